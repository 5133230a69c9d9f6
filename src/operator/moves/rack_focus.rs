//! The rack focus: from one subject to another at a different depth, both in the frame.
//!
//! A blur shows where one subject is near and the other far behind it, under a long lens. The camera therefore stands on
//! the line through both, a little aside of it so that neither hides the other.

use super::context::{StepContext, is_stated, require_visible};
use crate::constraint::{ConstraintKind, Scope};
use crate::framing::{Bearing, Fill, Target, distance_for, view_at};
use crate::motion::MotionSegment;
use crate::view::{aimed, lerp};
use cinesplat_trajectory::CameraState;

/// Height of the nearer subject in the frame.
const NEAR_FILL: (f64, f64) = (0.34, 0.62);
/// Vertical field of view, degrees: 50 to 110 mm on full frame.
const LENS_DEG: (f64, f64) = (12.5, 27.0);
/// Angle between the line through both subjects and the view of the nearer one, degrees.
const ASIDE_DEG: (f64, f64) = (3.0, 32.0);
/// Elevation of the camera, seen from the nearer subject, degrees.
const ELEVATION_DEG: (f64, f64) = (-2.0, 24.0);
/// Least height in the frame of the nearer subject and of the farther one.
const LEAST_HEIGHTS: [f64; 2] = [0.25, 0.1];
/// Least share of either subject in the frame.
const IN_FRAME: f64 = 0.98;

/// Moves the focus from one subject to another; the camera stays in place.
pub(super) fn rack_focus(context: &StepContext) -> Vec<MotionSegment> {
    let (from, to) = (context.opening_target(), context.main_target());
    let lined_up = lined_up(context, &from, &to);
    let (mut segments, view) = match (&context.before, lined_up) {
        (Some(before), _) => (Vec::new(), *before),
        (None, Some(view)) => (Vec::new(), view),
        (None, None) => context.opened_on(&from, (0.36, 0.62)),
    };
    let depth = |target: &Target| view.pose.to_camera(target.aim).z.max(1e-3 * context.world.bounds.size());
    let focused = |target: &Target| CameraState { focus_distance: Some(depth(target)), ..view };
    let mut segment = context.lasting(vec![focused(&from), focused(&to)], 2.5);
    let first_of = |target: &Target| target.ids.iter().take(1).copied().collect::<Vec<u32>>();
    if lined_up.is_some() && context.before.is_none() {
        let nearer_first = depth(&from) < depth(&to);
        let heights = if nearer_first { LEAST_HEIGHTS } else { [LEAST_HEIGHTS[1], LEAST_HEIGHTS[0]] };
        for (target, least) in [&from, &to].into_iter().zip(heights) {
            segment = segment
                .requiring(Scope::Start, ConstraintKind::InFrame(first_of(target), IN_FRAME))
                .requiring(Scope::Start, ConstraintKind::Height(target.clone(), (least, f64::INFINITY)));
        }
        segment = require_visible(segment, &from, Scope::Start);
    } else {
        segment = segment.requiring(Scope::All, ConstraintKind::InFrame(first_of(&to), 0.8));
    }
    segments.push(require_visible(segment, &to, Scope::All));
    segments
}

/// A camera that has one of two subjects before the other, aimed between them; `None` where the words say more about
/// the picture, or where there is no line through both. Parameter 4 picks the nearer one, 0 the angle to the line, 1 the
/// elevation, 2 the size and 3 the lens.
fn lined_up(context: &StepContext, from: &Target, to: &Target) -> Option<CameraState> {
    let (world, parameters) = (context.world, context.parameters);
    let step = context.step;
    if is_stated(&step.start) || is_stated(&step.end) || step.via.is_some() {
        return None;
    }
    if from.ids.is_empty() || to.ids.is_empty() || from.ids.first() == to.ids.first() {
        return None;
    }
    let [near, far] = if parameters[4] < 0.5 { [from, to] } else { [to, from] };
    let line = world.frame.horizontal(near.aim - far.aim);
    if !(line.length() > near.radius) {
        return None;
    }
    let off = 2.0 * parameters[0] - 1.0;
    let aside = lerp(ASIDE_DEG, off * off).to_radians().copysign(off);
    let elevation_rad = lerp(ELEVATION_DEG, parameters[1]).to_radians();
    let bearing = Bearing { azimuth_rad: world.frame.azimuth(line) + aside, elevation_rad };
    let fov_y_rad = lerp(LENS_DEG, parameters[3]).to_radians();
    let distance = distance_for(world, near, bearing, Fill::Height(lerp(NEAR_FILL, parameters[2])), fov_y_rad);
    let view = view_at(world, near.aim, bearing, distance, fov_y_rad);
    let eye = view.pose.position;
    let toward = |target: &Target| (target.aim - eye).normalize_or_zero();
    Some(aimed(world, &view, eye + toward(near) + toward(far)))
}

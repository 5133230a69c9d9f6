//! The rack focus: from one subject to another at a different depth, both in the frame.
//!
//! A blur shows where one subject is near and the other far behind it, under a long lens. The camera therefore stands on
//! the line through both, a little aside of it so that neither hides the other.

use super::context::{StepContext, is_stated, require_visible};
use crate::constraint::{ConstraintKind, Scope};
use crate::framing::{Bearing, Fill, Target, distance_for, view_at};
use crate::motion::MotionSegment;
use crate::program::Framing;
use crate::view::{aimed, lerp};
use cinesplat_trajectory::{CameraState, ShotSize};

/// Height of the nearer subject in the frame.
const NEAR_FILL: (f64, f64) = (0.34, 0.62);
/// Largest least height of a nearer subject whose size is stated.
const MOST_NEAR: f64 = 0.9;
/// Vertical field of view, degrees: 50 to 110 mm on full frame.
const LENS_DEG: (f64, f64) = (12.5, 27.0);
/// The same where the nearer subject has a stated size: close to a small thing a normal lens blurs what is behind it too.
const CLOSE_LENS_DEG: (f64, f64) = (16.0, 40.0);
/// Angle between the line through both subjects and the view of the nearer one, degrees.
const ASIDE_DEG: (f64, f64) = (3.0, 32.0);
/// Elevation of the camera, seen from the nearer subject, degrees.
const ELEVATION_DEG: (f64, f64) = (-2.0, 24.0);
/// Least height in the frame of the nearer subject and of the farther one.
const LEAST_HEIGHTS: [f64; 2] = [0.25, 0.1];
/// Least share of either subject in the frame.
const IN_FRAME: f64 = 0.98;
/// The same where the first subject has a stated size.
const IN_FRAME_OF_CLOSE: f64 = 0.9;
/// The same of a subject that is much larger than the other one, as a sofa behind a glass, and how much larger that is.
const IN_FRAME_OF_LARGE: f64 = 0.6;
const MUCH_LARGER: f64 = 3.0;

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
        for ((target, other), least) in [(&from, &to), (&to, &from)].into_iter().zip(heights) {
            let is_much_larger = target.radius > MUCH_LARGER * other.radius;
            let share = match (is_much_larger, context.step.start.size) {
                (true, _) => IN_FRAME_OF_LARGE,
                (false, Some(_)) => IN_FRAME_OF_CLOSE,
                (false, None) => IN_FRAME,
            };
            segment = segment
                .requiring(Scope::Start, ConstraintKind::InFrame(first_of(target), share))
                .requiring(Scope::Start, ConstraintKind::Height(target.clone(), (least, f64::INFINITY)));
        }
        segment = require_visible(segment, &from, Scope::Start);
    } else {
        segment = segment.requiring(Scope::All, ConstraintKind::InFrame(first_of(&to), 0.8));
    }
    segments.push(require_visible(segment, &to, Scope::All));
    segments
}

/// A framing without its size, and without a backdrop that is among `ids`: what a line through both subjects can still give.
fn without_size_and(ids: &[u32], framing: &Framing) -> Framing {
    let mut rest = Framing { size: None, ..framing.clone() };
    rest.backdrop.retain(|id| !ids.contains(id));
    rest
}

/// Height in the frame of the nearer subject whose size is stated. Both subjects share the picture, so that none is larger
/// than the frame.
fn near_fill(size: ShotSize) -> (f64, f64) {
    let (low, high) = size.height_band_frac();
    let low = low.min(MOST_NEAR);
    (low, high.min(1.15 * low))
}

/// A camera that has one of two subjects before the other, aimed between them; `None` where the words say more about
/// the picture, or where there is no line through both. Parameter 4 picks the nearer one, 0 the angle to the line, 1 the
/// elevation, 2 the size and 3 the lens.
fn lined_up(context: &StepContext, from: &Target, to: &Target) -> Option<CameraState> {
    let (world, parameters) = (context.world, context.parameters);
    let step = context.step;
    let opens_simply = !is_stated(&without_size_and(&to.ids, &step.start));
    if !opens_simply || is_stated(&step.end) || step.via.is_some() {
        return None;
    }
    if from.ids.is_empty() || to.ids.is_empty() || from.ids.first() == to.ids.first() {
        return None;
    }
    let sized = step.start.size.map(near_fill);
    let [near, far] = if sized.is_some() || parameters[4] < 0.5 { [from, to] } else { [to, from] };
    let line = world.frame.horizontal(near.aim - far.aim);
    if !(line.length() > near.radius) {
        return None;
    }
    let off = 2.0 * parameters[0] - 1.0;
    let aside = lerp(ASIDE_DEG, off * off).to_radians().copysign(off);
    let elevation_rad = lerp(ELEVATION_DEG, parameters[1]).to_radians();
    let bearing = Bearing { azimuth_rad: world.frame.azimuth(line) + aside, elevation_rad };
    let lens_deg = if sized.is_some() { CLOSE_LENS_DEG } else { LENS_DEG };
    let fov_y_rad = lerp(lens_deg, parameters[3]).to_radians();
    let distance =
        distance_for(world, near, bearing, Fill::Height(lerp(sized.unwrap_or(NEAR_FILL), parameters[2])), fov_y_rad);
    let view = view_at(world, near.aim, bearing, distance, fov_y_rad);
    let eye = view.pose.position;
    let toward = |target: &Target| (target.aim - eye).normalize_or_zero();
    Some(aimed(world, &view, eye + toward(near) + toward(far)))
}

//! Pushes over the back of a chair onto what lies before it: the back stands in the foreground at first, and the subject
//! fills a good part of the picture at the end.

use super::context::{NORMAL_LENS_DEG, StepContext, require_visible};
use crate::constraint::{ConstraintKind, Scope};
use crate::framing::{Bearing, Fill, Target, distance_for};
use crate::motion::MotionSegment;
use crate::program::Pass;
use crate::view::{aimed, fill_in, lerp, moved};
use crate::world::Subject;
use cinesplat_geometry::Pose;
use cinesplat_trajectory::{CameraState, Move};

/// Largest level distance between the two things, over the extent of the one that is passed.
const NEAR_RADII: f64 = 7.0;
/// Height of the thing's top over a person's eyes up to which one looks over it.
const LOW_TOP: f64 = 0.95;
/// Value of parameter 2 from which on the camera flies over the thing anyhow.
const OVER_SHOULDER_TO: f64 = 0.75;
/// Distance of the camera behind the thing at first, over its radius, and height above its top, over its extent upward.
const BEHIND_RADII: (f64, f64) = (0.7, 1.8);
const ABOVE_FRAC: (f64, f64) = (0.06, 0.3);
/// Share of the frame that the subject takes at the end.
const END_FILL: (f64, f64) = (0.4, 0.62);

/// A push over a thing onto the subject before it; `None` for other steps, and where the two are far apart.
pub(super) fn over_shoulder(context: &StepContext) -> Option<Vec<MotionSegment>> {
    let step = context.step;
    let via = step.via.as_ref().filter(|via| via.how == Pass::Over && via.objects.len() == 1)?;
    let goes_in = matches!(step.movement, Move::PushIn | Move::Follow | Move::FlyThrough);
    let free = context.before.is_none() && context.parameters[2] < OVER_SHOULDER_TO;
    let goal = context.end.as_ref().filter(|_| goes_in && free)?;
    let passed = context.world.subject(via.objects[0]).filter(|passed| is_low_and_near(context, passed, goal))?;
    let (world, frame) = (context.world, &context.world.frame);
    let aside = (context.parameters[2] / OVER_SHOULDER_TO - 0.5) * 0.7;
    let heading = frame.azimuth(goal.aim - passed.center) + aside;
    let ahead = frame.direction(heading);
    let top = passed.reach(frame.up) + lerp(ABOVE_FRAC, context.parameters[1]) * 2.0 * passed.reach(frame.up);
    let top = top.max(passed.reach(frame.up) + 1.6 * world.camera_radius);
    let back = passed.reach(ahead) + lerp(BEHIND_RADII, context.parameters[3]) * passed.radius;
    let fov_y_rad = lerp(NORMAL_LENS_DEG, context.parameters[5]).to_radians();
    let at = |position| CameraState {
        pose: Pose { position, rotation: glam::DQuat::IDENTITY },
        fov_y_rad,
        focus_distance: None,
    };
    let first = aimed(world, &at(passed.center - ahead * back + frame.up * top), goal.aim);
    let over = passed.center + frame.up * top;
    let above = aimed(world, &moved(&first, over - first.pose.position), goal.aim);
    let last = onto(context, goal, &above);
    let segment = context.segment(vec![first, above, last]).about(goal.aim);
    let segment = segment
        .requiring(Scope::All, ConstraintKind::DistanceRatio(goal.aim, (0.0, 0.57)))
        .requiring(Scope::End, ConstraintKind::Centered(goal.clone(), 0.2));
    Some(vec![require_visible(context.constrained_at_end(segment), goal, Scope::End)])
}

/// Whether somebody can look over a thing at the goal, and the goal lies before it.
fn is_low_and_near(context: &StepContext, passed: &Subject, goal: &Target) -> bool {
    let world = context.world;
    let top = world.top_above_floor(passed);
    let apart = world.frame.horizontal(goal.aim - passed.center).length();
    world.is_indoor() && top < LOW_TOP * world.eye_height() && apart < NEAR_RADII * passed.radius
}

/// The camera on the line from above the thing to the goal, at the size that the words state or a good one.
fn onto(context: &StepContext, goal: &Target, above: &CameraState) -> CameraState {
    let world = context.world;
    let way = goal.aim - above.pose.position;
    let fill = fill_in(world, &context.step.end, context.parameters[6])
        .unwrap_or(Fill::Fit(lerp(END_FILL, context.parameters[6])));
    let bearing = Bearing {
        azimuth_rad: world.frame.azimuth(-way),
        elevation_rad: (-world.frame.height(way)).atan2(world.frame.horizontal(way).length()),
    };
    let distance = distance_for(world, goal, bearing, fill, above.fov_y_rad).min(0.9 * way.length());
    aimed(world, &moved(above, way - way.normalize_or_zero() * distance), goal.aim)
}

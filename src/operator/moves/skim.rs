//! Flights just above a table, between what stands on it: `like a toy car along the table top, from the wine glass to the
//! globe`, `skim over the wood`.

use glam::DVec3;

use super::context::{StepContext, require_visible};
use crate::constraint::{ConstraintKind, Scope};
use crate::framing::{Bearing, Fill, Target};
use crate::motion::MotionSegment;
use crate::program::{Framing, Pass};
use crate::view::{aimed, fill_in, lerp, moved, view_from};
use crate::world::Subject;
use cinesplat_geometry::Pose;
use cinesplat_trajectory::{CameraState, Move, ShotAngle};

/// Heights of the camera above the tabletop: over its radius, and over the height of what stands there.
const LEAST_RADII: f64 = 1.2;
const LOW_RADII: f64 = 1.7;
const AMONG_THINGS: f64 = 0.6;
/// Height above a tabletop up to which a stated height is one just above it, over the height of a person's eyes.
const JUST_ABOVE: f64 = 0.25;
/// Vertical field of view of a flight among things, degrees.
const LENS_DEG: (f64, f64) = (42.0, 60.0);
/// Sizes of the things at both ends.
const FIRST_FILL: (f64, f64) = (0.4, 0.75);
const LAST_FILL: (f64, f64) = (0.45, 0.75);
/// Angle about the first thing by which the camera stands aside of the way, so that it passes it, radians.
const ASIDE_RAD: (f64, f64) = (0.25, 1.0);
/// Farthest that the way bends aside, over the table's shorter half.
const BEND: f64 = 0.7;
/// Where a flight to nothing in particular ends: before the end of the table, over half its length.
const SHORT_OF: (f64, f64) = (0.5, 1.0);
/// Keyframes between both ends.
const NUM_INNER: u32 = 2;

/// The table just above which a step flies; `None` for any other step.
fn table<'a>(context: &StepContext<'a>) -> Option<(&'a Subject, [f64; 2])> {
    let (world, step) = (context.world, context.step);
    let via = step.via.as_ref().filter(|via| matches!(via.how, Pass::Along | Pass::Over))?;
    let id = *via.objects.first()?;
    let table = world.subject(id)?;
    let heights = table.borne_heights?;
    let stands = |target: &Option<Target>| {
        let first = target.as_ref().and_then(|target| target.ids.first()).and_then(|id| world.subject(*id));
        first.is_some_and(|thing| thing.bearer == Some(id))
    };
    let surface = world.height_above_floor(table.center) + heights[0] - world.frame.height(table.center);
    let is_low = |framing: &Framing| {
        let above = framing.height.map(|height| height - surface);
        above.is_some_and(|above| above > 0.0 && above < JUST_ABOVE * world.eye_height())
            || matches!(framing.angle, Some(ShotAngle::EyeLevel | ShotAngle::Low | ShotAngle::Worm))
    };
    let are_on_it = stands(&context.end) && (stands(&context.start) || context.before.is_some());
    let flies = matches!(step.movement, Move::FlyThrough | Move::Follow | Move::PushIn);
    (flies && (are_on_it || is_low(&step.start) || is_low(&step.end))).then_some((table, heights))
}

/// Whether a step flies just above a table.
pub(super) fn skims(context: &StepContext) -> bool {
    table(context).is_some()
}

/// The flight; `None` where the step is no such flight.
pub(super) fn skim(context: &StepContext) -> Option<Vec<MotionSegment>> {
    let (table, heights) = table(context)?;
    let id = context.step.via.as_ref()?.objects.first().copied();
    let on_it = |target: &Option<Target>| target.clone().filter(|target| target.ids.first().copied() != id);
    let context = &StepContext { start: on_it(&context.start), end: on_it(&context.end), ..context.clone() };
    let world = context.world;
    let frame = &world.frame;
    let height = flight_height(context, table, heights);
    let [long, short] = table.level_axes(frame.up);
    let sign = if context.parameters[2] < 0.5 { -1.0 } else { 1.0 };
    let from = context.start.as_ref().map(|start| start.center);
    let to = context.end.as_ref().map(|end| end.center);
    let ends = match (from.or(context.before.map(|before| before.pose.position)), to) {
        (Some(from), Some(to)) => [from, to],
        (Some(from), None) => [from, table.center + long * (table.center - from).dot(long).signum()],
        (None, Some(to)) => [table.center - long * (to - table.center).dot(long).signum(), to],
        (None, None) => [table.center - long * sign, table.center + long * sign],
    };
    let way = frame.horizontal(ends[1] - ends[0]).try_normalize().or_else(|| long.try_normalize())?;
    let first = first_camera(context, (ends[0], way), height);
    let last = last_camera(context, (ends[1], way), (long.length(), [heights[0], height]));
    let aside = way.cross(frame.up) * short.length() * BEND;
    let bend = |i: u32| aside * (context.parameters[if i == 1 { 0 } else { 3 }] * 2.0 - 1.0);
    let inner = |i: u32| {
        let at = first.pose.position.lerp(last.pose.position, f64::from(i) / f64::from(NUM_INNER + 1)) + bend(i);
        let position = frame.at_height(at, height);
        let state = moved(&CameraState { fov_y_rad: last.fov_y_rad, ..first }, position - first.pose.position);
        let ahead = context.end.as_ref().map_or_else(|| frame.at_height(ends[1], heights[0]), |end| end.aim);
        aimed(world, &state, ahead)
    };
    let states = std::iter::once(first).chain((1..=NUM_INNER).map(inner)).chain([last]).collect();
    let floor = frame.height(table.center) - world.height_above_floor(table.center);
    let band = (heights[0] - floor, height - floor + 1.5 * world.camera_radius);
    let scope = if context.before.is_some() { Scope::End } else { Scope::All };
    let mut segment = context.constrained_at_end(context.constrained_at_start(context.segment(states)));
    segment = segment.requiring(scope, ConstraintKind::CameraHeight(band));
    if let Some(start) = context.start.as_ref().filter(|_| context.before.is_none()) {
        segment = require_visible(segment, start, Scope::Start);
    }
    if let Some(end) = &context.end {
        segment = segment.requiring(Scope::End, ConstraintKind::Centered(end.clone(), 0.15));
        segment = require_visible(segment, end, Scope::End);
    }
    Some(vec![segment])
}

/// Height of the camera along up: the stated one, or between the things on the table.
fn flight_height(context: &StepContext, table: &Subject, [surface, top]: [f64; 2]) -> f64 {
    let world = context.world;
    let radius = world.camera_radius;
    let stated = context.step.end.height.or(context.step.start.height);
    let stated =
        stated.map(|height| world.frame.height(table.center) + height - world.height_above_floor(table.center));
    let most = (LOW_RADII * radius).max(AMONG_THINGS * (top - surface));
    let open = surface + lerp((LEAST_RADII * radius, most), context.parameters[1]);
    stated.unwrap_or(open).max(surface + LEAST_RADII * radius)
}

/// The camera at the start: the one before; on the near side of the first thing and a little aside of the way; or at the
/// end of the table.
fn first_camera(context: &StepContext, (from, way): (DVec3, DVec3), height: f64) -> CameraState {
    let world = context.world;
    let frame = &world.frame;
    if let Some(before) = &context.before {
        return *before;
    }
    let fov_y_rad = lerp(LENS_DEG, context.parameters[5]).to_radians();
    let Some(start) = &context.start else {
        let position = frame.at_height(from, height);
        let pose = Pose { position, rotation: glam::DQuat::IDENTITY };
        return aimed(world, &CameraState { pose, fov_y_rad, focus_distance: None }, position + way);
    };
    let side = if context.parameters[4] < 0.5 { -1.0 } else { 1.0 };
    let swing = side * lerp(ASIDE_RAD, (2.0 * context.parameters[4]).fract());
    let azimuth_rad = frame.azimuth(-way) + swing;
    let fill = Fill::Fit(lerp(FIRST_FILL, context.parameters[6]));
    level_view(context, (start, &context.step.start), (azimuth_rad, fill), (height, fov_y_rad))
}

/// The camera at the end: before the last thing, or near the end of the table.
fn last_camera(
    context: &StepContext,
    (to, way): (DVec3, DVec3),
    (half, [surface, height]): (f64, [f64; 2]),
) -> CameraState {
    let world = context.world;
    let frame = &world.frame;
    let fov_y_rad = lerp(LENS_DEG, context.parameters[5]).to_radians();
    let Some(end) = &context.end else {
        let position = frame.at_height(to - way * lerp(SHORT_OF, context.parameters[7]) * half, height);
        let pose = Pose { position, rotation: glam::DQuat::IDENTITY };
        return aimed(world, &CameraState { pose, fov_y_rad, focus_distance: None }, frame.at_height(to, surface));
    };
    let azimuth_rad = frame.azimuth(-way) + (context.parameters[2] - 0.5) * 0.8;
    let fill = Fill::Fit(lerp(LAST_FILL, context.parameters[7]));
    level_view(context, (end, &context.step.end), (azimuth_rad, fill), (height, fov_y_rad))
}

/// The view of a thing from a height and an azimuth, at its stated size or a fill.
fn level_view(
    context: &StepContext,
    (target, framing): (&Target, &Framing),
    (azimuth_rad, fill): (f64, Fill),
    (height, fov_y_rad): (f64, f64),
) -> CameraState {
    let world = context.world;
    let fill = fill_in(world, framing, context.parameters[7]).unwrap_or(fill);
    let framing = Framing { height: None, ..framing.clone() };
    let bearing = Bearing { azimuth_rad, elevation_rad: 0.0 };
    let view = view_from(world, (target, &framing), bearing, fill, fov_y_rad);
    let rise = height - world.frame.height(view.pose.position);
    aimed(world, &moved(&view, world.frame.up * rise), target.aim)
}

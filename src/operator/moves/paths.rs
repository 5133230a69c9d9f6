//! Moves along a free path: between two views, a reveal, back to the start.

use glam::DVec3;

use super::context::{NORMAL_LENS_DEG, StepContext, require_visible};
use super::room_view::room_target;
use super::standing::turned_away;
use crate::composition::{natural_elevation_deg, stated_azimuths};
use crate::constraint::{ConstraintKind, Scope, pitch_band_deg};
use crate::contents::middle_of_things;
use crate::detours::is_clear;
use crate::framing::{Bearing, Fill, Target, bearing_of};
use crate::motion::MotionSegment;
use crate::program::{Framing, Motion};
use crate::view::{fill_in, lerp, moved, view_from};
use cinesplat_geometry::{LevelAngles, Pose, rotation};
use cinesplat_trajectory::{CameraState, Move, ShotAngle, ShotSize};

/// Moves from the view before, or from a view of the start target, to a view of the end target.
pub(super) fn follow(context: &StepContext) -> Vec<MotionSegment> {
    let end = context.main_target();
    if end.ids.is_empty() && context.before.is_none() && context.world.is_indoor() {
        return walk(context, &end);
    }
    let room = room_target(context.world, context.parameters).filter(|_| context.opens_on_room());
    let start = room.unwrap_or_else(|| context.opening_target());
    let nears = goes_over(context, &start, &end);
    let fill = if nears { (0.14, 0.28) } else { (0.4, 0.7) };
    let first = match &context.before {
        Some(before) => *before,
        None => context.view(&start, &context.opening_framing(), fill, NORMAL_LENS_DEG),
    };
    let last = end_view(context, &end, &first);
    let mut segment = glide(context, &first, &last);
    if nears {
        segment = segment.requiring(Scope::All, ConstraintKind::DistanceRatio(end.aim, (0.0, 0.7)));
    }
    vec![arriving(context, segment, Some(&start), &end)]
}

/// A way with what the words state of its ends: the start is seen where no step before decides that, and the end in the middle of the
/// picture.
pub(super) fn arriving(
    context: &StepContext,
    segment: MotionSegment,
    start: Option<&Target>,
    end: &Target,
) -> MotionSegment {
    let mut segment = context
        .constrained_at_end(context.constrained_at_start(segment))
        .requiring(Scope::End, ConstraintKind::Centered(end.clone(), 0.15));
    if let Some(start) = start.filter(|_| context.before.is_none()) {
        segment = require_visible(segment, start, Scope::Start);
    }
    require_visible(segment, end, Scope::End)
}

/// Whether the film begins with a way to the one thing that it names: `go over to the skull` sets out from farther
/// away.
fn goes_over(context: &StepContext, start: &Target, end: &Target) -> bool {
    let [opening, closing] = [&context.step.start, &context.step.end];
    let is_open = *opening == Framing { subjects: opening.subjects.clone(), ..Framing::default() };
    let is_wide = matches!(closing.size, Some(ShotSize::MediumLong | ShotSize::Long | ShotSize::ExtremeLong));
    context.before.is_none() && !end.ids.is_empty() && start.ids == end.ids && is_open && !is_wide && !closing.whole
}

/// Share of the way to what it looks at that a camera walks into a room where the prompt names no goal.
const WALK_FRAC: (f64, f64) = (0.36, 0.66);
/// Largest turn of a camera that walks into a room to what it comes to, radians: to a side, and up or down.
const MOST_WALK_TURN_RAD: [f64; 2] = [0.2, 0.14];

/// Walks into a room at one height, along the view from where somebody stands.
fn walk(context: &StepContext, ahead: &Target) -> Vec<MotionSegment> {
    let first = context.view(ahead, &context.opening_framing(), (0.4, 0.7), NORMAL_LENS_DEG);
    let way = context.world.frame.horizontal(ahead.aim - first.pose.position);
    let last = turned_to_things(context, &moved(&first, way * lerp(WALK_FRAC, context.parameters[6])));
    let segment = context.constrained_at_end(context.constrained_at_start(glide(context, &first, &last)));
    vec![segment]
}

/// The camera turned so far that what it shows lies about the middle of its picture. Who walks up to a desk looks down to it.
fn turned_to_things(context: &StepContext, state: &CameraState) -> CameraState {
    let world = context.world;
    let middle = middle_of_things(world, state).filter(|_| !context.forbids_turning());
    let Some(at) = middle else { return *state };
    let tan = 2.0 * (state.fov_y_rad / 2.0).tan();
    let [aside, upright] = MOST_WALK_TURN_RAD;
    let angles = world.frame.angles(state.pose.rotation);
    let rotation = world.frame.rotation(LevelAngles {
        yaw_rad: angles.yaw_rad + (at.x * tan * world.aspect).atan().clamp(-aside, aside),
        pitch_rad: angles.pitch_rad + (at.y * tan).atan().clamp(-upright, upright),
        ..angles
    });
    CameraState { pose: Pose { rotation, ..state.pose }, ..*state }
}

/// A view of the step's end target with the field of view of its start, so that only the camera's travel changes the
/// picture.
pub(super) fn end_view(context: &StepContext, end: &Target, first: &CameraState) -> CameraState {
    let world = context.world;
    let near = bearing_of(world, end.aim, first.pose.position);
    let parameters = context.parameters;
    // The density peaks at the bearing that the camera comes from: the shortest path shows the side that it already
    // sees.
    let spread = |parameter: f64| (parameter * 2.0 - 1.0) * (parameter * 2.0 - 1.0).abs();
    let band = context.step.end.angle.map(|angle| {
        let (low, high) = pitch_band_deg(angle);
        match angle {
            ShotAngle::Overhead => (56.0, 84.0),
            ShotAngle::High => (24.0, 38.0),
            _ => (-high.min(34.0), -low.max(-70.0)),
        }
    });
    let elevation_deg = if let Some(band) = band {
        lerp(band, parameters[7])
    } else {
        let (low, high) = natural_elevation_deg(world, end);
        near.elevation_rad.to_degrees().midpoint(lerp((low, high), parameters[7])).clamp(low, high + 8.0)
    };
    let framing = &context.step.end;
    let wall_front_rad = wall_front(context, end);
    let facing_rad = world.facing(end.center);
    let azimuth_rad = match stated_azimuths(world, end, framing) {
        Some((stated, beside_rad)) => nearest(&stated, near.azimuth_rad) + spread(parameters[5]) * beside_rad,
        None => match wall_front_rad {
            // What hangs on a wall or is part of it is looked at from its front.
            Some(front_rad) => front_rad + spread(parameters[5]) * 0.5,
            None if parameters[4] < FACED_TO && facing_rad.is_some() => {
                facing_rad.unwrap_or_default() + spread(parameters[5]) * FACED_RAD
            }
            None => near.azimuth_rad + spread(parameters[5]) * 2.4,
        },
    };
    let elevation_rad = framing.elevation_deg.unwrap_or(elevation_deg).to_radians();
    let bearing = unturned(context, first, Bearing { azimuth_rad, elevation_rad });
    let open = if world.is_indoor() { END_FILL } else { LONE_END_FILL };
    let fill = fill_in(world, framing, parameters[6]).unwrap_or_else(|| Fill::Fit(lerp(open, parameters[6])));
    let loose = framing.whole && framing.height_frac.is_none();
    let fill = if loose { Fill::Fit(lerp((0.6, 0.88), parameters[6])) } else { fill };
    let view = view_from(world, (end, framing), bearing, fill, context.end_fov_rad(first));
    if fill_in(world, framing, parameters[6]).is_some() || framing.distance.is_some() || !world.is_indoor() {
        return view;
    }
    // Somebody who walks up to a wall stops an arm's length and more before it.
    let least = if wall_front_rad.is_some() { LEAST_WALL_EYES * world.eye_height() } else { 0.0 };
    let short = least - view.pose.position.distance(end.aim);
    moved(&view, -view.pose.forward() * short.max(0.0))
}

/// Size of what a way ends at, where the words state none: in a room, and of a lone thing, about which there is nothing.
const END_FILL: (f64, f64) = (0.45, 0.78);
const LONE_END_FILL: (f64, f64) = (0.62, 0.92);
/// Value of parameter 4 up to which a way to what faces people ends before it, and how far beside, radians.
const FACED_TO: f64 = 0.7;
const FACED_RAD: f64 = 1.0;
/// Distance at which a walk up to a thing on a wall ends at least, over the height of a standing person's eyes.
const LEAST_WALL_EYES: f64 = 0.7;
/// Thickness of a thing on a wall over its width and its height.
const WALL_THIN: f64 = 0.3;

/// Azimuth of the free side of a thing on a wall, such as a window or a picture; `None` of any other thing.
fn wall_front(context: &StepContext, target: &Target) -> Option<f64> {
    let world = context.world;
    let subject = world.subject(*target.ids.first()?).filter(|_| world.is_indoor())?;
    let [wide, thin] = subject.level_axes(world.frame.up);
    let is_thin = thin.length() < WALL_THIN * wide.length().min(subject.reach(world.frame.up));
    let normal = thin.try_normalize().filter(|_| is_thin)?;
    let free = |way: DVec3| {
        let from = subject.center + way * (thin.length() + 2.0 * world.camera_radius);
        world.hit_distance(from, way).unwrap_or(0.0)
    };
    let (there, back) = (free(normal), free(-normal));
    let least = world.eye_height();
    // Free on both sides it stands in the room, such as a guitar or a screen.
    let is_on_wall = there.min(back) < LEAST_WALL_EYES * least && there.max(back) > least;
    is_on_wall.then(|| world.frame.azimuth(if there > back { normal } else { -normal }))
}

/// The bearing from which a camera sees the end target without the turns that the prompt forbids.
fn unturned(context: &StepContext, first: &CameraState, bearing: Bearing) -> Bearing {
    let forbids = |motions: [Motion; 2]| context.forbidden.iter().any(|motion| motions.contains(motion));
    let frame = &context.world.frame;
    let angles = frame.angles(first.pose.rotation);
    let azimuth_rad =
        if forbids([Motion::Turn, Motion::Pan]) { frame.azimuth(-first.pose.forward()) } else { bearing.azimuth_rad };
    let elevation_rad = if forbids([Motion::Turn, Motion::Tilt]) { -angles.pitch_rad } else { bearing.elevation_rad };
    Bearing { azimuth_rad, elevation_rad }
}

/// The angle of several that is the shortest turn away from another one.
fn nearest(angles_rad: &[f64], from_rad: f64) -> f64 {
    let turn = |angle: &&f64| rotation::short_turn(**angle - from_rad).abs();
    angles_rad.iter().min_by(|a, b| turn(a).total_cmp(&turn(b))).copied().unwrap_or(from_rad)
}

/// A path from one view to another: straight where that is clear of matter; else bent sideways or up, so that the
/// search can avoid obstacles.
fn glide(context: &StepContext, first: &CameraState, last: &CameraState) -> MotionSegment {
    let straight = context.segment(vec![*first, *last]);
    if is_clear(context.world, &straight) {
        return straight;
    }
    let way = last.pose.position - first.pose.position;
    let length = way.length();
    let frame = &context.world.frame;
    let aside = way.cross(frame.up).try_normalize().unwrap_or_else(|| first.pose.right());
    let bow = |parameter: f64| if parameter < 0.4 { 0.0 } else { (parameter - 0.7) / 0.3 * 0.35 * length };
    let offset = aside * bow(context.parameters[0]) + frame.up * bow(context.parameters[1]).max(-0.1 * length);
    if offset.length() > 1e-6 * length && length > 0.0 {
        context.segment(vec![*first, halfway(context, first, last, offset), *last])
    } else {
        straight
    }
}

/// The middle state of two, displaced by `offset`; its yaw, pitch and roll lie halfway between theirs.
fn halfway(context: &StepContext, first: &CameraState, last: &CameraState, offset: DVec3) -> CameraState {
    let frame = &context.world.frame;
    let (a, b) = (frame.angles(first.pose.rotation), frame.angles(last.pose.rotation));
    let turn = rotation::short_turn(b.yaw_rad - a.yaw_rad);
    let middle = LevelAngles {
        yaw_rad: a.yaw_rad + turn / 2.0,
        pitch_rad: a.pitch_rad.midpoint(b.pitch_rad),
        roll_rad: a.roll_rad.midpoint(b.roll_rad),
    };
    let position = first.pose.position.lerp(last.pose.position, 0.5) + offset;
    let pose = Pose { position, rotation: frame.rotation(middle) };
    CameraState { pose, fov_y_rad: first.fov_y_rad.midpoint(last.fov_y_rad), focus_distance: None }
}

/// Returns to the pose and lens of the shot's first frame.
pub(super) fn back_to_origin(context: &StepContext) -> Vec<MotionSegment> {
    let (Some(before), Some(origin)) = (context.before, context.origin) else { return Vec::new() };
    let mut segment = glide(context, &before, &origin);
    segment.movement = Move::Follow;
    vec![segment]
}

/// Starts with the subject outside the frame and brings it into view.
pub(super) fn reveal(context: &StepContext) -> Vec<MotionSegment> {
    let target = context.main_target();
    let stood = turned_away(context, &target).filter(|_| context.before.is_none());
    let last = match context.before.as_ref().or(stood.as_ref()) {
        Some(before) => end_view(context, &target, before),
        None => context.view(&target, &context.step.end, (0.4, 0.7), NORMAL_LENS_DEG),
    };
    let first = match context.before.as_ref().or(stood.as_ref()) {
        Some(before) => *before,
        None => moved(&last, out_of_frame(context, &last, &target)),
    };
    let mut segment = glide(context, &first, &last);
    segment = context.constrained_at_end(segment).requiring(Scope::End, ConstraintKind::Centered(target.clone(), 0.15));
    if context.before.is_none() {
        segment = segment
            .requiring(Scope::Start, ConstraintKind::NotWhole(target.ids.iter().take(1).copied().collect(), 0.25));
    }
    vec![require_visible(segment, &target, Scope::End)]
}

/// Displacement that takes the target out of the frame, against the direction of the reveal.
fn out_of_frame(context: &StepContext, last: &CameraState, target: &Target) -> DVec3 {
    let distance = last.pose.position.distance(target.aim);
    let half_height = (last.fov_y_rad / 2.0).tan() * distance;
    let half_width = half_height * context.world.aspect;
    let (right, up) = (last.pose.right(), context.world.frame.up);
    let aside = right * (half_width * 1.05 + target.radius);
    let aloft = up * (half_height * 1.05 + target.radius);
    match context.step.with.first() {
        Some(Move::TruckRight | Move::PanRight | Move::OrbitRight | Move::ArcRight) => -aside,
        Some(Move::TruckLeft | Move::PanLeft | Move::OrbitLeft | Move::ArcLeft) => aside,
        Some(Move::PedestalUp | Move::CraneUp | Move::TiltUp) => -aloft,
        Some(Move::PedestalDown | Move::CraneDown | Move::TiltDown) => aloft,
        Some(Move::PullOut) => last.pose.forward() * (0.8 * distance) + aside * 0.5,
        _ if context.parameters[5] < 0.5 => -aside,
        _ => aside,
    }
}

//! Moves along a free path: between two views, between or over objects, a reveal, back to the start.

use glam::DVec3;

use super::context::{NORMAL_LENS_DEG, StepContext, require_visible};
use crate::constraint::{ConstraintKind, Scope, pitch_band_deg};
use crate::framing::{Bearing, DEFAULT_ASPECT, Fill, Target, bearing_of, distance_for, off_center, view_at};
use crate::motion::MotionSegment;
use crate::program::{Pass, Via};
use crate::view::{aimed, lerp, moved, size_fill};
use cinesplat_geometry::{LevelAngles, Pose, rotation};
use cinesplat_trajectory::{CameraState, Move};

/// Moves from the view before, or from a view of the start target, to a view of the end target.
pub(super) fn follow(context: &StepContext) -> Vec<MotionSegment> {
    let (start, end) = (context.opening_target(), context.main_target());
    let first = match &context.before {
        Some(before) => *before,
        None => context.view(&start, &context.opening_framing(), (0.4, 0.7), NORMAL_LENS_DEG),
    };
    let last = end_view(context, &end, &first);
    let mut segment = glide(context, &first, &last);
    segment = context
        .constrained_at_end(context.constrained_at_start(segment))
        .requiring(Scope::End, ConstraintKind::Centered(end.clone(), 0.15));
    if context.before.is_none() {
        segment = require_visible(segment, &start, Scope::Start);
    }
    vec![require_visible(segment, &end, Scope::End)]
}

/// A view of the step's end target with the field of view of its start, so that only the camera's travel changes the
/// picture.
fn end_view(context: &StepContext, end: &Target, first: &CameraState) -> CameraState {
    let world = context.world;
    let near = bearing_of(world, end.aim, first.pose.position);
    let parameters = context.parameters;
    // The density peaks at the bearing that the camera comes from: the shortest path shows the side that it already
    // sees.
    let spread = |parameter: f64| (parameter * 2.0 - 1.0) * (parameter * 2.0 - 1.0).abs();
    let band = context.step.end.angle.map(|angle| {
        let (low, high) = pitch_band_deg(angle);
        (-high.min(34.0), -low.max(-70.0))
    });
    let elevation_deg = match band {
        Some(band) => lerp(band, parameters[7]),
        None => (near.elevation_rad.to_degrees() * 0.5 + lerp((-6.0, 20.0), parameters[7]) * 0.7).clamp(-12.0, 40.0),
    };
    let bearing = Bearing {
        azimuth_rad: near.azimuth_rad + spread(parameters[5]) * 2.4,
        elevation_rad: elevation_deg.to_radians(),
    };
    let fill = match context.step.end.size {
        Some(size) => size_fill(size, parameters[6]),
        None => Fill::Fit(lerp((0.35, 0.7), parameters[6])),
    };
    let fill = if context.step.end.whole { Fill::Fit(lerp((0.5, 0.85), parameters[6])) } else { fill };
    let distance = distance_for(world, end, bearing, fill, first.fov_y_rad);
    view_at(world, end.aim, bearing, distance, first.fov_y_rad)
}

/// A path from one view to another: straight, or bent sideways or up, so that the search can avoid obstacles.
fn glide(context: &StepContext, first: &CameraState, last: &CameraState) -> MotionSegment {
    let way = last.pose.position - first.pose.position;
    let length = way.length();
    let frame = &context.world.frame;
    let aside = way.cross(frame.up).try_normalize().unwrap_or_else(|| first.pose.right());
    let bow = |parameter: f64| if parameter < 0.4 { 0.0 } else { (parameter - 0.7) / 0.3 * 0.35 * length };
    let offset = aside * bow(context.parameters[0]) + frame.up * bow(context.parameters[1]).max(-0.1 * length);
    let states = if offset.length() > 1e-6 * length && length > 0.0 {
        vec![*first, halfway(context, first, last, offset), *last]
    } else {
        vec![*first, *last]
    };
    let angle_deg = rotation::angle_between(first.pose.rotation, last.pose.rotation).to_degrees();
    let natural = (angle_deg / 20.0).max(length / context.world.bounds.size() * 11.0).clamp(2.5, 8.0);
    context.segment(states, natural)
}

/// The middle state of two, displaced by `offset`; its yaw, pitch and roll lie halfway between theirs.
fn halfway(context: &StepContext, first: &CameraState, last: &CameraState, offset: DVec3) -> CameraState {
    let frame = &context.world.frame;
    let (a, b) = (frame.angles(first.pose.rotation), frame.angles(last.pose.rotation));
    let turn = (b.yaw_rad - a.yaw_rad + std::f64::consts::PI).rem_euclid(std::f64::consts::TAU) - std::f64::consts::PI;
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

/// Passes between two objects or over one, toward the end target.
pub(super) fn passing(context: &StepContext) -> Vec<MotionSegment> {
    let Some(gate) = context.step.via.as_ref().and_then(|via| gate(context, via)) else { return follow(context) };
    let frame = &context.world.frame;
    let goal = context.end.clone();
    let (mut segments, first) = match &context.before {
        Some(before) => context.turned_to(before, gate),
        None => (Vec::new(), before_gate(context, gate, goal.as_ref())),
    };
    let last = match &goal {
        Some(goal) => {
            let along = (goal.aim - gate).length();
            let stop = gate.lerp(goal.aim, lerp((0.25, 0.75), context.parameters[6]));
            let stop = stop + frame.up * lerp((-0.1, 0.25), context.parameters[7]) * along;
            aimed(context.world, &moved(&first, stop - first.pose.position), goal.aim)
        }
        None => moved(&first, (gate - first.pose.position) * 2.0),
    };
    let aim = goal.as_ref().map_or(gate + (gate - first.pose.position) * 4.0, |goal| goal.aim);
    let middle = aimed(context.world, &moved(&first, gate - first.pose.position), aim);
    let length = first.pose.position.distance(gate) + gate.distance(last.pose.position);
    let natural = (length / context.world.bounds.size() * 11.0).clamp(3.0, 8.0);
    let mut segment = context.segment(vec![first, middle, last], natural);
    if let Some(goal) = goal {
        if off_center(&first, goal.aim) < 0.5 {
            segment = segment.about(goal.aim);
            segment.states[0] = aimed(context.world, &first, goal.aim);
            if let Some(join) = segments.last_mut() {
                let end = join.states.len() - 1;
                join.states[end] = segment.states[0];
            }
        }
        segment = segment.requiring(Scope::All, ConstraintKind::DistanceRatio(goal.aim, (0.0, 0.57)));
        segment = segment.requiring(Scope::End, ConstraintKind::Centered(goal.clone(), 0.2));
        segment = require_visible(context.constrained_at_end(segment), &goal, Scope::End);
    }
    segments.push(segment);
    segments
}

/// The point to pass through: on the line between two objects, or above one.
fn gate(context: &StepContext, via: &Via) -> Option<DVec3> {
    let world = context.world;
    let frame = &world.frame;
    let subject = |i: usize| via.objects.get(i).and_then(|&id| world.subject(id));
    let first = subject(0)?;
    let top = |corners: &[DVec3]| corners.iter().map(|&c| frame.height(c)).fold(f64::NEG_INFINITY, f64::max);
    match (via.how, subject(1)) {
        (Pass::Between, Some(second)) => {
            let at = first.center.lerp(second.center, lerp((0.3, 0.7), context.parameters[0]));
            let floor = frame.height(world.bounds.core_min).min(frame.height(world.bounds.core_max));
            let high = top(&first.corners).max(top(&second.corners));
            let height = lerp((0.35, 1.05), context.parameters[1]) * (high - floor) + floor;
            Some(frame.horizontal(at) + frame.up * height)
        }
        (Pass::Over, _) => {
            let rise = top(&first.corners) - frame.height(first.center);
            let over = rise + world.camera_radius * 2.0 + lerp((0.05, 0.7), context.parameters[1]) * first.radius;
            Some(first.center + frame.up * over)
        }
        _ => None,
    }
}

/// The camera before it passes the gate, on the side of the gate away from the goal.
fn before_gate(context: &StepContext, gate: DVec3, goal: Option<&Target>) -> CameraState {
    let world = context.world;
    let frame = &world.frame;
    let size = world.bounds.size();
    let heading = match goal {
        Some(goal) => frame.azimuth(goal.aim - gate),
        None => context.parameters[2] * std::f64::consts::TAU,
    };
    let heading = heading + (context.parameters[2] - 0.5) * 1.2;
    let back = lerp((0.08, 0.4), context.parameters[3]) * size;
    let rise = (context.parameters[4] - 0.4) * 0.15 * size;
    let position = gate - frame.direction(heading) * back + frame.up * rise;
    let fov_y_rad = lerp((40.0, 58.0), context.parameters[5]).to_radians();
    let state =
        CameraState { pose: Pose { position, rotation: glam::DQuat::IDENTITY }, fov_y_rad, focus_distance: None };
    aimed(world, &state, goal.map_or(gate, |goal| goal.aim))
}

/// Starts with the subject outside the frame and brings it into view.
pub(super) fn reveal(context: &StepContext) -> Vec<MotionSegment> {
    let target = context.main_target();
    let last = match &context.before {
        Some(before) => end_view(context, &target, before),
        None => context.view(&target, &context.step.end, (0.4, 0.7), NORMAL_LENS_DEG),
    };
    let first = match &context.before {
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
    let half_width = half_height * DEFAULT_ASPECT;
    let (right, up) = (last.pose.right(), context.world.frame.up);
    let aside = right * (half_width * 1.05 + target.radius);
    let aloft = up * (half_height * 1.05 + target.radius);
    match context.step.with {
        Some(Move::TruckRight | Move::PanRight | Move::OrbitRight | Move::ArcRight) => -aside,
        Some(Move::TruckLeft | Move::PanLeft | Move::OrbitLeft | Move::ArcLeft) => aside,
        Some(Move::PedestalUp | Move::CraneUp | Move::TiltUp) => -aloft,
        Some(Move::PedestalDown | Move::CraneDown | Move::TiltDown) => aloft,
        Some(Move::PullOut) => last.pose.forward() * (0.8 * distance) + aside * 0.5,
        _ if context.parameters[5] < 0.5 => -aside,
        _ => aside,
    }
}

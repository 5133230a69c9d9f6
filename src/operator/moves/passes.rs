//! Moves that pass an object through a gate: between two, over or under one, through one.

use glam::DVec3;

use super::context::{NORMAL_LENS_DEG, StepContext, require_visible};
use super::paths::follow;
use crate::constraint::{ConstraintKind, Scope};
use crate::framing::{Target, off_center};
use crate::motion::MotionSegment;
use crate::program::{Pass, Via};
use crate::view::{aimed, lerp, moved};
use cinesplat_geometry::Pose;
use cinesplat_trajectory::{CameraState, Move};

/// Passes a gate, toward the end target: between two objects, over or under one, or through one.
pub(super) fn passing(context: &StepContext) -> Vec<MotionSegment> {
    let Some(gate) = context.step.via.as_ref().and_then(|via| gate(context, via)) else { return follow(context) };
    if let Some(subject) = backward_subject(context) {
        return backward(context, gate, &subject);
    }
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
    let mut segment = context.segment(vec![first, middle, last]);
    if let Some(goal) = goal {
        if off_center(context.world, &first, goal.aim) < 0.5 {
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

/// The subject that a pull-out under or through an object leaves behind.
fn backward_subject(context: &StepContext) -> Option<Target> {
    let how = context.step.via.as_ref().map(|via| via.how)?;
    let backward = context.step.movement == Move::PullOut && matches!(how, Pass::Under | Pass::Through);
    context.start.clone().or_else(|| context.earlier.clone()).filter(|_| backward)
}

/// Travels backward through the gate, aimed at the subject that it leaves.
fn backward(context: &StepContext, gate: DVec3, subject: &Target) -> Vec<MotionSegment> {
    let (mut segments, first) = match &context.before {
        Some(before) => context.turned_to(before, subject.aim),
        None => (Vec::new(), before_leaving(context, gate, subject)),
    };
    let onward = (gate - first.pose.position).normalize_or_zero() * lerp((0.06, 0.3), context.parameters[6]);
    let beyond = gate + onward * context.world.bounds.size();
    let at = |position: DVec3| aimed(context.world, &moved(&first, position - first.pose.position), subject.aim);
    let states = vec![first, at(gate), at(beyond)];
    let segment = context.segment(states);
    let segment = segment
        .about(subject.aim)
        .requiring(Scope::All, ConstraintKind::Centered(subject.clone(), 0.17))
        .requiring(Scope::All, ConstraintKind::DistanceRatio(subject.aim, (1.32, f64::INFINITY)));
    let segment = require_visible(segment, subject, Scope::Start);
    segments.push(context.constrained_at_end(context.constrained_at_start(segment)));
    segments
}

/// A camera between the subject and the gate, aimed at the subject.
fn before_leaving(context: &StepContext, gate: DVec3, subject: &Target) -> CameraState {
    let to_gate = gate - subject.aim;
    let near = lerp((0.3, 0.8), context.parameters[3]);
    let beside = context.world.frame.up * (context.parameters[4] - 0.4) * 0.3 * to_gate.length();
    let fov_y_rad = lerp(NORMAL_LENS_DEG, context.parameters[5]).to_radians();
    let pose = Pose { position: subject.aim + to_gate * near + beside, rotation: glam::DQuat::IDENTITY };
    aimed(context.world, &CameraState { pose, fov_y_rad, focus_distance: None }, subject.aim)
}

/// The point to pass through: on the line between two objects, above or below one, or inside one.
pub(super) fn gate(context: &StepContext, via: &Via) -> Option<DVec3> {
    let world = context.world;
    let frame = &world.frame;
    let subject = |i: usize| via.objects.get(i).and_then(|&id| world.subject(id));
    let first = subject(0)?;
    let top = |corners: &[DVec3]| corners.iter().map(|&c| frame.height(c)).fold(f64::NEG_INFINITY, f64::max);
    match (via.how, subject(1)) {
        (Pass::Between, Some(second)) => {
            let at = first.center.lerp(second.center, lerp((0.3, 0.7), context.parameters[0]));
            let floor = world.floor_height();
            let high = top(&first.corners).max(top(&second.corners));
            let height = lerp((0.35, 1.05), context.parameters[1]) * (high - floor) + floor;
            Some(frame.horizontal(at) + frame.up * height)
        }
        (Pass::Over, _) => {
            let rise = top(&first.corners) - frame.height(first.center);
            let over = rise + world.camera_radius * 2.0 + lerp((0.05, 0.7), context.parameters[1]) * first.radius;
            Some(first.center + frame.up * over)
        }
        (Pass::Under, _) => {
            let bottom = world.height_above_floor(first.center) - first.reach(frame.up);
            let room = (bottom - 2.0 * world.camera_radius).max(0.0);
            // The camera's ball fits between floor and object; higher gates are tried as well as lower ones.
            let height = world.camera_radius + lerp((0.1, 1.0), context.parameters[1]) * room;
            Some(first.center + frame.up * (height - world.height_above_floor(first.center)))
        }
        (Pass::Through, _) | (Pass::Between, None) if through_one(via) => {
            let [across, _] = first.level_axes(frame.up);
            let rise = first.half_axes[first.axis_along(frame.up)];
            let off = |parameter: f64| (parameter - 0.5) * 1.5;
            Some(first.center + across * off(context.parameters[0]) + rise * off(context.parameters[1]))
        }
        _ => None,
    }
}

/// Whether the camera passes through a single object: the opening is searched in the middle plane of its box, across
/// the shorter horizontal axis.
fn through_one(via: &Via) -> bool {
    via.how == Pass::Through || (via.how == Pass::Between && via.objects.len() == 1)
}

/// Azimuth of the way through an object: along the shorter horizontal axis of its box, to the goal's side.
fn way_through(context: &StepContext, goal: Option<&Target>) -> Option<f64> {
    let via = context.step.via.as_ref().filter(|via| through_one(via))?;
    let subject = context.world.subject(*via.objects.first()?)?;
    let [_, short] = subject.level_axes(context.world.frame.up);
    let ahead = goal.map_or(context.parameters[2] - 0.5, |goal| (goal.aim - subject.center).dot(short));
    Some(context.world.frame.azimuth(if ahead < 0.0 { -short } else { short }))
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
    let heading = way_through(context, goal).unwrap_or(heading + (context.parameters[2] - 0.5) * 1.2);
    let back = lerp((0.08, 0.4), context.parameters[3]) * size;
    let rise = (context.parameters[4] - 0.4) * 0.15 * size;
    let position = gate - frame.direction(heading) * back + frame.up * rise;
    let fov_y_rad = lerp((40.0, 58.0), context.parameters[5]).to_radians();
    let state =
        CameraState { pose: Pose { position, rotation: glam::DQuat::IDENTITY }, fov_y_rad, focus_distance: None };
    aimed(world, &state, goal.map_or(gate, |goal| goal.aim))
}

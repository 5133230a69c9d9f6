//! Moves that pass an object through a gate: between two, over or under one, through one.

use glam::DVec3;

use super::context::{NORMAL_LENS_DEG, StepContext, require_visible};
use super::over_shoulder::over_shoulder;
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
    if let Some(segments) = over_shoulder(context) {
        return segments;
    }
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
        None => beyond_gate(context, &first, gate),
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

/// The subject that a pull-out under, through or between objects leaves behind.
fn backward_subject(context: &StepContext) -> Option<Target> {
    let via = context.step.via.as_ref().filter(|_| context.step.movement == Move::PullOut)?;
    let left = || context.start.clone().or_else(|| context.earlier.clone());
    match via.how {
        Pass::Under | Pass::Through => left(),
        // What the words say to look at on the way is left, too.
        Pass::Between if !through_one(via) => left().or_else(|| context.end.clone()),
        _ => None,
    }
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
    let is_between = context.step.via.as_ref().is_some_and(|via| via.how == Pass::Between);
    let segment = require_visible(segment, subject, if is_between { Scope::All } else { Scope::Start });
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
            // At about half the height of both, so that they leave the frame on either side and not below it.
            let [low, high] = [first, second].map(|subject| frame.height(subject.center));
            let reach = first.reach(frame.up).min(second.reach(frame.up));
            let band = (low.min(high) - 0.2 * reach, low.max(high) + 0.7 * reach);
            Some(frame.horizontal(at) + frame.up * lerp(band, context.parameters[1]))
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
        None => across_pair(context).unwrap_or(context.parameters[2] * std::f64::consts::TAU),
    };
    let heading = way_through(context, goal).unwrap_or(heading + (context.parameters[2] - 0.5) * 1.2);
    let back = lerp((0.08, 0.4), context.parameters[3]) * size;
    // Between two things, without a goal behind them, the flight is level.
    let is_level = goal.is_none() && across_pair(context).is_some();
    let rise = if is_level { 0.0 } else { (context.parameters[4] - 0.4) * 0.15 * size };
    let position = gate - frame.direction(heading) * back + frame.up * rise;
    let fov_y_rad = lerp((40.0, 58.0), context.parameters[5]).to_radians();
    let state =
        CameraState { pose: Pose { position, rotation: glam::DQuat::IDENTITY }, fov_y_rad, focus_distance: None };
    aimed(world, &state, goal.map_or(gate, |goal| goal.aim))
}

/// Azimuth of the way between two objects, across the line from one to the other; parameter 4 chooses the side. `None`
/// where the step passes no two.
fn across_pair(context: &StepContext) -> Option<f64> {
    let via = context.step.via.as_ref().filter(|via| via.how == Pass::Between)?;
    let [first, second] = [0, 1].map(|i| via.objects.get(i).and_then(|&id| context.world.subject(id)));
    let line = context.world.frame.horizontal(second?.center - first?.center).try_normalize()?;
    let way = line.cross(context.world.frame.up);
    Some(context.world.frame.azimuth(if context.parameters[4] < 0.5 { way } else { -way }))
}

/// Largest angle between the flight and what the camera looks at behind the gate, and between that and the horizon,
/// radians.
const AHEAD_RAD: f64 = 0.6;
const AHEAD_PITCH_RAD: f64 = 0.25;

/// The camera beyond a gate that nothing is said to lie behind: it looks ahead, at what fills most of the picture there.
fn beyond_gate(context: &StepContext, first: &CameraState, gate: DVec3) -> CameraState {
    let world = context.world;
    let way = gate - first.pose.position;
    let onward = lerp((0.5, 1.1), context.parameters[6]);
    let last = moved(first, way * (1.0 + onward));
    let eye = last.pose.position;
    let is_ahead = |center: DVec3| {
        let to = center - eye;
        let level = world.frame.horizontal(to);
        level.angle_between(way) < AHEAD_RAD && world.frame.height(to).atan2(level.length()).abs() < AHEAD_PITCH_RAD
    };
    let size = |center: DVec3, radius: f64| (radius / center.distance(eye)).min(0.4);
    let passed = context.step.via.as_ref().map(|via| via.objects.clone()).unwrap_or_default();
    let is_passed = |center: DVec3| passed.iter().any(|&id| world.subject(id).is_some_and(|s| s.center == center));
    let things = world.things.iter().filter(|thing| is_ahead(thing.center) && !is_passed(thing.center));
    let seen = things.filter(|thing| {
        let to = thing.center - eye;
        world.hit_distance(eye, to.normalize_or_zero()).is_some_and(|hit| hit > to.length() - 1.3 * thing.radius)
    });
    let best = seen.max_by(|a, b| size(a.center, a.radius).total_cmp(&size(b.center, b.radius)));
    best.map_or(last, |thing| aimed(world, &last, thing.center))
}

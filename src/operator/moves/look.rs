//! What the camera looks at while it travels.
//!
//! The positions of a move stay as they are; every camera on the path turns to the look target. A look at a point is
//! exact at every moment ([`MotionSegment::about`]). A look along the path follows its tangent at nine and more keys, and
//! turns to the end framing on the last part of the path, where the step has one; on a path straight up or down it is no
//! look of its own, and the camera keeps to what the move looks at.

use glam::{DQuat, DVec3};

use super::context::StepContext;
use crate::constraint::{AHEAD_FRAC, Constraint, ConstraintKind, Scope};
use crate::cost::evenly_spaced;
use crate::framing::Target;
use crate::motion::MotionSegment;
use crate::program::{Framing, Look};
use crate::view::aimed;
use cinesplat_geometry::{Pose, rotation};
use cinesplat_trajectory::CameraState;

/// Keys of a path along which the camera looks.
const NUM_KEYS: usize = 9;
/// Largest distance of the look target from the frame's middle.
const OFF_CENTER: f64 = 0.08;
/// Sine of the steepest path along which the camera looks, 70 degrees.
const STEEP_SIN: f64 = 0.94;
/// Largest angle between the view axis and the path, degrees.
const OFF_PATH_DEG: f64 = 15.0;

/// Turns the cameras of the step's own motion to what the step looks at.
pub(super) fn look(context: &StepContext, segments: &mut [MotionSegment]) {
    let Some(look) = &context.step.look else { return };
    let Some(segment) = segments.iter_mut().rev().find(|segment| !segment.is_join) else { return };
    turn_to(context, look, segment);
}

fn turn_to(context: &StepContext, look: &Look, segment: &mut MotionSegment) {
    match look {
        Look::At(ids) => {
            let framing = Framing { subjects: ids.clone(), whole: ids.len() > 1, ..Framing::default() };
            if let Some(target) = Target::of(context.world, &framing) {
                look_at(context, segment, target.aim, named(context, ids));
            }
        }
        Look::Room => look_at(context, segment, context.world.bounds.center(), "the middle of the scene".to_owned()),
        Look::Ahead => look_along(context, segment, 1.0),
        Look::Back => look_along(context, segment, -1.0),
    }
}

fn named(context: &StepContext, ids: &[u32]) -> String {
    let name = |&id: &u32| context.world.subject(id).map_or_else(|| format!("<obj-{id}>"), |s| s.label.clone());
    ids.iter().map(name).collect::<Vec<_>>().join(", ")
}

fn look_at(context: &StepContext, segment: &mut MotionSegment, point: DVec3, name: String) {
    for state in &mut segment.states {
        *state = aimed(context.world, state, point);
    }
    if !segment.movement.is_circular() {
        segment.pivot = Some(point);
    }
    free_the_view(segment, None);
    let kind = ConstraintKind::LookAt(point, name, OFF_CENTER);
    segment.constraints.push(Constraint { kind, scope: Scope::All });
}

fn look_along(context: &StepContext, segment: &mut MotionSegment, sign: f64) {
    if sign > 0.0 && is_vertical(context, segment) {
        return;
    }
    if segment.states.len() < NUM_KEYS {
        segment.states = evenly_spaced(context.world, segment, NUM_KEYS);
    }
    let goal = (sign > 0.0 && !segment.movement.is_circular()).then(|| context.end.clone()).flatten();
    let count = segment.states.len() - 1;
    let tangents: Vec<Option<DVec3>> = (0..=count).map(|i| tangent(&segment.states, i)).collect();
    let up = context.world.frame.up;
    for (i, tangent) in tangents.into_iter().enumerate() {
        let state = segment.states[i];
        let Some(tangent) = tangent else { continue };
        let along = Pose::facing(state.pose.position, tangent * sign, up, Some(state.pose.right())).rotation;
        let share = i as f64 / count as f64;
        segment.states[i].pose.rotation = match &goal {
            Some(goal) => toward(along, aimed(context.world, &state, goal.aim).pose.rotation, share),
            None => along,
        };
    }
    if !segment.movement.is_circular() {
        segment.pivot = None;
    }
    free_the_view(segment, goal.as_ref());
    let kind = ConstraintKind::LookAlong(sign, OFF_PATH_DEG);
    segment.constraints.push(Constraint { kind, scope: Scope::All });
}

/// Whether a path leads straight up or down. Somebody who rises with the eyes ahead does not look at the sky.
fn is_vertical(context: &StepContext, segment: &MotionSegment) -> bool {
    let ways = || segment.states.windows(2).map(|pair| pair[1].pose.position - pair[0].pose.position);
    let (length, height): (f64, f64) =
        (ways().map(DVec3::length).sum(), ways().map(|way| way.dot(context.world.frame.up).abs()).sum());
    length > 1e-6 * context.world.bounds.size() && height > STEEP_SIN * length
}

/// From the look along the path to the end framing, on the part of the way after [`AHEAD_FRAC`].
fn toward(along: DQuat, goal: DQuat, share: f64) -> DQuat {
    let t = ((share - AHEAD_FRAC) / (1.0 - AHEAD_FRAC)).clamp(0.0, 1.0);
    rotation::slerp(along, goal, t * t * (3.0 - 2.0 * t))
}

/// Unit direction of travel at a state; `None` where the camera stands still.
fn tangent(states: &[CameraState], i: usize) -> Option<DVec3> {
    let at = |i: usize| states[i].pose.position;
    let last = states.len() - 1;
    match i {
        0 if last > 1 => ((at(1) - at(0)) * 4.0 - (at(2) - at(0))).try_normalize(),
        0 => (at(1) - at(0)).try_normalize(),
        i if i == last && last > 1 => ((at(i) - at(i - 1)) * 4.0 - (at(i) - at(i - 2))).try_normalize(),
        i if i == last => (at(i) - at(i - 1)).try_normalize(),
        i => (at(i + 1) - at(i - 1)).try_normalize(),
    }
}

/// Drops the constraints that a look elsewhere contradicts: subjects in the frame, and the turns of the move itself. Those
/// on `goal` at the end stay.
fn free_the_view(segment: &mut MotionSegment, goal: Option<&Target>) {
    let keeps_goal = |constraint: &Constraint| constraint.scope == Scope::End && goal.is_some();
    let contradicts = |kind: &ConstraintKind| {
        matches!(
            kind,
            ConstraintKind::Centered(..)
                | ConstraintKind::OnThird(_)
                | ConstraintKind::Unoccluded(..)
                | ConstraintKind::InFrame(..)
                | ConstraintKind::NotWhole(..)
                | ConstraintKind::Height(..)
                | ConstraintKind::Pitch(_)
                | ConstraintKind::YawChange(_)
                | ConstraintKind::PitchChange(_)
                | ConstraintKind::Travel(..)
        )
    };
    segment.constraints.retain(|constraint| keeps_goal(constraint) || !contradicts(&constraint.kind));
}

//! What the framing of a segment's ends is worth: subjects that the edge of the frame cuts, and turns that hardly show.

use glam::DVec3;

use super::constraint::{Constraint, ConstraintKind, Scope};
use super::framing::{extent_frac, frame_position, in_frame_frac};
use super::motion::MotionSegment;
use super::world::World;
use cinesplat_trajectory::{CameraState, Move};

/// Cost of a subject that is wholly out of the frame at an end, over what of it is cut.
const CUT_COST: f64 = 1.4;
/// Height in the frame from which a stated size cuts its subject: that of a medium close-up.
const CUTTING_HEIGHT: f64 = 0.8;
/// Radius of a subject over the scene size from which it is part of the room, and no picture has to hold it.
const LARGE_FRAC: f64 = 0.22;
/// Margin of the frame, over its size, within which a subject touches the edge.
const EDGE: f64 = 0.01;
/// Cost of a turn from one subject to another that does not change the picture.
const SHORT_TURN_COST: f64 = 0.9;
/// Angle of such a turn over the field of view from which on it costs nothing.
const LEAST_TURN: f64 = 0.55;
/// Cost of a pull-out whose lens widens at all: nearly that of a violated constraint.
const WIDENED_COST: f64 = 2.5;

/// Cost of the framing at the ends of a segment.
pub(super) fn framing_cost(world: &World, segment: &MotionSegment, states: &[CameraState]) -> f64 {
    let turned = short_turn_cost(world, segment, states);
    let sized = cut_cost(world, segment, states) + small_cost(world, segment, states);
    sized + turned + widened_cost(segment) + approach_cost(segment, states)
}

/// Size of a subject in the frame, the larger of its shares of width and height, below which it is small in the best
/// picture of it; and what a speck costs.
const LEAST_FIT: f64 = 0.42;
const SMALL_COST: f64 = 1.1;

/// Cost of a subject that is small in every picture that is about it, where the words state no size.
fn small_cost(world: &World, segment: &MotionSegment, states: &[CameraState]) -> f64 {
    if segment.is_join {
        return 0.0;
    }
    let ends = [(Scope::Start, &states[0]), (Scope::End, &states[states.len() - 1])];
    let small = |constraint: &Constraint| {
        let ConstraintKind::Unoccluded(id, _) = constraint.kind else { return 0.0 };
        let Some(subject) = world.subject(id) else { return 0.0 };
        let about = ends.iter().filter(|(scope, _)| constraint.scope.covers(*scope));
        if about.clone().any(|(scope, _)| is_sized(&segment.constraints, id, *scope)) {
            return 0.0;
        }
        let largest = about.map(|(_, state)| extent_frac(world, state, &subject.corners).max_element());
        (1.0 - largest.fold(0.0, f64::max) / LEAST_FIT).max(0.0)
    };
    SMALL_COST * segment.constraints.iter().map(small).fold(0.0, f64::max)
}

/// Whether the words state how large a subject is, or what else the picture has to hold.
fn is_sized(constraints: &[Constraint], id: u32, scope: Scope) -> bool {
    let states_size = |constraint: &Constraint| match &constraint.kind {
        ConstraintKind::Height(target, _) | ConstraintKind::Distance(target, _) => target.ids.contains(&id),
        ConstraintKind::InFrame(..) | ConstraintKind::FieldOfView(_) => true,
        _ => false,
    };
    constraints.iter().any(|constraint| constraint.scope.covers(scope) && states_size(constraint))
}

/// Cost of a way to a thing that ends farther from it than it begins, and the factor on the distance at which it costs as
/// much.
const APPROACH_COST: f64 = 1.0;
const FAR_RETREAT: f64 = 1.4;

/// Cost of a walk to a thing that leads away from it: `stroll over to the armchair` ends at the armchair.
fn approach_cost(segment: &MotionSegment, states: &[CameraState]) -> f64 {
    if segment.movement != Move::Follow || segment.is_join {
        return 0.0;
    }
    let sized = |constraint: &Constraint| {
        let states_size = matches!(constraint.kind, ConstraintKind::Height(..) | ConstraintKind::Distance(..));
        constraint.scope.covers(Scope::End) && states_size
    };
    let goal = segment.constraints.iter().find_map(|constraint| match &constraint.kind {
        ConstraintKind::Centered(goal, _) if constraint.scope == Scope::End => Some(goal),
        _ => None,
    });
    let Some(goal) = goal.filter(|_| !segment.constraints.iter().any(sized)) else { return 0.0 };
    let distance = |state: &CameraState| state.pose.position.distance(goal.aim).max(1e-9);
    let retreat = distance(&states[states.len() - 1]) / distance(&states[0]);
    APPROACH_COST * (retreat.ln() / FAR_RETREAT.ln()).clamp(0.0, 1.0)
}

/// Cost of a pull-out that widens its lens because the room ends behind the camera: as one that stays in the room by
/// itself is better.
fn widened_cost(segment: &MotionSegment) -> f64 {
    let tan = |state: &CameraState| (state.fov_y_rad / 2.0).tan();
    let widened = (tan(&segment.last()) / tan(&segment.states[0])).ln();
    let is_stated =
        segment.constraints.iter().any(|constraint| matches!(constraint.kind, ConstraintKind::FieldOfView(_)));
    if !is_stated && segment.movement == Move::PullOut && widened > 0.01 { WIDENED_COST + widened } else { 0.0 }
}

/// Cost of a subject that is cut by the edge of the frame at an end for which the words state no size that cuts it.
fn cut_cost(world: &World, segment: &MotionSegment, states: &[CameraState]) -> f64 {
    // A tilt and a rise go along what does not fit the picture.
    if matches!(segment.movement, Move::TiltUp | Move::TiltDown | Move::PedestalUp | Move::PedestalDown) {
        return 0.0;
    }
    let middle = &states[states.len() / 2];
    let ends = [(Scope::Start, &states[0]), (Scope::All, middle), (Scope::End, &states[states.len() - 1])];
    let cut_at = |constraint: &Constraint| {
        let ConstraintKind::Unoccluded(id, _) = constraint.kind else { return 0.0 };
        let Some(subject) = world.subject(id) else { return 0.0 };
        if world.is_indoor() && subject.radius > LARGE_FRAC * world.bounds.size() {
            return 0.0;
        }
        let holds = |(scope, _): &&(Scope, &CameraState)| {
            constraint.scope.covers(*scope) && !is_to_be_cut(&segment.constraints, id, *scope)
        };
        let cut = |(_, state): &(Scope, &CameraState)| {
            let beyond = 1.0 - in_frame_frac(world, state, &subject.points, EDGE);
            CUT_COST * beyond + shaved_cost(world, state, &subject.points)
        };
        ends.iter().filter(holds).map(cut).fold(0.0, f64::max)
    };
    segment.constraints.iter().map(cut_at).fold(0.0, f64::max)
}

/// Cost of a subject whose chin or feet the frame shaves while there is room on the other side, and the room, over the
/// frame's height, from which on it costs as much.
const SHAVED_COST: f64 = 0.8;
const SPARE_ROOM: f64 = 0.08;
/// Margin above and below a subject that leaves it untouched, over the frame's height.
const HEADROOM: f64 = 0.025;

/// Cost of a subject that touches the upper or the lower edge while it is away from the other one.
fn shaved_cost(world: &World, state: &CameraState, points: &[DVec3]) -> f64 {
    let heights = points.iter().filter_map(|&point| frame_position(world, state, point)).map(|(at, _)| at.y);
    let (low, high) = heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), y| (low.min(y), high.max(y)));
    let (below, above) = (low + 0.5 - HEADROOM, 0.5 - HEADROOM - high);
    let (least, most) = (below.min(above), below.max(above));
    if least >= 0.0 || most <= 0.0 { 0.0 } else { SHAVED_COST * (most.min(-2.0 * least) / SPARE_ROOM).min(1.0) }
}

/// Whether the words ask for a picture that a subject does not fit in.
fn is_to_be_cut(constraints: &[Constraint], id: u32, scope: Scope) -> bool {
    let cuts = |constraint: &Constraint| match &constraint.kind {
        ConstraintKind::Height(target, (low, _)) => target.ids.contains(&id) && *low >= CUTTING_HEIGHT,
        ConstraintKind::NotWhole(ids, _) => ids.contains(&id),
        ConstraintKind::Distance(target, _) => target.ids.contains(&id),
        _ => false,
    };
    constraints.iter().any(|constraint| constraint.scope.covers(scope) && cuts(constraint))
}

/// Cost of a pan between two subjects that are in the frame together from its start to its end.
fn short_turn_cost(world: &World, segment: &MotionSegment, states: &[CameraState]) -> f64 {
    if !matches!(segment.movement, Move::PanLeft | Move::PanRight | Move::WhipPan) {
        return 0.0;
    }
    let seen_at = |wanted: Scope| {
        segment.constraints.iter().find_map(move |constraint| match constraint.kind {
            ConstraintKind::Unoccluded(id, _) if constraint.scope == wanted => Some(id),
            _ => None,
        })
    };
    if seen_at(Scope::Start).is_none() || seen_at(Scope::Start) == seen_at(Scope::End) {
        return 0.0;
    }
    let (first, last) = (&states[0], &states[states.len() - 1]);
    let turn_rad = first.pose.forward().angle_between(last.pose.forward());
    let field_rad = 2.0 * ((first.fov_y_rad / 2.0).tan() * world.aspect.max(1.0)).atan();
    SHORT_TURN_COST * (1.0 - turn_rad / (LEAST_TURN * field_rad)).max(0.0)
}

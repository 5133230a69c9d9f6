//! What the sides of a subject show: a vase that was captured from the front only is a shell from behind, and the back of
//! a guitar is plain wood.

use cinesplat_geometry::rotation;

use super::constraint::Constraint;
use super::world::{Subject, World};
use cinesplat_trajectory::CameraState;

/// Share of a subject's surface that faces the camera below which its captured side faces away. A closed thing shows
/// about half of its surface from anywhere.
const LEAST_FRONT: f64 = 0.3;
/// Cost of a subject whose captured side faces away altogether: less than that of a violated constraint.
const BACK_COST: f64 = 2.0;

/// Angle from the middle of the front up to which a side of a lone thing costs nothing: a three-quarter view.
const FRONT_RAD: f64 = 0.5;
/// Cost of the back of a lone thing: more than all that pictures cost together, and less than a violated constraint.
const OFF_FRONT_COST: f64 = 2.8;

/// Cost of the sides from which cameras see the subjects that have to be visible.
pub(super) fn side_cost(world: &World, constraints: &[Constraint], states: &[CameraState]) -> f64 {
    let ends = [states[0], states[states.len() / 2], states[states.len() - 1]];
    [back_cost, edge_cost, off_front_cost].map(|cost| cost(world, constraints, &ends)).into_iter().sum()
}

/// The subject that has to be visible, where its front is not known. Facets tell the outer sides of closed things alone: the
/// surface of a chair's back that faces its seat lies behind the chair's middle, and counts as turned away from the front.
fn unfaced<'a>(world: &'a World, constraint: &Constraint) -> Option<&'a Subject> {
    constraint.shown(world).filter(|subject| subject.front_rad.is_none())
}

/// Breadth of a subject below which it is seen edge-on, and the cost of seeing nothing but its edge.
const LEAST_BREADTH: f64 = 0.55;
const EDGE_COST: f64 = 1.6;

/// Cost of cameras that see a flat subject edge-on, where it has to be visible: a picture on a wall from beside it.
fn edge_cost(world: &World, constraints: &[Constraint], ends: &[CameraState]) -> f64 {
    let edge_of = |constraint: &Constraint| {
        let Some(subject) = unfaced(world, constraint) else { return 0.0 };
        let picked = constraint.scope.of(ends);
        let breadth = |state: &CameraState| subject.facets.breadth(subject.center, state.pose.position, world.frame.up);
        let lack = picked.iter().filter_map(breadth).map(|breadth| (1.0 - breadth / LEAST_BREADTH).max(0.0));
        lack.sum::<f64>() / picked.len().max(1) as f64
    };
    EDGE_COST * constraints.iter().map(edge_of).fold(0.0, f64::max)
}

/// Cost of cameras that see a subject, where it has to be visible, from the side that was not captured.
fn back_cost(world: &World, constraints: &[Constraint], ends: &[CameraState]) -> f64 {
    let front_of = |constraint: &Constraint| {
        let Some(subject) = unfaced(world, constraint) else { return 1.0 };
        let picked = constraint.scope.of(ends).iter();
        picked.filter_map(|state| subject.facets.front_frac(state.pose.position)).fold(1.0, f64::min)
    };
    let front = constraints.iter().map(front_of).fold(1.0, f64::min);
    BACK_COST * (1.0 - front / LEAST_FRONT).max(0.0)
}

/// Cost of showing a thing that has a front from elsewhere: nothing else tells which side to show.
fn off_front_cost(world: &World, constraints: &[Constraint], ends: &[CameraState]) -> f64 {
    let faced = |subject: &Subject| Some((subject.center, subject.front_rad?));
    let mut shown = constraints.iter().filter_map(|constraint| constraint.shown(world)).peekable();
    // A film of nothing that has a name is one of the thing that there is.
    let of_all = world.front_rad.filter(|_| shown.peek().is_none()).map(|front_rad| (world.bounds.center(), front_rad));
    let front = shown.find_map(faced).or(of_all);
    let Some((center, front_rad)) = front else { return 0.0 };
    let off = |state: &CameraState| {
        let azimuth = world.frame.azimuth(state.pose.position - center);
        let off_rad = rotation::short_turn(azimuth - front_rad).abs();
        ((off_rad - FRONT_RAD) / (std::f64::consts::PI - FRONT_RAD)).max(0.0)
    };
    OFF_FRONT_COST * ends.iter().map(off).sum::<f64>() / ends.len() as f64
}

//! What the sides of a subject show: a vase that was captured from the front only is a shell from behind, and the back of
//! a guitar is plain wood.

use cinesplat_geometry::rotation;

use super::constraint::{Constraint, ConstraintKind};
use super::world::World;
use cinesplat_trajectory::CameraState;

/// Share of a subject's surface that faces the camera below which its captured side faces away. A closed thing shows
/// about half of its surface from anywhere.
const LEAST_FRONT: f64 = 0.3;
/// Cost of a subject whose captured side faces away altogether: less than that of a violated constraint.
const BACK_COST: f64 = 2.0;

/// Angle from the middle of the front up to which a side of a lone thing costs nothing.
const FRONT_RAD: f64 = 0.9;
/// Cost of the back of a lone thing.
const OFF_FRONT_COST: f64 = 1.0;

/// Cost of cameras that see a subject, where it has to be visible, from the side that was not captured.
pub(super) fn back_cost(world: &World, constraints: &[Constraint], states: &[CameraState]) -> f64 {
    let ends = [states[0], states[states.len() / 2], states[states.len() - 1]];
    let front_of = |constraint: &Constraint| {
        let ConstraintKind::Unoccluded(id, _) = constraint.kind else { return 1.0 };
        let Some(subject) = world.subject(id) else { return 1.0 };
        let picked = constraint.scope.of(&ends).iter();
        picked.filter_map(|state| subject.facets.front_frac(state.pose.position)).fold(1.0, f64::min)
    };
    let front = constraints.iter().map(front_of).fold(1.0, f64::min);
    BACK_COST * (1.0 - front / LEAST_FRONT).max(0.0)
}

/// Cost of showing a thing that has a front from elsewhere: nothing else tells which side to show.
pub(super) fn off_front_cost(world: &World, constraints: &[Constraint], states: &[CameraState]) -> f64 {
    let ends = [states[0], states[states.len() / 2], states[states.len() - 1]];
    let front = constraints.iter().find_map(|constraint| match constraint.kind {
        ConstraintKind::Unoccluded(id, _) => {
            world.subject(id).and_then(|subject| Some((subject.center, subject.front_rad?)))
        }
        _ => None,
    });
    let Some((center, front_rad)) = front else { return 0.0 };
    let off = |state: &CameraState| {
        let azimuth = world.frame.azimuth(state.pose.position - center);
        let off_rad = rotation::short_turn(azimuth - front_rad).abs();
        ((off_rad - FRONT_RAD) / (std::f64::consts::PI - FRONT_RAD)).max(0.0)
    };
    OFF_FRONT_COST * ends.iter().map(off).sum::<f64>() / ends.len() as f64
}

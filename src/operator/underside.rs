//! Cameras below what things stand on: of a table nobody wants to see the underside.

use super::constraint::{Constraint, ConstraintKind};
use super::pictures::asks_low;
use super::program::Pass;
use super::world::World;
use cinesplat_trajectory::CameraState;

/// Slope of the view down on a surface, height over level distance, from which on it costs nothing.
const LEAST_SLOPE: f64 = 0.16;
/// Cost of a camera at the height of the surface or below it: less than that of a violated constraint.
const BELOW_COST: f64 = 2.2;

/// Cost of cameras that see things which other things stand on from the height of their surface or from below, where
/// nothing asks for it.
pub(super) fn underside_cost(world: &World, constraints: &[Constraint], states: &[CameraState]) -> f64 {
    if constraints.iter().any(|constraint| asks_low(&constraint.kind)) {
        return 0.0;
    }
    let ends = [states[0], states[states.len() / 2], states[states.len() - 1]];
    let below = |constraint: &Constraint| {
        let along = match constraint.kind {
            ConstraintKind::Passed(Pass::Along, id) => world.subject(id),
            _ => None,
        };
        let Some(subject) = constraint.shown(world).or(along) else { return 0.0 };
        let Some([surface, _]) = subject.borne_heights else { return 0.0 };
        let lack = |state: &CameraState| {
            let eye = state.pose.position;
            let level = world.frame.horizontal(eye - subject.center).length().max(1e-9);
            (1.0 - (world.frame.height(eye) - surface) / (LEAST_SLOPE * level)).clamp(0.0, 1.0)
        };
        constraint.scope.of(&ends).iter().map(lack).fold(0.0, f64::max)
    };
    BELOW_COST * constraints.iter().map(below).fold(0.0, f64::max)
}

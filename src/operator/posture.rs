//! How a camera stands in a room: people film rooms from about the height of their eyes with a level lens, so that walls
//! and shelves stay upright.

use super::composition::natural_elevation_deg;
use super::constraint::{Constraint, ConstraintKind};
use super::framing::Target;
use super::motion::{Angle, MotionSegment};
use super::program::{Framing, Pass};
use super::view::ramp;
use super::world::World;
use cinesplat_trajectory::{CameraState, Move};

/// Cost of a camera above the eyes of a standing person, and the height over theirs at which it begins and is reached.
const HIGH_COST: f64 = 0.9;
const HIGH: (f64, f64) = (1.06, 1.45);
/// Cost of uprights that lean, that in a pan, and the slope of those at the frame's side edges at which it begins and is reached.
const LEAN_COST: f64 = 0.9;
const PAN_LEAN_COST: f64 = 0.4;
const LEAN: (f64, f64) = (0.12, 0.36);
/// Elevation from which people see what lies flat or bears other things, degrees: from there on nobody minds uprights.
const LOOKED_DOWN_DEG: f64 = 26.0;

/// Cost of high places and of leaning uprights at the ends and in the middle of a segment, where no words ask for either.
pub(super) fn posture_cost(world: &World, segment: &MotionSegment, states: &[CameraState]) -> f64 {
    let rises = matches!(
        segment.movement,
        Move::CraneUp
            | Move::CraneDown
            | Move::PedestalUp
            | Move::PedestalDown
            | Move::TiltUp
            | Move::TiltDown
            | Move::FlyThrough
    );
    let is_asked = |constraint: &Constraint| asks_for_height(&constraint.kind);
    if !world.is_indoor()
        || segment.is_join
        || segment.angle == Angle::Stated
        || rises
        || segment.constraints.iter().any(is_asked)
    {
        return 0.0;
    }
    let shown = || segment.constraints.iter().filter_map(|constraint| constraint.shown(world));
    // What hangs high is filmed from its own height.
    let top = shown().map(|subject| world.height_above_floor(subject.center)).fold(world.eye_height(), f64::max);
    let ends = [&states[0], &states[states.len() / 2], &states[states.len() - 1]];
    let worst = |of: &dyn Fn(&CameraState) -> f64| ends.iter().map(|state| of(state)).fold(0.0, f64::max);
    let high = worst(&|state| ramp(HIGH, world.height_above_floor(state.pose.position) / top));
    let lean = worst(&|state| ramp(LEAN, lean(world, state)));
    // A view of a room as a whole looks down a little: its floor is worth more than its ceiling. A pan has one pitch for
    // things of different heights.
    let pans = matches!(segment.movement, Move::PanLeft | Move::PanRight | Move::WhipPan);
    let may_lean = || shown().next().is_none() || segment.constraints.iter().any(|c| is_looked_down_on(world, c));
    let lean_cost = if pans { PAN_LEAN_COST } else { LEAN_COST };
    HIGH_COST * high + if lean <= 0.0 || may_lean() { 0.0 } else { lean_cost * lean }
}

/// Whether a constraint wants a subject to be visible that people look down on.
fn is_looked_down_on(world: &World, constraint: &Constraint) -> bool {
    let ConstraintKind::Unoccluded(id, _) = constraint.kind else { return false };
    let target = Target::of(world, &Framing { subjects: vec![id], ..Framing::default() });
    target.is_some_and(|target| natural_elevation_deg(world, &target).1 >= LOOKED_DOWN_DEG)
}

/// Slope of the projection of an upright at the frame's side edges: half the width on the plane at depth 1, by the tangent of
/// the pitch.
fn lean(world: &World, state: &CameraState) -> f64 {
    let pitch_rad = world.frame.angles(state.pose.rotation).pitch_rad;
    (state.fov_y_rad / 2.0).tan() * world.aspect.max(1.0) * pitch_rad.abs().min(1.4).tan()
}

fn asks_for_height(kind: &ConstraintKind) -> bool {
    matches!(
        kind,
        ConstraintKind::Pitch(_)
            | ConstraintKind::Elevation(..)
            | ConstraintKind::CameraHeight(_)
            | ConstraintKind::Placed(..)
            | ConstraintKind::Passed(Pass::Over | Pass::Under | Pass::Through, _)
    )
}

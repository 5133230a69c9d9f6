//! How much of a motion a stretch of film contains, for motions that a prompt forbids.

use super::program::Motion;
use super::world::World;
use cinesplat_geometry::rotation;
use cinesplat_trajectory::CameraState;

/// Largest change of an angle that counts as none, degrees.
const STILL_DEG: f64 = 0.5;
/// Largest change of the tangent of half the field of view that counts as none, over itself.
const STILL_LENS: f64 = 0.005;
/// Largest travel that counts as none, over the scene size.
const STILL_FRAC: f64 = 0.001;

/// The amount of a motion in samples of one take: the measured value, the largest value that counts as none, and a clear
/// excess. Shake and cuts, which belong to the program and not to a take, measure 0.
///
/// - `Zoom`: largest over least tangent of half the field of view, minus 1.
/// - `Pan`, `Tilt`, `Roll`: range of the yaw, pitch, roll, degrees; `Turn`: the largest of the three.
/// - `Rise`: range of the height, scene units.
/// - `Travel`: largest distance from the first position, scene units.
pub(super) fn excess(world: &World, motion: Motion, states: &[CameraState]) -> (f64, f64, f64) {
    let frame = &world.frame;
    let range = |of: &dyn Fn(&CameraState) -> f64| angle_range_deg(states.iter().map(of));
    let yaw = || range(&|s| frame.angles(s.pose.rotation).yaw_rad);
    let pitch = || range(&|s| frame.angles(s.pose.rotation).pitch_rad);
    let roll = || range(&|s| frame.angles(s.pose.rotation).roll_rad);
    match motion {
        Motion::Zoom => (lens_change(states), STILL_LENS, 0.3),
        Motion::Pan => (yaw(), STILL_DEG, 20.0),
        Motion::Tilt => (pitch(), STILL_DEG, 20.0),
        Motion::Roll => (roll(), STILL_DEG, 20.0),
        Motion::Turn => (yaw().max(pitch()).max(roll()), STILL_DEG, 20.0),
        Motion::Travel => {
            let travel = states.iter().map(|s| s.pose.position.distance(states[0].pose.position)).fold(0.0, f64::max);
            (travel, STILL_FRAC * world.bounds.size(), 0.2 * world.bounds.size())
        }
        Motion::Rise => {
            let heights = || states.iter().map(|s| frame.height(s.pose.position));
            let range = heights().fold(f64::NEG_INFINITY, f64::max) - heights().fold(f64::INFINITY, f64::min);
            (range, STILL_FRAC * world.bounds.size(), 0.05 * world.bounds.size())
        }
        Motion::Shake | Motion::Cut => (0.0, 0.5, 1.0),
    }
}

fn lens_change(states: &[CameraState]) -> f64 {
    let tan = |s: &CameraState| (s.fov_y_rad / 2.0).tan();
    let low = states.iter().map(tan).fold(f64::INFINITY, f64::min);
    let high = states.iter().map(tan).fold(0.0, f64::max);
    high / low - 1.0
}

/// Range of an angle along the samples, without jumps of a full turn, degrees.
fn angle_range_deg(angles: impl Iterator<Item = f64>) -> f64 {
    let (mut last, mut at, mut low, mut high) = (None, 0.0_f64, 0.0_f64, 0.0_f64);
    for angle in angles {
        at += last.map_or(0.0, |last| rotation::short_turn(angle - last));
        last = Some(angle);
        low = low.min(at);
        high = high.max(at);
    }
    (high - low).to_degrees()
}

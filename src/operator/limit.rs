//! Limits that a prompt sets for the camera of a whole film, at one camera: how high and how low it may be, and how near to things.

use super::program::{Level, Limit};
use super::world::{Subject, World};
use cinesplat_trajectory::CameraState;

/// Share of a thing's height above which its lower end is so high up that it hangs.
const HANGING_FRAC: f64 = 0.5;

/// The value of a limit at a camera, and its range. Speeds are none of one camera.
pub(super) fn measured(world: &World, limit: &Limit, state: &CameraState) -> (f64, (f64, f64)) {
    let position = state.pose.position;
    let from = |subject: &Subject| {
        let distances = subject.points.iter().map(|point| point.distance(position));
        distances.fold(f64::INFINITY, f64::min)
    };
    let missing = (f64::NAN, (0.0, 0.0));
    match *limit {
        Limit::Above(level) => (world.height_above_floor(position), (level_height(world, level, false), f64::INFINITY)),
        Limit::Below(level) => {
            (world.height_above_floor(position), (f64::NEG_INFINITY, level_height(world, level, true)))
        }
        Limit::Clear(None, units) => {
            let nearest = world.ellipsoids().nearest_within(position, units);
            (nearest.map_or(units, |nearest| nearest.distance), (units, f64::INFINITY))
        }
        Limit::Clear(Some(id), units) => {
            world.subject(id).map_or(missing, |subject| (from(subject), (units, f64::INFINITY)))
        }
        Limit::Within(id, units) => world.subject(id).map_or(missing, |subject| (from(subject), (0.0, units))),
        Limit::Speed(_) | Limit::TurnSpeed(_) => (0.0, (0.0, f64::INFINITY)),
    }
}

/// Height of a level above the floor: of a thing its upper end, or the lower one where it hangs and the camera stays below it.
fn level_height(world: &World, level: Level, is_below: bool) -> f64 {
    match level {
        Level::Units(units) => units,
        Level::Object(id) => world.subject(id).map_or(f64::NAN, |subject| {
            let heights = || subject.corners.iter().map(|corner| world.height_above_floor(*corner));
            let (low, high) = (heights().fold(f64::INFINITY, f64::min), heights().fold(f64::NEG_INFINITY, f64::max));
            if is_below && low > HANGING_FRAC * high { low } else { high }
        }),
    }
}

//! How much of a subject can be seen at all: a window behind its own curtains is never seen whole.
//!
//! Enters: a subject in its room, or a part of a lone thing. Leaves: the share of its points that the best place of a standing
//! person, or the best one around the thing, sees. Where that is less than a picture must show, the picture must show nearly as much
//! as can be seen, so that the search looks for the best view and not past the curtain, or from inside a skull.

use cinesplat_geometry::{rotation, sphere_directions};
use glam::DVec3;

use super::lookouts::standing_places;
use super::world::{Subject, World};

/// Share of what can be seen at best that a picture must show.
const OF_BEST: f64 = 0.85;
/// Places of a standing person that are tried, and points of the subject that are looked at from each.
const NUM_PLACES: usize = 48;
const NUM_POINTS: usize = 60;
/// Directions from a lone thing, the sine of how far below it a place is at most, and how far from its front.
const NUM_AROUND: usize = 96;
const BELOW_SIN: f64 = 0.35;
const BEFORE_RAD: f64 = 0.8;

/// The visible share of a subject that a picture must show, at most `least`.
pub(super) fn least_visible(world: &World, subject: &Subject, least: f64) -> f64 {
    least.min(OF_BEST * best_seen_frac(world, subject))
}

/// Places around a lone thing, as far from its middle as it is large; before its front, where that is known, and not far below it.
fn places_around(world: &World, subject: &Subject) -> Vec<DVec3> {
    let (middle, size) = (world.bounds.center(), world.bounds.size());
    let is_before = |way: &DVec3| {
        let off = |front_rad| rotation::short_turn(world.frame.azimuth(*way) - front_rad).abs();
        way.dot(world.frame.up) > -BELOW_SIN && subject.front_rad.is_none_or(|front_rad| off(front_rad) < BEFORE_RAD)
    };
    sphere_directions(NUM_AROUND).into_iter().filter(is_before).map(|way| middle + way * size).collect()
}

/// Share of a subject's points that the best place sees; 1 where the places of a person are not known.
fn best_seen_frac(world: &World, subject: &Subject) -> f64 {
    *subject.best_seen_frac.get_or_init(|| {
        let standing = standing_places(world);
        let around = if standing.is_empty() && !world.is_indoor() { places_around(world, subject) } else { Vec::new() };
        let places = if standing.is_empty() { &around } else { standing };
        let stride = (subject.points.len() / NUM_POINTS).max(1);
        let points = || subject.points.iter().step_by(stride);
        let num_points = points().count();
        if places.is_empty() || num_points == 0 {
            return 1.0;
        }
        let seen = |eye| points().filter(|point| subject.transmittance(eye, **point) >= 0.5).count();
        let best = places.iter().step_by((places.len() / NUM_PLACES).max(1)).map(|&eye| seen(eye)).max();
        best.unwrap_or(num_points) as f64 / num_points as f64
    })
}

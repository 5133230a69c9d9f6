//! How much of a subject can be seen at all: a window behind its own curtains is never seen whole.
//!
//! Enters: a subject in its room. Leaves: the share of its points that the best place of a standing person sees. Where that is
//! less than a picture must show, the picture must show nearly as much as can be seen, so that the search looks for the best view
//! and not past the curtain.

use super::lookouts::standing_places;
use super::world::{Subject, World};

/// Share of what can be seen at best that a picture must show.
const OF_BEST: f64 = 0.85;
/// Places of a standing person that are tried, and points of the subject that are looked at from each.
const NUM_PLACES: usize = 48;
const NUM_POINTS: usize = 60;

/// The visible share of a subject that a picture must show, at most `least`.
pub(super) fn least_visible(world: &World, subject: &Subject, least: f64) -> f64 {
    least.min(OF_BEST * best_seen_frac(world, subject))
}

/// Share of a subject's points that the best place sees; 1 where the places of a person are not known.
fn best_seen_frac(world: &World, subject: &Subject) -> f64 {
    *subject.best_seen_frac.get_or_init(|| {
        let places = standing_places(world);
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

//! World up of a scene whose file does not say it.
//!
//! Enters: Gaussians. Leaves: a unit direction and how sure it is. A direction is judged by the floor that lies across
//! it ([`floor`]) and by what files of its kind tend to have ([`UpPrior`]). Candidates are the six coordinate axes and
//! the directions that many surfaces face ([`candidates`]); a floor that is found is leveled by fitting a plane to it.
//!
//! Ties are broken by the prior, then by the order -y, +y, +z, -z, x, and directions off the axes last.

mod candidates;
mod facets;
mod floor;
mod prior;
mod sample;

use glam::DVec3;

use super::gaussians::Gaussians;
use prior::AXES;
use sample::Sample;

pub use prior::UpPrior;

/// An estimate of world up.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UpEstimate {
    /// World up, unit.
    pub up: DVec3,
    /// 0..=100: share of the weight of all candidates within 15 degrees of this one.
    pub percent_sure: u8,
}

/// What a floor beyond doubt is worth, as logarithm of odds.
const FLOOR_WEIGHT: f64 = 6.0;

/// What it is worth that matter lies near the floor rather than near the ceiling.
const HEIGHT_WEIGHT: f64 = 3.0;

/// Evidence below which leveling is not tried.
const LEAST_EVIDENCE: f64 = 0.03;

/// Evidence from which a floor is used to level the scene.
const LEVELING_EVIDENCE: f64 = 0.25;

/// Tilt below which a leveled direction is the coordinate axis itself (cosine of 0.5 degrees).
const SNAP_COS: f64 = 0.999_962;

/// Angle within which candidates mean the same direction (cosine of 15 degrees).
const SAME_COS: f64 = 0.966;

/// World up of a scene by its floor, else by what its kind of file tends to have. Deterministic.
pub fn estimate(gaussians: &Gaussians, prior: UpPrior) -> UpEstimate {
    let judged = match Sample::of(gaussians) {
        Some(sample) => judge_all(&sample, prior),
        None => AXES.into_iter().map(|up| (up, prior.of_axis(up))).collect(),
    };
    // The first of equals wins.
    let best = judged.iter().copied().reduce(|best, next| if next.1 > best.1 { next } else { best });
    let (up, merit) = best.unwrap_or((DVec3::NEG_Y, 0.0));
    let odds = |(_, other): &(DVec3, f64)| (other - merit).exp();
    // Directions that mean the same must not outvote the others by number: each group counts once, by its best.
    let mut groups: Vec<(DVec3, f64)> = Vec::new();
    let mut ranked = judged.clone();
    ranked.sort_by(|a, b| b.1.total_cmp(&a.1));
    for candidate in ranked {
        if groups.iter().all(|known| known.0.dot(candidate.0) < SAME_COS) {
            groups.push(candidate);
        }
    }
    let percent = 100.0 / groups.iter().map(odds).sum::<f64>().max(1.0);
    UpEstimate { up, percent_sure: percent.round() as u8 }
}

/// All candidates with their merits: the axes, and other directions that have a floor.
fn judge_all(sample: &Sample, prior: UpPrior) -> Vec<(DVec3, f64)> {
    let facets = facets::find(sample);
    let peaks = candidates::normal_peaks(sample, &facets);
    let judged = |up: DVec3| judge(sample, &facets, prior, up);
    let off_axis =
        peaks.into_iter().flat_map(|peak| [peak, -peak]).map(judged).filter(|judged| judged.2 >= LEVELING_EVIDENCE);
    AXES.into_iter().map(judged).chain(off_axis).map(|(up, merit, _)| (up, merit)).collect()
}

/// A candidate, leveled where it has a floor, with its merit and the evidence for the floor.
fn judge(sample: &Sample, facets: &[facets::Facet], prior: UpPrior, up: DVec3) -> (DVec3, f64, f64) {
    let judged = |direction: DVec3, floor: floor::Floor| {
        // Only next to a floor does it tell anything where the rest of the matter lies.
        let low_lying = HEIGHT_WEIGHT * floor.evidence * (0.5 - floor.mean_height);
        (direction, prior.of(direction) + FLOOR_WEIGHT * floor.evidence + low_lying, floor.evidence)
    };
    let first = floor::look(sample, facets, up);
    if first.evidence < LEAST_EVIDENCE {
        return judged(up, first);
    }
    // A floor that is tilted against the candidate shows only in part: level what is there, then look again.
    let leveled = snapped(candidates::level(sample, up, first.height));
    let second = floor::look(sample, facets, leveled);
    let is_better = second.evidence >= LEVELING_EVIDENCE && second.evidence >= 0.9 * first.evidence;
    if is_better { judged(leveled, second) } else { judged(up, first) }
}

/// The direction, or the coordinate axis it lies next to.
fn snapped(direction: DVec3) -> DVec3 {
    AXES.into_iter().find(|axis| axis.dot(direction) > SNAP_COS).unwrap_or(direction)
}

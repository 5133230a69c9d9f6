//! Estimation of world up, for files that do not state it.
//!
//! Enters: Gaussians and the prior of the kind of file. Leaves: a unit direction with a confidence. The candidates are the
//! six coordinate axes and the frequent surface normals ([`candidates`]). The score of a candidate combines the evidence
//! for a floor perpendicular to it ([`floor`]) with the prior ([`UpPrior`]). A plane fit levels the floor of a candidate.
//!
//! Invariant: the result is deterministic. Of equal scores the first wins: -y, +y, +z, -z, x, -x, then other directions.

mod candidates;
mod facets;
mod floor;
mod prior;
mod sample;

use glam::DVec3;

use super::gaussians::Gaussians;
use prior::AXES;
use sample::PatchSample;

pub use prior::UpPrior;

/// An estimate of world up.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UpEstimate {
    /// World up, unit.
    pub up: DVec3,
    /// Confidence in percent, 0..=100: the odds of this candidate divided by the sum of the odds of all. Candidates
    /// within 15 degrees of a better one do not count.
    pub confidence_percent: u8,
}

/// Score of full evidence for a floor, as the logarithm of odds.
const FLOOR_WEIGHT: f64 = 6.0;

/// Score for matter that is concentrated near the floor rather than near the ceiling.
const HEIGHT_WEIGHT: f64 = 3.0;

/// Evidence for a floor below which the candidate is not leveled.
const MIN_EVIDENCE: f64 = 0.03;

/// Minimum evidence for the leveled floor with which the leveled direction replaces the candidate.
const LEVELING_EVIDENCE: f64 = 0.25;

/// Cosine of the angle within which a leveled direction snaps to a coordinate axis (0.5 degrees).
const SNAP_COS: f64 = 0.999_962;

/// Cosine of the angle within which two candidates count as one direction (15 degrees).
const SAME_COS: f64 = 0.966;

/// Estimates world up from the floor of a scene; without a floor the prior decides.
pub fn estimate(gaussians: &Gaussians, prior: UpPrior) -> UpEstimate {
    let scored = match PatchSample::of(gaussians) {
        Some(sample) => score_candidates(&sample, prior),
        None => AXES.into_iter().map(|up| (up, prior.of_axis(up))).collect(),
    };
    // Of equal scores the first wins.
    let best = scored.iter().copied().reduce(|best, next| if next.1 > best.1 { next } else { best });
    let (up, score) = best.unwrap_or((DVec3::NEG_Y, 0.0));
    let odds = |(_, other): &(DVec3, f64)| (other - score).exp();
    // Each group of nearby directions counts once, by its best, so that a crowded group does not dominate the sum.
    let mut groups: Vec<(DVec3, f64)> = Vec::new();
    let mut ranked = scored.clone();
    ranked.sort_by(|a, b| b.1.total_cmp(&a.1));
    for candidate in ranked {
        if groups.iter().all(|known| known.0.dot(candidate.0) < SAME_COS) {
            groups.push(candidate);
        }
    }
    let percent = 100.0 / groups.iter().map(odds).sum::<f64>().max(1.0);
    UpEstimate { up, confidence_percent: percent.round() as u8 }
}

/// All candidates with their scores: the axes, and other directions with a floor.
fn score_candidates(sample: &PatchSample, prior: UpPrior) -> Vec<(DVec3, f64)> {
    let facets = facets::find_facets(sample);
    let peaks = candidates::normal_peaks(sample, &facets);
    let scored = |up: DVec3| score_direction(sample, &facets, prior, up);
    let off_axis =
        peaks.into_iter().flat_map(|peak| [peak, -peak]).map(scored).filter(|scored| scored.2 >= LEVELING_EVIDENCE);
    AXES.into_iter().map(scored).chain(off_axis).map(|(up, score, _)| (up, score)).collect()
}

/// A candidate, leveled if it has a floor, with its score and the evidence for the floor.
fn score_direction(sample: &PatchSample, facets: &[facets::Facet], prior: UpPrior, up: DVec3) -> (DVec3, f64, f64) {
    let scored = |direction: DVec3, floor: floor::Floor| {
        // The height of the matter is informative only relative to a floor.
        let low_lying = HEIGHT_WEIGHT * floor.evidence * (0.5 - floor.mean_height);
        (direction, prior.of(direction) + FLOOR_WEIGHT * floor.evidence + low_lying, floor.evidence)
    };
    let first = floor::find_floor(sample, facets, up);
    if first.evidence < MIN_EVIDENCE {
        return scored(up, first);
    }
    // A floor that is tilted against the candidate gives weak evidence. Level the candidate to it and search again.
    let leveled = snapped(candidates::level(sample, up, first.height));
    let second = floor::find_floor(sample, facets, leveled);
    let is_better = second.evidence >= LEVELING_EVIDENCE && second.evidence >= 0.9 * first.evidence;
    if is_better { scored(leveled, second) } else { scored(up, first) }
}

/// The nearby coordinate axis if there is one, else the direction.
fn snapped(direction: DVec3) -> DVec3 {
    AXES.into_iter().find(|axis| axis.dot(direction) > SNAP_COS).unwrap_or(direction)
}

//! Estimation of world up, for files that do not state it.
//!
//! Enters: Gaussians and the prior of the kind of file. Leaves: unit directions with probabilities. The candidates are
//! the frequent surface normals ([`candidates`]), the directions in which the scene can rest on the ground and its
//! principal axes ([`resting`]), and, unless the pose is arbitrary, the six coordinate axes. A plane fit levels the
//! floor of a candidate. The [`evidence`] for each gives its odds by fixed weights ([`weights`]), and the prior
//! ([`UpPrior`]) multiplies them.
//!
//! Invariant: the result is deterministic. Of equal scores the first wins: -y, +y, +z, -z, x, -x, then other directions.

mod candidates;
mod evidence;
mod facets;
mod floor;
mod legs;
mod prior;
mod resting;
mod sample;
mod weights;

use glam::DVec3;

use super::gaussians::Gaussians;
use evidence::{NUM_EVIDENCE, evidence};
use facets::Facet;
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

/// The flag that states an up direction, with three decimals.
pub fn up_flag(up: DVec3) -> String {
    let [x, y, z] = up.to_array().map(|v| (v * 1e3).round() / 1e3 + 0.0);
    format!("--up {x},{y},{z}")
}

/// Confidence below which an estimate is a guess that a person should look at.
pub const SURE_PERCENT: u8 = 80;

/// Evidence for a floor below which the candidate is not leveled.
const MIN_EVIDENCE: f64 = 0.03;

/// Minimum evidence for the leveled floor with which the leveled direction replaces the candidate.
const LEVELING_EVIDENCE: f64 = 0.25;

/// Cosine of the angle within which a leveled direction snaps to a coordinate axis (0.5 degrees).
const SNAP_COS: f64 = 0.999_962;

/// Cosine of the angle within which two candidates count as one direction (15 degrees).
const SAME_COS: f64 = 0.966;

/// Cosine of the angle within which a candidate of another source is not tried again (3 degrees).
const REPEATED_COS: f64 = 0.9986;

/// Estimates world up from the shape of a scene; without a shape the prior decides.
pub fn estimate(gaussians: &Gaussians, prior: UpPrior) -> UpEstimate {
    let first = estimates(gaussians, prior).into_iter().next();
    first.unwrap_or(UpEstimate { up: DVec3::NEG_Y, confidence_percent: 0 })
}

/// The directions that may be up, at least 15 degrees apart, most likely first.
pub fn estimates(gaussians: &Gaussians, prior: UpPrior) -> Vec<UpEstimate> {
    let scored = match candidates_of(gaussians, prior) {
        Some(found) => {
            let floorless = 1.0 - found.iter().map(|(_, evidence)| evidence[0]).fold(0.0, f64::max);
            found.into_iter().map(|c| (c.0, prior.of(c.0) + weights::score(&c.1, floorless))).collect()
        }
        None => AXES.into_iter().map(|up| (up, prior.of_axis(up))).collect(),
    };
    ranked(scored)
}

/// Groups nearby directions by their best and turns scores, the logarithms of odds, into probabilities.
fn ranked(mut scored: Vec<(DVec3, f64)>) -> Vec<UpEstimate> {
    // Of equal scores the first wins: the sort is stable.
    scored.sort_by(|a, b| b.1.total_cmp(&a.1));
    // Each group of nearby directions counts once, by its best, so that a crowded group does not dominate the sum.
    let mut groups: Vec<(DVec3, f64)> = Vec::new();
    for candidate in scored {
        if groups.iter().all(|known| known.0.dot(candidate.0) < SAME_COS) {
            groups.push(candidate);
        }
    }
    let best = groups.first().map_or(0.0, |group| group.1);
    let sum: f64 = groups.iter().map(|group| (group.1 - best).exp()).sum();
    let percent = |score: f64| (100.0 * (score - best).exp() / sum).round() as u8;
    groups.into_iter().map(|(up, score)| UpEstimate { up, confidence_percent: percent(score) }).collect()
}

/// All candidates with their evidence; `None` for a scene without extent.
pub(super) fn candidates_of(gaussians: &Gaussians, prior: UpPrior) -> Option<Vec<(DVec3, [f64; NUM_EVIDENCE])>> {
    let sample = &PatchSample::of(gaussians)?;
    let facets = facets::find_facets(sample);
    let mut directions: Vec<DVec3> = if prior == UpPrior::Any { Vec::new() } else { AXES.to_vec() };
    let peaks = candidates::normal_peaks(sample, &facets).into_iter().flat_map(|peak| [peak, -peak]);
    directions.extend(peaks);
    for direction in resting::resting(sample).into_iter().chain(resting::principal(sample)) {
        if directions.iter().all(|known| known.dot(direction) < REPEATED_COS) {
            directions.push(direction);
        }
    }
    Some(directions.into_iter().map(|up| leveled(sample, &facets, prior, up)).collect())
}

/// A candidate, leveled if it has a floor, with its evidence.
fn leveled(sample: &PatchSample, facets: &[Facet], prior: UpPrior, up: DVec3) -> (DVec3, [f64; NUM_EVIDENCE]) {
    let (first, floor) = evidence(sample, facets, up);
    if floor.evidence < MIN_EVIDENCE {
        return (up, first);
    }
    // A floor that is tilted against the candidate gives weak evidence. Level the candidate to it and search again.
    let level = candidates::level(sample, up, floor.height);
    let level = if prior == UpPrior::Any { level } else { snapped(level) };
    let (second, leveled) = evidence(sample, facets, level);
    let is_better = leveled.evidence >= LEVELING_EVIDENCE && leveled.evidence >= 0.9 * floor.evidence;
    if is_better { (level, second) } else { (up, first) }
}

/// The nearby coordinate axis if there is one, else the direction.
fn snapped(direction: DVec3) -> DVec3 {
    AXES.into_iter().find(|axis| axis.dot(direction) > SNAP_COS).unwrap_or(direction)
}

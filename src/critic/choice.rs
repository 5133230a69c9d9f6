//! The order of several films of one program.

use std::cmp::Ordering;

use super::review::Review;
use super::terms::Weights;

/// A film that may be chosen.
#[derive(Debug, Clone, PartialEq)]
pub struct Candidate {
    /// Number of requirements that the operator's report calls not met.
    pub num_unmet: usize,
    /// What the critic says.
    pub review: Review,
}

/// Indices of the candidates, the best first: by requirements that are not met, then by limits that are broken, then by
/// score. Ties go to the earlier one.
pub fn ranked(candidates: &[Candidate], weights: &Weights) -> Vec<usize> {
    let mut order: Vec<usize> = (0..candidates.len()).collect();
    order.sort_by(|&a, &b| compare(&candidates[a], &candidates[b], weights));
    order
}

fn compare(a: &Candidate, b: &Candidate, weights: &Weights) -> Ordering {
    let broken = |candidate: &Candidate| candidate.review.num_broken();
    let score = |candidate: &Candidate| candidate.review.score(weights);
    a.num_unmet.cmp(&b.num_unmet).then(broken(a).cmp(&broken(b))).then(score(b).total_cmp(&score(a)))
}

//! How well stated probabilities agree with what turned out right.

/// Number of bins of certainty.
const NUM_BINS: usize = 10;

/// Per bin of certainty that is not empty: mean probability, share of right answers, number of answers. `certainty` has
/// the probability of each answer and whether it is right.
pub(super) fn bins(certainty: &[(f64, bool)]) -> Vec<(f64, f64, usize)> {
    let mut sums = [(0.0, 0.0, 0_usize); NUM_BINS];
    for (probability, is_right) in certainty {
        let bin = &mut sums[((probability * NUM_BINS as f64) as usize).min(NUM_BINS - 1)];
        *bin = (bin.0 + probability, bin.1 + f64::from(u8::from(*is_right)), bin.2 + 1);
    }
    let filled = sums.into_iter().filter(|(_, _, count)| *count > 0);
    filled.map(|(sum, right, count)| (sum / count as f64, right / count as f64, count)).collect()
}

/// Expected calibration error: the mean distance between probability and share over the bins, weighted by their answers
/// (Naeini, Cooper and Hauskrecht 2015).
pub(super) fn calibration_error(certainty: &[(f64, bool)]) -> f64 {
    let distance = |(mean, share, count): (f64, f64, usize)| (mean - share).abs() * count as f64;
    bins(certainty).into_iter().map(distance).sum::<f64>() / certainty.len().max(1) as f64
}

//! Division of surface parameters into intervals. Enters: a range and a step. Leaves: intervals in ascending order that
//! cover the range without gaps.

/// Cell width per standard deviation. At 1.35 a flat sheet transmits less than one percent of the light.
const CELL_PER_SIGMA: f64 = 1.35;

/// An interval of a surface parameter, covered by one surfel.
#[derive(Debug, Clone, Copy)]
pub(super) struct ParamInterval {
    /// Lower end.
    pub(super) low: f64,
    /// Upper end.
    pub(super) high: f64,
    /// Middle.
    pub(super) middle: f64,
    /// Position of the middle in the whole range, 0..=1.
    pub(super) frac: f64,
    /// Standard deviation of the surfel divided by the interval's length.
    pub(super) sigma_frac: f64,
}

/// `low..high` divided into intervals of about `step`. Surfels become smaller toward both ends, so that outlines are
/// sharp.
pub(super) fn intervals(low: f64, high: f64, step: f64) -> Vec<ParamInterval> {
    let count = ((high - low) / step).round().max(1.0) as usize;
    let breaks: Vec<f64> = (0..=count).map(|i| low + (high - low) * i as f64 / count as f64).collect();
    intervals_between(&breaks)
}

/// `low..high` divided into `count` equal intervals, at least 3, with surfels of one size: for closed loops.
pub(super) fn periodic_intervals(low: f64, high: f64, count: usize) -> Vec<ParamInterval> {
    let count = count.max(3);
    let at = |i: f64| low + (high - low) * i / count as f64;
    (0..count)
        .map(|i| {
            let i = i as f64;
            let (frac, sigma_frac) = ((i + 0.5) / count as f64, 1.0 / CELL_PER_SIGMA);
            ParamInterval { low: at(i), high: at(i + 1.0), middle: at(i + 0.5), frac, sigma_frac }
        })
        .collect()
}

/// `-half..half` divided into narrow intervals over a width of `edge` at both ends (none if `edge` is 0) and intervals of
/// about `step` between.
pub(super) fn edge_refined_intervals(half: f64, edge: f64, step: f64) -> Vec<ParamInterval> {
    if edge <= 0.0 || edge >= half {
        return intervals(-half, half, step);
    }
    let inner = half - edge;
    let corner = (1.3 * edge / step).ceil().max(1.0) as usize;
    let count = (2.0 * inner / step).round().max(1.0) as usize;
    let ramp = |i: usize, n: usize, a: f64, b: f64| a + (b - a) * i as f64 / n as f64;
    let mut breaks: Vec<f64> = (0..corner).map(|i| ramp(i, corner, -half, -inner)).collect();
    breaks.extend((0..count).map(|i| ramp(i, count, -inner, inner)));
    breaks.extend((0..=corner).map(|i| ramp(i, corner, inner, half)));
    intervals_between(&breaks)
}

/// The intervals between consecutive breaks, with surfels that become smaller toward both ends.
pub(super) fn intervals_between(breaks: &[f64]) -> Vec<ParamInterval> {
    let (Some(&first), Some(&last)) = (breaks.first(), breaks.last()) else { return Vec::new() };
    let total = (last - first).max(1e-12);
    breaks
        .windows(2)
        .map(|pair| {
            let (low, high) = (pair[0], pair[1]);
            let (middle, width) = (f64::midpoint(low, high), high - low);
            let to_end = (middle - first).min(last - middle);
            let sigma = (width / CELL_PER_SIGMA).min(0.75 * to_end).max(width / 2.1);
            ParamInterval { low, high, middle, frac: (middle - first) / total, sigma_frac: sigma / width }
        })
        .collect()
}

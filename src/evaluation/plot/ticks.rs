//! Round numbers along an axis.

/// Multiples of 1, 2 or 5 times a power of ten inside `low..=high`, about `count` of them, and their decimals.
pub(super) fn ticks(low: f64, high: f64, count: f64) -> (Vec<f64>, usize) {
    let rough = (high - low) / count;
    if !(rough > 0.0 && rough.is_finite()) {
        return (vec![low], 3);
    }
    let power = 10_f64.powf(rough.log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0].into_iter().map(|m| m * power).find(|step| *step >= rough).unwrap_or(10.0 * power);
    let (first, last) = ((low / step - 1e-9).ceil() as i64, (high / step + 1e-9).floor() as i64);
    let decimals = (-step.log10().floor()).max(0.0) as usize;
    ((first..=last).map(|idx| idx as f64 * step).collect(), decimals)
}

/// The smallest interval around values that is not empty: a flat line gets room above and below.
pub(super) fn padded(low: f64, high: f64, least: f64) -> (f64, f64) {
    if !(low <= high) {
        return (0.0, 1.0);
    }
    let room = ((high - low) * 0.06).max((least - (high - low)) / 2.0);
    (low - room, high + room)
}

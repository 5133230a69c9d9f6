/// Order statistics of some values, all 0 for no values.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Summary {
    pub(super) least: f64,
    /// The upper median of an even number of values.
    pub(super) median: f64,
    pub(super) largest: f64,
}

impl Summary {
    pub(super) fn of(values: &[f64]) -> Self {
        let mut sorted = values.to_vec();
        sorted.sort_by(f64::total_cmp);
        let at = |idx: usize| sorted.get(idx).copied().unwrap_or(0.0);
        Self { least: at(0), median: at(sorted.len() / 2), largest: at(sorted.len().saturating_sub(1)) }
    }
}

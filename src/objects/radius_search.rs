//! Derivative-free maximization over one positive number.

/// The result of a search.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RadiusMaximum {
    /// Radius of the largest value; the smallest one of several.
    pub radius: f64,
    /// The largest value.
    pub value: f64,
    /// Number of evaluations of the objective, at most the budget.
    pub num_evaluations: usize,
}

/// The radius in `low..=high` with the largest objective, by a scan in equal ratios (two thirds of the budget) and
/// golden section search around its best radius.
///
/// The objective may have steps and plateaus. NaN counts as the smallest value. A budget of 0 returns `high` with value
/// 0.
pub fn maximize(low: f64, high: f64, budget: usize, objective: impl Fn(f64) -> f64) -> RadiusMaximum {
    let mut search = Maximizer { best: RadiusMaximum { radius: high, value: 0.0, num_evaluations: 0 }, objective };
    let num_scan = (2 * budget).div_ceil(3);
    let ratio = (high / low).ln() / (num_scan.max(2) - 1) as f64;
    for step in 0..num_scan {
        search.evaluate(low * (ratio * step as f64).exp());
    }
    let middle = search.best.radius.ln();
    let (mut left, mut right) = ((middle - ratio).max(low.ln()), (middle + ratio).min(high.ln()));
    let golden = (5.0_f64.sqrt() - 1.0) / 2.0;
    while search.best.num_evaluations + 2 <= budget {
        let (a, b) = (right - golden * (right - left), left + golden * (right - left));
        if search.evaluate(a.exp()) >= search.evaluate(b.exp()) { right = b } else { left = a }
    }
    search.best
}

struct Maximizer<F> {
    best: RadiusMaximum,
    objective: F,
}

impl<F: Fn(f64) -> f64> Maximizer<F> {
    fn evaluate(&mut self, radius: f64) -> f64 {
        let found = (self.objective)(radius);
        let value = if found.is_nan() { f64::NEG_INFINITY } else { found };
        let first = self.best.num_evaluations == 0;
        self.best.num_evaluations += 1;
        if first || value > self.best.value || (value >= self.best.value && radius < self.best.radius) {
            self.best = RadiusMaximum { radius, value, ..self.best };
        }
        value
    }
}

//! A search over one positive number by its values alone.

/// What a search found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Found {
    /// Where the best value was seen; the smallest of several such places.
    pub radius: f64,
    /// The best value.
    pub value: f64,
    /// How often the objective was asked: never more than the budget.
    pub num_evaluations: usize,
}

/// The radius in `low..=high` with the largest objective, by a coarse scan in equal ratios (two thirds of the budget)
/// and golden sections about the best of it.
///
/// The objective may have steps and plateaus; a value that is not a number counts as the worst. With a budget of 0 the
/// answer is `high` with value 0, unasked.
pub fn maximize(low: f64, high: f64, budget: usize, objective: impl Fn(f64) -> f64) -> Found {
    let mut search = Search { best: Found { radius: high, value: 0.0, num_evaluations: 0 }, objective };
    let num_scan = (2 * budget).div_ceil(3);
    let ratio = (high / low).ln() / (num_scan.max(2) - 1) as f64;
    for step in 0..num_scan {
        search.ask(low * (ratio * step as f64).exp());
    }
    let middle = search.best.radius.ln();
    let (mut left, mut right) = ((middle - ratio).max(low.ln()), (middle + ratio).min(high.ln()));
    let golden = (5.0_f64.sqrt() - 1.0) / 2.0;
    while search.best.num_evaluations + 2 <= budget {
        let (a, b) = (right - golden * (right - left), left + golden * (right - left));
        if search.ask(a.exp()) >= search.ask(b.exp()) { right = b } else { left = a }
    }
    search.best
}

struct Search<F> {
    best: Found,
    objective: F,
}

impl<F: Fn(f64) -> f64> Search<F> {
    fn ask(&mut self, radius: f64) -> f64 {
        let answer = (self.objective)(radius);
        let value = if answer.is_nan() { f64::NEG_INFINITY } else { answer };
        let first = self.best.num_evaluations == 0;
        self.best.num_evaluations += 1;
        if first || value > self.best.value || (value >= self.best.value && radius < self.best.radius) {
            self.best = Found { radius, value, ..self.best };
        }
        value
    }
}

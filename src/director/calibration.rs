//! Calibration: the probability that a step is right, from the network's own probability of it.

use serde::{Deserialize, Serialize};

/// Least distance of a probability from 0 and 1, so that its logit is finite.
const MARGIN: f64 = 1e-6;

/// A logistic map of probabilities (Platt 1999): `logit(out) = slope logit(in) + offset`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Calibration {
    /// Factor on the logit.
    pub slope: f64,
    /// Added to the logit.
    pub offset: f64,
}

impl Default for Calibration {
    /// The identity.
    fn default() -> Self {
        Self { slope: 1.0, offset: 0.0 }
    }
}

impl Calibration {
    /// The calibrated probability.
    pub fn apply(self, probability: f64) -> f64 {
        sigmoid(self.slope * logit(probability) + self.offset)
    }

    /// The calibration of the highest likelihood for probabilities of steps that are right or not, by Newton's method.
    /// The identity without examples of both.
    pub fn fit(examples: &[(f64, bool)]) -> Self {
        let mut fitted = Self::default();
        let right = examples.iter().filter(|(_, is_right)| *is_right).count();
        if right == 0 || right == examples.len() {
            return fitted;
        }
        for _ in 0..50 {
            let (mut gradient, mut curvature) = ([0.0; 2], [1e-6, 0.0, 1e-6]);
            for (probability, is_right) in examples {
                let x = logit(*probability);
                let p = sigmoid(fitted.slope * x + fitted.offset);
                let error = p - f64::from(u8::from(*is_right));
                let weight = p * (1.0 - p);
                gradient = [gradient[0] + error * x, gradient[1] + error];
                curvature = [curvature[0] + weight * x * x, curvature[1] + weight * x, curvature[2] + weight];
            }
            let determinant = curvature[0] * curvature[2] - curvature[1] * curvature[1];
            let step = [
                (curvature[2] * gradient[0] - curvature[1] * gradient[1]) / determinant,
                (curvature[0] * gradient[1] - curvature[1] * gradient[0]) / determinant,
            ];
            if !(determinant > 0.0 && step.iter().all(|value| value.is_finite())) {
                break;
            }
            // Half the step until the likelihood grows: a full step may overshoot where probabilities are near 0 or 1.
            let after =
                |share: f64| Self { slope: fitted.slope - share * step[0], offset: fitted.offset - share * step[1] };
            let now = fitted.loss(examples);
            let better = (0..30).map(|halvings| after(0.5_f64.powi(halvings))).find(|next| next.loss(examples) <= now);
            match better {
                Some(next) => fitted = next,
                None => break,
            }
        }
        fitted
    }
}

impl Calibration {
    /// Negative log-likelihood of the examples.
    fn loss(self, examples: &[(f64, bool)]) -> f64 {
        let of = |(probability, is_right): &(f64, bool)| {
            let logit = self.slope * logit(*probability) + self.offset;
            // ln(1 + e^-x) of the right answer, without overflow.
            let x = if *is_right { logit } else { -logit };
            (-x).max(0.0) + (-x.abs()).exp().ln_1p()
        };
        examples.iter().map(of).sum()
    }
}

fn logit(probability: f64) -> f64 {
    let probability = if probability.is_nan() { MARGIN } else { probability.clamp(MARGIN, 1.0 - MARGIN) };
    (probability / (1.0 - probability)).ln()
}

fn sigmoid(logit: f64) -> f64 {
    1.0 / (1.0 + (-logit).exp())
}

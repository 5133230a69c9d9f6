//! Statistics of a list of errors.

use super::EvaluationError;

/// Statistics of errors, in the unit of the errors.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Statistics {
    /// Root mean square.
    pub rmse: f64,
    /// Arithmetic mean.
    pub mean: f64,
    /// Median; the mean of the two middle values for an even number.
    pub median: f64,
    /// Population standard deviation (over n).
    pub std: f64,
    /// Smallest error.
    pub min: f64,
    /// Largest error.
    pub max: f64,
    /// Sum of squares, in the squared unit.
    pub sse: f64,
}

impl Statistics {
    /// Statistics of at least one error.
    ///
    /// # Errors
    /// [`EvaluationError::Empty`] without errors.
    pub fn of(errors: &[f64]) -> Result<Self, EvaluationError> {
        if errors.is_empty() {
            return Err(EvaluationError::Empty { which: "comparison" });
        }
        let count = errors.len() as f64;
        let mean = errors.iter().sum::<f64>() / count;
        let sse = errors.iter().map(|error| error * error).sum::<f64>();
        let variance = errors.iter().map(|error| (error - mean).powi(2)).sum::<f64>() / count;
        let mut sorted = errors.to_vec();
        sorted.sort_by(f64::total_cmp);
        let (low, high) = (sorted[(sorted.len() - 1) / 2], sorted[sorted.len() / 2]);
        Ok(Self {
            rmse: (sse / count).sqrt(),
            mean,
            median: f64::midpoint(low, high),
            std: variance.sqrt(),
            min: sorted[0],
            max: sorted[sorted.len() - 1],
            sse,
        })
    }

    /// Names and values, in the order of the report.
    pub fn named(&self) -> [(&'static str, f64); 7] {
        [
            ("rmse", self.rmse),
            ("mean", self.mean),
            ("median", self.median),
            ("std", self.std),
            ("min", self.min),
            ("max", self.max),
            ("sse", self.sse),
        ]
    }
}

/// The value below which a fraction of sorted values lies, interpolated linearly; NaN without values.
pub(super) fn quantile(sorted: &[f64], fraction: f64) -> f64 {
    let Some(last) = sorted.len().checked_sub(1) else { return f64::NAN };
    let at = fraction.clamp(0.0, 1.0) * last as f64;
    let (low, high) = (at.floor() as usize, at.ceil() as usize);
    sorted[low] + (sorted[high] - sorted[low]) * at.fract()
}

/// Root mean square of values; NaN without values.
pub(super) fn root_mean_square(values: &[f64]) -> f64 {
    (values.iter().map(|value| value * value).sum::<f64>() / values.len() as f64).sqrt()
}

//! Error of the focal length, which trajectory errors do not include.

use super::Trajectory;
use super::statistics::root_mean_square;

/// Error of the focal lengths over matched poses: statistics of ln(estimate focal length / reference focal length).
///
/// A value of 0.1 is a difference of about 10 %.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FocalError {
    /// Root mean square.
    pub log_ratio_rmse: f64,
    /// Mean; above 0 if the estimate has longer focal lengths, that is narrower fields of view.
    pub log_ratio_mean: f64,
    /// Largest magnitude.
    pub log_ratio_max: f64,
}

/// The error of the focal lengths of poses matched by index; `None` if a pose has no field of view.
pub(super) fn focal_error(reference: &Trajectory, estimate: &Trajectory) -> Option<FocalError> {
    let pairs = reference.fov_y_rad.iter().zip(&estimate.fov_y_rad);
    // Focal length over half the image height is 1 / tan(fov / 2).
    let ratio =
        |(a, b): (&Option<f64>, &Option<f64>)| Some((a.as_ref()? / 2.0).tan().ln() - (b.as_ref()? / 2.0).tan().ln());
    let ratios: Vec<f64> = pairs.map(ratio).collect::<Option<_>>()?;
    if ratios.is_empty() {
        return None;
    }
    Some(FocalError {
        log_ratio_rmse: root_mean_square(&ratios),
        log_ratio_mean: ratios.iter().sum::<f64>() / ratios.len() as f64,
        log_ratio_max: ratios.iter().fold(0.0, |largest, r| r.abs().max(largest)),
    })
}

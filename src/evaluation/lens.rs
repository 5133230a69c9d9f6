//! Errors of the lens, which trajectory measures leave out.

use super::Trajectory;
use super::statistics::root_mean_square;

/// How far fields of view are off, over matched poses.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FocalError {
    /// Root mean square of ln(estimate focal length / reference focal length): 0.1 is about 10 %.
    pub log_ratio_rmse: f64,
    /// Mean of the same with its sign: above 0 the estimate is longer, that is, narrower.
    pub log_ratio_mean: f64,
    /// Largest magnitude of the same.
    pub log_ratio_max: f64,
}

/// The error of the focal lengths of poses matched one to one; `None` where a path lacks fields of view.
pub fn focal_error(reference: &Trajectory, estimate: &Trajectory) -> Option<FocalError> {
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
        log_ratio_max: ratios.iter().fold(0.0, |most, r| r.abs().max(most)),
    })
}

//! The constants and formulas of the spec image, which `reference` and `fast` share.

/// Upper bound of the opacity of one splat in a pixel.
pub(super) const ALPHA_MAX: f64 = 0.99;
/// A splat is skipped in pixels where its opacity is below this.
pub(super) const ALPHA_CUT: f64 = 1.0 / 255.0;
/// Blending stops before the transmittance of a pixel would fall below this.
pub(super) const TRANSMITTANCE_STOP: f64 = 1e-4;
/// The local affine approximation is computed at most this many times tan(fov / 2) away from the view axis.
pub(super) const TAN_FOV_CLAMP: f64 = 1.3;

/// Lower and upper bounds of x / z (or y / z) at which the projection is linearized, from the image's size, focal
/// length and principal point along that axis, all in px. Symmetric where the principal point is in the middle.
pub(super) fn slope_bounds(size_px: f64, focal_px: f64, center_px: f64) -> (f64, f64) {
    let margin = (TAN_FOV_CLAMP - 1.0) * size_px / (2.0 * focal_px);
    (-center_px / focal_px - margin, (size_px - center_px) / focal_px + margin)
}

/// Whether a splat is drawn, along one axis: its circle of three standard deviations (radius rounded up to whole
/// pixels) must overlap the picture, whose right and lower end are rounded up to a multiple of 16 px.
///
/// This is the culling of the rasterizer that scenes are trained with (Kerbl et al. 2023). It drops a splat just
/// outside the border although its tail would still be visible.
pub(super) fn reaches(center_px: f64, radius_px: f64, size_px: u32) -> bool {
    let end_px = f64::from(size_px.next_multiple_of(16));
    center_px - 0.5 + radius_px >= 1.0 && center_px - 0.5 - radius_px < end_px
}

/// Radius in whole pixels of the circle of three standard deviations of a splat, from its dilated covariance.
pub(super) fn radius_px(variance_x: f64, covariance: f64, variance_y: f64) -> f64 {
    let half_difference = (variance_x - variance_y) / 2.0;
    let spread = (half_difference * half_difference + covariance * covariance).max(0.1).sqrt();
    (3.0 * (f64::midpoint(variance_x, variance_y) + spread).sqrt()).ceil()
}

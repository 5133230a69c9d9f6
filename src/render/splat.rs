use glam::Vec3;

use super::tiles::{TILE_PX, TileGrid};
use super::{View, reference::ExactSplat};

/// A splat stores the binary logarithm of the opacity divided by this, so that the exponent is in -1..=0 wherever the
/// opacity is above the alpha cut; see [`super::kernel`].
pub(super) const EXPONENT_DIVISOR: f64 = 8.0;

/// The factor k from standard deviations to the units of [`Splat::whiten`]: at an offset of w standard deviations the
/// exponent is lower by (w k)^2.
pub(super) fn whitening_unit() -> f64 {
    (0.5 * std::f64::consts::LOG2_E / EXPONENT_DIVISOR).sqrt()
}

/// The projection of a Gaussian, in the form that blending needs.
///
/// With d = pixel - mean the opacity is 2^(8 (level - u^2 - v^2)), u = `ux` d.x + `uy` d.y, v = `vy` d.y: a Cholesky
/// factor of the inverse covariance, so that the exponent is never above `level`, however thin the splat.
///
/// A splat fills one cache line, because tiles fetch splats in random order.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[repr(align(64))]
pub(super) struct Splat {
    /// Center in pixels.
    pub(super) mean_px: [f32; 2],
    /// Whitening factors ux, uy, vy.
    pub(super) whiten: [f32; 3],
    /// Exponent at the center.
    pub(super) level: f32,
    /// Exponent at the center less that of the alpha cut: the opacity is above the cut where u^2 + v^2 <= `reach`.
    pub(super) reach: f32,
    /// Half the width and height of the region above the alpha cut, pixels.
    pub(super) half_px: [f32; 2],
    /// How far the rightmost point of that region is below the center, pixels.
    pub(super) skew_px: f32,
    /// Red, green, blue.
    pub(super) color: [f32; 3],
    /// Depth along the view axis, scene units.
    pub(super) depth: f32,
    /// Index of the Gaussian.
    pub(super) gaussian_idx: u32,
    /// How far it moves in a sweep, across or down, pixels; 0 without one.
    pub(super) swept_px: f32,
}

impl Splat {
    /// The splat of an exact projection, for Gaussians whose projection overflows `f32`.
    pub(super) fn from_exact(exact: &ExactSplat, view: &View) -> Self {
        let unit = whitening_unit();
        let level = exact.opacity.log2() / EXPONENT_DIVISOR;
        let reach = level - view.alpha_cut.log2() / EXPONENT_DIVISOR;
        let half = exact.half_extents_px(view.alpha_cut);
        let ux = unit * (exact.variance_y / exact.determinant).sqrt();
        let whiten = [ux, -exact.covariance / exact.variance_y * ux, unit / exact.variance_y.sqrt()];
        Self {
            mean_px: exact.mean_px.as_vec2().to_array(),
            whiten: whiten.map(|factor| factor as f32),
            level: level as f32,
            reach: reach as f32,
            half_px: half.as_vec2().to_array(),
            skew_px: (exact.covariance / exact.variance_x * half.x) as f32,
            color: [0.0; 3],
            depth: exact.depth as f32,
            gaussian_idx: 0,
            swept_px: 0.0,
        }
    }

    /// The splat with its color and its Gaussian.
    pub(super) fn with_source(self, gaussian_idx: u32, color: Vec3) -> Self {
        Self { color: color.to_array(), gaussian_idx, ..self }
    }

    /// Tiles of a grid that the splat may overlap: first and last column, first and last row. `None` outside the grid.
    pub(super) fn tile_rect(&self, grid: TileGrid, view: &View) -> Option<[u16; 4]> {
        let [x, y] = self.mean_px;
        let [half_x, half_y] = self.half_px;
        let (width, height) = (view.width as f32, view.height as f32);
        let is_inside = x + half_x > 0.0 && x - half_x < width && y + half_y > 0.0 && y - half_y < height;
        let tile = |position_px: f32, size_px: f32| (position_px.min(size_px - 1.0).max(0.0) / TILE_PX as f32) as u16;
        let (first_row, last_row) = (grid.first_row as u16, (grid.first_row + grid.down - 1) as u16);
        let (top, bottom) = (tile(y - half_y, height), tile(y + half_y, height));
        (is_inside && bottom >= first_row && top <= last_row)
            .then(|| [tile(x - half_x, width), tile(x + half_x, width), top.max(first_row), bottom.min(last_row)])
    }
}

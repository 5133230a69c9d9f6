//! The spec image: every step in `f64`, pixel by pixel, without approximations. The accuracy of every other quality is
//! measured against it.
//!
//! Enters: Gaussians and a view. Leaves: color and transmittance. Tiles only drop splats whose opacity stays below
//! `alpha_cut` in them, so the tile size does not change the picture.

use std::ops::Range;

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use super::blur::AddedVariance;
use super::memory::Budget;
use super::{Limits, RenderError, View, WorkCounts, harmonics, spec, spread};
use cinesplat_scene::Gaussians;

/// Edge of a tile in pixels.
const TILE_PX: u32 = 16;

/// A Gaussian on the image plane.
#[derive(Debug, Clone, Copy)]
pub(super) struct ExactSplat {
    /// Center in pixels.
    pub(super) mean_px: DVec2,
    /// Depth along the view axis.
    pub(super) depth: f64,
    /// Variance along x, dilated.
    pub(super) variance_x: f64,
    /// Covariance of x and y.
    pub(super) covariance: f64,
    /// Variance along y, dilated.
    pub(super) variance_y: f64,
    /// Determinant of the covariance, by Cauchy-Binet.
    pub(super) determinant: f64,
    /// Peak opacity, reduced if the filter compensates for the dilation.
    pub(super) opacity: f64,
}

/// The splat of one Gaussian; `None` if it is not in front of the near plane, not finite, below the alpha cut
/// everywhere or outside the picture.
///
/// With V = J W R S (2 x 3) and its rows v1, v2 the covariance is V V^T + s I; its determinant is computed as
/// |v1 x v2|^2 + s (|v1|^2 + |v2|^2) + s^2. This is exact for needles, for which a c - b b (a, b, c the covariance's
/// entries) loses all digits.
pub(super) fn project(gaussians: &Gaussians, gaussian_idx: usize, view: &View) -> Option<ExactSplat> {
    let mean_camera = view.camera_from_world * (gaussians.means[gaussian_idx].as_dvec3() - view.center);
    let depth = mean_camera.z;
    if !(depth > view.near && mean_camera.is_finite()) {
        return None;
    }
    let slope = mean_camera / depth;
    let [fx, fy] = view.focal_px;
    let bend = |slope: f64, bounds: (f64, f64)| slope.max(bounds.0).min(bounds.1);
    let axis_x = (DVec3::X - DVec3::Z * bend(slope.x, view.slope_x)) * (fx / depth);
    let axis_y = (DVec3::Y - DVec3::Z * bend(slope.y, view.slope_y)) * (fy / depth);
    let rotation = gaussians.rotations[gaussian_idx].as_dquat().normalize();
    let scale = gaussians.scales[gaussian_idx].as_dvec3();
    let to_axes = |axis: DVec3| (rotation.conjugate() * (view.camera_from_world.transpose() * axis)) * scale;
    let (v1, v2) = (to_axes(axis_x), to_axes(axis_y));
    let (raw_x, raw_y, dilation) = (v1.length_squared(), v2.length_squared(), view.dilation_px2);
    let raw = v1.cross(v2).length_squared();
    let determinant = raw + dilation * (raw_x + raw_y) + dilation * dilation;
    let compensation = if view.is_compensated { (raw / determinant).sqrt() } else { 1.0 };
    let opacity = f64::from(gaussians.opacities[gaussian_idx]) * compensation;
    let principal_px = DVec2::from(view.principal_px);
    let mean_px = DVec2::new(fx * slope.x, fy * slope.y) + principal_px;
    let mut splat = ExactSplat {
        mean_px,
        depth,
        variance_x: raw_x + dilation,
        covariance: v1.dot(v2),
        variance_y: raw_y + dilation,
        determinant,
        opacity: opacity.min(1.0),
    };
    if let Some(blur) = &view.blur {
        let added = blur.added(gaussians.means[gaussian_idx].as_dvec3(), depth);
        splat = splat.blurred((v1, v2), added, view);
    }
    let is_finite = splat.determinant > 0.0 && splat.determinant.is_finite() && mean_px.is_finite();
    (is_finite && opacity >= view.alpha_cut && splat.reaches(view)).then_some(splat)
}

impl ExactSplat {
    /// The splat with blur. `v1` and `v2` are the rows of V, see [`project`]: the smear is a fourth column of V.
    fn blurred(self, (v1, v2): (DVec3, DVec3), added: AddedVariance, view: &View) -> Self {
        let AddedVariance { disk, smear } = added;
        let disk = disk + view.dilation_px2;
        let minors = v1 * smear.y - v2 * smear.x;
        let (wide_x, wide_y) = (v1.length_squared() + smear.x * smear.x, v2.length_squared() + smear.y * smear.y);
        let raw = v1.cross(v2).length_squared() + minors.length_squared();
        let determinant = raw + disk.y * wide_x + disk.x * wide_y + disk.x * disk.y;
        let area_frac = (self.determinant / determinant).sqrt();
        Self {
            variance_x: wide_x + disk.x,
            covariance: self.covariance + smear.x * smear.y,
            variance_y: wide_y + disk.y,
            determinant,
            opacity: spread::opacity(self.opacity, area_frac, view.alpha_cut),
            ..self
        }
    }

    /// Whether the splat is drawn; see [`spec::reaches`].
    fn reaches(&self, view: &View) -> bool {
        let radius_px = spec::radius_px(self.variance_x, self.covariance, self.variance_y);
        spec::reaches(self.mean_px.x, radius_px, view.width) && spec::reaches(self.mean_px.y, radius_px, view.height)
    }

    /// Half the width and height in pixels of the region where the opacity is at least `alpha_cut`.
    pub(super) fn half_extents_px(&self, alpha_cut: f64) -> DVec2 {
        let sigmas = (2.0 * (self.opacity / alpha_cut).ln()).max(0.0).sqrt();
        DVec2::new(self.variance_x.sqrt(), self.variance_y.sqrt()) * sigmas
    }

    /// Opacity at a pixel position.
    fn alpha(&self, position_px: DVec2) -> f64 {
        let offset = position_px - self.mean_px;
        // Whitened with a Cholesky factor: q is a sum of squares, so the exponent is never positive.
        let along = offset.y - self.covariance / self.variance_x * offset.x;
        let q = offset.x * offset.x / self.variance_x + along * along * self.variance_x / self.determinant;
        (self.opacity * (-0.5 * q).exp()).min(spec::ALPHA_MAX)
    }
}

/// A splat with its color.
struct Colored {
    splat: ExactSplat,
    color: DVec3,
    sort_distance: f32,
}

/// Renders the `usable` Gaussians into rgb and transmittance; returns the counters.
///
/// # Errors
/// [`RenderError::Cost`] and [`RenderError::Memory`] if the picture exceeds the limits.
pub(super) fn render(
    (gaussians, usable): (&Gaussians, Vec<u32>),
    view: &View,
    limits: &Limits,
    (rgb, transmittance): (&mut [f32], &mut [f32]),
) -> Result<WorkCounts, RenderError> {
    let mut budget = Budget::of_picture(view, limits)?;
    budget.take("the splats", (usable.len() * (size_of::<Colored>() + size_of::<u32>())) as u64)?;
    let splats = sorted_splats(gaussians, &usable, view);
    let tiles_across = view.width.div_ceil(TILE_PX) as usize;
    let num_pairs = splats.iter().map(|splat| tile_rect(splat, view).num_tiles()).sum();
    budget.take_pairs(num_pairs)?;
    let bins = bin(&splats, view, tiles_across);
    let row_len = view.width as usize;
    let rows = rgb.par_chunks_mut(row_len * 3).zip(transmittance.par_chunks_mut(row_len)).enumerate();
    let num_blends: u64 = rows
        .map(|(row, (rgb, transmittance))| {
            let bins = &bins[row / TILE_PX as usize * tiles_across..][..tiles_across];
            blend_row(&splats, bins, view, row, (rgb, transmittance))
        })
        .sum();
    let (num_projected, num_splats) = (usable.len() as u64, splats.len() as u64);
    Ok(WorkCounts { num_subframes: 1, num_projected, num_splats, num_pairs, num_block_blends: num_blends })
}

/// All visible splats, nearest first; ties in `f32` keep the order of the file.
fn sorted_splats(gaussians: &Gaussians, usable: &[u32], view: &View) -> Vec<Colored> {
    let colored = |&idx: &u32| {
        let idx = idx as usize;
        let splat = project(gaussians, idx, view)?;
        let mean = gaussians.means[idx].as_dvec3();
        let color = harmonics::color(mean - view.center, gaussians.sh_dc[idx], gaussians.sh_rest_of(idx));
        let color = view.fog.map_or(color, |fog| fog.tinted(color, mean - view.center));
        let color = color.min(DVec3::splat(view.max_color.into()));
        Some(Colored { splat, color, sort_distance: view.sort_distance(mean, splat.depth) })
    };
    let mut splats: Vec<Colored> = usable.par_iter().filter_map(colored).collect();
    splats.par_sort_by(|a, b| a.sort_distance.total_cmp(&b.sort_distance));
    splats
}

/// Tiles that a splat may overlap: columns and rows.
struct TileRect {
    columns: Range<usize>,
    rows: Range<usize>,
}

impl TileRect {
    fn num_tiles(&self) -> u64 {
        self.columns.len() as u64 * self.rows.len() as u64
    }
}

fn tile_rect(Colored { splat, .. }: &Colored, view: &View) -> TileRect {
    let half = splat.half_extents_px(view.alpha_cut) + 1.0;
    let (low, high) = ((splat.mean_px - half) / f64::from(TILE_PX), (splat.mean_px + half) / f64::from(TILE_PX));
    // Casts saturate: a splat outside the picture gets an empty range at the border.
    let range = |low: f64, high: f64, size: u32| {
        let num_tiles = size.div_ceil(TILE_PX) as usize;
        let end = if high < 0.0 { 0 } else { (high as usize).saturating_add(1).min(num_tiles) };
        (low.max(0.0) as usize).min(end)..end
    };
    TileRect { columns: range(low.x, high.x, view.width), rows: range(low.y, high.y, view.height) }
}

/// Indices of the splats that may overlap each tile, nearest first.
fn bin(splats: &[Colored], view: &View, tiles_across: usize) -> Vec<Vec<u32>> {
    let mut bins = vec![Vec::new(); tiles_across * view.height.div_ceil(TILE_PX) as usize];
    for (splat_idx, splat) in splats.iter().enumerate() {
        let TileRect { columns, rows } = tile_rect(splat, view);
        for tile_y in rows {
            for tile_x in columns.clone() {
                bins[tile_y * tiles_across + tile_x].push(splat_idx as u32);
            }
        }
    }
    bins
}

/// Blends one row of pixels; returns the number of blends.
fn blend_row(
    splats: &[Colored],
    bins: &[Vec<u32>],
    view: &View,
    row: usize,
    (rgb, transmittance): (&mut [f32], &mut [f32]),
) -> u64 {
    let mut num_blends = 0;
    for (column, (rgb, transmittance)) in rgb.chunks_exact_mut(3).zip(transmittance).enumerate() {
        let position_px = DVec2::new(column as f64 + 0.5, row as f64 + 0.5);
        let near_first = bins[column / TILE_PX as usize].iter().map(|&idx| &splats[idx as usize]);
        let (color, rest, blends) = blend_pixel(near_first, view, position_px);
        rgb.copy_from_slice(&color.as_vec3().to_array());
        *transmittance = rest as f32;
        num_blends += blends;
    }
    num_blends
}

/// Color, transmittance and number of blends of one pixel.
fn blend_pixel<'a>(
    near_first: impl Iterator<Item = &'a Colored>,
    view: &View,
    position_px: DVec2,
) -> (DVec3, f64, u64) {
    let (mut color, mut transmittance, mut num_blends) = (DVec3::ZERO, 1.0, 0);
    for Colored { splat, color: splat_color, .. } in near_first {
        let alpha = splat.alpha(position_px);
        if alpha < view.alpha_cut {
            continue;
        }
        let rest = transmittance * (1.0 - alpha);
        if rest < view.transmittance_stop {
            break;
        }
        color += *splat_color * (alpha * transmittance);
        transmittance = rest;
        num_blends += 1;
    }
    (color, transmittance, num_blends)
}

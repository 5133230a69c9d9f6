//! Points that can represent an object: those of its Gaussians' surfaces that lie on the outlines of its masks, and
//! means inside them.

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use super::silhouettes::{Silhouettes, View};
use cinesplat_scene::{Gaussians, SOLID_OPACITY};

/// Distance, px, over which a Gaussian can reach the outline.
const REACH_PX: i64 = 3;

/// Number of standard deviations up to which a point of a Gaussian represents it.
const MAX_SIGMA: f64 = 2.0;

/// Distance, px, by which the renderer's dilation carries a splat's edge outward.
const DILATION_PX: f64 = 0.5;

/// Limit on the Gaussians per pixel, largest first.
const PER_PIXEL: usize = 3;

/// Distance between the means inside a mask, px.
const INSIDE_STEP_PX: usize = 6;

/// A point that may be kept.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Candidate {
    pub(crate) point: DVec3,
    /// The view on whose outline it lies.
    pub(crate) view_idx: usize,
    /// Its position in that view.
    pub(crate) position_px: DVec2,
}

/// The candidates of an object, in order of the views.
///
/// For every side of an outline, the Gaussian that comes nearest to it gives the point of its ellipsoid in the direction
/// of the side, at most [`MAX_SIGMA`] from its mean plus [`DILATION_PX`]. Points that lie beside the mask of another view are dropped.
pub(crate) fn candidates(gaussians: &Gaussians, silhouettes: &Silhouettes) -> Vec<Candidate> {
    let solid = solid(gaussians);
    let of_view = |(view_idx, view): (usize, &View)| {
        let pixels = PixelIndex::new(gaussians, &solid, view);
        let outline = view.mask.outline();
        let on_outline = outline.iter().filter_map(|side| pixels.nearest(gaussians, view, *side));
        let found: Vec<Candidate> = on_outline
            .chain(pixels.inside(gaussians, view))
            .map(|(point, position_px)| Candidate { point, view_idx, position_px })
            .collect();
        found
    };
    let found: Vec<Vec<Candidate>> = silhouettes.views.par_iter().enumerate().map(of_view).collect();
    let fits_all = |candidate: &Candidate| {
        silhouettes.views.iter().all(|v| v.position_px(candidate.point).is_some_and(|px| v.mask.holds(px)))
    };
    found.into_par_iter().flatten_iter().filter(fits_all).collect()
}

/// The solid Gaussians in canonical order; all of them where fewer than a tenth are solid. Gaussians with equal means and
/// sizes count once.
fn solid(gaussians: &Gaussians) -> Vec<usize> {
    let above = |least: f32| (0..gaussians.len()).filter(|&i| gaussians.opacities[i] >= least).collect::<Vec<_>>();
    let chosen = above(SOLID_OPACITY);
    let mut chosen = if chosen.len() * 10 >= gaussians.len() { chosen } else { above(0.0) };
    let key = |&i: &usize| (gaussians.means[i].to_array(), gaussians.scales[i].to_array()).into_bits();
    chosen.sort_by_cached_key(key);
    chosen.dedup_by_key(|i| key(i));
    chosen
}

trait IntoBits {
    fn into_bits(self) -> [u32; 6];
}

impl IntoBits for ([f32; 3], [f32; 3]) {
    fn into_bits(self) -> [u32; 6] {
        let ([a, b, c], [d, e, f]) = self;
        [a, b, c, d, e, f].map(f32::to_bits)
    }
}

/// The largest Gaussians of each pixel of a view.
struct PixelIndex {
    size: usize,
    /// Per pixel: indices of Gaussians and the pixel positions of their means.
    gaussians: Vec<Vec<(usize, DVec2)>>,
}

impl PixelIndex {
    fn new(gaussians: &Gaussians, solid: &[usize], view: &View) -> Self {
        let size = view.mask.size;
        let mut index = Self { size, gaussians: vec![Vec::new(); size * size] };
        let weight = |i: usize| gaussians.opacities[i] * gaussians.scales[i].max_element();
        for &i in solid {
            let Some(px) = view.position_px(gaussians.mean_world(i)) else { continue };
            let Some(pixel) = index.pixel(px) else { continue };
            let held = &mut index.gaussians[pixel];
            let place = held.partition_point(|&(other, _)| weight(other) >= weight(i));
            if place < PER_PIXEL {
                held.insert(place, (i, px));
                held.truncate(PER_PIXEL);
            }
        }
        index
    }

    fn pixel(&self, px: DVec2) -> Option<usize> {
        let (x, y) = (px.x.floor(), px.y.floor());
        let limit = self.size as f64;
        ((0.0..limit).contains(&x) && (0.0..limit).contains(&y)).then(|| y as usize * self.size + x as usize)
    }

    /// The point nearest to a side of the outline, and its position.
    fn nearest(&self, gaussians: &Gaussians, view: &View, (middle, normal): (DVec2, DVec2)) -> Option<(DVec3, DVec2)> {
        let (x, y) = (middle.x.floor() as i64, middle.y.floor() as i64);
        let mut best: Option<(f64, DVec3, DVec2)> = None;
        for row in (y - REACH_PX).max(0)..=(y + REACH_PX).min(self.size as i64 - 1) {
            for column in (x - REACH_PX).max(0)..=(x + REACH_PX).min(self.size as i64 - 1) {
                for &(i, px) in &self.gaussians[row as usize * self.size + column as usize] {
                    let (point, at) = reached(gaussians, view, (i, px), (middle, normal));
                    let miss = at.distance(middle);
                    if best.is_none_or(|best| miss < best.0) {
                        best = Some((miss, point, at));
                    }
                }
            }
        }
        best.map(|(_, point, at)| (point, at))
    }

    /// Means inside the mask, one per square of [`INSIDE_STEP_PX`].
    fn inside(&self, gaussians: &Gaussians, view: &View) -> impl Iterator<Item = (DVec3, DVec2)> {
        let steps = || (INSIDE_STEP_PX / 2..self.size).step_by(INSIDE_STEP_PX);
        let pixels = steps().flat_map(move |y| steps().map(move |x| y * self.size + x));
        let found = pixels.filter(|&pixel| view.mask.inside[pixel]);
        found.filter_map(|pixel| self.gaussians[pixel].first()).map(|&(i, px)| (gaussians.mean_world(i), px))
    }
}

/// The point of a Gaussian's ellipsoids in the direction of an outline's normal that reaches the outline, at most
/// [`MAX_SIGMA`] and [`DILATION_PX`] from the mean, and its pixel position.
fn reached(
    gaussians: &Gaussians,
    view: &View,
    (i, px): (usize, DVec2),
    (middle, normal): (DVec2, DVec2),
) -> (DVec3, DVec2) {
    let missing_px = (middle - px).dot(normal);
    let mean = gaussians.mean_world(i);
    let direction = view.camera.pose.rotation * DVec3::new(normal.x, normal.y, 0.0);
    let (rotation, scale) = (gaussians.rotations[i].as_dquat(), gaussians.scales[i].as_dvec3());
    let local = scale * (rotation.conjugate() * direction);
    let sigma = local.length();
    let depth = view.camera.pose.to_camera(mean).z;
    let px_per_unit = view.camera.intrinsics.fy_px / depth;
    if !(missing_px > 0.0) {
        return (mean, px);
    }
    let on_ellipsoid = rotation * (scale * local) / sigma.max(f64::MIN_POSITIVE);
    let steps = (missing_px / (sigma * px_per_unit).max(f64::MIN_POSITIVE)).min(MAX_SIGMA);
    let left_px = (missing_px - steps * sigma * px_per_unit).clamp(0.0, DILATION_PX);
    let point = mean + on_ellipsoid * steps + direction * (left_px / px_per_unit);
    let at = view.position_px(point).unwrap_or(px);
    (point, at)
}

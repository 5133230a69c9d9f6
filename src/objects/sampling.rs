//! Subsets of points.

use std::collections::BTreeMap;

use cinesplat_geometry::Camera;
use glam::{DVec2, DVec3};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

use super::alpha_shape::AlphaShapes;

/// How the points of a cloud are chosen.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PointSampler {
    /// Where the silhouettes need them: points of the Gaussians' surfaces, added where shape and mask differ.
    Silhouette,
    /// The alpha shapes of all means, their borders by farthest point sampling.
    AlphaBorder,
    /// At random, seeded.
    Uniform,
    /// Farthest point sampling.
    Farthest,
    /// The mean nearest to the middle of each cell of a grid.
    VoxelGrid,
    /// The convex hulls of all views, by farthest point sampling.
    Hull,
}

impl PointSampler {
    /// All samplers, with their names.
    pub const ALL: [(Self, &'static str); 6] = [
        (Self::Silhouette, "silhouette"),
        (Self::AlphaBorder, "alpha border"),
        (Self::Uniform, "uniform"),
        (Self::Farthest, "farthest point"),
        (Self::VoxelGrid, "voxel grid"),
        (Self::Hull, "convex hull"),
    ];
}

/// Distinct points, sorted by coordinates: the result does not depend on the order of the input.
pub(crate) fn in_canonical_order(mut points: Vec<DVec3>) -> Vec<DVec3> {
    let order = |a: &DVec3, b: &DVec3| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)).then(a.z.total_cmp(&b.z));
    points.sort_unstable_by(order);
    points.dedup();
    points
}

/// At most `max_points` points by farthest point sampling, as [`farthest_indices`].
pub(crate) fn farthest_points(points: &[DVec3], max_points: usize) -> Vec<DVec3> {
    farthest_indices(points, max_points).into_iter().map(|i| points[i]).collect()
}

/// At most `max_points` points by farthest point sampling (Gonzalez 1985): first the point farthest from the mean, then
/// repeatedly the point farthest from all chosen ones. Ties go to the earlier point.
pub(crate) fn farthest_indices(points: &[DVec3], max_points: usize) -> Vec<usize> {
    if points.is_empty() || max_points == 0 {
        return Vec::new();
    }
    let middle = points.iter().sum::<DVec3>() / points.len() as f64;
    let mut gaps: Vec<f64> = points.iter().map(|p| p.distance_squared(middle)).collect();
    let mut chosen = Vec::with_capacity(max_points.min(points.len()));
    for round in 0..max_points.min(points.len()) {
        let farthest = (0..points.len()).rev().max_by(|&a, &b| gaps[a].total_cmp(&gaps[b])).unwrap_or(0);
        if round > 0 && gaps[farthest] <= 0.0 {
            break;
        }
        chosen.push(farthest);
        for (gap, point) in gaps.iter_mut().zip(points) {
            let apart = point.distance_squared(points[farthest]);
            *gap = if round == 0 { apart } else { gap.min(apart) };
        }
    }
    chosen
}

/// Points at random: the first ones of a seeded shuffle (Fisher and Yates).
pub(crate) fn uniform_points(points: &[DVec3], max_points: usize, seed: u64) -> Vec<DVec3> {
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    let mut chosen = points.to_vec();
    let count = max_points.min(chosen.len());
    for i in 0..count {
        let other = i + (random.next_u64() % (chosen.len() - i) as u64) as usize;
        chosen.swap(i, other);
    }
    chosen.truncate(count);
    chosen
}

/// One point per cell of the finest grid with at most `max_points` occupied cells: the one nearest to the cell's middle.
pub(crate) fn voxel_points(points: &[DVec3], max_points: usize) -> Vec<DVec3> {
    let low = points.iter().copied().reduce(DVec3::min).unwrap_or_default();
    let high = points.iter().copied().reduce(DVec3::max).unwrap_or_default();
    let extent = (high - low).max_element();
    let (mut least, mut most) = (1.0_f64, 4096.0_f64);
    let mut best = Vec::new();
    for _ in 0..16 {
        let num_cells = (least * most).sqrt();
        let found = one_per_cell(points, low, extent / num_cells);
        if found.len() <= max_points {
            (best, least) = (found, num_cells);
        } else {
            most = num_cells;
        }
    }
    best
}

fn one_per_cell(points: &[DVec3], low: DVec3, cell: f64) -> Vec<DVec3> {
    let mut nearest: BTreeMap<[i64; 3], (f64, DVec3)> = BTreeMap::new();
    for &point in points {
        let at = (point - low) / cell.max(f64::MIN_POSITIVE);
        let off = (at - at.floor() - 0.5).length_squared();
        let held = nearest.entry(at.floor().as_i64vec3().to_array()).or_insert((off, point));
        if off < held.0 {
            *held = (off, point);
        }
    }
    nearest.into_values().map(|(_, point)| point).collect()
}

/// The points on the border of the alpha shape of a radius (px; infinite: the convex hull) in at least one view.
pub(crate) fn border_points(points: &[DVec3], cameras: &[Camera], radius_px: f64) -> Vec<DVec3> {
    let mut is_on_border = vec![false; points.len()];
    for camera in cameras {
        let seen: Vec<(usize, DVec2)> =
            points.iter().enumerate().filter_map(|(i, &p)| camera.project(p).map(|(px, _)| (i, px))).collect();
        let positions_px: Vec<DVec2> = seen.iter().map(|(_, px)| *px).collect();
        for i in AlphaShapes::new(&positions_px).border(radius_px) {
            is_on_border[seen[i].0] = true;
        }
    }
    points.iter().zip(is_on_border).filter(|(_, on)| *on).map(|(p, _)| *p).collect()
}

//! What stands out from a level surface: plates, books, the feet of lamps.
//!
//! Enters: the voxels of a level surface, with what lies on it. Leaves: the surface, and whether a position stands out from it by
//! more than the surface is rough.

use std::collections::BTreeMap;

use glam::Vec3;

use super::median::median;
use super::voxels::VoxelGrid;

/// Width of the bins of heights, cells.
const BIN_CELLS: f32 = 0.2;

/// Distances from the plane of the voxels to which it is fitted, cells.
const FIT_CELLS: [f32; 3] = [0.5, 0.4, 0.3];

/// Height over a surface from which a voxel stands out from it, median distances of the voxels from the plane, and the least
/// and largest such height, cells.
const NUM_DEVIATIONS: f32 = 5.0;
const RELIEF_CELLS: (f32, f32) = (0.15, 0.6);

/// A nearly level plane.
pub(crate) struct Surface {
    /// A point on it.
    pub(crate) middle: Vec3,
    /// Rise along x and z.
    slope: (f32, f32),
    /// Height over it from which a position stands out.
    pub(crate) relief: f32,
}

impl Surface {
    /// The plane of most of a level surface: of its upper side, where the two sides of a board are both among the voxels.
    pub(crate) fn new(grid: &VoxelGrid, voxels: &[usize]) -> Self {
        let mut highest: BTreeMap<[i32; 2], Vec3> = BTreeMap::new();
        for &voxel in voxels {
            let [x, _, z] = grid.voxels[voxel].key;
            let p = grid.voxels[voxel].position;
            let held = highest.entry([x, z]).or_insert(p);
            if p.y > held.y {
                *held = p;
            }
        }
        let points: Vec<Vec3> = highest.into_values().collect();
        Self::of_points(&points, grid.cell)
    }

    /// The plane of most of some points, y up.
    pub(crate) fn of_points(points: &[Vec3], cell: f32) -> Self {
        let mut plane = Self { middle: fullest_height(points, cell), slope: (0.0, 0.0), relief: 0.0 };
        for reach in FIT_CELLS {
            plane.fit(points.iter().copied(), reach * cell);
        }
        let near = points.iter().map(|&p| plane.height(p).abs()).filter(|off| *off <= FIT_CELLS[0] * cell);
        plane.relief = (NUM_DEVIATIONS * median(near) / cell).clamp(RELIEF_CELLS.0, RELIEF_CELLS.1) * cell;
        plane
    }

    /// Height of a position over the plane.
    pub(crate) fn height(&self, p: Vec3) -> f32 {
        let step = p - self.middle;
        step.y - self.slope.0 * step.x - self.slope.1 * step.z
    }

    /// Whether a position stands out from the surface.
    pub(crate) fn is_raised(&self, p: Vec3) -> bool {
        self.height(p) > self.relief
    }

    /// Fits the plane to the points at most `reach` from it, by least squares.
    fn fit(&mut self, points: impl Iterator<Item = Vec3>, reach: f32) {
        let near: Vec<Vec3> = points.filter(|&p| self.height(p).abs() <= reach).collect();
        if near.is_empty() {
            return;
        }
        let mean = near.iter().sum::<Vec3>() / near.len() as f32;
        let [xx, xz, zz, xy, zy] = near.iter().map(|&p| p - mean).fold([0.0_f32; 5], |[xx, xz, zz, xy, zy], p| {
            [xx + p.x * p.x, xz + p.x * p.z, zz + p.z * p.z, xy + p.x * p.y, zy + p.z * p.y]
        });
        let determinant = xx * zz - xz * xz;
        self.middle = mean;
        if determinant > 1e-6 * xx * zz {
            self.slope = ((xy * zz - zy * xz) / determinant, (zy * xx - xy * xz) / determinant);
        }
    }
}

/// The mean of the points in the fullest bin of heights, of the higher one of two.
fn fullest_height(points: &[Vec3], cell: f32) -> Vec3 {
    let bin = |p: &Vec3| (p.y / (BIN_CELLS * cell)).floor() as i32;
    let mut bins: BTreeMap<i32, usize> = BTreeMap::new();
    points.iter().for_each(|p| *bins.entry(bin(p)).or_default() += 1);
    let around = |key: i32| [key - 1, key, key + 1].iter().filter_map(|key| bins.get(key)).sum::<usize>();
    let fullest = bins.keys().copied().max_by_key(|&key| (around(key), key)).unwrap_or(0);
    let near: Vec<Vec3> = points.iter().copied().filter(|p| (bin(p) - fullest).abs() <= 1).collect();
    near.iter().sum::<Vec3>() / near.len().max(1) as f32
}

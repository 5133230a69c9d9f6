//! The Gaussians at the borders of things.
//!
//! Enters: the ids of voxels. Leaves: the ids of Gaussians. A cell at a border holds Gaussians of two things: each belongs to the
//! one whose surface goes on through it, in color and in position.

use glam::Vec3;

use super::color;
use super::voxels::VoxelGrid;

/// Color difference that a distance of one cell from a surface counts.
const OFF_SURFACE: f32 = 30.0;

/// Difference from which a Gaussian is not of its voxel's thing.
const MIN_DIFFERENCE: f32 = 4.0;

/// The voxels of things and of the background.
pub(crate) struct Borders<'a> {
    grid: &'a VoxelGrid,
    /// For every voxel the id of its thing; 0 for the background.
    ids: &'a [u16],
    /// Whether a voxel has a neighbor of another thing.
    is_border: Vec<bool>,
}

impl<'a> Borders<'a> {
    pub(crate) fn new(grid: &'a VoxelGrid, ids: &'a [u16]) -> Self {
        let is_border = (0..ids.len()).map(|v| grid.neighbors(v, 1).any(|other| ids[other] != ids[v])).collect();
        Self { grid, ids, is_border }
    }

    /// The id of a Gaussian at a position in a voxel.
    pub(crate) fn id(&self, voxel: usize, local: Vec3, color_lab: impl Fn() -> Vec3) -> u16 {
        let own = self.ids[voxel];
        if !self.is_border[voxel] {
            return own;
        }
        let color_lab = color_lab();
        // The id of every thing around and the least difference from its voxels.
        let mut around: Vec<(u16, f32)> = Vec::new();
        for other in self.grid.around(self.grid.voxels[voxel].key, 1) {
            let difference = self.difference(other, local, color_lab);
            let id = self.ids[other];
            match around.iter_mut().find(|(known, _)| *known == id) {
                Some((_, least)) => *least = least.min(difference),
                None => around.push((id, difference)),
            }
        }
        let of_own = around.iter().find(|(id, _)| *id == own).map_or(0.0, |held| held.1);
        let nearest = around.into_iter().min_by(|a, b| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0)));
        nearest.filter(|&(_, least)| least + MIN_DIFFERENCE < of_own).map_or(own, |(id, _)| id)
    }

    /// How far a Gaussian is from the surface in a voxel, in color and position.
    fn difference(&self, voxel: usize, local: Vec3, color_lab: Vec3) -> f32 {
        let voxel = &self.grid.voxels[voxel];
        let off = voxel.normal.dot(local - voxel.position).abs() / self.grid.cell;
        color::difference(color_lab, voxel.color_lab) + OFF_SURFACE * off
    }
}

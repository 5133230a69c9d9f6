//! The structure of a scene: the voxels of floor, walls and ceiling.

use super::planes::{PlaneKind, ScenePlane};
use super::settings::FindSettings;
use super::voxels::VoxelGrid;

/// Thickness of floor, walls and ceiling, cells: voxels this near to one of them belong to it.
const STRUCTURE_CELLS: f32 = 1.0;

/// Depth behind a wall or under a floor up to which voxels are background too, over the scene size.
const BEHIND_FRAC: f64 = 0.1;

/// For every voxel whether it belongs to floor, walls or ceiling.
pub(crate) fn structure(grid: &VoxelGrid, planes: &[ScenePlane], settings: &FindSettings) -> Vec<bool> {
    let behind = (BEHIND_FRAC * settings.resolution) as f32 * grid.cell;
    let mut is_structure = vec![false; grid.voxels.len()];
    for plane in planes.iter().filter(|plane| plane.kind != PlaneKind::Support) {
        if plane.kind != PlaneKind::Wall {
            plane.voxels.iter().for_each(|&voxel| is_structure[voxel] = true);
        }
        for (flag, voxel) in is_structure.iter_mut().zip(&grid.voxels) {
            let height = plane.height(voxel.position);
            *flag |= height < STRUCTURE_CELLS * grid.cell && height > -behind && plane.spans(voxel.position);
        }
    }
    is_structure
}

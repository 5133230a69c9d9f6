//! The background of a scene: floor, walls and ceiling; and its support planes, such as table tops.

use glam::Vec3;

use super::color;
use super::planes::{PlaneKind, ScenePlane};
use super::settings::FindSettings;
use super::voxels::VoxelGrid;

/// Thickness of floor, walls and ceiling, cells: voxels this near to one of them are background.
const STRUCTURE_CELLS: f32 = 1.0;

/// Depth behind a wall or under a floor up to which voxels are background too, over the scene size.
const BEHIND_FRAC: f64 = 0.1;

/// Growth of a table top beyond the voxels with a level normal, cells.
const TOP_GROWTH_CELLS: usize = 4;

/// Least color difference between a plain wall and a flat voxel of an object on it: a picture, a screen, a window.
const WALL_OBJECT_DIFFERENCE: f32 = 25.0;

/// Share of a wall's voxels that must have about the same color for the wall to be plain.
const PLAIN_FRAC: f32 = 0.75;

/// The role of a voxel, before voxels are grouped into objects.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum CellRole {
    /// Part of an object.
    Free,
    /// Background.
    Structure,
    /// On the support plane with this index.
    Support(usize),
}

/// The role of every voxel.
pub(crate) fn roles(grid: &VoxelGrid, planes: &[ScenePlane], settings: &FindSettings) -> Vec<CellRole> {
    let behind = (BEHIND_FRAC * settings.resolution) as f32 * grid.cell;
    let mut roles = vec![CellRole::Free; grid.voxels.len()];
    for (i, plane) in planes.iter().enumerate() {
        let role = if plane.kind == PlaneKind::Support { CellRole::Support(i) } else { CellRole::Structure };
        if plane.kind != PlaneKind::Wall {
            for &voxel in &plane.voxels {
                roles[voxel] = role;
            }
        }
    }
    grow_tops(grid, planes, &mut roles);
    for plane in planes.iter().filter(|plane| plane.kind != PlaneKind::Support) {
        let wall_color = plain_color(grid, plane);
        for (role, voxel) in roles.iter_mut().zip(&grid.voxels) {
            if wall_color.is_some_and(|color| color::difference(voxel.color_lab, color) > WALL_OBJECT_DIFFERENCE) {
                continue;
            }
            let height = plane.height(voxel.position);
            if height < STRUCTURE_CELLS * grid.cell && height > -behind && plane.spans(voxel.position) {
                *role = CellRole::Structure;
            }
        }
    }
    roles
}

/// Grows table tops by the adjacent voxels at their height, regardless of their normals. Voxels at the edge of a top or
/// under an object on it would otherwise connect the object with the table.
fn grow_tops(grid: &VoxelGrid, planes: &[ScenePlane], roles: &mut [CellRole]) {
    for (i, plane) in planes.iter().enumerate().filter(|(_, plane)| plane.kind == PlaneKind::Support) {
        let mut edge = plane.voxels.clone();
        for _ in 0..TOP_GROWTH_CELLS {
            let mut beside: Vec<usize> = edge.iter().flat_map(|&voxel| grid.neighbors(voxel, 1)).collect();
            beside.sort_unstable();
            beside.dedup();
            beside.retain(|&v| roles[v] == CellRole::Free && plane.height(grid.voxels[v].position).abs() <= grid.cell);
            for &voxel in &beside {
                roles[voxel] = CellRole::Support(i);
            }
            edge = beside;
        }
    }
}

/// The color of a plain wall. `None` for patterned walls, whose pattern must not count as objects, and for other
/// planes.
fn plain_color(grid: &VoxelGrid, plane: &ScenePlane) -> Option<Vec3> {
    let colors: Vec<Vec3> = plane.voxels.iter().map(|&v| grid.voxels[v].color_lab).collect();
    let median = color::median(&colors);
    let plain = |&&v: &&usize| color::difference(grid.voxels[v].color_lab, median) <= WALL_OBJECT_DIFFERENCE;
    let share = plane.voxels.iter().filter(plain).count() as f32 / plane.voxels.len().max(1) as f32;
    (plane.kind == PlaneKind::Wall && share >= PLAIN_FRAC).then_some(median)
}

//! The objects of a capture with walls but without a ceiling, such as a kitchen seen from its middle.
//!
//! Enters: voxels and planes. Leaves: groups of voxels. Such captures are cluttered and their surfaces are rough: tops are
//! large level planes of the whole scene, and what hangs on a wall is told from it by color.

use super::groups::VoxelGroup;
use super::open_background::{CellRole, roles};
use super::pieces::{attach, split};
use super::planes::ScenePlane;
use super::segmentation::components;
use super::settings::FindSettings;
use super::standing::owners;
use super::tidying::tidy;
use super::voxels::VoxelGrid;

/// Least share of the voxels under a table top that belong to one body, for the top and the body to be one object.
const BODY_FRAC: f64 = 0.6;

/// Groups the voxels of an open room.
pub(crate) fn group(grid: &VoxelGrid, planes: &[ScenePlane], settings: &FindSettings) -> Vec<VoxelGroup> {
    let roles = roles(grid, planes, settings);
    let of = |wanted: CellRole| (0..roles.len()).filter(|&v| roles[v] == wanted).collect::<Vec<_>>();
    let max_diagonal = settings.split_frac * settings.resolution;
    let mut bodies = Vec::new();
    let mut fragments = Vec::new();
    for component in components(grid, &of(CellRole::Free), 1) {
        for piece in split(grid, component, max_diagonal, settings) {
            if piece.len() < settings.min_voxels { fragments.extend(piece) } else { bodies.push(piece) }
        }
    }
    fragments.sort_unstable();
    let (large, small): (Vec<_>, Vec<_>) =
        components(grid, &fragments, 2).into_iter().partition(|component| component.len() >= settings.min_voxels);
    bodies.extend(large);
    attach(grid, small, &mut bodies);
    let mut groups: Vec<VoxelGroup> = bodies.into_iter().map(|voxels| VoxelGroup::whole(voxels, false)).collect();
    for plane in 0..planes.len() {
        for top in components(grid, &of(CellRole::Support(plane)), 1) {
            add_top(grid, top, &mut groups, settings.min_voxels);
        }
    }
    tidy(grid, planes, groups)
}

/// Adds a level piece to the body below it. A piece above several bodies or none becomes an object where it is large
/// enough.
fn add_top(grid: &VoxelGrid, top: Vec<usize>, groups: &mut Vec<VoxelGroup>, min_voxels: usize) {
    let owner = owners(grid, groups.iter().map(|group| &group.voxels));
    let mut contacts = vec![0_usize; groups.len()];
    for &voxel in &top {
        let level = grid.voxels[voxel].key[1];
        for below in grid.neighbors(voxel, 2).filter(|&other| grid.voxels[other].key[1] < level) {
            if let Some(count) = contacts.get_mut(owner[below]) {
                *count += 1;
            }
        }
    }
    let total: usize = contacts.iter().sum();
    let carrier = (0..contacts.len()).max_by_key(|&i| (contacts[i], std::cmp::Reverse(i)));
    match carrier.filter(|&i| contacts[i] as f64 >= BODY_FRAC * total as f64 && total > 0) {
        Some(body) => groups[body].voxels.extend(top),
        None if top.len() >= min_voxels => groups.push(VoxelGroup::whole(top, true)),
        None => {}
    }
}

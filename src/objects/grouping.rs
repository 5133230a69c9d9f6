//! Voxels become objects.
//!
//! Enters: voxels and the scene's planes. Leaves: disjoint groups of voxels, one per object.

use super::background::structure;
use super::groups::VoxelGroup;
use super::parts::divide;
use super::pieces::{drop_lumps, isolated_objects};
use super::planes::{PlaneKind, ScenePlane, is_closed_room};
use super::settings::FindSettings;
use super::surroundings::surrounds;
use super::voxels::VoxelGrid;
use super::{closed_room, open_room};
use cinesplat_scene::Gaussians;

/// Groups the voxels of a scene into objects, by the kind of capture: a closed room has a floor, and a ceiling or
/// walls on four sides; an open room has walls; every other capture shows single things, each a connected component.
pub(crate) fn group(
    grid: &VoxelGrid,
    planes: &[ScenePlane],
    gaussians: &Gaussians,
    settings: &FindSettings,
) -> Vec<VoxelGroup> {
    let is_wall = |plane: &ScenePlane| matches!(plane.kind, PlaneKind::Wall | PlaneKind::Ceiling);
    let has_walls = planes.iter().any(is_wall);
    // The sides and the back of an armchair are walls only from its seat.
    let is_room = has_walls && surrounds(grid);
    if is_room && is_closed_room(planes) {
        return to_detail(grid, closed_room::group(grid, planes, gaussians, settings), settings, 2);
    }
    if is_room {
        return to_detail(grid, open_room::group(grid, planes, settings), settings, 2);
    }
    // Without a room around them, upright planes are sides of things.
    let ground: Vec<ScenePlane> = planes.iter().filter(|plane| !is_wall(plane)).cloned().collect();
    let is_structure = structure(grid, &ground, settings);
    let free: Vec<usize> = (0..is_structure.len()).filter(|&voxel| !is_structure[voxel]).collect();
    let mut objects = isolated_objects(grid, &free);
    drop_lumps(grid, &ground, &mut objects);
    let wholes = objects.into_iter().map(|voxels| VoxelGroup::whole(voxels, false)).collect();
    to_detail(grid, wholes, settings, 1)
}

/// Divides wholes into parts from the detail `parts_from` on; at detail 0 parts become one with their whole.
fn to_detail(
    grid: &VoxelGrid,
    mut groups: Vec<VoxelGroup>,
    settings: &FindSettings,
    parts_from: u8,
) -> Vec<VoxelGroup> {
    if settings.detail >= parts_from {
        divide(grid, &mut groups);
    } else if settings.detail == 0 {
        for i in (0..groups.len()).rev() {
            if let Some(whole) = groups[i].parent {
                let moved = std::mem::take(&mut groups[i].voxels);
                groups[whole].voxels.extend(moved);
            }
        }
        groups.retain(|group| !group.voxels.is_empty());
        groups.iter_mut().for_each(|group| group.parent = None);
    }
    groups
}

//! Flat regions that belong to a thing before them: the back of a shelf, the contact shade of a plant.
//!
//! Enters: the flat things of floor and walls, and the groups of a room. Leaves: the flat things that are things of their
//! own.

use glam::Vec3;

use super::groups::VoxelGroup;
use super::loose::inside_frac;
use super::pieces::contacts;
use super::standing::{extent, owners};
use super::voxels::VoxelGrid;

/// Least share of a flat thing inside the box of the thing before it.
const INSIDE_FRAC: f32 = 0.85;

/// Least share of a flat thing's voxels that touch the thing before it.
const TOUCHING_FRAC: f32 = 0.2;

/// Adds every flat thing that lies inside the box of a group, and touches it, to the group; returns the others.
pub(crate) fn absorb_backs(grid: &VoxelGrid, flats: Vec<Vec<usize>>, groups: &mut [VoxelGroup]) -> Vec<Vec<usize>> {
    let owner = owners(grid, groups.iter().map(|group| &group.voxels));
    // What joins a group does not make its box larger.
    let boxes: Vec<(Vec3, Vec3)> = groups.iter().map(|group| extent(grid, &group.voxels)).collect();
    let mut others = Vec::new();
    for flat in flats {
        let least = TOUCHING_FRAC * flat.len() as f32;
        let around = contacts(grid, &flat, &owner, 2);
        let mut order: Vec<(usize, usize)> = around.into_iter().collect();
        order.sort_by_key(|&(group, count)| (std::cmp::Reverse(count), group));
        let holds = |&(group, _): &(usize, usize)| {
            let touching = |&&v: &&usize| grid.neighbors(v, 2).any(|other| owner[other] == group);
            flat.iter().filter(touching).count() as f32 >= least
                && inside_frac(grid, &flat, boxes[group]) >= INSIDE_FRAC
        };
        match order.into_iter().find(holds) {
            Some((group, _)) => groups[group].voxels.extend(flat),
            None => others.push(flat),
        }
    }
    others
}

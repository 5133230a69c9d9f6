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
        let touching = |groups: &[usize]| {
            let touches = |&&v: &&usize| grid.neighbors(v, 2).any(|other| groups.contains(&owner[other]));
            flat.iter().filter(touches).count() as f32
        };
        let inside = |groups: &[usize]| {
            let holder = |&v: &usize| {
                let holds = |&&group: &&usize| inside_frac(grid, &[v], boxes[group]) > 0.0;
                groups.iter().find(holds).copied()
            };
            flat.iter().map(holder).collect::<Vec<Option<usize>>>()
        };
        let holds = |groups: &[usize]| {
            touching(groups) >= least
                && inside(groups).iter().flatten().count() as f32 >= INSIDE_FRAC * flat.len() as f32
        };
        let all: Vec<usize> = order.iter().map(|&(group, _)| group).collect();
        let one = all.iter().copied().find(|&group| holds(&[group]));
        match one {
            Some(group) => groups[group].voxels.extend(flat),
            // The backs of shelves side by side.
            None if all.len() > 1 && holds(&all) => {
                for (voxel, holder) in flat.iter().zip(inside(&all)) {
                    if let Some(group) = holder {
                        groups[group].voxels.push(*voxel);
                    }
                }
            }
            None => others.push(flat),
        }
    }
    others
}

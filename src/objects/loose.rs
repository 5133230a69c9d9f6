//! Loose pieces of a thing: a leaf of a plant whose stalk is thinner than a cell.
//!
//! Enters: groups. Leaves: the same groups, each loose piece joined with the thing around it. A piece is loose if it is small,
//! lies in the thing's box, and touches nothing but other such pieces: what stands or hangs somewhere touches that.

use glam::Vec3;

use super::groups::VoxelGroup;
use super::standing::{extent, owners};
use super::voxels::VoxelGrid;

/// Largest size of a loose piece over that of the thing around it.
const MAX_SIZE: f32 = 0.1;

/// Least share of a loose piece inside the box of the thing, and largest share of it that touches anything else.
const INSIDE_FRAC: f32 = 0.85;
const MAX_TOUCHING: f32 = 0.25;

/// Distance of voxels that touch, cells.
const REACH: i32 = 2;

/// Joins every loose piece with the smallest thing around it.
pub(crate) fn join_loose(grid: &VoxelGrid, groups: &mut Vec<VoxelGroup>) {
    let owner = owners(grid, groups.iter().map(|group| &group.voxels));
    let boxes: Vec<(Vec3, Vec3)> = groups.iter().map(|group| extent(grid, &group.voxels)).collect();
    let around = |piece: usize| {
        let least = groups[piece].voxels.len() as f32 / MAX_SIZE;
        let holds = |&whole: &usize| {
            let group = &groups[whole];
            !group.is_surface
                && group.voxels.len() as f32 >= least
                && inside_frac(grid, &groups[piece].voxels, boxes[whole]) >= INSIDE_FRAC
        };
        (0..groups.len()).filter(holds).min_by_key(|&whole| (groups[whole].voxels.len(), whole))
    };
    let wholes: Vec<Option<usize>> = (0..groups.len()).map(around).collect();
    let is_loose = |piece: usize, whole: usize| {
        let is_other = |other: usize| {
            let other = owner[other];
            other != piece && (other == usize::MAX || wholes[other] != Some(whole))
        };
        let touches = |&&voxel: &&usize| grid.neighbors(voxel, REACH).any(is_other);
        let voxels = &groups[piece].voxels;
        voxels.iter().filter(touches).count() as f32 <= MAX_TOUCHING * voxels.len() as f32
    };
    let joins = wholes.iter().enumerate().filter_map(|(piece, &whole)| Some((piece, whole?)));
    let joins: Vec<(usize, usize)> = joins.filter(|&(piece, whole)| is_loose(piece, whole)).collect();
    // Every whole is ten times as large as its piece, so that chains of joins end.
    for &(piece, mut whole) in &joins {
        while let Ok(next) = joins.binary_search_by_key(&whole, |join| join.0) {
            whole = joins[next].1;
        }
        let moved = std::mem::take(&mut groups[piece].voxels);
        groups[whole].voxels.extend(moved);
    }
    groups.retain(|group| !group.voxels.is_empty());
}

/// Share of some voxels inside a box.
pub(crate) fn inside_frac(grid: &VoxelGrid, voxels: &[usize], (low, high): (Vec3, Vec3)) -> f32 {
    let (low, high) = (low - 2.0 * grid.cell, high + 2.0 * grid.cell);
    let is_inside = |p: Vec3| p.cmpge(low).all() && p.cmple(high).all();
    voxels.iter().filter(|&&v| is_inside(grid.voxels[v].position)).count() as f32 / voxels.len().max(1) as f32
}

//! Bodies that rest on nothing: what carries them is too thin for a voxel.
//!
//! Enters: the bodies of a room. Leaves: the same bodies, each that rests on one other body alone joined with it.

use std::collections::BTreeMap;

use rayon::prelude::*;

use super::segmentation::DisjointSets;
use super::standing::{extent, lowest, owners};
use super::tops::Top;
use super::voxels::VoxelGrid;

/// Share of a body's height, from below, in which it must touch what carries it.
const FOOT_FRAC: f32 = 0.3;

/// Distances, cells, over which a body that touches nothing else is joined with the body below it.
const GAPS: [i32; 2] = [3, 6];

/// Owner of a voxel of the structure or of a top.
const ON_TOP: usize = usize::MAX - 1;

/// Joins every body that rests on nothing but one other body with it: the shade of a lamp with its pole, a crown with
/// its pot. What stands on tops, touches structure or is the lower one stays alone.
pub(crate) fn join_floating(
    grid: &VoxelGrid,
    bodies: &[Vec<usize>],
    tops: &[Top],
    is_structure: &[bool],
) -> Vec<Vec<usize>> {
    let mut owner = owners(grid, bodies);
    tops.iter().flat_map(|top| &top.voxels).for_each(|&voxel| owner[voxel] = ON_TOP);
    (0..owner.len()).filter(|&voxel| is_structure[voxel]).for_each(|voxel| owner[voxel] = ON_TOP);
    let lowest: Vec<f32> = bodies.iter().map(|body| lowest(grid, body)).collect();
    let carrier =
        |body: usize| carrier(grid, &bodies[body], (body, &owner)).filter(|&carrier| lowest[carrier] < lowest[body]);
    let carriers: Vec<Option<usize>> = (0..bodies.len()).into_par_iter().map(carrier).collect();
    let mut sets = DisjointSets::new(bodies.len());
    for (body, carrier) in carriers.iter().enumerate() {
        if let Some(carrier) = carrier {
            sets.join(body, *carrier);
        }
    }
    let all: Vec<usize> = (0..bodies.len()).collect();
    let union = |set: Vec<usize>| set.into_iter().flat_map(|body| bodies[body].iter().copied()).collect();
    sets.groups(&all).into_iter().map(union).collect()
}

/// The other body that the lower part of a body touches most; `None` where it touches a top or the structure, or
/// nothing. A body's voxels have its index as their owner.
fn carrier(grid: &VoxelGrid, voxels: &[usize], (body, owner): (usize, &[usize])) -> Option<usize> {
    let (low, high) = extent(grid, voxels);
    let end = low.y + FOOT_FRAC * (high.y - low.y);
    let foot: Vec<usize> = voxels.iter().copied().filter(|&v| grid.voxels[v].position.y <= end).collect();
    for reach in GAPS {
        let mut touched: BTreeMap<usize, usize> = BTreeMap::new();
        for other in foot.iter().flat_map(|&v| grid.neighbors(v, reach)).map(|other| owner[other]) {
            if other == ON_TOP {
                return None;
            }
            if other != body && other != usize::MAX {
                *touched.entry(other).or_default() += 1;
            }
        }
        let most = touched.iter().max_by_key(|&(&other, &count)| (count, std::cmp::Reverse(other)));
        if let Some((&other, _)) = most {
            return Some(other);
        }
    }
    None
}

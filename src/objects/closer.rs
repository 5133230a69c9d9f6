//! Things on a top that are closer to each other than a cell: a radio beside a stack of books.
//!
//! Enters: bodies that stand on tops, and their Gaussians. Leaves: the same bodies, those of several things in pieces. In cells half
//! as large the things come apart; what does not stand on the top belongs to the nearest thing that does.

use glam::Vec3;

use super::segmentation::components;
use super::standing::{extent, footprint_area, lowest, owners};
use super::voxels::VoxelGrid;
use cinesplat_scene::Gaussians;

/// Least number of small voxels of a thing, and least share of those of its body.
const MIN_VOXELS: usize = 40;
const MIN_SHARE: f32 = 0.08;

/// Largest share of the footprint of a thing over that of another one.
const MAX_SHARED: f32 = 0.5;

/// Largest height of the foot of a thing over the top, cells.
const FOOT_CELLS: f32 = 1.5;

/// The bodies, each thing apart. `heights` are those of the tops under them.
pub(crate) fn seen_closer(
    grid: &VoxelGrid,
    gaussians: &Gaussians,
    bodies: Vec<Vec<usize>>,
    heights: &[f32],
) -> Vec<Vec<usize>> {
    if bodies.is_empty() {
        return bodies;
    }
    let owner = owners(grid, &bodies);
    let mut members: Vec<Vec<usize>> = vec![Vec::new(); bodies.len()];
    for i in 0..gaussians.len() {
        let voxel = grid.find(grid.key_at(grid.to_local(gaussians.mean_world(i))));
        if let Some(list) = voxel.and_then(|voxel| members.get_mut(owner[voxel])) {
            list.push(i);
        }
    }
    let mut apart = Vec::new();
    for ((body, members), &height) in bodies.into_iter().zip(members).zip(heights) {
        let fine = grid.halved(&gaussians.plain_subset(&members));
        let things = things(&fine, height + FOOT_CELLS * grid.cell);
        if things.len() < 2 {
            apart.push(body);
            continue;
        }
        let mut pieces: Vec<Vec<usize>> = vec![Vec::new(); things.len()];
        for voxel in body {
            pieces[nearest(&fine, grid.voxels[voxel].position, &things)].push(voxel);
        }
        apart.extend(pieces.into_iter().filter(|piece| !piece.is_empty()));
    }
    apart
}

/// The things that stand below a height, with what is nearest to them.
fn things(fine: &VoxelGrid, height: f32) -> Vec<Vec<usize>> {
    let all: Vec<usize> = (0..fine.voxels.len()).collect();
    let least = MIN_VOXELS.max((MIN_SHARE * all.len() as f32) as usize);
    let stands = |piece: &Vec<usize>| piece.len() >= least && lowest(fine, piece) <= height;
    let (standing, others): (Vec<_>, Vec<_>) = components(fine, &all, 1).into_iter().partition(stands);
    let mut things: Vec<Vec<usize>> = Vec::new();
    for piece in standing {
        // The foot of a plate inside its rim is no thing of its own.
        let own = extent(fine, &piece);
        match things.iter_mut().find(|thing| is_around(extent(fine, thing), own)) {
            Some(thing) => thing.extend(piece),
            None => things.push(piece),
        }
    }
    if things.len() > 1 {
        let of_things = things.clone();
        for piece in others {
            let middle = piece.iter().map(|&v| fine.voxels[v].position).sum::<Vec3>() / piece.len() as f32;
            things[nearest(fine, middle, &of_things)].extend(piece);
        }
    }
    things
}

/// Whether two boxes share much of the smaller one's footprint.
fn is_around(one: (Vec3, Vec3), other: (Vec3, Vec3)) -> bool {
    let shared = footprint_area((one.0.max(other.0), one.1.min(other.1)));
    shared > MAX_SHARED * footprint_area(one).min(footprint_area(other))
}

/// The thing that is nearest to a place.
fn nearest(fine: &VoxelGrid, place: Vec3, things: &[Vec<usize>]) -> usize {
    let distance = |thing: &Vec<usize>| {
        thing.iter().map(|&v| fine.voxels[v].position.distance_squared(place)).fold(f32::INFINITY, f32::min)
    };
    let distances: Vec<f32> = things.iter().map(distance).collect();
    (0..things.len()).min_by(|&a, &b| distances[a].total_cmp(&distances[b])).unwrap_or(0)
}

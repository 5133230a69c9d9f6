//! Bodies that rest on nothing: what carries them is too thin for a voxel.
//!
//! Enters: the bodies of a room. Leaves: the same bodies, each that rests on one other body alone joined with it.

use std::collections::BTreeMap;

use glam::Vec3;
use rayon::prelude::*;

use super::planes::{PlaneKind, ScenePlane};
use super::segmentation::DisjointSets;
use super::standing::{extent, lowest, owners};
use super::tops::Top;
use super::voxels::VoxelGrid;

/// Share of a body's height, from below, in which it must touch what carries it.
const FOOT_FRAC: f32 = 0.3;

/// Distances, cells, over which a body that touches nothing else is joined with the body below it.
const GAPS: [i32; 2] = [3, 6];

/// Owner of a voxel of a floor or a ceiling, of a wall, and of a top.
const FIXED: usize = usize::MAX - 1;
const WALL: usize = usize::MAX - 2;
const TOP: usize = usize::MAX - 3;

/// Share of a body's voxels near a wall from which it hangs on the wall: leaves only brush it.
const HUNG_FRAC: f32 = 0.25;

/// Distance from a wall at which a body hangs on it, and from a ceiling, cells.
const HUNG_CELLS: i32 = 2;

/// Joins every body that rests on nothing but one other body with it: the shade of a lamp with its pole, a crown with
/// its pot. What stands on tops or the floor, hangs on a wall or from the ceiling, or is the lower one stays alone.
pub(crate) fn join_floating(
    grid: &VoxelGrid,
    bodies: &[Vec<usize>],
    tops: &[Top],
    (is_structure, planes): (&[bool], &[ScenePlane]),
) -> Vec<Vec<usize>> {
    let mut owner = owners(grid, bodies);
    tops.iter().flat_map(|top| &top.voxels).for_each(|&voxel| owner[voxel] = TOP);
    let is_level = |voxel: usize| {
        let p = grid.voxels[voxel].position;
        let level = |plane: &&ScenePlane| matches!(plane.kind, PlaneKind::Floor | PlaneKind::Ceiling);
        planes.iter().filter(level).any(|plane| plane.height(p) < LEVEL_CELLS * grid.cell)
    };
    for voxel in (0..owner.len()).filter(|&voxel| is_structure[voxel]) {
        owner[voxel] = if is_level(voxel) { FIXED } else { WALL };
    }
    let lowest: Vec<f32> = bodies.iter().map(|body| lowest(grid, body)).collect();
    let extents: Vec<(Vec3, Vec3)> = bodies.iter().map(|body| extent(grid, body)).collect();
    let carrier = |body: usize| match hold(grid, &bodies[body], (body, &owner)) {
        Hold::Body(carrier) => Some(carrier).filter(|&carrier| lowest[carrier] < lowest[body]),
        Hold::BodyUnderTop(carrier) => Some(carrier).filter(|&carrier| {
            let (foot, own) = (extents[carrier], extents[body]);
            // The stem of a plant is thinner than its pot.
            let is_upright = is_on_axis(grid, foot, own) || (is_on_axis(grid, own, foot) && is_round(foot));
            lowest[carrier] < lowest[body] && is_upright && is_round(own)
        }),
        Hold::Nothing => foot_below(grid, &extents, body).or_else(|| beside(grid, &bodies[body], (body, &owner))),
        // The crown of a plant in a corner leans on the walls.
        Hold::Wall => foot_below(grid, &extents, body).filter(|_| is_round(extents[body])),
        Hold::Fixed => None,
    };
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

/// Height over a floor, or depth under a ceiling, up to which the structure is level, cells.
const LEVEL_CELLS: f32 = 1.5;

/// What holds a body.
enum Hold {
    /// A top, the floor or the ceiling.
    Fixed,
    /// A wall.
    Wall,
    /// The other body that its lower part touches most.
    Body(usize),
    /// The same, and a top lies on the body: an apron and a leg of one table, or a crown with a large level leaf and its pot.
    BodyUnderTop(usize),
    /// Its lower part touches nothing.
    Nothing,
}

/// What holds a body, whose voxels have its index as their owner.
fn hold(grid: &VoxelGrid, voxels: &[usize], (body, owner): (usize, &[usize])) -> Hold {
    let (low, high) = extent(grid, voxels);
    let end = low.y + FOOT_FRAC * (high.y - low.y);
    let is_under_top = match hung(grid, voxels, owner) {
        Hung::Ceiling => return Hold::Fixed,
        Hung::Wall => return Hold::Wall,
        Hung::Top => true,
        Hung::Not => false,
    };
    let foot: Vec<usize> = voxels.iter().copied().filter(|&v| grid.voxels[v].position.y <= end).collect();
    for reach in GAPS {
        let touched = touched(grid, &foot, (body, owner), reach);
        if is_fixed(&touched) {
            return Hold::Fixed;
        }
        if let Some(other) = most(&touched) {
            return if is_under_top { Hold::BodyUnderTop(other) } else { Hold::Body(other) };
        }
    }
    if is_under_top { Hold::Fixed } else { Hold::Nothing }
}

/// The other body that all of a body touches most.
fn beside(grid: &VoxelGrid, voxels: &[usize], own: (usize, &[usize])) -> Option<usize> {
    let touched = touched(grid, voxels, own, GAPS[1]);
    most(&touched).filter(|_| !is_fixed(&touched))
}

/// The number of contacts with every other owner but walls.
fn touched(grid: &VoxelGrid, part: &[usize], (body, owner): (usize, &[usize]), reach: i32) -> BTreeMap<usize, usize> {
    let mut touched: BTreeMap<usize, usize> = BTreeMap::new();
    let owners = part.iter().flat_map(|&v| grid.neighbors(v, reach)).map(|other| owner[other]);
    for other in owners.filter(|&other| other != body && other != usize::MAX && other != WALL) {
        *touched.entry(other).or_default() += 1;
    }
    touched
}

fn is_fixed(touched: &BTreeMap<usize, usize>) -> bool {
    touched.contains_key(&FIXED) || touched.contains_key(&TOP)
}

fn most(touched: &BTreeMap<usize, usize>) -> Option<usize> {
    let bodies = touched.iter().filter(|(other, _)| ![FIXED, TOP].contains(*other));
    bodies.max_by_key(|&(&other, &count)| (count, std::cmp::Reverse(other))).map(|(&other, _)| other)
}

/// Largest distance between the middles of a body and of its foot, seen from above, over the size of the body there.
const ALIGNED_FRAC: f32 = 0.15;

/// Largest gap between a body and its foot, over the height of the body: what hangs over a table is farther from it.
const MAX_GAP: f32 = 1.5;

/// Largest depth of a body in its foot, over the height of the body: leaves hang over the rim of a pot.
const SUNK_FRAC: f32 = 0.15;

/// The body under a body that touches nothing, on the same upright axis: the foot of a lamp whose pole was not captured.
fn foot_below(grid: &VoxelGrid, extents: &[(Vec3, Vec3)], body: usize) -> Option<usize> {
    let (low, high) = extents[body];
    let is_foot = |&other: &usize| {
        let top = extents[other].1.y;
        let height = high.y - low.y;
        let is_near = (-SUNK_FRAC * height..=MAX_GAP * height).contains(&(low.y - top));
        other != body && is_near && is_on_axis(grid, extents[other], extents[body])
    };
    (0..extents.len()).filter(is_foot).max_by(|&a, &b| extents[a].1.y.total_cmp(&extents[b].1.y).then(b.cmp(&a)))
}

/// Whether a foot is about as wide as the body over it at most, on the same upright axis.
fn is_on_axis(grid: &VoxelGrid, (bottom, top): (Vec3, Vec3), (low, high): (Vec3, Vec3)) -> bool {
    let level = |v: Vec3| Vec3::new(v.x, 0.0, v.z);
    let width = level(high - low).length();
    let apart = level(low + high - bottom - top).length() / 2.0;
    level(top - bottom).length() <= 1.2 * width && apart <= ALIGNED_FRAC * width + grid.cell
}

/// Least depth of a round body over its width.
const ROUND_FRAC: f32 = 0.5;

/// Whether a body is about as deep as wide: what hangs on a wall is flat.
fn is_round((low, high): (Vec3, Vec3)) -> bool {
    let sides = high - low;
    sides.x.min(sides.z) >= ROUND_FRAC * sides.x.max(sides.z)
}

/// How a body hangs.
enum Hung {
    /// On the ceiling above it.
    Ceiling,
    Wall,
    /// A top lies on it.
    Top,
    Not,
}

/// What a body hangs on.
fn hung(grid: &VoxelGrid, voxels: &[usize], owner: &[usize]) -> Hung {
    let (mut num_near, mut is_under_top) = (0, false);
    for &voxel in voxels {
        let y = grid.voxels[voxel].key[1];
        let mut is_near = false;
        for other in grid.neighbors(voxel, HUNG_CELLS) {
            let is_above = grid.voxels[other].key[1] > y;
            if owner[other] == FIXED && is_above {
                return Hung::Ceiling;
            }
            is_under_top |= owner[other] == TOP && is_above;
            is_near |= owner[other] == WALL;
        }
        num_near += usize::from(is_near);
    }
    if is_under_top {
        Hung::Top
    } else if num_near as f32 >= HUNG_FRAC * voxels.len() as f32 {
        Hung::Wall
    } else {
        Hung::Not
    }
}

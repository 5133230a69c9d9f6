//! Things that touch each other on a top: a bottle beside a plant.
//!
//! Enters: the bodies of a room and its tops. Leaves: the same bodies, those of several things in pieces. A thing of a table
//! stands on it, has its own color, and touches its neighbor with little of itself.

use std::collections::BTreeMap;

use super::closer::seen_closer;
use super::color;
use super::pieces::{contacts, diagonal};
use super::segmentation::split_by_color;
use super::standing::{lowest, mean_color, owners};
use super::tops::Top;
use super::voxels::VoxelGrid;
use cinesplat_scene::Gaussians;

/// Scale and least size of the regions of one color of a body.
const SCALE: f32 = 140.0;
const MIN_VOXELS: usize = 8;

/// Largest diagonal of a body of small things, cells.
const MAX_DIAGONAL: f64 = 40.0;

/// Least number of voxels of a thing on the top.
const MIN_STANDING: usize = 3;

/// Depth below a top to which a thing that stands on it may reach, cells.
const SUNK_CELLS: f32 = 1.6;

/// Least color difference between two things, and largest share of the smaller one's voxels that touch the other one.
const MIN_DIFFERENCE: f32 = 12.0;
const MAX_TOUCHING: f32 = 0.3;

/// The bodies, each thing on a top apart.
pub(crate) fn separate(
    grid: &VoxelGrid,
    gaussians: &Gaussians,
    bodies: Vec<Vec<usize>>,
    tops: &[Top],
) -> Vec<Vec<usize>> {
    let on_top = owners(grid, tops.iter().map(|top| &top.voxels));
    let stands = |voxel: usize| {
        let level = grid.voxels[voxel].key[1];
        grid.neighbors(voxel, 1).any(|other| on_top[other] != usize::MAX && grid.voxels[other].key[1] <= level)
    };
    let standing = |piece: &[usize]| piece.iter().filter(|&&voxel| stands(voxel)).count();
    let top_under = |body: &[usize]| {
        let near = body.iter().flat_map(|&voxel| grid.neighbors(voxel, 1)).map(|other| on_top[other]);
        near.filter(|&top| top != usize::MAX).map(|top| tops[top].height).fold(f32::INFINITY, f32::min)
    };
    let (mut apart, mut close) = (Vec::new(), Vec::new());
    for body in bodies {
        let is_small = || diagonal(grid, body.iter().copied()) <= MAX_DIAGONAL;
        let is_on_top = || lowest(grid, &body) > top_under(&body) - SUNK_CELLS * grid.cell;
        if body.len() < 2 * MIN_VOXELS || !is_small() || standing(&body) < 2 * MIN_STANDING || !is_on_top() {
            apart.push(body);
        } else {
            let pieces = split_by_color(grid, &body, SCALE, MIN_VOXELS);
            close.extend(join_pieces(grid, pieces, |piece| standing(piece) >= MIN_STANDING));
        }
    }
    let heights: Vec<f32> = close.iter().map(|body| top_under(body)).collect();
    apart.extend(seen_closer(grid, gaussians, close, &heights));
    apart
}

/// Joins the pieces of a body, smallest first, with the neighbors that they belong to.
fn join_pieces(grid: &VoxelGrid, mut pieces: Vec<Vec<usize>>, stands: impl Fn(&[usize]) -> bool) -> Vec<Vec<usize>> {
    loop {
        let owner = owners(grid, &pieces);
        let mut order: Vec<usize> = (0..pieces.len()).collect();
        order.sort_by_key(|&i| (pieces[i].len(), i));
        let whole = |piece: usize| {
            let around: BTreeMap<usize, usize> = contacts(grid, &pieces[piece], &owner, 1);
            let most = around.into_iter().max_by_key(|&(other, count)| (count, std::cmp::Reverse(other)))?;
            (!is_apart(grid, (&pieces, &owner), (piece, most.0), &stands)).then_some(most.0)
        };
        let Some((from, to)) = order.into_iter().find_map(|piece| Some((piece, whole(piece)?))) else { return pieces };
        let moved = std::mem::take(&mut pieces[from]);
        pieces[to].extend(moved);
        pieces.remove(from);
    }
}

/// Whether two touching pieces are two things.
fn is_apart(
    grid: &VoxelGrid,
    (pieces, owner): (&[Vec<usize>], &[usize]),
    (one, other): (usize, usize),
    stands: impl Fn(&[usize]) -> bool,
) -> bool {
    let (smaller, larger) = if pieces[one].len() <= pieces[other].len() { (one, other) } else { (other, one) };
    let touches = |&&voxel: &&usize| grid.neighbors(voxel, 1).any(|near| owner[near] == larger);
    let touching = pieces[smaller].iter().filter(touches).count() as f32;
    let difference = color::difference(mean_color(grid, &pieces[one]), mean_color(grid, &pieces[other]));
    touching <= MAX_TOUCHING * pieces[smaller].len() as f32
        && difference >= MIN_DIFFERENCE
        && stands(&pieces[one])
        && stands(&pieces[other])
}

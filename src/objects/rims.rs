//! What is left of floor and walls around the things on them: casings of doors, frames of mirrors, feet of lamps.
//!
//! Enters: the planes of a room without the flat things on them, and all things. Leaves: the things with their rims.

use std::collections::BTreeMap;

use super::flats::PlaneCells;
use super::groups::VoxelGroup;
use super::outlines::{is_in, rectangle};

/// Largest width of a rim, cells.
const MAX_CELLS: i32 = 3;

/// Height over its plane up to which a voxel touches it, and up to which a thing on a wall is flat, cells.
const NEAR_CELLS: f32 = 3.0;
const FLAT_CELLS: f32 = 6.0;

/// Height of a rim over that of what stands out.
const RIM_FRAC: f32 = 0.6;

/// Adds their rims to the things that lie flat on a wall or stand on a floor.
pub(crate) fn add_rims(surfaces: &mut [PlaneCells], groups: &mut [VoxelGroup]) {
    for surface in surfaces {
        let bears = |&i: &usize| !groups[i].is_surface && bears(surface, &groups[i].voxels);
        let borne: Vec<usize> = (0..groups.len()).filter(bears).collect();
        let keys: Vec<Vec<[i32; 2]>> = borne.iter().map(|&i| touching(surface, &groups[i].voxels)).collect();
        let mut owner: BTreeMap<[i32; 2], usize> = BTreeMap::new();
        for (&i, keys) in borne.iter().zip(&keys) {
            keys.iter().for_each(|&key| {
                owner.entry(key).or_insert(i);
            });
        }
        for (&i, keys) in borne.iter().zip(keys) {
            // What lies between two things holds the edges of both.
            let is_own = |key: [i32; 2]| around(key).all(|near| owner.get(&near).is_none_or(|&held| held == i));
            let rim = take_rim(surface, keys, is_own);
            groups[i].voxels.extend(rim);
        }
    }
}

/// The cells of a plane that a thing touches.
fn touching(surface: &PlaneCells, thing: &[usize]) -> Vec<[i32; 2]> {
    let near = |&&v: &&usize| surface.plane.height(surface.grid.voxels[v].position) < NEAR_CELLS * surface.grid.cell;
    thing.iter().filter(near).map(|&v| surface.key(v)).collect()
}

/// A cell and those around it.
fn around([x, y]: [i32; 2]) -> impl Iterator<Item = [i32; 2]> {
    (-1..=1).flat_map(move |dx| (-1..=1).map(move |dy| [x + dx, y + dy]))
}

/// Whether a thing stands on the plane's floor, or lies flat on its wall.
fn bears(surface: &PlaneCells, thing: &[usize]) -> bool {
    let position = |&v: &usize| surface.grid.voxels[v].position;
    let heights = || thing.iter().map(position).map(|p| surface.plane.height(p) / surface.grid.cell);
    let touches = heights().fold(f32::INFINITY, f32::min).abs() < NEAR_CELLS;
    let is_flat =
        || heights().all(|height| height < FLAT_CELLS) && thing.iter().map(position).all(|p| surface.plane.spans(p));
    touches && (!surface.is_wall() || is_flat())
}

/// Takes the voxels of the plane that are the rim of a thing, which touches the cells `open`: connected with it, and at most [`MAX_CELLS`] outside its rectangle.
/// On a wall a rim stands out or has another color, on a floor it stands out: things throw shade on the floor.
fn take_rim(surface: &mut PlaneCells, mut open: Vec<[i32; 2]>, is_own: impl Fn([i32; 2]) -> bool) -> Vec<usize> {
    if open.is_empty() {
        return Vec::new();
    }
    let (low, high) = rectangle(&open);
    let bounds = (low.map(|v| v - MAX_CELLS), high.map(|v| v + MAX_CELLS));
    let differing = Some(&surface.differing).filter(|_| surface.is_wall());
    let is_rim = |key: &[i32; 2]| {
        let stands_out = surface.heights.get(key).is_some_and(|&height| height > RIM_FRAC * surface.relief);
        is_in(*key, bounds) && (stands_out || differing.is_some_and(|differing| differing.contains(key)))
    };
    let cells = &mut surface.cells;
    let mut taken = Vec::new();
    while let Some(held) = open.pop() {
        for key in around(held).filter(|key| is_rim(key) && is_own(*key)) {
            if let Some(voxels) = cells.remove(&key) {
                taken.extend(voxels);
                open.push(key);
            }
        }
    }
    taken
}

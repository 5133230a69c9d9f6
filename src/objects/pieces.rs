//! Pieces of things: joined by their contacts, and measured.

use std::collections::BTreeMap;

use glam::Vec3;

use super::color;
use super::planes::{PlaneKind, ScenePlane};
use super::segmentation::{components, split_by_color};
use super::settings::FindSettings;
use super::standing::{extent, mean_color, owners};
use super::voxels::VoxelGrid;

/// Share of a piece's neighbors that must belong to one other piece for the two to be joined.
const REJOIN_FRAC: f64 = 0.5;

/// A component in pieces for one object each: one that is too large for one object (`max_diagonal`, cells) is split by
/// color and surface direction.
pub(crate) fn split(
    grid: &VoxelGrid,
    component: Vec<usize>,
    max_diagonal: f64,
    settings: &FindSettings,
) -> Vec<Vec<usize>> {
    if diagonal(grid, component.iter().copied()) <= max_diagonal {
        return vec![component];
    }
    let pieces = split_by_color(grid, &component, settings.split_scale, settings.min_voxels);
    rejoin(grid, pieces, max_diagonal)
}

/// Margin around a thing in which a loose piece belongs to it, over the thing's diagonal.
const LOOSE_MARGIN: f32 = 0.1;

/// The connected components of a capture without walls. Components of at most a twentieth of the largest one's voxels
/// are loose pieces, such as a leaf or the inside of a shell: they join the thing around them, or disappear.
pub(crate) fn isolated_objects(grid: &VoxelGrid, voxels: &[usize]) -> Vec<Vec<usize>> {
    let mut objects = components(grid, voxels, 2);
    objects.sort_by_key(|object| std::cmp::Reverse(object.len()));
    let Some(least) = objects.first().map(|largest| largest.len() / 20) else { return objects };
    let pieces = objects.split_off(objects.partition_point(|object| object.len() > least));
    let around = |object: &Vec<usize>| {
        let (low, high) = extent(grid, object);
        let margin = LOOSE_MARGIN * (high - low).length();
        (low - margin, high + margin)
    };
    let boxes: Vec<(Vec3, Vec3)> = objects.iter().map(around).collect();
    for piece in pieces {
        let (low, high) = extent(grid, &piece);
        let holds = |&i: &usize| boxes[i].0.cmple(low).all() && boxes[i].1.cmpge(high).all();
        if let Some(object) = (0..objects.len()).find(holds) {
            objects[object].extend(piece);
        }
    }
    objects
}

/// Height of a lump of the ground over its longer side, and largest color difference from the ground.
const LUMP_RATIO: f32 = 0.25;
const LUMP_DIFFERENCE: f32 = 12.0;

/// Drops lumps of the ground: flat, on it, and of its color. The largest object stays.
pub(crate) fn drop_lumps(grid: &VoxelGrid, planes: &[ScenePlane], objects: &mut Vec<Vec<usize>>) {
    let floors = planes.iter().filter(|plane| plane.kind == PlaneKind::Floor);
    let floors: Vec<(&ScenePlane, Vec3)> = floors.map(|floor| (floor, mean_color(grid, &floor.voxels))).collect();
    let largest = objects.iter().map(Vec::len).max().unwrap_or(0);
    let is_lump = |object: &Vec<usize>| {
        let (low, high) = extent(grid, object);
        let sides = high - low;
        let own = mean_color(grid, object);
        let is_on = |(floor, color): &(&ScenePlane, Vec3)| {
            floor.height(low) < 3.0 * grid.cell && color::difference(own, *color) < LUMP_DIFFERENCE
        };
        object.len() < largest && sides.y <= LUMP_RATIO * sides.x.max(sides.z) && floors.iter().any(is_on)
    };
    objects.retain(|object| !is_lump(object));
}

/// Joins the pieces of an object of several colors. A piece joins the neighbor that holds most of its contacts, unless
/// the union is too large for one object (`max_diagonal`, cells). This joins a pot with its plant and a door with its
/// handle, but not the doors of a row, which have neighbors on both sides.
fn rejoin(grid: &VoxelGrid, mut pieces: Vec<Vec<usize>>, max_diagonal: f64) -> Vec<Vec<usize>> {
    let owner = owners(grid, &pieces);
    let mut contacts: Vec<BTreeMap<usize, usize>> =
        pieces.iter().map(|piece| contacts(grid, piece, &owner, 1)).collect();
    let mut queue: Vec<usize> = (0..pieces.len()).collect();
    queue.sort_by_key(|&i| (pieces[i].len(), i));
    let mut at = 0;
    while let Some(&from) = queue.get(at) {
        at += 1;
        contacts[from].remove(&from);
        let total: usize = contacts[from].values().sum();
        let nearest = contacts[from].iter().max_by_key(|&(&i, &count)| (count, std::cmp::Reverse(i)));
        let Some((&to, &count)) = nearest.filter(|_| !pieces[from].is_empty()) else { continue };
        let union = || pieces[from].iter().chain(&pieces[to]).copied();
        if (count as f64) < REJOIN_FRAC * total as f64 || diagonal(grid, union()) > max_diagonal {
            continue;
        }
        let moved = std::mem::take(&mut pieces[from]);
        pieces[to].extend(moved);
        for (other, count) in std::mem::take(&mut contacts[from]) {
            let back = contacts[other].remove(&from).unwrap_or(0);
            if other != to {
                *contacts[to].entry(other).or_default() += count;
                *contacts[other].entry(to).or_default() += back;
            }
        }
        queue.push(to);
    }
    pieces.retain(|piece| !piece.is_empty());
    pieces
}

/// Adds every fragment to the body with which it has the most contacts. Fragments without contact are dropped.
pub(crate) fn attach(grid: &VoxelGrid, fragments: Vec<Vec<usize>>, bodies: &mut [Vec<usize>]) {
    let owner = owners(grid, &*bodies);
    for fragment in fragments {
        let contacts = contacts(grid, &fragment, &owner, 2);
        if let Some((&body, _)) = contacts.iter().max_by_key(|&(&i, &count)| (count, std::cmp::Reverse(i))) {
            bodies[body].extend(fragment);
        }
    }
}

/// The number of contacts of a group with every other group: pairs of voxels at most `reach` cells apart.
pub(crate) fn contacts(grid: &VoxelGrid, group: &[usize], owner: &[usize], reach: i32) -> BTreeMap<usize, usize> {
    let own = group.first().map(|&voxel| owner[voxel]);
    let mut contacts = BTreeMap::new();
    for &voxel in group {
        for other in grid.neighbors(voxel, reach).map(|other| owner[other]) {
            if other != usize::MAX && Some(other) != own {
                *contacts.entry(other).or_default() += 1;
            }
        }
    }
    contacts
}

/// Diagonal of the bounding box of some voxels, in cells.
pub(crate) fn diagonal(grid: &VoxelGrid, voxels: impl Iterator<Item = usize>) -> f64 {
    let start = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    let (low, high) = voxels.map(|v| grid.voxels[v].position).fold(start, |(low, high), p| (low.min(p), high.max(p)));
    f64::from((high - low).length() / grid.cell)
}

//! Voxels become objects: connected components, split by color where they are too large, and table tops with
//! their bodies.
//!
//! Enters: voxels and the scene's planes. Leaves: disjoint groups of voxels, one per object.

use std::collections::BTreeMap;

use glam::Vec3;

use super::background::{CellRole, roles};
use super::planes::{PlaneKind, ScenePlane};
use super::segmentation::{components, split_by_color};
use super::settings::FindSettings;
use super::voxels::VoxelGrid;

/// Share of a piece's neighbors that must belong to one other piece for the two to be joined.
const REJOIN_FRAC: f64 = 0.5;

/// Least share of the voxels under a table top that belong to one body, for the top and the body to be one object.
const BODY_FRAC: f64 = 0.6;

/// The voxels of one object.
pub(crate) struct VoxelGroup {
    /// Positions in [`VoxelGrid::voxels`].
    pub(crate) voxels: Vec<usize>,
    /// The object is only a level surface.
    pub(crate) is_surface: bool,
}

/// Groups the voxels of a scene into objects.
///
/// In a room, voxels that touch form one component, and components too large for one object are split by color and
/// surface direction. A capture without walls is not split: each connected component is one object.
pub(crate) fn group(grid: &VoxelGrid, planes: &[ScenePlane], settings: &FindSettings) -> Vec<VoxelGroup> {
    let roles = roles(grid, planes, settings);
    let of = |wanted: CellRole| (0..roles.len()).filter(|&v| roles[v] == wanted).collect::<Vec<_>>();
    let is_room = planes.iter().any(|plane| matches!(plane.kind, PlaneKind::Wall | PlaneKind::Ceiling));
    let mut bodies = Vec::new();
    let mut fragments = Vec::new();
    let free = of(CellRole::Free);
    for component in if is_room { components(grid, &free, 1) } else { isolated_objects(grid, &free) } {
        let is_too_large =
            is_room && diagonal(grid, component.iter().copied()) > settings.split_frac * settings.resolution;
        let pieces = if is_too_large {
            let pieces = split_by_color(grid, &component, settings.split_scale, settings.min_voxels);
            rejoin(grid, pieces, settings.split_frac * settings.resolution)
        } else {
            vec![component]
        };
        for piece in pieces {
            if piece.len() < settings.min_voxels { fragments.extend(piece) } else { bodies.push(piece) }
        }
    }
    fragments.sort_unstable();
    let (large, small): (Vec<_>, Vec<_>) =
        components(grid, &fragments, 2).into_iter().partition(|component| component.len() >= settings.min_voxels);
    bodies.extend(large);
    attach(grid, small, &mut bodies);
    let mut groups: Vec<VoxelGroup> =
        bodies.into_iter().map(|voxels| VoxelGroup { voxels, is_surface: false }).collect();
    for plane in 0..planes.len() {
        for top in components(grid, &of(CellRole::Support(plane)), 1) {
            add_top(grid, top, &mut groups, settings.min_voxels);
        }
    }
    groups
}

/// The connected components of a capture without walls. Components of at most a twentieth of the largest one's voxels
/// are loose pieces of it, such as a leaf or the inside of a shell: they join it.
fn isolated_objects(grid: &VoxelGrid, voxels: &[usize]) -> Vec<Vec<usize>> {
    let mut objects = components(grid, voxels, 2);
    objects.sort_by_key(|object| std::cmp::Reverse(object.len()));
    let Some(least) = objects.first().map(|largest| largest.len() / 20) else { return objects };
    let pieces = objects.split_off(objects.partition_point(|object| object.len() > least));
    objects[0].extend(pieces.into_iter().flatten());
    objects
}

/// Joins the pieces of an object of several colors. A piece joins the neighbor that holds most of its contacts, unless
/// the union is too large for one object (`max_diagonal`, cells). This joins a pot with its plant and a door with its
/// handle, but not the doors of a row, which have neighbors on both sides.
fn rejoin(grid: &VoxelGrid, mut pieces: Vec<Vec<usize>>, max_diagonal: f64) -> Vec<Vec<usize>> {
    let owner = owners(grid, pieces.iter().map(Vec::as_slice));
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
fn attach(grid: &VoxelGrid, fragments: Vec<Vec<usize>>, bodies: &mut [Vec<usize>]) {
    let owner = owners(grid, bodies.iter().map(Vec::as_slice));
    for fragment in fragments {
        let contacts = contacts(grid, &fragment, &owner, 2);
        if let Some((&body, _)) = contacts.iter().max_by_key(|&(&i, &count)| (count, std::cmp::Reverse(i))) {
            bodies[body].extend(fragment);
        }
    }
}

/// For each voxel the index of its group; `usize::MAX` where it is in none.
fn owners<'a>(grid: &VoxelGrid, groups: impl Iterator<Item = &'a [usize]>) -> Vec<usize> {
    let mut owner = vec![usize::MAX; grid.voxels.len()];
    for (i, group) in groups.enumerate() {
        for &voxel in group {
            owner[voxel] = i;
        }
    }
    owner
}

/// The number of contacts of a group with every other group: pairs of voxels at most `reach` cells apart.
fn contacts(grid: &VoxelGrid, group: &[usize], owner: &[usize], reach: i32) -> BTreeMap<usize, usize> {
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

/// Adds a level piece to the body below it. A piece above several bodies or none becomes an object where it is large
/// enough.
fn add_top(grid: &VoxelGrid, top: Vec<usize>, groups: &mut Vec<VoxelGroup>, min_voxels: usize) {
    let owner = owners(grid, groups.iter().map(|group| group.voxels.as_slice()));
    let mut contacts = vec![0_usize; groups.len()];
    for &voxel in &top {
        let level = grid.voxels[voxel].key[1];
        for below in grid.neighbors(voxel, 2).filter(|&other| grid.voxels[other].key[1] < level) {
            if let Some(count) = contacts.get_mut(owner[below]) {
                *count += 1;
            }
        }
    }
    let total: usize = contacts.iter().sum();
    let carrier = (0..contacts.len()).max_by_key(|&i| (contacts[i], std::cmp::Reverse(i)));
    match carrier.filter(|&i| contacts[i] as f64 >= BODY_FRAC * total as f64 && total > 0) {
        Some(body) => groups[body].voxels.extend(top),
        None if top.len() >= min_voxels => groups.push(VoxelGroup { voxels: top, is_surface: true }),
        None => {}
    }
}

/// Diagonal of the bounding box of some voxels, in cells.
fn diagonal(grid: &VoxelGrid, voxels: impl Iterator<Item = usize>) -> f64 {
    let start = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    let (low, high) = voxels.map(|v| grid.voxels[v].position).fold(start, |(low, high), p| (low.min(p), high.max(p)));
    f64::from((high - low).length() / grid.cell)
}

//! What stands on what: bodies and tops become things, with the things on a top apart from the thing that it belongs to.

use std::collections::BTreeMap;

use glam::Vec3;

use super::color;
use super::tops::Top;
use super::voxels::VoxelGrid;

/// Share of a body's voxels that must lie under a top for the body to carry it.
const UNDER_FRAC: f32 = 0.6;

/// Depth below a top to which a thing that stands on it may reach, cells.
const SUNK_CELLS: f32 = 1.6;

/// Least share of the contacts of a top with all bodies under it that its carrier has.
const CARRIER_FRAC: f32 = 0.15;

/// Share of a thing's contacts with a top at the edges of the top's box from which it is the top's own upright, such as a
/// backrest.
const RIM_FRAC: f32 = 0.75;

/// Distance from the edges of a top's box that counts as its rim, cells.
const RIM_CELLS: f32 = 3.5;

/// Share of the longer side of a top's box along which its own upright stands.
const UPRIGHT_FRAC: f32 = 0.4;

/// Largest color difference between a top and its own upright.
const SAME_COLOR: f32 = 9.0;

/// Bodies and tops joined into things.
pub(crate) struct Things {
    /// The voxels of every thing.
    pub(crate) voxels: Vec<Vec<usize>>,
    /// Whether it is a top without anything that carries it.
    pub(crate) is_surface: Vec<bool>,
}

/// How a body touches a top.
#[derive(Default)]
struct Contact {
    /// Pairs of touching voxels with the body's voxel higher, and lower.
    above: usize,
    below: usize,
    /// Contacts above at the rim of the top.
    rim: usize,
}

/// Joins every top with the bodies that carry it.
pub(crate) fn join(grid: &VoxelGrid, bodies: &[Vec<usize>], tops: &[Top]) -> Things {
    let num_bodies = bodies.len();
    let owner = owners(grid, bodies);
    let lowest: Vec<f32> = bodies.iter().map(|body| lowest(grid, body)).collect();
    let colors: Vec<Vec3> = bodies.iter().map(|body| mean_color(grid, body)).collect();
    let boxes: Vec<(Vec3, Vec3)> = bodies.iter().map(|body| extent(grid, body)).collect();
    // Sets of bodies and tops, tops after bodies.
    let mut sets = super::segmentation::DisjointSets::new(num_bodies + tops.len());
    for (t, top) in tops.iter().enumerate() {
        let contacts = contacts(grid, top, &owner);
        let total_below: usize = contacts.values().map(|contact| contact.below).sum();
        let top_color = mean_color(grid, &top.voxels);
        let (low, high) = extent(grid, &top.voxels);
        let rests = |body: usize| lowest[body] > top.height - SUNK_CELLS * grid.cell;
        // A foot carries one thing and stands on the floor.
        let resting: Vec<usize> = contacts.keys().copied().filter(|&body| rests(body)).collect();
        if let [only] = resting.as_slice()
            && contacts.len() == 1
        {
            sets.join(*only, num_bodies + t);
            continue;
        }
        for (&body, contact) in &contacts {
            let carries = if rests(body) {
                let at_rim = contact.rim as f32 >= RIM_FRAC * contact.above as f32;
                let side = (boxes[body].1 - boxes[body].0) * Vec3::new(1.0, 0.0, 1.0);
                let is_long = side.max_element() >= UPRIGHT_FRAC * (high - low).max_element();
                at_rim && is_long && color::difference(colors[body], top_color) < SAME_COLOR
            } else {
                let share = contact.below as f32 / total_below.max(1) as f32;
                contact.below > 0 && (share >= CARRIER_FRAC || under_frac(grid, &bodies[body], top) >= UNDER_FRAC)
            };
            if carries {
                sets.join(body, num_bodies + t);
            }
        }
    }
    let all: Vec<usize> = (0..num_bodies + tops.len()).collect();
    let mut things = Things { voxels: Vec::new(), is_surface: Vec::new() };
    for group in sets.groups(&all) {
        things.is_surface.push(group.iter().all(|&item| item >= num_bodies));
        let of = |item: usize| if item < num_bodies { &bodies[item] } else { &tops[item - num_bodies].voxels };
        things.voxels.push(group.into_iter().flat_map(|item| of(item).iter().copied()).collect());
    }
    things
}

fn contacts(grid: &VoxelGrid, top: &Top, owner: &[usize]) -> BTreeMap<usize, Contact> {
    let mut contacts: BTreeMap<usize, Contact> = BTreeMap::new();
    let (low, high) = extent(grid, &top.voxels);
    for &voxel in &top.voxels {
        let y = grid.voxels[voxel].key[1];
        let p = grid.voxels[voxel].position;
        let gaps = [p.x - low.x, high.x - p.x, p.z - low.z, high.z - p.z];
        let is_rim = gaps.into_iter().fold(f32::INFINITY, f32::min) < RIM_CELLS * grid.cell;
        for other in grid.neighbors(voxel, 2) {
            if owner[other] == usize::MAX {
                continue;
            }
            let contact = contacts.entry(owner[other]).or_default();
            match grid.voxels[other].key[1].cmp(&y) {
                std::cmp::Ordering::Greater => {
                    contact.above += 1;
                    contact.rim += usize::from(is_rim);
                }
                std::cmp::Ordering::Less => contact.below += 1,
                std::cmp::Ordering::Equal => {}
            }
        }
    }
    contacts
}

/// Share of a body's voxels below a top, inside its box.
fn under_frac(grid: &VoxelGrid, body: &[usize], top: &Top) -> f32 {
    let (low, high) = extent(grid, &top.voxels);
    let margin = 1.5 * grid.cell;
    let is_under = |p: Vec3| {
        p.y < top.height + margin
            && p.x > low.x - margin
            && p.x < high.x + margin
            && p.z > low.z - margin
            && p.z < high.z + margin
    };
    body.iter().filter(|&&v| is_under(grid.voxels[v].position)).count() as f32 / body.len().max(1) as f32
}

/// Corners of the upright box of some voxels' positions, local frame.
pub(crate) fn extent(grid: &VoxelGrid, voxels: &[usize]) -> (Vec3, Vec3) {
    let start = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    voxels.iter().map(|&v| grid.voxels[v].position).fold(start, |(low, high), p| (low.min(p), high.max(p)))
}

fn lowest(grid: &VoxelGrid, body: &[usize]) -> f32 {
    let mut heights: Vec<f32> = body.iter().map(|&v| grid.voxels[v].position.y).collect();
    let at = heights.len() / 50;
    if heights.is_empty() { 0.0 } else { *heights.select_nth_unstable_by(at, f32::total_cmp).1 }
}

/// Mean color of some voxels, CIE Lab.
pub(crate) fn mean_color(grid: &VoxelGrid, voxels: &[usize]) -> Vec3 {
    voxels.iter().map(|&v| grid.voxels[v].color_lab).sum::<Vec3>() / voxels.len().max(1) as f32
}

/// For each voxel the index of its group; `usize::MAX` where it is in none.
pub(crate) fn owners(grid: &VoxelGrid, groups: &[Vec<usize>]) -> Vec<usize> {
    let mut owner = vec![usize::MAX; grid.voxels.len()];
    for (i, group) in groups.iter().enumerate() {
        group.iter().for_each(|&voxel| owner[voxel] = i);
    }
    owner
}

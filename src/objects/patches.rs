//! Flat things in tops: place mats, cooktops.
//!
//! Enters: tops, and the bodies of a room. Leaves: the bodies with the patches of the tops that differ from them in color. A
//! patch under a body is the body's own foot, or else a body with the small ones that lie on it.

use std::collections::{BTreeMap, BTreeSet};

use glam::Vec3;

use super::flats::{differs, most_frequent};
use super::outlines::{Rectangle, area, components_within, outline, rectangle, sides};
use super::segmentation::split_by_color;
use super::standing::{extent, mean_color, owners};
use super::tops::Top;
use super::voxels::VoxelGrid;

/// Scale and least size of the regions of one color on a top.
const SCALE: f32 = 140.0;
const MIN_REGION: usize = 6;

/// Least number of cells of a patch, least width, and largest length over the width.
const MIN_CELLS: usize = 14;
const MIN_SIDE: f32 = 3.0;
const MAX_RATIO: f32 = 4.0;

/// Least share of the rectangle that a patch covers, and of the patch that differs from the top.
const MIN_FILL: f32 = 0.6;

/// Largest share of a top that one patch covers.
const MAX_SHARE: f32 = 0.35;

/// Limit on the patches of one top: a pattern has more.
const MAX_PATCHES: usize = 16;

/// Share of a patch under a body from which it is the body's foot.
const UNDER_FRAC: f32 = 0.5;

/// Takes the patches from the tops.
pub(crate) fn take_patches(grid: &VoxelGrid, tops: &mut [Top]) -> Vec<Vec<usize>> {
    tops.iter_mut().flat_map(|top| patches(grid, top)).collect()
}

fn patches(grid: &VoxelGrid, top: &mut Top) -> Vec<Vec<usize>> {
    let colors: Vec<Vec3> = top.voxels.iter().map(|&v| grid.voxels[v].color_lab).collect();
    let Some(top_color) = most_frequent(&colors) else { return Vec::new() };
    let mut cells: BTreeMap<[i32; 2], Vec<usize>> = BTreeMap::new();
    let mut differing: BTreeSet<[i32; 2]> = BTreeSet::new();
    for region in split_by_color(grid, &top.voxels, SCALE, MIN_REGION) {
        let is_apart = differs(mean_color(grid, &region) - top_color);
        for &v in &region {
            let [x, _, z] = grid.voxels[v].key;
            cells.entry([x, z]).or_default().push(v);
            if is_apart {
                differing.insert([x, z]);
            }
        }
    }
    let mut patches = Vec::new();
    for keys in components_within(differing.clone(), 1) {
        let bounds = rectangle(&keys);
        let mut outline = outline(&keys, bounds, false);
        outline.retain(|key| cells.contains_key(key));
        let num_differing = outline.iter().filter(|key| differing.contains(*key)).count() as f32;
        let is_solid = num_differing >= MIN_FILL * outline.len() as f32 && is_compact(bounds, outline.len());
        if is_solid && outline.len() as f32 <= MAX_SHARE * cells.len() as f32 {
            patches.push(outline.into_iter().flat_map(|key| cells[&key].iter().copied()).collect::<Vec<usize>>());
        }
    }
    if patches.len() > MAX_PATCHES {
        return Vec::new();
    }
    let taken: BTreeSet<usize> = patches.iter().flatten().copied().collect();
    top.voxels.retain(|voxel| !taken.contains(voxel));
    patches
}

fn is_compact(bounds: Rectangle, num_cells: usize) -> bool {
    let [a, b] = sides(bounds);
    let is_wide = a.min(b) >= MIN_SIDE && a.max(b) <= MAX_RATIO * a.min(b);
    is_wide && num_cells >= MIN_CELLS && num_cells as f32 >= MIN_FILL * area(bounds)
}

/// Adds every patch to the body that stands on most of it; the others become bodies with what lies inside their outlines.
pub(crate) fn add_patches(grid: &VoxelGrid, patches: Vec<Vec<usize>>, bodies: &mut Vec<Vec<usize>>) {
    let owner = owners(grid, &*bodies);
    let mut boxes: Vec<(Vec3, Vec3)> = bodies.iter().map(|body| extent(grid, body)).collect();
    for patch in patches {
        let mut above: BTreeMap<usize, usize> = BTreeMap::new();
        for &voxel in &patch {
            let level = grid.voxels[voxel].key[1];
            let over = grid.neighbors(voxel, 2).filter(|&other| grid.voxels[other].key[1] > level);
            let bodies: BTreeSet<usize> = over.map(|other| owner[other]).filter(|&body| body != usize::MAX).collect();
            bodies.into_iter().for_each(|body| *above.entry(body).or_default() += 1);
        }
        let most = above.iter().max_by_key(|&(&body, &count)| (count, std::cmp::Reverse(body)));
        if let Some((&body, _)) = most.filter(|&(_, &count)| count as f32 >= UNDER_FRAC * patch.len() as f32) {
            bodies[body].extend(patch);
            continue;
        }
        let (low, high) = extent(grid, &patch);
        let lies_on = |(a, b): (Vec3, Vec3)| {
            let margin = grid.cell;
            a.x > low.x - margin && b.x < high.x + margin && a.z > low.z - margin && b.z < high.z + margin
        };
        let mut whole = patch;
        for &body in above.keys().filter(|&&body| lies_on(boxes[body])) {
            whole.append(&mut bodies[body]);
        }
        boxes.push(extent(grid, &whole));
        bodies.push(whole);
    }
    bodies.retain(|body| !body.is_empty());
}

//! Storeys of one thing: the upper and the lower part of a shelf, which one of its boards has cut apart.
//!
//! Enters: groups. Leaves: the same groups, those of one footprint and color on top of each other joined. What stands on a thing is
//! smaller than the thing, or has another color.

use glam::Vec3;

use super::color;
use super::groups::VoxelGroup;
use super::standing::{extent, footprint_overlap, mean_color};
use super::voxels::VoxelGrid;

/// Least overlap of the footprints of two storeys, from above.
const SAME_FOOTPRINT: f32 = 0.85;

/// Largest gap between two storeys, and largest overlap in height, cells.
const GAP_CELLS: f32 = 3.0;
const SHARED_CELLS: f32 = 4.0;

/// Least length of the footprint, cells: small things are stacked.
const MIN_LENGTH_CELLS: f32 = 14.0;

/// Largest color difference between two storeys: boards and what stands on them.
const MAX_DIFFERENCE: f32 = 20.0;

/// A group, measured.
struct Storey {
    bounds: (Vec3, Vec3),
    color_lab: Vec3,
}

impl Storey {
    fn new(grid: &VoxelGrid, group: &VoxelGroup) -> Self {
        Self { bounds: extent(grid, &group.voxels), color_lab: mean_color(grid, &group.voxels) }
    }

    /// Whether another group is the storey over this one.
    fn is_under(&self, upper: &Self, cell: f32) -> bool {
        let ((low, high), (bottom, top)) = (self.bounds, upper.bounds);
        let sides = (high - low) / cell;
        let gap = (bottom.y - high.y) / cell;
        sides.x.max(sides.z) >= MIN_LENGTH_CELLS
            && (-SHARED_CELLS..=GAP_CELLS).contains(&gap)
            && top.y > high.y
            && footprint_overlap((low, high), (bottom, top)) >= SAME_FOOTPRINT
            && color::difference(self.color_lab, upper.color_lab) <= MAX_DIFFERENCE
    }
}

/// Joins storeys.
pub(crate) fn join_stacked(grid: &VoxelGrid, groups: &mut Vec<VoxelGroup>) {
    let mut storeys: Vec<Storey> = groups.iter().map(|group| Storey::new(grid, group)).collect();
    let mut at = 0;
    while at < groups.len() {
        let is_upper = |&other: &usize| other != at && storeys[at].is_under(&storeys[other], grid.cell);
        let Some(upper) = (0..groups.len()).find(is_upper) else {
            at += 1;
            continue;
        };
        let moved = std::mem::take(&mut groups[upper].voxels);
        let is_surface = groups[upper].is_surface;
        groups[at].voxels.extend(moved);
        groups[at].is_surface &= is_surface;
        storeys[at] = Storey::new(grid, &groups[at]);
        groups.remove(upper);
        storeys.remove(upper);
        // What lies under the union may come before it.
        at = 0;
    }
}

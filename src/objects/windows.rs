//! Windows: openings of walls through which what lies outside is seen.
//!
//! Enters: the walls of a room. Leaves: for every window the voxels of its frame and its bars. A hole of a wall is a window
//! where matter lies behind it and little stands before it: a wall is also empty behind furniture.

use std::collections::{BTreeMap, BTreeSet};

use glam::Vec3;

use super::flats::is_seen;
use super::outlines::{Rectangle, area, components_within, is_in, rectangle, sides};
use super::planes::{PlaneKind, ScenePlane};
use super::voxels::VoxelGrid;

/// Heights over a wall between which voxels are part of it, cells.
const WALL_CELLS: f32 = 1.2;

/// Heights between which a voxel stands before a hole, cells.
const BEFORE_CELLS: (f32, f32) = (4.0, 30.0);

/// Largest width of the bars that divide a window, cells.
const BAR_CELLS: i32 = 3;

/// Least width and height of a pane, largest distance between panes beside each other, and largest difference between where
/// they begin and end, cells.
const MIN_PANE: f32 = 4.0;
const POST_CELLS: i32 = 7;
const PANE_SHIFT: i32 = 2;

/// Least width and height of a window, cells.
const MIN_SIDE: f32 = 10.0;

/// Least share of a window's rectangle that is empty.
const MIN_OPEN: f32 = 0.4;

/// Largest share of a hole before which something stands, and least share behind which something lies.
const MAX_BEFORE: f32 = 0.6;
const MIN_BEHIND: f32 = 0.3;

/// Width of the rim of the holes, cells: it is frame, even where it lies in its wall.
const RIM_CELLS: i32 = 1;

/// Width of the frame around the holes, cells.
const FRAME_CELLS: i32 = 4;

/// Heights of a frame over its wall, cells.
const FRAME_HEIGHTS: (f32, f32) = (-1.5, 4.0);

/// Height over its wall from which a voxel beside the holes is part of the frame, cells.
const RELIEF_CELLS: f32 = 0.4;

/// The windows, each as voxels.
pub(crate) fn windows(grid: &VoxelGrid, planes: &[ScenePlane]) -> Vec<Vec<usize>> {
    let walls = planes.iter().filter(|plane| plane.kind == PlaneKind::Wall && is_seen(planes, plane, grid.cell));
    walls.flat_map(|wall| on_wall(grid, wall)).collect()
}

/// What the cells of a wall hold.
#[derive(Default)]
struct Cells {
    wall: BTreeSet<[i32; 2]>,
    before: BTreeSet<[i32; 2]>,
    behind: BTreeSet<[i32; 2]>,
    /// Voxels of frames.
    near: BTreeMap<[i32; 2], Vec<usize>>,
}

fn on_wall(grid: &VoxelGrid, wall: &ScenePlane) -> Vec<Vec<usize>> {
    let along = Vec3::Y.cross(wall.normal);
    let mut cells = Cells::default();
    for (voxel, p) in grid.voxels.iter().map(|voxel| voxel.position).enumerate().filter(|(_, p)| wall.spans(*p)) {
        let height = wall.height(p) / grid.cell;
        let key = [(along.dot(p) / grid.cell).floor() as i32, (p.y / grid.cell).floor() as i32];
        if height.abs() <= WALL_CELLS {
            cells.wall.insert(key);
        } else if height < 0.0 {
            cells.behind.insert(key);
        } else if height > BEFORE_CELLS.0 && height < BEFORE_CELLS.1 {
            cells.before.insert(key);
        }
        if height > FRAME_HEIGHTS.0 && height < FRAME_HEIGHTS.1 {
            cells.near.entry(key).or_default().push(voxel);
        }
    }
    let all: Vec<[i32; 2]> = cells.wall.iter().copied().collect();
    if all.is_empty() {
        return Vec::new();
    }
    let (low, high) = rectangle(&all);
    let inside = (low[0]..=high[0]).flat_map(|x| (low[1]..=high[1]).map(move |y| [x, y]));
    let holes: BTreeSet<[i32; 2]> = inside.filter(|key| !cells.wall.contains(key)).collect();
    let found = with_panes_joined(components_within(holes, BAR_CELLS));
    found.into_iter().filter_map(|hole| window(grid, wall, (&cells, (low, high)), &hole)).collect()
}

/// The holes of a wall, the panes of one window as one hole: they begin and end alike, with a bar between them.
fn with_panes_joined(mut holes: Vec<Vec<[i32; 2]>>) -> Vec<Vec<[i32; 2]>> {
    holes.retain(|hole| sides(rectangle(hole)).into_iter().all(|side| side >= MIN_PANE));
    let is_beside = |one: Rectangle, other: Rectangle, axis: usize| {
        let gap = (one.0[axis] - other.1[axis]).max(other.0[axis] - one.1[axis]);
        let across = 1 - axis;
        let is_alike = |a: [i32; 2], b: [i32; 2]| (a[across] - b[across]).abs() <= PANE_SHIFT;
        (1..=POST_CELLS).contains(&gap) && is_alike(one.0, other.0) && is_alike(one.1, other.1)
    };
    let mut at = 0;
    while at < holes.len() {
        let own = rectangle(&holes[at]);
        let beside = |other: &Vec<[i32; 2]>| (0..2).any(|axis| is_beside(own, rectangle(other), axis));
        match (at + 1..holes.len()).find(|&other| beside(&holes[other])) {
            Some(other) => {
                let joined = holes.swap_remove(other);
                holes[at].extend(joined);
            }
            None => at += 1,
        }
    }
    holes
}

/// The voxels of a window; `None` where a hole is none.
fn window(
    grid: &VoxelGrid,
    wall: &ScenePlane,
    (cells, whole): (&Cells, Rectangle),
    hole: &[[i32; 2]],
) -> Option<Vec<usize>> {
    let bounds = rectangle(hole);
    let (low, high) = bounds;
    let share =
        |of: &BTreeSet<[i32; 2]>| hole.iter().filter(|key| of.contains(*key)).count() as f32 / hole.len() as f32;
    let is_large = sides(bounds).into_iter().all(|side| side >= MIN_SIDE);
    let is_framed = (0..2).all(|axis| low[axis] > whole.0[axis] + 1 && high[axis] < whole.1[axis] - 1);
    let is_open = hole.len() as f32 >= MIN_OPEN * area(bounds);
    if !(is_large && is_framed && is_open && share(&cells.before) <= MAX_BEFORE && share(&cells.behind) >= MIN_BEHIND) {
        return None;
    }
    let grown = |by: i32| (low.map(|v| v - by), high.map(|v| v + by));
    let (outer, inner) = (grown(FRAME_CELLS), grown(RIM_CELLS));
    let members = cells.near.iter().filter(|(key, _)| is_in(**key, outer)).flat_map(|(key, voxels)| {
        let is_own = is_in(*key, inner);
        voxels
            .iter()
            .copied()
            .filter(move |&v| is_own || wall.height(grid.voxels[v].position) > RELIEF_CELLS * grid.cell)
    });
    Some(members.collect())
}

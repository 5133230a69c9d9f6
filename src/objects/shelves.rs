//! Boards that hang on a wall, with what stands on them.
//!
//! Enters: the groups of a room and its tops. Leaves: the groups, those on such a board as parts of the board's group: a wall
//! shelf with its books is one thing, because without them nobody would call it one. What stands on a table, which stands on
//! the floor itself, is no part of it.

use glam::Vec3;

use super::groups::VoxelGroup;
use super::pieces::contacts;
use super::planes::{PlaneKind, ScenePlane};
use super::standing::{extent, lowest, owners};
use super::tops::Top;
use super::voxels::VoxelGrid;

/// Least length of a board over its depth, and largest height of its group, brackets included, over its length.
const BOARD_RATIO: f32 = 2.0;
const MAX_RISE: f32 = 0.5;

/// Largest distance of a board from its wall, and least height over the floor, cells.
const WALL_CELLS: f32 = 4.0;
const FLOOR_CELLS: f32 = 12.0;

/// Distance of voxels that touch, cells.
const REACH: i32 = 3;

/// Margin around the footprint of a board, cells, and least share of a thing over it.
const MARGIN_CELLS: f32 = 3.0;
const OVER_FRAC: f32 = 0.85;

/// Makes everything on a board that hangs on a wall a part of the board's group.
pub(crate) fn fill_shelves(grid: &VoxelGrid, planes: &[ScenePlane], tops: &[Top], groups: &mut [VoxelGroup]) {
    let owner = owners(grid, groups.iter().map(|group| &group.voxels));
    for top in tops {
        let Some(shelf) = shelf_of(grid, planes, top, (&owner, groups)) else { continue };
        let board = extent(grid, &top.voxels);
        let least_y = lowest(grid, &groups[shelf].voxels);
        for part in contacts(grid, &groups[shelf].voxels, &owner, REACH).into_keys() {
            if groups[part].parent.is_none() && is_over(grid, &groups[part].voxels, board, least_y) {
                groups[part].parent = Some(shelf);
            }
        }
    }
}

/// The group of a top that is a board on a wall; `None` where it is no board or something else carries it.
fn shelf_of(
    grid: &VoxelGrid,
    planes: &[ScenePlane],
    top: &Top,
    (owner, groups): (&[usize], &[VoxelGroup]),
) -> Option<usize> {
    let shelf = *top.voxels.iter().map(|&voxel| &owner[voxel]).find(|&&group| group != usize::MAX)?;
    let voxels = &groups[shelf].voxels;
    let (board, whole) = (extent(grid, &top.voxels), extent(grid, voxels));
    let sides = board.1 - board.0;
    let length = sides.x.max(sides.z);
    let is_board = length >= BOARD_RATIO * sides.x.min(sides.z) && whole.1.y - whole.0.y <= MAX_RISE * length;
    let is_on_wall = planes.iter().filter(|plane| plane.kind == PlaneKind::Wall).any(|wall| {
        let depth = wall.normal.abs().dot(sides);
        let middle = (board.0 + board.1) / 2.0;
        depth < length / BOARD_RATIO + grid.cell && wall.height(middle) - depth / 2.0 <= WALL_CELLS * grid.cell
    });
    let mut floors = planes.iter().filter(|plane| plane.kind == PlaneKind::Floor);
    let hangs = floors.all(|floor| floor.height(whole.0) > FLOOR_CELLS * grid.cell);
    let under = contacts(grid, voxels, owner, REACH).into_keys();
    let mut under = under.filter(|&other| lowest(grid, &groups[other].voxels) < whole.0.y - MARGIN_CELLS * grid.cell);
    let is_shelf = is_board && is_on_wall && hangs && groups[shelf].parent.is_none() && under.next().is_none();
    is_shelf.then_some(shelf)
}

/// Whether a thing lies over the footprint of a board, at `least_y` or higher.
fn is_over(grid: &VoxelGrid, thing: &[usize], (low, high): (Vec3, Vec3), least_y: f32) -> bool {
    let margin = Vec3::splat(MARGIN_CELLS * grid.cell);
    let (low, high) = ((low - margin).with_y(least_y - margin.y), (high + margin).with_y(f32::INFINITY));
    let is_in = |&&voxel: &&usize| {
        let p = grid.voxels[voxel].position;
        p.cmpge(low).all() && p.cmple(high).all()
    };
    thing.iter().filter(is_in).count() as f32 >= OVER_FRAC * thing.len() as f32
}

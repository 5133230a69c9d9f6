//! Fragments join the thing that they belong to, and scraps of walls and floaters disappear.
//!
//! Enters: the groups of a cluttered room. Leaves: those that a person would point at. Contact, color and shape decide: a
//! fragment is small and mostly touches one thing, or has its color and lies in its box.

use std::collections::BTreeMap;

use glam::Vec3;

use super::color;
use super::groups::VoxelGroup;
use super::loose::join_loose;
use super::planes::{PlaneKind, ScenePlane};
use super::standing::{extent, mean_color, owners};
use super::voxels::{Voxel, VoxelGrid};

/// Distance of voxels that touch, and of the folds of one curtain, cells.
const REACH: i32 = 2;
const FOLD_REACH: i32 = 6;

/// Limit on the rounds of joining.
const MAX_ROUNDS: usize = 4;

/// A way in which a fragment belongs to a thing. Measured on the fragment: its size over the thing's, the share of its
/// voxels that touch the thing, the color difference, and the diagonal of both over the longer one's.
struct Rule {
    max_size: f32,
    min_touching: f32,
    max_difference: f32,
    max_growth: f64,
}

/// A dent, a handle, and a part or slice of the same color.
const RULES: [Rule; 5] = [
    Rule { max_size: 0.25, min_touching: 0.6, max_difference: 18.0, max_growth: 1.15 },
    Rule { max_size: 0.05, min_touching: 0.85, max_difference: f32::INFINITY, max_growth: 1.1 },
    Rule { max_size: 0.05, min_touching: 0.3, max_difference: 12.0, max_growth: 1.1 },
    Rule { max_size: 0.25, min_touching: 0.2, max_difference: 8.0, max_growth: 1.25 },
    Rule { max_size: 1.0, min_touching: 0.15, max_difference: 8.0, max_growth: 1.2 },
];

/// Largest height, cells, of what is joined with a top: things stand on it, unless nearly all of them touches it.
const FLAKE_CELLS: f32 = 4.0;
const IN_TOP: f32 = 0.9;

/// Color difference from which a small thing on a wall is no part of it.
const ON_WALL_DIFFERENCE: f32 = 18.0;

/// Height over its wider side from which a body is a fold of a curtain, and least height over the scene's.
const FOLD_RATIO: f32 = 5.0;
const FOLD_HEIGHT: f32 = 0.4;

/// Largest color difference between the folds of a curtain.
const FOLD_DIFFERENCE: f32 = 15.0;

/// Length over the next longer side from which a group on a wall or a floor is its trim.
const TRIM_RATIO: f32 = 3.5;

/// Height over a wall or a floor up to which a group is its trim or a scrap, cells, and size up to which it is a scrap.
const SCRAP_CELLS: f32 = 4.0;
const SCRAP_VOXELS: usize = 100;

/// Largest standard deviation of the Gaussians of a thing, over its diagonal.
const MAX_BLUR: f32 = 0.1;

/// Standard deviation of the Gaussians of a blurred voxel, cells, and largest share of blurred voxels in a thing.
const BLURRED_CELLS: f32 = 2.0;
const MAX_BLURRED: f32 = 0.45;

/// Gaussians per voxel, over those of the scene, under which a thing is a blob or a wisp, and diagonal up to which it is
/// one, cells.
const BLOB_DENSITY: f32 = 0.45;
const BLOB_CELLS: f32 = 66.0;
const WISP_DENSITY: f32 = 0.345;
const WISP_CELLS: f32 = 40.0;

/// The same of a wash, which a capture did not see well, and least share of blurred voxels in it.
const WASH_DENSITY: f32 = 0.2;
const WASH_BLURRED: f32 = 0.5;
const WASH_CELLS: f32 = 100.0;

/// Share of its box that a seam between things fills, and share of it that touches them.
const SEAM_FILL: f32 = 0.04;
const SEAM_TOUCHING: f32 = 0.95;

/// Thickness of a wall over the room's extent, and share of the room's length and height that it covers.
const WALL_THICKNESS: f32 = 0.15;
const WALL_COVERED: f32 = 0.6;

/// The groups without fragments and scraps.
pub(crate) fn tidy(grid: &VoxelGrid, planes: &[ScenePlane], mut groups: Vec<VoxelGroup>) -> Vec<VoxelGroup> {
    join_loose(grid, &mut groups);
    let all: Vec<usize> = (0..grid.voxels.len()).collect();
    let mut pieces: Vec<Piece> = groups.into_iter().map(|group| Piece::new(grid, group)).collect();
    let room = extent(grid, &all);
    pieces.iter_mut().for_each(|piece| piece.is_wall = is_wall(&piece.bounds, room));
    join_folds(grid, &mut pieces, room);
    for _ in 0..MAX_ROUNDS {
        if !join_fragments(grid, &mut pieces) {
            break;
        }
    }
    dissolve_seams(grid, &mut pieces);
    let density = mean(grid, all.into_iter(), |voxel| voxel.num_centers);
    let is_kept = |piece: &Piece| !piece.is_wall && !is_scrap(grid, planes, piece) && !is_blurred(grid, piece, density);
    pieces.into_iter().filter(is_kept).map(|piece| piece.group).collect()
}

/// A group, measured.
struct Piece {
    group: VoxelGroup,
    bounds: (Vec3, Vec3),
    color_lab: Vec3,
    is_wall: bool,
}

impl Piece {
    fn new(grid: &VoxelGrid, group: VoxelGroup) -> Self {
        let (bounds, color_lab) = (extent(grid, &group.voxels), mean_color(grid, &group.voxels));
        Self { group, bounds, color_lab, is_wall: false }
    }

    fn len(&self) -> usize {
        self.group.voxels.len()
    }

    /// Sides in cells, longest first.
    fn sides(&self, grid: &VoxelGrid) -> [f32; 3] {
        let mut sides = ((self.bounds.1 - self.bounds.0) / grid.cell + 1.0).to_array();
        sides.sort_by(|a, b| b.total_cmp(a));
        sides
    }
}

/// Whether a box is that of a wall: flat, at an end of the room, and most of its length and height.
fn is_wall((low, high): &(Vec3, Vec3), room: (Vec3, Vec3)) -> bool {
    let whole = room.1 - room.0;
    let covered = (*high - *low) / whole;
    let at_end = (*low - room.0).min(room.1 - *high) / whole;
    let is_flat = |thin: usize, along: usize| {
        covered[thin] <= WALL_THICKNESS && at_end[thin] <= WALL_THICKNESS && covered[along] >= WALL_COVERED
    };
    covered.y >= WALL_COVERED && (is_flat(0, 2) || is_flat(2, 0))
}

/// Joins tall narrow bodies of one color beside each other: the folds of a curtain.
fn join_folds(grid: &VoxelGrid, pieces: &mut Vec<Piece>, room: (Vec3, Vec3)) {
    let is_fold = |piece: &Piece| {
        let sides = piece.bounds.1 - piece.bounds.0;
        !piece.group.is_surface
            && sides.y >= FOLD_RATIO * sides.x.max(sides.z)
            && sides.y >= FOLD_HEIGHT * (room.1.y - room.0.y)
    };
    let folds: Vec<bool> = pieces.iter().map(is_fold).collect();
    let mut owner = owners(grid, pieces.iter().map(|piece| &piece.group.voxels));
    for from in 0..pieces.len() {
        if !folds[from] {
            continue;
        }
        let near = touching(grid, &pieces[from].group.voxels, (from, &owner), FOLD_REACH);
        let fits = |&&to: &&usize| {
            folds[to] && color::difference(pieces[from].color_lab, pieces[to].color_lab) <= FOLD_DIFFERENCE
        };
        if let Some(&to) = near.keys().find(fits) {
            merge(grid, pieces, (from, to), &mut owner);
        }
    }
    pieces.retain(|piece| piece.len() > 0);
}

/// Joins every fragment with the thing that it belongs to, smallest first; whether there was one.
fn join_fragments(grid: &VoxelGrid, pieces: &mut Vec<Piece>) -> bool {
    let mut owner = owners(grid, pieces.iter().map(|piece| &piece.group.voxels));
    let mut order: Vec<usize> = (0..pieces.len()).collect();
    order.sort_by_key(|&i| (pieces[i].len(), i));
    let mut has_joined = false;
    for from in order {
        let near = touching(grid, &pieces[from].group.voxels, (from, &owner), REACH);
        let fits = |&(&to, &count): &(&usize, &usize)| belongs(grid, &pieces[from], &pieces[to], count);
        let best = near.iter().filter(fits).max_by_key(|&(&to, &count)| (count, std::cmp::Reverse(to)));
        if let Some((&to, _)) = best {
            merge(grid, pieces, (from, to), &mut owner);
            has_joined = true;
        }
    }
    pieces.retain(|piece| piece.len() > 0);
    has_joined
}

/// Whether a piece is a fragment of another one that `count` of its voxels touch.
fn belongs(grid: &VoxelGrid, piece: &Piece, whole: &Piece, count: usize) -> bool {
    let touching = count as f32 / piece.len() as f32;
    let size = piece.len() as f32 / whole.len() as f32;
    let difference = color::difference(piece.color_lab, whole.color_lab);
    if size > 1.0 || piece.is_wall || (piece.group.is_surface && !whole.group.is_surface) {
        return false;
    }
    if whole.is_wall && difference > ON_WALL_DIFFERENCE {
        return false;
    }
    let height = (piece.bounds.1.y - piece.bounds.0.y) / grid.cell + 1.0;
    if whole.group.is_surface && (height > FLAKE_CELLS || touching < RULES[0].min_touching) && touching < IN_TOP {
        return false;
    }
    let own = |piece: &Piece| (piece.bounds.1 - piece.bounds.0).length();
    let both = (whole.bounds.1.max(piece.bounds.1) - whole.bounds.0.min(piece.bounds.0)).length();
    let growth = f64::from(both / own(whole).max(own(piece)).max(f32::MIN_POSITIVE));
    RULES.iter().any(|rule| {
        size <= rule.max_size
            && touching >= rule.min_touching
            && difference <= rule.max_difference
            && growth <= rule.max_growth
    })
}

/// The number of voxels of a piece that touch every other piece.
fn touching(grid: &VoxelGrid, voxels: &[usize], (own, owner): (usize, &[usize]), reach: i32) -> BTreeMap<usize, usize> {
    let mut counts = BTreeMap::new();
    for &voxel in voxels {
        let mut near: Vec<usize> = grid.neighbors(voxel, reach).map(|other| owner[other]).collect();
        near.sort_unstable();
        near.dedup();
        for other in near.into_iter().filter(|&other| other != usize::MAX && other != own) {
            *counts.entry(other).or_default() += 1;
        }
    }
    counts
}

fn merge(grid: &VoxelGrid, pieces: &mut [Piece], (from, to): (usize, usize), owner: &mut [usize]) {
    let moved = std::mem::take(&mut pieces[from].group.voxels);
    moved.iter().for_each(|&voxel| owner[voxel] = to);
    let is_wall = pieces[to].is_wall;
    let VoxelGroup { mut voxels, is_surface, parent, name } =
        std::mem::replace(&mut pieces[to].group, VoxelGroup::whole(Vec::new(), false));
    voxels.extend(moved);
    pieces[to] = Piece { is_wall, ..Piece::new(grid, VoxelGroup { voxels, is_surface, parent, name }) };
}

/// Gives the voxels of every seam to the things on its sides, such as the fronts of a row of cupboards.
fn dissolve_seams(grid: &VoxelGrid, pieces: &mut Vec<Piece>) {
    let owner = owners(grid, pieces.iter().map(|piece| &piece.group.voxels));
    let sides = |seam: usize, voxel: usize| {
        let mut counts: BTreeMap<usize, usize> = BTreeMap::new();
        let others = grid.neighbors(voxel, REACH).map(|other| owner[other]);
        others
            .filter(|&other| other != usize::MAX && other != seam)
            .for_each(|other| *counts.entry(other).or_default() += 1);
        counts.into_iter().max_by_key(|&(other, count)| (count, std::cmp::Reverse(other))).map(|(other, _)| other)
    };
    for seam in 0..pieces.len() {
        let piece = &pieces[seam];
        let is_thin = piece.len() as f32 <= SEAM_FILL * piece.sides(grid).iter().product::<f32>();
        if piece.group.is_surface || piece.is_wall || piece.len() < SCRAP_VOXELS || !is_thin {
            continue;
        }
        let beside: Vec<Option<usize>> = piece.group.voxels.iter().map(|&voxel| sides(seam, voxel)).collect();
        if (beside.iter().flatten().count() as f32) < SEAM_TOUCHING * piece.len() as f32 {
            continue;
        }
        let moved = std::mem::take(&mut pieces[seam].group.voxels);
        for (voxel, side) in moved.into_iter().zip(beside) {
            if let Some(side) = side {
                pieces[side].group.voxels.push(voxel);
            }
        }
    }
    pieces.retain(|piece| piece.len() > 0);
    pieces.iter_mut().for_each(|piece| piece.bounds = extent(grid, &piece.group.voxels));
}

/// Whether a piece is a trim or a small scrap on a wall or the floor.
fn is_scrap(grid: &VoxelGrid, planes: &[ScenePlane], piece: &Piece) -> bool {
    let [a, b, _] = piece.sides(grid);
    let is_on = |plane: &ScenePlane| {
        let off = |&&v: &&usize| plane.height(grid.voxels[v].position).abs() > SCRAP_CELLS * grid.cell;
        plane.kind != PlaneKind::Support && piece.group.voxels.iter().filter(off).count() * 5 <= piece.len()
    };
    let is_small = piece.len() < SCRAP_VOXELS;
    !piece.group.is_surface && (a >= TRIM_RATIO * b || is_small) && planes.iter().any(is_on)
}

/// Whether a piece is a blur without a shape, filled by few large Gaussians. Large blurs are windows.
fn is_blurred(grid: &VoxelGrid, piece: &Piece, density: f32) -> bool {
    let of = |value: &dyn Fn(&Voxel) -> f32| mean(grid, piece.group.voxels.iter().copied(), value);
    let sparseness = of(&|voxel| voxel.num_centers) / density;
    let blurred = of(&|voxel| f32::from(u8::from(voxel.sigma > BLURRED_CELLS * grid.cell)));
    let size = (piece.bounds.1 - piece.bounds.0).length() / grid.cell;
    let is_blob = blurred > MAX_BLURRED && sparseness < BLOB_DENSITY && size < BLOB_CELLS;
    let is_wisp = sparseness < WISP_DENSITY && size < WISP_CELLS;
    let is_wash = blurred > WASH_BLURRED && sparseness < WASH_DENSITY && size < WASH_CELLS;
    is_blob || is_wisp || is_wash || of(&|voxel| voxel.sigma) / grid.cell > MAX_BLUR * size
}

fn mean(grid: &VoxelGrid, voxels: impl ExactSizeIterator<Item = usize>, value: impl Fn(&Voxel) -> f32) -> f32 {
    let count = voxels.len().max(1) as f32;
    voxels.map(|v| value(&grid.voxels[v])).sum::<f32>() / count
}

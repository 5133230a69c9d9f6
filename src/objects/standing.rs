//! What stands on what: bodies and tops become things, with the things on a top apart from the thing that it belongs to.

use std::collections::BTreeMap;

use glam::Vec3;

use super::color;
use super::segmentation::DisjointSets;
use super::tops::Top;
use super::voxels::VoxelGrid;

/// Share of a body's voxels that must lie under a top for the body to carry it.
const UNDER_FRAC: f32 = 0.6;

/// Depth below a top to which a thing that stands on it may reach, cells.
const SUNK_CELLS: f32 = 1.6;

/// Least share of the contacts of a top with all bodies under it that its carrier has.
const CARRIER_FRAC: f32 = 0.15;

/// Largest height of a foot over the floor, cells.
const FOOT_CELLS: i32 = 3;

/// Share of a body's contacts with the top that it touches most from below, under which it carries no other top: the
/// apron of a table touches the seats of the chairs under it.
const MAIN_FRAC: f32 = 0.2;

/// Share of a thing's contacts with a top at the edges of the top's box from which it is the top's own upright, such as a
/// backrest.
const RIM_FRAC: f32 = 0.75;

/// Distance from the edges of a top's box that counts as its rim, cells.
const RIM_CELLS: f32 = 3.5;

/// Share of the longer side of a top's box along which its own upright stands.
const UPRIGHT_FRAC: f32 = 0.4;

/// Least share of the edge of a seat and of its backrest that lie above each other, and largest thickness of the backrest
/// over that edge.
const BACK_SHARED: f32 = 0.7;
const BACK_THIN: f32 = 0.35;

/// Least height of a backrest over the length of that edge.
const BACK_HEIGHT: f32 = 0.5;

/// Least distance by which what stands in a top reaches beyond it, cells.
const OVERHANG_CELLS: f32 = 1.0;

/// Largest side of a seat, cells.
const SEAT_CELLS: f32 = 24.0;

/// Largest color difference between a top and its own upright.
const SAME_COLOR: f32 = 9.0;

/// Least overlap of the footprints of two tops that are boards of one shelf.
const SAME_FOOTPRINT: f32 = 0.75;

/// Largest thickness of a board, cells, and least share of its underside under it.
const BOARD_CELLS: f32 = 3.0;
const UNDERSIDE_INSIDE: f32 = 0.9;

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

/// Joins every top with the bodies that carry it. Things larger than `max_diagonal` (cells), such as a row of counters,
/// come apart again.
pub(crate) fn join(
    grid: &VoxelGrid,
    bodies: &[Vec<usize>],
    tops: &[Top],
    (is_structure, max_diagonal): (&[bool], f64),
) -> Things {
    let num_bodies = bodies.len();
    let owner = owners(grid, bodies);
    let measured: Vec<Body> = bodies.iter().map(|voxels| Body::new(grid, voxels)).collect();
    let touching: Vec<BTreeMap<usize, Contact>> = tops.iter().map(|top| contacts(grid, top, &owner)).collect();
    let mut most_below = vec![0_usize; num_bodies];
    for (&body, contact) in touching.iter().flatten() {
        most_below[body] = most_below[body].max(contact.below);
    }
    // Sets of bodies and tops, tops after bodies.
    let mut sets = DisjointSets::new(num_bodies + tops.len());
    join_boards(grid, tops, num_bodies, &mut sets);
    for (t, (top, contacts)) in tops.iter().zip(&touching).enumerate() {
        let seat = Seat::new(grid, top, contacts);
        let rests = |body: usize| seat.holds(grid, &measured[body]);
        // A foot carries one thing and stands on the floor.
        let only = contacts.keys().next().copied().filter(|&only| contacts.len() == 1 && rests(only));
        if let Some(only) = only.filter(|_| is_on_structure(grid, top, is_structure)) {
            sets.join(only, num_bodies + t);
            continue;
        }
        let floats = |&body: &usize| !contacts.contains_key(&body) && seat.is_backrest(grid, &measured[body]);
        (0..num_bodies).filter(floats).for_each(|body| {
            sets.join(body, num_bodies + t);
        });
        for (&body, contact) in contacts {
            let carries = if rests(body) {
                seat.is_upright(&measured[body], contact)
                    || seat.is_backrest(grid, &measured[body])
                    || seat.is_overhung(grid, &measured[body])
            } else {
                let is_main = contact.below as f32 >= MAIN_FRAC * most_below[body] as f32;
                is_main && seat.is_carried(contact, || under_frac(grid, &bodies[body], top))
            };
            if carries {
                sets.join(body, num_bodies + t);
            }
        }
    }
    assemble(grid, bodies, tops, (&mut sets, max_diagonal))
}

/// Whether a top lies on the structure: the foot of a lamp on the floor.
fn is_on_structure(grid: &VoxelGrid, top: &Top, is_structure: &[bool]) -> bool {
    let lies = |&&voxel: &&usize| {
        let level = grid.voxels[voxel].key[1];
        grid.neighbors(voxel, FOOT_CELLS).any(|other| is_structure[other] && grid.voxels[other].key[1] < level)
    };
    top.voxels.iter().filter(lies).count() * 2 >= top.voxels.len()
}

/// A body, measured.
struct Body {
    lowest: f32,
    bounds: (Vec3, Vec3),
    color_lab: Vec3,
    sides: Vec3,
}

impl Body {
    fn new(grid: &VoxelGrid, voxels: &[usize]) -> Self {
        let (low, high) = extent(grid, voxels);
        Self {
            lowest: lowest(grid, voxels),
            bounds: (low, high),
            color_lab: mean_color(grid, voxels),
            sides: high - low,
        }
    }
}

/// A top, measured.
struct Seat {
    height: f32,
    bounds: (Vec3, Vec3),
    color_lab: Vec3,
    sides: Vec3,
    /// Contacts with all bodies under it.
    total_below: usize,
}

impl Seat {
    fn new(grid: &VoxelGrid, top: &Top, contacts: &BTreeMap<usize, Contact>) -> Self {
        let (low, high) = extent(grid, &top.voxels);
        let total_below = contacts.values().map(|contact| contact.below).sum();
        Self {
            height: top.height,
            bounds: (low, high),
            color_lab: mean_color(grid, &top.voxels),
            sides: high - low,
            total_below,
        }
    }

    /// Whether a body that touches the top stands on it.
    fn holds(&self, grid: &VoxelGrid, body: &Body) -> bool {
        body.lowest > self.height - SUNK_CELLS * grid.cell
    }

    /// Whether a body on the top is its own upright.
    fn is_upright(&self, body: &Body, contact: &Contact) -> bool {
        let at_rim = contact.rim as f32 >= RIM_FRAC * contact.above as f32;
        let longer = |sides: Vec3| sides.x.max(sides.z);
        let is_long = longer(body.sides) >= UPRIGHT_FRAC * longer(self.sides);
        at_rim && is_long && color::difference(body.color_lab, self.color_lab) < SAME_COLOR
    }

    /// Whether a body is the backrest of the top, which may be held by posts that are thinner than a cell: it is about as
    /// long as one edge of the top, and thin above that edge.
    fn is_backrest(&self, grid: &VoxelGrid, body: &Body) -> bool {
        let ((low, high), (bottom, top)) = (self.bounds, body.bounds);
        let gap = bottom.y - self.height;
        let is_above = |along: usize, across: usize| {
            let edge = high[along] - low[along];
            let shared = high[along].min(top[along]) - low[along].max(bottom[along]);
            let middle = f32::midpoint(bottom[across], top[across]);
            let beside = (middle - low[across]).abs().min((middle - high[across]).abs());
            shared >= BACK_SHARED * edge
                && shared >= BACK_SHARED * body.sides[along]
                && body.sides[across] <= BACK_THIN * edge
                && beside <= RIM_CELLS * grid.cell
                && gap <= edge
                && body.sides.y >= BACK_HEIGHT * edge
        };
        let is_seat = (high.x - low.x).max(high.z - low.z) <= SEAT_CELLS * grid.cell;
        is_seat && gap > 0.0 && (is_above(0, 2) || is_above(2, 0))
    }

    /// Whether a body on the top reaches beyond it on all sides: the crown of a plant, on the soil in its pot.
    fn is_overhung(&self, grid: &VoxelGrid, body: &Body) -> bool {
        let ((low, high), (bottom, top)) = (self.bounds, body.bounds);
        let over = |axis: usize| (low[axis] - bottom[axis]).min(top[axis] - high[axis]);
        over(0).min(over(2)) > OVERHANG_CELLS * grid.cell
    }

    /// Whether a body under the top carries it. `under_frac`: the share of the body under the top.
    fn is_carried(&self, contact: &Contact, under_frac: impl FnOnce() -> f32) -> bool {
        let share = contact.below as f32 / self.total_below.max(1) as f32;
        contact.below > 0 && (share >= CARRIER_FRAC || under_frac() >= UNDER_FRAC)
    }
}

/// Joins the boards of a shelf: tops over each other with nearly the same footprint.
fn join_boards(grid: &VoxelGrid, tops: &[Top], num_bodies: usize, sets: &mut DisjointSets) {
    let boxes: Vec<(Vec3, Vec3)> = tops.iter().map(|top| extent(grid, &top.voxels)).collect();
    let is_underside = |lower: usize, upper: usize| {
        let gap = tops[upper].height - tops[lower].height;
        let (a, b) = (boxes[lower], boxes[upper]);
        gap > 0.0 && gap <= BOARD_CELLS * grid.cell && footprint_area(a) <= footprint_area(b) && is_above(a, b)
    };
    let is_same = |a: usize, b: usize| {
        footprint_overlap(boxes[a], boxes[b]) >= SAME_FOOTPRINT || is_underside(a, b) || is_underside(b, a)
    };
    for t in 0..tops.len() {
        for other in (0..t).filter(|&other| is_same(t, other)) {
            sets.join(num_bodies + t, num_bodies + other);
        }
    }
}

/// Overlap of two boxes seen from above: intersection over union.
pub(crate) fn footprint_overlap(a: (Vec3, Vec3), b: (Vec3, Vec3)) -> f32 {
    let shared = footprint_area((a.0.max(b.0), a.1.min(b.1)));
    shared / (footprint_area(a) + footprint_area(b) - shared).max(f32::MIN_POSITIVE)
}

pub(crate) fn footprint_area((low, high): (Vec3, Vec3)) -> f32 {
    (high.x - low.x).max(0.0) * (high.z - low.z).max(0.0)
}

/// Whether the underside of a board lies under the board, and under half of it at least.
fn is_above(under: (Vec3, Vec3), board: (Vec3, Vec3)) -> bool {
    let shared = footprint_area((under.0.max(board.0), under.1.min(board.1)));
    shared >= UNDERSIDE_INSIDE * footprint_area(under) && shared >= 0.5 * footprint_area(board)
}

/// The things of the sets of bodies and tops.
fn assemble(
    grid: &VoxelGrid,
    bodies: &[Vec<usize>],
    tops: &[Top],
    (sets, max_diagonal): (&mut DisjointSets, f64),
) -> Things {
    let all: Vec<usize> = (0..bodies.len() + tops.len()).collect();
    let is_top = |item: usize| item >= bodies.len();
    let of = |item: usize| if is_top(item) { &tops[item - bodies.len()].voxels } else { &bodies[item] };
    let mut things = Things { voxels: Vec::new(), is_surface: Vec::new() };
    for group in sets.groups(&all) {
        let union: Vec<usize> = group.iter().flat_map(|&item| of(item).iter().copied()).collect();
        let (low, high) = extent(grid, &union);
        if f64::from((high - low).length() / grid.cell) > max_diagonal {
            things.is_surface.extend(group.iter().map(|&item| is_top(item)));
            things.voxels.extend(group.iter().map(|&item| of(item).clone()));
        } else {
            things.is_surface.push(group.iter().all(|&item| is_top(item)));
            things.voxels.push(union);
        }
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

pub(crate) fn lowest(grid: &VoxelGrid, body: &[usize]) -> f32 {
    let mut heights: Vec<f32> = body.iter().map(|&v| grid.voxels[v].position.y).collect();
    let at = heights.len() / 50;
    if heights.is_empty() { 0.0 } else { *heights.select_nth_unstable_by(at, f32::total_cmp).1 }
}

/// Mean color of some voxels, CIE Lab.
pub(crate) fn mean_color(grid: &VoxelGrid, voxels: &[usize]) -> Vec3 {
    voxels.iter().map(|&v| grid.voxels[v].color_lab).sum::<Vec3>() / voxels.len().max(1) as f32
}

/// For each voxel the index of its group; `usize::MAX` where it is in none.
pub(crate) fn owners<'a>(grid: &VoxelGrid, groups: impl IntoIterator<Item = &'a Vec<usize>>) -> Vec<usize> {
    let mut owner = vec![usize::MAX; grid.voxels.len()];
    for (i, group) in groups.into_iter().enumerate() {
        group.iter().for_each(|&voxel| owner[voxel] = i);
    }
    owner
}

//! Flat things on floors and walls: rugs, pictures, doors, windows.
//!
//! Enters: a plane of the structure. Leaves: groups of its voxels that differ from it in color. Things on walls and floors
//! are mostly rectangles, so that a group is filled to its rectangle.

use std::collections::{BTreeMap, BTreeSet};

use glam::{Vec3, Vec3Swizzles};

use super::color;
use super::outlines::{Rectangle, area, components_within, holds_several, is_in, outline, rectangle, sides};
use super::planes::{PlaneKind, ScenePlane};
use super::relief::Surface;
use super::segmentation::split_by_color;
use super::standing::mean_color;
use super::valleys::{cut, cut_at_step};
use super::voxels::VoxelGrid;

/// Least difference in hue and chroma, and in lightness, between a plane and a thing on it (CIE Lab). Light and shadow
/// change the lightness of a wall more than its hue.
const CHROMA_DIFFERENCE: f32 = 10.0;
const LIGHTNESS_DIFFERENCE: f32 = 24.0;

/// Height over its wall from which a voxel belongs to a thing on it, cells: less than the thickness of a picture.
const RELIEF_CELLS: f32 = 0.4;

/// The same where the wall is even, and over an even floor: less than the thickness of a mirror, and than the pile of a rug.
const WALL_RELIEF_CELLS: f32 = 0.2;
const PILE_CELLS: f32 = 0.15;

/// Width of the rim of a rug, cells.
const RIM_CELLS: usize = 2;

/// Scale and least size of the regions of one color on a plane.
const SCALE: f32 = 140.0;
const MIN_REGION: usize = 12;

/// Least number of cells of a thing.
const MIN_CELLS: usize = 60;

/// Least share of the rectangle that the differing cells cover.
const MIN_FILL: f32 = 0.55;

/// Largest share of a plane's cells that one thing covers.
const MAX_SHARE: f32 = 0.45;

/// Least width of a thing, cells, and largest length over its width: what is longer is a skirting board, a cornice or the
/// shade in a corner.
const STRIP_CELLS: f32 = 4.0;
const STRIP_RATIO: f32 = 9.0;

/// Least number of cells of a rim around a thing, over those around its rectangle.
const MIN_RIM: f32 = 0.6;

/// Height over the floor up to which a thing on a wall stands on it, cells.
const FOOT_CELLS: i32 = 5;

/// Width of the trims along the ends of a wall, cells.
const TRIM_CELLS: i32 = 3;

/// Share of a thing's cells that stand out from the wall, under which it must differ in hue.
const MIN_RAISED: f32 = 0.3;

/// Least cosine between the normals of parallel walls, least distance between them, cells, and least share of the front
/// one's length before the other one.
const PARALLEL: f32 = 0.95;
const APART_CELLS: f32 = 5.0;
const SHARED_FRAC: f32 = 0.5;

/// Largest share of a rug at the border of its floor.
const MAX_OUTER: f32 = 0.45;

/// Least lightness of sunlight on a floor over the floor's, least chroma in the floor's hue over what light alone would
/// give, and largest share of its rectangle: patches of generated rooms had 31 to 54, .47 to .73 and .60 to .89, rugs as
/// light .12 to .37 and .87 to 1.
const SUNLIT_LIGHTNESS: f32 = 30.0;
const SUNLIT_CHROMA: f32 = 0.42;
const SUNLIT_FILL: f32 = 0.92;

/// Height of the valley between two things on a wall over the lower one's, of things that hang and of those that stand on the
/// floor. Between pictures that hang a cell apart it was .57 to .66, because the cells of the valley hold their edges too;
/// inside pictures at least .74.
const HUNG_VALLEY: f32 = 0.7;
const STANDING_VALLEY: f32 = 0.5;

/// Least intersection over union of two outlines of one thing.
const SAME_SHARE: f32 = 0.7;

/// Limit on the things of one plane: a pattern of tiles has more.
const MAX_THINGS: usize = 14;

/// The flat things on floors and walls among the voxels of the structure, each as voxels, and what is left of the planes.
pub(crate) fn flats<'a>(
    grid: &'a VoxelGrid,
    planes: &'a [ScenePlane],
    is_structure: &[bool],
) -> (Vec<Vec<usize>>, Vec<PlaneCells<'a>>) {
    let mut taken = vec![false; grid.voxels.len()];
    let (mut flats, mut left) = (Vec::new(), Vec::new());
    let has_things = |plane: &&ScenePlane| {
        plane.kind == PlaneKind::Floor || (plane.kind == PlaneKind::Wall && is_seen(planes, plane, grid.cell))
    };
    for plane in planes.iter().filter(has_things) {
        let near = |&v: &usize| {
            let p = grid.voxels[v].position;
            is_structure[v] && !taken[v] && plane.height(p).abs() < 2.0 * grid.cell && plane.spans(p)
        };
        let voxels: Vec<usize> = (0..grid.voxels.len()).filter(near).collect();
        let regions = split_by_color(grid, &voxels, SCALE, MIN_REGION);
        let Some(mut cells) = PlaneCells::new(grid, plane, &voxels, &regions) else { continue };
        let found = on_plane(&mut cells, &regions);
        left.push(cells);
        found.iter().flatten().for_each(|&voxel| taken[voxel] = true);
        flats.extend(found);
    }
    (flats, left)
}

/// Whether no other wall stands before a wall.
pub(crate) fn is_seen(planes: &[ScenePlane], wall: &ScenePlane, cell: f32) -> bool {
    planes.iter().all(|other| !is_before(other, wall, cell))
}

/// Whether one wall stands before another one, which is the view through its windows.
fn is_before(wall: &ScenePlane, other: &ScenePlane, cell: f32) -> bool {
    let is_parallel = wall.kind == PlaneKind::Wall && wall.normal.dot(other.normal) > PARALLEL;
    let ((a, b), (c, d)) = (wall.extent[0], other.extent[0]);
    is_parallel && wall.offset > other.offset + APART_CELLS * cell && b.min(d) - a.max(c) > SHARED_FRAC * (b - a)
}

/// The cells of a plane by their position in it.
pub(crate) struct PlaneCells<'a> {
    pub(crate) grid: &'a VoxelGrid,
    pub(crate) plane: &'a ScenePlane,
    color_lab: Vec3,
    /// The voxels of every cell that no thing has taken.
    pub(crate) cells: BTreeMap<[i32; 2], Vec<usize>>,
    /// Cells whose color differs from the plane's, or that stand out from it.
    pub(crate) differing: BTreeSet<[i32; 2]>,
    /// Cells that stand out from the plane.
    raised: BTreeSet<[i32; 2]>,
    /// Height of every cell over the plane.
    pub(crate) heights: BTreeMap<[i32; 2], f32>,
    /// Height from which a cell stands out.
    pub(crate) relief: f32,
}

impl<'a> PlaneCells<'a> {
    /// `None` for a plane without voxels.
    fn new(grid: &'a VoxelGrid, plane: &'a ScenePlane, voxels: &[usize], regions: &[Vec<usize>]) -> Option<Self> {
        // A rug may cover most of a floor, but not its border.
        let is_plane = |v: usize| plane.kind == PlaneKind::Wall || plane.is_border(grid.voxels[v].position);
        let of_plane: Vec<usize> = voxels.iter().copied().filter(|&v| is_plane(v)).collect();
        let color_lab = most_frequent(&of_plane.iter().map(|&v| grid.voxels[v].color_lab).collect::<Vec<Vec3>>())?;
        let surface = surface(grid, plane, &of_plane);
        let height = |v: usize| surface.height(in_plane(plane, grid.voxels[v].position));
        let least = if plane.kind == PlaneKind::Wall { WALL_RELIEF_CELLS } else { PILE_CELLS };
        let relief = surface.relief.clamp(least * grid.cell, RELIEF_CELLS * grid.cell);
        let is_raised = |v: usize| height(v) > relief;
        let (cells, differing, raised) = (BTreeMap::new(), BTreeSet::new(), BTreeSet::new());
        let mut all = Self { grid, plane, color_lab, cells, differing, raised, heights: BTreeMap::new(), relief };
        for region in regions {
            let differs = differs(mean_color(grid, region) - color_lab);
            for &v in region {
                let key = all.key(v);
                let is_raised = is_raised(v);
                all.cells.entry(key).or_default().push(v);
                let height = height(v);
                let highest = all.heights.entry(key).or_insert(0.0);
                *highest = highest.max(height);
                if is_raised {
                    all.raised.insert(key);
                }
                if differs || is_raised {
                    all.differing.insert(key);
                }
            }
        }
        Some(all)
    }

    pub(crate) fn is_wall(&self) -> bool {
        self.plane.kind == PlaneKind::Wall
    }

    pub(crate) fn key(&self, voxel: usize) -> [i32; 2] {
        key_at(self.grid, self.plane, voxel)
    }

    /// The cells that stand out from a wall, without its ends: skirting boards and cornices run along them, and connect
    /// doors with everything else.
    fn raised_apart(&self) -> BTreeSet<[i32; 2]> {
        let keys: Vec<[i32; 2]> = self.cells.keys().copied().collect();
        let (low, high) = rectangle(&keys);
        let inner = (low.map(|v| v + TRIM_CELLS), high.map(|v| v - TRIM_CELLS));
        self.raised.iter().copied().filter(|key| is_in(*key, inner)).collect()
    }

    /// The lowest row of cells.
    fn foot(&self) -> i32 {
        self.cells.keys().map(|key| key[1]).min().unwrap_or(0)
    }

    /// Whether a rectangle on a wall reaches down to its foot.
    fn is_at_foot(&self, bounds: Rectangle) -> bool {
        self.is_wall() && bounds.0[1] <= self.foot() + FOOT_CELLS
    }

    /// The outline of a region where it is one of a thing: `is_relief` where its cells stand out from the wall.
    fn outline_of_thing(&self, keys: &[[i32; 2]], is_relief: bool) -> Option<Vec<[i32; 2]>> {
        let mut bounds = rectangle(keys);
        let is_at_foot = self.is_at_foot(bounds);
        let stands = is_at_foot && is_relief;
        if stands {
            bounds.0[1] = self.foot();
        }
        if is_strip(bounds) || area(bounds) > MAX_SHARE * self.cells.len() as f32 {
            return None;
        }
        let mut outline = outline(keys, bounds, stands);
        outline.retain(|key| self.cells.contains_key(key));
        if outline.len() < MIN_CELLS || (outline.len() as f32) < MIN_FILL * area(bounds) {
            return None;
        }
        let share = |of: &BTreeSet<[i32; 2]>| {
            outline.iter().filter(|key| of.contains(*key)).count() as f32 / outline.len() as f32
        };
        let differs = self.differing.contains(&keys[0]);
        let is_apart = differs && share(&self.differing) >= MIN_FILL;
        let is_thing = if is_at_foot && share(&self.raised) < MIN_RAISED {
            // The wall behind furniture, in its shade.
            false
        } else if self.is_wall() {
            // The glass of a mirror may have the color of the wall around it: its rim differs.
            let is_rim = differs && keys.len() as f32 >= MIN_RIM * rim(bounds);
            is_rim || (is_apart && (share(&self.raised) >= MIN_RAISED || self.has_hue(&outline)))
        } else {
            let lies = is_relief || share(&self.raised) >= MIN_FILL;
            !self.is_border(&outline) && (lies || (is_apart && !self.is_sunlit(&outline, bounds)))
        };
        is_thing.then_some(outline)
    }

    /// The outlines of the things of some regions.
    fn outlines_of(&self, regions: &[Vec<[i32; 2]>], is_relief: bool) -> Vec<Vec<[i32; 2]>> {
        let large = regions.iter().filter(|keys| keys.len() >= MIN_CELLS / 2);
        large.flat_map(|keys| self.outlines_of_things(keys, is_relief)).collect()
    }

    /// Adds the cells beside an outline that differ from the floor: the rim of a rug is lower than the rug.
    fn add_rim(&self, outline: &mut Vec<[i32; 2]>) {
        let mut held: BTreeSet<[i32; 2]> = outline.iter().copied().collect();
        for _ in 0..RIM_CELLS {
            let around = held.iter().flat_map(|&[x, y]| [[x - 1, y], [x + 1, y], [x, y - 1], [x, y + 1]]);
            let rim: Vec<[i32; 2]> = around.filter(|key| self.differing.contains(key)).collect();
            held.extend(rim);
        }
        *outline = held.into_iter().collect();
    }

    /// Adds a voxel to what no thing has taken.
    fn put_back(&mut self, voxel: usize) {
        self.cells.entry(self.key(voxel)).or_default().push(voxel);
    }

    /// Takes the voxels in some outlines, those of the largest one first.
    fn take(&mut self, mut outlines: Vec<Vec<[i32; 2]>>) -> Vec<Vec<usize>> {
        outlines.sort_by_key(|outline| (std::cmp::Reverse(outline.len()), outline.first().copied()));
        let mut things = Vec::new();
        for outline in outlines {
            let voxels: Vec<usize> = outline.iter().filter_map(|key| self.cells.remove(key)).flatten().collect();
            if voxels.len() >= MIN_CELLS && voxels.len() as f32 >= MIN_FILL * outline.len() as f32 {
                things.push(voxels);
            }
        }
        things
    }

    /// The outlines of the things of a region: more than one where the wall is seen between them.
    fn outlines_of_things(&self, keys: &[[i32; 2]], is_relief: bool) -> Vec<Vec<[i32; 2]>> {
        let Some(whole) = self.outline_of_thing(keys, is_relief) else { return Vec::new() };
        let bounds = rectangle(keys);
        // A door has valleys between its panels.
        let deepest = if self.is_at_foot(bounds) { STANDING_VALLEY } else { HUNG_VALLEY };
        let sides = self.is_wall().then(|| cut(keys, bounds, &self.heights, deepest)).flatten();
        let hangs = self.is_wall() && !self.is_at_foot(bounds);
        let sides = sides.or_else(|| hangs.then(|| cut_at_step(&whole, bounds)).flatten());
        let sides = sides.filter(|sides| sides.iter().all(|keys| keys.len() >= MIN_CELLS / 2));
        let apart = sides.map(|sides| sides.map(|keys| self.outlines_of_things(&keys, is_relief)));
        match apart.filter(|apart| apart.iter().all(|outlines| !outlines.is_empty())) {
            Some(apart) => apart.into_iter().flatten().collect(),
            None => vec![whole],
        }
    }

    /// Whether much of a region lies at the border of its floor: a part of a floor of two colors, not a rug.
    fn is_border(&self, outline: &[[i32; 2]]) -> bool {
        let position = |key: &[i32; 2]| Some(self.grid.voxels[*self.cells.get(key)?.first()?].position);
        let num_outer = outline.iter().filter_map(position).filter(|&p| self.plane.is_border(p)).count();
        num_outer as f32 > MAX_OUTER * outline.len() as f32
    }

    /// Whether the cells of a floor are only lit by the sun: much lighter, of the floor's own hue, and no upright rectangle.
    fn is_sunlit(&self, outline: &[[i32; 2]], bounds: Rectangle) -> bool {
        let lit = self.color_of(outline);
        // Light scales all of L + 16, a and b alike, but highlights are paler.
        let scale = (lit.x + 16.0) / (self.color_lab.x + 16.0);
        let (own, floor) = (lit.yz(), self.color_lab.yz());
        let is_floor_hue = own.dot(floor) >= SUNLIT_CHROMA * scale * floor.length_squared();
        let is_slanted = (outline.len() as f32) < SUNLIT_FILL * area(bounds);
        lit.x - self.color_lab.x > SUNLIT_LIGHTNESS && is_floor_hue && is_slanted
    }

    fn color_of(&self, outline: &[[i32; 2]]) -> Vec3 {
        let voxels: Vec<usize> = outline.iter().filter_map(|key| self.cells.get(key)).flatten().copied().collect();
        mean_color(self.grid, &voxels)
    }

    /// Whether the cells differ from the plane in hue and chroma: shadows differ in lightness alone.
    fn has_hue(&self, outline: &[[i32; 2]]) -> bool {
        let step = self.color_of(outline) - self.color_lab;
        step.y.hypot(step.z) > CHROMA_DIFFERENCE
    }
}

/// A position along a plane, over it, and across it.
fn in_plane(plane: &ScenePlane, p: Vec3) -> Vec3 {
    let is_wall = plane.kind == PlaneKind::Wall;
    let (along, across) = if is_wall { (Vec3::Y.cross(plane.normal), Vec3::Y) } else { (Vec3::X, Vec3::Z) };
    Vec3::new(along.dot(p), plane.height(p), across.dot(p))
}

/// The cell of a voxel in a plane.
fn key_at(grid: &VoxelGrid, plane: &ScenePlane, voxel: usize) -> [i32; 2] {
    let p = in_plane(plane, grid.voxels[voxel].position) / grid.cell;
    [p.x.floor() as i32, p.z.floor() as i32]
}

/// The surface of most of a plane: the plane's own is that of all that lies near it.
fn surface(grid: &VoxelGrid, plane: &ScenePlane, voxels: &[usize]) -> Surface {
    let mut highest: BTreeMap<[i32; 2], Vec3> = BTreeMap::new();
    for &voxel in voxels {
        let p = in_plane(plane, grid.voxels[voxel].position);
        let held = highest.entry(key_at(grid, plane, voxel)).or_insert(p);
        if p.y > held.y {
            *held = p;
        }
    }
    Surface::of_points(&highest.into_values().collect::<Vec<Vec3>>(), grid.cell)
}

/// Takes the voxels of the things on a plane; `regions` are those of one color.
fn on_plane(all: &mut PlaneCells, regions: &[Vec<usize>]) -> Vec<Vec<usize>> {
    // A rug has several colors; what hangs on a wall is one region of color, or stands out from it.
    let things = if all.is_wall() {
        let colored: Vec<Vec<[i32; 2]>> =
            regions.iter().map(|region| region.iter().map(|&v| all.key(v)).collect()).collect();
        let raised = all.outlines_of(&components(all.raised_apart()), true);
        let mut outlines = all.outlines_of(&colored, false);
        outlines.retain(|outline| all.is_at_foot(rectangle(outline)) || !holds_several(outline, &raised, MIN_FILL));
        // Of a thing that was found twice, what stands out is more exact: its color goes on in frames beside it.
        outlines.retain(|outline| {
            all.is_at_foot(rectangle(outline)) || !raised.iter().any(|other| is_same(outline, other))
        });
        outlines.extend(raised);
        all.take(outlines)
    } else {
        // Sunlight and shade beside a rug are no part of it.
        let mut raised = all.outlines_of(&components(all.raised.clone()), true);
        raised.iter_mut().for_each(|outline| all.add_rim(outline));
        let of_raised: BTreeSet<[i32; 2]> = raised.iter().flatten().copied().collect();
        let mut things = all.take(raised);
        let colored = all.differing.difference(&of_raised).copied().collect();
        let colored = all.outlines_of(&components(colored), false);
        things.extend(all.take(colored));
        things
    };
    if things.len() > MAX_THINGS {
        for voxel in things.into_iter().flatten() {
            all.put_back(voxel);
        }
        return Vec::new();
    }
    things
}

/// Whether two outlines share most of their cells.
fn is_same(one: &[[i32; 2]], other: &[[i32; 2]]) -> bool {
    let held: BTreeSet<&[i32; 2]> = one.iter().collect();
    let shared = other.iter().filter(|key| held.contains(key)).count() as f32;
    shared >= SAME_SHARE * (one.len() + other.len()) as f32 / (1.0 + SAME_SHARE)
}

/// Whether a color step (CIE Lab) is that between two things.
pub(crate) fn differs(step: Vec3) -> bool {
    step.y.hypot(step.z) > CHROMA_DIFFERENCE || step.x.abs() > LIGHTNESS_DIFFERENCE
}

/// Number of cells around the inside of a rectangle.
fn rim(rectangle: Rectangle) -> f32 {
    2.0 * sides(rectangle).iter().sum::<f32>()
}

/// Whether a rectangle is a skirting board, a cornice, or the shade in a corner.
fn is_strip(rectangle: Rectangle) -> bool {
    let [a, b] = sides(rectangle);
    a.min(b) < STRIP_CELLS || a.max(b) > STRIP_RATIO * a.min(b)
}

/// The mean of the fullest bin of colors (10 units of CIE Lab) and its neighbors.
pub(crate) fn most_frequent(colors: &[Vec3]) -> Option<Vec3> {
    let bin = |color: &Vec3| (*color / 12.0).round().as_ivec3().to_array();
    let mut bins: BTreeMap<[i32; 3], usize> = BTreeMap::new();
    colors.iter().for_each(|color| *bins.entry(bin(color)).or_default() += 1);
    let fullest = bins.iter().max_by_key(|(key, count)| (**count, std::cmp::Reverse(**key)))?.0;
    let near = |color: &&Vec3| bin(color).iter().zip(fullest).all(|(a, b)| (a - b).abs() <= 1);
    let chosen: Vec<Vec3> = colors.iter().filter(near).copied().collect();
    Some(color::median(&chosen))
}

/// The connected components of some cells.
fn components(open: BTreeSet<[i32; 2]>) -> Vec<Vec<[i32; 2]>> {
    components_within(open, 1)
}

//! Flat things on floors and walls: rugs, pictures, doors, windows.
//!
//! Enters: a plane of the structure. Leaves: groups of its voxels that differ from it in color. Things on walls and floors
//! are mostly rectangles, so that a group is filled to its rectangle.

use std::collections::{BTreeMap, BTreeSet};

use glam::Vec3;

use super::color;
use super::planes::{PlaneKind, ScenePlane};
use super::segmentation::split_by_color;
use super::standing::mean_color;
use super::voxels::VoxelGrid;

/// Least difference in hue and chroma, and in lightness, between a plane and a thing on it (CIE Lab). Light and shadow
/// change the lightness of a wall more than its hue.
const CHROMA_DIFFERENCE: f32 = 10.0;
const LIGHTNESS_DIFFERENCE: f32 = 24.0;

/// Height over its wall from which a voxel belongs to a thing on it, cells: less than the thickness of a picture.
const RELIEF_CELLS: f32 = 0.4;

/// Scale and least size of the regions of one color on a plane.
const SCALE: f32 = 140.0;
const MIN_REGION: usize = 12;

/// Least number of cells of a thing.
const MIN_CELLS: usize = 60;

/// Least share of the rectangle that the differing cells cover.
const MIN_FILL: f32 = 0.55;

/// Largest share of a plane's cells that one thing covers.
const MAX_SHARE: f32 = 0.3;

/// Limit on the things of one plane: a pattern of tiles has more.
const MAX_THINGS: usize = 14;

/// The flat things on floors and walls among the voxels of the structure, each as voxels.
pub(crate) fn flats(grid: &VoxelGrid, planes: &[ScenePlane], is_structure: &[bool]) -> Vec<Vec<usize>> {
    let mut taken = vec![false; grid.voxels.len()];
    let mut flats = Vec::new();
    for plane in planes.iter().filter(|plane| matches!(plane.kind, PlaneKind::Floor | PlaneKind::Wall)) {
        let near = |&v: &usize| {
            let p = grid.voxels[v].position;
            is_structure[v] && !taken[v] && plane.height(p).abs() < 2.0 * grid.cell && plane.spans(p)
        };
        let voxels: Vec<usize> = (0..grid.voxels.len()).filter(near).collect();
        let found = on_plane(grid, plane, &voxels, &split_by_color(grid, &voxels, SCALE, MIN_REGION));
        found.iter().flatten().for_each(|&voxel| taken[voxel] = true);
        flats.extend(found);
    }
    flats
}

/// A cell of a plane: the voxels in it, and whether their color differs from the plane's.
struct Cell {
    voxels: Vec<usize>,
    differs: bool,
}

fn on_plane(grid: &VoxelGrid, plane: &ScenePlane, voxels: &[usize], regions: &[Vec<usize>]) -> Vec<Vec<usize>> {
    let along = if plane.kind == PlaneKind::Wall { Vec3::Y.cross(plane.normal) } else { Vec3::X };
    let across = if plane.kind == PlaneKind::Wall { Vec3::Y } else { Vec3::Z };
    let at = |v: usize| {
        let p = grid.voxels[v].position / grid.cell;
        [along.dot(p).floor() as i32, across.dot(p).floor() as i32]
    };
    let colors: Vec<Vec3> = voxels.iter().map(|&v| grid.voxels[v].color_lab).collect();
    let Some(plane_color) = most_frequent(&colors) else { return Vec::new() };
    let mut heights: Vec<f32> = voxels.iter().map(|&v| plane.height(grid.voxels[v].position)).collect();
    let middle = heights.len() / 2;
    let level = *heights.select_nth_unstable_by(middle, f32::total_cmp).1;
    let is_proud = |v: usize| plane.height(grid.voxels[v].position) - level > RELIEF_CELLS * grid.cell;
    let mut raised: BTreeSet<[i32; 2]> = BTreeSet::new();
    let mut cells: BTreeMap<[i32; 2], Cell> = BTreeMap::new();
    for region in regions {
        let step = mean_color(grid, region) - plane_color;
        let differs = step.y.hypot(step.z) > CHROMA_DIFFERENCE || step.x.abs() > LIGHTNESS_DIFFERENCE;
        for &v in region {
            let cell = cells.entry(at(v)).or_insert(Cell { voxels: Vec::new(), differs: false });
            cell.voxels.push(v);
            let is_raised = plane.kind == PlaneKind::Wall && is_proud(v);
            cell.differs |= differs || is_raised;
            if is_raised {
                raised.insert(at(v));
            }
        }
    }
    let differing: BTreeSet<[i32; 2]> = cells.iter().filter(|(_, cell)| cell.differs).map(|(key, _)| *key).collect();
    let mut rectangles: Vec<([i32; 2], [i32; 2])> = Vec::new();
    // A rug has several colors; what hangs on a wall is one region of color, or stands out from it.
    let regions: Vec<Vec<[i32; 2]>> = if plane.kind == PlaneKind::Wall {
        let regions = regions.iter().map(|region| region.iter().map(|&v| at(v)).collect());
        regions.chain(components(raised)).collect()
    } else {
        components(differing.clone())
    };
    for keys in regions.into_iter().filter(|keys| keys.len() >= MIN_CELLS) {
        let (low, high) = rectangle(&keys);
        let area = ((high[0] - low[0] + 1) * (high[1] - low[1] + 1)) as f32;
        let num_differing = differing.iter().filter(|key| is_in(**key, (low, high))).count() as f32;
        if differing.contains(&keys[0]) && num_differing >= MIN_FILL * area && area <= MAX_SHARE * cells.len() as f32 {
            rectangles.push((low, high));
        }
    }
    let area = |(low, high): &([i32; 2], [i32; 2])| (high[0] - low[0] + 1) * (high[1] - low[1] + 1);
    rectangles.sort_by_key(|rectangle| (std::cmp::Reverse(area(rectangle)), *rectangle));
    let mut things = Vec::new();
    for rectangle in rectangles {
        let filled: Vec<[i32; 2]> = cells.keys().copied().filter(|key| is_in(*key, rectangle)).collect();
        let voxels: Vec<usize> =
            filled.iter().filter_map(|key| cells.remove(key)).flat_map(|cell| cell.voxels).collect();
        if voxels.len() >= MIN_CELLS && voxels.len() as f32 >= MIN_FILL * area(&rectangle) as f32 {
            things.push(voxels);
        }
    }
    if things.len() > MAX_THINGS { Vec::new() } else { things }
}

fn is_in(key: [i32; 2], (low, high): ([i32; 2], [i32; 2])) -> bool {
    (0..2).all(|axis| (low[axis]..=high[axis]).contains(&key[axis]))
}

/// The mean of the fullest bin of colors (10 units of CIE Lab) and its neighbors.
fn most_frequent(colors: &[Vec3]) -> Option<Vec3> {
    let bin = |color: &Vec3| (*color / 12.0).round().as_ivec3().to_array();
    let mut bins: BTreeMap<[i32; 3], usize> = BTreeMap::new();
    colors.iter().for_each(|color| *bins.entry(bin(color)).or_default() += 1);
    let fullest = bins.iter().max_by_key(|(key, count)| (**count, std::cmp::Reverse(**key)))?.0;
    let near = |color: &&Vec3| bin(color).iter().zip(fullest).all(|(a, b)| (a - b).abs() <= 1);
    let chosen: Vec<Vec3> = colors.iter().filter(near).copied().collect();
    Some(color::median(&chosen))
}

/// The connected components of some cells.
fn components(mut open: BTreeSet<[i32; 2]>) -> Vec<Vec<[i32; 2]>> {
    let mut components = Vec::new();
    while let Some(start) = open.pop_first() {
        let mut component = vec![start];
        let mut at = 0;
        while at < component.len() {
            let [x, y] = component[at];
            let around = (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| [x + dx, y + dy]));
            component.extend(around.filter(|key| open.remove(key)).collect::<Vec<_>>());
            at += 1;
        }
        components.push(component);
    }
    components
}

/// The rectangle of some cells without their outermost 2 % on every side.
fn rectangle(keys: &[[i32; 2]]) -> ([i32; 2], [i32; 2]) {
    let ends = |axis: usize| {
        let mut values: Vec<i32> = keys.iter().map(|key| key[axis]).collect();
        values.sort_unstable();
        let cut = values.len() / 50;
        (values[cut], values[values.len() - 1 - cut])
    };
    let (x, y) = (ends(0), ends(1));
    ([x.0, y.0], [x.1, y.1])
}

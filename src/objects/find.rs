//! Objects of a scene that nobody has labelled.
//!
//! Enters: a scene. Leaves: objects with Gaussians, boxes and names. Floor, walls and ceiling are background (id 0);
//! tables, counters and shelves are objects of their own, and what stands on them is not part of them.

use std::collections::BTreeMap;

use glam::{DVec3, Vec3};
use rayon::prelude::*;

use super::planes::{PlaneKind, ScenePlane, find_planes};
use super::segments::{components, split_by_color};
use super::voxels::VoxelGrid;
use super::{Object, ObjectSet, boxes, color, naming};
use cinesplat_scene::Scene;

/// Knobs of the search for objects.
#[derive(Debug, Clone, PartialEq)]
pub struct FindSettings {
    /// Cells along the scene's size: more tell apart smaller and nearer things, at a cost that grows with their square.
    pub resolution: f64,
    /// Cells an object needs at least.
    pub min_voxels: usize,
    /// Objects kept, most prominent first.
    pub max_objects: usize,
    /// Share of the scene's size from which a connected thing is taken for furniture grown together and split by color.
    pub split_frac: f64,
    /// How much color must change within such a thing before it is split: CIE Lab units times cells.
    pub split_scale: f32,
    /// Seed of the plane search.
    pub seed: u64,
}

impl Default for FindSettings {
    fn default() -> Self {
        Self { resolution: 220.0, min_voxels: 24, max_objects: 60, split_frac: 0.3, split_scale: 140.0, seed: 0 }
    }
}

/// Margin of floor, walls and ceiling in cells: this near to one of them a cell is background.
const STRUCTURE_CELLS: f32 = 1.0;

/// How far behind a wall or under a floor cells are still taken for the wall's own, as a share of the scene's size.
const BEHIND_FRAC: f64 = 0.1;

/// How far a table top reaches past the cells that are plainly level.
const TOP_GROWTH_CELLS: usize = 4;

/// Difference in color from a wall's own from which something flat hangs on it: a picture, a screen, a window.
const HANGING_DIFFERENCE: f32 = 25.0;

/// Share of a wall's cells that have to be of about one color for the wall to be plain.
const PLAIN_FRAC: f32 = 0.75;

/// Share of a piece's neighbors that have to be of one other piece for the two to be one thing.
const REJOIN_FRAC: f64 = 0.5;

/// Share of the cells under a table top that one body needs to be the same object as the top.
const BODY_FRAC: f64 = 0.6;

/// Finds the objects of a scene, ids from 1 in order of prominence (how much surface they have, more when their color
/// stands out). The same scene and settings give the same objects.
///
/// Solid matter is put into cells; large level and upright planes are found with the scene's up; floor, walls and
/// ceiling are taken away and table tops set apart; cells that touch become one object, and what is too large for one
/// object in a room is split where color or direction changes. A capture without walls is not split: each
/// connected part is one object.
pub fn find(scene: &Scene, settings: &FindSettings) -> ObjectSet {
    let bounds = scene.bounds();
    let cell = bounds.size() / settings.resolution.max(1.0);
    if !(cell > 0.0 && cell.is_finite()) {
        return ObjectSet::default();
    }
    let grid = VoxelGrid::new(&scene.gaussians, cell, bounds.center(), boxes::upright_axes(scene.up));
    let planes = find_planes(&grid, (grid.voxels.len() / 300).max(60), settings.seed);
    let segments = segments(&grid, &planes, settings);
    let mut ranked = ranked(&grid, segments);
    ranked.truncate(settings.max_objects.min(usize::from(u16::MAX)));
    let labels = gaussian_labels(scene, &grid, &ranked);
    let surfaces: Vec<bool> = ranked.iter().map(|segment| segment.is_surface).collect();
    assemble(scene, scene.up, labels, &|id| surfaces.get(id as usize - 1).copied().unwrap_or(false))
}

/// The objects of given labels: every id above 0 becomes one, with a box and a name of what can be measured.
pub fn from_labels(scene: &Scene, labels: Vec<u16>) -> ObjectSet {
    assemble(scene, scene.up, labels, &|_| false)
}

fn assemble(scene: &Scene, up: DVec3, labels: Vec<u16>, is_surface: &dyn Fn(u32) -> bool) -> ObjectSet {
    let size = scene.bounds().size();
    let mut objects = Vec::new();
    for (id, members) in boxes::members_by_id(&labels) {
        let Some(fitted) = boxes::fit(&scene.gaussians, &members, up) else { continue };
        let label = naming::describe(&scene.gaussians, &members, &fitted, (size, is_surface(id)));
        objects.push(Object {
            id,
            label,
            center: fitted.center,
            half_extents: fitted.half_extents,
            rotation: fitted.rotation,
            num_gaussians: members.len(),
            points: Vec::new(),
            shape_radius: 0.0,
            mask_iou: 0.0,
        });
    }
    naming::make_unique(&mut objects);
    ObjectSet { objects, labels }
}

/// Cells of one object to be.
struct Segment {
    voxels: Vec<usize>,
    /// Nothing but a level plane.
    is_surface: bool,
}

/// What a cell is before objects are made of them.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Role {
    Free,
    Structure,
    Support(usize),
}

fn segments(grid: &VoxelGrid, planes: &[ScenePlane], settings: &FindSettings) -> Vec<Segment> {
    let roles = roles(grid, planes, settings);
    let of = |wanted: Role| (0..roles.len()).filter(|&v| roles[v] == wanted).collect::<Vec<_>>();
    let is_room = planes.iter().any(|plane| matches!(plane.kind, PlaneKind::Wall | PlaneKind::Ceiling));
    let mut bodies = Vec::new();
    let mut fragments = Vec::new();
    let free = of(Role::Free);
    for part in if is_room { components(grid, &free, 1) } else { whole_things(grid, &free) } {
        let is_grown = is_room && diagonal(grid, part.iter().copied()) > settings.split_frac * settings.resolution;
        let pieces = if is_grown {
            let pieces = split_by_color(grid, &part, settings.split_scale, settings.min_voxels);
            rejoin(grid, pieces, settings.split_frac * settings.resolution)
        } else {
            vec![part]
        };
        for piece in pieces {
            if piece.len() < settings.min_voxels { fragments.extend(piece) } else { bodies.push(piece) }
        }
    }
    fragments.sort_unstable();
    let (large, small): (Vec<_>, Vec<_>) =
        components(grid, &fragments, 2).into_iter().partition(|part| part.len() >= settings.min_voxels);
    bodies.extend(large);
    attach(grid, small, &mut bodies);
    let mut segments: Vec<Segment> = bodies.into_iter().map(|voxels| Segment { voxels, is_surface: false }).collect();
    for plane in 0..planes.len() {
        for top in components(grid, &of(Role::Support(plane)), 1) {
            add_top(grid, top, &mut segments, settings.min_voxels);
        }
    }
    segments
}

/// The connected parts of a capture that is no room; whatever is a twentieth of the largest or less is taken for a loose
/// bit of it, such as a leaf or the inside of a shell.
fn whole_things(grid: &VoxelGrid, voxels: &[usize]) -> Vec<Vec<usize>> {
    let mut parts = components(grid, voxels, 2);
    parts.sort_by_key(|part| std::cmp::Reverse(part.len()));
    let Some(least) = parts.first().map(|largest| largest.len() / 20) else { return parts };
    let bits = parts.split_off(parts.partition_point(|part| part.len() > least));
    parts[0].extend(bits.into_iter().flatten());
    parts
}

/// Joins pieces that belong to one thing of several colors: a piece most of whose neighbors are of one other piece goes
/// to it, as long as both together are not too large for one object (`max_diagonal`, cells). A pot and its plant, a
/// door and its handle; not the doors of a row, which have neighbors on both sides.
fn rejoin(grid: &VoxelGrid, mut pieces: Vec<Vec<usize>>, max_diagonal: f64) -> Vec<Vec<usize>> {
    let owner = owners(grid, &pieces);
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

/// Puts every fragment to the body that is near most of it; fragments near none are left out.
fn attach(grid: &VoxelGrid, fragments: Vec<Vec<usize>>, bodies: &mut [Vec<usize>]) {
    let owner = owners(grid, bodies);
    for fragment in fragments {
        let contacts = contacts(grid, &fragment, &owner, 2);
        if let Some((&body, _)) = contacts.iter().max_by_key(|&(&i, &count)| (count, std::cmp::Reverse(i))) {
            bodies[body].extend(fragment);
        }
    }
}

/// For each voxel the group that it is in, `usize::MAX` for none.
fn owners(grid: &VoxelGrid, groups: &[Vec<usize>]) -> Vec<usize> {
    let mut owner = vec![usize::MAX; grid.voxels.len()];
    for (i, group) in groups.iter().enumerate() {
        for &voxel in group {
            owner[voxel] = i;
        }
    }
    owner
}

/// How many pairs of voxels at most `reach` cells apart a group has with each other group.
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

/// Puts a level piece to the body that carries it; a piece with many or no bodies becomes an object where it is large.
fn add_top(grid: &VoxelGrid, top: Vec<usize>, segments: &mut Vec<Segment>, min_voxels: usize) {
    let mut owner = vec![usize::MAX; grid.voxels.len()];
    for (i, segment) in segments.iter().enumerate() {
        for &voxel in &segment.voxels {
            owner[voxel] = i;
        }
    }
    let mut contacts = vec![0_usize; segments.len()];
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
        Some(body) => segments[body].voxels.extend(top),
        None if top.len() >= min_voxels => segments.push(Segment { voxels: top, is_surface: true }),
        None => {}
    }
}

fn roles(grid: &VoxelGrid, planes: &[ScenePlane], settings: &FindSettings) -> Vec<Role> {
    let behind = (BEHIND_FRAC * settings.resolution) as f32 * grid.cell;
    let mut roles = vec![Role::Free; grid.voxels.len()];
    for (i, plane) in planes.iter().enumerate() {
        let role = if plane.kind == PlaneKind::Support { Role::Support(i) } else { Role::Structure };
        if plane.kind != PlaneKind::Wall {
            for &voxel in &plane.voxels {
                roles[voxel] = role;
            }
        }
    }
    grow_tops(grid, planes, &mut roles);
    for plane in planes.iter().filter(|plane| plane.kind != PlaneKind::Support) {
        let paint = plain_color(grid, plane);
        for (role, voxel) in roles.iter_mut().zip(&grid.voxels) {
            if paint.is_some_and(|paint| color::difference(voxel.color_lab, paint) > HANGING_DIFFERENCE) {
                continue;
            }
            let height = plane.height(voxel.position);
            if height < STRUCTURE_CELLS * grid.cell && height > -behind && plane.spans(voxel.position) {
                *role = Role::Structure;
            }
        }
    }
    roles
}

/// Adds to table tops the cells level with them and beside them, whatever their normals: those at edges and under what
/// stands there would tie it to the table.
fn grow_tops(grid: &VoxelGrid, planes: &[ScenePlane], roles: &mut [Role]) {
    for (i, plane) in planes.iter().enumerate().filter(|(_, plane)| plane.kind == PlaneKind::Support) {
        let mut edge = plane.voxels.clone();
        for _ in 0..TOP_GROWTH_CELLS {
            let mut beside: Vec<usize> = edge.iter().flat_map(|&voxel| grid.neighbors(voxel, 1)).collect();
            beside.sort_unstable();
            beside.dedup();
            beside.retain(|&v| roles[v] == Role::Free && plane.height(grid.voxels[v].position).abs() <= grid.cell);
            for &voxel in &beside {
                roles[voxel] = Role::Support(i);
            }
            edge = beside;
        }
    }
}

/// The color of a wall that has one nearly all over; `None` of patterned walls, whose pattern is nothing that hangs
/// there, and of other planes.
fn plain_color(grid: &VoxelGrid, plane: &ScenePlane) -> Option<Vec3> {
    let paint = typical_color(grid, &plane.voxels);
    let plain = |&&v: &&usize| color::difference(grid.voxels[v].color_lab, paint) <= HANGING_DIFFERENCE;
    let share = plane.voxels.iter().filter(plain).count() as f32 / plane.voxels.len().max(1) as f32;
    (plane.kind == PlaneKind::Wall && share >= PLAIN_FRAC).then_some(paint)
}

/// Median color of some voxels, channel by channel.
fn typical_color(grid: &VoxelGrid, voxels: &[usize]) -> Vec3 {
    let median = |channel: usize| {
        let mut values: Vec<f32> = voxels.iter().map(|&v| grid.voxels[v].color_lab[channel]).collect();
        let middle = values.len() / 2;
        if values.is_empty() { 0.0 } else { *values.select_nth_unstable_by(middle, f32::total_cmp).1 }
    };
    Vec3::new(median(0), median(1), median(2))
}

/// Diagonal of some voxels' box in cells.
fn diagonal(grid: &VoxelGrid, voxels: impl Iterator<Item = usize>) -> f64 {
    let start = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    let (low, high) = voxels.map(|v| grid.voxels[v].position).fold(start, |(low, high), p| (low.min(p), high.max(p)));
    f64::from((high - low).length() / grid.cell)
}

/// Most prominent first: the root of the number of cells, times how far the color is from the scene's mean.
fn ranked(grid: &VoxelGrid, mut segments: Vec<Segment>) -> Vec<Segment> {
    let color = |voxels: &mut dyn Iterator<Item = usize>| {
        let (sum, count) = voxels.fold((Vec3::ZERO, 0), |(sum, n), v| (sum + grid.voxels[v].color_lab, n + 1));
        sum / count.max(1) as f32
    };
    let overall = color(&mut (0..grid.voxels.len()));
    let prominence = |segment: &Segment| {
        let apart = (color(&mut segment.voxels.iter().copied()) - overall).length();
        (segment.voxels.len() as f32).sqrt() * (0.3 + (apart / 60.0).min(1.0))
    };
    segments.sort_by(|a, b| prominence(b).total_cmp(&prominence(a)).then(a.voxels.first().cmp(&b.voxels.first())));
    segments
}

/// One id a Gaussian: that of the cell its mean lies in; a faint one between cells takes that of the nearest cell
/// around it.
fn gaussian_labels(scene: &Scene, grid: &VoxelGrid, segments: &[Segment]) -> Vec<u16> {
    let mut ids = vec![0_u16; grid.voxels.len()];
    for (i, segment) in segments.iter().enumerate() {
        for &voxel in &segment.voxels {
            ids[voxel] = i as u16 + 1;
        }
    }
    let label = |i: usize| {
        let local = grid.to_local(scene.gaussians.mean_world(i));
        match grid.find(grid.key_at(local)) {
            Some(voxel) => ids[voxel],
            None => nearest_around(grid, local).map_or(0, |voxel| ids[voxel]),
        }
    };
    (0..scene.gaussians.len()).into_par_iter().map(label).collect()
}

/// The occupied cell next to an empty one whose matter is nearest to a position.
fn nearest_around(grid: &VoxelGrid, local: Vec3) -> Option<usize> {
    let distance = |voxel: usize| grid.voxels[voxel].position.distance_squared(local);
    grid.around(grid.key_at(local), 1).min_by(|&a, &b| distance(a).total_cmp(&distance(b)))
}

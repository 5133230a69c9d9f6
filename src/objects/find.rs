//! Objects of a scene without labels.
//!
//! Enters: a scene. Leaves: objects with Gaussians, boxes and descriptive names. Floor, walls and ceiling are
//! background (id 0). Tables, counters and shelves are objects of their own, separate from the objects on them.

use std::collections::BTreeSet;

use glam::{DVec3, Vec3};
use rayon::prelude::*;

use super::borders::Borders;
use super::boxes;
use super::color;
use super::grouping::group;
use super::groups::VoxelGroup;
use super::holes::without_holes;
use super::naming;
use super::object::{Object, ObjectSet};
use super::planes::{ScenePlane, find_planes, is_closed_room, room_box};
use super::settings::FindSettings;
use super::voxels::VoxelGrid;
use cinesplat_scene::Scene;

/// Size of a room over the scene size below which the room decides the size of the cells.
const SMALL_ROOM_FRAC: f64 = 0.85;

/// Cells of a closed room, over those of other captures of its size. Its surfaces are plain, so that plates, mirrors and the
/// frames of windows, which are about as thick as a cell, come apart from tables and walls. At 1 the things of 20 generated
/// rooms overlapped the true ones by .80, at 1.27 by .84; at 1.5 more rugs were lost, and half again as many scraps were
/// things.
const CLOSED_ROOM_FINENESS: f64 = 1.27;

/// Finds the objects of a scene. Ids count from 1 in order of prominence: size, weighted by the difference between the
/// object's color and the scene's mean color. The same scene and settings give the same objects.
///
/// The solid Gaussians fill the cells of a grid; an occupied cell is a voxel. The scene's up distinguishes level planes
/// from upright ones. Voxels of floor, walls and ceiling are removed, and table tops are separated. Voxels that touch
/// become one object. In a room, components too large for one object are split where color or surface direction
/// changes.
pub fn find(scene: &Scene, settings: &FindSettings) -> ObjectSet {
    let bounds = scene.bounds();
    let cell = bounds.size() / settings.resolution.max(1.0);
    if !(cell > 0.0 && cell.is_finite()) {
        return ObjectSet::default();
    }
    let (grid, planes, settings) = voxels_and_planes(scene, cell, settings);
    let limit = settings.max_objects.min(usize::from(u16::MAX));
    let ranked = ranked(&grid, group(&grid, &planes, &scene.gaussians, &settings), limit);
    let labels = gaussian_labels(scene, &grid, &ranked);
    let of_id = |id: u32| {
        ranked.get(id as usize - 1).map_or(Traits::default(), |group| Traits {
            is_surface: group.is_surface,
            parent: group.parent.map(|i| i as u32 + 1),
            name: group.name,
        })
    };
    assemble(scene, labels, &of_id)
}

/// What is known of an object besides its Gaussians.
#[derive(Debug, Clone, Copy, Default)]
struct Traits {
    is_surface: bool,
    parent: Option<u32>,
    name: Option<&'static str>,
}

/// The voxels of a scene and its planes, and the settings for cells of their size. In a closed room the cells are smaller,
/// and smaller still if the room is much smaller than the scene, because windows show what lies far outside.
fn voxels_and_planes(scene: &Scene, cell: f64, settings: &FindSettings) -> (VoxelGrid, Vec<ScenePlane>, FindSettings) {
    let center = scene.bounds().center();
    let axes = boxes::upright_axes(scene.up);
    let with_planes = |grid: VoxelGrid| {
        let planes = find_planes(&grid, (grid.voxels.len() / 300).max(60), settings.seed);
        (grid, planes)
    };
    let found = with_planes(VoxelGrid::new(&scene.gaussians, cell, center, axes));
    if let Some((low, high)) = room_box(&found.1).filter(|_| is_closed_room(&found.1)) {
        let room = f64::from((high - low).length()) / settings.resolution.max(1.0);
        let size = if room < SMALL_ROOM_FRAC * cell && room > 0.0 { room } else { cell };
        let finer = without_holes(&scene.gaussians, size / CLOSED_ROOM_FINENESS, center, axes);
        let (grid, planes) = with_planes(finer);
        if is_closed_room(&planes) {
            let resolution = settings.resolution * CLOSED_ROOM_FINENESS;
            let finer = FindSettings { resolution, ..settings.clone() };
            return (grid, planes, finer);
        }
    }
    (found.0, found.1, settings.clone())
}

/// The objects of given labels (one id per Gaussian): every id above 0 becomes an object with a box and a descriptive
/// name.
pub fn from_labels(scene: &Scene, labels: Vec<u16>) -> ObjectSet {
    assemble(scene, labels, &|_| Traits::default())
}

fn assemble(scene: &Scene, labels: Vec<u16>, of_id: &dyn Fn(u32) -> Traits) -> ObjectSet {
    let size = scene.bounds().size();
    let present: BTreeSet<u32> = labels.iter().copied().filter(|label| *label > 0).map(u32::from).collect();
    let ancestors = |id: u32| std::iter::successors(Some(id), |&id| of_id(id).parent);
    let ids: BTreeSet<u32> = present.into_iter().flat_map(ancestors).collect();
    let unfitted =
        |&id: &u32| Object { parent: of_id(id).parent, ..Object::from_box(id, "", DVec3::ZERO, DVec3::ZERO) };
    let mut set = ObjectSet { objects: ids.iter().map(unfitted).collect(), labels };
    let members = set.members();
    for object in &mut set.objects {
        let members = members.get(&object.id).map_or(&[][..], Vec::as_slice);
        let Some(fitted) = boxes::fit(&scene.gaussians, members, scene.up) else { continue };
        let traits = of_id(object.id);
        let describe = || naming::describe(scene, members, &fitted, (size, traits.is_surface));
        object.label = traits.name.map_or_else(describe, str::to_owned);
        object.take_box(&fitted);
        object.num_gaussians = members.len();
    }
    naming::make_unique(&mut set.objects);
    set
}

/// The groups, most prominent first: the root of the number of voxels, weighted by the distance of their color from the
/// scene's mean.
fn ranked(grid: &VoxelGrid, groups: Vec<VoxelGroup>, limit: usize) -> Vec<VoxelGroup> {
    let mean = |voxels: &mut dyn Iterator<Item = usize>| {
        let (sum, count) = voxels.fold((Vec3::ZERO, 0), |(sum, n), v| (sum + grid.voxels[v].color_lab, n + 1));
        sum / count.max(1) as f32
    };
    let overall = mean(&mut (0..grid.voxels.len()));
    let prominence = |group: &VoxelGroup| {
        let apart = (mean(&mut group.voxels.iter().copied()) - overall).length();
        (group.voxels.len() as f32).sqrt() * (0.3 + (apart / 60.0).min(1.0))
    };
    let mut scores: Vec<f32> = groups.iter().map(prominence).collect();
    // A whole comes before its parts.
    for i in 0..groups.len() {
        let mut above = groups[i].parent;
        while let Some(whole) = above {
            scores[whole] = scores[whole].max(scores[i] * 1.01);
            above = groups[whole].parent;
        }
    }
    let first = |i: usize| groups[i].voxels.first().copied();
    let mut order: Vec<usize> = (0..groups.len()).collect();
    order.sort_by(|&a, &b| scores[b].total_cmp(&scores[a]).then(first(a).cmp(&first(b))));
    order.truncate(limit);
    let place = |group: usize| order.iter().position(|&i| i == group);
    let parents: Vec<Option<usize>> = order.iter().map(|&i| groups[i].parent.and_then(place)).collect();
    let mut groups: Vec<Option<VoxelGroup>> = groups.into_iter().map(Some).collect();
    let kept = order.iter().zip(parents).filter_map(|(&i, parent)| Some(VoxelGroup { parent, ..groups[i].take()? }));
    kept.collect()
}

/// One id per Gaussian: the id of the voxel that contains its mean. A Gaussian in an empty cell takes the id of the
/// nearest adjacent voxel.
fn gaussian_labels(scene: &Scene, grid: &VoxelGrid, groups: &[VoxelGroup]) -> Vec<u16> {
    let mut ids = vec![0_u16; grid.voxels.len()];
    for (i, group) in groups.iter().enumerate() {
        for &voxel in &group.voxels {
            ids[voxel] = i as u16 + 1;
        }
    }
    let borders = Borders::new(grid, &ids);
    let label = |i: usize| {
        let local = grid.to_local(scene.gaussians.mean_world(i));
        match grid.find(grid.key_at(local)) {
            Some(voxel) => borders.id(voxel, local, || color::lab(scene.gaussians.base_color(i))),
            None => nearest_around(grid, local).map_or(0, |voxel| ids[voxel]),
        }
    };
    (0..scene.gaussians.len()).into_par_iter().map(label).collect()
}

/// The voxel whose matter is nearest to a position, among the voxels next to the position's cell.
fn nearest_around(grid: &VoxelGrid, local: Vec3) -> Option<usize> {
    let distance = |voxel: usize| grid.voxels[voxel].position.distance_squared(local);
    grid.around(grid.key_at(local), 1).min_by(|&a, &b| distance(a).total_cmp(&distance(b)))
}

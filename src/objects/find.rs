//! Objects of a scene without labels.
//!
//! Enters: a scene. Leaves: objects with Gaussians, boxes and descriptive names. Floor, walls and ceiling are
//! background (id 0). Tables, counters and shelves are objects of their own, separate from the objects on them.

use glam::{DVec3, Vec3};
use rayon::prelude::*;

use super::boxes;
use super::grouping::{VoxelGroup, group};
use super::naming;
use super::object::{Object, ObjectSet};
use super::planes::find_planes;
use super::settings::FindSettings;
use super::voxels::VoxelGrid;
use cinesplat_scene::Scene;

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
    let grid = VoxelGrid::new(&scene.gaussians, cell, bounds.center(), boxes::upright_axes(scene.up));
    let planes = find_planes(&grid, (grid.voxels.len() / 300).max(60), settings.seed);
    let mut ranked = ranked(&grid, group(&grid, &planes, settings));
    ranked.truncate(settings.max_objects.min(usize::from(u16::MAX)));
    let labels = gaussian_labels(scene, &grid, &ranked);
    let surfaces: Vec<bool> = ranked.iter().map(|group| group.is_surface).collect();
    assemble(scene, scene.up, labels, &|id| surfaces.get(id as usize - 1).copied().unwrap_or(false))
}

/// The objects of given labels (one id per Gaussian): every id above 0 becomes an object with a box and a descriptive
/// name.
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
            rotation: fitted.rotation,
            num_gaussians: members.len(),
            ..Object::from_box(id, &label, fitted.center, fitted.half_extents)
        });
    }
    naming::make_unique(&mut objects);
    ObjectSet { objects, labels }
}

/// The groups, most prominent first: the root of the number of voxels, weighted by the distance of their color from the
/// scene's mean.
fn ranked(grid: &VoxelGrid, mut groups: Vec<VoxelGroup>) -> Vec<VoxelGroup> {
    let color = |voxels: &mut dyn Iterator<Item = usize>| {
        let (sum, count) = voxels.fold((Vec3::ZERO, 0), |(sum, n), v| (sum + grid.voxels[v].color_lab, n + 1));
        sum / count.max(1) as f32
    };
    let overall = color(&mut (0..grid.voxels.len()));
    let prominence = |group: &VoxelGroup| {
        let apart = (color(&mut group.voxels.iter().copied()) - overall).length();
        (group.voxels.len() as f32).sqrt() * (0.3 + (apart / 60.0).min(1.0))
    };
    groups.sort_by(|a, b| prominence(b).total_cmp(&prominence(a)).then(a.voxels.first().cmp(&b.voxels.first())));
    groups
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
    let label = |i: usize| {
        let local = grid.to_local(scene.gaussians.mean_world(i));
        match grid.find(grid.key_at(local)) {
            Some(voxel) => ids[voxel],
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

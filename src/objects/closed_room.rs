//! The objects of a closed room: everything between floor, ceiling and walls.
//!
//! Enters: voxels and planes with a floor and a ceiling. Leaves: groups of voxels. Tops such as those of tables, and flat
//! things on floor and walls, are separated first; voxels that touch form a body; tops join the bodies that carry them.

use glam::Vec3;

use super::absorbing::absorb_backs;
use super::background::structure;
use super::flats::flats;
use super::floating::join_floating;
use super::groups::VoxelGroup;
use super::loose::join_loose;
use super::neighbors::separate;
use super::patches::{add_patches, take_patches};
use super::pieces::{attach, contacts, diagonal, split};
use super::planes::ScenePlane;
use super::rims::add_rims;
use super::segmentation::components;
use super::settings::FindSettings;
use super::shelves::fill_shelves;
use super::stacked::join_stacked;
use super::standing::{self, owners};
use super::tops::{Top, tops};
use super::voxels::VoxelGrid;
use super::windows::windows;
use cinesplat_scene::Gaussians;

/// Least share of a body's voxels that touch a flat thing for the body to be its relief: a handle, a frame.
const RELIEF_FRAC: f64 = 0.4;

/// Diagonal of a thing, over the scene size, above which it is background: a wall that is no plane.
const BACKGROUND_FRAC: f64 = 0.55;

/// Diagonal of a body, over the room's, above which it is split.
const SPLIT_FRAC: f64 = 0.42;

/// Largest depth of a thing that hangs on a wall, cells.
const THIN_CELLS: f32 = 8.0;

/// Least number of voxels of a thing on a top.
const MIN_ON_TOP: usize = 8;

/// Least number of Gaussians of a thing: what a few large ones fill between the cells of a sparse wall is none.
const MIN_GAUSSIANS: f32 = 24.0;

/// Share of a group inside the box of another group from which it is a part of that group.
const INSIDE_FRAC: f64 = 0.85;

/// Share of a whole's voxels below which a part inside it is no object of its own.
const CRUMB_FRAC: f64 = 0.01;

/// Groups the voxels of a closed room.
pub(crate) fn group(
    grid: &VoxelGrid,
    planes: &[ScenePlane],
    gaussians: &Gaussians,
    settings: &FindSettings,
) -> Vec<VoxelGroup> {
    let mut is_structure = structure(grid, planes, settings);
    let windows = windows(grid, planes);
    let mut is_window = vec![false; grid.voxels.len()];
    windows.iter().flatten().for_each(|&voxel| is_window[voxel] = true);
    let mut is_free: Vec<bool> =
        is_structure.iter().zip(&is_window).map(|(structure, window)| !structure && !window).collect();
    is_structure.iter_mut().zip(&is_window).for_each(|(structure, window)| *structure &= !window);
    let mut tops = tops(grid, &is_free);
    tops.iter().flat_map(|top| &top.voxels).for_each(|&voxel| is_free[voxel] = false);
    let free: Vec<usize> = (0..is_free.len()).filter(|&voxel| is_free[voxel]).collect();
    let on_top = owners(grid, tops.iter().map(|top| &top.voxels));
    let bodies = bodies(grid, &free, &tops, settings);
    let patches = take_patches(grid, &mut tops);
    let (flats, mut surfaces) = flats(grid, planes, &is_structure);
    let (flats, mut bodies) = with_reliefs(grid, flats, bodies);
    add_patches(grid, patches, &mut bodies);
    let max_diagonal = BACKGROUND_FRAC * settings.resolution;
    let bodies = separate(grid, gaussians, bodies, &tops);
    let bodies = join_floating(grid, &bodies, &tops, (&is_structure, planes));
    let things = standing::join(grid, &bodies, &tops, (&is_structure, max_diagonal));
    let things = things.voxels.into_iter().zip(things.is_surface);
    let mut groups: Vec<VoxelGroup> =
        things.map(|(voxels, is_surface)| VoxelGroup::whole(voxels, is_surface)).collect();
    groups.retain(|group| {
        let least = if is_on_top(grid, &group.voxels, &on_top) { MIN_ON_TOP } else { settings.min_voxels };
        group.voxels.len() >= least
            && has_shape(grid, &group.voxels)
            && (group.is_surface || diagonal(grid, group.voxels.iter().copied()) <= max_diagonal)
    });
    join_stacked(grid, &mut groups);
    join_loose(grid, &mut groups);
    let flats = absorb_backs(grid, flats, &mut groups);
    nest(grid, &mut groups, SPLIT_FRAC * settings.resolution);
    fill_shelves(grid, planes, &tops, &mut groups);
    let flat = windows.into_iter().chain(flats).filter(|voxels| has_shape(grid, voxels));
    groups.extend(flat.map(|voxels| VoxelGroup::whole(voxels, false)));
    add_rims(&mut surfaces, &mut groups);
    groups
}

/// Whether a group has enough Gaussians to show a shape.
fn has_shape(grid: &VoxelGrid, voxels: &[usize]) -> bool {
    voxels.iter().map(|&v| grid.voxels[v].num_centers).sum::<f32>() >= MIN_GAUSSIANS
}

/// Whether a small group stands on a top: what stands somewhere is no floater.
fn is_on_top(grid: &VoxelGrid, voxels: &[usize], on_top: &[usize]) -> bool {
    let touches = |&&v: &&usize| {
        let level = grid.voxels[v].key[1];
        grid.neighbors(v, 1).any(|other| on_top[other] != usize::MAX && grid.voxels[other].key[1] <= level)
    };
    let num_touching = voxels.iter().filter(touches).count();
    num_touching >= 3 || num_touching * 3 >= voxels.len()
}

/// Makes groups inside the box of another group that they touch its parts: the books of a shelf, the cushions of a sofa.
/// Very small ones join it.
fn nest(grid: &VoxelGrid, groups: &mut Vec<VoxelGroup>, max_diagonal: f64) {
    let voxels: Vec<Vec<usize>> = groups.iter().map(|group| group.voxels.clone()).collect();
    let owner = owners(grid, &voxels);
    let boxes: Vec<(Vec3, Vec3)> = voxels.iter().map(|voxels| standing::extent(grid, voxels)).collect();
    for i in 0..groups.len() {
        let around: Vec<usize> = contacts(grid, &voxels[i], &owner, 2).into_keys().collect();
        let inside = |whole: usize| {
            let (low, high) = boxes[whole];
            let holds = |p: Vec3| p.cmpge(low - grid.cell).all() && p.cmple(high + grid.cell).all();
            let count = voxels[i].iter().filter(|&&v| holds(grid.voxels[v].position)).count();
            count as f64 >= INSIDE_FRAC * voxels[i].len() as f64
        };
        let size = |whole: usize| diagonal(grid, voxels[whole].iter().copied());
        let larger = |whole: usize| voxels[whole].len() > voxels[i].len() && size(whole) <= max_diagonal;
        let holder = around.into_iter().filter(|&whole| larger(whole) && inside(whole));
        groups[i].parent = holder.min_by_key(|&whole| (voxels[whole].len(), whole));
    }
    let is_crumb = |groups: &[VoxelGroup], i: usize| {
        groups[i].parent.filter(|&whole| (voxels[i].len() as f64) < CRUMB_FRAC * voxels[whole].len() as f64)
    };
    for i in 0..groups.len() {
        if let Some(mut whole) = is_crumb(groups, i) {
            while let Some(next) = is_crumb(groups, whole) {
                whole = next;
            }
            let moved = std::mem::take(&mut groups[i].voxels);
            groups[whole].voxels.extend(moved);
        }
    }
    remove_empty(groups);
}

/// Removes groups without voxels; parents that are removed are replaced by their own.
fn remove_empty(groups: &mut Vec<VoxelGroup>) {
    let mut index = vec![None; groups.len()];
    let filled = (0..groups.len()).filter(|&i| !groups[i].voxels.is_empty());
    for (number, i) in filled.enumerate() {
        index[i] = Some(number);
    }
    let resolved = |mut parent: Option<usize>| {
        while let Some(i) = parent {
            if index[i].is_some() {
                return index[i];
            }
            parent = groups[i].parent;
        }
        None
    };
    let parents: Vec<Option<usize>> = groups.iter().map(|group| resolved(group.parent)).collect();
    for (group, parent) in groups.iter_mut().zip(parents) {
        group.parent = parent;
    }
    groups.retain(|group| !group.voxels.is_empty());
}

/// The bodies of a room: components of free voxels. Those too large for one object are split; small pieces join the body
/// or disappear.
fn bodies(grid: &VoxelGrid, free: &[usize], tops: &[Top], settings: &FindSettings) -> Vec<Vec<usize>> {
    let max_diagonal = SPLIT_FRAC * settings.resolution;
    let mut bodies = Vec::new();
    let mut fragments = Vec::new();
    for component in components(grid, free, 1) {
        // Two curtains on one rod are longer than any other thing.
        let (low, high) = standing::extent(grid, &component);
        let is_thin = (high - low).x.min((high - low).z) <= THIN_CELLS * grid.cell;
        let most = if is_thin { BACKGROUND_FRAC * settings.resolution } else { max_diagonal };
        for piece in split(grid, component, most, settings) {
            if piece.len() < settings.min_voxels { fragments.extend(piece) } else { bodies.push(piece) }
        }
    }
    fragments.sort_unstable();
    let reach_tops: Vec<bool> = {
        let mut on_top = vec![false; grid.voxels.len()];
        tops.iter().flat_map(|top| &top.voxels).for_each(|&voxel| on_top[voxel] = true);
        on_top
    };
    let touches_top =
        |piece: &[usize]| piece.iter().any(|&voxel| grid.neighbors(voxel, 1).any(|other| reach_tops[other]));
    let (large, small): (Vec<_>, Vec<_>) = components(grid, &fragments, 2)
        .into_iter()
        .partition(|component| component.len() >= settings.min_voxels || touches_top(component));
    bodies.extend(large);
    attach(grid, small, &mut bodies);
    bodies
}

/// Adds to every flat thing the bodies that lie on it.
fn with_reliefs(
    grid: &VoxelGrid,
    mut flats: Vec<Vec<usize>>,
    bodies: Vec<Vec<usize>>,
) -> (Vec<Vec<usize>>, Vec<Vec<usize>>) {
    let owner = owners(grid, &flats);
    let mut others = Vec::new();
    for body in bodies {
        let mut touching = vec![0_usize; flats.len()];
        for &voxel in &body {
            let mut near: Vec<usize> =
                grid.neighbors(voxel, 2).map(|other| owner[other]).filter(|&flat| flat != usize::MAX).collect();
            near.sort_unstable();
            near.dedup();
            near.into_iter().for_each(|flat| touching[flat] += 1);
        }
        let best = (0..flats.len()).max_by_key(|&flat| (touching[flat], std::cmp::Reverse(flat)));
        let fits = |flat: usize| {
            let (low, high) = standing::extent(grid, &flats[flat]);
            let (low, high) = (low - 3.0 * grid.cell, high + 3.0 * grid.cell);
            let is_in = |&&v: &&usize| {
                let p = grid.voxels[v].position;
                p.cmpge(low).all() && p.cmple(high).all()
            };
            body.iter().filter(is_in).count() as f64 >= INSIDE_FRAC * body.len() as f64
        };
        match best.filter(|&flat| touching[flat] as f64 >= RELIEF_FRAC * body.len() as f64 && fits(flat)) {
            Some(flat) => flats[flat].extend(body),
            None => others.push(body),
        }
    }
    (flats, others)
}

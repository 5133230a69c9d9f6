//! Tops: level surfaces on which things stand, such as those of tables, dressers and shelves.
//!
//! Enters: voxels that are no structure. Leaves: the tops with their voxels. A top separates what stands on it from what
//! carries it.

use glam::Vec3;

use super::relief::Surface;
use super::voxels::VoxelGrid;

/// Least upward component of the normal of a level voxel.
const LEVEL_COSINE: f32 = 0.92;

/// Least levelness of the Gaussians of a level voxel without a normal.
const LEVEL_SHARE: f32 = 0.8;

/// Largest distance of a voxel from the mean height of its top, cells.
const FLAT_CELLS: f32 = 0.9;

/// Largest standard deviation of the heights of a top, cells: a large leaf is bent.
const MAX_ROUGHNESS: f32 = 0.35;

/// Least number of voxels of a top: about the top of a bedside table in a room.
const MIN_VOXELS: usize = 60;

/// Growth of a top beyond the voxels with a level normal, cells.
const GROWTH_CELLS: i32 = 3;

/// Depth under a top down to which all voxels over its footprint belong to it, cells.
const SLAB_CELLS: f32 = 1.6;

/// One top.
pub(crate) struct Top {
    /// Ascending.
    pub(crate) voxels: Vec<usize>,
    /// Mean height of its voxels, local frame.
    pub(crate) height: f32,
}

/// The tops among free voxels, largest first.
///
/// Level voxels that touch each other at one height form a top. It takes all voxels at its height over its footprint and a
/// little around it, regardless of their normals, because those at its edge or under a thing on it would connect the thing
/// with what carries it.
pub(crate) fn tops(grid: &VoxelGrid, is_free: &[bool]) -> Vec<Top> {
    let mut taken: Vec<bool> = is_free.iter().map(|free| !free).collect();
    let is_level = |v: usize| {
        let voxel = &grid.voxels[v];
        voxel.normal.y.abs() > LEVEL_COSINE || (voxel.normal == Vec3::ZERO && voxel.level > LEVEL_SHARE)
    };
    let mut tops = Vec::new();
    for seed in 0..grid.voxels.len() {
        if taken[seed] || !is_level(seed) {
            continue;
        }
        taken[seed] = true;
        let mut voxels = vec![seed];
        let mut sum = grid.voxels[seed].position.y;
        let mut at = 0;
        while at < voxels.len() {
            for other in grid.neighbors(voxels[at], 1) {
                let y = grid.voxels[other].position.y;
                let is_near = (y - sum / voxels.len() as f32).abs() <= FLAT_CELLS * grid.cell;
                if !taken[other] && is_level(other) && is_near {
                    taken[other] = true;
                    voxels.push(other);
                    sum += y;
                }
            }
            at += 1;
        }
        if voxels.len() >= MIN_VOXELS && roughness(grid, &voxels) <= MAX_ROUGHNESS * grid.cell {
            tops.push((Surface::new(grid, &voxels), voxels));
        } else {
            voxels.into_iter().for_each(|voxel| taken[voxel] = false);
        }
    }
    tops.sort_by_key(|(_, voxels)| std::cmp::Reverse(voxels.len()));
    for (surface, voxels) in &mut tops {
        voxels.retain(|&voxel| {
            taken[voxel] = !surface.is_raised(grid.voxels[voxel].position);
            taken[voxel]
        });
    }
    tops.into_iter().map(|(surface, voxels)| grow(grid, &surface, voxels, &mut taken)).collect()
}

/// Standard deviation of the heights of some voxels.
fn roughness(grid: &VoxelGrid, voxels: &[usize]) -> f32 {
    let heights = || voxels.iter().map(|&v| grid.voxels[v].position.y);
    let mean = heights().sum::<f32>() / voxels.len().max(1) as f32;
    (heights().map(|y| (y - mean).powi(2)).sum::<f32>() / voxels.len().max(1) as f32).sqrt()
}

fn grow(grid: &VoxelGrid, surface: &Surface, mut voxels: Vec<usize>, taken: &mut [bool]) -> Top {
    let mut columns: Vec<[i32; 2]> = Vec::new();
    for &voxel in &voxels {
        let [x, _, z] = grid.voxels[voxel].key;
        let steps = || -GROWTH_CELLS..=GROWTH_CELLS;
        columns.extend(steps().flat_map(|dx| steps().map(move |dz| [x + dx, z + dz])));
    }
    columns.sort_unstable();
    columns.dedup();
    let level = grid.key_at(surface.middle)[1];
    for [x, z] in columns {
        for y in level - 2..=level + 1 {
            let Some(voxel) = grid.find([x, y, z]).filter(|&v| !taken[v]) else { continue };
            let p = grid.voxels[voxel].position;
            if surface.height(p) >= -SLAB_CELLS * grid.cell && !surface.is_raised(p) {
                taken[voxel] = true;
                voxels.push(voxel);
            }
        }
    }
    voxels.sort_unstable();
    Top { voxels, height: surface.middle.y }
}

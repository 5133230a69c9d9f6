//! Holes of surfaces whose Gaussians lie about a cell apart: whole lines of cells have none, where the middles of the cells and
//! of the Gaussians fall out of step.
//!
//! Enters: Gaussians. Leaves: voxels, also between two others where Gaussians of the same surface reach.

use std::collections::BTreeMap;

use glam::{DMat3, DVec3, Vec3};

use super::color;
use super::voxels::{CellIndex, FAINT_OPACITY, Moments, REACH_SIGMA, STEPS_PER_CELL, VoxelGrid, is_occupied};
use cinesplat_scene::Gaussians;

/// Samples per cell of a Gaussian that may fill a hole, along its longer half axes.
const HOLE_STEPS_PER_CELL: f32 = 3.0;

/// Largest distance of the cells on both sides of a hole from the plane of the Gaussian, cells, and largest difference
/// between their colors and its own. With any cells around it, holes between a vase and a bottle were filled.
const OFF_PLANE_CELLS: f32 = 0.4;
const MAX_DIFFERENCE: f32 = 25.0;

/// The plane across a Gaussian's thinnest axis, and its color.
struct Patch {
    mean: Vec3,
    normal: Vec3,
    color_lab: Vec3,
}

/// As [`VoxelGrid::new`], with the holes of surfaces filled.
pub(crate) fn without_holes(gaussians: &Gaussians, cell: f64, center: DVec3, axes: DMat3) -> VoxelGrid {
    let empty = VoxelGrid::empty(cell, center, axes);
    let mut cells = empty.accumulated(gaussians);
    cells.retain(is_occupied);
    let holes = holes(&empty, gaussians, &cells);
    cells.extend(holes);
    empty.with_cells(cells)
}

/// The empty cells between two cells of one surface that Gaussians of the surface reach, in order of their keys.
/// `cells` are the occupied ones.
fn holes(grid: &VoxelGrid, gaussians: &Gaussians, cells: &[([i32; 3], Moments)]) -> Vec<([i32; 3], Moments)> {
    let index: CellIndex = cells.iter().enumerate().map(|(i, (key, _))| (*key, i as u32)).collect();
    let turn = grid.local_rotation();
    let mut holes: BTreeMap<[i32; 3], Moments> = BTreeMap::new();
    let mut filled = Vec::new();
    let goes_on = |key: [i32; 3], patch: &Patch| {
        let Some((_, held)) = index.get(&key).and_then(|&cell| cells.get(cell as usize)) else { return false };
        let position = grid.middle(key) + held.offset / held.mass;
        patch.normal.dot(position - patch.mean).abs() <= OFF_PLANE_CELLS * grid.cell
            && color::difference(held.color_lab / held.mass, patch.color_lab) < MAX_DIFFERENCE
    };
    let is_hole = |[x, y, z]: [i32; 3], patch: &Patch| {
        let is_between =
            |[a, b, c]: [i32; 3]| goes_on([x - a, y - b, z - c], patch) && goes_on([x + a, y + b, z + c], patch);
        !index.contains_key(&[x, y, z]) && [[1, 0, 0], [0, 1, 0], [0, 0, 1]].into_iter().any(is_between)
    };
    for i in (0..gaussians.len()).filter(|&i| gaussians.opacities[i] >= FAINT_OPACITY) {
        let reach = gaussians.scales[i] * REACH_SIGMA / grid.cell;
        let thinnest = reach.min_position();
        let mut finer = Vec3::splat(HOLE_STEPS_PER_CELL);
        finer[thinnest] = STEPS_PER_CELL;
        if (reach * finer).floor() == (reach * STEPS_PER_CELL).floor() {
            continue;
        }
        let patch = Patch {
            mean: grid.to_local(gaussians.mean_world(i)),
            normal: turn * gaussians.rotations[i] * Vec3::AXES[thinnest],
            color_lab: color::lab(gaussians.base_color(i)),
        };
        let sample = Moments::of_gaussian(gaussians, i, turn);
        grid.fill(gaussians, i, (turn, finer), &mut filled);
        for &(key, position) in filled.iter().filter(|(key, _)| is_hole(*key, &patch)) {
            holes.entry(key).or_insert(Moments::EMPTY).add(&sample.at(position - grid.middle(key)));
        }
    }
    holes.into_iter().collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Quat;

    /// A square of flat Gaussians `step` cells apart, and its voxels of edge 1 without and with its holes filled.
    fn square(step: f32) -> [VoxelGrid; 2] {
        let mut gaussians = Gaussians::default();
        for i in 0..60 * 60 {
            gaussians.means.push(Vec3::new((i % 60) as f32, 0.0, (i / 60) as f32) * step + 0.5);
            gaussians.scales.push(Vec3::new(0.45, 0.05, 0.45));
            gaussians.rotations.push(Quat::IDENTITY);
            gaussians.opacities.push(0.95);
            gaussians.sh_dc.push(Vec3::ZERO);
        }
        [
            VoxelGrid::new(&gaussians, 1.0, DVec3::ZERO, DMat3::IDENTITY),
            without_holes(&gaussians, 1.0, DVec3::ZERO, DMat3::IDENTITY),
        ]
    }

    /// Lines of empty cells crossed every surface whose Gaussians lie a little farther apart than the cells.
    #[test]
    fn the_lines_between_gaussians_are_filled() {
        let [with, without] = square(1.04).map(|grid| grid.voxels.len());
        // The last Gaussian lies in the 62nd cell; where two lines cross no cell lies between two others.
        assert_eq!(with, 60 * 60);
        assert!((62 * 62 - 4..=62 * 62).contains(&without), "{without}");
        // Nothing grows beyond its Gaussians.
        let [with, without] = square(1.0).map(|grid| grid.voxels.len());
        assert_eq!((with, without), (60 * 60, 60 * 60));
    }
}

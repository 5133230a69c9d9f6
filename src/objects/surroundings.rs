//! Whether a scene surrounds those who look at it: a room, and no thing.
//!
//! Enters: voxels. A room is seen from inside, a thing from outside, whatever planes it has.

use cinesplat_geometry::{LevelFrame, sphere_directions};
use glam::{DVec3, Vec3};
use rayon::prelude::*;

use super::planes::extent_without;
use super::voxels::VoxelGrid;

/// Number of voxels whose visibility is tested.
const NUM_SEEN: usize = 300;

/// Places along each side of the scene's box, and the cells around a place that must be empty.
const NUM_ALONG: usize = 7;
const CLEAR_CELLS: i32 = 3;

/// Places inside that count, best first, and what they must see together, over what is seen from outside.
const NUM_INSIDE: usize = 8;
const SURROUNDED_FRAC: f64 = 0.42;

/// Least number of places inside that are enclosed.
const NUM_ENCLOSED: usize = 6;

/// Least share of directions in which an enclosed place meets matter. At the sixth best place a chair, an armchair and a relief
/// had .57 to .58, scans of rooms .77 to .85.
const ENCLOSED_FRAC: f64 = 0.67;

/// Number of directions that are tried.
const NUM_DIRECTIONS: usize = 96;

/// Places outside: directions around up, their angles above the horizon, and their distance over the diagonal.
const NUM_AROUND: usize = 12;
const ABOVE_RAD: [f64; 2] = [0.1, 0.6];
const OUTSIDE_FRAC: f32 = 0.8;

/// Of so many voxels one lies astray at each end of an axis.
const ASTRAY: usize = 200;

/// Cells before a voxel that do not hide it.
const SKIN_CELLS: f32 = 2.5;

/// Length of a step along a ray, cells.
const STEP_CELLS: f32 = 0.7;

/// Whether most of what anybody sees of the voxels is seen from inside.
pub(crate) fn surrounds(grid: &VoxelGrid) -> bool {
    let (low, high) = core(grid);
    let is_in = |p: &Vec3| p.cmpge(low).all() && p.cmple(high).all();
    let within: Vec<Vec3> = grid.voxels.iter().map(|voxel| voxel.position).filter(is_in).collect();
    let targets: Vec<Vec3> = within.iter().step_by(within.len().div_ceil(NUM_SEEN).max(1)).copied().collect();
    let seen_from = |eye: &Vec3| targets.iter().map(|&target| sees(grid, *eye, target, (low, high))).collect();
    let seen = |eyes: &[Vec3]| -> Vec<Vec<bool>> { eyes.par_iter().map(seen_from).collect() };
    let count = |flags: &[bool]| flags.iter().filter(|flag| **flag).count();
    let places = places_inside(grid, low, high);
    // A chair of thin bars is seen from anywhere, and stands around nobody.
    let is_enclosed = |eye: &&Vec3| enclosed_frac(grid, **eye, (low, high)) >= ENCLOSED_FRAC;
    if places.par_iter().filter(is_enclosed).count() < NUM_ENCLOSED {
        return false;
    }
    let mut inside = seen(&places);
    inside.sort_by_key(|flags| std::cmp::Reverse(count(flags)));
    inside.truncate(NUM_INSIDE);
    let together = |views: &[Vec<bool>]| (0..targets.len()).filter(|&i| views.iter().any(|flags| flags[i])).count();
    together(&inside) as f64 >= SURROUNDED_FRAC * together(&seen(&places_outside(low, high))) as f64
}

/// Corners of the box of the voxels without those astray.
fn core(grid: &VoxelGrid) -> (Vec3, Vec3) {
    let ends = Vec3::AXES.map(|axis| extent_without(grid, 0..grid.voxels.len(), axis, ASTRAY));
    (Vec3::from_array(ends.map(|end| end.0)), Vec3::from_array(ends.map(|end| end.1)))
}

/// Free places on a lattice in the box of the scene.
fn places_inside(grid: &VoxelGrid, low: Vec3, high: Vec3) -> Vec<Vec3> {
    let at = |i: usize| (i as f32 + 0.5) / NUM_ALONG as f32;
    let place = |i: usize| {
        let steps = [i % NUM_ALONG, i / NUM_ALONG % NUM_ALONG, i / NUM_ALONG / NUM_ALONG];
        low + (high - low) * Vec3::from_array(steps.map(at))
    };
    let is_free = |place: &Vec3| grid.around(grid.key_at(*place), CLEAR_CELLS).next().is_none();
    (0..NUM_ALONG.pow(3)).map(place).filter(is_free).collect()
}

fn places_outside(low: Vec3, high: Vec3) -> Vec<Vec3> {
    let Ok(frame) = LevelFrame::new(DVec3::Y) else { return Vec::new() };
    let distance = OUTSIDE_FRAC * (high - low).length();
    let place = |away: DVec3| (low + high) / 2.0 + distance * away.as_vec3();
    frame.rings(NUM_AROUND, &ABOVE_RAD).map(place).collect()
}

/// Share of all directions in which matter is met from a place.
fn enclosed_frac(grid: &VoxelGrid, eye: Vec3, (low, high): (Vec3, Vec3)) -> f64 {
    let length = (high - low).length();
    let meets = |direction: &DVec3| !sees(grid, eye + direction.as_vec3() * length, eye, (low, high));
    sphere_directions(NUM_DIRECTIONS).iter().filter(|direction| meets(direction)).count() as f64 / NUM_DIRECTIONS as f64
}

/// Whether no voxel lies between a place and a target, in short steps.
fn sees(grid: &VoxelGrid, eye: Vec3, target: Vec3, (low, high): (Vec3, Vec3)) -> bool {
    let back = (eye - target).normalize_or_zero();
    let length = (eye - target).length();
    let mut along = SKIN_CELLS * grid.cell;
    while along < length {
        let point = target + back * along;
        if point.cmplt(low - grid.cell).any() || point.cmpgt(high + grid.cell).any() {
            return true;
        }
        if grid.find(grid.key_at(point)).is_some() {
            return false;
        }
        along += STEP_CELLS * grid.cell;
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;
    use cinesplat_scene::Gaussians;
    use glam::{DMat3, Quat};

    /// The voxels of what is inside boxes, given by their middles and half sizes.
    fn filled(boxes: &[([f32; 3], [f32; 3])], cell: f32) -> VoxelGrid {
        let mut gaussians = Gaussians::default();
        for (middle, half) in boxes {
            let (middle, half) = (Vec3::from_array(*middle), Vec3::from_array(*half));
            let num = (2.0 * half / cell).ceil().as_uvec3().max(glam::UVec3::ONE);
            for i in 0..num.x * num.y * num.z {
                let at = glam::UVec3::new(i % num.x, i / num.x % num.y, i / num.x / num.y);
                let share = (at.as_vec3() + 0.5) / num.as_vec3();
                gaussians.means.push(middle + half * (2.0 * share - 1.0));
                gaussians.scales.push(Vec3::splat(0.6 * cell));
                gaussians.rotations.push(Quat::IDENTITY);
                gaussians.opacities.push(1.0);
                gaussians.sh_dc.push(Vec3::ZERO);
            }
        }
        VoxelGrid::new(&gaussians, f64::from(cell), DVec3::ZERO, DMat3::IDENTITY)
    }

    #[test]
    fn a_room_surrounds_and_an_armchair_does_not() {
        let wall = |middle: [f32; 3], half: [f32; 3]| (middle, half);
        let mut room = vec![wall([0.0, -0.05, 0.0], [2.0, 0.05, 2.0])];
        for side in [-2.0, 2.0] {
            room.push(wall([side, 1.25, 0.0], [0.05, 1.25, 2.0]));
            room.push(wall([0.0, 1.25, side], [2.0, 1.25, 0.05]));
        }
        assert!(surrounds(&filled(&room, 0.08)), "a room without a ceiling");
        room.push(wall([0.0, 2.55, 0.0], [2.0, 0.05, 2.0]));
        assert!(surrounds(&filled(&room, 0.08)), "a closed room");
        // Seat, back and arms are thick, as no wall is.
        let armchair = [
            wall([0.0, 0.25, 0.0], [0.5, 0.25, 0.5]),
            wall([0.0, 0.75, -0.42], [0.5, 0.75, 0.08]),
            wall([-0.45, 0.45, 0.0], [0.06, 0.45, 0.5]),
            wall([0.45, 0.45, 0.0], [0.06, 0.45, 0.5]),
        ];
        assert!(!surrounds(&filled(&armchair, 0.03)), "an armchair");
    }
}

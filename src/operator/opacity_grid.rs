//! The scene's opacity on a grid, for occlusion.
//!
//! Rays march through the cells and skip blocks of empty cells. Each cell holds the highest opacity of the Gaussians
//! that reach it.

use glam::{DVec3, IVec3, UVec3};

use super::grid::Grid;
use cinesplat_scene::{Gaussians, SOLID_OPACITY};

/// Cells along the edge of a block.
const BLOCK: i32 = 8;
/// Largest number of a sample, 2^53: `f64` holds every whole number up to it.
const MAX_SAMPLE_NUMBER: f64 = 9_007_199_254_740_992.0;

/// The transmittance of every cell.
#[derive(Debug, Clone)]
pub(super) struct OpacityGrid {
    /// Position and size of the cells.
    pub(super) grid: Grid,
    /// Logarithm of the transmittance along one cell edge, one value per cell; 0 in an empty cell.
    log_transmittance: Vec<f32>,
    /// Whether a block of cells contains a cell that is not empty. Rays skip the other blocks.
    occupied: Vec<bool>,
}

impl OpacityGrid {
    /// The opacity of all Gaussians whose index satisfies `includes`.
    pub(super) fn of(grid: Grid, gaussians: &Gaussians, includes: impl Fn(usize) -> bool) -> Self {
        let mut opacity = vec![0.0_f32; grid.len()];
        for i in (0..gaussians.len()).filter(|&i| includes(i)) {
            let alpha = gaussians.opacities[i];
            for_covered_points(gaussians, i, grid.cell, |point| {
                if let Some(cell) = grid.index_at(point) {
                    opacity[cell] = opacity[cell].max(alpha);
                }
            });
        }
        let log_transmittance = opacity.into_iter().map(log_transmittance).collect();
        let mut made = Self { grid, log_transmittance, occupied: Vec::new() };
        made.mark_occupied_blocks();
        made
    }

    /// Transmittance from `target` to `eye`, without the two cells next to the target, 0..1. A cell of opacity a
    /// transmits 1 - min(a, 0.99) per cell edge of path length. The march stops below exp(-6).
    pub(super) fn transmittance(&self, eye: DVec3, target: DVec3) -> f64 {
        let way = target - eye;
        let length = way.length();
        let reach = length - 2.0 * self.grid.cell;
        if !(reach > 0.0) {
            return 1.0;
        }
        let step = 0.5 * self.grid.cell;
        let mut log_light = 0.0_f64;
        let samples = RaySamples { first: step / 2.0, step, end: reach };
        self.march(eye, way / length, &samples, |_, log_transmittance| {
            log_light += log_transmittance * 0.5;
            log_light <= -6.0
        });
        log_light.exp()
    }

    /// Whether the transmittance between two points is above 0.5.
    pub(super) fn is_open(&self, a: DVec3, b: DVec3) -> bool {
        let length = a.distance(b);
        self.hit_distance(a, (b - a) / length.max(f64::MIN_POSITIVE), length).is_none()
    }

    /// Distance along a ray of unit `direction` at which its transmittance falls below 0.5; `None` where it stays
    /// above within `reach`.
    pub(super) fn hit_distance(&self, eye: DVec3, direction: DVec3, reach: f64) -> Option<f64> {
        let step = 0.7 * self.grid.cell;
        let mut log_light = 0.0_f64;
        self.march(eye, direction, &RaySamples { first: step, step, end: reach + step }, |_, log_transmittance| {
            log_light += log_transmittance * 0.7;
            log_light < -0.7
        })
    }

    /// Calls `visit` with the distance and the log transmittance of every sample of a ray (unit `direction`) in an
    /// occupied cell, in order. Returns the distance at which `visit` returns true. Empty blocks are skipped. A grid
    /// beyond [`RaySamples::exact_reach`] is not visited.
    fn march(
        &self,
        eye: DVec3,
        direction: DVec3,
        samples: &RaySamples,
        mut visit: impl FnMut(f64, f64) -> bool,
    ) -> Option<f64> {
        let (origin, along) = ((eye - self.grid.low) / self.grid.cell, direction / self.grid.cell);
        let dims = self.grid.dims.as_dvec3();
        let [enter, leave] = crossing(origin, along, DVec3::ZERO, dims);
        let end = samples.end.min(leave).min(samples.exact_reach());
        let last = self.grid.dims.as_ivec3() - 1;
        let mut number = samples.number_after(enter);
        loop {
            let at = samples.first + samples.step * number;
            // Written so that NaN ends the march.
            if !(at < end) {
                return None;
            }
            // Coordinates inside the grid are not negative: truncation rounds down, and is much faster than `floor`.
            let cell = (origin + along * at).as_ivec3().clamp(IVec3::ZERO, last);
            let block = cell / BLOCK;
            if self.occupied[self.block_index(block)] {
                let log_transmittance = self.log_transmittance[self.grid.unchecked_index(cell)];
                if log_transmittance < 0.0 && visit(at, f64::from(log_transmittance)) {
                    return Some(at);
                }
                number += 1.0;
            } else {
                let low = (block * BLOCK).as_dvec3();
                let [_, leave] = crossing(origin, along, low, low + f64::from(BLOCK));
                number = samples.number_after(leave).max(number + 1.0);
            }
        }
    }

    /// Index of a block.
    fn block_index(&self, block: IVec3) -> usize {
        let dims = block_dims(&self.grid);
        (block.x as usize * dims.y as usize + block.y as usize) * dims.z as usize + block.z as usize
    }

    /// Finds the blocks that contain a cell that is not empty.
    fn mark_occupied_blocks(&mut self) {
        self.occupied = vec![false; block_dims(&self.grid).element_product() as usize];
        for index in (0..self.log_transmittance.len()).filter(|&index| self.log_transmittance[index] < 0.0) {
            let block = self.block_index(self.grid.cell_of(index) / BLOCK);
            self.occupied[block] = true;
        }
    }
}

fn block_dims(grid: &Grid) -> UVec3 {
    (grid.dims + (BLOCK as u32 - 1)) / BLOCK as u32
}

/// Samples along a ray at even distances.
struct RaySamples {
    first: f64,
    step: f64,
    /// All samples lie before this distance.
    end: f64,
}

impl RaySamples {
    /// Number of the first sample at or after a distance.
    fn number_after(&self, distance: f64) -> f64 {
        ((distance - self.first) / self.step).ceil().max(0.0)
    }

    /// Distance up to which the number of a sample plus one is the number of the next sample. Farther samples have no
    /// numbers of their own in `f64`, and a march over them would never end.
    fn exact_reach(&self) -> f64 {
        self.first + self.step * MAX_SAMPLE_NUMBER
    }
}

/// Distances at which a ray enters and leaves a box; an empty interval where it misses the box.
fn crossing(origin: DVec3, along: DVec3, low: DVec3, high: DVec3) -> [f64; 2] {
    let (mut enter, mut leave) = (f64::NEG_INFINITY, f64::INFINITY);
    for axis in 0..3 {
        if along[axis].abs() < f64::MIN_POSITIVE {
            if origin[axis] < low[axis] || origin[axis] > high[axis] {
                return [f64::INFINITY, f64::NEG_INFINITY];
            }
            continue;
        }
        let (a, b) = ((low[axis] - origin[axis]) / along[axis], (high[axis] - origin[axis]) / along[axis]);
        enter = enter.max(a.min(b));
        leave = leave.min(a.max(b));
    }
    [enter, leave]
}

/// Logarithm of the transmittance along one edge of a cell.
fn log_transmittance(opacity: f32) -> f32 {
    if opacity > 0.0 { (1.0 - opacity.min(0.99)).ln() } else { 0.0 }
}

/// Calls `visit` with points that cover a Gaussian at cell resolution: its mean and, for a solid Gaussian larger than a
/// cell, a lattice over its two longest axes out to 1.5 standard deviations.
fn for_covered_points(gaussians: &Gaussians, i: usize, cell: f64, mut visit: impl FnMut(DVec3)) {
    let mean = gaussians.mean_world(i);
    visit(mean);
    let scales = gaussians.scales[i].as_dvec3();
    let longest = scales.max_element();
    if gaussians.opacities[i] < SOLID_OPACITY || longest * 1.5 < 0.5 * cell || !longest.is_finite() {
        return;
    }
    let axes = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| gaussians.rotations[i].as_dquat() * axis);
    let thinnest = scales.min_position();
    let (a, b) = ((thinnest + 1) % 3, (thinnest + 2) % 3);
    let steps = |axis: usize| ((1.5 * scales[axis] / (0.8 * cell)).ceil() as i32).min(40);
    for u in -steps(a)..=steps(a) {
        for v in -steps(b)..=steps(b) {
            let (u, v) = (f64::from(u) * 0.8 * cell, f64::from(v) * 0.8 * cell);
            if (u / scales[a]).powi(2) + (v / scales[b]).powi(2) <= 2.25 {
                visit(mean + axes[a] * u + axes[b] * v);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Sparse pseudo-random cells.
    fn scattered() -> OpacityGrid {
        let grid = Grid { low: DVec3::new(-1.0, 2.0, 0.5), cell: 0.1, dims: UVec3::new(37, 20, 41) };
        let light = |i: usize| if i % 97 < 10 { -0.4 } else { 0.0 };
        let log_transmittance: Vec<f32> = (0..grid.len())
            .map(|i| if i % 41 < 24 && (i / 820) % 16 < 9 { light(i.wrapping_mul(2_654_435_761) >> 7) } else { 0.0 })
            .collect();
        let mut made = OpacityGrid { grid, log_transmittance, occupied: Vec::new() };
        made.mark_occupied_blocks();
        made
    }

    /// The same march without skipping blocks.
    fn hit_by_brute_force(grid: &OpacityGrid, eye: DVec3, direction: DVec3, reach: f64) -> Option<f64> {
        let step = 0.7 * grid.grid.cell;
        let mut light = 0.0;
        for number in 1.. {
            let at = step * f64::from(number);
            if at - step >= reach {
                break;
            }
            let cell = grid.grid.index_at(eye + direction * at);
            light += cell.map_or(0.0, |cell| f64::from(grid.log_transmittance[cell])) * 0.7;
            if light < -0.7 {
                return Some(at);
            }
        }
        None
    }

    /// The march used to add 1 to sample numbers above 2^53, which left them unchanged.
    #[test]
    fn a_ray_from_a_splat_far_outside_of_the_grid_ends() {
        let grid = scattered();
        let target = grid.grid.low + 1.0;
        for distance in [1e6, 1e12, 1e15, 1e17, 1e30] {
            for direction in [DVec3::X, DVec3::NEG_Y, DVec3::new(0.6, 0.0, 0.8)] {
                let eye = target - direction * distance;
                assert!((0.0..=1.0).contains(&grid.transmittance(eye, target)), "{distance} along {direction}");
                let hit = grid.hit_distance(eye, direction, 2.0 * distance);
                assert!(hit.is_none_or(|hit| hit < 2.0 * distance), "{hit:?} at {distance} along {direction}");
            }
        }
    }

    #[test]
    fn skipping_empty_blocks_gives_the_same_hits() {
        let grid = scattered();
        let (mut hits, mut misses) = (0, 0);
        for i in 0..4000_u32 {
            let t = f64::from(i);
            let eye =
                DVec3::new((t * 0.31).sin() * 3.0 + 0.5, 3.0 + (t * 0.17).cos() * 2.0, 2.5 + (t * 0.73).sin() * 3.0);
            let target = DVec3::new(0.85 + 1.5 * (t * 1.3).sin(), 2.8 + 0.7 * (t * 0.7).cos(), 1.8 + (t * 2.1).cos());
            let direction = (target - eye).normalize();
            let (got, expected) =
                (grid.hit_distance(eye, direction, 5.0), hit_by_brute_force(&grid, eye, direction, 5.0));
            assert_eq!(got.is_some(), expected.is_some(), "ray {i}: {got:?}, expected {expected:?}");
            assert!(
                got.zip(expected).is_none_or(|(a, b)| (a - b).abs() < 1e-9),
                "ray {i}: {got:?}, expected {expected:?}"
            );
            if got.is_some() { hits += 1 } else { misses += 1 }
        }
        assert!(hits > 300 && misses > 300, "{hits} hits, {misses} misses");
    }
}

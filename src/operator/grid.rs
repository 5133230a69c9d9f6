//! The scene as cells of opacity: what blocks light on its way to the camera.

use glam::{DVec3, IVec3, UVec3};

use cinesplat_scene::{Bounds, Gaussians, SOLID_OPACITY};

/// Cells along the scene's size. Finer cells see through narrower gaps and cost their cube in time and memory; at 110
/// a room of 7 m has cells of 6 cm, which keeps table legs and bottles.
const CELLS_ALONG_SIZE: f64 = 110.0;
/// Room for the camera around the box of the middle 96 % of the solid Gaussians, in scene sizes: sideways, and along up.
const MARGIN_FRAC: (f64, f64) = (0.55, 0.3);
/// Most cells in one grid; above it the cells grow.
const MAX_CELLS: f64 = 6e6;

/// A box of cubic cells in the world.
#[derive(Debug, Clone)]
pub(super) struct Grid {
    /// Lowest corner, world.
    pub(super) low: DVec3,
    /// Edge of a cell, scene units.
    pub(super) cell: f64,
    /// Number of cells along each axis.
    pub(super) dims: UVec3,
}

impl Grid {
    /// Cells over the scene's core box and the room around it.
    pub(super) fn around(bounds: &Bounds, up: DVec3) -> Self {
        let size = bounds.size().max(1e-9);
        let upright = up.abs();
        let margin = (DVec3::splat(MARGIN_FRAC.0) * (1.0 - upright) + upright * MARGIN_FRAC.1) * size;
        let (low, high) = (bounds.core_min - margin, bounds.core_max + margin);
        Self::over(low, high, size / CELLS_ALONG_SIZE)
    }

    /// Cells of an edge over a box; larger ones where there would be too many.
    pub(super) fn over(low: DVec3, high: DVec3, cell: f64) -> Self {
        let extent = high - low;
        let volume = extent.x * extent.y * extent.z;
        let cell = cell.max((volume / MAX_CELLS).cbrt());
        Self { low, cell, dims: (extent / cell).ceil().max(DVec3::ONE).as_uvec3() }
    }

    /// Number of cells.
    pub(super) fn len(&self) -> usize {
        self.dims.x as usize * self.dims.y as usize * self.dims.z as usize
    }

    /// Index of the cell at integer coordinates that may lie outside.
    pub(super) fn index_of(&self, at: IVec3) -> Option<usize> {
        let inside = at.cmpge(IVec3::ZERO).all() && at.cmplt(self.dims.as_ivec3()).all();
        inside.then(|| self.unchecked_index(at))
    }

    /// Index of a cell that is inside.
    fn unchecked_index(&self, at: IVec3) -> usize {
        (at.x as usize * self.dims.y as usize + at.y as usize) * self.dims.z as usize + at.z as usize
    }

    /// Integer coordinates of the cell of an index.
    pub(super) fn cell_of(&self, index: usize) -> IVec3 {
        let (ny, nz) = (self.dims.y as usize, self.dims.z as usize);
        IVec3::new((index / (ny * nz)) as i32, (index / nz % ny) as i32, (index % nz) as i32)
    }

    /// Middle of the cell of an index, world.
    pub(super) fn middle(&self, index: usize) -> DVec3 {
        self.low + (self.cell_of(index).as_dvec3() + 0.5) * self.cell
    }

    /// Index of the cell that holds a world point.
    pub(super) fn index_at(&self, point: DVec3) -> Option<usize> {
        self.index_of(((point - self.low) / self.cell).floor().as_ivec3())
    }
}

/// How much light each cell lets through: by the highest opacity of the Gaussians that reach it.
#[derive(Debug, Clone)]
pub(super) struct OpacityGrid {
    /// Where the cells are.
    pub(super) grid: Grid,
    /// Logarithm of the light that passes one cell edge of way, one a cell; 0 where there is nothing.
    log_pass: Vec<f32>,
    /// Whether a block of cells holds anything: rays cross the others at once.
    blocks: Vec<bool>,
}

impl OpacityGrid {
    /// Cells of all Gaussians for which `counts` holds.
    pub(super) fn of(grid: Grid, gaussians: &Gaussians, counts: impl Fn(usize) -> bool) -> Self {
        let mut opacity = vec![0.0_f32; grid.len()];
        for i in (0..gaussians.len()).filter(|&i| counts(i)) {
            let alpha = gaussians.opacities[i];
            for_reached_points(gaussians, i, grid.cell, |point| {
                if let Some(cell) = grid.index_at(point) {
                    opacity[cell] = opacity[cell].max(alpha);
                }
            });
        }
        let log_pass = opacity.into_iter().map(log_pass).collect();
        let mut made = Self { grid, log_pass, blocks: Vec::new() };
        made.find_blocks();
        made
    }

    /// Share of light that gets from `target` to `eye`, except for what the last two cells before the target hold back.
    /// Each cell of opacity a lets (1 - min(a, 0.99)) through for every cell edge of way.
    pub(super) fn transmittance(&self, eye: DVec3, target: DVec3) -> f64 {
        let way = target - eye;
        let length = way.length();
        let reach = length - 2.0 * self.grid.cell;
        if !(reach > 0.0) {
            return 1.0;
        }
        let step = 0.5 * self.grid.cell;
        let mut log_light = 0.0_f64;
        let samples = Samples { first: step / 2.0, step, end: reach };
        self.march(eye, way / length, &samples, |_, log_pass| {
            log_light += log_pass * 0.5;
            log_light <= -6.0
        });
        log_light.exp()
    }

    /// Whether more than half of the light gets from `a` to `b`.
    pub(super) fn is_open(&self, a: DVec3, b: DVec3) -> bool {
        let length = a.distance(b);
        self.hit_distance(a, (b - a) / length.max(f64::MIN_POSITIVE), length).is_none()
    }

    /// Whether a ray from `eye` meets enough opacity within `reach` to hide what is behind.
    pub(super) fn hit_distance(&self, eye: DVec3, direction: DVec3, reach: f64) -> Option<f64> {
        let step = 0.7 * self.grid.cell;
        let mut log_light = 0.0_f64;
        self.march(eye, direction, &Samples { first: step, step, end: reach + step }, |_, log_pass| {
            log_light += log_pass * 0.7;
            log_light < -0.7
        })
    }

    /// Calls `visit` with the distance and the light of every sample of a ray (unit `direction`) that lies in a cell that is
    /// not empty, in order; the distance at which it says to stop. Blocks without matter are crossed at once.
    fn march(
        &self,
        eye: DVec3,
        direction: DVec3,
        samples: &Samples,
        mut visit: impl FnMut(f64, f64) -> bool,
    ) -> Option<f64> {
        let (origin, along) = ((eye - self.grid.low) / self.grid.cell, direction / self.grid.cell);
        let dims = self.grid.dims.as_dvec3();
        let [enter, leave] = crossing(origin, along, DVec3::ZERO, dims);
        let end = samples.end.min(leave);
        let last = self.grid.dims.as_ivec3() - 1;
        let mut number = samples.number_after(enter);
        loop {
            let at = samples.first + samples.step * number;
            // Written so that NaN ends.
            if !(at < end) {
                return None;
            }
            // Within the grid truncation is rounding down, and far faster.
            let cell = (origin + along * at).as_ivec3().clamp(IVec3::ZERO, last);
            let block = cell / BLOCK;
            if self.blocks[self.block_index(block)] {
                let log_pass = self.log_pass[self.grid.unchecked_index(cell)];
                if log_pass < 0.0 && visit(at, f64::from(log_pass)) {
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

    /// Place of a block in the list of blocks.
    fn block_index(&self, block: IVec3) -> usize {
        let dims = block_dims(&self.grid);
        (block.x as usize * dims.y as usize + block.y as usize) * dims.z as usize + block.z as usize
    }

    /// Which blocks of cells hold anything.
    fn find_blocks(&mut self) {
        self.blocks = vec![false; block_dims(&self.grid).element_product() as usize];
        let (ny, nz) = (self.grid.dims.y as usize, self.grid.dims.z as usize);
        for index in (0..self.log_pass.len()).filter(|&index| self.log_pass[index] < 0.0) {
            let cell = IVec3::new((index / (ny * nz)) as i32, (index / nz % ny) as i32, (index % nz) as i32);
            let block = self.block_index(cell / BLOCK);
            self.blocks[block] = true;
        }
    }
}

/// Cells along the edge of a block.
const BLOCK: i32 = 8;

fn block_dims(grid: &Grid) -> UVec3 {
    (grid.dims + (BLOCK as u32 - 1)) / BLOCK as u32
}

/// Even samples along a ray, by distance.
struct Samples {
    first: f64,
    step: f64,
    /// No sample lies here or beyond.
    end: f64,
}

impl Samples {
    /// Number of the first sample at or after a distance.
    fn number_after(&self, distance: f64) -> f64 {
        ((distance - self.first) / self.step).ceil().max(0.0)
    }
}

/// Distances at which a ray enters and leaves a box; an empty interval where it misses.
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

/// Logarithm of the light that passes a cell of an opacity.
fn log_pass(opacity: f32) -> f32 {
    if opacity > 0.0 { (1.0 - opacity.min(0.99)).ln() } else { 0.0 }
}

/// Calls `visit` with points that cover a Gaussian at cell resolution: its mean, and for a solid one that is larger than
/// a cell, a lattice over its two longest axes out to 1.5 standard deviations.
fn for_reached_points(gaussians: &Gaussians, i: usize, cell: f64, mut visit: impl FnMut(DVec3)) {
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

    /// A thin scatter of cells, as a grid and as a function.
    fn scattered() -> OpacityGrid {
        let grid = Grid { low: DVec3::new(-1.0, 2.0, 0.5), cell: 0.1, dims: UVec3::new(37, 20, 41) };
        let light = |i: usize| if i % 97 < 10 { -0.4 } else { 0.0 };
        let log_pass: Vec<f32> = (0..grid.len())
            .map(|i| if i % 41 < 24 && (i / 820) % 16 < 9 { light(i.wrapping_mul(2_654_435_761) >> 7) } else { 0.0 })
            .collect();
        let mut made = OpacityGrid { grid, log_pass, blocks: Vec::new() };
        made.find_blocks();
        made
    }

    /// Every sample looked up by itself.
    fn hit_by_brute_force(grid: &OpacityGrid, eye: DVec3, direction: DVec3, reach: f64) -> Option<f64> {
        let step = 0.7 * grid.grid.cell;
        let mut light = 0.0;
        for number in 1.. {
            let at = step * f64::from(number);
            if at - step >= reach {
                break;
            }
            let cell = grid.grid.index_at(eye + direction * at);
            light += cell.map_or(0.0, |cell| f64::from(grid.log_pass[cell])) * 0.7;
            if light < -0.7 {
                return Some(at);
            }
        }
        None
    }

    #[test]
    fn skipping_empty_blocks_meets_what_every_sample_meets() {
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

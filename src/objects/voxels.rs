//! A scene as voxels: the occupied cells of a grid, each with a color and a surface normal.
//!
//! Enters: Gaussians. Leaves: voxels in a frame whose y axis is up. A Gaussian fills every cell within one standard
//! deviation, so that the large Gaussians of plain surfaces leave no holes.

use std::collections::HashMap;
use std::hash::{BuildHasherDefault, Hasher};

use glam::{DMat3, DVec3, IVec3, Mat3, Quat, Vec3};
use rayon::prelude::*;

use super::color;
use cinesplat_scene::Gaussians;

/// Least opacity of a Gaussian that fills cells.
pub(crate) const FAINT_OPACITY: f32 = 0.1;

/// Least sum of opacities in an occupied cell: one clearly visible Gaussian or a few faint ones.
const OCCUPIED_MASS: f32 = 0.5;

/// Number of standard deviations out to which a Gaussian fills cells.
pub(crate) const REACH_SIGMA: f32 = 1.0;

/// Samples of a Gaussian along each half axis, per cell.
pub(crate) const STEPS_PER_CELL: f32 = 2.0;

/// Limit on the samples of a Gaussian along each half axis.
const MAX_STEPS: i32 = 4;

/// Cells from the center beyond which matter is left out, along every axis: dozens of scene sizes, where no object of the
/// scene is. One Gaussian astray in a damaged file would otherwise make a thing of any extent.
const MAX_CELLS: f32 = 16_384.0;

/// Positions of cells by key.
pub(crate) type CellIndex = HashMap<[i32; 3], u32, BuildHasherDefault<CellHasher>>;

/// A hash of three small integers, mixed by odd constants: much faster than the default's keyed hash. The keys come
/// from the scene's own grid, so that protection against chosen keys is not needed.
#[derive(Default)]
pub(crate) struct CellHasher(u64);

impl Hasher for CellHasher {
    fn finish(&self) -> u64 {
        self.0 ^ self.0 >> 29
    }

    fn write(&mut self, bytes: &[u8]) {
        for chunk in bytes.chunks(4) {
            let value = chunk.iter().rev().fold(0_u32, |value, &byte| value << 8 | u32::from(byte));
            self.write_u32(value);
        }
    }

    fn write_u32(&mut self, value: u32) {
        self.0 = (self.0.rotate_left(21) ^ u64::from(value)).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    }

    fn write_i32(&mut self, value: i32) {
        self.write_u32(value as u32);
    }

    fn write_usize(&mut self, _: usize) {
        // The length prefix of the array is always 3.
    }
}

/// A voxel: one occupied cell.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Voxel {
    /// Cell coordinates; y is up.
    pub(crate) key: [i32; 3],
    /// Opacity-weighted mean position of its samples, local frame.
    pub(crate) position: Vec3,
    /// Opacity-weighted mean color, CIE Lab.
    pub(crate) color_lab: Vec3,
    /// Unit normal of the surface, of either sign; zero where there is no surface.
    pub(crate) normal: Vec3,
    /// How level its Gaussians lie, 0..=1: mean square of the upward component of their thinnest axes. The two sides of
    /// a board as thick as a cell have no normal, but each of them is level.
    pub(crate) level: f32,
    /// Opacity-weighted mean of the largest standard deviations of its Gaussians, scene units.
    pub(crate) sigma: f32,
    /// Number of Gaussians whose means lie in the cell.
    pub(crate) num_centers: f32,
}

/// The voxels of a scene.
pub(crate) struct VoxelGrid {
    /// Edge of a cell, scene units.
    pub(crate) cell: f32,
    /// The voxels, sorted by key.
    pub(crate) voxels: Vec<Voxel>,
    index: CellIndex,
    center: DVec3,
    local_from_world: DMat3,
}

/// Sums over the samples in a cell, weighted by opacity.
#[derive(Clone, Copy)]
pub(crate) struct Moments {
    pub(crate) mass: f32,
    /// Sum of positions relative to the middle of the cell, which keeps the precision of the squares.
    pub(crate) offset: Vec3,
    square: Mat3,
    pub(crate) color_lab: Vec3,
    level: f32,
    sigma: f32,
    num_centers: f32,
}

impl VoxelGrid {
    /// Cells with edge `cell`; the local frame has its origin at `center` and the columns of `axes` as its axes in the
    /// world.
    pub(crate) fn new(gaussians: &Gaussians, cell: f64, center: DVec3, axes: DMat3) -> Self {
        let empty = Self::empty(cell, center, axes);
        let cells = empty.accumulated(gaussians);
        empty.with_cells(cells)
    }

    /// Some Gaussians in cells half as large, in the same frame.
    pub(crate) fn halved(&self, gaussians: &Gaussians) -> Self {
        Self::new(gaussians, f64::from(self.cell) / 2.0, self.center, self.local_from_world.transpose())
    }

    /// A grid without voxels.
    pub(crate) fn empty(cell: f64, center: DVec3, axes: DMat3) -> Self {
        let local_from_world = axes.transpose();
        Self { cell: cell as f32, voxels: Vec::new(), index: CellIndex::default(), center, local_from_world }
    }

    /// The grid with the voxels of some cells.
    pub(crate) fn with_cells(self, mut cells: Vec<([i32; 3], Moments)>) -> Self {
        let empty = self;
        cells.retain(is_occupied);
        cells.sort_unstable_by_key(|(key, _)| *key);
        let index: CellIndex = cells.iter().enumerate().map(|(i, (key, _))| (*key, i as u32)).collect();
        let voxels = cells.par_iter().map(|(key, moments)| Voxel {
            key: *key,
            position: empty.middle(*key) + moments.offset / moments.mass,
            color_lab: moments.color_lab / moments.mass,
            normal: surface_normal(*key, empty.cell, &cells, &index),
            level: moments.level / moments.mass,
            sigma: moments.sigma / moments.mass,
            num_centers: moments.num_centers,
        });
        let voxels = voxels.collect();
        Self { voxels, index, ..empty }
    }

    /// A world position in the local frame.
    pub(crate) fn to_local(&self, point: DVec3) -> Vec3 {
        (self.local_from_world * (point - self.center)).as_vec3()
    }

    /// The cell that contains a local position.
    pub(crate) fn key_at(&self, local: Vec3) -> [i32; 3] {
        // One cell more than matter may lie at: what is astray is in an empty cell.
        let most = Vec3::splat(MAX_CELLS + 1.0);
        (local / self.cell).floor().max(-most).min(most).as_ivec3().to_array()
    }

    pub(crate) fn middle(&self, key: [i32; 3]) -> Vec3 {
        (IVec3::from_array(key).as_vec3() + 0.5) * self.cell
    }

    /// Index in `voxels` of a cell; `None` where it is empty.
    pub(crate) fn find(&self, key: [i32; 3]) -> Option<usize> {
        self.index.get(&key).map(|&i| i as usize)
    }

    /// Voxels at most `reach` cells away along every axis, without the voxel itself.
    pub(crate) fn neighbors(&self, voxel: usize, reach: i32) -> impl Iterator<Item = usize> + '_ {
        self.around(self.voxels[voxel].key, reach).filter(move |&other| other != voxel)
    }

    /// Voxels at most `reach` cells away from a cell along every axis.
    pub(crate) fn around(&self, key: [i32; 3], reach: i32) -> impl Iterator<Item = usize> + '_ {
        let [x, y, z] = key;
        offsets(reach).filter_map(move |[a, b, c]| self.find([x + a, y + b, z + c]))
    }

    /// The sums of every cell. Gaussians are added in order, so that the sums do not depend on the number of threads.
    pub(crate) fn accumulated(&self, gaussians: &Gaussians) -> Vec<([i32; 3], Moments)> {
        let turn = self.local_rotation();
        let mut index = CellIndex::default();
        let mut cells: Vec<([i32; 3], Moments)> = Vec::new();
        let mut filled = Vec::new();
        for i in (0..gaussians.len()).filter(|&i| gaussians.opacities[i] >= FAINT_OPACITY) {
            let traits = Moments::of_gaussian(gaussians, i, turn);
            let center = self.key_at(self.to_local(gaussians.mean_world(i)));
            self.fill(gaussians, i, (turn, Vec3::splat(STEPS_PER_CELL)), &mut filled);
            for &(key, position) in &filled {
                let num_centers = f32::from(u8::from(key == center));
                let sample = Moments { num_centers, ..traits.at(position - self.middle(key)) };
                let cell = *index.entry(key).or_insert(cells.len() as u32) as usize;
                match cells.get_mut(cell) {
                    Some((_, moments)) => moments.add(&sample),
                    None => cells.push((key, sample)),
                }
            }
        }
        cells
    }

    /// Local from world.
    pub(crate) fn local_rotation(&self) -> Quat {
        Quat::from_mat3(&self.local_from_world.as_mat3())
    }

    /// The cells that one Gaussian fills, each once, with a sample position in it.
    pub(crate) fn fill(
        &self,
        gaussians: &Gaussians,
        i: usize,
        (turn, fineness): (Quat, Vec3),
        filled: &mut Vec<([i32; 3], Vec3)>,
    ) {
        let mean = self.to_local(gaussians.mean_world(i));
        let axes =
            Mat3::from_quat(turn * gaussians.rotations[i]) * Mat3::from_diagonal(gaussians.scales[i] * REACH_SIGMA);
        // An axis shorter than a cell is not sampled, because samples along it would make every surface two cells
        // thick.
        let reach = gaussians.scales[i] * REACH_SIGMA / self.cell;
        let steps = (reach * fineness).floor().min(Vec3::splat(MAX_STEPS as f32)).as_ivec3();
        filled.clear();
        for x in -steps.x..=steps.x {
            for y in -steps.y..=steps.y {
                for z in -steps.z..=steps.z {
                    let part = Vec3::new(x as f32, y as f32, z as f32) / steps.as_vec3().max(Vec3::ONE);
                    let position = mean + axes * part;
                    let is_near = (position / self.cell).abs().max_element() < MAX_CELLS;
                    if part.length_squared() <= 1.0 && is_near {
                        filled.push((self.key_at(position), position));
                    }
                }
            }
        }
        filled.sort_unstable_by_key(|(key, _)| *key);
        filled.dedup_by_key(|(key, _)| *key);
    }
}

impl Moments {
    /// No samples. Not `Default`, because glam's default matrix is the identity.
    pub(crate) const EMPTY: Self = Self {
        mass: 0.0,
        offset: Vec3::ZERO,
        square: Mat3::ZERO,
        color_lab: Vec3::ZERO,
        level: 0.0,
        sigma: 0.0,
        num_centers: 0.0,
    };

    /// The sums of a Gaussian's sample at the middle of a cell. `turn`: local from world.
    pub(crate) fn of_gaussian(gaussians: &Gaussians, i: usize, turn: Quat) -> Self {
        let mass = gaussians.opacities[i];
        Self {
            mass,
            color_lab: color::lab(gaussians.base_color(i)) * mass,
            level: levelness(turn * gaussians.rotations[i], gaussians.scales[i]) * mass,
            sigma: gaussians.scales[i].max_element() * mass,
            ..Self::EMPTY
        }
    }

    pub(crate) fn add(&mut self, other: &Self) {
        self.mass += other.mass;
        self.offset += other.offset;
        self.square += other.square;
        self.color_lab += other.color_lab;
        self.level += other.level;
        self.sigma += other.sigma;
        self.num_centers += other.num_centers;
    }

    /// The same sums of a sample at `offset` from the middle of its cell.
    pub(crate) fn at(&self, offset: Vec3) -> Self {
        Self { offset: offset * self.mass, square: outer(offset, offset) * self.mass, ..*self }
    }

    /// The sums relative to the middle of another cell; this cell's middle is at `step` from it.
    fn shifted(&self, step: Vec3) -> Self {
        let square = self.square + outer(self.offset, step) + outer(step, self.offset) + outer(step, step) * self.mass;
        Self { offset: self.offset + step * self.mass, square, ..*self }
    }
}

/// Whether a cell is a voxel.
pub(crate) fn is_occupied((_, moments): &([i32; 3], Moments)) -> bool {
    moments.mass >= OCCUPIED_MASS
}

/// `a` times the transpose of `b`.
fn outer(a: Vec3, b: Vec3) -> Mat3 {
    Mat3::from_cols(a * b.x, a * b.y, a * b.z)
}

/// Square of the upward component of a Gaussian's thinnest axis; 0 of one that is not flat.
fn levelness(rotation: Quat, scale: Vec3) -> f32 {
    let thinnest = scale.min_position();
    let others = scale[(thinnest + 1) % 3].min(scale[(thinnest + 2) % 3]);
    let is_flat = scale[thinnest] < FLAT_SCALE * others;
    if is_flat { (rotation * Vec3::AXES[thinnest]).y.powi(2) } else { 0.0 }
}

/// Largest thickness of a flat Gaussian over its next larger axis.
const FLAT_SCALE: f32 = 0.5;

/// All offsets of at most `reach` cells along every axis.
fn offsets(reach: i32) -> impl Iterator<Item = [i32; 3]> {
    let range = move || -reach..=reach;
    range().flat_map(move |x| range().flat_map(move |y| range().map(move |z| [x, y, z])))
}

/// The direction of least variance of the samples in a cell and its neighbors; zero where they do not lie in a plane.
fn surface_normal(key: [i32; 3], cell: f32, cells: &[([i32; 3], Moments)], index: &CellIndex) -> Vec3 {
    let mut sum = Moments::EMPTY;
    for [a, b, c] in offsets(1) {
        if let Some(&i) = index.get(&[key[0] + a, key[1] + b, key[2] + c]) {
            sum.add(&cells[i as usize].1.shifted(Vec3::new(a as f32, b as f32, c as f32) * cell));
        }
    }
    let mean = sum.offset / sum.mass;
    let covariance = sum.square * (1.0 / sum.mass) - outer(mean, mean);
    let (values, axes) = symmetric_eigen(covariance);
    if values[0] < FLAT_RATIO * values[1] { axes.x_axis } else { Vec3::ZERO }
}

/// Ratio of least to middle variance below which samples lie on a surface.
const FLAT_RATIO: f32 = 0.35;

/// Eigenvalues, ascending, and eigenvectors of a symmetric matrix by Jacobi rotations.
pub(crate) fn symmetric_eigen(matrix: Mat3) -> ([f32; 3], Mat3) {
    let (mut a, mut v) = (matrix, Mat3::IDENTITY);
    for (p, q) in [(0, 1), (0, 2), (1, 2)].into_iter().cycle().take(18) {
        let off = a.col(q)[p];
        if off.abs() <= f32::MIN_POSITIVE {
            continue;
        }
        let angle = 0.5 * (2.0 * off).atan2(a.col(q)[q] - a.col(p)[p]);
        let (sin, cos) = angle.sin_cos();
        let mut turn = Mat3::IDENTITY;
        (turn.col_mut(p)[p], turn.col_mut(q)[q]) = (cos, cos);
        (turn.col_mut(q)[p], turn.col_mut(p)[q]) = (sin, -sin);
        a = turn.transpose() * a * turn;
        v *= turn;
    }
    let mut order = [0, 1, 2];
    order.sort_by(|&i, &j| a.col(i)[i].total_cmp(&a.col(j)[j]));
    (order.map(|i| a.col(i)[i]), Mat3::from_cols(v.col(order[0]), v.col(order[1]), v.col(order[2])))
}

//! Objects: files, boxes, alpha shapes, clouds, search, sheet.

mod agreement;
mod alpha_shape;
mod boxes;
mod by_name;
mod cloud;
mod delaunay;
mod editing;
mod file;
mod find;
mod find_touching;
mod lifting;
mod naming;
mod point_features;
mod radius_search;
mod renaming;
mod sheet;

use std::path::PathBuf;

use cinesplat::scene::{Gaussians, Scene, UpSource};
use glam::{DVec3, Quat, Vec3};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// A scene with the given Gaussians, y up.
pub fn scene_of(gaussians: Gaussians) -> Scene {
    Scene {
        path: PathBuf::new(),
        sha256: String::new(),
        format: "test".to_owned(),
        gaussians,
        dropped: Vec::new(),
        filter: None,
        up: DVec3::Y,
        up_source: UpSource::Flag,
        notes: Vec::new(),
    }
}

/// Adds a round Gaussian.
pub fn push(gaussians: &mut Gaussians, mean: DVec3, scale: f32, color: Vec3) {
    gaussians.means.push(mean.as_vec3());
    gaussians.scales.push(Vec3::splat(scale));
    gaussians.rotations.push(Quat::IDENTITY);
    gaussians.opacities.push(0.95);
    gaussians.sh_dc.push((color - 0.5) / 0.282_094_8);
}

/// Adds the surface of an axis-aligned box, one Gaussian per `step`.
pub fn push_box(gaussians: &mut Gaussians, center: DVec3, half: DVec3, step: f64, color: Vec3) {
    for axis in 0..3 {
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        let count = |axis: usize| (2.0 * half[axis] / step).ceil().max(1.0) as usize;
        for i in 0..=count(u) {
            for j in 0..=count(v) {
                for side in [-1.0, 1.0] {
                    let mut p = DVec3::ZERO;
                    p[axis] = side * half[axis];
                    p[u] = half[u] * (2.0 * i as f64 / count(u) as f64 - 1.0);
                    p[v] = half[v] * (2.0 * j as f64 / count(v) as f64 - 1.0);
                    push(gaussians, center + p, 0.6 * step as f32, color);
                }
            }
        }
    }
}

/// Seeded numbers in 0..1.
pub struct Dice(Pcg64Mcg);

impl Dice {
    /// The same numbers for the same seed.
    pub fn new(seed: u64) -> Self {
        Self(Pcg64Mcg::seed_from_u64(seed))
    }

    /// The next number, 0..1.
    pub fn unit(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// A whole number below a limit.
    pub fn below(&mut self, limit: usize) -> usize {
        (self.unit() * limit as f64) as usize
    }

    /// Shuffles in place (Fisher and Yates).
    pub fn shuffle<T>(&mut self, items: &mut [T]) {
        for i in (1..items.len()).rev() {
            items.swap(i, self.below(i + 1));
        }
    }
}

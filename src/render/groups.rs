//! Groups of neighboring Gaussians: invisible ones are rejected group by group, visible ones are read from memory in
//! order.
//!
//! Enters: the Gaussians of a scene, once. Leaves: packs of 16 Gaussians in groups of 256, each group with a bounding
//! sphere. The invariant: every Gaussian that can be drawn is in exactly one group.

use glam::{Quat, Vec3};
use rayon::prelude::*;

use super::memory::bytes_of;
use cinesplat_scene::Gaussians;

/// Gaussians per group. Smaller groups reject more Gaussians and need more tests; 64 and 1024 were both slower in the
/// kitchen scene.
pub(super) const GROUP_LEN: usize = 256;

/// Packs per group.
pub(super) const PACKS_PER_GROUP: usize = GROUP_LEN / LANES;

/// Bounds of a group of neighbors: a sphere about their means, and the largest scale and opacity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Group {
    /// Center of the sphere, relative to the scene's origin.
    pub(super) center: Vec3,
    /// Radius of the sphere, scene units.
    pub(super) radius: f32,
    /// Largest standard deviation of the members.
    pub(super) max_scale: f32,
    /// Largest opacity of the members.
    pub(super) max_opacity: f32,
}

/// Gaussians that are projected together: the width of the widest SIMD registers.
pub(super) const LANES: usize = 16;

/// One value per Gaussian of a pack.
pub(super) type Lane = [f32; LANES];

/// The attributes of 16 neighbors, one array per attribute. Unused lanes at the end have opacity 0.
#[derive(Debug, Clone, Copy)]
#[repr(align(64))]
pub(super) struct Pack {
    pub(super) mean: [Lane; 3],
    pub(super) scale: [Lane; 3],
    pub(super) rotation: [Lane; 4],
    pub(super) opacity: Lane,
    pub(super) sh_dc: [Lane; 3],
    pub(super) gaussian_idx: [u32; LANES],
}

/// All Gaussians of a scene that can be drawn, sorted by size class and along a space-filling curve, in groups.
#[derive(Debug)]
pub(super) struct Groups {
    /// Attributes: [`PACKS_PER_GROUP`] packs per group; all groups but the last are full.
    pub(super) packs: Vec<Pack>,
    /// Bounds of each group.
    pub(super) bounds: Vec<Group>,
    num_gaussians: usize,
}

impl Groups {
    /// Groups the Gaussians. Drops those with a value that is not finite, a rotation of length zero or an opacity of 0.
    pub(super) fn new(gaussians: &Gaussians) -> Self {
        let usable = |idx: &u32| is_usable(gaussians, *idx as usize);
        let kept: Vec<u32> = (0..gaussians.len() as u32).into_par_iter().filter(usable).collect();
        let (low, span) = extent(gaussians, &kept);
        let median = median_scale(gaussians, &kept);
        let code = |idx: u32| {
            let size_class = size_class(gaussians.scales[idx as usize].max_element() / median);
            size_class << MORTON_BITS | morton((gaussians.means[idx as usize] - low) / span)
        };
        let mut keyed: Vec<(u64, u32)> = kept.into_par_iter().map(|idx| (code(idx), idx)).collect();
        keyed.par_sort_unstable();
        let gaussian_from_slot: Vec<u32> = keyed.into_par_iter().map(|(_, idx)| idx).collect();
        let bounds = gaussian_from_slot.par_chunks(GROUP_LEN).map(|members| group(gaussians, members)).collect();
        let packs = gaussian_from_slot.par_chunks(LANES).map(|members| Pack::of(gaussians, members)).collect();
        Self { packs, bounds, num_gaussians: gaussian_from_slot.len() }
    }

    /// The attributes of a group's members.
    pub(super) fn packs_of(&self, group: usize) -> &[Pack] {
        let first = group * PACKS_PER_GROUP;
        &self.packs[first..(first + PACKS_PER_GROUP).min(self.packs.len())]
    }

    /// Number of a group's members.
    pub(super) fn len_of(&self, group: usize) -> usize {
        (self.num_gaussians - group * GROUP_LEN).min(GROUP_LEN)
    }

    /// Bytes of the lists.
    pub(super) fn bytes(&self) -> u64 {
        bytes_of(&self.packs) + bytes_of(&self.bounds)
    }

    /// Indices of all Gaussians that can be drawn, ascending.
    pub(super) fn usable(&self) -> Vec<u32> {
        let members = self.packs.iter().flat_map(|pack| &pack.gaussian_idx).take(self.num_gaussians);
        let mut usable: Vec<u32> = members.copied().collect();
        usable.sort_unstable();
        usable
    }
}

impl Pack {
    fn of(gaussians: &Gaussians, members: &[u32]) -> Self {
        let mut pack = Self {
            mean: [[0.0; LANES]; 3],
            scale: [[0.0; LANES]; 3],
            rotation: [[1.0; LANES]; 4],
            opacity: [0.0; LANES],
            sh_dc: [[0.0; LANES]; 3],
            gaussian_idx: [0; LANES],
        };
        for (lane, &gaussian_idx) in members.iter().enumerate() {
            let idx = gaussian_idx as usize;
            for axis in 0..3 {
                pack.mean[axis][lane] = gaussians.means[idx][axis];
                pack.scale[axis][lane] = gaussians.scales[idx][axis];
                pack.sh_dc[axis][lane] = gaussians.sh_dc[idx][axis];
            }
            for (part, value) in gaussians.rotations[idx].to_array().into_iter().enumerate() {
                pack.rotation[part][lane] = value;
            }
            pack.opacity[lane] = gaussians.opacities[idx];
            pack.gaussian_idx[lane] = gaussian_idx;
        }
        pack
    }
}

/// Whether a Gaussian can be drawn; rejects NaN.
fn is_usable(gaussians: &Gaussians, idx: usize) -> bool {
    let scale = gaussians.scales[idx];
    let rotation: Quat = gaussians.rotations[idx];
    gaussians.opacities[idx] > 0.0
        && gaussians.opacities[idx].is_finite()
        && gaussians.means[idx].is_finite()
        && scale.is_finite()
        && scale.min_element() >= 0.0
        && rotation.is_finite()
        && rotation.as_dquat().length_squared() > 1e-12
        && gaussians.sh_dc[idx].is_finite()
        && gaussians.sh_rest_of(idx).iter().all(|coefficient| coefficient.is_finite())
}

/// Values of a sample of the kept Gaussians, ascending.
fn sampled(kept: &[u32], number: impl Fn(usize) -> f32) -> Vec<f32> {
    let step = (kept.len() / 4096).max(1);
    let mut numbers: Vec<f32> = kept.iter().step_by(step).map(|&idx| number(idx as usize)).collect();
    numbers.sort_unstable_by(f32::total_cmp);
    numbers
}

/// Median of the Gaussians' largest standard deviations, estimated on a sample.
fn median_scale(gaussians: &Gaussians, kept: &[u32]) -> f32 {
    let scales = sampled(kept, |idx| gaussians.scales[idx].max_element());
    scales.get(scales.len() / 2).copied().unwrap_or_default().max(f32::MIN_POSITIVE)
}

/// Size class of a Gaussian from the ratio of its size to the median: up to 1, up to 4, up to 16 and so on. Classes do
/// not share groups, because a single huge Gaussian makes its whole group visible from everywhere.
fn size_class(times_median: f32) -> u64 {
    (times_median.max(1.0).log2() / 2.0).ceil().min(7.0) as u64
}

/// Lowest corner and side lengths of the box of the middle 98 % of the means along each axis, estimated on a sample.
fn extent(gaussians: &Gaussians, kept: &[u32]) -> (Vec3, Vec3) {
    let axis = |axis: usize| {
        let values = sampled(kept, |idx| gaussians.means[idx][axis]);
        let at = |frac: f64| values.get((frac * values.len() as f64) as usize).copied().unwrap_or_default();
        (at(0.01), at(0.99))
    };
    let (x, y, z) = (axis(0), axis(1), axis(2));
    let low = Vec3::new(x.0, y.0, z.0);
    (low, (Vec3::new(x.1, y.1, z.1) - low).max(Vec3::splat(f32::MIN_POSITIVE)))
}

/// Bits of a position on the z-order curve.
const MORTON_BITS: u32 = 60;

/// Position on the z-order curve of a point in the unit cube, 20 bits per axis; points outside are clamped to the cube.
fn morton(position: Vec3) -> u64 {
    let spread = |value: f32| {
        let mut bits = (value.clamp(0.0, 1.0) * 1_048_575.0) as u64;
        bits = (bits | bits << 32) & 0x1f_0000_0000_ffff;
        bits = (bits | bits << 16) & 0x1f_0000_ff00_00ff;
        bits = (bits | bits << 8) & 0x100f_00f0_0f00_f00f;
        bits = (bits | bits << 4) & 0x10c3_0c30_c30c_30c3;
        (bits | bits << 2) & 0x1249_2492_4924_9249
    };
    spread(position.x) | spread(position.y) << 1 | spread(position.z) << 2
}

fn group(gaussians: &Gaussians, members: &[u32]) -> Group {
    let means = || members.iter().map(|&idx| gaussians.means[idx as usize]);
    let low = means().fold(Vec3::INFINITY, Vec3::min);
    let high = means().fold(Vec3::NEG_INFINITY, Vec3::max);
    let center = low * 0.5 + high * 0.5;
    let max_scale = members.iter().map(|&idx| gaussians.scales[idx as usize].max_element()).fold(0.0, f32::max);
    let max_opacity = members.iter().map(|&idx| gaussians.opacities[idx as usize]).fold(0.0, f32::max);
    Group { center, radius: (high * 0.5 - low * 0.5).length() * 1.0001, max_scale, max_opacity }
}

use glam::{DMat3, DVec3};

use crate::gaussians::{Gaussians, SOLID_OPACITY};

/// Maximum number of patches. More of them change the estimate by less than its precision.
const MAX_PATCHES: usize = 20_000;

/// Ratio of smallest to middle standard deviation below which a Gaussian is flat and has a normal.
const FLATNESS: f32 = 0.4;

/// Share of the patches within the scene's core, and the factor on its radius within which patches count.
const CORE_FRAC: f64 = 0.95;
const CORE_MARGIN: f64 = 1.15;

/// A sampled Gaussian.
#[derive(Debug, Clone, Copy)]
pub(super) struct Patch {
    /// Mean relative to the center of the scene's core.
    pub(super) position: DVec3,
    /// Unit normal of a flat Gaussian, of arbitrary sign; zero for a round one.
    pub(super) normal: DVec3,
    /// Luma of the base color.
    pub(super) luma: f64,
}

/// A bounded number of Gaussians from the solid core of a scene.
///
/// Core and size do not depend on the axes of the world, so that a rotated scene has the rotated sample.
pub(super) struct PatchSample {
    /// Patches in file order.
    pub(super) patches: Vec<Patch>,
    /// Scene size, above 0: the diameter of the core.
    pub(super) size: f64,
}

impl PatchSample {
    /// Every n-th solid Gaussian, or every n-th of all if less than 5 % are solid, without those far outside. `None`
    /// for a scene without extent.
    pub(super) fn of(gaussians: &Gaussians) -> Option<Self> {
        let all = 0..gaussians.len();
        let solid: Vec<usize> = all.clone().filter(|&idx| gaussians.opacities[idx] >= SOLID_OPACITY).collect();
        let chosen = if solid.len() < gaussians.len() / 20 { all.collect() } else { solid };
        let stride = chosen.len().div_ceil(MAX_PATCHES).max(1);
        let mut patches: Vec<Patch> = chosen.iter().step_by(stride).map(|&idx| patch(gaussians, idx)).collect();
        let (middle, radius) = core(&patches)?;
        patches.iter_mut().for_each(|patch| patch.position -= middle);
        patches.retain(|patch| patch.position.length() <= CORE_MARGIN * radius);
        Some(Self { patches, size: 2.0 * radius })
    }
}

/// Center and radius of the core: the ball around the mean of its own patches that holds [`CORE_FRAC`] of all.
fn core(patches: &[Patch]) -> Option<(DVec3, f64)> {
    let rank = (CORE_FRAC * patches.len().checked_sub(1)? as f64) as usize;
    let mut inside: Vec<DVec3> = patches.iter().map(|patch| patch.position).collect();
    let mut middle = DVec3::ZERO;
    let mut radius = 0.0;
    for _ in 0..4 {
        middle = inside.iter().sum::<DVec3>() / inside.len().max(1) as f64;
        let mut distances: Vec<f64> = patches.iter().map(|patch| patch.position.distance(middle)).collect();
        radius = *distances.select_nth_unstable_by(rank, f64::total_cmp).1;
        inside = patches.iter().map(|p| p.position).filter(|p| p.distance(middle) <= radius).collect();
    }
    (radius > 0.0 && radius.is_finite()).then_some((middle, radius))
}

fn patch(gaussians: &Gaussians, idx: usize) -> Patch {
    let scale = gaussians.scales[idx];
    let mut sorted = scale.to_array();
    sorted.sort_unstable_by(f32::total_cmp);
    let axes = DMat3::from_quat(gaussians.rotations[idx].as_dquat());
    let normal = if sorted[0] < FLATNESS * sorted[1] { axes.col(scale.min_position()) } else { DVec3::ZERO };
    let color = gaussians.base_color(idx).clamp(glam::Vec3::ZERO, glam::Vec3::ONE).as_dvec3();
    Patch { position: gaussians.mean_world(idx), normal, luma: color.dot(DVec3::new(0.299, 0.587, 0.114)) }
}

use glam::{DMat3, DVec3};

use crate::bounds::Bounds;
use crate::gaussians::{Gaussians, SOLID_OPACITY};

/// Maximum number of patches. More of them change the estimate by less than its precision.
const MAX_PATCHES: usize = 40_000;

/// Ratio of smallest to middle standard deviation below which a Gaussian is flat and has a normal.
const FLATNESS: f32 = 0.4;

/// A sampled Gaussian.
#[derive(Debug, Clone, Copy)]
pub(super) struct Patch {
    /// Mean relative to the center of the scene's core.
    pub(super) position: DVec3,
    /// Unit normal of a flat Gaussian, of arbitrary sign; zero for a round one.
    pub(super) normal: DVec3,
}

/// A bounded number of Gaussians from the solid core of a scene.
pub(super) struct PatchSample {
    /// Patches in file order.
    pub(super) patches: Vec<Patch>,
    /// Scene size, above 0.
    pub(super) size: f64,
}

impl PatchSample {
    /// Every n-th solid Gaussian of the core, or every n-th of all Gaussians there if less than 5 % are solid. `None` for a
    /// scene without extent.
    pub(super) fn of(gaussians: &Gaussians) -> Option<Self> {
        let bounds = Bounds::of(gaussians);
        let (size, middle) = (bounds.size(), bounds.center());
        if !(size > 0.0 && size.is_finite()) {
            return None;
        }
        let margin = DVec3::splat(0.05 * size);
        let (low, high) = (bounds.core_min - margin, bounds.core_max + margin);
        let is_core = |idx: &usize| {
            let p = gaussians.mean_world(*idx);
            p.cmpge(low).all() && p.cmple(high).all()
        };
        let core: Vec<usize> = (0..gaussians.len()).filter(is_core).collect();
        let solid: Vec<usize> = core.iter().copied().filter(|&idx| gaussians.opacities[idx] >= SOLID_OPACITY).collect();
        let chosen = if solid.len() < core.len() / 20 { core } else { solid };
        let stride = chosen.len().div_ceil(MAX_PATCHES).max(1);
        Some(Self { patches: chosen.iter().step_by(stride).map(|&idx| patch(gaussians, idx, middle)).collect(), size })
    }
}

fn patch(gaussians: &Gaussians, idx: usize, middle: DVec3) -> Patch {
    let scale = gaussians.scales[idx];
    let mut sorted = scale.to_array();
    sorted.sort_unstable_by(f32::total_cmp);
    let axes = DMat3::from_quat(gaussians.rotations[idx].as_dquat());
    let normal = if sorted[0] < FLATNESS * sorted[1] { axes.col(scale.min_position()) } else { DVec3::ZERO };
    Patch { position: gaussians.mean_world(idx) - middle, normal }
}

use glam::DVec3;

use super::gaussians::{Gaussians, SOLID_OPACITY};

/// Axis-aligned bounds of a scene, world.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    /// Lowest corner of all means.
    pub min: DVec3,
    /// Highest corner of all means.
    pub max: DVec3,
    /// Lowest corner of the core: the box of the middle 96 % of the solid Gaussians, axis by axis.
    pub core_min: DVec3,
    /// Highest corner of the core.
    pub core_max: DVec3,
}

impl Bounds {
    /// Bounds of the means. If no Gaussian is solid, all of them form the core; without Gaussians, all corners are zero.
    pub fn of(gaussians: &Gaussians) -> Self {
        let all = || (0..gaussians.len()).map(|i| gaussians.mean_world(i));
        let min = all().reduce(DVec3::min).unwrap_or(DVec3::ZERO);
        let max = all().reduce(DVec3::max).unwrap_or(DVec3::ZERO);
        let mut solid: Vec<usize> = (0..gaussians.len()).filter(|&i| gaussians.opacities[i] >= SOLID_OPACITY).collect();
        if solid.is_empty() {
            solid = (0..gaussians.len()).collect();
        }
        let axis = |axis: usize| {
            let mut values: Vec<f64> = solid.iter().map(|&i| gaussians.mean_world(i)[axis]).collect();
            values.sort_unstable_by(f64::total_cmp);
            (percentile(&values, 0.02), percentile(&values, 0.98))
        };
        let (x, y, z) = (axis(0), axis(1), axis(2));
        Self { min, max, core_min: DVec3::new(x.0, y.0, z.0), core_max: DVec3::new(x.1, y.1, z.1) }
    }

    /// Scene size: the diagonal of the core, scene units.
    pub fn size(&self) -> f64 {
        (self.core_max - self.core_min).length()
    }

    /// Center of the core, world.
    pub fn center(&self) -> DVec3 {
        (self.core_min + self.core_max) / 2.0
    }

    /// Default distance of the near plane, scene units: 0.01 times the scene size, clamped to 1e-6..=0.2.
    pub fn default_near(&self) -> f64 {
        (0.01 * self.size()).clamp(1e-6, 0.2)
    }
}

/// Linearly interpolated percentile of sorted values, as `numpy.percentile`; 0 for no values.
fn percentile(sorted: &[f64], frac: f64) -> f64 {
    let Some(last) = sorted.len().checked_sub(1) else { return 0.0 };
    let at = frac * last as f64;
    let low = at.floor() as usize;
    let high = (low + 1).min(last);
    sorted[low] + (sorted[high] - sorted[low]) * (at - low as f64)
}

use glam::{DVec3, Quat, Vec3};

/// Number of spherical-harmonic coefficients per color channel above degree 0, for degrees 0..=3.
pub const NUM_SH_REST: [usize; 4] = [0, 3, 8, 15];

/// Lowest opacity at which a Gaussian counts as solid.
///
/// Bounds, the up axis, boxes of objects and the camera's clearance ignore Gaussians below it.
pub const SOLID_OPACITY: f32 = 0.5;

/// Shortest over middle axis below which a Gaussian is flat.
const FLATNESS: f32 = 0.5;

/// The decoded Gaussians of a scene: linear scales, opacities in 0..=1, unit rotations.
///
/// Means are `f32` offsets from `origin` (`f64`, world), so that scenes far from the world's origin keep their precision.
/// Every column has one entry per Gaussian in file order, except `sh_rest` and `ids`.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Gaussians {
    /// World position of offset zero. It is zero for scenes near the world's origin.
    pub origin: DVec3,
    /// Mean of each Gaussian minus `origin`.
    pub means: Vec<Vec3>,
    /// Standard deviations along the Gaussian's axes, scene units.
    pub scales: Vec<Vec3>,
    /// World from the Gaussian's axes, unit quaternions.
    pub rotations: Vec<Quat>,
    /// Peak opacity, 0..=1.
    pub opacities: Vec<f32>,
    /// Coefficients of degree 0, rgb: color = max(0, 0.2820948 * `sh_dc` + higher degrees + 0.5).
    pub sh_dc: Vec<Vec3>,
    /// Highest degree of the spherical harmonics, 0..=3.
    pub sh_degree: u8,
    /// Coefficients above degree 0, n = `NUM_SH_REST[sh_degree]` per Gaussian: `[gaussian * n + coefficient]` holds rgb.
    pub sh_rest: Vec<Vec3>,
    /// Object id per Gaussian, 0 = no object; empty if the file has no ids.
    pub ids: Vec<u16>,
}

impl Gaussians {
    /// Number of Gaussians.
    pub fn len(&self) -> usize {
        self.means.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.means.is_empty()
    }

    /// Mean of a Gaussian, world.
    pub fn mean_world(&self, gaussian_idx: usize) -> DVec3 {
        self.origin + self.means[gaussian_idx].as_dvec3()
    }

    /// Coefficients above degree 0 of a Gaussian: `[coefficient]` of rgb.
    pub fn sh_rest_of(&self, gaussian_idx: usize) -> &[Vec3] {
        let n = NUM_SH_REST[usize::from(self.sh_degree.min(3))];
        &self.sh_rest[gaussian_idx * n..(gaussian_idx + 1) * n]
    }

    /// The Gaussians with the given indices, in their order.
    #[must_use]
    pub fn subset(&self, indices: &[usize]) -> Self {
        Self {
            sh_degree: self.sh_degree,
            sh_rest: indices.iter().flat_map(|&i| self.sh_rest_of(i)).copied().collect(),
            ids: if self.ids.is_empty() { Vec::new() } else { indices.iter().map(|&i| self.ids[i]).collect() },
            ..self.plain_subset(indices)
        }
    }

    /// As [`Gaussians::subset`], without view-dependent color and ids.
    #[must_use]
    pub fn plain_subset(&self, indices: &[usize]) -> Self {
        Self {
            origin: self.origin,
            means: indices.iter().map(|&i| self.means[i]).collect(),
            scales: indices.iter().map(|&i| self.scales[i]).collect(),
            rotations: indices.iter().map(|&i| self.rotations[i]).collect(),
            opacities: indices.iter().map(|&i| self.opacities[i]).collect(),
            sh_dc: indices.iter().map(|&i| self.sh_dc[i]).collect(),
            sh_degree: 0,
            sh_rest: Vec::new(),
            ids: Vec::new(),
        }
    }

    /// The unit normal of a flat Gaussian, of either sign, and the product of its two longer standard deviations. A Gaussian
    /// is flat where its shortest axis is shorter than half its middle one; `None` for another.
    pub fn facet(&self, gaussian_idx: usize) -> Option<(DVec3, f64)> {
        let scale = self.scales[gaussian_idx];
        let shortest = scale.min_position();
        let [a, b] = [scale[(shortest + 1) % 3], scale[(shortest + 2) % 3]];
        let normal = || self.rotations[gaussian_idx].as_dquat() * DVec3::AXES[shortest];
        (scale[shortest] < FLATNESS * a.min(b)).then(|| (normal(), f64::from(a) * f64::from(b)))
    }

    /// Color of degree 0 of a Gaussian, without view dependence: rgb, clamped to 0..=1.
    pub fn base_color(&self, gaussian_idx: usize) -> Vec3 {
        (self.sh_dc[gaussian_idx] * 0.282_094_8 + 0.5).clamp(Vec3::ZERO, Vec3::ONE)
    }
}

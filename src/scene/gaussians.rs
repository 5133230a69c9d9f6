use glam::{DVec3, Quat, Vec3};

/// Number of spherical-harmonic coefficients a color channel has above degree 0, for degrees 0..=3.
pub const NUM_SH_REST: [usize; 4] = [0, 3, 8, 15];

/// Lowest opacity at which a Gaussian counts as solid.
///
/// Bounds, the up axis, boxes of objects and the camera's clearance ignore Gaussians below it.
pub const SOLID_OPACITY: f32 = 0.5;

/// A scene as 3D Gaussians, decoded: linear scales, opacities in 0..=1, unit rotations.
///
/// Positions are `f32` offsets from `origin` (f64, world), so that far-off scenes keep their precision. All columns
/// have one entry a Gaussian, in file order.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Gaussians {
    /// World position of offset zero; zero for scenes near the world's origin.
    pub origin: DVec3,
    /// Mean of each Gaussian minus `origin`.
    pub means: Vec<Vec3>,
    /// Standard deviations along the Gaussian's own axes.
    pub scales: Vec<Vec3>,
    /// Unit quaternions from the Gaussian's own axes to the world.
    pub rotations: Vec<Quat>,
    /// Peak opacity, 0..=1.
    pub opacities: Vec<f32>,
    /// Degree-0 coefficients: color = max(0, 0.2820948 * `sh_dc` + higher bands + 0.5).
    pub sh_dc: Vec<Vec3>,
    /// Highest degree stored, 0..=3.
    pub sh_degree: u8,
    /// Coefficients above degree 0, `NUM_SH_REST[sh_degree]` a Gaussian, coefficient-major: `[gaussian * n + coefficient]`
    /// holds r, g, b.
    pub sh_rest: Vec<Vec3>,
    /// Object ids where the file carries them, else empty; 0 = no object.
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

    /// Mean of one Gaussian in the world.
    pub fn mean_world(&self, gaussian_idx: usize) -> DVec3 {
        self.origin + self.means[gaussian_idx].as_dvec3()
    }

    /// Coefficients above degree 0 of one Gaussian: `[coefficient]` of rgb.
    pub fn sh_rest_of(&self, gaussian_idx: usize) -> &[Vec3] {
        let n = NUM_SH_REST[usize::from(self.sh_degree.min(3))];
        &self.sh_rest[gaussian_idx * n..(gaussian_idx + 1) * n]
    }

    /// Color seen from nowhere in particular: that of degree 0, clamped to 0..=1.
    pub fn base_color(&self, gaussian_idx: usize) -> Vec3 {
        (self.sh_dc[gaussian_idx] * 0.282_094_8 + 0.5).clamp(Vec3::ZERO, Vec3::ONE)
    }
}

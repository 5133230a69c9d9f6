use glam::{DVec3, Vec3};

/// Fog of even density: light is lost with the distance, and fog takes its place.
///
/// Each splat's color is mixed before blending, by the distance of its Gaussian: nothing is smeared across edges. The
/// background is infinitely far and shows fog alone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fog {
    /// Color of the fog, in the colors of the trained scene.
    pub color: Vec3,
    /// Share of the light lost per scene unit, as an exponent: after a distance d the share exp(-d density) is left.
    pub density: f64,
}

impl Fog {
    /// The color of a Gaussian as it is seen through the fog; `offset` is its mean minus the camera center.
    #[inline(always)]
    pub(super) fn tinted(&self, color: DVec3, offset: DVec3) -> DVec3 {
        let (fog, share) = (self.color.as_dvec3(), (-self.density * offset.length()).exp());
        fog + (color - fog) * share
    }
}

use glam::{DMat3, DQuat, DVec3, Quat, Vec3};

use super::bvh::OccluderBvh;
use super::occluder::Ray;

/// A surfel: a flat Gaussian with the material at its mean, before lighting. World frame, m.
#[derive(Debug, Clone, Copy)]
pub(super) struct Surfel {
    /// Mean.
    pub(super) mean: Vec3,
    /// World from the surfel's axes; the third axis is the normal.
    pub(super) rotation: Quat,
    /// Standard deviations along the surfel's axes.
    pub(super) scale: Vec3,
    /// Outward unit normal.
    pub(super) normal: Vec3,
    /// Linear reflectance.
    pub(super) albedo: Vec3,
    /// Emitted radiance divided by the reflectance.
    pub(super) emission: f32,
    /// Peak opacity, 0..=1.
    pub(super) opacity: f32,
    /// Strength of the sheen, 0..=1.
    pub(super) gloss: f32,
    /// Whether both sides receive light.
    pub(super) two_sided: bool,
    /// Object id; 0 = the room itself.
    pub(super) object: u16,
}

/// Depth inside another primitive from which a surfel is hidden, m. The proxies of round primitives are slightly larger
/// than the primitives.
const BURIED_DEPTH: f32 = 0.02;

/// Width of a gap between two surfaces that no camera can look into, m.
const CLOSED_GAP: f32 = 0.035;

impl Surfel {
    /// Half extents of the one-sigma ellipsoid along the axes of a frame.
    pub(super) fn half_extents(&self, frame_from_world: DQuat) -> DVec3 {
        let own =
            DMat3::from_quat(frame_from_world * self.rotation.as_dquat()) * DMat3::from_diagonal(self.scale.as_dvec3());
        let row = |i: usize| own.row(i).length();
        DVec3::new(row(0), row(1), row(2))
    }

    /// Whether another primitive contains the surfel, or covers it so closely that no camera sees it. Renderers sort
    /// splats by their centers, so at grazing views such a surfel would show through the surface in front of it.
    pub(super) fn is_hidden(&self, occluders: &OccluderBvh, primitive: u32) -> bool {
        if self.two_sided || self.emission > 0.0 {
            return false;
        }
        let axes = [self.rotation * Vec3::X * self.scale.x, self.rotation * Vec3::Y * self.scale.y];
        let is_covered = |offset: Vec3| {
            let origin = self.mean + offset + self.normal * 0.001;
            let ray = Ray { origin, direction: self.normal, object: self.object, primitive: Some(primitive) };
            occluders.is_occluded(&ray, CLOSED_GAP)
        };
        occluders.is_buried(self.mean, primitive, BURIED_DEPTH)
            || [Vec3::ZERO, axes[0], -axes[0], axes[1], -axes[1]].into_iter().all(is_covered)
    }
}

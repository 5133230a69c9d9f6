use glam::{DQuat, DVec3};

/// A rigid transform: object from primitive, or world from object.
#[derive(Debug, Clone, Copy)]
pub(super) struct Placement {
    /// Rotation.
    pub(super) rotation: DQuat,
    /// Translation after the rotation, m.
    pub(super) translation: DVec3,
}

impl Placement {
    /// A translation.
    pub(super) fn at(translation: DVec3) -> Self {
        Self { rotation: DQuat::IDENTITY, translation }
    }

    /// A translation after a rotation about the up axis; at yaw 0 the front faces +z.
    pub(super) fn facing(translation: DVec3, yaw_rad: f64) -> Self {
        Self { rotation: DQuat::from_rotation_y(yaw_rad), translation }
    }

    /// The transformed point.
    pub(super) fn apply(&self, point: DVec3) -> DVec3 {
        self.rotation * point + self.translation
    }

    /// The composition that applies `inner` first, then `self`.
    pub(super) fn after(&self, inner: &Self) -> Self {
        Self { rotation: self.rotation * inner.rotation, translation: self.apply(inner.translation) }
    }
}

use glam::{DQuat, DVec3};

/// A rigid placement: part to object, or object to world.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place {
    /// Turn.
    pub(super) rotation: DQuat,
    /// Shift after the turn.
    pub(super) translation: DVec3,
}

impl Place {
    /// A shift alone.
    pub(super) fn at(translation: DVec3) -> Self {
        Self { rotation: DQuat::IDENTITY, translation }
    }

    /// Standing at a point, turned about the upright axis; at 0 the front looks along +z.
    pub(super) fn facing(translation: DVec3, yaw_rad: f64) -> Self {
        Self { rotation: DQuat::from_rotation_y(yaw_rad), translation }
    }

    /// A point carried over.
    pub(super) fn apply(&self, point: DVec3) -> DVec3 {
        self.rotation * point + self.translation
    }

    /// First `inner`, then this.
    pub(super) fn after(&self, inner: &Self) -> Self {
        Self { rotation: self.rotation * inner.rotation, translation: self.apply(inner.translation) }
    }
}

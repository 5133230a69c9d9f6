use glam::{DMat3, DMat4, DQuat, DVec3};

use super::{GeometryError, rotation};

/// Position and rotation of a camera: `world_from_camera` with OpenCV camera axes (x right, y down, z forward).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pose {
    /// Camera center, world.
    pub position: DVec3,
    /// Unit quaternion from camera axes to world axes.
    pub rotation: DQuat,
}

impl Pose {
    /// The camera at the world's origin, with the world's axes.
    pub const IDENTITY: Self = Self { position: DVec3::ZERO, rotation: DQuat::IDENTITY };

    /// A pose from a position and a rotation; normalizes the rotation.
    pub fn new(position: DVec3, rotation: DQuat) -> Self {
        Self { position, rotation: rotation.normalize() }
    }

    /// The pose at `eye` that looks at `target`, with an x axis perpendicular to `up`.
    ///
    /// A view along `up` leaves the heading open: the x axis then follows `right_hint`, or a fixed axis without one.
    ///
    /// # Errors
    /// [`GeometryError::NoViewDirection`] if eye and target coincide or are not finite.
    pub fn look_at(eye: DVec3, target: DVec3, up: DVec3, right_hint: Option<DVec3>) -> Result<Self, GeometryError> {
        let forward = (target - eye)
            .try_normalize()
            .filter(|f| f.is_finite() && eye.is_finite())
            .ok_or(GeometryError::NoViewDirection { eye: eye.to_array(), target: target.to_array() })?;
        Ok(Self::facing(eye, forward, up, right_hint))
    }

    /// As [`Pose::look_at`], with a unit view direction instead of a target.
    pub fn facing(eye: DVec3, forward: DVec3, up: DVec3, right_hint: Option<DVec3>) -> Self {
        let level = forward.cross(up);
        let right = if level.length() > 1e-6 * up.length() {
            level.normalize()
        } else {
            let hint = right_hint.map(|hint| hint - forward * hint.dot(forward));
            hint.and_then(DVec3::try_normalize).unwrap_or_else(|| forward.any_orthonormal_vector())
        };
        let axes = DMat3::from_cols(right, forward.cross(right), forward);
        Self { position: eye, rotation: DQuat::from_mat3(&axes).normalize() }
    }

    /// A pose from a 4 x 4 `world_from_camera` matrix.
    ///
    /// # Errors
    /// [`GeometryError::NotARotation`] if the upper left 3 x 3 is mirrored, scaled or not finite (tolerance 1e-3), or
    /// the position is not finite.
    pub fn from_matrix(world_from_camera: DMat4) -> Result<Self, GeometryError> {
        let rotation = rotation::from_matrix(DMat3::from_mat4(world_from_camera))?;
        let position = world_from_camera.w_axis.truncate();
        if !position.is_finite() {
            return Err(GeometryError::NotARotation { reason: format!("position {position} is not finite") });
        }
        Ok(Self { position, rotation })
    }

    /// The 4 x 4 matrix from camera coordinates to world coordinates.
    pub fn world_from_camera(&self) -> DMat4 {
        DMat4::from_rotation_translation(self.rotation, self.position)
    }

    /// The 4 x 4 matrix from world coordinates to camera coordinates.
    pub fn camera_from_world(&self) -> DMat4 {
        self.inverse().world_from_camera()
    }

    /// The inverse transform: `camera_from_world`, in the same form.
    #[must_use]
    pub fn inverse(&self) -> Self {
        let back = self.rotation.conjugate();
        Self { position: back * -self.position, rotation: back }
    }

    /// The product `self * first` of two transforms: applies `first`, then `self`.
    #[must_use]
    pub fn compose(&self, first: &Self) -> Self {
        Self {
            position: self.position + self.rotation * first.position,
            rotation: (self.rotation * first.rotation).normalize(),
        }
    }

    /// The pose at a share of the way to another one: the position on a line, the rotation at constant speed along the
    /// shorter arc.
    #[must_use]
    pub fn between(&self, end: &Self, t: f64) -> Self {
        Self::new(self.position.lerp(end.position, t), rotation::slerp(self.rotation, end.rotation, t))
    }

    /// A world point in camera coordinates.
    pub fn to_camera(&self, point_world: DVec3) -> DVec3 {
        self.rotation.conjugate() * (point_world - self.position)
    }

    /// The camera's right, unit vector in the world.
    pub fn right(&self) -> DVec3 {
        self.rotation * DVec3::X
    }

    /// The camera's up (its negative y axis), unit vector in the world.
    pub fn up(&self) -> DVec3 {
        self.rotation * DVec3::NEG_Y
    }

    /// The view direction (the camera's z axis), unit vector in the world.
    pub fn forward(&self) -> DVec3 {
        self.rotation * DVec3::Z
    }
}

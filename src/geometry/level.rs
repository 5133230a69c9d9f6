use glam::{DMat3, DQuat, DVec3};

use super::{GeometryError, Pose};

/// A camera's rotation in the operator's terms: first yaw about the world's up, then pitch, then roll.
///
/// Yaw is positive to the operator's right, pitch is positive upward, and roll is positive clockwise as the operator
/// sees it (the camera's right side dips).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct LevelAngles {
    /// Heading: 0 at the frame's `north`, positive to the right.
    pub yaw_rad: f64,
    /// Angle of the view axis above the horizon.
    pub pitch_rad: f64,
    /// Rotation about the view axis; 0 with a level horizon.
    pub roll_rad: f64,
}

/// The frame in which yaw, pitch, roll, azimuth and height are measured: the world's up and a reference heading.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LevelFrame {
    /// World up, unit length.
    pub up: DVec3,
    /// Horizontal unit direction at yaw 0.
    pub north: DVec3,
    /// Horizontal unit direction to the right of `north`.
    pub east: DVec3,
}

impl LevelFrame {
    /// The level frame about `up`, with a reference heading that depends on `up` alone.
    ///
    /// # Errors
    /// [`GeometryError::NoUpDirection`] if `up` has no length or is not finite.
    pub fn new(up: DVec3) -> Result<Self, GeometryError> {
        let up = up
            .try_normalize()
            .filter(|u| u.is_finite())
            .ok_or(GeometryError::NoUpDirection { found: up.to_array() })?;
        let aside = if up.x.abs() < 0.8 { DVec3::X } else { DVec3::Z };
        let east = up.cross(aside).normalize();
        Ok(Self { up, north: up.cross(east), east })
    }

    /// The same frame with yaw 0 at the heading of `forward`; unchanged if `forward` is vertical.
    #[must_use]
    pub fn with_heading(&self, forward: DVec3) -> Self {
        let flat = forward - self.up * forward.dot(self.up);
        match flat.try_normalize().filter(|_| flat.length() > 1e-9) {
            Some(north) => Self { up: self.up, north, east: north.cross(self.up) },
            None => *self,
        }
    }

    /// Horizontal unit direction at an azimuth (rad, positive to the right of `north`).
    pub fn direction(&self, azimuth_rad: f64) -> DVec3 {
        self.north * azimuth_rad.cos() + self.east * azimuth_rad.sin()
    }

    /// Unit directions on rings around up, ring by ring: at each elevation above the horizon (rad) `num_azimuths` ones, evenly
    /// spaced from `north` on.
    pub fn rings<'a>(&'a self, num_azimuths: usize, elevations_rad: &'a [f64]) -> impl Iterator<Item = DVec3> + 'a {
        elevations_rad.iter().flat_map(move |elevation_rad| {
            (0..num_azimuths).map(move |step| {
                let level = self.direction(step as f64 * std::f64::consts::TAU / num_azimuths as f64);
                level * elevation_rad.cos() + self.up * elevation_rad.sin()
            })
        })
    }

    /// Azimuth of the horizontal part of a direction, rad, -pi..=pi.
    pub fn azimuth(&self, direction: DVec3) -> f64 {
        direction.dot(self.east).atan2(direction.dot(self.north))
    }

    /// Component of a point or vector along up.
    pub fn height(&self, point: DVec3) -> f64 {
        point.dot(self.up)
    }

    /// The point above or below another one at a height along up.
    pub fn at_height(&self, point: DVec3, height: f64) -> DVec3 {
        point + self.up * (height - self.height(point))
    }

    /// A point turned by an azimuth about the upright axis through a pivot.
    pub fn swung(&self, pivot: DVec3, point: DVec3, azimuth_rad: f64) -> DVec3 {
        let away = point - pivot;
        let direction = self.direction(self.azimuth(away) + azimuth_rad);
        pivot + direction * self.horizontal(away).length() + self.up * self.height(away)
    }

    /// The horizontal part of a vector.
    pub fn horizontal(&self, vector: DVec3) -> DVec3 {
        vector - self.up * vector.dot(self.up)
    }

    /// Yaw, pitch and roll of a rotation (`world_from_camera`). For a vertical view axis, roll is 0 and yaw follows the
    /// camera's right.
    pub fn angles(&self, rotation: DQuat) -> LevelAngles {
        let (right, down, forward) = (rotation * DVec3::X, rotation * DVec3::Y, rotation * DVec3::Z);
        let pitch_rad = forward.dot(self.up).clamp(-1.0, 1.0).asin();
        if self.horizontal(forward).length() < 1e-7 {
            return LevelAngles {
                yaw_rad: self.azimuth(right) - std::f64::consts::FRAC_PI_2,
                pitch_rad,
                roll_rad: 0.0,
            };
        }
        let yaw_rad = self.azimuth(forward);
        let roll_rad = (-right.dot(self.up)).atan2(-down.dot(self.up));
        LevelAngles { yaw_rad, pitch_rad, roll_rad }
    }

    /// The rotation (`world_from_camera`) with these angles, the inverse of [`LevelFrame::angles`].
    pub fn rotation(&self, angles: LevelAngles) -> DQuat {
        let heading = self.direction(angles.yaw_rad);
        let right = heading.cross(self.up);
        let forward = heading * angles.pitch_rad.cos() + self.up * angles.pitch_rad.sin();
        let down = forward.cross(right);
        let (sin, cos) = angles.roll_rad.sin_cos();
        let axes = DMat3::from_cols(right * cos + down * sin, down * cos - right * sin, forward);
        DQuat::from_mat3(&axes).normalize()
    }

    /// Roll of a pose, rad; 0 with a level horizon.
    pub fn roll_rad(&self, pose: &Pose) -> f64 {
        self.angles(pose.rotation).roll_rad
    }
}

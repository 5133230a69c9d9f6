//! The frame in which the network sees a scene: level, centered, of size one.

use glam::{DMat3, DQuat, DVec3};

use super::DirectorError;
use cinesplat_geometry::{LevelFrame, Pose, rotation};

/// A level frame: x to the right of its heading, y up, z against the heading; origin in the middle of the scene, unit =
/// scene size. Everything that enters or leaves the network is in it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SceneFrame {
    /// Takes world directions to frame directions.
    frame_from_world: DQuat,
    /// Origin, world.
    center: DVec3,
    /// Scene size in scene units.
    size: f64,
}

impl SceneFrame {
    /// The frame about `up` (any length) with its origin at `center` and its heading from there toward `toward`; a fixed
    /// heading without one or when it lies above or below the center.
    ///
    /// # Errors
    /// [`DirectorError::BadScene`] when `up` has no direction or `size` is not a positive number.
    pub fn new(up: DVec3, center: DVec3, size: f64, toward: Option<DVec3>) -> Result<Self, DirectorError> {
        let level = LevelFrame::new(up)
            .map_err(|error| DirectorError::BadScene { found: error.to_string(), expected: "a unit up direction" })?;
        // Written so that NaN fails.
        if !(size > 0.0 && size.is_finite() && center.is_finite()) {
            let found = format!("size {size}, center {center}");
            return Err(DirectorError::BadScene { found, expected: "a finite center and a size above 0" });
        }
        let level = match toward {
            Some(target) if level.horizontal(target - center).length() > 1e-6 * size => {
                level.with_heading(target - center)
            }
            _ => level,
        };
        let world_from_frame = DMat3::from_cols(level.east, level.up, -level.north);
        Ok(Self { frame_from_world: DQuat::from_mat3(&world_from_frame.transpose()).normalize(), center, size })
    }

    /// Scene size in scene units.
    pub fn size(&self) -> f64 {
        self.size
    }

    /// A world point in the frame.
    pub fn point(&self, point_world: DVec3) -> DVec3 {
        self.frame_from_world * (point_world - self.center) / self.size
    }

    /// A world rotation (`world_from_x`) in the frame.
    pub fn turn(&self, world_from_x: DQuat) -> DQuat {
        (self.frame_from_world * world_from_x).normalize()
    }

    /// A pose in the frame: position in scene sizes and 6D rotation.
    pub fn pose(&self, pose: &Pose) -> (DVec3, [f64; 6]) {
        (self.point(pose.position), rotation::to_6d(self.turn(pose.rotation)))
    }

    /// The world pose of a position and a 6D rotation of this frame; a degenerate rotation falls back to `fallback`, in
    /// the frame.
    pub fn world_pose(&self, position: DVec3, rotation_6d: [f64; 6], fallback: DQuat) -> Pose {
        let world_from_frame = self.frame_from_world.conjugate();
        let turned = world_from_frame * rotation::from_6d(rotation_6d, fallback);
        Pose::new(world_from_frame * position * self.size + self.center, turned)
    }

    /// Half extents, along the frame's axes, of a box given in the world: those of the smallest box of the frame that
    /// holds it.
    pub fn half_extents(&self, half_extents: DVec3, world_from_box: DQuat) -> DVec3 {
        let axes = DMat3::from_quat(self.turn(world_from_box));
        let absolute = DMat3::from_cols(axes.x_axis.abs(), axes.y_axis.abs(), axes.z_axis.abs());
        absolute * half_extents.abs() / self.size
    }
}

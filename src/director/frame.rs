//! The frame of the network's inputs and outputs: level, centered, one scene size per unit.

use glam::{DMat3, DQuat, DVec3};

use super::error::DirectorError;
use cinesplat_geometry::{LevelFrame, Pose, rotation};

/// A level frame: x points to the right of its heading, y up, z against the heading. The origin is the center of the scene
/// and the unit is the scene size. All inputs and outputs of the network are in this frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SceneFrame {
    /// Rotates world directions into the frame.
    frame_from_world: DQuat,
    /// Origin, in the world.
    center: DVec3,
    /// Scene size in scene units.
    size: f64,
}

impl SceneFrame {
    /// The frame of up direction `up` (of any length), origin `center` and heading from there to `toward`, all in the world.
    /// Without `toward`, or when it lies straight above or below the center, the heading is that of [`LevelFrame::new`].
    ///
    /// # Errors
    /// [`DirectorError::BadScene`] when `up` has no direction or `size` is not a positive number.
    pub fn new(up: DVec3, center: DVec3, size: f64, toward: Option<DVec3>) -> Result<Self, DirectorError> {
        let level = LevelFrame::new(up)
            .map_err(|error| DirectorError::BadScene { found: error.to_string(), expected: "a unit up direction" })?;
        // NaN fails this test.
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

    /// A world point in the frame, in scene sizes.
    pub fn point(&self, point_world: DVec3) -> DVec3 {
        self.frame_from_world * (point_world - self.center) / self.size
    }

    /// The rotation `frame_from_x` of a rotation `world_from_x`.
    pub fn turn(&self, world_from_x: DQuat) -> DQuat {
        (self.frame_from_world * world_from_x).normalize()
    }

    /// Position in scene sizes and 6D rotation of a world pose in the frame.
    pub fn pose(&self, pose: &Pose) -> (DVec3, [f64; 6]) {
        (self.point(pose.position), rotation::to_6d(self.turn(pose.rotation)))
    }

    /// World pose of a position and a 6D rotation in the frame. A degenerate 6D rotation becomes `fallback`, which is in the
    /// frame too.
    pub fn world_pose(&self, position: DVec3, rotation_6d: [f64; 6], fallback: DQuat) -> Pose {
        let world_from_frame = self.frame_from_world.conjugate();
        let turned = world_from_frame * rotation::from_6d(rotation_6d, fallback);
        Pose::new(world_from_frame * position * self.size + self.center, turned)
    }

    /// Half extents, in scene sizes, of the smallest box along the frame's axes that holds a box of the world.
    /// `half_extents` are along the axes of that box, in scene units.
    pub fn half_extents(&self, half_extents: DVec3, world_from_box: DQuat) -> DVec3 {
        let axes = DMat3::from_quat(self.turn(world_from_box));
        let absolute = DMat3::from_cols(axes.x_axis.abs(), axes.y_axis.abs(), axes.z_axis.abs());
        absolute * half_extents.abs() / self.size
    }
}

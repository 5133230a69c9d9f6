//! Rotations of cameras with OpenGL axes (x right, y up, z back) as quaternions, and worlds with +y up.

use glam::{DQuat, DVec3};

use super::format::Format;
use cinesplat_geometry::Pose;

/// Half a turn about x: OpenCV camera axes from OpenGL ones; its own inverse up to the sign.
pub(super) const HALF_TURN_X: DQuat = DQuat::from_xyzw(1.0, 0.0, 0.0, 0.0);

/// The rotation of `world_from_camera` with OpenGL camera axes.
pub(super) fn opengl_rotation(pose: &Pose) -> DQuat {
    pose.rotation * HALF_TURN_X
}

/// The pose of a camera with OpenGL axes.
pub(super) fn from_opengl_rotation(position: DVec3, rotation: DQuat) -> Pose {
    Pose::new(position, rotation * HALF_TURN_X.conjugate())
}

/// The smallest rotation that takes the world's `up` to +y; the identity if up is unknown.
pub(super) fn y_up_from_world(up: Option<DVec3>) -> DQuat {
    up.map_or(DQuat::IDENTITY, |up| DQuat::from_rotation_arc(up.normalize(), DVec3::Y))
}

/// The warning of a format whose world has +y up, if the scene's up is unknown.
pub(super) fn unknown_up(format: Format, up: Option<DVec3>) -> Option<String> {
    let what = "takes +y as up: the scene's up is not known, positions are written unchanged";
    up.is_none().then(|| format!("{format} {what}"))
}

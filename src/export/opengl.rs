//! Rotations of cameras with OpenGL axes (x right, y up, z back) as quaternions, and worlds with +y up.

use glam::{DQuat, DVec3};

use cinesplat_geometry::Pose;

/// Half a turn about x: OpenCV camera axes from OpenGL ones, and back.
const HALF_TURN_X: DQuat = DQuat::from_xyzw(1.0, 0.0, 0.0, 0.0);

/// The rotation of `world_from_camera` with OpenGL camera axes.
pub(super) fn opengl_rotation(pose: &Pose) -> DQuat {
    pose.rotation * HALF_TURN_X
}

/// The pose of a camera with OpenGL axes.
pub(super) fn from_opengl_rotation(position: DVec3, rotation: DQuat) -> Pose {
    Pose::new(position, rotation * HALF_TURN_X.conjugate())
}

/// The rotation that takes the world's `up` to +y by the shortest way; none without an up.
pub(super) fn y_up_from_world(up: Option<DVec3>) -> DQuat {
    up.map_or(DQuat::IDENTITY, |up| DQuat::from_rotation_arc(up.normalize(), DVec3::Y))
}

/// The note for formats whose world has +y up, where the scene's up is not known.
pub(super) fn unknown_up(format: &str, up: Option<DVec3>) -> Option<String> {
    let what = "takes +y as up: the scene's up is not known, positions are written as they stand";
    up.is_none().then(|| format!("{format} {what}"))
}

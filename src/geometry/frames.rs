//! Camera-axis conventions of other programs. Only this file and the crate `export` flip the signs of axes.

use glam::{DMat3, DMat4, DQuat, DVec3};

use super::{GeometryError, Pose};

/// OpenGL camera axes (x right, y up, z back) from OpenCV ones (x right, y down, z forward); its own inverse.
const OPENGL_FROM_OPENCV: DMat3 = DMat3::from_cols(DVec3::X, DVec3::NEG_Y, DVec3::NEG_Z);

/// `world_from_camera` with OpenGL camera axes, as in nerfstudio, Blender, glTF and USD.
pub fn to_opengl(pose: &Pose) -> DMat4 {
    pose.world_from_camera() * DMat4::from_mat3(OPENGL_FROM_OPENCV)
}

/// The pose of a `world_from_camera` matrix with OpenGL camera axes.
///
/// # Errors
/// [`GeometryError::NotARotation`] if the matrix is not a rigid transform.
pub fn from_opengl(world_from_camera_opengl: DMat4) -> Result<Pose, GeometryError> {
    Pose::from_matrix(world_from_camera_opengl * DMat4::from_mat3(OPENGL_FROM_OPENCV))
}

/// The smallest rotation that takes the direction `up` to +z, for programs with a z-up world.
pub fn z_up_from_world(up: DVec3) -> DQuat {
    DQuat::from_rotation_arc(up.normalize(), DVec3::Z)
}

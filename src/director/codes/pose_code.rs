//! A camera as the numbers of the pose decoder.

/// Number of values of a [`PoseCode`].
pub const POSE_WIDTH: usize = 11;

/// Field of view of `log_fov` 0.
const BASE_FOV_RAD: f64 = 50.0 * std::f64::consts::PI / 180.0;

/// A camera in the frame of a [`SceneFrame`](crate::SceneFrame), as the pose decoder outputs it.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PoseCode {
    /// Camera center, in scene sizes.
    pub position: [f32; 3],
    /// First two columns of the rotation `frame_from_camera`.
    pub rotation_6d: [f32; 6],
    /// Natural logarithm of the vertical field of view over 50 degrees.
    pub log_fov: f32,
    /// Natural logarithm of 1 + the seconds since the key before.
    pub log_wait: f32,
}

impl PoseCode {
    /// All values, in the order of the fields.
    pub fn to_array(self) -> [f32; POSE_WIDTH] {
        let mut out = [0.0; POSE_WIDTH];
        out[..3].copy_from_slice(&self.position);
        out[3..9].copy_from_slice(&self.rotation_6d);
        out[9] = self.log_fov;
        out[10] = self.log_wait;
        out
    }
}

/// Vertical field of view of its code, clamped to 0.05..=2.5 rad.
pub(crate) fn fov_y_rad(log_fov: f32) -> f64 {
    (BASE_FOV_RAD * f64::from(log_fov).exp()).clamp(0.05, 2.5)
}

/// Code of a vertical field of view.
pub fn log_fov(fov_y_rad: f64) -> f32 {
    (fov_y_rad / BASE_FOV_RAD).ln() as f32
}

/// Earlier poses as input of the pose decoder: per key 1 and the pose of the key before, or zeros where there is none.
/// `num_keys * (POSE_WIDTH + 1)` values, key after key. `poses` may be shorter than `num_keys`.
pub fn previous_poses(poses: &[PoseCode], num_keys: usize) -> Vec<f32> {
    let mut out = vec![0.0; num_keys * (POSE_WIDTH + 1)];
    for (pose, row) in poses.iter().zip(out.chunks_exact_mut(POSE_WIDTH + 1).skip(1)) {
        row[0] = 1.0;
        row[1..].copy_from_slice(&pose.to_array());
    }
    out
}

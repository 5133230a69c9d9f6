use cinesplat_geometry::{Camera, Intrinsics};
use cinesplat_trajectory::{CameraPath, Shot};

/// The camera of one frame, counted from 0, without the motion that effects add.
pub fn camera_at(path: &CameraPath, shot: &Shot, frame_idx: usize) -> Camera {
    path_camera(path, shot, shot.frame_time_secs(frame_idx))
}

/// The camera of the path at a time.
pub(super) fn path_camera(path: &CameraPath, shot: &Shot, time_secs: f64) -> Camera {
    let state = path.sample(time_secs);
    Camera { pose: state.pose, intrinsics: Intrinsics::from_fov_y(shot.width, shot.height, state.fov_y_rad) }
}

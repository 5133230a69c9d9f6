use std::ops::Range;

use cinesplat_geometry::{Camera, Intrinsics};
use cinesplat_trajectory::{CameraPath, Shot};

/// The camera of one frame, counted from 0.
pub fn camera_at(path: &CameraPath, shot: &Shot, frame_idx: usize) -> Camera {
    let state = path.sample(shot.frame_time_secs(frame_idx));
    Camera { pose: state.pose, intrinsics: Intrinsics::from_fov_y(shot.width, shot.height, state.fov_y_rad) }
}

/// Cameras of the frames that a film renders. Frames with the camera of the frame before are not rendered again.
pub(in crate::pipeline) fn moving_cameras(path: &CameraPath, shot: &Shot, frames: Range<usize>) -> Vec<Camera> {
    let mut cameras: Vec<Camera> = frames.map(|frame_idx| camera_at(path, shot, frame_idx)).collect();
    cameras.dedup();
    cameras
}

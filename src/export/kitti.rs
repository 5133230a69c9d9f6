//! KITTI odometry poses: per line the 12 numbers of a 3 x 4 `world_from_camera` matrix in row-major order, with OpenCV
//! camera axes and no times.

use super::ExportError;
use super::columns::{bad_line, data_lines, joined, numbers};
use super::json_read::matrix_from_rows;
use super::track::{DEFAULT_FPS, PoseFrame, PoseTrack};
use cinesplat_geometry::Pose;

pub(super) fn write(track: &PoseTrack) -> String {
    let mut out = String::new();
    for frame in &track.frames {
        let rows = frame.pose.world_from_camera().transpose().to_cols_array();
        out.push_str(&joined(rows.into_iter().take(12), " "));
        out.push('\n');
    }
    out
}

pub(super) fn read(text: &str) -> Result<PoseTrack, ExportError> {
    let mut frames = Vec::new();
    for (line, text) in data_lines(text) {
        let rows = numbers::<12>(line, text)?;
        frames.push(matrix_frame(frames.len(), &rows).map_err(|reason| bad_line(line, text, reason))?);
    }
    Ok(PoseTrack::untimed(frames))
}

/// Frame `frame_idx` from a row-major matrix; the error is the expectation that the numbers fail.
pub(super) fn matrix_frame(frame_idx: usize, rows: &[f64]) -> Result<PoseFrame, String> {
    let matrix = matrix_from_rows(rows).ok_or("a 3 x 4 or 4 x 4 matrix")?;
    let pose = Pose::from_matrix(matrix).map_err(|error| format!("a rigid pose ({error})"))?;
    let time_secs = frame_idx as f64 / DEFAULT_FPS;
    Ok(PoseFrame { matrix: Some(glam::DMat3::from_mat4(matrix)), ..PoseFrame::new(time_secs, pose) })
}

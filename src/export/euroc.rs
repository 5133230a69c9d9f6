//! EuRoC MAV ground truth: CSV lines of `nanoseconds, px, py, pz, qw, qx, qy, qz, ..`. Further columns (velocities and
//! biases) are not read, which a note says. Columns may also be separated by white space. Poses are written as `world_from_camera` with OpenCV camera axes. Files of the data set itself
//! hold poses of the IMU body, which are read unchanged.

use std::fmt::Write as _;

use super::columns::joined;
use super::line_layout::LineLayout;
use super::pose_lines::NANOS;
use super::track::PoseTrack;
use super::{ExportError, pose_lines};

const HEADER: &str = "#timestamp [ns],p_RS_R_x [m],p_RS_R_y [m],p_RS_R_z [m],q_RS_w [],q_RS_x [],q_RS_y [],q_RS_z []\n";

pub(super) fn write(track: &PoseTrack) -> String {
    let mut out = HEADER.to_owned();
    for frame in &track.frames {
        let [x, y, z, w] = frame.pose.rotation.to_array();
        let pose = frame.pose.position.to_array().into_iter().chain([w, x, y, z]);
        let _ = writeln!(out, "{},{}", (frame.time_secs * NANOS).round() as i64, joined(pose, ","));
    }
    out
}

pub(super) fn read(text: &str) -> Result<PoseTrack, ExportError> {
    pose_lines::read_as(text, LineLayout::EUROC)
}

//! EuRoC MAV ground truth: CSV lines of `nanoseconds, px, py, pz, qw, qx, qy, qz, ..`. Further columns (velocities and
//! biases) are ignored. Poses are written as `world_from_camera` with OpenCV camera axes. Files of the data set itself
//! hold poses of the IMU body, which are read unchanged.

use std::fmt::Write as _;

use glam::{DQuat, DVec3};

use super::ExportError;
use super::columns::{bad_line, data_lines, joined, number};
use super::track::{PoseFrame, PoseTrack};
use super::tum::unit_pose;

const HEADER: &str = "#timestamp [ns],p_RS_R_x [m],p_RS_R_y [m],p_RS_R_z [m],q_RS_w [],q_RS_x [],q_RS_y [],q_RS_z []\n";
const NANOS: f64 = 1e9;

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
    let mut frames = Vec::new();
    for (line, text) in data_lines(text) {
        let columns: Vec<&str> = text.split(',').collect();
        if columns.len() < 8 {
            return Err(bad_line(line, text, format!("at least 8 columns, not {}", columns.len())));
        }
        let mut v = [0.0; 8];
        for (value, column) in v.iter_mut().zip(columns) {
            *value = number(line, column)?;
        }
        let pose = unit_pose(DVec3::new(v[1], v[2], v[3]), DQuat::from_xyzw(v[5], v[6], v[7], v[4]));
        frames.push(PoseFrame::new(v[0] / NANOS, pose.ok_or_else(|| bad_line(line, text, "a unit quaternion"))?));
    }
    Ok(PoseTrack { timed: true, ..PoseTrack::untimed(frames) })
}

//! TUM RGB-D trajectories: lines of `time tx ty tz qx qy qz qw`, `world_from_camera` with OpenCV camera axes, seconds
//! on any clock. Reference: the file formats of the TUM RGB-D benchmark, read as strictly as evo does (8 columns, `#`
//! comments).

use glam::{DQuat, DVec3};

use super::ExportError;
use super::columns::{bad_line, data_lines, joined, numbers};
use super::track::{PoseFrame, PoseTrack};
use cinesplat_geometry::Pose;

/// Largest deviation of a quaternion's length from 1. Above it, the columns are likely something else.
const UNIT_TOLERANCE: f64 = 0.05;

pub(super) fn write(track: &PoseTrack) -> String {
    let mut out = String::from("# timestamp tx ty tz qx qy qz qw\n");
    for frame in &track.frames {
        let pose = frame.pose.position.to_array().into_iter().chain(frame.pose.rotation.to_array());
        out.push_str(&joined(std::iter::once(frame.time_secs).chain(pose), " "));
        out.push('\n');
    }
    out
}

pub(super) fn read(text: &str) -> Result<PoseTrack, ExportError> {
    let mut frames = Vec::new();
    for (line, text) in data_lines(text) {
        let [time_secs, x, y, z, qx, qy, qz, qw] = numbers::<8>(line, text)?;
        let pose = unit_pose(DVec3::new(x, y, z), DQuat::from_xyzw(qx, qy, qz, qw));
        frames.push(PoseFrame::new(time_secs, pose.ok_or_else(|| bad_line(line, text, "a unit quaternion"))?));
    }
    Ok(PoseTrack { timed: true, ..PoseTrack::untimed(frames) })
}

/// A pose from a position and a rounded quaternion; `None` for a quaternion that is not of unit length.
pub(super) fn unit_pose(position: DVec3, rotation: DQuat) -> Option<Pose> {
    let length = rotation.length();
    // A quaternion written with all digits keeps its bits.
    let unit = if (length - 1.0).abs() > 1e-12 { rotation.normalize() } else { rotation };
    ((length - 1.0).abs() < UNIT_TOLERANCE).then_some(Pose { position, rotation: unit })
}

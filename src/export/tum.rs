//! TUM RGB-D trajectories: `time tx ty tz qx qy qz qw` a line, `world_from_camera`, OpenCV camera axes, seconds on any
//! clock. Reference: the TUM RGB-D benchmark's file formats; strict as evo reads them (8 columns, `#` comments).

use glam::{DQuat, DVec3};

use super::ExportError;
use super::columns::{bad_line, data_lines, joined, numbers};
use super::track::{PoseFrame, PoseTrack};
use cinesplat_geometry::Pose;

/// Rotations whose quaternion is off unit length by more are refused: they are likely other columns.
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

/// A pose from numbers of a text file, whose quaternion may be rounded.
pub(super) fn unit_pose(position: DVec3, rotation: DQuat) -> Option<Pose> {
    let length = rotation.length();
    // A quaternion that was written with all digits keeps its bits.
    let unit = if (length - 1.0).abs() > 1e-12 { rotation.normalize() } else { rotation };
    ((length - 1.0).abs() < UNIT_TOLERANCE).then_some(Pose { position, rotation: unit })
}

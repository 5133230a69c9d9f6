//! TUM RGB-D trajectories: lines of `time tx ty tz qx qy qz qw`, `world_from_camera` with OpenCV camera axes, seconds
//! on any clock. Reference: the file formats of the TUM RGB-D benchmark, read with 8 columns and `#` comments.
//! Columns may also be separated by commas; further columns are not read, which a note says.

use super::columns::joined;
use super::line_layout::LineLayout;
use super::track::PoseTrack;
use super::{ExportError, pose_lines};

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
    pose_lines::read_as(text, LineLayout::TUM)
}

//! Lines of a time, a position and a quaternion, in any layout.

use glam::{DQuat, DVec3};

use super::ExportError;
use super::columns::{bad_line, cells, data_lines, is_names, number};
use super::line_layout::{ColumnCount, LineLayout, POSE_COLUMNS, QuaternionOrder, StampUnit, UNIT_TOLERANCE};
use super::track::{PoseFrame, PoseTrack};
use cinesplat_geometry::Pose;

/// Nanoseconds per second.
pub(super) const NANOS: f64 = 1e9;

/// The poses of a text. A first line of names is skipped.
///
/// # Errors
/// [`ExportError::BadLine`] for a line with too few or too many columns, or without a unit quaternion.
pub(super) fn read(text: &str, layout: LineLayout) -> Result<PoseTrack, ExportError> {
    let mut frames = Vec::new();
    let mut num_unread = 0;
    for (line, text) in data_lines(text) {
        if frames.is_empty() && is_names(text) {
            continue;
        }
        let columns = cells(text);
        let expected = match layout.columns {
            ColumnCount::Exact if columns.len() != POSE_COLUMNS => Some("8 columns"),
            ColumnCount::AtLeast if columns.len() < POSE_COLUMNS => Some("at least 8 columns"),
            _ => None,
        };
        if let Some(expected) = expected {
            return Err(bad_line(line, text, format!("{expected}, not {}", columns.len())));
        }
        num_unread = num_unread.max(columns.len() - POSE_COLUMNS);
        let mut v = [0.0; POSE_COLUMNS];
        for (value, column) in v.iter_mut().zip(columns) {
            *value = number(line, column)?;
        }
        let rotation = match layout.order {
            QuaternionOrder::Xyzw => DQuat::from_xyzw(v[4], v[5], v[6], v[7]),
            QuaternionOrder::Wxyz => DQuat::from_xyzw(v[5], v[6], v[7], v[4]),
        };
        let time_secs = match layout.unit {
            StampUnit::Seconds => v[0],
            StampUnit::Nanoseconds => v[0] / NANOS,
        };
        let pose = unit_pose(DVec3::new(v[1], v[2], v[3]), rotation);
        frames.push(PoseFrame::new(time_secs, pose.ok_or_else(|| bad_line(line, text, "a unit quaternion"))?));
    }
    let unread = format!("{num_unread} columns behind the quaternion are not read");
    let unread = if num_unread > 0 { vec![unread] } else { Vec::new() };
    Ok(PoseTrack { timed: true, unread, ..PoseTrack::untimed(frames) })
}

/// A pose from a position and a rounded quaternion; `None` for a quaternion that is not of unit length.
pub(super) fn unit_pose(position: DVec3, rotation: DQuat) -> Option<Pose> {
    let length = rotation.length();
    // A quaternion written with all digits keeps its bits.
    let unit = if (length - 1.0).abs() > 1e-12 { rotation.normalize() } else { rotation };
    ((length - 1.0).abs() < UNIT_TOLERANCE).then_some(Pose { position, rotation: unit })
}

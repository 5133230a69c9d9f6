//! Lines of a time, a position and a quaternion, in any layout.

use glam::{DQuat, DVec3};

use super::ExportError;
use super::columns::{bad_line, cells, data_lines, is_names, number};
use super::line_layout::{LineLayout, POSE_COLUMNS, QuaternionOrder, UNIT_TOLERANCE};
use super::stamp_unit::UnitEvidence;
use super::track::{PoseFrame, PoseTrack};
use cinesplat_geometry::Pose;

/// Columns behind the quaternion in the ground truth of EuRoC: velocity and two biases. Its world has +z up.
const EUROC_STATE_COLUMNS: usize = 9;
/// Nanoseconds per second.
pub(super) const NANOS: f64 = 1e9;
/// Two stamps in a row of at least this size, and this ratio or more, are in different units.
const MIXED_UNITS: (f64, f64) = (1e8, 900.0);

/// The poses of a text in a format that is named. The stamps show the unit of the times where they can.
///
/// # Errors
/// As [`read`].
pub(super) fn read_as(text: &str, format: LineLayout) -> Result<PoseTrack, ExportError> {
    let layout = format.with_unit_of(text);
    let mut track = read(text, layout)?;
    if layout.unit != format.unit {
        track.unread.push(format!("the times are read as {}: as {} they make no path", layout.unit, format.unit));
    }
    Ok(track)
}

/// The poses of a text. A first line of names is skipped.
///
/// # Errors
/// [`ExportError::BadLine`] for a line with fewer than eight columns or other columns than the first one, without a unit
/// quaternion, and with a time in another unit than the line before.
pub(super) fn read(whole: &str, layout: LineLayout) -> Result<PoseTrack, ExportError> {
    let mut frames: Vec<PoseFrame> = Vec::new();
    let (mut num_columns, mut stamp_before) = (None, 0.0_f64);
    for (line, text) in data_lines(whole) {
        if frames.is_empty() && is_names(text) {
            continue;
        }
        let columns = cells(text);
        let expected = *num_columns.get_or_insert(columns.len().max(POSE_COLUMNS));
        if columns.len() != expected {
            return Err(bad_line(line, text, format!("{expected} columns, not {}", columns.len())));
        }
        let mut v = [0.0; POSE_COLUMNS];
        for (value, column) in v.iter_mut().zip(columns) {
            *value = number(line, column)?;
        }
        let rotation = match layout.order {
            QuaternionOrder::Xyzw => DQuat::from_xyzw(v[4], v[5], v[6], v[7]),
            QuaternionOrder::Wxyz => DQuat::from_xyzw(v[5], v[6], v[7], v[4]),
        };
        if are_mixed(stamp_before, v[0]) {
            return Err(bad_line(line, text, "a time in the unit of the line before"));
        }
        stamp_before = v[0];
        let time_secs = v[0] / layout.unit.per_sec();
        let pose = unit_pose(DVec3::new(v[1], v[2], v[3]), rotation);
        frames.push(PoseFrame::new(time_secs, pose.ok_or_else(|| bad_line(line, text, "a unit quaternion"))?));
    }
    let num_unread = num_columns.unwrap_or(POSE_COLUMNS) - POSE_COLUMNS;
    let unread = match num_unread {
        0 => Vec::new(),
        1 => vec!["1 column behind the quaternion is not read".to_owned()],
        _ => vec![format!("{num_unread} columns behind the quaternion are not read")],
    };
    let unread = unread.into_iter().chain(UnitEvidence::of(whole).doubt(layout.unit)).collect();
    let is_euroc_state = num_unread == EUROC_STATE_COLUMNS
        && (layout.unit, layout.order) == (LineLayout::EUROC.unit, LineLayout::EUROC.order);
    let up = is_euroc_state.then_some(DVec3::Z);
    Ok(PoseTrack { timed: true, up, unread, ..PoseTrack::untimed(frames) })
}

/// Whether two stamps in a row are in different units.
fn are_mixed(before: f64, stamp: f64) -> bool {
    let (low, high) = (before.abs().min(stamp.abs()), before.abs().max(stamp.abs()));
    low >= MIXED_UNITS.0 && high >= MIXED_UNITS.1 * low
}

/// A pose from a position and a rounded quaternion; `None` for a quaternion that is not of unit length.
pub(super) fn unit_pose(position: DVec3, rotation: DQuat) -> Option<Pose> {
    let length = rotation.length();
    // A quaternion written with all digits keeps its bits.
    let unit = if (length - 1.0).abs() > 1e-12 { rotation.normalize() } else { rotation };
    ((length - 1.0).abs() < UNIT_TOLERANCE).then_some(Pose { position, rotation: unit })
}

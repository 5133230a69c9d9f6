//! A table for spreadsheets: a line of column names, then one line per frame. Poses are `world_from_camera` with OpenCV
//! camera axes. `yaw_deg`, `pitch_deg` and `roll_deg` (as `euler_deg` of `shot.json`) are written for people and not
//! read back; they are empty if the world's up is unknown.

use std::fmt::Write as _;

use glam::{DQuat, DVec3};

use super::ExportError;
use super::columns::{bad_line, cells, data_lines, joined, number};
use super::json_read::quoted;
use super::pose_lines::unit_pose;
use super::shot_json::level_angles;
use super::track::{PoseFrame, PoseTrack};
use cinesplat_geometry::LevelFrame;
use cinesplat_trajectory::Easing;

const COLUMNS: &str = "time_secs,x,y,z,qx,qy,qz,qw,yaw_deg,pitch_deg,roll_deg,fov_y_deg,focus_distance,easing,cut\n";

pub(super) fn write(track: &PoseTrack) -> String {
    let level = track.up.and_then(|up| LevelFrame::new(up).ok());
    let angles = level.map(|level| level_angles(&level, track.frames.iter().map(|frame| frame.pose.rotation)));
    let mut out = COLUMNS.to_owned();
    for (idx, frame) in track.frames.iter().enumerate() {
        let pose = frame.pose.position.to_array().into_iter().chain(frame.pose.rotation.to_array());
        let euler = angles.as_ref().and_then(|angles| angles.get(idx)).map_or_else(
            || ",,".to_owned(),
            |a| joined([a.yaw_rad, a.pitch_rad, a.roll_rad].map(f64::to_degrees), ","),
        );
        let fov = frame.fov_y_rad.map(|rad| rad.to_degrees().to_string()).unwrap_or_default();
        let focus = frame.focus_distance.map(|d| d.to_string()).unwrap_or_default();
        let (time_secs, pose, easing) = (frame.time_secs, joined(pose, ","), frame.easing.as_ref());
        let _ = writeln!(out, "{time_secs},{pose},{euler},{fov},{focus},{easing},{}", u8::from(frame.cut));
    }
    out
}

/// Columns that may be missing, and columns that repeat the quaternion for people.
const OPTIONAL: [&str; 4] = ["fov_y_deg", "focus_distance", "easing", "cut"];
const ANGLES: [&str; 3] = ["yaw_deg", "pitch_deg", "roll_deg"];

pub(super) fn read(text: &str) -> Result<PoseTrack, ExportError> {
    let mut lines = data_lines(text);
    let Some((first, header)) = lines.next() else { return Err(ExportError::NoPoses) };
    let names = cells(header);
    let column = |name: &str| names.iter().position(|found| *found == name);
    let required = ["time_secs", "x", "y", "z", "qx", "qy", "qz", "qw"];
    let mut idx_of = [0; 8];
    for (idx, name) in idx_of.iter_mut().zip(required) {
        *idx = column(name).ok_or_else(|| bad_line(first, header, format!("a column {name}")))?;
    }
    let optional = OPTIONAL.map(column);
    let is_unknown = |name: &&&str| !required.contains(*name) && !OPTIONAL.contains(*name) && !ANGLES.contains(*name);
    let unknown: Vec<String> = names.iter().filter(is_unknown).map(|name| quoted(name)).collect();
    let unread = (!unknown.is_empty()).then(|| format!("columns that are not read: {}", unknown.join(", ")));
    let frames = lines.map(|(line, text)| read_row(line, text, &idx_of, optional)).collect::<Result<Vec<_>, _>>()?;
    Ok(PoseTrack { timed: true, unread: unread.into_iter().collect(), ..PoseTrack::untimed(frames) })
}

fn read_row(
    line: usize,
    text: &str,
    idx_of: &[usize; 8],
    [fov, focus, easing, cut]: [Option<usize>; 4],
) -> Result<PoseFrame, ExportError> {
    let cells = cells(text);
    let cell = |idx: Option<usize>| idx.and_then(|idx| cells.get(idx).copied()).filter(|cell| !cell.is_empty());
    let mut v = [0.0; 8];
    for (value, idx) in v.iter_mut().zip(idx_of) {
        *value =
            number(line, cell(Some(*idx)).ok_or_else(|| bad_line(line, text, "as many cells as the first line"))?)?;
    }
    let pose = unit_pose(DVec3::new(v[1], v[2], v[3]), DQuat::from_xyzw(v[4], v[5], v[6], v[7]));
    let easing = cell(easing).map(|name| name.parse::<Easing>().map_err(|_| bad_line(line, name, "an easing")));
    Ok(PoseFrame {
        fov_y_rad: cell(fov).map(|cell| number(line, cell)).transpose()?.map(f64::to_radians),
        focus_distance: cell(focus).map(|cell| number(line, cell)).transpose()?,
        easing: easing.transpose()?.unwrap_or(Easing::Linear),
        cut: cell(cut).map(|cell| flag(line, cell)).transpose()?.unwrap_or(false),
        ..PoseFrame::new(v[0], pose.ok_or_else(|| bad_line(line, text, "a unit quaternion"))?)
    })
}

/// A truth value, as people and spreadsheets write it.
fn flag(line: usize, cell: &str) -> Result<bool, ExportError> {
    match cell.to_ascii_lowercase().as_str() {
        "1" | "true" => Ok(true),
        "0" | "false" => Ok(false),
        _ => Err(bad_line(line, cell, "1, 0, true or false")),
    }
}

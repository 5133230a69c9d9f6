//! Closed-loop trajectories of Project Aria: a CSV with a line of names. Read are `tracking_timestamp_us`, `t[xyz]_world_device`,
//! `q[xyzw]_world_device` and, for the world's up, `gravity_[xyz]_world`. The poses are those of the device, whose axes are the
//! left tracking camera's; they are read unchanged, which a line says.

use glam::{DQuat, DVec3};

use super::ExportError;
use super::columns::{bad_line, cells, data_lines, number};
use super::pose_lines::unit_pose;
use super::track::{PoseFrame, PoseTrack};

/// The column that tells the format.
pub(super) const TIME: &str = "tracking_timestamp_us";
const MICROS: f64 = 1e6;
const POSE: [&str; 8] = [
    TIME,
    "tx_world_device",
    "ty_world_device",
    "tz_world_device",
    "qx_world_device",
    "qy_world_device",
    "qz_world_device",
    "qw_world_device",
];
const GRAVITY: [&str; 3] = ["gravity_x_world", "gravity_y_world", "gravity_z_world"];

pub(super) fn read(text: &str) -> Result<PoseTrack, ExportError> {
    let mut lines = data_lines(text);
    let Some((first, header)) = lines.next() else { return Err(ExportError::NoPoses) };
    let names = cells(header);
    let column = |name: &str| names.iter().position(|found| *found == name);
    let mut columns = [0; POSE.len()];
    for (slot, name) in columns.iter_mut().zip(POSE) {
        *slot = column(name).ok_or_else(|| bad_line(first, header, format!("a column {name}")))?;
    }
    let gravity = GRAVITY.map(column);
    let (mut frames, mut up) = (Vec::new(), None);
    for (line, text) in lines {
        let cells = cells(text);
        let cell = |idx: usize| {
            let cell = cells.get(idx).ok_or_else(|| bad_line(line, text, "as many cells as the first line"))?;
            number(line, cell)
        };
        let mut v = [0.0; POSE.len()];
        for (value, idx) in v.iter_mut().zip(columns) {
            *value = cell(idx)?;
        }
        if let ([Some(x), Some(y), Some(z)], None) = (gravity, up) {
            up = (-DVec3::new(cell(x)?, cell(y)?, cell(z)?)).try_normalize();
        }
        let pose = unit_pose(DVec3::new(v[1], v[2], v[3]), DQuat::from_xyzw(v[4], v[5], v[6], v[7]));
        let pose = pose.ok_or_else(|| bad_line(line, text, "a unit quaternion"))?;
        frames.push(PoseFrame::new(v[0] / MICROS, pose));
    }
    let unread = vec!["the poses are those of the device, not of one of its cameras".to_owned()];
    Ok(PoseTrack { up, timed: true, unread, ..PoseTrack::untimed(frames) })
}

//! Poses as a table: time, x, y, z, roll, pitch, yaw, field of view.

use std::fmt::Write as _;

use glam::{DQuat, DVec3};

use super::Trajectory;
use cinesplat_export::json_write::{Json, object};
use cinesplat_geometry::LevelFrame;

/// One pose of a table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TableRow {
    /// Time; the index of the pose if the path has no times.
    pub time_secs: f64,
    /// Camera center, world.
    pub position: DVec3,
    /// Positive clockwise as the operator sees it, degrees.
    pub roll_deg: f64,
    /// Positive above the horizon, degrees.
    pub pitch_deg: f64,
    /// Relative to the first pose, positive to the right, degrees; continuous beyond half a turn.
    pub yaw_deg: f64,
    /// Vertical field of view, degrees; `None` if unknown.
    pub fov_y_deg: Option<f64>,
}

/// One row per pose. Angles are relative to the world's up (the file's, else the mean up of the cameras) and continuous
/// from row to row.
pub fn keyframe_table(path: &Trajectory) -> Vec<TableRow> {
    let level = LevelFrame::new(path.up_or_mean()).ok();
    rows(path, level, None)
}

/// As [`keyframe_table`], with the up and the yaw 0 of another path, so that both tables can be compared.
pub(super) fn table_relative_to(path: &Trajectory, other: &Trajectory) -> Vec<TableRow> {
    let level = LevelFrame::new(other.up_or_mean()).ok();
    let start = level
        .zip(other.rotations.first())
        .map(|(level, first)| level.angles(DQuat::from_mat3(first).normalize()).yaw_rad);
    rows(path, level, start)
}

fn rows(path: &Trajectory, level: Option<LevelFrame>, yaw_start_rad: Option<f64>) -> Vec<TableRow> {
    let Some(level) = level else { return Vec::new() };
    let times = path.times_or_indices();
    let mut rows: Vec<TableRow> = Vec::with_capacity(path.len());
    let mut start_rad = yaw_start_rad;
    for (idx, rotation) in path.rotations.iter().enumerate() {
        let angles = level.angles(DQuat::from_mat3(rotation).normalize());
        let start = *start_rad.get_or_insert(angles.yaw_rad);
        let before = rows.last();
        // The equivalent angle nearest to that of the previous row, or to 0.
        let near =
            |degrees: f64, last: Option<f64>| degrees - 360.0 * ((degrees - last.unwrap_or(0.0)) / 360.0).round();
        rows.push(TableRow {
            time_secs: times.get(idx).copied().unwrap_or(idx as f64),
            position: path.positions[idx],
            roll_deg: near(angles.roll_rad.to_degrees(), before.map(|row| row.roll_deg)),
            pitch_deg: angles.pitch_rad.to_degrees(),
            yaw_deg: near((angles.yaw_rad - start).to_degrees(), before.map(|row| row.yaw_deg)),
            fov_y_deg: path.fov_y_rad.get(idx).copied().flatten().map(f64::to_degrees),
        });
    }
    rows
}

/// The table as aligned text: a line of names, then one line per row.
pub fn table_text(rows: &[TableRow]) -> String {
    let names = ["time s", "x", "y", "z", "roll deg", "pitch deg", "yaw deg", "fov deg"];
    let mut out = names.map(|name| format!("{name:>10}")).join(" ");
    for row in rows {
        let [x, y, z] = row.position.to_array();
        let numbers = [row.time_secs, x, y, z, row.roll_deg, row.pitch_deg, row.yaw_deg];
        // Adding 0 turns a rounded -0 into 0.
        let cells = numbers.map(|value| format!("{:>10.3}", (value * 1e3).round() / 1e3 + 0.0)).join(" ");
        let fov = row.fov_y_deg.map_or_else(|| "-".to_owned(), |fov| format!("{fov:.3}"));
        let _ = write!(out, "\n{cells} {fov:>10}");
    }
    out.push('\n');
    out
}

/// The table as JSON text: a list of objects.
pub fn table_json(rows: &[TableRow]) -> String {
    rows_json(rows).pretty()
}

/// The table as a JSON value: a list of objects.
pub(super) fn rows_json(rows: &[TableRow]) -> Json {
    let row = |row: &TableRow| {
        object([
            ("time_secs", row.time_secs.into()),
            ("position", row.position.into()),
            ("roll_deg", row.roll_deg.into()),
            ("pitch_deg", row.pitch_deg.into()),
            ("yaw_deg", row.yaw_deg.into()),
            ("fov_y_deg", row.fov_y_deg.into()),
        ])
    };
    Json::list(rows.iter().map(row))
}

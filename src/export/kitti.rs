//! KITTI odometry poses: per line the 12 numbers of a 3 x 4 `world_from_camera` matrix in row-major order, with OpenCV
//! camera axes, or the 16 of a 4 x 4 matrix. Times may stand before 12 numbers, in 13 columns, or in a file beside it, `times.txt` or `NAME_times.txt`, with
//! one per line, s.

use std::path::Path;

use cinesplat_files::Limits;

use super::ExportError;
use super::columns::{bad_line, cells, data_lines, joined, numbers};
use super::json_read::matrix_from_rows;
use super::line_layout::LineLayout;
use super::stamp_unit::{StampUnit, UnitEvidence};
use super::track::{DEFAULT_FPS, PoseFrame, PoseTrack};
use cinesplat_geometry::Pose;

/// Columns of a line with a time.
const TIMED_COLUMNS: usize = 13;
/// Columns of a line with a 4 x 4 matrix, and its last row.
const SQUARE_COLUMNS: usize = 16;
const LAST_ROW: [f64; 4] = [0.0, 0.0, 0.0, 1.0];
/// Largest deviation from [`LAST_ROW`], which sums in 32 bits leave.
const LAST_ROW_TOLERANCE: f64 = 1e-6;

pub(super) fn write(track: &PoseTrack) -> String {
    let mut out = String::new();
    for frame in &track.frames {
        let rows = frame.pose.world_from_camera().transpose().to_cols_array();
        out.push_str(&joined(rows.into_iter().take(12), " "));
        out.push('\n');
    }
    out
}

pub(super) fn read(whole: &str) -> Result<PoseTrack, ExportError> {
    let mut frames = Vec::new();
    let layout = LineLayout::TUM.with_unit_of(whole);
    let unit = layout.unit;
    let num_columns = data_lines(whole).next().map_or(0, |(_, line)| cells(line).len());
    let is_timed = num_columns == TIMED_COLUMNS;
    for (line, text) in data_lines(whole) {
        let (time_secs, rows) = if is_timed {
            let [time_secs, rows @ ..] = numbers::<TIMED_COLUMNS>(line, text)?;
            (Some(time_secs), rows)
        } else if num_columns == SQUARE_COLUMNS {
            let [rows @ .., a, b, c, d] = numbers::<SQUARE_COLUMNS>(line, text)?;
            if !is_last_row([a, b, c, d]) {
                return Err(bad_line(line, text, "a last row of 0 0 0 1"));
            }
            (None, rows)
        } else {
            (None, numbers::<12>(line, text)?)
        };
        let frame = matrix_frame(frames.len(), &rows).map_err(|reason| bad_line(line, text, reason))?;
        let time_secs = time_secs.map_or(frame.time_secs, |stamp| stamp / unit.per_sec());
        frames.push(PoseFrame { time_secs, ..frame });
    }
    let is_other_unit = is_timed && unit != StampUnit::Seconds;
    let unread = is_other_unit.then(|| format!("the times are read as {unit}: as seconds they make no path"));
    let doubt = if is_timed { UnitEvidence::of(whole).doubt(layout.unit) } else { None };
    Ok(PoseTrack { timed: is_timed, unread: unread.into_iter().chain(doubt).collect(), ..PoseTrack::untimed(frames) })
}

/// Whether four numbers are the last row of a 4 x 4 matrix of a pose, within rounding.
pub(super) fn is_last_row(row: [f64; 4]) -> bool {
    row.iter().zip(LAST_ROW).all(|(found, wanted)| (found - wanted).abs() <= LAST_ROW_TOLERANCE)
}

/// The track with the times of a file beside `path`, if there is one with as many times as poses.
pub(super) fn with_times_beside(mut track: PoseTrack, path: &Path) -> PoseTrack {
    let own = path.file_stem().map(|stem| format!("{}_times.txt", stem.to_string_lossy()));
    let names = own.into_iter().chain(["times.txt".to_owned()]).map(|name| path.with_file_name(name));
    let times_in = |file: &Path| {
        let text = String::from_utf8(cinesplat_files::read(file, Limits::DEFAULT.array_bytes).ok()?).ok()?;
        let times: Option<Vec<f64>> = data_lines(&text).map(|(_, line)| line.parse().ok()).collect();
        times.filter(|times| times.len() == track.frames.len() && times.iter().all(|time| time.is_finite()))
    };
    let found = if track.timed { None } else { names.into_iter().find_map(|file| Some((times_in(&file)?, file))) };
    if let Some((times, file)) = found {
        track.frames.iter_mut().zip(times).for_each(|(frame, time_secs)| frame.time_secs = time_secs);
        track.timed = true;
        let name = file.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
        track.unread.push(format!("the times are those of {name}"));
    }
    track
}

/// Frame `frame_idx` from a row-major matrix; the error is the expectation that the numbers fail.
pub(super) fn matrix_frame(frame_idx: usize, rows: &[f64]) -> Result<PoseFrame, String> {
    let matrix = matrix_from_rows(rows).ok_or("a 3 x 4 or 4 x 4 matrix")?;
    let pose = Pose::from_matrix(matrix).map_err(|error| format!("a rigid pose ({error})"))?;
    let time_secs = frame_idx as f64 / DEFAULT_FPS;
    Ok(PoseFrame { matrix: Some(glam::DMat3::from_mat4(matrix)), ..PoseFrame::new(time_secs, pose) })
}

//! KITTI odometry poses: per line the 12 numbers of a 3 x 4 `world_from_camera` matrix in row-major order, with OpenCV
//! camera axes. Times may stand before them, in 13 columns, or in a file beside it, `times.txt` or `NAME_times.txt`, with
//! one per line, s.

use std::path::Path;

use cinesplat_files::Limits;

use super::ExportError;
use super::columns::{bad_line, cells, data_lines, joined, numbers};
use super::json_read::matrix_from_rows;
use super::track::{DEFAULT_FPS, PoseFrame, PoseTrack};
use cinesplat_geometry::Pose;

/// Columns of a line with a time.
const TIMED_COLUMNS: usize = 13;

pub(super) fn write(track: &PoseTrack) -> String {
    let mut out = String::new();
    for frame in &track.frames {
        let rows = frame.pose.world_from_camera().transpose().to_cols_array();
        out.push_str(&joined(rows.into_iter().take(12), " "));
        out.push('\n');
    }
    out
}

pub(super) fn read(text: &str) -> Result<PoseTrack, ExportError> {
    let mut frames = Vec::new();
    let is_timed = data_lines(text).next().is_some_and(|(_, line)| cells(line).len() == TIMED_COLUMNS);
    for (line, text) in data_lines(text) {
        let (time_secs, rows) = if is_timed {
            let [time_secs, rows @ ..] = numbers::<TIMED_COLUMNS>(line, text)?;
            (Some(time_secs), rows)
        } else {
            (None, numbers::<12>(line, text)?)
        };
        let frame = matrix_frame(frames.len(), &rows).map_err(|reason| bad_line(line, text, reason))?;
        frames.push(PoseFrame { time_secs: time_secs.unwrap_or(frame.time_secs), ..frame });
    }
    Ok(PoseTrack { timed: is_timed, ..PoseTrack::untimed(frames) })
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

//! Sequences of the 7-Scenes data set and of tools that write the same: a folder with one file `NAME.pose.txt` per frame, each a
//! 4 x 4 matrix `world_from_camera` with OpenCV camera axes. Poses that tracking lost are not finite and are left out. The
//! frames follow the numbers in the names (`frame-000123`), so that a lost pose leaves a gap and later frames keep their
//! times.

use std::path::{Path, PathBuf};

use cinesplat_files::Limits;

use super::ExportError;
use super::columns::{bad_line, cells, data_lines};
use super::kitti::matrix_frame;
use super::track::{DEFAULT_FPS, PoseFrame, PoseTrack};

/// How the name of a pose file ends.
const ENDING: &str = ".pose.txt";

/// The pose files of a folder, in order of their numbers, then of their names.
pub(super) fn pose_files(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
    let is_pose = |path: &PathBuf| path.file_name().is_some_and(|name| name.to_string_lossy().ends_with(ENDING));
    let mut files: Vec<PathBuf> = entries.filter(is_pose).collect();
    files.sort_by_cached_key(|file| (number_of(file), file.clone()));
    files
}

/// The number of the frame: the last digits of the name; `None` without digits.
fn number_of(file: &Path) -> Option<u64> {
    let name = file.file_name()?.to_string_lossy().into_owned();
    let stem = name.strip_suffix(ENDING)?.trim_end_matches(|c: char| !c.is_ascii_digit());
    let before = stem.trim_end_matches(|c: char| c.is_ascii_digit());
    stem[before.len()..].parse().ok()
}

/// The numbers of all frames; `None` if a name has none, or two have the same.
fn numbers_of(files: &[PathBuf]) -> Option<Vec<u64>> {
    let numbers: Vec<u64> = files.iter().map(|file| number_of(file)).collect::<Option<_>>()?;
    numbers.windows(2).all(|pair| pair[0] < pair[1]).then_some(numbers)
}

pub(super) fn read(files: &[PathBuf]) -> Result<PoseTrack, ExportError> {
    let (mut frames, mut num_lost) = (Vec::new(), 0);
    let numbers = numbers_of(files);
    for (idx, file) in files.iter().enumerate() {
        let text =
            String::from_utf8_lossy(&cinesplat_files::read(file, Limits::DEFAULT.header_bytes as u64)?).into_owned();
        let rows = matrix(&text)?;
        if rows.iter().any(|value| !value.is_finite()) {
            num_lost += 1;
            continue;
        }
        let frame = matrix_frame(idx, &rows).map_err(|reason| bad_line(1, &text, reason))?;
        let number = numbers.as_ref().map_or(idx as u64, |numbers| numbers[idx]);
        frames.push(PoseFrame { time_secs: number as f64 / DEFAULT_FPS, ..frame });
    }
    let lost =
        format!("{num_lost} of {} poses are not finite and are left out: the others keep their times", files.len());
    let unread = if num_lost > 0 { vec![lost] } else { Vec::new() };
    Ok(PoseTrack { is_numbered: true, unread, ..PoseTrack::untimed(frames) })
}

/// The 16 numbers of a file, which may be infinite or NaN.
fn matrix(text: &str) -> Result<Vec<f64>, ExportError> {
    let mut rows = Vec::with_capacity(16);
    for (line, text) in data_lines(text) {
        for cell in cells(text) {
            rows.push(cell.parse::<f64>().map_err(|_| bad_line(line, text, "4 numbers"))?);
        }
    }
    if rows.len() == 16 { Ok(rows) } else { Err(bad_line(1, text, format!("16 numbers, not {}", rows.len()))) }
}

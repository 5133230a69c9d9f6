//! Sequences of the 7-Scenes data set and of tools that write the same: a folder with one file `NAME.pose.txt` per frame, each a
//! 4 x 4 matrix `world_from_camera` with OpenCV camera axes. Poses that tracking lost are not finite and are left out.

use std::path::{Path, PathBuf};

use super::ExportError;
use super::columns::{bad_line, cells, data_lines};
use super::kitti::matrix_frame;
use super::track::PoseTrack;

/// How the name of a pose file ends.
const ENDING: &str = ".pose.txt";
/// Most bytes of a pose file.
const MAX_POSE_BYTES: u64 = 1 << 16;

/// The pose files of a folder, in order of their names.
pub(super) fn pose_files(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
    let is_pose = |path: &PathBuf| path.file_name().is_some_and(|name| name.to_string_lossy().ends_with(ENDING));
    let mut files: Vec<PathBuf> = entries.filter(is_pose).collect();
    files.sort();
    files
}

pub(super) fn read(files: &[PathBuf]) -> Result<PoseTrack, ExportError> {
    let (mut frames, mut num_lost) = (Vec::new(), 0);
    for file in files {
        let text = String::from_utf8_lossy(&cinesplat_files::read(file, MAX_POSE_BYTES)?).into_owned();
        let rows = matrix(&text)?;
        if rows.iter().any(|value| !value.is_finite()) {
            num_lost += 1;
            continue;
        }
        frames.push(matrix_frame(frames.len(), &rows).map_err(|reason| bad_line(1, &text, reason))?);
    }
    let lost = format!("{num_lost} of {} poses are not finite and are left out", files.len());
    let unread = if num_lost > 0 { vec![lost] } else { Vec::new() };
    Ok(PoseTrack { unread, ..PoseTrack::untimed(frames) })
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

//! Trajectory logs of Redwood and Open3D: per frame a line of three integers, then the four rows of `world_from_camera`
//! with OpenCV camera axes; no times.

use std::fmt::Write as _;

use super::ExportError;
use super::columns::{bad_line, data_lines, joined, numbers};
use super::kitti::matrix_frame;
use super::track::PoseTrack;

pub(super) fn write(track: &PoseTrack) -> String {
    let mut out = String::new();
    for (idx, frame) in track.frames.iter().enumerate() {
        let _ = writeln!(out, "{idx} {idx} {}", idx + 1);
        let matrix = frame.pose.world_from_camera();
        for row in 0..4 {
            let _ = writeln!(out, "{}", joined(matrix.row(row).to_array(), " "));
        }
    }
    out
}

pub(super) fn read(text: &str) -> Result<PoseTrack, ExportError> {
    let mut frames = Vec::new();
    let mut lines = data_lines(text);
    while let Some((line, header)) = lines.next() {
        numbers::<3>(line, header)?;
        let mut rows = Vec::with_capacity(16);
        for _ in 0..4 {
            let (line, row) = lines.next().ok_or_else(|| bad_line(line, header, "four matrix rows after this line"))?;
            rows.extend(numbers::<4>(line, row)?);
        }
        frames.push(matrix_frame(frames.len(), &rows).map_err(|reason| bad_line(line, header, reason))?);
    }
    Ok(PoseTrack::untimed(frames))
}

//! Sequences of the 7-Scenes data set and of tools that write the same: a folder with one file `NAME.pose.txt` per frame, each a
//! 4 x 4 matrix `world_from_camera` with OpenCV camera axes. Poses that tracking lost are not finite and are left out. The
//! frames follow the numbers in the names (`frame-000123`), so that a lost pose leaves a gap and later frames keep their
//! times. Of several sequences in one folder (`seq-01-frame-000123`) one follows the other, and the poses are counted.

use std::path::{Path, PathBuf};

use cinesplat_files::Limits;

use super::ExportError;
use super::columns::{bad_line, cells, data_lines};
use super::json_read::quoted;
use super::kitti::matrix_frame;
use super::track::{DEFAULT_FPS, PoseFrame, PoseTrack};

/// How the name of a pose file ends.
const ENDING: &str = ".pose.txt";

/// The name of a pose file.
#[derive(Debug, PartialEq, Eq, PartialOrd, Ord)]
struct FrameName {
    /// The text before the number.
    before: String,
    /// The last digits, those before the point of a decimal number; `None` without digits.
    number: Option<u64>,
    /// Whether the number is decimal: a time stamp, and no number of a frame.
    is_stamp: bool,
}

impl FrameName {
    fn of(file: &Path) -> Self {
        let name = file.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let stem = name.strip_suffix(ENDING).unwrap_or(&name).trim_end_matches(|c: char| !c.is_ascii_digit());
        let before_digits = |text: &str| text.trim_end_matches(|c: char| c.is_ascii_digit()).len();
        let split = before_digits(stem);
        let whole = stem[..split].strip_suffix('.').filter(|whole| before_digits(whole) < whole.len());
        let numbered = whole.unwrap_or(stem);
        let (before, digits) = numbered.split_at(before_digits(numbered));
        Self { before: before.to_owned(), number: digits.parse().ok(), is_stamp: whole.is_some() }
    }
}

/// The pose files of a folder, in order of the text before their numbers, of the numbers, then of their names.
pub(super) fn pose_files(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
    let is_pose = |path: &PathBuf| path.file_name().is_some_and(|name| name.to_string_lossy().ends_with(ENDING));
    let mut files: Vec<PathBuf> = entries.filter(is_pose).collect();
    files.sort_by_cached_key(|file| (FrameName::of(file), file.clone()));
    files
}

/// The numbers of all frames of one sequence; `None` if a name has none, two have the same, or there are several sequences.
fn numbers_of(files: &[PathBuf]) -> Option<Vec<u64>> {
    let names: Vec<FrameName> = files.iter().map(|file| FrameName::of(file)).collect();
    let is_one_sequence = names.iter().all(|name| !name.is_stamp && name.before == names[0].before);
    let numbers: Vec<u64> = names.iter().map(|name| name.number).collect::<Option<_>>()?;
    (is_one_sequence && numbers.windows(2).all(|pair| pair[0] < pair[1])).then_some(numbers)
}

/// The poses of a folder's files; errors name the file.
pub(super) fn read_folder(files: &[PathBuf]) -> Result<PoseTrack, ExportError> {
    read(files, |file, error| {
        let name = file.file_name().unwrap_or_default().to_string_lossy().into_owned();
        ExportError::InFile { name: quoted(&name), error: Box::new(error) }
    })
}

/// The pose of a file that is read alone.
pub(super) fn read_file(file: &Path) -> Result<PoseTrack, ExportError> {
    read(&[file.to_owned()], |_, error| error)
}

fn read(files: &[PathBuf], in_file: impl Fn(&Path, ExportError) -> ExportError) -> Result<PoseTrack, ExportError> {
    let (mut frames, mut num_lost) = (Vec::new(), 0);
    let numbers = numbers_of(files);
    for (idx, file) in files.iter().enumerate() {
        let bytes = cinesplat_files::read(file, Limits::DEFAULT.header_bytes as u64)?;
        let text = String::from_utf8_lossy(&bytes);
        let Some(frame) = frame_of(idx, &text).map_err(|error| in_file(file, error))? else {
            num_lost += 1;
            continue;
        };
        let number = numbers.as_ref().map_or(idx as u64, |numbers| numbers[idx]);
        frames.push(PoseFrame { time_secs: number as f64 / DEFAULT_FPS, ..frame });
    }
    let lost =
        format!("{num_lost} of {} poses are not finite and are left out: the others keep their times", files.len());
    let unread = if num_lost > 0 { vec![lost] } else { Vec::new() };
    Ok(PoseTrack { is_numbered: true, unread, ..PoseTrack::untimed(frames) })
}

/// The frame of a file's text; `None` for a pose that is not finite.
fn frame_of(idx: usize, text: &str) -> Result<Option<PoseFrame>, ExportError> {
    let rows = matrix(text)?;
    if rows.iter().any(|value| !value.is_finite()) {
        return Ok(None);
    }
    matrix_frame(idx, &rows).map(Some).map_err(|reason| bad_line(1, text, reason))
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

//! Tracks and shots read from files of any format.

use std::path::{Path, PathBuf};
use strum::VariantNames;

use cinesplat_files::{FileError, Limits};

use super::columns::{data_lines, without_index};
use super::format::{self, Doubt};
use super::imported_shot::{ImportSettings, overrule, shot_of};
use super::json_read::quoted;
use super::line_layout::LineLayout;
use super::{
    ExportError, Format, PoseTrack, aria, blender, cameras_json, colmap, csv, euroc, gltf, inria, kitti, lichtfeld,
    motionctrl, named_camera, nerfstudio, pose_lines, re10k, recammaster, redwood_log, ros, seven_scenes, shot_json,
    supersplat, transforms, tum, usd,
};
use cinesplat_trajectory::Shot;

/// Files in a folder that may hold its camera path, in the order of the search.
const IN_FOLDER: [&str; 11] = [
    "images.bin",
    "images.txt",
    "sparse/0/images.bin",
    "sparse/0/images.txt",
    "sparse/images.bin",
    "sparse/images.txt",
    "transforms.json",
    "camera_path.json",
    "trajectory.log",
    "mav0/state_groundtruth_estimate0/data.csv",
    "data.csv",
];

/// A camera path read from a file.
#[derive(Debug, Clone, PartialEq)]
pub struct Imported {
    /// Format of the file.
    pub format: Format,
    /// The poses, on the file's clock.
    pub track: PoseTrack,
    /// The shot, if the file is a `shot.json`.
    pub shot: Option<Shot>,
    /// The other format that the content fits, if the content does not settle its format.
    pub doubt: Option<Doubt>,
    /// One line per unknown key and per edit that the reader of a `shot.json` noted.
    pub notes: Vec<String>,
}

impl Imported {
    /// The file's shot with the reader's notes, or a shot with one keyframe per pose and one line per assumption and loss.
    ///
    /// The settings win over the file.
    ///
    /// # Errors
    /// [`ExportError::BadShot`] if the poses make no shot, for example because times do not increase.
    pub fn into_shot(self, settings: &ImportSettings) -> Result<(Shot, Vec<String>), ExportError> {
        match self.shot {
            Some(shot) => Ok((overrule(shot, settings)?, self.notes)),
            None => shot_of(&self.track, settings),
        }
    }
}

/// How a file is read.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct ReadSettings {
    /// Its format; `None` for what its content says.
    pub format: Option<Format>,
    /// Name of the camera in a file of several; `None` for the first.
    pub camera: Option<String>,
}

/// As [`read_with`], with the camera that the file holds first.
///
/// # Errors
/// Those of [`read_with`].
pub fn read(path: &Path, format: Option<Format>) -> Result<Imported, ExportError> {
    read_with(path, &ReadSettings { format, camera: None })
}

/// The camera path in a file, or in a folder that holds a COLMAP, EuRoC, nerfstudio or 7-Scenes capture or one recording
/// of ROS.
///
/// Without a format, the content of the file determines it. `FILE#NAME` names a topic of a recording of ROS, or a camera
/// of a file of several.
///
/// # Errors
/// [`ExportError::File`] and [`ExportError::TooLarge`] for the file, [`ExportError::WrongFormat`] for content that is
/// none of the known formats, and the errors of the format's reader.
pub fn read_with(path: &Path, settings: &ReadSettings) -> Result<Imported, ExportError> {
    let ReadSettings { format, camera } = settings;
    let pose_files = if path.is_dir() { seven_scenes::pose_files(path) } else { Vec::new() };
    if !pose_files.is_empty() && format.is_none_or(|format| format == Format::SevenScenes) {
        return imported(Format::SevenScenes, seven_scenes::read_folder(&pose_files)?);
    }
    let (path, topic) = without_topic(path);
    let path = &file_of(path)?;
    let whole = read_bytes(path)?;
    refuse_recordings(&whole)?;
    let without_index = std::str::from_utf8(&whole).ok().and_then(without_index).map(String::into_bytes);
    let has_index = without_index.is_some();
    let bytes = without_index.unwrap_or(whole);
    let by_name = || Format::from_path(path).filter(|format| *format == Format::Colmap);
    let (format, lines) = match (*format).or_else(by_name) {
        Some(format) => (format, None),
        None => format::detect_with_layout(&bytes).ok_or_else(|| unknown_content(&bytes))?,
    };
    let camera = camera.as_deref().or(topic);
    if let Some(camera) = camera.filter(|_| !holds_several(format)) {
        let found = format!("{}, the name of a camera, for {format}", quoted(camera));
        return Err(ExportError::WrongFormat { found, expected: "a name for gltf, usd, recammaster or ros".into() });
    }
    let (mut shot, mut notes) = (None, Vec::new());
    let track = match format {
        Format::Gltf => gltf::read(&bytes, camera, &|name| read_beside(path, name)),
        Format::Usd => usd::read(&bytes, camera),
        Format::Ros => ros::read(&bytes, camera),
        Format::Colmap => read_colmap(path, &bytes),
        Format::Supersplat if bytes.starts_with(b"PK") => supersplat::read(&supersplat::document_in_project(&bytes)?),
        _ => {
            let text = if is_by_line(format) { lines_of(&bytes)? } else { text_of(&bytes)? };
            match format {
                Format::Tum | Format::Euroc => match &lines {
                    Some(found) => pose_lines::read(text, found.layout),
                    None if format == Format::Tum => tum::read(text),
                    None => euroc::read(text),
                },
                Format::Kitti => kitti::read(text).map(|track| kitti::with_times_beside(track, path)),
                Format::Dpvo => pose_lines::read_as(text, LineLayout::DPVO),
                Format::Cameras => named_camera::track(&cameras_json::read(text)?.cameras),
                Format::Inria => inria::read(text),
                Format::Re10k => re10k::read(text),
                Format::Aria => aria::read(text),
                Format::MotionCtrl => motionctrl::read(text),
                Format::ReCamMaster => recammaster::read(text, camera),
                Format::SevenScenes => seven_scenes::read_file(path),
                Format::Nerfstudio => nerfstudio::read(text),
                Format::Transforms => transforms::read(text),
                Format::Supersplat => supersplat::read(text),
                Format::Lichtfeld => lichtfeld::read(text),
                Format::Blender => blender::read(text),
                Format::Csv => csv::read(text),
                Format::Log => redwood_log::read(text),
                _ => {
                    let found = shot_json::read(text)?;
                    let track = PoseTrack::keyframes(&found.shot);
                    (shot, notes) = (Some(found.shot), found.notes);
                    Ok(track)
                }
            }
        }
    }?;
    let mut read = imported(format, track)?;
    if has_index {
        read.track.unread.push("the first column has no name and is not read: an index of the lines".to_owned());
    }
    let doubt = lines.and_then(|found| Doubt::new(format, &found));
    Ok(Imported { shot, doubt, notes, ..read })
}

/// A track without a shot, doubts and notes.
fn imported(format: Format, track: PoseTrack) -> Result<Imported, ExportError> {
    if track.frames.is_empty() {
        return Err(ExportError::NoPoses);
    }
    let (num_frames, limit) = (track.frames.len(), Limits::DEFAULT.poses);
    if num_frames > limit {
        let expected = format!("at most {limit}");
        let place = "camera poses".to_owned();
        return Err(ExportError::BadField { place, found: num_frames.to_string(), expected });
    }
    Ok(Imported { format, track, shot: None, doubt: None, notes: Vec::new() })
}

/// Whether a file may hold several paths, of which a name chooses one.
fn holds_several(format: Format) -> bool {
    matches!(format, Format::Gltf | Format::Usd | Format::ReCamMaster | Format::Ros)
}

/// A path and the topic behind it, unless the whole path is a file.
fn without_topic(path: &Path) -> (&Path, Option<&str>) {
    let split = path.to_str().and_then(ros::split_topic).filter(|_| !path.exists());
    split.map_or((path, None), |(file, topic)| (Path::new(file), Some(topic)))
}

/// Refuses recordings of ROS without a reader; the error names the command that takes a path out of one.
fn refuse_recordings(bytes: &[u8]) -> Result<(), ExportError> {
    let kinds: [(&[u8], &str); 2] = [(b"#ROSBAG V1", "bag"), (b"SQLite format 3\0", "bag2")];
    let Some((_, kind)) = kinds.iter().find(|(magic, _)| bytes.starts_with(magic)) else { return Ok(()) };
    let reason = format!(
        "databases and version 1 of ROS are not read: `evo_traj {kind} RECORDING TOPIC --save_as_tum` (of evo) writes a TUM file, which is"
    );
    Err(ExportError::NotReadable { format: "ros", reason })
}

/// The error of a file that fits no format, with its first line of data.
fn unknown_content(bytes: &[u8]) -> ExportError {
    let first = text_of(bytes).ok().and_then(|text| data_lines(text).next());
    let found = match first {
        Some((line, text)) => format!("content of no known format (line {line}: \"{}\")", quoted(text)),
        None => "content of no known format".to_owned(),
    };
    ExportError::WrongFormat { found, expected: Format::VARIANTS.join(", ") }
}

/// Whether a format has a line, or several, per pose. The memory for JSON is limited by its own reader.
fn is_by_line(format: Format) -> bool {
    use Format as F;
    !matches!(
        format,
        F::Cameras
            | F::Inria
            | F::MotionCtrl
            | F::ReCamMaster
            | F::Nerfstudio
            | F::Transforms
            | F::Supersplat
            | F::Lichtfeld
            | F::Blender
            | F::Shot
    )
}

/// The text of a file with a pose per line, if it has no more lines than a path may have poses.
fn lines_of(bytes: &[u8]) -> Result<&str, ExportError> {
    // A line of a few bytes becomes a pose of hundreds.
    let limit = Limits::DEFAULT.poses;
    let end = if bytes.contains(&b'\n') { b'\n' } else { b'\r' };
    if bytes.iter().filter(|byte| **byte == end).take(limit + 1).count() > limit {
        let expected = format!("at most {limit} lines");
        return Err(ExportError::BadLine { line: limit + 1, found: "a further line".into(), expected });
    }
    text_of(bytes)
}

fn text_of(bytes: &[u8]) -> Result<&str, ExportError> {
    std::str::from_utf8(bytes).map_err(|error| ExportError::BadBytes {
        offset: error.valid_up_to(),
        found: "bytes that are not UTF-8".into(),
        expected: "text".into(),
    })
}

/// The file itself; of a folder the first match of [`IN_FOLDER`], or its recording of ROS.
fn file_of(path: &Path) -> Result<PathBuf, ExportError> {
    if !path.is_dir() {
        return Ok(path.to_owned());
    }
    let found = IN_FOLDER.iter().map(|name| path.join(name)).find(|file| file.is_file());
    match found {
        Some(file) => Ok(file),
        None => recording_in(path)?.ok_or_else(|| ExportError::WrongFormat {
            found: "a folder without a camera path".into(),
            expected: format!(
                "one of {}, a recording of ROS (.mcap or .bag), or a sequence of 7-Scenes (frame-000000.pose.txt)",
                IN_FOLDER.join(", ")
            ),
        }),
    }
}

/// The only recording of ROS in a folder, as ROS 2 writes one beside its `metadata.yaml`.
///
/// # Errors
/// [`ExportError::WrongFormat`] for several recordings and for a packed one.
fn recording_in(folder: &Path) -> Result<Option<PathBuf>, ExportError> {
    let of_folder = |source| FileError::Read { path: folder.to_owned(), source };
    let entries = std::fs::read_dir(folder).and_then(Iterator::collect::<Result<Vec<_>, _>>).map_err(of_folder)?;
    let is_file = |name: &String| is_recording(name) && folder.join(name).is_file();
    let mut names: Vec<String> =
        entries.iter().filter_map(|entry| entry.file_name().into_string().ok()).filter(is_file).collect();
    names.sort_unstable();
    let listed = names.iter().map(|name| quoted(name)).collect::<Vec<_>>().join(", ");
    match &names[..] {
        [] => Ok(None),
        [name] if name.ends_with(PACKED) => Err(ExportError::WrongFormat {
            found: format!("a packed recording of ROS, {listed}"),
            expected: format!("one that is unpacked (`zstd -d {listed}`)"),
        }),
        [name] => Ok(Some(folder.join(name))),
        _ => Err(ExportError::WrongFormat {
            found: format!("a folder with {} recordings of ROS ({listed})", names.len()),
            expected: "the path of one of them".into(),
        }),
    }
}

/// Ending of a recording that is packed as a whole.
const PACKED: &str = ".zstd";

/// Whether a file is a recording of ROS by its name.
fn is_recording(name: &str) -> bool {
    let unpacked = name.strip_suffix(PACKED).unwrap_or(name);
    [".mcap", ".bag", ".db3"].iter().any(|ending| unpacked.ends_with(ending))
}

fn read_bytes(path: &Path) -> Result<Vec<u8>, ExportError> {
    // A larger file is likely a scene, given by mistake.
    cinesplat_files::read(path, Limits::DEFAULT.array_bytes).map_err(|error| match error {
        FileError::TooLarge { path, found, expected } => ExportError::TooLarge { found, expected, path },
        error => error.into(),
    })
}

/// A file that another file names. It must be in the same folder, so that a file cannot read from elsewhere.
fn read_beside(path: &Path, name: &str) -> Result<Vec<u8>, ExportError> {
    if name.is_empty() || name.contains(['/', '\\']) || name.starts_with('.') {
        let found = quoted(name);
        return Err(ExportError::WrongFormat { found, expected: "the name of a file in the same folder".into() });
    }
    read_bytes(&path.with_file_name(name))
}

/// The model of an `images` (or `cameras`) file. Without a `cameras` file the fields of view are unknown.
fn read_colmap(path: &Path, bytes: &[u8]) -> Result<PoseTrack, ExportError> {
    let binary = path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("bin"));
    let extension = if binary { "bin" } else { "txt" };
    let named_cameras = path.file_stem().is_some_and(|stem| stem.eq_ignore_ascii_case("cameras"));
    let images = if named_cameras { read_beside(path, &format!("images.{extension}"))? } else { bytes.to_vec() };
    let cameras_path = path.with_file_name(format!("cameras.{extension}"));
    let cameras = if cameras_path.is_file() { Some(read_bytes(&cameras_path)?) } else { None };
    if binary {
        return colmap::read_binary(&images, cameras.as_deref());
    }
    colmap::read_text(lines_of(&images)?, cameras.as_deref().map(lines_of).transpose()?)
}

//! Shots and tracks into files of any format.

use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};

use super::losses::losses;
use super::{
    ExportError, Format, PoseTrack, blender, colmap, csv, euroc, gltf, kitti, lichtfeld, nerfstudio, redwood_log,
    shot_json, supersplat, transforms, tum, usd,
};
use cinesplat_trajectory::Shot;

/// What of a shot is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Content {
    /// Every frame of the film.
    #[default]
    Sampled,
    /// The keyframes; the reader's own curve joins them.
    Keyframes,
}

/// How a shot is written.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ExportSettings {
    /// Frames or keys.
    pub content: Content,
    /// Frames a second of sampled content; `None` takes the shot's.
    pub fps: Option<f64>,
}

/// Writes `shot` to `path` and returns a line for everything the format cannot hold.
///
/// A COLMAP model is a folder: `path` names it, or `images.txt` or `images.bin` inside it, whose ending picks text (also
/// the default) or binary. glTF is binary where the path ends in `.glb`. Existing files are replaced, each at once.
///
/// # Errors
/// [`ExportError::BadShot`] when the shot is not usable, [`ExportError::Io`] when a file cannot be written.
pub fn write(path: &Path, format: Format, shot: &Shot, settings: &ExportSettings) -> Result<Vec<String>, ExportError> {
    let track = match settings.content {
        Content::Sampled => PoseTrack::sampled(shot, settings.fps)?,
        Content::Keyframes => PoseTrack::keyframes(shot),
    };
    if format == Format::Shot && settings.content == Content::Keyframes {
        write_file(path, shot_json::write(shot).as_bytes())?;
        return Ok(Vec::new());
    }
    let mut warnings = write_poses(path, format, &track)?;
    if settings.content == Content::Keyframes && shot.keyframes.len() > 2 {
        let what = "joins the keys by a curve of its own: export without --keyframes for the film's path";
        warnings.push(format!("{} {what}", format.as_ref()));
    }
    Ok(warnings)
}

/// Writes timed poses to `path`, as [`write()`] does.
///
/// # Errors
/// [`ExportError::NoPoses`] for a track without frames, [`ExportError::BadShot`] where it makes no shot and the format is
/// `shot`, [`ExportError::Io`] when a file cannot be written.
pub fn write_poses(path: &Path, format: Format, track: &PoseTrack) -> Result<Vec<String>, ExportError> {
    if track.frames.is_empty() {
        return Err(ExportError::NoPoses);
    }
    let mut warnings = losses(format, track);
    let text = match format {
        Format::Colmap => {
            let (folder, binary) = colmap_target(path);
            let files = if binary { colmap::write_binary(track) } else { colmap::write_text(track) };
            write_folder(&folder, &files)?;
            return Ok(warnings);
        }
        Format::Gltf if has_extension(path, "glb") => {
            write_file(path, &gltf::write_binary(track))?;
            return Ok(warnings);
        }
        Format::Shot => {
            let (shot, assumptions) = track.to_shot()?;
            warnings.extend(assumptions);
            shot_json::write(&shot)
        }
        Format::Tum => tum::write(track),
        Format::Kitti => kitti::write(track),
        Format::Euroc => euroc::write(track),
        Format::Nerfstudio => nerfstudio::write(track),
        Format::Transforms => transforms::write(track),
        Format::Supersplat => supersplat::write(track),
        Format::Lichtfeld => lichtfeld::write(track),
        Format::Gltf => gltf::write_text(track),
        Format::Usd => usd::write(track),
        Format::Blender => blender::write(track),
        Format::Csv => csv::write(track),
        Format::Log => redwood_log::write(track),
    };
    write_file(path, text.as_bytes())?;
    Ok(warnings)
}

fn has_extension(path: &Path, extension: &str) -> bool {
    path.extension().is_some_and(|found| found.eq_ignore_ascii_case(extension))
}

/// The folder of a COLMAP model and whether it is to be binary.
fn colmap_target(path: &Path) -> (PathBuf, bool) {
    let in_file = has_extension(path, "bin") || has_extension(path, "txt");
    let folder = if in_file { path.parent().unwrap_or(Path::new("")) } else { path };
    (folder.to_owned(), has_extension(path, "bin"))
}

fn write_folder(folder: &Path, files: &colmap::ModelFiles) -> Result<(), ExportError> {
    let io = |source| ExportError::Io { doing: "creating", source, path: folder.to_owned() };
    if !folder.as_os_str().is_empty() {
        fs::create_dir_all(folder).map_err(io)?;
    }
    files.iter().try_for_each(|(name, bytes)| write_file(&folder.join(name), bytes))
}

/// Writes beside the target and renames, so that no reader ever sees half a file.
fn write_file(path: &Path, bytes: &[u8]) -> Result<(), ExportError> {
    let mut name = path.file_name().map_or_else(OsString::new, OsString::from);
    name.push(".part");
    let part = path.with_file_name(name);
    let io = |doing| move |source| ExportError::Io { doing, source, path: path.to_owned() };
    fs::write(&part, bytes).map_err(io("creating"))?;
    fs::rename(&part, path).map_err(io("creating"))
}

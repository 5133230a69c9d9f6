//! Shots encoded in any format.

use std::path::{Path, PathBuf};

use cinesplat_files::{Existing, FileError};
use strum::VariantArray;

use super::imported_shot::{ImportSettings, shot_of};
use super::key_slopes::key_slopes;
use super::losses::losses;
use super::stray;
use super::{
    ExportError, Format, PoseTrack, blender, cameras_json, colmap, csv, euroc, gltf, kitti, lichtfeld, nerfstudio,
    redwood_log, shot_json, supersplat, transforms, tum, usd,
};
use cinesplat_trajectory::{Easing, LENS_EFFECT, Shot};

/// The poses of a shot to write.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Content {
    /// Every frame of the film.
    #[default]
    Sampled,
    /// The keyframes; the reading program interpolates between them.
    Keyframes,
}

/// Settings of an export.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ExportSettings {
    /// Frames or keyframes.
    pub content: Content,
    /// Frames per second of sampled content; `None` for the shot's.
    pub fps: Option<f64>,
    /// Layout, for glTF and COLMAP.
    pub layout: Layout,
}

/// Text or binary, for the two formats that have both: glTF and COLMAP.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Layout {
    /// Text.
    #[default]
    Text,
    /// Binary.
    Binary,
}

impl Layout {
    /// The layout of a path by its extension: binary for `.glb` and `.bin`, else text.
    pub fn of_path(path: &Path) -> Self {
        if has_extension(path, "glb") || has_extension(path, "bin") { Self::Binary } else { Self::Text }
    }
}

/// A shot encoded in a format, not yet written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Encoded {
    /// Content of the file or files.
    pub files: EncodedFiles,
    /// One line per property that the format cannot hold.
    pub losses: Vec<String>,
}

/// Content of an export.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum EncodedFiles {
    /// The bytes of one file.
    Single(Vec<u8>),
    /// Names and bytes of the files of a folder.
    Folder(Vec<(&'static str, Vec<u8>)>),
}

/// Encodes a shot in a format.
///
/// # Errors
/// [`ExportError::BadShot`] if the shot is not usable.
pub fn encode(format: Format, shot: &Shot, settings: &ExportSettings) -> Result<Encoded, ExportError> {
    // The last key eases nothing.
    let eased = shot.keyframes.split_last().map_or(&[][..], |(_, keys)| keys);
    let num_eased = eased.iter().filter(|key| !lichtfeld::has(key.easing)).count();
    let is_too_eased = format == Format::Lichtfeld && num_eased > 0;
    let content = if is_too_eased { Content::Sampled } else { settings.content };
    // `ns-render` renders the path that stands beside the keyframes.
    let has_path = format == Format::Nerfstudio;
    let track = match content {
        Content::Keyframes if !has_path => PoseTrack::keyframes(shot),
        Content::Keyframes | Content::Sampled => PoseTrack::sampled(shot, settings.fps)?,
    };
    if format == Format::Shot && content == Content::Keyframes {
        return Ok(Encoded { files: EncodedFiles::Single(shot_json::write(shot).into_bytes()), losses: Vec::new() });
    }
    let single =
        |text: String| Encoded { files: EncodedFiles::Single(text.into_bytes()), losses: losses(format, &track) };
    let mut encoded = match (format, content) {
        (Format::Blender, Content::Keyframes) => single(blender::write(&track, &key_slopes(shot)?)),
        (Format::Nerfstudio, Content::Keyframes) => single(nerfstudio::write(&track, &track.keys)),
        _ => encode_poses(format, shot, &track, settings.layout)?,
    };
    encoded.losses.extend(lost_effects(format, shot));
    if content == Content::Keyframes && shot.keyframes.len() > 1 {
        encoded.losses.extend(stray::line(format, shot)?);
    }
    if content != settings.content {
        encoded.losses.push(format!(
            "lichtfeld has linear and cubic easings: every frame is a key, because {num_eased} of {} keys ease otherwise",
            shot.keyframes.len()
        ));
    }
    Ok(encoded)
}

/// A line about the effects of a shot: no other program has them, nor what they do to the lens and the path.
fn lost_effects(format: Format, shot: &Shot) -> Option<String> {
    let mut names: Vec<&str> = shot.effects.iter().map(|effect| effect.kind.as_str()).collect();
    if !names.contains(&LENS_EFFECT) && shot.keyframes.iter().any(|key| key.optics.lens.is_some()) {
        names.push(LENS_EFFECT);
    }
    let are_lost = format != Format::Shot && !names.is_empty();
    are_lost.then(|| format!("{format} holds no effects: {} are lost", names.join(", ")))
}

/// A shot with one keyframe per frame of another shot's film. It keeps what does not depend on the keys.
fn sampled_shot(shot: &Shot, track: &PoseTrack) -> Result<Encoded, ExportError> {
    let (sampled, _) = shot_of(track, &ImportSettings::default())?;
    let mut sampled = Shot {
        scene: shot.scene.clone(),
        prompt: shot.prompt.clone(),
        seed: shot.seed,
        model: shot.model.clone(),
        effects: shot.effects.clone(),
        ..sampled
    };
    for key in &mut sampled.keyframes {
        key.optics.lens = shot.lens_at(key.time_secs);
    }
    let num_keys = shot.keyframes.len();
    let num_optics = shot.keyframes.iter().filter(|key| key.optics.is_exposing()).count();
    let num_eased = shot.keyframes.iter().filter(|key| key.easing != Easing::Linear).count();
    let num_intents = shot.keyframes.iter().filter(|key| key.intent.is_some()).count();
    let num_lines = shot.report.len();
    let clearance = usize::from(shot.clearance.is_some());
    let dropped = [
        (num_eased, format!("the easings of {num_eased} of {num_keys} keys are in the times of the sampled keys")),
        (num_intents, format!("the intents of {num_intents} of {num_keys} keys do not apply to sampled keys")),
        (
            num_optics,
            format!("the f-stops and shutter angles of {num_optics} of {num_keys} keys are not in sampled keys"),
        ),
        (num_lines, format!("the report does not apply to sampled keys (lines: {num_lines})")),
        (clearance, "the clearance proof does not apply to sampled keys".to_owned()),
    ];
    let losses =
        dropped.into_iter().filter(|(amount, _)| *amount > 0).map(|(_, line)| format!("shot: {line}")).collect();
    Ok(Encoded { files: EncodedFiles::Single(shot_json::write(&sampled).into_bytes()), losses })
}

/// Encodes timed poses of a shot in a format.
fn encode_poses(format: Format, shot: &Shot, track: &PoseTrack, layout: Layout) -> Result<Encoded, ExportError> {
    if track.frames.is_empty() {
        return Err(ExportError::NoPoses);
    }
    if !format.is_written() {
        let expected = Format::VARIANTS.iter().filter(|format| format.is_written()).map(|format| (*format).into());
        return Err(ExportError::NotWritable { format: format.into(), expected: expected.collect() });
    }
    let losses = losses(format, track);
    let text = match format {
        Format::Colmap => {
            let files = match layout {
                Layout::Binary => colmap::write_binary(track),
                Layout::Text => colmap::write_text(track),
            };
            return Ok(Encoded { files: EncodedFiles::Folder(files), losses });
        }
        Format::Gltf if layout == Layout::Binary => {
            return Ok(Encoded { files: EncodedFiles::Single(gltf::write_binary(track)), losses });
        }
        Format::Shot => return sampled_shot(shot, track),
        Format::Tum => tum::write(track),
        Format::Kitti => kitti::write(track),
        Format::Euroc => euroc::write(track),
        Format::Nerfstudio => nerfstudio::write(track, &track.frames),
        Format::Transforms => transforms::write(track),
        Format::Supersplat => supersplat::write(track),
        Format::Lichtfeld => lichtfeld::write(track),
        Format::Gltf => gltf::write_text(track),
        Format::Usd => usd::write(track),
        Format::Blender => blender::write(track, &[]),
        Format::Csv => csv::write(track),
        Format::Log => redwood_log::write(track),
        Format::Cameras => cameras_json::write(shot, track),
        Format::Inria
        | Format::Re10k
        | Format::Aria
        | Format::SevenScenes
        | Format::Dpvo
        | Format::MotionCtrl
        | Format::ReCamMaster
        | Format::Ros => String::new(),
    };
    Ok(Encoded { files: EncodedFiles::Single(text.into_bytes()), losses })
}

/// The files that an export to `path` creates.
///
/// A COLMAP model is a folder: `path` is the folder, or a `.txt` or `.bin` file in it. Every other format is one file.
pub fn output_files(path: &Path, format: Format, layout: Layout) -> Vec<PathBuf> {
    if format != Format::Colmap {
        return vec![path.to_owned()];
    }
    let folder = colmap_folder(path);
    let extension = if layout == Layout::Binary { "bin" } else { "txt" };
    ["cameras", "images", "points3D"].map(|name| folder.join(format!("{name}.{extension}"))).to_vec()
}

/// Checks before any work that the files of an export can be created. The folder of a COLMAP model may be missing. A model in
/// the other layout counts as existing: programs would read it in place of the new one.
///
/// # Errors
/// [`FileError::Exists`], [`FileError::Create`] of the first file that cannot be created.
pub fn check_output(path: &Path, format: Format, layout: Layout, existing: Existing) -> Result<(), FileError> {
    if format == Format::Colmap && !colmap_folder(path).exists() {
        return Ok(());
    }
    let other = if layout == Layout::Binary { Layout::Text } else { Layout::Binary };
    let in_other = if format == Format::Colmap { output_files(path, format, other) } else { Vec::new() };
    let files = output_files(path, format, layout);
    files.iter().chain(&in_other).try_for_each(|file| cinesplat_files::check_free(file, existing))
}

/// Writes a shot to `path` and returns one line per property that the format cannot hold.
///
/// [`output_files`] returns the paths of the files. Nothing is written if one of them exists and may not be replaced.
///
/// # Errors
/// [`ExportError::BadShot`] if the shot is not usable, [`ExportError::File`] if a file exists already or cannot be
/// written.
pub fn write(
    path: &Path,
    format: Format,
    shot: &Shot,
    settings: &ExportSettings,
    existing: Existing,
) -> Result<Vec<String>, ExportError> {
    let encoded = encode(format, shot, settings)?;
    encoded.write(path, existing)?;
    Ok(encoded.losses)
}

impl Encoded {
    /// Writes the file to `path`, or the files to the folder of `path`; each is written completely or not at all.
    ///
    /// # Errors
    /// [`FileError`] of the first file that cannot be created or written.
    pub fn write(&self, path: &Path, existing: Existing) -> Result<(), FileError> {
        let files = match &self.files {
            EncodedFiles::Single(bytes) => return cinesplat_files::write(path, bytes, existing),
            EncodedFiles::Folder(files) => files,
        };
        let folder = colmap_folder(path);
        cinesplat_files::create_folder(&folder)?;
        let paths: Vec<_> = files.iter().map(|(name, bytes)| (folder.join(name), bytes)).collect();
        paths.iter().try_for_each(|(path, _)| cinesplat_files::check_free(path, existing))?;
        paths.iter().try_for_each(|(path, bytes)| cinesplat_files::write(path, bytes, existing))
    }
}

fn has_extension(path: &Path, extension: &str) -> bool {
    path.extension().is_some_and(|found| found.eq_ignore_ascii_case(extension))
}

/// The folder of a COLMAP model.
fn colmap_folder(path: &Path) -> PathBuf {
    let in_file = has_extension(path, "bin") || has_extension(path, "txt");
    let folder = if in_file { path.parent().unwrap_or(Path::new("")) } else { path };
    if folder.as_os_str().is_empty() { PathBuf::from(".") } else { folder.to_owned() }
}

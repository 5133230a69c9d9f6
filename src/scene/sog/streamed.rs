//! The streamed SOG of `PlayCanvas`: `lod-meta.json` with a tree of boxes, each with ranges of Gaussians in several SOGs, one
//! SOG or more per level of detail. Enters: that file. Leaves: the Gaussians of the finest level whose files are all there.

use std::collections::BTreeMap;
use std::path::{Component, Path, PathBuf};

use cinesplat_files::json_excess;
use glam::Vec3;
use serde_json::Value;

use super::single::{read_bundle, read_unbundled};
use crate::decoded::DecodedScene;
use crate::error::{SceneError, shown};
use crate::gaussians::NUM_SH_REST;
use crate::intake::{Intake, RawGaussian};
use crate::source_file::{SourceFile, collected_bytes, read_file};

/// Deepest tree.
const MAX_DEPTH: usize = 64;
/// Most levels of detail.
const MAX_LEVELS: u64 = 64;

/// Gaussians `start..start + count` of file `file`.
#[derive(Debug, Clone, Copy)]
struct Piece {
    file: usize,
    start: usize,
    count: usize,
}

/// Gaussians of a streamed SOG.
///
/// # Errors
/// [`SceneError::Damaged`] for a bad tree, [`SceneError::NotFound`] if no level is whole, and the errors of SOG.
pub(crate) fn read(source: &SourceFile) -> Result<DecodedScene, SceneError> {
    let bytes = source.bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(source.bytes);
    json_excess(bytes, &source.options.limits).map_or(Ok(()), |excess| Err(damaged(source, excess)))?;
    let json: Value = serde_json::from_slice(bytes).map_err(|error| damaged(source, format!("not JSON: {error}")))?;
    let files = file_names(source, &json)?;
    let num_levels = json.get("lodLevels").and_then(Value::as_u64).unwrap_or(1).clamp(1, MAX_LEVELS);
    let mut missing = Vec::new();
    for level in 0..num_levels {
        let mut pieces = Vec::new();
        collect(source, &json["tree"], (level, num_levels, 0), &mut pieces)?;
        let unread =
            pieces.iter().map(|piece| files.get(piece.file)).find(|path| path.is_none_or(|path| !path.exists()));
        match unread {
            Some(path) => missing.push((level, path.cloned())),
            None if pieces.is_empty() => return Err(damaged(source, "a tree without Gaussians".to_owned())),
            None => return assemble(source, &json, (&files, &pieces), (level, num_levels)),
        }
    }
    let first = missing.into_iter().find_map(|(_, path)| path);
    Err(first
        .map_or_else(|| damaged(source, "a tree that names no file".to_owned()), |path| SceneError::NotFound { path }))
}

fn damaged(source: &SourceFile, reason: String) -> SceneError {
    SceneError::Damaged { path: source.path.to_path_buf(), byte: 0, reason }
}

/// The files, which must be in the folder or below it, so that a scene cannot read from elsewhere.
fn file_names(source: &SourceFile, json: &Value) -> Result<Vec<PathBuf>, SceneError> {
    let names = json.get("filenames").and_then(Value::as_array).map_or(&[][..], Vec::as_slice);
    names.iter().map(|name| file_path(source, name)).collect()
}

fn file_path(source: &SourceFile, name: &Value) -> Result<PathBuf, SceneError> {
    let name = Path::new(name.as_str().unwrap_or_default());
    if name.as_os_str().is_empty() || !name.components().all(|part| matches!(part, Component::Normal(_))) {
        return Err(damaged(source, format!("the file {} outside of the folder", name.display())));
    }
    Ok(source.path.parent().unwrap_or(Path::new("")).join(name))
}

/// Adds the pieces of a box and the boxes in it. A box without the level has its next coarser one, else its coarsest.
fn collect(
    source: &SourceFile,
    node: &Value,
    (level, num_levels, depth): (u64, u64, usize),
    pieces: &mut Vec<Piece>,
) -> Result<(), SceneError> {
    if depth > MAX_DEPTH {
        return Err(damaged(source, format!("a tree deeper than {MAX_DEPTH}")));
    }
    if let Some(lods) = node.get("lods").and_then(Value::as_object) {
        let at = |level: u64| lods.get(&level.to_string());
        let found = (level..num_levels).find_map(at).or_else(|| (0..level).rev().find_map(at));
        if let Some(found) = found {
            let number = |name: &str| found.get(name).and_then(Value::as_u64).map(|value| value as usize);
            let (Some(file), Some(start), Some(count)) = (number("file"), number("offset"), number("count")) else {
                return Err(damaged(source, "a level without file, offset and count".to_owned()));
            };
            pieces.push(Piece { file, start, count });
        }
    }
    let children = node.get("children").and_then(Value::as_array);
    let inside = (level, num_levels, depth + 1);
    children.into_iter().flatten().try_for_each(|child| collect(source, child, inside, pieces))
}

/// Reads the files of the pieces and joins the pieces in the order of the tree.
fn assemble(
    source: &SourceFile,
    json: &Value,
    (files, pieces): (&[PathBuf], &[Piece]),
    (level, num_levels): (u64, u64),
) -> Result<DecodedScene, SceneError> {
    let total = pieces.iter().fold(0_u64, |sum, piece| sum.saturating_add(piece.count as u64));
    source.check_count(total)?;
    let around = json.get("environment").filter(|name| name.is_string());
    let around = around.map(|name| file_path(source, name)).transpose()?;
    let mut scenes: BTreeMap<&Path, FileScene> = BTreeMap::new();
    let mut held_bytes = source.held_bytes;
    for path in pieces.iter().map(|piece| &files[piece.file]).chain(&around) {
        if !scenes.contains_key(path.as_path()) {
            let scene = FileScene::read(&SourceFile { held_bytes, ..*source }, path)?;
            held_bytes = held_bytes.saturating_add(scene.num_bytes());
            scenes.insert(path, scene);
        }
    }
    let all = || scenes.values();
    let environment = around.as_deref().and_then(|path| scenes.get(path));
    let degree = all().map(|scene| scene.decoded.collected.gaussians.sh_degree).max().unwrap_or(0);
    let num_around = environment.map_or(0, FileScene::count);
    let count = source.check_count(total + num_around as u64)?;
    let mut intake = Intake::new(&SourceFile { held_bytes, ..*source }, count, degree)?;
    for piece in pieces {
        let Some(scene) = scenes.get(files[piece.file].as_path()) else { continue };
        if piece.start.checked_add(piece.count).is_none_or(|end| end > scene.count()) {
            let found = format!("Gaussians {} + {} of a file of {}", piece.start, piece.count, scene.count());
            return Err(damaged(source, found));
        }
        scene.push(&mut intake, piece.start, piece.count, degree);
    }
    if let Some(scene) = environment {
        scene.push(&mut intake, 0, scene.count(), degree);
    }
    let mut collected = intake.finish(source.path)?;
    let folder = source.path.parent().unwrap_or(Path::new(""));
    for (path, scene) in &scenes {
        let name = shown(path.strip_prefix(folder).unwrap_or(path));
        collected.notes.extend(scene.decoded.collected.notes.iter().map(|note| format!("{name}: {note}")));
    }
    if level > 0 {
        collected.notes.push(format!(
            "the files of finer levels of detail are missing: level {level} of 0 to {} is read",
            num_levels - 1
        ));
    }
    let filter = all().find_map(|scene| scene.decoded.filter);
    let format = format!("sog (streamed, level {level} of {num_levels})");
    // Files of two levels may have the same content.
    let named = |(path, scene): (&Path, FileScene)| {
        let name = shown(path.strip_prefix(folder).unwrap_or(path));
        std::iter::once(name).chain(scene.decoded.further_sha256)
    };
    let further_sha256 = scenes.into_iter().flat_map(named).collect();
    Ok(DecodedScene { format, collected, filter, up: None, further_sha256 })
}

/// A SOG of the tree.
struct FileScene {
    decoded: DecodedScene,
}

impl FileScene {
    fn read(source: &SourceFile, path: &Path) -> Result<Self, SceneError> {
        let bytes = read_file(path, source.options.limits.scene_bytes)?;
        let file = SourceFile { path, bytes: &bytes, ..*source };
        let mut decoded = if bytes.starts_with(b"PK") { read_bundle(&file)? } else { read_unbundled(&file)? };
        decoded.further_sha256.insert(0, cinesplat_files::sha256_hex(&bytes));
        Ok(Self { decoded })
    }

    /// Number of Gaussians in the file, with those that were dropped.
    fn count(&self) -> usize {
        self.decoded.collected.num_in_file()
    }

    /// Bytes of memory that it takes.
    fn num_bytes(&self) -> u64 {
        collected_bytes(self.count(), self.decoded.collected.gaussians.sh_degree)
    }

    /// Adds the Gaussians of a range of the file; those that were dropped only count.
    fn push(&self, intake: &mut Intake, start: usize, count: usize, degree: u8) {
        let gaussians = &self.decoded.collected.gaussians;
        let mut rest = vec![Vec3::ZERO; NUM_SH_REST[usize::from(degree)]];
        for kept in self.decoded.collected.in_file_order(start..start + count) {
            let Some(idx) = kept else {
                intake.push_dropped();
                continue;
            };
            rest.iter_mut().zip(gaussians.sh_rest_of(idx)).for_each(|(to, value)| *to = *value);
            let turn = gaussians.rotations[idx].as_dquat();
            let raw = RawGaussian {
                mean: gaussians.mean_world(idx),
                scale: gaussians.scales[idx].as_dvec3(),
                rotation_wxyz: [turn.w, turn.x, turn.y, turn.z],
                opacity: f64::from(gaussians.opacities[idx]),
                sh_dc: gaussians.sh_dc[idx].as_dvec3(),
            };
            intake.push(&raw, &rest);
        }
    }
}

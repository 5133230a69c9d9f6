use std::fs;
use std::path::Path;

use glam::DVec3;

use super::decoded::DecodedScene;
use super::error::SceneError;
use super::options::LoadOptions;
use super::scene::{Scene, UpSource};
use super::sniff::{self, SceneFormat};
use super::source_file::{SourceFile, read_file};
use super::up::{self, UpPrior};
use super::{gltf, ksplat, pcd, ply, sog, splat, spz};

/// Reads a scene of any supported format: a file, or the folder, `meta.json` or `lod-meta.json` of an
/// unbundled or streamed SOG.
///
/// The content decides the format; only a `.splat`, which has no magic number, may be known by its extension. The file
/// is read into memory once. The readers check its sizes against `options` and the bytes present before they allocate.
///
/// # Errors
/// [`SceneError`], one variant per kind of fault. No content of the file causes a panic.
pub fn load(path: &Path, options: &LoadOptions) -> Result<Scene, SceneError> {
    let metadata = fs::metadata(path).map_err(|source| SceneError::from_io(path, source))?;
    if metadata.is_dir() {
        let named = ["meta.json", "lod-meta.json"].map(|name| path.join(name));
        let [first, _] = &named;
        let meta = named.iter().find(|meta| meta.exists()).unwrap_or(first).clone();
        let bytes = read_file(&meta, options.limits.scene_bytes)?;
        return load_bytes(&meta, &bytes, options).map(|scene| Scene { path: path.to_path_buf(), ..scene });
    }
    load_bytes(path, &read_file(path, options.limits.scene_bytes)?, options)
}

/// As [`load`], for a file that is in memory already. `path` names the file in errors; the pictures of a SOG `meta.json`
/// are read from the folder of `path`.
///
/// # Errors
/// As [`load`].
pub fn load_bytes(path: &Path, bytes: &[u8], options: &LoadOptions) -> Result<Scene, SceneError> {
    let source = SourceFile { path, bytes, options, held_bytes: 0 };
    let decoded = match sniff::format_of(&source)? {
        SceneFormat::Ply => ply::read(&source)?,
        SceneFormat::Splat => splat::read(&source)?,
        SceneFormat::Spz => spz::read(&source)?,
        SceneFormat::SogBundle => sog::read_bundle(&source)?,
        SceneFormat::SogMeta => sog::read_unbundled(&source)?,
        SceneFormat::SogStreamed => sog::read_streamed(&source)?,
        SceneFormat::Ksplat => ksplat::read(&source)?,
        SceneFormat::Gltf => gltf::read(&source)?,
        SceneFormat::Pcd => pcd::read(&source)?,
    };
    let (up, up_source) = choose_up(path, &decoded, options)?;
    Ok(Scene {
        path: path.to_path_buf(),
        sha256: hash_of(bytes, &decoded.further_sha256),
        format: decoded.format,
        gaussians: decoded.collected.gaussians,
        dropped: decoded.collected.dropped,
        filter: decoded.filter,
        up,
        up_source,
        notes: decoded.collected.notes,
    })
}

/// SHA-256 of the file; of several files that of a list of theirs.
fn hash_of(bytes: &[u8], further: &[String]) -> String {
    let own = cinesplat_files::sha256_hex(bytes);
    if further.is_empty() {
        own
    } else {
        cinesplat_files::sha256_hex(format!("{own}\n{}", further.join("\n")).as_bytes())
    }
}

/// World up and its source: the caller's, else the file's, else the estimate.
fn choose_up(path: &Path, decoded: &DecodedScene, options: &LoadOptions) -> Result<(DVec3, UpSource), SceneError> {
    if let Some(given) = options.up {
        let bad = || SceneError::BadUp { path: path.to_path_buf(), found: given.to_array() };
        let largest = given.abs().max_element();
        let up = (given / largest).try_normalize().filter(|up| up.is_finite() && given.is_finite()).ok_or_else(bad)?;
        return Ok((up, UpSource::Flag));
    }
    if let Some((up, words)) = &decoded.up {
        return Ok((*up, UpSource::File(words.clone())));
    }
    let estimate = up::estimate(&decoded.collected.gaussians, UpPrior::of_format(&decoded.format));
    Ok((estimate.up, UpSource::Estimated(estimate.confidence_percent)))
}

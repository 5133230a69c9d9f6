use std::fs::{self, File};
use std::io::Read;
use std::path::Path;

use glam::DVec3;

use super::intake::Collected;
use super::sniff::{self, SceneFormat};
use super::up::{self, UpPrior};
use super::{Scene, SceneError, SplatFilter, UpSource, ply, sog, splat, spz};

/// What a scene may cost, and what the caller knows better than the file.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoadOptions {
    /// World up, of any length; wins over the file and over the estimate.
    pub up: Option<DVec3>,
    /// Largest file, and largest size after decompression, in bytes.
    pub max_file_bytes: u64,
    /// Most Gaussians.
    pub max_gaussians: usize,
}

impl Default for LoadOptions {
    fn default() -> Self {
        Self { up: None, max_file_bytes: 8 << 30, max_gaussians: 50_000_000 }
    }
}

/// A file in memory, with its name for errors and the limits it is read under.
#[derive(Clone, Copy)]
pub(super) struct Source<'a> {
    /// The path as the caller gave it.
    pub(super) path: &'a Path,
    /// All of the file.
    pub(super) bytes: &'a [u8],
    /// Limits.
    pub(super) options: &'a LoadOptions,
}

impl Source<'_> {
    /// Refuses more Gaussians than the caller allows.
    ///
    /// # Errors
    /// [`SceneError::TooManyGaussians`].
    pub(super) fn check_count(&self, found: u64) -> Result<usize, SceneError> {
        let cap = self.options.max_gaussians.min(u32::MAX as usize) as u64;
        if found > cap {
            return Err(SceneError::TooManyGaussians { path: self.path.to_path_buf(), found, cap });
        }
        Ok(found as usize)
    }
}

/// A decoded file before its up axis is settled.
pub(super) struct Decoded {
    /// Human name of the format.
    pub(super) format: String,
    /// Gaussians and what was dropped.
    pub(super) collected: Collected,
    /// Filter that the file asks for.
    pub(super) filter: Option<SplatFilter>,
    /// Up axis that the file states, with its words.
    pub(super) up: Option<(DVec3, String)>,
    /// Which up axes files of this kind tend to have.
    pub(super) up_prior: UpPrior,
}

/// Reads a scene of any supported format: a file, or the folder or `meta.json` of an unbundled SOG.
///
/// The content decides the format, not the extension. The file is read into memory once; its sizes are checked against
/// `options` and against the bytes that are there before anything is allocated for them.
///
/// # Errors
/// [`SceneError`], one variant a kind of fault; never a panic, whatever the file holds.
pub fn load(path: &Path, options: &LoadOptions) -> Result<Scene, SceneError> {
    let metadata = fs::metadata(path).map_err(|source| SceneError::from_io(path, source))?;
    if metadata.is_dir() {
        let meta = path.join("meta.json");
        if !meta.exists() && path.join("lod-meta.json").exists() {
            return Err(SceneError::NotReadYet { path: path.to_path_buf(), format: sniff::STREAMED_SOG });
        }
        let bytes = read_file(&meta, options.max_file_bytes)?;
        return load_bytes(&meta, &bytes, options).map(|scene| Scene { path: path.to_path_buf(), ..scene });
    }
    load_bytes(path, &read_file(path, options.max_file_bytes)?, options)
}

/// As [`load`], for a file that is in memory already. `path` names it in errors; a SOG `meta.json` finds its pictures
/// in the folder of `path`.
///
/// # Errors
/// As [`load`].
pub fn load_bytes(path: &Path, bytes: &[u8], options: &LoadOptions) -> Result<Scene, SceneError> {
    let source = Source { path, bytes, options };
    let decoded = match sniff::format_of(&source)? {
        SceneFormat::Ply => ply::read(&source)?,
        SceneFormat::Splat => splat::read(&source)?,
        SceneFormat::Spz => spz::read(&source)?,
        SceneFormat::SogBundle => sog::read_bundle(&source)?,
        SceneFormat::SogMeta => sog::read_unbundled(&source)?,
    };
    let (up, up_source) = settle_up(path, &decoded, options)?;
    Ok(Scene {
        path: path.to_path_buf(),
        sha256: cinesplat_files::sha256_hex(bytes),
        format: decoded.format,
        gaussians: decoded.collected.gaussians,
        dropped: decoded.collected.dropped,
        filter: decoded.filter,
        up,
        up_source,
        notes: decoded.collected.notes,
    })
}

/// Up by rank of its source: the caller, the file, the estimate.
fn settle_up(path: &Path, decoded: &Decoded, options: &LoadOptions) -> Result<(DVec3, UpSource), SceneError> {
    if let Some(given) = options.up {
        let bad = || SceneError::BadUp { path: path.to_path_buf(), found: given.to_array() };
        let largest = given.abs().max_element();
        let up = (given / largest).try_normalize().filter(|up| up.is_finite() && given.is_finite()).ok_or_else(bad)?;
        return Ok((up, UpSource::Flag));
    }
    if let Some((up, words)) = &decoded.up {
        return Ok((*up, UpSource::File(words.clone())));
    }
    let estimate = up::estimate(&decoded.collected.gaussians, decoded.up_prior);
    Ok((estimate.up, UpSource::Estimated(estimate.percent_sure)))
}

/// All bytes of a regular file, at most `cap` of them.
///
/// # Errors
/// [`SceneError::NotAFile`] for pipes and devices, which may never end; [`SceneError::TooManyBytes`]; faults of the
/// file system.
pub(super) fn read_file(path: &Path, cap: u64) -> Result<Vec<u8>, SceneError> {
    let failed = |source| SceneError::from_io(path, source);
    // Asked before opening: opening a pipe waits for its other end.
    let metadata = fs::metadata(path).map_err(failed)?;
    if !metadata.is_file() {
        return Err(SceneError::NotAFile { path: path.to_path_buf() });
    }
    let too_many = |found| SceneError::TooManyBytes { path: path.to_path_buf(), found, cap };
    if metadata.len() > cap {
        return Err(too_many(metadata.len()));
    }
    let mut bytes = Vec::new();
    if bytes.try_reserve_exact(metadata.len() as usize + 1).is_err() {
        return Err(too_many(metadata.len()));
    }
    let file = File::open(path).map_err(failed)?;
    file.take(cap.saturating_add(1)).read_to_end(&mut bytes).map_err(failed)?;
    if bytes.len() as u64 > cap { Err(too_many(bytes.len() as u64)) } else { Ok(bytes) }
}

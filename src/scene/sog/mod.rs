//! SOG, versions 1 and 2, in a zip or in a folder. Reference: the SOG page of the `PlayCanvas` user manual; version 1 as the
//! engine's parser reads it.
//!
//! Enters: `meta.json` and its pictures. Leaves: Gaussians. A texel of each picture belongs to one Gaussian, row by row.

mod decode;
mod meta;
mod pictures;

use std::path::Path;

use super::decoded::DecodedScene;
use super::error::SceneError;
use super::source_file::SourceFile;
use super::up::UpPrior;
use meta::Meta;
use pictures::Files;

/// Gaussians of a bundle.
///
/// # Errors
/// [`SceneError`] of the `SOG-*` kinds, and the caps.
pub(super) fn read_bundle(source: &SourceFile) -> Result<DecodedScene, SceneError> {
    let mut files = Files::in_zip(source)?;
    let meta = Meta::parse(source, &files.meta(source)?)?;
    read(source, &meta, &mut files, "bundled")
}

/// Gaussians of a folder, whose `meta.json` the source is.
///
/// # Errors
/// [`SceneError`] of the `SOG-*` kinds, and the caps.
pub(super) fn read_unbundled(source: &SourceFile) -> Result<DecodedScene, SceneError> {
    let meta = Meta::parse(source, source.bytes)?;
    let folder = source.path.parent().unwrap_or(Path::new(""));
    read(source, &meta, &mut Files::Folder(folder.to_path_buf()), "unbundled")
}

fn read(source: &SourceFile, meta: &Meta, files: &mut Files, wrapping: &str) -> Result<DecodedScene, SceneError> {
    let count = source.check_count(meta.count)?;
    let mut collected = decode::decode(source, meta, files, count)?;
    collected.notes.extend(meta.notes.iter().cloned());
    Ok(DecodedScene {
        format: format!("sog v{} ({wrapping})", meta.version),
        collected,
        filter: meta.filter,
        up: None,
        up_prior: UpPrior::PlyFrame,
    })
}

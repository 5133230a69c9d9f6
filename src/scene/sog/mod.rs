//! SOG, versions 1 and 2, in a zip archive or in a folder.
//!
//! Enters: `meta.json` and its pictures. Leaves: Gaussians. Invariant: texel i of a picture, row by row, belongs to
//! Gaussian i. Reference: the SOG page of the `PlayCanvas` user manual; version 1 follows the engine's parser.

mod decode;
mod meta;
mod pictures;

use std::path::Path;

use super::decoded::DecodedScene;
use super::error::SceneError;
use super::source_file::SourceFile;
use super::up::UpPrior;
use meta::Meta;
use pictures::PictureFiles;

/// Gaussians of a bundle, which is a zip archive.
///
/// # Errors
/// [`SceneError`] with a `SOG-*` code, and those of the limits.
pub(super) fn read_bundle(source: &SourceFile) -> Result<DecodedScene, SceneError> {
    let mut files = PictureFiles::in_zip(source)?;
    let meta = Meta::parse(source, &files.meta(source)?)?;
    read(source, &meta, &mut files, "bundled")
}

/// Gaussians of a folder; the source is its `meta.json`.
///
/// # Errors
/// [`SceneError`] with a `SOG-*` code, and those of the limits.
pub(super) fn read_unbundled(source: &SourceFile) -> Result<DecodedScene, SceneError> {
    let meta = Meta::parse(source, source.bytes)?;
    let folder = source.path.parent().unwrap_or(Path::new(""));
    read(source, &meta, &mut PictureFiles::Folder(folder.to_path_buf()), "unbundled")
}

fn read(
    source: &SourceFile,
    meta: &Meta,
    files: &mut PictureFiles,
    container: &str,
) -> Result<DecodedScene, SceneError> {
    let count = source.check_count(meta.count)?;
    let mut collected = decode::decode(source, meta, files, count)?;
    collected.notes.extend(meta.notes.iter().cloned());
    Ok(DecodedScene {
        format: format!("sog v{} ({container})", meta.version),
        collected,
        filter: meta.filter,
        up: None,
        up_prior: UpPrior::PlyFrame,
    })
}

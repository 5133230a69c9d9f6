//! One SOG, in a zip archive or in a folder.

use std::path::Path;

use super::decode::decode;
use super::meta::Meta;
use super::pictures::PictureFiles;
use crate::decoded::DecodedScene;
use crate::error::SceneError;
use crate::source_file::SourceFile;

/// Gaussians of a bundle, which is a zip archive.
///
/// # Errors
/// [`SceneError`] with a `SOG-*` code, and those of the limits.
pub(crate) fn read_bundle(source: &SourceFile) -> Result<DecodedScene, SceneError> {
    let mut files = PictureFiles::in_zip(source)?;
    let meta = Meta::parse(source, &files.meta(source)?)?;
    read(source, &meta, files, "bundled")
}

/// Gaussians of a folder; the source is its `meta.json`.
///
/// # Errors
/// [`SceneError`] with a `SOG-*` code, and those of the limits.
pub(crate) fn read_unbundled(source: &SourceFile) -> Result<DecodedScene, SceneError> {
    let meta = Meta::parse(source, source.bytes)?;
    let folder = source.path.parent().unwrap_or(Path::new(""));
    read(source, &meta, PictureFiles::in_folder(folder), "unbundled")
}

fn read(
    source: &SourceFile,
    meta: &Meta,
    mut files: PictureFiles,
    container: &str,
) -> Result<DecodedScene, SceneError> {
    let count = source.check_count(meta.count)?;
    let mut collected = decode(source, meta, &mut files, count)?;
    collected.notes.extend(meta.notes.iter().cloned());
    Ok(DecodedScene {
        format: format!("sog v{} ({container})", meta.version),
        collected,
        filter: meta.filter,
        up: None,
        further_sha256: files.into_sha256(),
    })
}

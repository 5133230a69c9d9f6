//! SOG, versions 1 and 2, in a zip or in a folder. Reference: the SOG page of the `PlayCanvas` user manual; version 1 as the
//! engine's parser reads it.
//!
//! Enters: `meta.json` and its pictures. Leaves: Gaussians. A texel of each picture belongs to one Gaussian, row by row.

mod decode;
mod meta;
mod pictures;

use std::path::Path;

use super::SceneError;
use super::load::{Decoded, Source};
use super::up::UpPrior;
use meta::Meta;
use pictures::Files;

/// Gaussians of a bundle.
///
/// # Errors
/// [`SceneError`] of the `SOG-*` kinds, and the caps.
pub(super) fn read_bundle(source: &Source) -> Result<Decoded, SceneError> {
    let mut files = Files::in_zip(source)?;
    let meta = Meta::parse(source, &files.meta(source)?)?;
    read(source, &meta, &mut files, "bundled")
}

/// Gaussians of a folder, whose `meta.json` the source is.
///
/// # Errors
/// [`SceneError`] of the `SOG-*` kinds, and the caps.
pub(super) fn read_unbundled(source: &Source) -> Result<Decoded, SceneError> {
    let meta = Meta::parse(source, source.bytes)?;
    let folder = source.path.parent().unwrap_or(Path::new(""));
    read(source, &meta, &mut Files::Folder(folder.to_path_buf()), "unbundled")
}

fn read(source: &Source, meta: &Meta, files: &mut Files, wrapping: &str) -> Result<Decoded, SceneError> {
    let count = source.check_count(meta.count)?;
    let mut collected = decode::decode(source, meta, files, count)?;
    collected.notes.extend(meta.notes.iter().cloned());
    Ok(Decoded {
        format: format!("sog v{} ({wrapping})", meta.version),
        collected,
        filter: meta.filter,
        up: None,
        up_prior: UpPrior::PlyFrame,
    })
}

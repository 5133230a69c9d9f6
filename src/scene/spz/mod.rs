//! SPZ, versions 1 to 4.
//!
//! Enters: bytes, plain, in gzip (versions 1-3) or as Zstandard streams (version 4). Leaves: Gaussians. Invariant: the
//! coordinates are those of the file, no axis is flipped. Reference: nianticlabs/spz README.md and `load-spz.cc`.

mod attributes;
mod container;
mod extensions;
mod flags;

use super::decoded::DecodedScene;
use super::error::SceneError;
use super::filter::SplatFilter;
use super::source_file::SourceFile;
use container::Container;
use flags::{ANTIALIASED, HAS_EXTENSIONS};

/// Gaussians of an SPZ.
///
/// # Errors
/// [`SceneError`] with an `SPZ-*` code, [`SceneError::NotReadYet`] for a level-of-detail tree, and those of the limits.
pub(super) fn read(source: &SourceFile) -> Result<DecodedScene, SceneError> {
    let container = Container::open(source)?;
    let header = container.header;
    let mut collected = attributes::decode(source, &container)?;
    collected.notes.extend(container.notes.iter().cloned());
    if header.sh_degree > 3 {
        collected.notes.push("spherical harmonics of degree 4 are truncated to degree 3".to_owned());
    }
    let unknown = header.flags & !(ANTIALIASED | HAS_EXTENSIONS);
    if unknown != 0 {
        collected.notes.push(format!("header flags {unknown:#04x} are unknown and ignored"));
    }
    let found = extensions::read(&container.extensions);
    collected.notes.extend(found.notes);
    Ok(DecodedScene {
        format: format!("spz v{}", header.version),
        collected,
        // A cleared flag states no filter: writers without antialiasing support leave it cleared.
        filter: (header.flags & ANTIALIASED != 0).then_some(SplatFilter::Mip),
        up: found.up,
        further_sha256: Vec::new(),
    })
}

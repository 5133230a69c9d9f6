//! SPZ versions 1 to 4. Reference: nianticlabs/spz README.md and `load-spz.cc`.
//!
//! Enters: bytes, plain, gzipped (versions 1-3) or as Zstandard streams (version 4). Leaves: Gaussians, in the numbers
//! that the file holds: no axis is flipped.

mod attributes;
mod container;
mod extensions;
mod flags;

use super::decoded::DecodedScene;
use super::error::SceneError;
use super::filter::SplatFilter;
use super::source_file::SourceFile;
use super::up::UpPrior;
use container::Container;
use flags::{ANTIALIASED, HAS_EXTENSIONS};

/// Gaussians of an SPZ.
///
/// # Errors
/// [`SceneError`] of the `SPZ-*` kinds, [`SceneError::NotReadYet`] for level-of-detail trees, and the caps.
pub(super) fn read(source: &SourceFile) -> Result<DecodedScene, SceneError> {
    let container = Container::open(source)?;
    let header = container.header;
    let mut collected = attributes::decode(source, &container)?;
    collected.notes.extend(container.notes.iter().cloned());
    if header.sh_degree > 3 {
        collected.notes.push("spherical harmonics of degree 4 are cut to degree 3".to_owned());
    }
    let unknown = header.flags & !(ANTIALIASED | HAS_EXTENSIONS);
    if unknown != 0 {
        collected.notes.push(format!("header flags {unknown:#04x} are not known and not heeded"));
    }
    let found = extensions::read(&container.extensions);
    collected.notes.extend(found.notes);
    Ok(DecodedScene {
        format: format!("spz v{}", header.version),
        collected,
        // A flag that is not set says nothing: writers that know no antialiasing leave it so.
        filter: (header.flags & ANTIALIASED != 0).then_some(SplatFilter::Mip),
        up: found.up,
        up_prior: UpPrior::Spz,
    })
}

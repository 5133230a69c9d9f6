//! PLY: the header, rows of any layout, and the two kinds of PLY that hold Gaussians.
//!
//! Enters: bytes. Leaves: Gaussians. Invariant: every iteration over rows consumes bytes or ends in an error, and every
//! count of the header is checked against the bytes that are present. Reference: Turk, "The PLY Polygon File Format", 1994;
//! properties as graphdeco-inria/gaussian-splatting `scene/gaussian_model.py` writes them.

mod comments;
mod compressed;
mod header;
mod inria;
mod rows;
mod write;

pub use write::write_ply;

use super::decoded::DecodedScene;
use super::error::SceneError;
use super::source_file::SourceFile;

/// Gaussians of a PLY. The elements of the header decide between INRIA's kind and the compressed kind of `PlayCanvas`.
///
/// # Errors
/// [`SceneError`] with a `PLY-*` code, [`SceneError::TooManyGaussians`], [`SceneError::OutOfMemory`],
/// [`SceneError::Empty`].
pub(super) fn read(source: &SourceFile) -> Result<DecodedScene, SceneError> {
    let header = header::parse(source)?;
    if compressed::is_compressed(&header) { compressed::read(source, &header) } else { inria::read(source, &header) }
}

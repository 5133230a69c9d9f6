//! PLY: header grammar, rows of any layout, and the two kinds of PLY that hold Gaussians.
//!
//! Enters: bytes. Leaves: Gaussians. Every loop over rows either consumes bytes or ends in an error, and no count of
//! the header is believed before the bytes for it are seen. Reference: Turk, "The PLY Polygon File Format", 1994;
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

/// Gaussians of a PLY, INRIA's or `PlayCanvas`'s compressed kind, told apart by their elements.
///
/// # Errors
/// [`SceneError`] of the `PLY-*` kinds, and `SCENE-EMPTY`.
pub(super) fn read(source: &SourceFile) -> Result<DecodedScene, SceneError> {
    let header = header::parse(source)?;
    if compressed::is_compressed(&header) { compressed::read(source, &header) } else { inria::read(source, &header) }
}

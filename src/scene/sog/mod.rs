//! SOG, versions 1 and 2, in a zip archive, in a folder, or as a tree of several with levels of detail.
//!
//! Enters: `meta.json` and its pictures. Leaves: Gaussians. Invariant: texel i of a picture, row by row, belongs to
//! Gaussian i. Reference: the SOG page of the `PlayCanvas` user manual; version 1 follows the engine's parser.

mod decode;
mod meta;
mod pictures;
mod single;
mod streamed;

pub(super) use single::{read_bundle, read_unbundled};
pub(super) use streamed::read as read_streamed;

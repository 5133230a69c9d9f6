//! USD, text form (`.usda`): a camera with time samples of translation, rotation, focal length and focus distance.
//!
//! Cameras have OpenGL axes; lens and film back are in tenths of a unit of the scene, so that a stage with
//! `metersPerUnit = 1` reads them as mm / 100. A prim above the camera turns the scene's up to the stage's +y. Where the
//! shot cuts, a sample just before the cut holds the pose. Binary `.usdc` is not read.

mod parse;
mod read;
mod write;

pub(super) use read::read;
pub(super) use write::write;

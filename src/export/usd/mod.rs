//! USD: a camera with time samples of translation, rotation, focal length and focus distance. The text form (`.usda`),
//! the binary form (`.usdc`) and packages (`.usdz`) of either are read, the text form is written.
//!
//! Cameras have OpenGL axes. Focal length and film back are in tenths of a scene unit. A prim above the camera rotates
//! the scene's up to the stage's +y. A sample just before a cut holds the pose up to the cut.

mod binary;
mod curves;
mod layer;
mod package;
mod parse;
mod read;
mod write;

pub(super) use package::is_package;
pub(super) use read::read;
pub(super) use write::write;

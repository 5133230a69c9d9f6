//! glTF 2.0: one camera with animated translation, rotation and (through `KHR_animation_pointer`) field of view.
//!
//! Cameras have OpenGL axes, and the world has +y up. A node above the camera rotates the scene's up to +y. Its
//! `extras` state the scene's up, so that a file written here reads back in the scene's own world. Key times and values
//! are f32, as the format requires. An additional key just before a cut holds the pose up to the cut.

mod accessor;
mod channel;
mod constants;
mod nodes;
mod read;
mod rigid;
mod write;

pub(super) use read::read;
pub(super) use write::{write_binary, write_text};

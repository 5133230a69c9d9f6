//! glTF 2.0: one camera with animated translation, rotation and (through `KHR_animation_pointer`) field of view.
//!
//! Cameras have OpenGL axes, the world +y up: a node above the camera turns the scene's up there, and says in its
//! `extras` which direction that was, so that a file written here reads back in the scene's own world. Key times and
//! values are f32, as the format asks. Where the shot cuts, a second key a hair before the cut holds the pose.

mod accessor;
mod base64;
mod constants;
mod read;
mod write;

pub(super) use read::read;
pub(super) use write::{write_binary, write_text};

//! COLMAP sparse models: `cameras`, `images` and an empty `points3D`, as text or binary.
//!
//! Poses in the files are `camera_from_world` with OpenCV camera axes, quaternions in the order w, x, y, z. Images are
//! read in order of their names. Reference: COLMAP's output format documentation.

mod binary;
mod model;
mod text;

pub(super) use binary::{read as read_binary, write as write_binary};
pub(super) use text::{read as read_text, write as write_text};

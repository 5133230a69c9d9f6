//! Readers of scenes, the up axis, and damaged files.

mod bombs;
mod bytes;
mod compressed;
mod faults;
mod inria;
mod intake;
mod other_formats;
mod shared_scenes;
mod sog;
mod splat;
mod spz;
mod up;
mod write;

use std::path::Path;

use cinesplat::scene::{LoadOptions, Scene, SceneError, load_bytes};

/// Loads a file that is in memory, with default limits.
fn read(name: &str, bytes: &[u8]) -> Result<Scene, SceneError> {
    load_bytes(Path::new(name), bytes, &LoadOptions::default())
}

/// The code of the error that a file must give.
fn code(name: &str, bytes: &[u8]) -> &'static str {
    match read(name, bytes) {
        Ok(scene) => panic!("{name} loads as {} with {} Gaussians", scene.format, scene.gaussians.len()),
        Err(error) => error.code(),
    }
}

//! What several test files need: the shared data folder, and a line that says so where it is absent; a shot over keys.

use std::path::{Path, PathBuf};

use cinesplat::trajectory::{Keyframe, SceneRef, Shot};
use glam::DVec3;

/// A file or folder of `../shared`, or `None` (with a line on stderr) where this machine has no such folder.
pub fn shared(relative: &str) -> Option<PathBuf> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared").join(relative);
    let found = path.exists();
    if !found {
        eprintln!("skipped: ../shared/{relative} is not on this machine");
    }
    found.then_some(path)
}

/// A shot over keys that ends with the last one, in a world whose up is +y.
pub fn shot_over(keyframes: Vec<Keyframe>) -> Shot {
    Shot {
        scene: SceneRef { up: Some(DVec3::Y), ..SceneRef::default() },
        prompt: String::new(),
        seed: 0,
        model: None,
        width: 640,
        height: 360,
        fps: 30.0,
        duration_secs: keyframes.last().map_or(0.0, |key| key.time_secs),
        keyframes,
        effects: Vec::new(),
        report: Vec::new(),
        clearance: None,
    }
}

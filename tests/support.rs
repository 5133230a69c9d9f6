//! Shared by several areas: the optional data folder, the corpus, the line that reports a skipped test, a shot over keys.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use cinesplat::training::corpus::{Writer, read_folder};
use cinesplat::trajectory::{Keyframe, SceneRef, Shot};
use glam::DVec3;

/// A file or folder of `../shared`; `None`, with a line on stderr, on a machine without that folder.
///
/// # Panics
/// Panics if the folder is there and the file is not: a renamed file must not turn its tests off.
pub fn shared(relative: &str) -> Option<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared");
    if !folder.exists() {
        report_skip(&format!("../shared/{relative}"));
        return None;
    }
    let path = folder.join(relative);
    assert!(path.exists(), "{} is missing", path.display());
    Some(path)
}

/// The writers of the corpus, read once: it takes seconds.
pub fn corpus() -> &'static [Writer] {
    static CORPUS: LazyLock<Vec<Writer>> =
        LazyLock::new(|| read_folder(&Path::new(env!("CARGO_MANIFEST_DIR")).join("prompts/corpus")).unwrap());
    &CORPUS
}

/// Says on stderr that the running test is skipped, or a part of it, and what it lacks.
///
/// Writes to the stream itself: `cargo test` captures `eprintln!` and would hide the line of a test that passes.
pub fn report_skip(lacking: &str) {
    let thread = std::thread::current();
    let test = thread.name().unwrap_or("a test");
    let mut stderr = std::io::stderr();
    writeln!(stderr, "skipped {test}: no {lacking} on this machine").unwrap();
}

/// A shot over keys that ends with the last one, in a world whose up is +y.
pub fn shot_over(keyframes: Vec<Keyframe>) -> Shot {
    let duration_secs = keyframes.last().map_or(0.0, |key| key.time_secs);
    let scene = SceneRef { up: Some(DVec3::Y), ..SceneRef::default() };
    Shot { scene, ..Shot::from_keyframes([640, 360], 30.0, duration_secs, keyframes) }
}

//! What several test files need: the shared data folder, and a line that says so where it is absent.

use std::path::{Path, PathBuf};

/// A file or folder of `../shared`, or `None` (with a line on stderr) where this machine has no such folder.
pub fn shared(relative: &str) -> Option<PathBuf> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared").join(relative);
    let found = path.exists();
    if !found {
        eprintln!("skipped: ../shared/{relative} is not on this machine");
    }
    found.then_some(path)
}

//! Temporary files that are being written, so that a program that ends without dropping its values can remove them.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Files that are listed at once; further ones are not.
const MAX_LISTED: usize = 64;

/// Nothing allocates while this is locked: the allocator itself may ask for the list when memory runs out.
static LISTED: Mutex<[Option<PathBuf>; MAX_LISTED]> = Mutex::new([const { None }; MAX_LISTED]);

/// The place of a file in the list; the file leaves it when this value is dropped.
#[derive(Debug)]
pub(crate) struct Listed(Option<usize>);

impl Listed {
    /// Lists a temporary file.
    pub(crate) fn new(path: &Path) -> Self {
        let path = path.to_owned();
        let mut listed = lock();
        let free_idx = listed.iter().position(Option::is_none);
        if let Some(idx) = free_idx {
            listed[idx] = Some(path);
        }
        Self(free_idx)
    }
}

impl Drop for Listed {
    fn drop(&mut self) {
        let path = self.0.and_then(|idx| lock()[idx].take());
        // Freed when the list is unlocked again.
        drop(path);
    }
}

/// Removes the temporary files that are being written. Call it only right before the program ends: what still writes to
/// them cannot give them their names.
pub fn remove_open_files() {
    for idx in 0..MAX_LISTED {
        let path = lock()[idx].take();
        // A file that is gone already needs no removal, and nobody is left to hear of another error.
        let _ = path.map(fs::remove_file);
    }
}

fn lock() -> MutexGuard<'static, [Option<PathBuf>; MAX_LISTED]> {
    LISTED.lock().unwrap_or_else(PoisonError::into_inner)
}

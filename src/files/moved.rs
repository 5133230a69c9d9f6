use std::fs::{self, File};
use std::io::{self, ErrorKind};
use std::path::Path;

use tempfile::TempPath;

use crate::disk::sync_folder;
use crate::new_file::is_special;
use crate::paths::folder_of;
use crate::{Existing, FileError};

/// Gives a finished file its name, on the same disk. A target that is no regular file (`/dev/stdout`, a FIFO) gets the bytes
/// instead, and the file is removed.
///
/// # Errors
/// [`FileError::Exists`], [`FileError::Write`], both about `to`. The file stays where it is then.
pub fn move_file(from: &Path, to: &Path, existing: Existing) -> Result<(), FileError> {
    if is_special(to) {
        return copy(from, to).map_err(|source| FileError::Write { path: to.to_owned(), source });
    }
    let moved = match existing {
        Existing::Replace => fs::rename(from, to),
        Existing::Keep => rename_to_free(from, to),
    };
    moved.map_err(|source| match source.kind() {
        ErrorKind::AlreadyExists => FileError::Exists { path: to.to_owned() },
        _ => FileError::Write { path: to.to_owned(), source },
    })?;
    sync_folder(folder_of(to))
}

/// Renames in one step that fails where the name is taken.
fn rename_to_free(from: &Path, to: &Path) -> io::Result<()> {
    TempPath::try_from_path(from)?.persist_noclobber(to).map_err(|mut refused| {
        // Dropping it would remove the file.
        refused.path.disable_cleanup(true);
        refused.error
    })
}

fn copy(from: &Path, to: &Path) -> io::Result<()> {
    io::copy(&mut File::open(from)?, &mut File::options().write(true).open(to)?)?;
    fs::remove_file(from)
}

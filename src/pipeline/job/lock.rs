use std::fs::{self, File, TryLockError};
use std::io::ErrorKind;
use std::path::Path;

use cinesplat_files::{FileError, folder_of, sync_folder};

use super::error::JobError;

/// Who else may work on a job folder.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Access {
    /// Nobody.
    Alone,
    /// Other programs that render parts of the same film.
    Shared,
}

/// Makes a job folder where there is none.
pub(super) fn make_folder(folder: &Path) -> Result<(), JobError> {
    match fs::create_dir(folder) {
        Err(_) if folder.is_dir() => Ok(()),
        Ok(()) => Ok(sync_folder(folder_of(folder))?),
        Err(source) => Err(FileError::Create { path: folder.to_owned(), source }.into()),
    }
}

/// The lock of the folder, held until the file is closed.
pub(super) fn locked(folder: &Path, access: Access) -> Result<File, JobError> {
    let path = folder.join("lock");
    let opened = File::options().create(true).append(true).open(&path);
    let file = opened.map_err(|source| FileError::Create { path: path.clone(), source })?;
    let taken = match access {
        Access::Alone => file.try_lock(),
        Access::Shared => file.try_lock_shared(),
    };
    match taken {
        Ok(()) => Ok(file),
        Err(TryLockError::WouldBlock) => Err(JobError::Locked { path: folder.to_owned() }),
        // Some shared disks have no locks. Two programs then do work twice, and write the same bytes.
        Err(TryLockError::Error(error)) if error.kind() == ErrorKind::Unsupported => Ok(file),
        Err(TryLockError::Error(source)) => Err(FileError::Write { path, source }.into()),
    }
}

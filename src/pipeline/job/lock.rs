use std::fs::{self, File, TryLockError};
use std::path::Path;
use std::sync::Arc;
use std::time::SystemTime;

use cinesplat_files::{FileError, folder_of, has_no_locks, sync_folder};

use super::access::Access;
use super::error::JobError;
use super::holders::{Holder, Sign, has_rival};

/// The right to work on a job folder. It ends with this value, or with the program.
pub(super) struct Lock {
    /// It goes before the lock of the system does: who gets that finds no file.
    holder: Option<Holder>,
    sign: Arc<Sign>,
    /// Unlocked when it is closed, which the system does even for a killed program.
    _file: File,
}

impl Lock {
    /// Tells whether the right was lost.
    pub(super) fn sign(&self) -> &Arc<Sign> {
        &self.sign
    }

    /// Removes the files of this program and of those that are gone: the folder is about to be removed.
    pub(super) fn withdraw(&mut self) {
        if let Some(holder) = self.holder.take() {
            holder.remove_gone();
        }
    }
}

/// Makes a job folder where there is none.
pub(super) fn make_folder(folder: &Path) -> Result<(), JobError> {
    match fs::create_dir(folder) {
        Err(_) if folder.is_dir() => Ok(()),
        Ok(()) => Ok(sync_folder(folder_of(folder))?),
        Err(source) => Err(FileError::Create { path: folder.to_owned(), source }.into()),
    }
}

/// The lock of the folder, and a file that stands for it: programs from elsewhere may find no locks on this disk.
///
/// # Errors
/// [`JobError::Locked`], [`JobError::File`].
pub(super) fn locked(folder: &Path, access: Access) -> Result<Lock, JobError> {
    let file = lock_of_system(folder, access)?;
    let holder = Holder::announce(folder, access)?;
    Ok(Lock { sign: Arc::clone(holder.sign()), holder: Some(holder), _file: file })
}

/// Looks whether the folder could be locked; `now` is the clock of its disk.
///
/// # Errors
/// As [`locked`].
pub(super) fn check_lock(folder: &Path, access: Access, now: SystemTime) -> Result<(), JobError> {
    let _file = lock_of_system(folder, access)?;
    if has_rival(folder, access, now, None)? {
        return Err(JobError::Locked { path: folder.to_owned() });
    }
    Ok(())
}

/// The lock file, locked where the disk has locks.
fn lock_of_system(folder: &Path, access: Access) -> Result<File, JobError> {
    let path = folder.join("lock");
    // NFS gives a shared lock only on a file that is open for reading.
    let opened = File::options().create(true).read(true).append(true).open(&path);
    let file = opened.map_err(|source| FileError::Create { path: path.clone(), source })?;
    let taken = match access {
        Access::Alone => file.try_lock(),
        Access::Shared => file.try_lock_shared(),
    };
    match taken {
        Ok(()) => Ok(file),
        Err(TryLockError::WouldBlock) => Err(JobError::Locked { path: folder.to_owned() }),
        Err(TryLockError::Error(error)) if has_no_locks(&error) => Ok(file),
        Err(TryLockError::Error(source)) => Err(FileError::Write { path, source }.into()),
    }
}

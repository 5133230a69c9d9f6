use std::fs::File;
use std::path::Path;

use crate::FileError;

/// Flushes the data of a file to the disk.
///
/// # Errors
/// [`FileError::Write`]
pub fn sync_file(path: &Path) -> Result<(), FileError> {
    let synced = File::open(path).and_then(|file| file.sync_data());
    synced.map_err(|source| FileError::Write { path: path.to_owned(), source })
}

/// Asks the system to start writing the data of a file to the disk, and does not wait for it: many files that are
/// flushed after that wait for the disk once, not once each. Does nothing where the system knows no such request. What
/// fails is reported by [`sync_file`].
pub fn start_sync(path: &Path) {
    #[cfg(target_os = "linux")]
    if let Ok(file) = File::open(path) {
        // "Not needed" writes what the disk lacks, and then frees what it has: nothing is lost by either.
        let _ = rustix::fs::fadvise(&file, 0, None, rustix::fs::Advice::DontNeed);
    }
    #[cfg(not(target_os = "linux"))]
    let _ = path;
}

/// Flushes the names in a folder to the disk. Does nothing on systems where a folder cannot be opened.
///
/// # Errors
/// [`FileError::Write`]
pub fn sync_folder(folder: &Path) -> Result<(), FileError> {
    if cfg!(unix) {
        let synced = File::open(folder).and_then(|folder| folder.sync_all());
        return synced.or_else(refused_by_kind).map_err(|source| FileError::Write { path: folder.to_owned(), source });
    }
    Ok(())
}

/// Some file systems cannot flush a folder and say that the call makes no sense; a folder without the right to read it
/// cannot be opened. Neither loses data that was written.
fn refused_by_kind(error: std::io::Error) -> std::io::Result<()> {
    use std::io::ErrorKind as Kind;
    match error.kind() {
        Kind::InvalidInput | Kind::Unsupported | Kind::PermissionDenied => Ok(()),
        _ => Err(error),
    }
}

/// Whether the error of a lock says that this file system has none, as some network disks do.
pub fn has_no_locks(error: &std::io::Error) -> bool {
    #[cfg(unix)]
    if let Some(errno) = rustix::io::Errno::from_io_error(error) {
        use rustix::io::Errno;
        return [Errno::NOLCK, Errno::NOSYS, Errno::OPNOTSUPP, Errno::NOTSUP].contains(&errno);
    }
    error.kind() == std::io::ErrorKind::Unsupported
}

/// Bytes that a new file in this folder may take; `None` where the system does not say.
pub fn free_bytes(folder: &Path) -> Option<u64> {
    #[cfg(unix)]
    {
        let found = rustix::fs::statvfs(folder).ok()?;
        Some(found.f_bavail.saturating_mul(found.f_frsize))
    }
    #[cfg(not(unix))]
    {
        let _ = folder;
        None
    }
}

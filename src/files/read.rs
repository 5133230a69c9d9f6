use std::fs::{self, File, FileType};
use std::io::Read;
use std::path::Path;

use crate::FileError;

/// All bytes of a regular file of at most `max_bytes` bytes.
///
/// # Errors
/// [`FileError::NotAFile`] for folders, FIFOs, sockets and devices, which may never end; [`FileError::TooLarge`] above
/// `max_bytes`, or where the memory for the file cannot be had; [`FileError::Read`] for faults of the file system.
pub fn read(path: &Path, max_bytes: u64) -> Result<Vec<u8>, FileError> {
    let failed = |source| FileError::Read { path: path.to_owned(), source };
    // Checked before opening, because opening a FIFO waits for a writer.
    let metadata = fs::metadata(path).map_err(failed)?;
    if !metadata.is_file() {
        return Err(FileError::NotAFile { path: path.to_owned(), found: kind_name(metadata.file_type()) });
    }
    let too_large = |found| FileError::TooLarge { path: path.to_owned(), found, expected: max_bytes };
    if metadata.len() > max_bytes {
        return Err(too_large(metadata.len()));
    }
    let mut bytes = Vec::new();
    if bytes.try_reserve_exact(metadata.len() as usize + 1).is_err() {
        return Err(too_large(metadata.len()));
    }
    // The file may grow while it is read.
    let mut bounded = File::open(path).map_err(failed)?.take(max_bytes.saturating_add(1));
    bounded.read_to_end(&mut bytes).map_err(failed)?;
    if bytes.len() as u64 > max_bytes { Err(too_large(bytes.len() as u64)) } else { Ok(bytes) }
}

/// Name of what a path is, with its article.
fn kind_name(kind: FileType) -> &'static str {
    if kind.is_dir() {
        return "a folder";
    }
    #[cfg(unix)]
    {
        use std::os::unix::fs::FileTypeExt;
        if kind.is_fifo() {
            return "a pipe";
        }
        if kind.is_socket() {
            return "a socket";
        }
    }
    "a device"
}

use std::fs::{File, TryLockError};
use std::path::Path;

use cinesplat_files::{FileError, create_folder, has_no_locks};

use super::error::JobError;

/// The right to render a frame. It ends with this value, or with the program that holds it.
pub(crate) struct Claim {
    _lock: File,
}

/// Claims a frame; `None` if another program has it.
///
/// Claims save work and nothing depends on them: two programs that render one frame write the same bytes.
pub(super) fn claim(folder: &Path, frame_idx: usize) -> Result<Option<Claim>, JobError> {
    let claims = folder.join("claims");
    create_folder(&claims)?;
    let path = claims.join(format!("{frame_idx:06}"));
    let opened = File::options().create(true).append(true).open(&path);
    let file = opened.map_err(|source| FileError::Create { path: path.clone(), source })?;
    match file.try_lock() {
        Ok(()) => Ok(Some(Claim { _lock: file })),
        Err(TryLockError::WouldBlock) => Ok(None),
        // On a disk without locks the programs of a farm meet only where one reaches the place that another began at.
        Err(TryLockError::Error(error)) if has_no_locks(&error) => Ok(Some(Claim { _lock: file })),
        Err(TryLockError::Error(source)) => Err(FileError::Write { path, source }.into()),
    }
}

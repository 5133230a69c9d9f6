use std::fs::{self, File};
use std::io::Read;
use std::path::Path;

use super::error::SceneError;
use super::options::LoadOptions;

/// A file in memory, with its path for errors and the limits of reading.
#[derive(Clone, Copy)]
pub(super) struct SourceFile<'a> {
    /// The path as the caller gave it.
    pub(super) path: &'a Path,
    /// Content of the file.
    pub(super) bytes: &'a [u8],
    /// Limits of reading.
    pub(super) options: &'a LoadOptions,
}

impl SourceFile<'_> {
    /// `found` as a count, if the limits allow that many Gaussians.
    ///
    /// # Errors
    /// [`SceneError::TooManyGaussians`] when they do not.
    pub(super) fn check_count(&self, found: u64) -> Result<usize, SceneError> {
        let cap = self.options.max_gaussians.min(u32::MAX as usize) as u64;
        if found > cap {
            return Err(SceneError::TooManyGaussians { path: self.path.to_path_buf(), found, cap });
        }
        Ok(found as usize)
    }
}

/// Content of a regular file of at most `cap` bytes.
///
/// # Errors
/// [`SceneError::NotAFile`] for pipes and devices, which may never end; [`SceneError::TooManyBytes`] above `cap`;
/// [`SceneError::NotFound`], [`SceneError::Permission`] or [`SceneError::Io`] for faults of the file system.
pub(super) fn read_file(path: &Path, cap: u64) -> Result<Vec<u8>, SceneError> {
    let failed = |source| SceneError::from_io(path, source);
    // Checked before opening, because opening a pipe waits for a writer.
    let metadata = fs::metadata(path).map_err(failed)?;
    if !metadata.is_file() {
        return Err(SceneError::NotAFile { path: path.to_path_buf() });
    }
    let too_many = |found| SceneError::TooManyBytes { path: path.to_path_buf(), found, cap };
    if metadata.len() > cap {
        return Err(too_many(metadata.len()));
    }
    let mut bytes = Vec::new();
    if bytes.try_reserve_exact(metadata.len() as usize + 1).is_err() {
        return Err(too_many(metadata.len()));
    }
    let file = File::open(path).map_err(failed)?;
    file.take(cap.saturating_add(1)).read_to_end(&mut bytes).map_err(failed)?;
    if bytes.len() as u64 > cap { Err(too_many(bytes.len() as u64)) } else { Ok(bytes) }
}

use std::io;
use std::path::Path;

use super::error::SceneError;
use super::options::LoadOptions;
use cinesplat_files::FileError;

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
    cinesplat_files::read(path, cap).map_err(|error| match error {
        FileError::NotAFile { path, .. } => SceneError::NotAFile { path },
        FileError::TooLarge { path, found, .. } => SceneError::TooManyBytes { path, found, cap },
        FileError::Read { source, .. } => SceneError::from_io(path, source),
        other => SceneError::from_io(path, io::Error::other(other)),
    })
}

use std::io;
use std::path::Path;

use glam::{DVec3, Vec3};

use super::error::SceneError;
use super::gaussians::NUM_SH_REST;
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
    /// Bytes of memory that the scene's other files take already.
    pub(super) held_bytes: u64,
}

impl SourceFile<'_> {
    /// `found` as a count, if the limits allow that many Gaussians.
    ///
    /// # Errors
    /// [`SceneError::TooManyGaussians`] when they do not.
    pub(super) fn check_count(&self, found: u64) -> Result<usize, SceneError> {
        let cap = self.options.limits.gaussians.min(u32::MAX as usize) as u64;
        if found > cap {
            return Err(SceneError::TooManyGaussians { path: self.path.to_path_buf(), found, cap });
        }
        Ok(found as usize)
    }

    /// Checks, before anything is allocated, the memory for `count` Gaussians of a degree, the scene's files, and
    /// `unpacked_bytes`.
    ///
    /// # Errors
    /// [`SceneError::OutOfMemory`] when the limits forbid that much.
    pub(super) fn check_memory(&self, count: usize, sh_degree: u8, unpacked_bytes: u64) -> Result<(), SceneError> {
        let held = (self.bytes.len() as u64).saturating_add(unpacked_bytes).saturating_add(self.held_bytes);
        let needed_bytes = collected_bytes(count, sh_degree).saturating_add(held);
        if needed_bytes > self.options.limits.memory_bytes {
            let (path, limit_bytes) = (self.path.to_path_buf(), self.options.limits.memory_bytes);
            Err(SceneError::OutOfMemory { path, found: count as u64, needed_bytes, limit_bytes })
        } else {
            Ok(())
        }
    }

    /// The error for memory that the limits allow and the system has not.
    pub(super) fn no_memory(&self, count: usize, needed_bytes: u64) -> SceneError {
        SceneError::NoMemory { path: self.path.to_path_buf(), found: count as u64, needed_bytes }
    }
}

/// Bytes that `count` Gaussians of a degree take while they are collected: their columns, the means in both precisions, and
/// one column to find medians in.
pub(super) fn collected_bytes(count: usize, sh_degree: u8) -> u64 {
    let num_rest = NUM_SH_REST[usize::from(sh_degree.min(3))];
    let columns = size_of::<DVec3>() + (4 + num_rest) * size_of::<Vec3>() + size_of::<[f32; 5]>();
    (count as u64).saturating_mul((columns + size_of::<f64>()) as u64)
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

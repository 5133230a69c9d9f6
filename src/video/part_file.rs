use std::fs::{self, File};
use std::io::{self, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};

use super::VideoError;

/// A file under a passing name beside its target, which takes the target's name only when it is whole. Dropped before
/// that, it is removed.
#[derive(Debug)]
pub(super) struct PartFile {
    part: PathBuf,
    target: PathBuf,
    kept: bool,
}

impl PartFile {
    /// Creates `.NAME.PID.part` in the target's folder, empty.
    pub(super) fn create(target: &Path) -> Result<(Self, File), VideoError> {
        let mut name = std::ffi::OsString::from(".");
        name.push(target.file_name().unwrap_or_default());
        name.push(format!(".{}.part", std::process::id()));
        let part = target.with_file_name(name);
        let file = File::options().read(true).write(true).create(true).truncate(true).open(&part);
        let file = file.map_err(|source| VideoError::Create { path: target.to_owned(), source })?;
        Ok((Self { part, target: target.to_owned(), kept: false }, file))
    }

    /// The passing name.
    pub(super) fn path(&self) -> &Path {
        &self.part
    }

    /// Gives the file its name, or `target` in its place; what was there is replaced.
    pub(super) fn keep_as(mut self, target: Option<PathBuf>) -> Result<PathBuf, VideoError> {
        let target = target.unwrap_or_else(|| self.target.clone());
        let renamed = fs::rename(&self.part, &target);
        renamed.map_err(|source| VideoError::Io {
            action: "renaming the finished file",
            path: target.clone(),
            source,
        })?;
        self.kept = true;
        Ok(target)
    }
}

impl Drop for PartFile {
    fn drop(&mut self) {
        if !self.kept {
            // Nobody is left to tell when even this fails; the name says what the file is.
            let _ = fs::remove_file(&self.part);
        }
    }
}

/// The first error of a file that FFmpeg writes to: FFmpeg itself passes on only `EIO`.
pub(super) type FirstError = Arc<Mutex<Option<io::Error>>>;

/// A file that remembers its first error.
pub(super) struct WatchedFile {
    pub(super) file: File,
    pub(super) first_error: FirstError,
}

impl WatchedFile {
    fn watch<T>(&mut self, action: impl FnOnce(&mut File) -> io::Result<T>) -> io::Result<T> {
        action(&mut self.file).inspect_err(|error| {
            if let Ok(mut first) = self.first_error.lock() {
                let copy = error.raw_os_error().map_or_else(|| error.kind().into(), io::Error::from_raw_os_error);
                first.get_or_insert(copy);
            }
        })
    }
}

impl Write for WatchedFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.watch(|file| file.write(bytes))
    }

    fn flush(&mut self) -> io::Result<()> {
        self.watch(File::flush)
    }
}

impl Seek for WatchedFile {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        self.watch(|file| file.seek(to))
    }
}

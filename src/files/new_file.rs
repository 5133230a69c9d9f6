use std::fs::{self, File, Permissions};
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};

use tempfile::{Builder, NamedTempFile};

use crate::FileError;
use crate::disk::sync_folder;
use crate::open_files::Listed;
use crate::paths::folder_of;

/// What happens to a file that has the output's name already.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Existing {
    /// It stays, and writing fails.
    #[default]
    Keep,
    /// It is replaced once the new file is whole.
    Replace,
}

impl Existing {
    /// The choice behind a flag such as `--overwrite`.
    pub fn replace_if(overwrite: bool) -> Self {
        if overwrite { Self::Replace } else { Self::Keep }
    }
}

/// A file under a temporary name in the folder of its target. Committing it renames it to the target; dropping it before
/// that removes it.
///
/// A target that is no regular file (a device, a FIFO) is written directly, and so is a name of an open file such as
/// `/dev/stdout`, whatever that file is.
#[derive(Debug)]
pub struct NewFile {
    target: PathBuf,
    existing: Existing,
    content: Content,
}

#[derive(Debug)]
enum Content {
    Temporary { file: NamedTempFile, listed: Listed },
    Special(File),
}

impl NewFile {
    /// Creates the temporary file `.NAME.RANDOM.part`, empty.
    ///
    /// # Errors
    /// [`FileError::Exists`], [`FileError::Create`].
    pub fn create(target: &Path, existing: Existing) -> Result<Self, FileError> {
        let failed = |source| FileError::Create { path: target.to_owned(), source };
        let content = if is_special(target) {
            // What an open file holds already stays: that is what the shell's `>>` means.
            Content::Special(File::options().append(is_open_file(target)).write(true).open(target).map_err(failed)?)
        } else {
            check_free(target, existing)?;
            temporary(target, folder_of(target)).map_err(failed)?
        };
        Ok(Self { target: target.to_owned(), existing, content })
    }

    /// As [`NewFile::create`], with the temporary file in another folder on the same disk.
    ///
    /// # Errors
    /// As [`NewFile::create`].
    pub fn create_in(folder: &Path, target: &Path, existing: Existing) -> Result<Self, FileError> {
        check_free(target, existing)?;
        let made = temporary(target, folder).map_err(|source| FileError::Create { path: target.to_owned(), source })?;
        Ok(Self { target: target.to_owned(), existing, content: made })
    }

    /// The file, open for reading and writing.
    pub fn file(&self) -> &File {
        match &self.content {
            Content::Temporary { file, .. } => file.as_file(),
            Content::Special(file) => file,
        }
    }

    /// The temporary path; that of the target where it is a special file.
    pub fn path(&self) -> &Path {
        match &self.content {
            Content::Temporary { file, .. } => file.path(),
            Content::Special(_) => &self.target,
        }
    }

    /// Flushes the data to the disk, renames the file to its target in one step, and flushes the name.
    ///
    /// # Errors
    /// [`FileError::Exists`] if another program took the name meanwhile, [`FileError::Write`].
    pub fn commit(self) -> Result<(), FileError> {
        let Content::Temporary { file, .. } = &self.content else { return Ok(()) };
        let flushed = file.as_file().sync_all();
        flushed.map_err(|source| FileError::Write { path: self.target.clone(), source })?;
        let target = self.target.clone();
        self.commit_unflushed()?;
        sync_folder(folder_of(&target))
    }

    /// As [`NewFile::commit`] without flushing: the file survives the end of this program, but not that of the machine.
    ///
    /// # Errors
    /// As [`NewFile::commit`].
    pub fn commit_unflushed(self) -> Result<(), FileError> {
        let (target, Content::Temporary { file, listed }) = (self.target, self.content) else { return Ok(()) };
        let named = match self.existing {
            Existing::Replace => file.persist(&target),
            Existing::Keep => file.persist_noclobber(&target),
        };
        drop(listed);
        named.map(drop).map_err(|error| match error.error.kind() {
            ErrorKind::AlreadyExists => FileError::Exists { path: target },
            _ => FileError::Write { path: target, source: error.error },
        })
    }
}

/// Writes a file, which appears under its name with all its bytes or not at all.
///
/// # Errors
/// [`FileError::Exists`], [`FileError::Create`], [`FileError::Write`].
pub fn write(path: &Path, bytes: &[u8], existing: Existing) -> Result<(), FileError> {
    let new = NewFile::create(path, existing)?;
    new.file().write_all(bytes).map_err(|source| FileError::Write { path: path.to_owned(), source })?;
    new.commit()
}

/// Whether a file exists and holds exactly these bytes. A file that cannot be read holds others.
pub fn holds(path: &Path, bytes: &[u8]) -> bool {
    fs::metadata(path).is_ok_and(|found| found.is_file() && found.len() == bytes.len() as u64)
        && fs::read(path).is_ok_and(|found| found == bytes)
}

/// Creates a folder and those above it where they are missing.
///
/// # Errors
/// [`FileError::Create`].
pub fn create_folder(folder: &Path) -> Result<(), FileError> {
    fs::create_dir_all(folder).map_err(|source| FileError::Create { path: folder.to_owned(), source })
}

/// Checks before any work that a file can be created: its folder exists, its name is free or may be replaced.
///
/// # Errors
/// [`FileError::Exists`], [`FileError::Create`].
pub fn check_free(path: &Path, existing: Existing) -> Result<(), FileError> {
    let refuse =
        |kind, reason: &str| Err(FileError::Create { path: path.to_owned(), source: io::Error::new(kind, reason) });
    if path.is_dir() || path.as_os_str().as_encoded_bytes().ends_with(b"/") {
        return refuse(ErrorKind::IsADirectory, "it is a folder, expected a file name");
    }
    match fs::symlink_metadata(path) {
        Ok(_) if existing == Existing::Keep && !is_special(path) => {
            return Err(FileError::Exists { path: path.to_owned() });
        }
        Err(error) if error.kind() == ErrorKind::InvalidFilename => {
            return refuse(ErrorKind::InvalidFilename, "its name is longer than the file system allows");
        }
        _ => {}
    }
    match fs::metadata(folder_of(path)) {
        Ok(folder) if !folder.is_dir() => refuse(ErrorKind::NotADirectory, "its folder is a file"),
        Ok(folder) if folder.permissions().readonly() => refuse(ErrorKind::PermissionDenied, "its folder is read-only"),
        Ok(_) => Ok(()),
        Err(error) if error.kind() == ErrorKind::NotFound => refuse(ErrorKind::NotFound, "its folder does not exist"),
        Err(error) if error.kind() == ErrorKind::NotADirectory => {
            refuse(ErrorKind::NotADirectory, "a part of its folder's path is a file")
        }
        // Such as links that lead to each other.
        Err(source) => Err(FileError::Create { path: path.to_owned(), source }),
    }
}

/// Whether a path leads to a device, a pipe, a socket or an open file.
pub(crate) fn is_special(path: &Path) -> bool {
    fs::metadata(path).is_ok_and(|found| !found.is_dir() && (!found.is_file() || is_open_file(path)))
}

/// Whether a path is a name that the system gives to open files: an entry of `/dev` (`/dev/stdout`), or of `/proc/self/fd`,
/// which is what `/dev/fd` leads to. Such a link must not be replaced by a file.
fn is_open_file(path: &Path) -> bool {
    folder_of(path).canonicalize().is_ok_and(|folder| folder == Path::new("/dev") || folder.starts_with("/proc"))
}

/// Longest name that a temporary name repeats, bytes. Most file systems allow 255, and a temporary name has 13 more.
const MAX_REPEATED_BYTES: usize = 200;

/// A new file whose name no other process has, with the permissions that any new file gets.
fn temporary(target: &Path, folder: &Path) -> io::Result<Content> {
    let mut prefix = std::ffi::OsString::from(".");
    let name = target.file_name().unwrap_or_default();
    prefix.push(if name.len() > MAX_REPEATED_BYTES { "output".as_ref() } else { name });
    prefix.push(".");
    let mut builder = Builder::new();
    builder.prefix(&prefix).suffix(".part");
    #[cfg(unix)]
    builder.permissions(<Permissions as std::os::unix::fs::PermissionsExt>::from_mode(0o666));
    let file = builder.tempfile_in(folder)?;
    let listed = Listed::new(file.path());
    Ok(Content::Temporary { file, listed })
}

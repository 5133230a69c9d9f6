use std::io;
use std::path::{Path, PathBuf};

use thiserror::Error;

/// Error of reading or writing a file.
#[derive(Debug, Error)]
pub enum FileError {
    /// A file of this name exists and may not be replaced.
    #[error("{}: exists already, expected a new name", path.display())]
    Exists {
        /// The file.
        path: PathBuf,
    },
    /// The file cannot be created.
    #[error("{}: cannot create: {source}", path.display())]
    Create {
        /// The file or folder.
        path: PathBuf,
        /// The system's reason.
        source: io::Error,
    },
    /// The file cannot be read.
    #[error("{}: cannot read: {source}", path.display())]
    Read {
        /// The file or folder.
        path: PathBuf,
        /// The system's reason.
        source: io::Error,
    },
    /// The path is no regular file: reading it may never end.
    #[error("{}: it is {found}, expected a regular file", path.display())]
    NotAFile {
        /// The path.
        path: PathBuf,
        /// What it is, with its article: `a folder`, `a pipe`, `a socket`, `a device`.
        found: &'static str,
    },
    /// The file exceeds the limit on files of its kind.
    #[error("{}: the file has {found} bytes, expected at most {expected}", path.display())]
    TooLarge {
        /// The file.
        path: PathBuf,
        /// Its size.
        found: u64,
        /// The limit.
        expected: u64,
    },
    /// Writing to the file, closing it or giving it its name failed.
    #[error("{}: cannot write: {source}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// The system's reason.
        source: io::Error,
    },
}

impl FileError {
    /// Stable code for people and scripts.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Exists { .. } => "OUTPUT-EXISTS",
            Self::Create { .. } => "OUTPUT-CREATE",
            Self::Read { .. } => "FILE-READ",
            Self::NotAFile { .. } => "FILE-KIND",
            Self::TooLarge { .. } => "FILE-SIZE",
            Self::Write { .. } => "FILE-WRITE",
        }
    }

    /// The file or folder at fault.
    pub fn path(&self) -> &Path {
        match self {
            Self::Exists { path }
            | Self::Create { path, .. }
            | Self::Read { path, .. }
            | Self::NotAFile { path, .. }
            | Self::TooLarge { path, .. }
            | Self::Write { path, .. } => path,
        }
    }

    /// The system's reason, where there is one.
    pub fn io_error(&self) -> Option<&io::Error> {
        match self {
            Self::Exists { .. } | Self::NotAFile { .. } | Self::TooLarge { .. } => None,
            Self::Create { source, .. } | Self::Read { source, .. } | Self::Write { source, .. } => Some(source),
        }
    }
}

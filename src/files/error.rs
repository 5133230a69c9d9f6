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
            Self::Write { .. } => "FILE-WRITE",
        }
    }

    /// The file or folder at fault.
    pub fn path(&self) -> &Path {
        let (Self::Exists { path } | Self::Create { path, .. } | Self::Read { path, .. } | Self::Write { path, .. }) =
            self;
        path
    }

    /// The system's reason, where there is one.
    pub fn io_error(&self) -> Option<&io::Error> {
        match self {
            Self::Exists { .. } => None,
            Self::Create { source, .. } | Self::Read { source, .. } | Self::Write { source, .. } => Some(source),
        }
    }
}

use std::io;
use std::path::{Path, PathBuf};

use thiserror::Error;

/// Why a file could not be read or written.
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
    /// Stable code for messages.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Exists { .. } => "OUTPUT-EXISTS",
            Self::Create { .. } => "OUTPUT-CREATE",
            Self::Read { .. } => "FILE-READ",
            Self::Write { .. } => "FILE-WRITE",
        }
    }

    /// Exit code of a program that ends with this error.
    pub fn exit_code(&self) -> i32 {
        match self {
            _ if self.io_error().is_some_and(|error| error.kind() == io::ErrorKind::PermissionDenied) => 77,
            Self::Exists { .. } | Self::Create { .. } => 73,
            Self::Read { source, .. } if source.kind() == io::ErrorKind::NotFound => 66,
            Self::Read { .. } | Self::Write { .. } => 74,
        }
    }

    /// What to do about it.
    pub fn help(&self) -> String {
        match self {
            Self::Exists { .. } => "choose another name, or pass --overwrite",
            Self::Create { .. } => "create the folder, or choose one that you may write to",
            Self::Read { .. } => "check the path and its permissions",
            Self::Write { .. } => "check free space and permissions of the folder",
        }
        .to_owned()
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

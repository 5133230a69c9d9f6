use std::path::{Path, PathBuf};

use thiserror::Error;

/// What goes wrong with the files of training: shards of shots, checkpoints, models.
#[derive(Debug, Error)]
pub enum FileError {
    /// It cannot be read.
    #[error("{}: cannot read: {source}", path.display())]
    Read {
        /// The file or folder.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// It cannot be written.
    #[error("{}: cannot write: {source}", path.display())]
    Write {
        /// The file or folder.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
}

impl FileError {
    /// Stable code for people and scripts.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Read { .. } => "TRAIN-READ",
            Self::Write { .. } => "TRAIN-WRITE",
        }
    }

    /// What to do about it.
    pub fn help(&self) -> String {
        match self {
            Self::Read { .. } => "check the path; `cinesplat dataset` writes shots to learn from".into(),
            Self::Write { .. } => "check the folder and the space on its disk".into(),
        }
    }

    /// Exit code of the command that meets it.
    pub fn exit_code(&self) -> i32 {
        match self {
            Self::Read { source, .. } if source.kind() == std::io::ErrorKind::NotFound => 66,
            Self::Read { .. } => 74,
            Self::Write { .. } => 73,
        }
    }
}

/// Writes a file under a passing name, then renames it: it appears whole or not at all.
pub fn write_whole(path: &Path, bytes: &[u8]) -> Result<(), FileError> {
    let failed = |source| FileError::Write { path: path.to_owned(), source };
    let mut temporary = path.as_os_str().to_owned();
    temporary.push(".tmp");
    let temporary = PathBuf::from(temporary);
    std::fs::write(&temporary, bytes).map_err(failed)?;
    std::fs::rename(&temporary, path).map_err(failed)
}

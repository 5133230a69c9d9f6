use std::path::{Path, PathBuf};

use cinesplat_files::FileError;
use cinesplat_video::VideoError;
use thiserror::Error;

/// Error of a job folder.
#[derive(Debug, Error)]
pub enum JobError {
    /// A file of the folder cannot be created, written or read.
    #[error(transparent)]
    File(#[from] FileError),
    /// The output's name has no known format, or a picture cannot be encoded.
    #[error(transparent)]
    Video(Box<VideoError>),
    /// Another program works on the folder.
    #[error("{}: another cinesplat is working on this film", path.display())]
    Locked {
        /// The folder.
        path: PathBuf,
    },
    /// This program was halted or cut off from the disk, and another one took the folder.
    #[error("{}: another cinesplat took this film over, or its folder was removed", path.display())]
    Lost {
        /// The folder.
        path: PathBuf,
    },
    /// The folder holds frames of another film.
    #[error("{}: its frames are of another film: {}", path.display(), differences.join("; "))]
    Mismatch {
        /// The folder.
        path: PathBuf,
        /// One text per field that differs.
        differences: Vec<String>,
    },
    /// The folder's description cannot be read.
    #[error("{}: {reason}, expected the description of a film", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        reason: String,
    },
    /// The frames do not fit on the disk.
    #[error(
        "{}: finished frames need up to {:.1} GB until the film is whole, the disk has {:.1} GB",
        path.display(),
        *needed as f64 / 1e9,
        *free as f64 / 1e9
    )]
    NoSpace {
        /// The folder.
        path: PathBuf,
        /// Bytes of the frames.
        needed: u64,
        /// Bytes that are free.
        free: u64,
    },
    /// The film is whole and cannot get its name.
    #[error("{error}; the finished film is {}", kept.display())]
    NotPlaced {
        /// Where the film is.
        kept: PathBuf,
        /// Why.
        error: FileError,
    },
    /// The thread that flushes frames to the disk ended early.
    #[error("{}: the thread that writes to the disk ended early", path.display())]
    Flushing {
        /// The folder.
        path: PathBuf,
    },
}

impl JobError {
    /// An error of the video stage.
    pub(super) fn video(error: VideoError) -> Self {
        Self::Video(Box::new(error))
    }

    /// Stable code for people and scripts.
    pub fn code(&self) -> &'static str {
        match self {
            Self::File(error) => error.code(),
            Self::Video(error) => error.code(),
            Self::Locked { .. } => "JOB-LOCKED",
            Self::Lost { .. } => "JOB-LOST",
            Self::Mismatch { .. } => "JOB-MISMATCH",
            Self::Unreadable { .. } => "JOB-READ",
            Self::NoSpace { .. } => "JOB-SPACE",
            Self::NotPlaced { .. } => "JOB-NAME",
            Self::Flushing { .. } => "JOB-FLUSH",
        }
    }

    /// The file or folder at fault, if there is one.
    pub fn path(&self) -> Option<&Path> {
        match self {
            Self::File(error) | Self::NotPlaced { error, .. } => Some(error.path()),
            Self::Video(error) => error.path(),
            Self::Locked { path }
            | Self::Lost { path }
            | Self::Mismatch { path, .. }
            | Self::Unreadable { path, .. }
            | Self::NoSpace { path, .. }
            | Self::Flushing { path } => Some(path),
        }
    }
}

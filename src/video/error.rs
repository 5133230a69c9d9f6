use std::path::PathBuf;

use cinesplat_files::FileError;
use thiserror::Error;

/// Why frames do not become a file. `Display` is `FILE: what was found, what was expected`.
#[derive(Debug, Error)]
pub enum VideoError {
    /// The name of the output ends in nothing that says what to write.
    #[error("{}: the name ends in {found:?}, expected .mp4 .mkv .webm .mov, or a pattern such as frames/%05d.png", path.display())]
    UnknownFormat {
        /// The ending found, without its dot.
        found: String,
        /// The output.
        path: PathBuf,
    },
    /// A frame pattern that does not give every frame its own name.
    #[error("{}: {reason}", path.display())]
    BadPattern {
        /// What is wrong with it.
        reason: &'static str,
        /// The output.
        path: PathBuf,
    },
    /// A size, rate or quality that no encoder takes.
    #[error("{what} is {found}, expected {expected}")]
    BadSetting {
        /// Name of the setting.
        what: &'static str,
        /// What was asked for.
        found: String,
        /// What is allowed.
        expected: &'static str,
    },
    /// This build of FFmpeg lacks what the output needs.
    #[error("{}: FFmpeg on this machine has no {missing}, needed for this file", path.display())]
    Missing {
        /// Encoder or container, by FFmpeg's name.
        missing: String,
        /// The output.
        path: PathBuf,
    },
    /// A file cannot be created, written, named or read back.
    #[error(transparent)]
    File(#[from] FileError),
    /// FFmpeg refused a step that it should take.
    #[error("{}: {action} failed: {message}", path.display())]
    Ffmpeg {
        /// What was being done.
        action: &'static str,
        /// FFmpeg's own words.
        message: String,
        /// The output.
        path: PathBuf,
    },
    /// A frame of the wrong number of bytes.
    #[error("a frame has {found} bytes, expected {expected}")]
    FrameSize {
        /// Bytes given.
        found: usize,
        /// Width x height x 3.
        expected: usize,
    },
    /// The finished file does not hold what was written.
    #[error("{}: read back {found}, expected {expected}", path.display())]
    ReadBack {
        /// What the file holds.
        found: String,
        /// What was written.
        expected: String,
        /// The file.
        path: PathBuf,
    },
}

impl VideoError {
    /// Short name of the case, for messages and searches.
    pub fn code(&self) -> &'static str {
        match self {
            Self::UnknownFormat { .. } => "VIDEO-FORMAT",
            Self::BadPattern { .. } => "VIDEO-PATTERN",
            Self::BadSetting { .. } => "VIDEO-SETTING",
            Self::Missing { .. } => "VIDEO-ENCODER",
            Self::File(error) => error.code(),
            Self::Ffmpeg { .. } => "VIDEO-FFMPEG",
            Self::FrameSize { .. } => "VIDEO-FRAME",
            Self::ReadBack { .. } => "VIDEO-READBACK",
        }
    }

    /// The file that it is about, if it is about one.
    pub fn path(&self) -> Option<&std::path::Path> {
        match self {
            Self::UnknownFormat { path, .. }
            | Self::BadPattern { path, .. }
            | Self::Missing { path, .. }
            | Self::Ffmpeg { path, .. }
            | Self::ReadBack { path, .. } => Some(path),
            Self::File(error) => Some(error.path()),
            Self::BadSetting { .. } | Self::FrameSize { .. } => None,
        }
    }
}

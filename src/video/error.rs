use std::path::PathBuf;

use cinesplat_files::FileError;
use thiserror::Error;

/// Error of writing a film. The message is `FILE: found, expected`.
#[derive(Debug, Error)]
pub enum VideoError {
    /// The name of the output has no known extension.
    #[error("{}: the name ends in {found:?}, expected .mp4 .mkv .webm .mov, or a pattern such as frames/%05d.png", path.display())]
    UnknownFormat {
        /// The extension, without its dot.
        found: String,
        /// The output.
        path: PathBuf,
    },
    /// A pattern that does not give each frame its own name.
    #[error("{}: {reason}", path.display())]
    BadPattern {
        /// What is wrong with it.
        reason: &'static str,
        /// The output.
        path: PathBuf,
    },
    /// A size, rate or quality outside its range.
    #[error("{what} is {found}, expected {expected}")]
    BadSetting {
        /// Name of the setting.
        what: &'static str,
        /// The value found.
        found: String,
        /// The values allowed.
        expected: &'static str,
    },
    /// FFmpeg on this machine lacks an encoder or a container.
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
    /// A call of FFmpeg fails.
    #[error("{}: {action} failed: {message}", path.display())]
    Ffmpeg {
        /// The failed action.
        action: &'static str,
        /// FFmpeg's message.
        message: String,
        /// The output.
        path: PathBuf,
    },
    /// A picture cannot be compressed for `OpenEXR`.
    #[error("encoding an EXR failed: {message}")]
    Exr {
        /// The compressor's message.
        message: String,
    },
    /// A picture cannot be encoded as PNG.
    #[error("encoding a PNG failed: {message}")]
    Png {
        /// The encoder's message.
        message: String,
    },
    /// A frame of the wrong number of bytes.
    #[error("a frame has {found} bytes, expected {expected}")]
    FrameSize {
        /// Bytes given.
        found: usize,
        /// Width x height x 3.
        expected: usize,
    },
    /// The finished file does not contain the written frames.
    #[error("{}: read back {found}, expected {expected}", path.display())]
    ReadBack {
        /// What the file contains.
        found: String,
        /// What was written.
        expected: String,
        /// The file.
        path: PathBuf,
    },
}

impl VideoError {
    /// Stable code for people and scripts.
    pub fn code(&self) -> &'static str {
        match self {
            Self::UnknownFormat { .. } => "VIDEO-FORMAT",
            Self::BadPattern { .. } => "VIDEO-PATTERN",
            Self::BadSetting { .. } => "VIDEO-SETTING",
            Self::Missing { .. } => "VIDEO-ENCODER",
            Self::File(error) => error.code(),
            Self::Ffmpeg { .. } => "VIDEO-FFMPEG",
            Self::Png { .. } => "VIDEO-PNG",
            Self::Exr { .. } => "VIDEO-EXR",
            Self::FrameSize { .. } => "VIDEO-FRAME",
            Self::ReadBack { .. } => "VIDEO-READBACK",
        }
    }

    /// The file at fault, if there is one.
    pub fn path(&self) -> Option<&std::path::Path> {
        match self {
            Self::UnknownFormat { path, .. }
            | Self::BadPattern { path, .. }
            | Self::Missing { path, .. }
            | Self::Ffmpeg { path, .. }
            | Self::ReadBack { path, .. } => Some(path),
            Self::File(error) => Some(error.path()),
            Self::BadSetting { .. } | Self::Png { .. } | Self::Exr { .. } | Self::FrameSize { .. } => None,
        }
    }
}

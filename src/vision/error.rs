use std::fmt::Display;
use std::path::{Path, PathBuf};

use cinesplat_files::FileError;
use thiserror::Error;

/// Error of a network for pictures.
#[derive(Debug, Error)]
pub enum VisionError {
    /// A file of the network cannot be read.
    #[error(transparent)]
    File(#[from] FileError),
    /// The program was built without networks for pictures.
    #[error("{}: this build reads no networks for pictures, expected one with the feature `vision`", path.display())]
    NotBuilt {
        /// The folder that was asked for.
        path: PathBuf,
    },
    /// A file of the network is damaged, or its network is not one that can be run.
    #[error("{}: {part} is {found}, expected {expected}", path.display())]
    BadModel {
        /// The file.
        path: PathBuf,
        /// The key, tensor or place at fault.
        part: String,
        /// What was found.
        found: String,
        /// What was expected.
        expected: String,
    },
    /// A picture that is not whole patches, or has not three bytes per pixel.
    #[error(
        "a picture of {width} x {height} px in {num_bytes} bytes, expected sides of whole patches of {patch_px} px"
    )]
    BadPicture {
        /// Width of the picture.
        width: usize,
        /// Height of the picture.
        height: usize,
        /// Bytes of the picture.
        num_bytes: usize,
        /// Side of a patch.
        patch_px: usize,
    },
    /// The network failed to compute, or gives numbers that are not finite.
    #[error("the network for pictures failed: {reason}")]
    Compute {
        /// The reason.
        reason: String,
    },
}

impl VisionError {
    /// Stable code for people and scripts.
    pub fn code(&self) -> &'static str {
        match self {
            Self::File(error) => error.code(),
            Self::NotBuilt { .. } => "VISION-NOT-BUILT",
            Self::BadModel { .. } => "VISION-BAD",
            Self::BadPicture { .. } => "VISION-PICTURE",
            Self::Compute { .. } => "VISION-COMPUTE",
        }
    }

    pub(crate) fn bad_model(path: &Path, part: &str, found: &dyn Display, expected: &dyn Display) -> Self {
        let (found, expected) = (first_line(found), expected.to_string());
        Self::BadModel { path: path.to_owned(), part: part.to_owned(), found, expected }
    }

    pub(crate) fn compute(reason: &dyn Display) -> Self {
        Self::Compute { reason: first_line(reason) }
    }
}

/// candle's errors carry the stack of calls on further lines, if the environment asks for it.
fn first_line(text: &dyn Display) -> String {
    text.to_string().lines().next().unwrap_or_default().to_owned()
}

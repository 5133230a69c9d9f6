use std::fmt::Display;
use std::path::{Path, PathBuf};

use cinesplat_files::FileError;
use thiserror::Error;

/// Error of a language model or of what it reads.
#[derive(Debug, Error)]
pub enum ReaderError {
    /// A file of the model cannot be opened or read.
    #[error(transparent)]
    File(#[from] FileError),
    /// The program was built without language models.
    #[error("{}: this build reads no language models, expected one with the feature `reader`", path.display())]
    NotBuilt {
        /// The model that was asked for.
        path: PathBuf,
    },
    /// A file of the model is damaged, or its model is not one that can be run.
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
    /// A prompt that leaves the model no room for an answer.
    #[error("the prompt and the scene's objects are {found} tokens of the language model, expected at most {limit}")]
    TooLong {
        /// Number of tokens.
        found: usize,
        /// Largest number of tokens.
        limit: usize,
    },
    /// The model gives no finite score to any token that may follow.
    #[error("the language model gives {found} as the score of a token, expected a finite number")]
    NotFinite {
        /// The score.
        found: f32,
    },
    /// The model failed to compute.
    #[error("the language model failed: {reason}")]
    Compute {
        /// The reason.
        reason: String,
    },
}

impl ReaderError {
    /// Stable code for people and scripts.
    pub fn code(&self) -> &'static str {
        match self {
            Self::File(error) => error.code(),
            Self::NotBuilt { .. } => "READER-NOT-BUILT",
            Self::BadModel { .. } => "READER-BAD",
            Self::TooLong { .. } => "READER-TOO-LONG",
            Self::NotFinite { .. } => "READER-NOT-FINITE",
            Self::Compute { .. } => "READER-COMPUTE",
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

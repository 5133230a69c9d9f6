use std::path::PathBuf;

use thiserror::Error;

use cinesplat_language::LanguageError;

/// What keeps the director from directing.
#[derive(Debug, Error)]
pub enum DirectorError {
    /// The words cannot be linked to the scene's objects.
    #[error(transparent)]
    Language(#[from] LanguageError),
    /// Nothing to read in the prompt.
    #[error("the prompt holds no words, expected a sentence about the camera")]
    EmptyPrompt,
    /// More words than the network reads.
    #[error("the prompt is {found} tokens long, expected at most {limit}")]
    PromptTooLong {
        /// Tokens found.
        found: usize,
        /// Tokens allowed.
        limit: usize,
    },
    /// A scene without extent or up direction.
    #[error("the scene has {found}, expected {expected}")]
    BadScene {
        /// What it has.
        found: String,
        /// What it should have.
        expected: &'static str,
    },
    /// A file of the model cannot be read.
    #[error("{}: cannot read the model: {source}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// A file of the model is not what it says it is.
    #[error("{part}: found {found}, expected {expected}")]
    BadModel {
        /// Which part: a file, a field, a tensor.
        part: String,
        /// What was found.
        found: String,
        /// What was expected.
        expected: String,
    },
    /// An id that the model has no row for.
    #[error("token id {found} is beyond the vocabulary of {limit}")]
    IdBeyondVocabulary {
        /// The id.
        found: u32,
        /// Size of the vocabulary.
        limit: usize,
    },
    /// The network failed to compute.
    #[error("the network failed: {0}")]
    Compute(#[from] candle_core::Error),
    /// The network produced a number that is none.
    #[error("the network put out {found} as {field}, expected a finite number")]
    NotFinite {
        /// Which output.
        field: &'static str,
        /// The value.
        found: f32,
    },
}

impl DirectorError {
    /// Stable code for people and scripts.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Language(error) => error.code(),
            Self::EmptyPrompt => "PROMPT-EMPTY",
            Self::PromptTooLong { .. } => "PROMPT-TOO-LONG",
            Self::BadScene { .. } => "DIRECTOR-SCENE",
            Self::Read { .. } => "MODEL-READ",
            Self::BadModel { .. } => "MODEL-BAD",
            Self::IdBeyondVocabulary { .. } => "MODEL-TOKEN",
            Self::Compute(_) => "MODEL-COMPUTE",
            Self::NotFinite { .. } => "MODEL-NOT-FINITE",
        }
    }
}

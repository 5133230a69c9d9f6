use std::path::PathBuf;

use thiserror::Error;

use cinesplat_language::LanguageError;

/// Error of the director.
#[derive(Debug, Error)]
pub enum DirectorError {
    /// The prompt cannot be linked to the scene's objects.
    #[error(transparent)]
    Language(#[from] LanguageError),
    /// A prompt without words.
    #[error("the prompt holds no words, expected a sentence about the camera")]
    EmptyPrompt,
    /// A prompt of more tokens than the network reads.
    #[error("the prompt is {found} tokens long, expected at most {limit}")]
    PromptTooLong {
        /// Number of tokens.
        found: usize,
        /// Largest number of tokens.
        limit: usize,
    },
    /// A scene without extent or up direction.
    #[error("the scene has {found}, expected {expected}")]
    BadScene {
        /// The value found.
        found: String,
        /// The values allowed.
        expected: &'static str,
    },
    /// A file of the model cannot be read.
    #[error("{}: cannot read the model: {source}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// The system's reason.
        source: std::io::Error,
    },
    /// A file of the model is malformed or does not match its description.
    #[error("{part}: found {found}, expected {expected}")]
    BadModel {
        /// The file, field or tensor at fault.
        part: String,
        /// What was found.
        found: String,
        /// What was expected.
        expected: String,
    },
    /// A token id outside the vocabulary.
    #[error("token id {found}, expected less than {limit}")]
    IdBeyondVocabulary {
        /// The id.
        found: u32,
        /// Size of the vocabulary.
        limit: usize,
    },
    /// The network failed to compute.
    #[error("the network failed: {0}")]
    Compute(#[from] candle_core::Error),
    /// An output of a network is not finite: its weights are damaged.
    #[error("{file}: the network's {output} hold {found}, expected finite numbers")]
    NotFinite {
        /// The file of the network's weights.
        file: &'static str,
        /// The output.
        output: &'static str,
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

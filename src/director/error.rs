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

    /// What to do about it.
    pub fn help(&self) -> String {
        match self {
            Self::Language(error) => error.help(),
            Self::EmptyPrompt => "say what the camera should do, such as \"push in on <obj-1>\"".into(),
            Self::PromptTooLong { .. } => "say it in fewer words, or split it into several shots".into(),
            Self::BadScene { .. } => "give the up direction with --up, or check the scene with `cinesplat info`".into(),
            Self::Read { .. } => "check the path given with --model, or leave it out for the built-in weights".into(),
            Self::BadModel { .. } | Self::IdBeyondVocabulary { .. } => {
                "leave --model out for the built-in weights, or train them again with `cinesplat train`".into()
            }
            Self::Compute(_) | Self::NotFinite { .. } => "this is a fault of ours: report it with the prompt".into(),
        }
    }

    /// Exit code of the command that meets it.
    pub fn exit_code(&self) -> i32 {
        match self {
            Self::Language(error) => error.exit_code(),
            Self::Read { source, .. } => match source.kind() {
                std::io::ErrorKind::NotFound => 66,
                std::io::ErrorKind::PermissionDenied => 77,
                _ => 74,
            },
            Self::Compute(_) | Self::NotFinite { .. } => 70,
            _ => 65,
        }
    }
}

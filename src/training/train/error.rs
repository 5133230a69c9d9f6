use std::path::PathBuf;

use thiserror::Error;

use crate::corpus::CorpusError;
use crate::dataset::DatasetError;
use cinesplat_director::DirectorError;
use cinesplat_files::FileError;
use cinesplat_language::LanguageError;

/// Error of training or evaluating a network.
#[derive(Debug, Error)]
pub enum TrainError {
    /// The network fails, or its files cannot be read.
    #[error(transparent)]
    Director(#[from] DirectorError),
    /// A prompt cannot be sampled, or an evaluation split cannot be read.
    #[error(transparent)]
    Language(#[from] LanguageError),
    /// The corpus cannot be read.
    #[error(transparent)]
    Corpus(#[from] CorpusError),
    /// The realized shots cannot be read.
    #[error(transparent)]
    Dataset(#[from] DatasetError),
    /// The sampler draws no prompt within the limits on keys, objects and mentions.
    #[error("example {number}: no usable prompt in 100 draws, expected one with few enough steps and objects")]
    NoExample {
        /// Number of the example.
        number: u64,
    },
    /// The loss is not finite.
    #[error("the loss is {found} at step {step}, expected a finite number")]
    Diverged {
        /// The step.
        step: u64,
        /// The loss.
        found: f64,
    },
    /// The training was stopped after writing a checkpoint.
    #[error("stopped after step {step}")]
    Stopped {
        /// Number of finished steps.
        step: u64,
    },
    /// A checkpoint of another training, or a damaged one.
    #[error("{}: found {found}, expected a checkpoint of this training", path.display())]
    BadCheckpoint {
        /// The file.
        path: PathBuf,
        /// What was found.
        found: String,
    },
    /// A text encoder to start from that is not of the family that this program knows.
    #[error("{}: found {found}, expected BERT as transformers stores it", path.display())]
    BadBase {
        /// The file, or the folder and the name of a tensor.
        path: PathBuf,
        /// What was found.
        found: String,
    },
    /// A file cannot be read or written.
    #[error(transparent)]
    File(#[from] FileError),
}

impl From<candle_core::Error> for TrainError {
    fn from(error: candle_core::Error) -> Self {
        Self::Director(error.into())
    }
}

impl TrainError {
    /// Stable code for people and scripts.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Director(error) => error.code(),
            Self::Language(error) => error.code(),
            Self::Dataset(error) => error.code(),
            Self::Corpus(error) => error.code(),
            Self::File(error) => error.code(),
            Self::NoExample { .. } => "TRAIN-NO-EXAMPLE",
            Self::Diverged { .. } => "TRAIN-DIVERGED",
            Self::Stopped { .. } => "TRAIN-STOPPED",
            Self::BadCheckpoint { .. } => "TRAIN-CHECKPOINT",
            Self::BadBase { .. } => "TRAIN-BASE",
        }
    }
}

use std::path::PathBuf;

use thiserror::Error;

use crate::dataset::DatasetError;
use cinesplat_director::DirectorError;
use cinesplat_files::FileError;
use cinesplat_language::LanguageError;

/// What keeps the network from being trained.
#[derive(Debug, Error)]
pub enum TrainError {
    /// The network or its files.
    #[error(transparent)]
    Director(#[from] DirectorError),
    /// The phrasebook or the exam.
    #[error(transparent)]
    Language(#[from] LanguageError),
    /// The realized shots.
    #[error(transparent)]
    Dataset(#[from] DatasetError),
    /// The phrasebook keeps making prompts that keys cannot express.
    #[error("no lesson after 100 draws for number {number}, expected a prompt of few enough steps and objects")]
    NoLesson {
        /// Which lesson.
        number: u64,
    },
    /// The loss is no number any more.
    #[error("the loss is {found} at step {step}, expected a finite number")]
    Diverged {
        /// The step.
        step: u64,
        /// The loss.
        found: f64,
    },
    /// Somebody stopped it; a checkpoint was written.
    #[error("stopped after step {step}, expected to go on")]
    Stopped {
        /// Steps made.
        step: u64,
    },
    /// A checkpoint that does not fit.
    #[error("{}: found {found}, expected a checkpoint of this training", path.display())]
    BadCheckpoint {
        /// The file.
        path: PathBuf,
        /// What was found.
        found: String,
    },
    /// A file.
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
            Self::File(error) => error.code(),
            Self::NoLesson { .. } => "TRAIN-NO-LESSON",
            Self::Diverged { .. } => "TRAIN-DIVERGED",
            Self::Stopped { .. } => "TRAIN-STOPPED",
            Self::BadCheckpoint { .. } => "TRAIN-CHECKPOINT",
        }
    }
}

use cinesplat::training::corpus::CorpusError;
use cinesplat::training::{DatasetError, TrainError};

use super::exit::Exit;
use super::message::Failure;

impl From<TrainError> for Failure {
    fn from(error: TrainError) -> Self {
        let (code, message) = (error.code(), error.to_string());
        let (exit, help) = match error {
            TrainError::Director(error) => return error.into(),
            TrainError::Language(error) => return error.into(),
            TrainError::Dataset(error) => return error.into(),
            TrainError::File(error) | TrainError::Corpus(CorpusError::Read(error)) => return error.into(),
            TrainError::Corpus(CorpusError::List { .. }) => {
                (Exit::NoInput, "give the folder of the corpus's text files")
            }
            TrainError::Corpus(CorpusError::BadLine { .. }) => (Exit::BadData, "correct that line"),
            TrainError::NoExample { .. } => {
                (Exit::Fault, "this is a fault of the example sampler: report it with the seed")
            }
            TrainError::Diverged { .. } => (Exit::Fault, "resume from the last checkpoint with a smaller --rate"),
            TrainError::Stopped { .. } => (Exit::Stopped, "the same command with --resume continues from there"),
            TrainError::BadBase { .. } => (
                Exit::BadData,
                "give --base a folder with config.json, model.safetensors and vocab.txt of one BERT model",
            ),
            TrainError::BadCheckpoint { .. } => {
                (Exit::BadData, "train into another folder, or give the settings that it was made with")
            }
        };
        Self::new(code, message, help, exit)
    }
}

impl From<CorpusError> for Failure {
    fn from(error: CorpusError) -> Self {
        TrainError::from(error).into()
    }
}

impl From<DatasetError> for Failure {
    fn from(error: DatasetError) -> Self {
        let (code, message) = (error.code(), error.to_string());
        let (exit, help) = match error {
            DatasetError::Language(error) => return error.into(),
            DatasetError::Director(error) => return (*error).into(),
            DatasetError::Objects(error) => return (*error).into(),
            DatasetError::File(error) => return error.into(),
            DatasetError::Scene { .. } => {
                (Exit::Fault, "this is a fault of the scene generator: report it with the seed")
            }
            DatasetError::OtherSettings { .. } => {
                (Exit::BadData, "write into another folder, or give the settings that it was made with")
            }
            DatasetError::BadSetting { .. } => (Exit::Usage, "give a value in that range"),
            DatasetError::BadLine { .. } => (Exit::BadData, "write the shards again with `cinesplat dataset`"),
        };
        Self::new(code, message, help, exit)
    }
}

//! The director: words and object tokens to keyframes, by a network trained here.
//!
//! Enters: a linked prompt and the scene's objects with their sparse clouds. Leaves: a [`Direction`]: a program of steps
//! and a camera for every key. A Q-former turns each object's cloud into a few tokens, a small causal decoder attends to
//! text and object tokens and emits keys one by one until it stops. The one invariant: whatever the words, the program
//! names only objects of the scene and all numbers are finite. The only folder with candle and tokenizers.

mod choices;
mod codes;
mod coverage;
mod dataset;
mod decode;
mod directing;
mod error;
mod files;
mod frame;
mod ground;
pub mod keys;
pub mod language;
mod merges;
mod model;
mod train;
mod vocabulary;
mod weights;

pub use dataset::{DatasetError, DatasetSettings, DatasetSummary, write_dataset};
pub use directing::{Direction, Director, Stage, StepCertainty, SuggestedCamera};
pub use error::DirectorError;
pub use files::FileError;
pub use frame::SceneFrame;
pub use model::ModelConfig;
pub use train::{
    GradientAudit, GradientCheck, Marks, Miss, Paper, Progress, Report, TrainError, TrainSettings, TrainSummary,
    audit_gradients, examine, train,
};
pub use vocabulary::Vocabulary;

//! Training: examples, loss, optimizer, checkpoints, evaluation.

mod augmentation;
mod checkpoint;
mod error;
mod evaluation;
mod examples;
mod gradient_check;
mod gradients;
mod loss;
mod metrics;
mod optimizer;
mod phrases;
mod progress;
mod run;
mod sentences;
mod settings;
mod transfer;

pub(crate) use loss::whole_rows;
pub(crate) use optimizer::{AdamSettings, AdamW, learning_rate};

pub use error::TrainError;
pub use evaluation::{EvaluationSplit, Examination, Mentions, evaluate_director, examine};
pub use gradient_check::{GradientCheck, ParameterCheck, check_gradients};
pub use metrics::{ErrorCase, Mistake, ProgramMetrics, StepField, Tally};
pub use phrases::Phrases;
pub use progress::{ProgressCallback, TrainingProgress};
pub use run::{TrainSummary, train};
pub use settings::TrainSettings;

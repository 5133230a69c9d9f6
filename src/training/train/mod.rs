//! Training: examples, loss, optimizer, checkpoints, evaluation.

mod augmentation;
mod base;
mod checkpoint;
mod error;
mod evaluation;
mod examples;
mod gradient_check;
mod gradients;
mod joining;
mod loss;
mod metrics;
mod modifiers;
mod optimizer;
mod phrases;
mod progress;
mod run;
mod sentence;
mod sentences;
mod settings;
mod slips;
mod transfer;
mod wishes;

pub(crate) use loss::whole_rows;
pub(crate) use optimizer::{AdamSettings, AdamW, learning_rate};

pub use base::Base;
pub use error::TrainError;
pub use evaluation::{EvaluationSplit, Examination, Mentions, evaluate_director, examine};
pub use gradient_check::{GradientCheck, ParameterCheck, check_gradients};
pub use metrics::{ErrorCase, Mistake, ProgramMetrics, StepField, Tally};
pub use modifiers::{Modifier, Modifiers, Position, Wish};
pub use phrases::Phrases;
pub use progress::{ProgressCallback, TrainingProgress};
pub use run::{TrainSummary, train};
pub use sentences::drawn_sentences;
pub use settings::TrainSettings;

//! Training of the director: sampled prompts, realized shots, the training loop, evaluation.
//!
//! [`PromptSampler`] samples prompts labeled with the programs that they mean, [`exam()`] returns hand-written prompts.
//! [`write_dataset`] makes shards of realized shots, [`train`] trains a network on sampled prompts and these shards, and
//! [`evaluate_director`] measures how well a director understands prompts. Equal seeds give equal prompts.

pub mod corpus;
mod dataset;
mod names;
mod sampler;
mod train;
mod workers;

pub use dataset::{DatasetError, DatasetSettings, DatasetSummary, write_dataset};
pub use names::{
    NameFigures, NameMistake, NameProgress, NameSettings, NameSummary, examine_mentions, examine_names, train_names,
};
pub use sampler::{LabeledPrompt, PromptSampler, TemplateSplit, exam, exam_objects};
pub use train::{
    Base, ErrorCase, EvaluationSplit, Examination, GradientCheck, Mentions, Mistake, Modifier, Modifiers,
    ParameterCheck, Phrases, Position, ProgramMetrics, ProgressCallback, StepField, Tally, TrainError, TrainSettings,
    TrainSummary, TrainingProgress, Wish, check_gradients, drawn_sentences, evaluate_director, examine, train,
};

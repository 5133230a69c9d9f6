//! Training of the director.

mod dataset;
mod sampler;
mod train;

pub use dataset::{DatasetError, DatasetSettings, DatasetSummary, write_dataset};
pub use sampler::{LabeledPrompt, PromptSampler, TemplateSplit, exam, exam_objects};
pub use train::{
    GradientAudit, GradientCheck, Marks, Miss, Paper, Progress, Report, TrainError, TrainSettings, TrainSummary,
    audit_gradients, examine, train,
};

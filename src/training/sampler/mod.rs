//! The sampler of sentences: prompts with their programs, drawn from the grammar; and the sentences of the exam.

mod compose;
mod exam;
mod figures;
mod prompt_sampler;
mod surface;
mod wording;

pub use exam::{exam, exam_objects};
pub use prompt_sampler::{LabeledPrompt, PromptSampler, TemplateSplit};

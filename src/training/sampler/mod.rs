//! The sampler of training prompts, and the sentences of the exam.
//!
//! Enters: the grammar of `prompts/grammar.txt`, objects, a random generator. Leaves: prompts labeled with the program
//! that they mean. The one invariant: linking a sampled prompt finds exactly the objects and quantities of its program.
//!
//! The stages are those of template-based text generation: [`grammar`] holds templates grouped by meaning, [`expansion`]
//! chooses among them, [`compose`] plans the clauses of a prompt and realizes them as text, [`surface`] applies a writing
//! style.

mod choice;
mod compose;
mod exam;
mod expansion;
mod grammar;
mod labeled_prompt;
mod prompt_sampler;
mod quantity_phrases;
mod surface;
mod template;

pub use exam::{exam, exam_objects};
pub use expansion::TemplateSplit;
pub use labeled_prompt::LabeledPrompt;
pub use prompt_sampler::PromptSampler;

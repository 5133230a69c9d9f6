//! The sampler of sentences: prompts with their programs, drawn from the grammar; and the sentences of the exam.

mod compose;
mod exam;
mod figures;
mod phrasebook;
mod surface;
mod wording;

pub use exam::{ExamItem, exam, exam_objects};
pub use phrasebook::{Phrasebook, Sample, Split};

//! One sentence of training.

use cinesplat_language::Linked;
use cinesplat_operator::Program;

/// A sentence with its meaning, in which groups stand for their members. A phrase is a sentence without steps.
#[derive(Debug, Clone, Default)]
pub(super) struct Sentence {
    pub(super) linked: Linked,
    pub(super) program: Program,
    /// Bytes that the notation cannot say.
    pub(super) unmet: Vec<[usize; 2]>,
}

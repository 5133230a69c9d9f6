use cinesplat_operator::Program;

/// A prompt labeled with its meaning.
#[derive(Debug, Clone, PartialEq)]
pub struct LabeledPrompt {
    /// The text.
    pub prompt: String,
    /// Its meaning, with ids of objects. A sampled prompt gives every step its byte range of the text, a sentence of the
    /// exam none.
    pub program: Program,
}

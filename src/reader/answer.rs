/// An answer.
#[derive(Debug, Clone, PartialEq)]
pub struct Answer {
    /// The text.
    pub text: String,
    /// Per token of the answer the byte of the text at which it begins, and its probability among the allowed tokens.
    /// The last one is the end of the answer.
    pub tokens: Vec<(usize, f64)>,
}

//! Linked prompts for unit tests.

use super::linked::Linked;

/// A prompt whose words and marks stand apart by spaces; `<obj-0>` is object 5, `<obj-1>` object 7.
pub(crate) fn linked(text: &str) -> Linked {
    let words = text.split(' ');
    let spans = words.scan(0, |at, word| Some([*at, std::mem::replace(at, *at + word.len() + 1) + word.len()]));
    Linked { tokens_text: text.to_owned(), spans: spans.collect(), slots: vec![5, 7], ..Linked::default() }
}

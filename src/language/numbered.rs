//! Objects mentioned by number: `<obj-3>`, `obj 3`, `object #3`, `#3`.

use super::tokenizer::{Word, word_at};

/// A mention of an object by number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct NumberedMention {
    /// Number of words.
    pub len: usize,
    /// The object's id; `None` for a placeholder such as `<obj-N>`.
    pub id: Option<u32>,
}

/// The mention by number that begins at word `i`.
pub fn numbered_mention_at(words: &[Word], i: usize) -> Option<NumberedMention> {
    let bracket = usize::from(matches!(word_at(words, i), "<" | "("));
    let angle = word_at(words, i) == "<";
    let mut j = i + bracket;
    let named = matches!(word_at(words, j), "obj" | "object" | "objs");
    j += usize::from(named);
    let hash = word_at(words, j) == "#";
    j += usize::from(hash);
    if !(named || hash && bracket == 0) {
        return None;
    }
    let digits = word_at(words, j);
    let id = digits.parse::<u32>().ok();
    let is_number = digits.starts_with(|c: char| c.is_ascii_digit()) && !digits.contains('.');
    if !is_number {
        // `<obj-N>`, copied from a manual, is a mention without a number.
        let closes = word_at(words, j + 1) == ">";
        return (angle && closes).then_some(NumberedMention { len: j + 2 - i, id: None });
    }
    let closing = if angle { ">" } else { ")" };
    let closed = bracket == 1 && word_at(words, j + 1) == closing;
    // The parenthesis of `(object 3 and 4)` does not belong to the mention.
    let start = if bracket == 1 && !closed && !angle { return None } else { i };
    Some(NumberedMention { len: j + 1 + usize::from(closed) - start, id })
}

//! Objects named by number: `<obj-3>`, `obj 3`, `object #3`, `#3`.

use super::counting::at;
use super::words::Word;

/// An object's number at some place, and the number of words it takes; `None` inside when it is no object's number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Numbered {
    pub(crate) len: usize,
    pub(crate) id: Option<u32>,
}

/// The numbered mention that begins at word `i`.
pub(crate) fn numbered_at(words: &[Word], i: usize) -> Option<Numbered> {
    let bracket = usize::from(matches!(at(words, i), "<" | "("));
    let angle = at(words, i) == "<";
    let mut j = i + bracket;
    let named = matches!(at(words, j), "obj" | "object" | "objs");
    j += usize::from(named);
    let hash = at(words, j) == "#";
    j += usize::from(hash);
    if !(named || hash && bracket == 0) {
        return None;
    }
    let digits = at(words, j);
    let id = digits.parse::<u32>().ok();
    let is_number = digits.starts_with(|c: char| c.is_ascii_digit()) && !digits.contains('.');
    if !is_number {
        // `<obj-N>` as in a manual is meant as an object, whatever stands for the number.
        let closes = at(words, j + 1) == ">";
        return (angle && closes).then_some(Numbered { len: j + 2 - i, id: None });
    }
    let closing = if angle { ">" } else { ")" };
    let closed = bracket == 1 && at(words, j + 1) == closing;
    // `(object 3 and 4)`: the parenthesis is none of ours.
    let opens = if bracket == 1 && !closed && !angle { return None } else { i };
    Some(Numbered { len: j + 1 + usize::from(closed) - opens, id })
}

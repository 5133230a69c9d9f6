//! Marks that somebody who dictates says as words: `the bedtime story video comma I want it to feel like morning full stop`.

use std::borrow::Cow;

use super::tokenizer::{is_listed, tokenize, word_at};

/// Said marks: their words and the mark.
const MARKS: [(&[&str], &str); 11] = [
    (&["new", "sentence"], "."),
    (&["full", "stop"], "."),
    (&["new", "paragraph"], "."),
    (&["new", "para"], "."),
    (&["new", "line"], "."),
    (&["question", "mark"], "?"),
    (&["exclamation", "mark"], "!"),
    (&["exclamation", "point"], "!"),
    (&["semi", "colon"], ";"),
    (&["semicolon"], ";"),
    (&["comma"], ","),
];
/// Words before them by which they are none: `come to a full stop`, `the new line`.
const NAMES: &str = "a an the to complete this that your our my at";

/// The prompt with the marks that are said in it as marks, each followed by spaces, so that all other words stay where they are.
pub fn with_dictated_marks(prompt: &str) -> Cow<'_, str> {
    let words = tokenize(prompt);
    let mark_at = |at: usize| {
        let said = |names: &[&str]| names.iter().enumerate().all(|(nth, name)| word_at(&words, at + nth) == *name);
        let is_name = at.checked_sub(1).is_some_and(|before| is_listed(NAMES, word_at(&words, before)));
        MARKS.iter().find(|(names, _)| said(names) && !is_name)
    };
    let found: Vec<([usize; 2], &str)> = (0..words.len())
        .filter_map(|at| {
            let (names, mark) = mark_at(at)?;
            Some(([words[at].span[0], words.get(at + names.len() - 1)?.span[1]], *mark))
        })
        .collect();
    if found.is_empty() {
        return Cow::Borrowed(prompt);
    }
    let mut out = prompt.to_owned();
    for ([start, end], mark) in found {
        out.replace_range(start..end, &format!("{mark:<width$}", width = end - start));
    }
    Cow::Owned(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn said_marks_are_marks() {
        let said = "push in on the bed comma slowly full stop then hold";
        assert_eq!(with_dictated_marks(said), "push in on the bed ,     slowly .         then hold");
        assert_eq!(with_dictated_marks("come to a full stop at the bed"), "come to a full stop at the bed");
        assert_eq!(with_dictated_marks("push in, slowly").len(), 15);
    }
}

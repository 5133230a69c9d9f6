//! How exactly something is meant: `±10 %`, `+/- 5°`, `(±10 % of frame)`, `within 10 % of the frame`.
//!
//! Such numbers are no heights in the frame and no amounts of a move.

use std::borrow::Cow;

use super::blanks::{blank, unless_empty};
use super::quantity::{QuantityKind, quantity_at};
use super::tokenizer::{Word, tokenize, word_at};

/// Words behind a tolerance that say what it is a share of.
const OF_FRAME: [&str; 9] = ["of", "the", "frame", "image", "picture", "either", "way", "tolerance", "distance"];
/// Words before `within` that make the number behind it a tolerance, and such behind the number.
const EXACT: [&str; 14] = [
    "size",
    "scale",
    "constant",
    "centered",
    "centred",
    "steady",
    "unchanged",
    "same",
    "level",
    "fixed",
    "equal",
    "place",
    "accurate",
    "middle",
];

/// The prompt with blanks in the place of its tolerances, so that every other byte stays where it is. A prompt that says
/// nothing else stays as it is.
pub fn without_tolerances(prompt: &str) -> Cow<'_, str> {
    let words = tokenize(prompt);
    let mut blanked = Cow::Borrowed(prompt);
    let mut at = 0;
    while at < words.len() {
        let Some(end) = tolerance_at(prompt, &words, at) else {
            at += 1;
            continue;
        };
        let leads = at > 0 && word_at(&words, at) == "within" && word_at(&words, at - 1) == "to";
        let first = signed_from(prompt, words[at - usize::from(leads)].span[0]);
        let (from, to) = in_brackets(prompt, first, words[end - 1].span[1]);
        blank(&mut blanked, [from, to]);
        at = end;
    }
    unless_empty(blanked, prompt)
}

/// The word behind the tolerance that begins at word `i`.
fn tolerance_at(prompt: &str, words: &[Word], i: usize) -> Option<usize> {
    let begins = words.get(i)?.span[0];
    let is_signed = signed_from(prompt, begins) < begins && word_at(words, i).starts_with(|c: char| c.is_ascii_digit());
    let start = match word_at(words, i) {
        "within" if is_about_exactness(words, i) => i + 1,
        "plus" if word_at(words, i + 1) == "minus" => i + 2,
        "plus" if word_at(words, i + 1) == "or" && word_at(words, i + 2) == "minus" => i + 3,
        "error" | "deviation" | "jitter"
            if matches!(word_at(words, i + 1), "under" | "below" | "within" | "max" | "<" | "of") =>
        {
            i + 2
        }
        // A drift of 30 cm is a move.
        "drift" if matches!(word_at(words, i + 1), "under" | "max" | "<") => i + 2,
        _ if is_signed => i,
        _ => return None,
    };
    let (len, quantity) = quantity_at(words, start)?;
    let is_share = matches!(quantity.kind, QuantityKind::Percent | QuantityKind::Degrees | QuantityKind::Units);
    let end = start + len;
    let tail = (end..words.len()).take_while(|at| OF_FRAME.contains(&word_at(words, *at))).count();
    is_share.then_some(end + tail)
}

/// Whether `within` at word `i` says how exactly what stands before it is meant: `centred to within 10 %`, not `drops
/// to within 10° of horizontal`.
fn is_about_exactness(words: &[Word], i: usize) -> bool {
    let before = (0..i).rev().take_while(|at| !matches!(word_at(words, *at), "." | "," | ";")).take(5);
    before.into_iter().any(|at| EXACT.contains(&word_at(words, at)))
}

/// The byte at which the sign before byte `at` begins: `±`, `+/-`, `+-`; `at` itself without one.
fn signed_from(prompt: &str, at: usize) -> usize {
    let before = prompt.get(..at).unwrap_or_default().trim_end();
    let sign = ["\u{B1}", "+/-", "+/\u{2212}", "+-", "+ / -", "-/+"].into_iter().find(|sign| before.ends_with(sign));
    sign.map_or(at, |sign| before.len() - sign.len())
}

/// The bytes with the brackets around them, where they hold nothing else.
fn in_brackets(prompt: &str, from: usize, to: usize) -> (usize, usize) {
    let before = prompt.get(..from).unwrap_or_default().trim_end();
    let after = prompt.get(to..).unwrap_or_default();
    let spaces = after.len() - after.trim_start().len();
    if before.ends_with('(') && after.trim_start().starts_with(')') {
        (before.len() - 1, to + spaces + 1)
    } else {
        (from, to)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tolerance_is_no_quantity() {
        let words = |prompt: &str| {
            let left = without_tolerances(prompt);
            assert_eq!(left.len(), prompt.len());
            left.split_whitespace().collect::<Vec<_>>().join(" ")
        };
        assert_eq!(words("centred (±10 % of frame) throughout"), "centred throughout");
        assert_eq!(words("constant radius ±10 %, 6 s"), "constant radius , 6 s");
        assert_eq!(words("orbit 40° (+/- 5°) to the left"), "orbit 40° to the left");
        assert_eq!(words("centred to within 10 % of the frame at all times"), "centred at all times");
        assert_eq!(words("the tilt ends within 10° of horizontal"), "the tilt ends within 10° of horizontal");
        assert_eq!(words("pan +30°, then -20°"), "pan +30°, then -20°");
    }
}

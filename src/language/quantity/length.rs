//! Lengths without a unit: `height 1.6`, `at 1.65`, `a hand's breadth`.

use super::belonging::bare_number;
use super::context::{after_hedges, back, ends_phrase, word_before};
use super::kind::{Found, QuantityKind, found};
use super::topic::turns_before;
use crate::tokenizer::{Word, word_at};

/// Heights that a number with decimals states without a unit.
const HEIGHTS: std::ops::RangeInclusive<f64> = 0.2..=3.5;

/// A length without a unit.
pub(super) fn length_at(words: &[Word], i: usize) -> Option<Found> {
    if let Some(len) = hand_at(words, i) {
        return Some(found(len, QuantityKind::Units, 0.1));
    }
    let (end, value) = bare_number(words, i)?;
    // `Pose A + 0.3 along its forward axis`.
    let is_offset = word_before(words, i, 1) == "+" && word_at(words, end) == "along";
    let is_length = is_named(words, i) && value <= 200.0
        || is_offset
        || HEIGHTS.contains(&value) && word_at(words, i).contains('.') && is_height(words, i, end)
        || climbs(words, i, end) && value <= 200.0;
    is_length.then(|| found(end - i, QuantityKind::Units, value))
}

/// `a hand's breadth`: number of words.
fn hand_at(words: &[Word], i: usize) -> Option<usize> {
    let article = usize::from(matches!(word_at(words, i), "a" | "one"));
    let rest = [0, 1, 2].map(|k| word_at(words, i + article + k));
    matches!(rest, ["hand", "'s", "breadth" | "width"]).then_some(article + 3)
}

/// `height 1.6`, `radius of 3`.
fn is_named(words: &[Word], i: usize) -> bool {
    let is_name =
        |word: &str| matches!(word, "height" | "ht" | "h" | "alt" | "altitude" | "radius" | "r" | "dist" | "distance");
    let start = after_hedges(words, i);
    let before = word_before(words, start, 1);
    let linked = matches!(before, "of" | ":" | "is" | "," | "to" | "hold") && is_name(word_before(words, start, 2));
    // `orbit R 90`: to the right.
    let is_letter = matches!(before, "r" | "h");
    let is_side = is_letter && (turns_before(words, i) || bare_number(words, i).is_some_and(|(_, value)| value > 20.0));
    is_name(before) && before != "distance" && !is_side || linked && (before != "," || word_at(words, i).contains('.'))
}

/// Whether a number with decimals is a height: `at 1.65`, `1.2ish` near a word about heights.
fn is_height(words: &[Word], i: usize, end: usize) -> bool {
    let is_high = |word: &str| {
        matches!(
            word,
            "height"
                | "eye"
                | "eyes"
                | "low"
                | "high"
                | "m"
                | "metre"
                | "meter"
                | "at"
                | "child"
                | "tall"
                | "head"
                | "view"
        )
    };
    ends_phrase(words, end) && back(words, i, 14).any(is_high)
}

/// `climb 25`.
fn climbs(words: &[Word], i: usize, end: usize) -> bool {
    let before = word_before(words, after_hedges(words, i), 1);
    matches!(before, "climb" | "ascend" | "descend" | "fwd" | "forward") && ends_phrase(words, end)
}

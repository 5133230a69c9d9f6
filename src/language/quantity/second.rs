//! Times that single words state: `second 6`, `the last second`, `beat`.

use super::belonging::bare_number;
use super::context::{ends_phrase, word_before};
use super::kind::{Found, QuantityKind, found};
use crate::numerals::cardinal_at;
use crate::tokenizer::{Word, word_at};

/// Number of words in which the last point in time is searched.
const LOOK_BACK: usize = 30;

/// A second with a number or an ordinal, or a beat.
pub(super) fn second_at(words: &[Word], i: usize) -> Option<Found> {
    ordinal_second_at(words, i).or_else(|| lone_beat_at(words, i))
}

/// `second 6` as a point in time, and `the last second`.
fn ordinal_second_at(words: &[Word], i: usize) -> Option<Found> {
    if !matches!(word_at(words, i), "second" | "sec") {
        return None;
    }
    let before = word_before(words, i, 1);
    if let Some((end, secs)) = bare_number(words, i + 1).filter(|_| word_at(words, i) == "second") {
        let after_preposition = matches!(before, "at" | "by" | "until" | "till" | "from" | "after");
        let is_clause = matches!(before, "" | "." | "," | "on" | "to") && ends_phrase(words, end);
        let since = second_before(words, i);
        let duration = if secs > since { secs - since } else { secs };
        return (duration > 0.0 && (after_preposition || is_clause))
            .then(|| found(end - i, QuantityKind::Seconds, duration));
    }
    // `Until the last second` is until the end.
    let leads = (2..=4).any(|back| matches!(word_before(words, i, back), "until" | "till" | "til"));
    let is_last = matches!(before, "last" | "final" | "first" | "opening" | "closing") && !leads;
    is_last.then(|| found(1, QuantityKind::Seconds, 1.0))
}

/// The point in time of the last `second 5` before word `i`; 0 without.
fn second_before(words: &[Word], i: usize) -> f64 {
    let named = |at: usize| (word_at(words, at) == "second").then(|| cardinal_at(words, at + 1)).flatten();
    (i.saturating_sub(LOOK_BACK)..i).rev().find_map(named).map_or(0.0, |(_, secs)| secs)
}

/// `beat` as a clause of its own: one second.
fn lone_beat_at(words: &[Word], i: usize) -> Option<Found> {
    let is_mark = |word: &str| matches!(word, "" | "." | "," | ";" | "then" | "(" | ")");
    (word_at(words, i) == "beat" && is_mark(word_before(words, i, 1)) && is_mark(word_at(words, i + 1)))
        .then(|| found(1, QuantityKind::Seconds, 1.0))
}

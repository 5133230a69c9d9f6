//! Numbers that share the unit of another: `from 1 to 4 m`, `10 m, 30, 60`, `from 10 percent to 90`.

use super::belonging::bare_number;
use super::context::{begins_clause, ends_phrase, word_before};
use super::kind::{Found, QuantityKind, found};
use super::measure::measure_at;
use super::unit::unit;
use crate::numerals::cardinal_at;
use crate::tokenizer::{Word, word_at};

/// Number of words in which the unit is searched.
const LOOK_BACK: usize = 12;

/// A number with the unit of the quantity before, or of the one after `to`.
pub(super) fn ellipsis_at(words: &[Word], i: usize) -> Option<Found> {
    let (end, value) = bare_number(words, i)?;
    // `left 90` is an angle.
    let is_turn = matches!(value as u32, 45 | 90 | 180 | 270 | 360)
        && matches!(word_before(words, i, 1), "left" | "right" | "up" | "down");
    if is_turn {
        return None;
    }
    let shared = || unit_after(words, i, end).or_else(|| unit_before(words, i, end));
    let (kind, scale) = corrected_unit(words, i, end).or_else(shared)?;
    Some(found(end - i, kind, value * scale))
}

/// The unit of `from 1 to 4 m` at the 1.
fn unit_after(words: &[Word], i: usize, end: usize) -> Option<(QuantityKind, f64)> {
    let is_first = word_before(words, i, 1) == "from" && matches!(word_at(words, end), "to" | ">" | "down" | "up");
    let next = end + 1 + usize::from(word_at(words, end + 1) == "to");
    let (len, _) = cardinal_at(words, next).filter(|_| is_first)?;
    unit(word_at(words, next + len)).filter(|(kind, _)| is_shared(*kind))
}

/// The unit of the last measure before a number that ends its phrase.
fn unit_before(words: &[Word], i: usize, end: usize) -> Option<(QuantityKind, f64)> {
    let before = word_before(words, i, 1);
    let is_end =
        matches!(before, "to" | "at" | "from" | "then" | "forward" | "back" | "left" | "right" | "up" | "down" | "or");
    let in_list = before == "," && matches!(word_at(words, end), "," | "." | "" | "and" | "then");
    let is_direction =
        begins_clause(words, i) && matches!(word_at(words, end), "up" | "down" | "back" | "off" | "high");
    // `One metre forward, two to the right`.
    let is_aside = begins_clause(words, i)
        && word_at(words, end) == "to"
        && matches!(word_at(words, end + 1), "the" | "your" | "its")
        && matches!(word_at(words, end + 2), "left" | "right");
    if !(is_end && ends_phrase(words, end) || in_list || is_direction || is_aside) {
        return None;
    }
    let first = i.saturating_sub(LOOK_BACK);
    let (at, (kind, scale)) = (first..i).rev().find_map(|at| Some((at, unit(word_at(words, at))?)))?;
    let is_measure = at.checked_sub(1).is_some_and(|number| measure_at(words, number).is_some());
    let is_near = !in_list || i - at <= 4;
    (is_measure && is_near && is_shared(kind)).then_some((kind, scale))
}

/// The unit of the measure that a number puts right: `over 5 seconds, make that 7`.
fn corrected_unit(words: &[Word], i: usize, end: usize) -> Option<(QuantityKind, f64)> {
    let is_that = matches!(word_before(words, i, 1), "that" | "it") && word_before(words, i, 2) == "make";
    let is_word = matches!(word_before(words, i, 1), "no" | "rather" | "actually" | "sorry" | "say");
    if !(is_that || is_word) || !ends_phrase(words, end) {
        return None;
    }
    let first = i.saturating_sub(6);
    let (at, found) = (first..i).rev().find_map(|at| Some((at, unit(word_at(words, at))?)))?;
    at.checked_sub(1).is_some_and(|number| measure_at(words, number).is_some()).then_some(found)
}

/// Whether a number may go without this unit.
fn is_shared(kind: QuantityKind) -> bool {
    matches!(kind, QuantityKind::Units | QuantityKind::Percent)
}

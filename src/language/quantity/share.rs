//! Shares of the frame: `40%`, `half the frame`, `two thirds of the frame height`, `1/10 of the picture`.

use super::context::{sentence_back, word_before};
use super::kind::{Found, QuantityKind, found};
use super::topic::is_picture;
use crate::numerals::{Numeral, NumeralForm, numeral_at};
use crate::tokenizer::{Word, word_at};

/// A share of the frame in words.
pub(super) fn share_at(words: &[Word], i: usize) -> Option<Found> {
    let percent = |len, share: f64| found(len, QuantityKind::Percent, 100.0 * share);
    if let Some(len) = whole_height_at(words, i) {
        return Some(percent(len, 1.0));
    }
    let number = fraction_at(words, i)?;
    let end = i + number.len;
    if let Some(of_picture) = picture_at(words, end) {
        return Some(percent(number.len + of_picture, number.value));
    }
    // `from a fifth to half of the frame`
    let next = fraction_at(words, end + 1).filter(|_| word_at(words, end) == "to");
    let to_share = next.is_some_and(|next| picture_at(words, end + 1 + next.len).is_some());
    let is_alone = (number.value - 0.5).abs() > 1e-9 && is_alone(words, i, end);
    (to_share || is_alone).then(|| percent(number.len, number.value))
}

/// A fraction below 1 that is no ordinal and no count.
fn fraction_at(words: &[Word], i: usize) -> Option<Numeral> {
    let is_part_of_time = matches!(
        word_before(words, i, 1),
        "first" | "second" | "last" | "other" | "left" | "right" | "upper" | "lower"
    );
    let number = numeral_at(words, i).filter(|n| n.form == NumeralForm::Fraction && n.value < 1.0)?;
    let is_side =
        matches!(word_at(words, i + number.len), "view" | "shot" | "front" | "profile" | "angle" | "rear" | "back");
    (!is_part_of_time && !is_side).then_some(number)
}

/// Number of words of `of the frame height` at word `i`, without `of` and article too.
fn picture_at(words: &[Word], i: usize) -> Option<usize> {
    let mut at = i;
    at += usize::from(word_at(words, at) == "of");
    at += usize::from(matches!(word_at(words, at), "the" | "its" | "our" | "my" | "your" | "whole" | "full"));
    at += usize::from(matches!(word_at(words, at), "whole" | "full" | "total"));
    let word = word_at(words, at);
    if is_picture(word) {
        at += 1 + usize::from(word_at(words, at + 1) == "'s");
        at += usize::from(is_side(word_at(words, at)));
        return Some(at - i);
    }
    // `half the height of the tower` is no share of the frame.
    let of_thing = word_at(words, at + 1) == "of" && !(at + 2..at + 4).any(|k| is_picture(word_at(words, k)));
    let follows_of = matches!(word_before(words, i, 1), "of" | "the");
    if !is_side(word) || of_thing || at == i && !follows_of {
        return None;
    }
    let of_picture = if word_at(words, at + 1) == "of" { picture_at(words, at + 1).unwrap_or(0) } else { 0 };
    Some(at + 1 + of_picture - i)
}

fn is_side(word: &str) -> bool {
    matches!(word, "height" | "width" | "size" | "area" | "hight" | "heigth")
}

/// `full frame height`, `the full height` in a sentence about the frame: number of words.
fn whole_height_at(words: &[Word], i: usize) -> Option<usize> {
    let is_full = |at: usize| matches!(word_at(words, at), "full" | "whole" | "entire");
    let the = usize::from(word_at(words, i) == "the");
    if !is_full(i + the) {
        return None;
    }
    match [1, 2].map(|k| word_at(words, i + the + k)) {
        [picture, "height" | "width"] if is_picture(picture) => Some(3 + the),
        ["height" | "width", "of"] if (3..6).any(|k| is_picture(word_at(words, i + the + k))) => {
            picture_at(words, i + the + 2).map(|len| 2 + the + len)
        }
        ["height" | "width", next] if next != "of" && sentence_back(words, i, 12).any(is_picture) => Some(2 + the),
        _ => None,
    }
}

/// Whether a fraction ends its phrase in a sentence about the picture: `small in the picture, like a tenth`.
fn is_alone(words: &[Word], i: usize, end: usize) -> bool {
    // `Three quarters of it`.
    let end = end + usize::from(word_before(words, end, 1) == "of" && word_at(words, end) == "it");
    matches!(word_at(words, end), "" | "." | "," | ";" | ")" | "and" | "then" | "!" | "when" | "at" | "by")
        && sentence_back(words, i, 24).any(|word| is_picture(word) || word.starts_with("fill"))
}

//! Words that only look like a measure: `a second orbit`, `an S`, `the 80s`, `2 m/s`, `30% slower`.

use super::context::{back, is_joined, word_before};
use super::kind::QuantityKind;
use super::unit::unit;
use crate::numerals::{Numeral, NumeralForm};
use crate::tokenizer::{SIGNED, Word, is_listed, word_at};

/// Longest focal length that is read, in millimeters. Beyond it `mm` is a length.
const MAX_FOCAL_MM: f64 = 1000.0;

/// Words between a turn or a way and the sign of its amount: `an offset of minus 2 units`, `pose A minus 2 units`.
const BEFORE_SIGN: &str = "of by a";

/// Whether a number and the word after it only look like a measure: `a second orbit`, `an S`, `the 80s`, `1880s`.
pub(super) fn is_no_measure(words: &[Word], i: usize, unit_idx: usize, number: Numeral) -> bool {
    let unit_word = word_at(words, unit_idx);
    let is_article = number.form == NumeralForm::Article;
    let letter = is_article && unit_word.len() <= 2;
    let ordinal = is_article && unit_word == "second" && !second_is_time(words, i, unit_idx + 1);
    let before = word_before(words, i, 2);
    let is_signed = before == "plus" || is_listed(SIGNED, before) || is_listed(BEFORE_SIGN, before);
    let is_negative = matches!(word_before(words, i, 1), "minus" | "negative") && !is_signed;
    let is_label = unit_word == "beat" && word_before(words, i, 1) == "beat";
    let of_each =
        is_article && is_rate(words, i) || is_article && word_at(words, i) != "another" && unit_word == "unit";
    let decade = unit_word == "s"
        && is_joined(words, unit_idx)
        && ((1500.0..2100.0).contains(&number.value) && word_at(words, i).len() == 4
            || matches!(
                word_at(words, unit_idx + 1),
                "style" | "music" | "vibe" | "vibes" | "movie" | "film" | "feel" | "look"
            )
            || is_decade(words, i, number.value));
    letter || ordinal || is_negative || is_label || of_each || decade || matches!(unit_word, "count") && is_article
}

/// Whether a number of tens is one of years: `since the 70s`, `from the early 60s`.
fn is_decade(words: &[Word], i: usize, value: f64) -> bool {
    let before = word_before(words, i, 1);
    let article = if matches!(before, "early" | "late" | "mid") { word_before(words, i, 2) } else { before };
    let leads = ["the", "early", "late", "mid"].contains(&article);
    let since = (1..4).any(|n| matches!(word_before(words, i, n), "since" | "from" | "in" | "of" | "during" | "back"));
    leads && since && value % 10.0 == 0.0 && (20.0..100.0).contains(&value)
}

/// Whether a percentage at words `i..end` is none of the frame: `30% slower`, `the last 10 percent`, `30% off teapots`.
pub(super) fn is_no_share(words: &[Word], i: usize, end: usize) -> bool {
    let compares = matches!(
        word_at(words, end),
        "slower"
            | "faster"
            | "quicker"
            | "higher"
            | "lower"
            | "wider"
            | "brighter"
            | "darker"
            | "more"
            | "less"
            | "longer"
            | "shorter"
            | "speed"
            | "overlap"
            | "opacity"
    );
    // `30% off teapots` is a price; `30% off center` is a place.
    let is_price = word_at(words, end) == "off"
        && !matches!(word_at(words, end + 1), "center" | "centre" | "axis" | "the" | "screen" | "frame" | "to")
        || matches!(word_at(words, end), "discount" | "cheaper" | "sale" | "cotton" | "sure");
    compares || is_price || matches!(word_before(words, i, 1), "last" | "first" | "remaining")
}

/// Whether the unit before word `i` is the first half of a speed: `/ s`, `per second`, `a second`.
pub(super) fn is_rate(words: &[Word], i: usize) -> bool {
    let is_time = |at: usize| {
        matches!(
            word_at(words, at),
            "s" | "sec" | "second" | "seconds" | "minute" | "min" | "h" | "hr" | "hour" | "frame"
        )
    };
    match word_at(words, i) {
        "/" | "per" => is_time(i + 1),
        // `hold two beats a second time` does not occur; a time after another unit is its rate.
        "a" | "each" => {
            is_time(i + 1) && unit(word_before(words, i, 1)).is_some_and(|(kind, _)| kind != QuantityKind::Seconds)
        }
        _ => false,
    }
}

/// Whether `mm` after `value`, which ends before word `end`, is a length and no focal length.
pub(super) fn is_length(words: &[Word], i: usize, end: usize, value: f64) -> bool {
    let is_lens = |word: &str| matches!(word, "lens" | "prime" | "equiv" | "equivalent" | "look" | "glass");
    let moves = back(words, i, 3).any(|word| {
        matches!(
            word,
            "move" | "slide" | "truck" | "raise" | "rise" | "lower" | "shift" | "nudge" | "back" | "up" | "down"
        )
    });
    let direction = matches!(
        word_at(words, end),
        "away"
            | "closer"
            | "nearer"
            | "further"
            | "farther"
            | "above"
            | "higher"
            | "lower"
            | "up"
            | "down"
            | "forward"
            | "sideways"
    );
    value > MAX_FOCAL_MM || direction || moves && !is_lens(word_at(words, end))
}

/// Whether `a second`, between word `i` and word `next`, is a time. Otherwise `second` is an ordinal.
fn second_is_time(words: &[Word], i: usize, next: usize) -> bool {
    matches!(
        word_before(words, i, 1),
        "for"
            | "hold"
            | "over"
            | "pause"
            | "wait"
            | "about"
            | "lasting"
            | "takes"
            | "taking"
            | "within"
            | "stay"
            | "linger"
            | "rest"
            | "holding"
            | "pausing"
            | "just"
            | "holds"
            | "pauses"
            | "around"
            | "there"
            | "still"
            | "held"
    ) || matches!(
        word_at(words, next),
        "" | "."
            | ","
            | ";"
            | "then"
            | "and"
            | "before"
            | "while"
            | ")"
            | "hold"
            | "pause"
            | "or"
            | "each"
            | "apiece"
            | "on"
            | "in"
            | "with"
            | "until"
            | "till"
            | "there"
            | "longer"
            | "per"
    )
}

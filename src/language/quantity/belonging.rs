//! Numbers that belong to something else: `scene 12`, `16:9`, `24 fps`, `3 chairs`.

use super::context::{is_joined, word_before};
use super::topic::TURNING;
use super::unit::unit;
use crate::numerals::{NumeralForm, numeral_at};
use crate::tokenizer::{Word, word_at};

/// The number in digits or words at word `i` as the index after it and its value, unless it belongs to something else.
pub(super) fn bare_number(words: &[Word], i: usize) -> Option<(usize, f64)> {
    let number = numeral_at(words, i).filter(|number| number.form == NumeralForm::Number)?;
    let end = i + number.len;
    (!belongs_elsewhere(words, i, end)).then_some((end, number.value))
}

/// Whether the number at words `i..end` belongs to something else: `scene 12`, `16:9`, `f/2.8`, `24 fps`, `3 chairs`.
pub(super) fn belongs_elsewhere(words: &[Word], i: usize, end: usize) -> bool {
    let after_mark = matches!(word_before(words, i, 1), "/" | ":" | "#" | "." | "x") && is_joined(words, i);
    let before_mark = matches!(word_at(words, end), "/" | ":" | "x") && is_joined(words, end);
    let label = match word_before(words, i, 1) {
        "#" | "no" | "nr" | "number" => word_before(words, i, 2),
        word => word,
    };
    let is_number = |at: usize| word_at(words, at).starts_with(|c: char| c.is_ascii_digit());
    let is_hyphened = |at: usize| words.get(at).is_some_and(|word| word.after_hyphen);
    let in_range = is_hyphened(i) && i > 0 && is_number(i - 1) || is_hyphened(end);
    after_mark
        || before_mark
        || in_range
        || is_joined(words, end) && is_number(end + 1) && word_at(words, end) != ","
        || is_label(label)
        || is_foreign_unit(word_at(words, end))
        || is_counted(words, end)
        || unit(word_at(words, end)).is_some()
}

/// Whether word `i` is a noun in the plural, which a number before it counts.
pub(super) fn is_counted(words: &[Word], i: usize) -> bool {
    let Some(word) = words.get(i).filter(|word| word.is_alphabetic()) else { return false };
    let is_move = TURNING.contains(&word.text.as_str()) || word.text.ends_with("wards");
    word.stem != word.text
        && !is_move
        && !matches!(word.text.as_str(), "always" | "widdershins" | "lens" | "across" | "is" | "this" | "degs")
}

/// Whether a number after this word is a name.
fn is_label(word: &str) -> bool {
    matches!(
        word,
        "scene"
            | "sc"
            | "shot"
            | "take"
            | "setup"
            | "step"
            | "version"
            | "ver"
            | "v"
            | "chapter"
            | "part"
            | "iso"
            | "f"
            | "t"
            | "page"
            | "room"
            | "bay"
            | "lot"
            | "item"
            | "day"
            | "act"
            | "slate"
            | "option"
            | "floor"
            | "phase"
            | "section"
            | "#"
            | "no"
            | "nr"
            | "number"
            | "row"
            | "station"
            | "sh"
            | "type"
    )
}

/// Whether a number after this word heads a shot list: `cam 3 - 9 sec`.
pub(super) fn is_heading(word: &str) -> bool {
    is_label(word) || matches!(word, "cam" | "camera" | "cut" | "unit" | "reel" | "clip" | "frame" | "panel")
}

/// Whether a number before this word is of a dimension that prompts cannot state.
fn is_foreign_unit(word: &str) -> bool {
    matches!(
        word,
        "k" | "p"
            | "i"
            | "fps"
            | "x"
            | "frames"
            | "frame"
            | "fr"
            | "km"
            | "kph"
            | "kmh"
            | "mph"
            | "hz"
            | "khz"
            | "px"
            | "pixel"
            | "bpm"
            | "rpm"
            | "d"
            | "st"
            | "nd"
            | "rd"
            | "th"
            | "iso"
            | "times"
            | "o"
            | "am"
            | "pm"
            | "mb"
            | "gb"
            | "kg"
            | "percent"
            | "%"
            | "mm"
            | "years"
            | "year"
            | "e"
            | "points"
            | "steps"
            | "stops"
    )
}

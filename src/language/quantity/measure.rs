//! Numbers with a unit: `2.5 s`, `1,5 m`, `6'2"`, `a metre and a half`, `35 mm`.

use super::belonging::is_heading;
use super::context::{is_dash, is_joined, word_before};
use super::kind::{Found, QuantityKind, found};
use super::lookalike::{is_length, is_no_measure, is_no_share, is_rate};
use super::unit::{number_at, unit_at};
use crate::numerals::{Numeral, NumeralForm, cardinal_at};
use crate::tokenizer::{Word, word_at};

/// A number with a unit.
pub(super) fn measure_at(words: &[Word], i: usize) -> Option<Found> {
    if let Some(half_more) = one_and_a_half_at(words, i) {
        return Some(half_more);
    }
    let number = number_at(words, i)?;
    if let Some(first) = first_lens_angle(words, i, number) {
        return Some(first);
    }
    let number = mean_of_range(words, i, number);
    let unit_idx = i + number.len + modifier_at(words, i + number.len);
    let (unit_len, kind, scale) = unit_at(words, unit_idx)?;
    let end = unit_idx + unit_len;
    if kind == QuantityKind::Percent && is_no_share(words, i, end) {
        return None;
    }
    let is_zoom_range = kind == QuantityKind::Millimeters && words.get(i).is_some_and(|word| word.after_hyphen);
    if is_no_measure(words, i, unit_idx, number) || is_rate(words, end) || is_zoom_range {
        return None;
    }
    let (len, value) = with_rest(words, end, number.value * scale, scale);
    match kind {
        QuantityKind::Millimeters if is_length(words, i, end, number.value) => {
            Some(found(end + len - i, QuantityKind::Units, value / 1000.0))
        }
        _ => Some(found(end + len - i, kind, value)),
    }
}

/// The first of two angles between which a lens or an elevation changes: the 50 of `from 50 to 25 degrees FOV`.
fn first_lens_angle(words: &[Word], i: usize, first: Numeral) -> Option<Found> {
    let next = i + first.len;
    let (len, _) = cardinal_at(words, next + 1).filter(|_| word_at(words, next) == "to")?;
    let (unit_len, kind, scale) = unit_at(words, next + 1 + len)?;
    let end = next + 1 + len + unit_len;
    let is_angle = |word: &str| matches!(word, "fov" | "vfov" | "hfov" | "elevation" | "view");
    let is_about = (1..=4).any(|k| is_angle(word_before(words, i, k)))
        || (0..4).map_while(|k| Some(word_at(words, end + k)).filter(|word| *word != ".")).any(is_angle);
    (kind == QuantityKind::Degrees && is_about).then(|| found(first.len, kind, first.value * scale))
}

/// `sec and a half`, `a second and a half` without a number.
fn one_and_a_half_at(words: &[Word], i: usize) -> Option<Found> {
    let scale = match word_at(words, i) {
        "sec" => 1.0,
        "minute" | "min" => 60.0,
        _ => return None,
    };
    let is_first = cardinal_at(words, i.checked_sub(1).unwrap_or(words.len())).is_none();
    let rest = [1, 2, 3].map(|k| word_at(words, i + k));
    (is_first && rest == ["and", "a", "half"]).then(|| found(4, QuantityKind::Seconds, 1.5 * scale))
}

/// Number of words between a number and its unit: `full`, `more`, `ish`.
fn modifier_at(words: &[Word], i: usize) -> usize {
    usize::from(matches!(
        word_at(words, i),
        "full"
            | "whole"
            | "complete"
            | "entire"
            | "good"
            | "solid"
            | "more"
            | "extra"
            | "long"
            | "slow"
            | "short"
            | "odd"
            | "ish"
            | "lovely"
            | "quiet"
            | "clean"
    ))
}

/// `and a half` of the unit, or the smaller part of `6'2"`, `one metre eighty`, `1m80`: number of words, value with it.
fn with_rest(words: &[Word], i: usize, value: f64, scale: f64) -> (usize, f64) {
    match [0, 1, 2].map(|k| word_at(words, i + k)) {
        ["and", "half", next] if !matches!(next, "of" | "the" | "a") => return (2, value + 0.5 * scale),
        ["and", "a", "half"] if is_and_half_of_unit(words, i) => return (3, value + 0.5 * scale),
        ["and", "a", "quarter"] if is_and_half_of_unit(words, i) => return (3, value + 0.25 * scale),
        _ => {}
    }
    let Some((len, rest)) = cardinal_at(words, i) else { return (0, value) };
    let before = word_before(words, i, 1);
    let has_unit = unit_at(words, i + len).is_some();
    let is_inches = matches!(word_at(words, i + len), "inch" | "inches" | "\"" | "in");
    match before {
        "'" | "foot" | "feet" | "ft" if is_inches => (len + 1, value + rest * 0.0254),
        "'" | "foot" if rest < 12.0 && !has_unit && (before == "foot" || is_joined(words, i)) => {
            (len, value + rest * 0.0254)
        }
        "m" | "meter" | "metre" | "meters" | "metres" if !has_unit && (10.0..100.0).contains(&rest) => {
            (len, value + rest / 100.0)
        }
        _ => (0, value),
    }
}

/// Whether `and a half` at word `i` belongs to the unit before it and has no noun of its own.
fn is_and_half_of_unit(words: &[Word], i: usize) -> bool {
    !matches!(word_at(words, i + 3), "turn" | "circle" | "orbit" | "step" | "second" | "way")
}

/// The mean of `5 to 6` or `5 - 6` before a unit; `first` itself where no range begins.
fn mean_of_range(words: &[Word], i: usize, first: Numeral) -> Numeral {
    let is_of_clock = word_before(words, i, 1) == ":" && is_joined(words, i);
    let next = i + first.len;
    // `Cam 3 - 9 sec`: the first number is a name.
    let is_name = is_dash(words, next) && is_heading(word_before(words, i, 1));
    if first.form != NumeralForm::Number || is_of_clock || is_name {
        return first;
    }
    let link = usize::from(matches!(word_at(words, next), "to" | "or" | "," | "/"));
    let Some((len, value)) = cardinal_at(words, next + link) else { return first };
    let Some((_, kind, _)) = unit_at(words, next + link + len) else { return first };
    let is_hyphen = words.get(next).is_some_and(|word| word.after_hyphen);
    let is_range = match word_at(words, next) {
        "or" => true,
        "to" if word_before(words, i, 1) == "from" => !matches!(kind, QuantityKind::Units | QuantityKind::Percent),
        "to" => kind != QuantityKind::Percent,
        "," | "/" => is_dash(words, next),
        _ => is_hyphen || are_alike(words, i, next) && (0.0..=2.0).contains(&(value - first.value)),
    };
    if is_range && kind != QuantityKind::Millimeters {
        return Numeral {
            len: first.len + link + len,
            value: f64::midpoint(first.value, value),
            form: NumeralForm::Number,
        };
    }
    first
}

/// Whether the numbers at words `i` and `next` are both in digits or both in words.
fn are_alike(words: &[Word], i: usize, next: usize) -> bool {
    let is_figure = |at: usize| word_at(words, at).starts_with(|c: char| c.is_ascii_digit());
    is_figure(i) == is_figure(next)
}

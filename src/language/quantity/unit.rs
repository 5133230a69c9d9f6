//! Units, and numbers before a unit.

use super::context::is_joined;
use super::kind::QuantityKind;
use crate::numerals::{Numeral, NumeralForm, numeral_at};
use crate::tokenizer::{Word, word_at};

/// Kind and scale of a unit.
pub(crate) fn unit(word: &str) -> Option<(QuantityKind, f64)> {
    Some(match word {
        "s" | "sec" | "secs" | "second" | "seconds" | "beat" | "beats" | "count" | "counts" | "secconds"
        | "secound" | "secounds" | "seconde" | "seconden" | "sek" => (QuantityKind::Seconds, 1.0),
        "min" | "mins" | "minute" | "minutes" => (QuantityKind::Seconds, 60.0),
        "degree" | "degrees" | "deg" | "degs" | "grade" | "grades" | "grados" | "\u{B0}" => {
            (QuantityKind::Degrees, 1.0)
        }
        "m" | "meter" | "meters" | "metre" | "metres" | "unit" | "units" | "metros" | "mtr" | "mtrs" => {
            (QuantityKind::Units, 1.0)
        }
        "cm" | "cms" | "centimeter" | "centimeters" | "centimetre" | "centimetres" => (QuantityKind::Units, 0.01),
        "ft" | "foot" | "feet" | "'" => (QuantityKind::Units, 0.3048),
        "inch" | "inches" | "\"" => (QuantityKind::Units, 0.0254),
        "yard" | "yards" | "yd" | "yds" => (QuantityKind::Units, 0.9144),
        "mm" | "millimeter" | "millimeters" | "millimetre" | "millimetres" | "mil" | "mill" => {
            (QuantityKind::Millimeters, 1.0)
        }
        "%" | "percent" | "pct" => (QuantityKind::Percent, 1.0),
        _ => return None,
    })
}

/// The unit at word `i`: number of words, kind, scale.
pub(super) fn unit_at(words: &[Word], i: usize) -> Option<(usize, QuantityKind, f64)> {
    if word_at(words, i) == "per" && word_at(words, i + 1) == "cent" {
        return Some((2, QuantityKind::Percent, 1.0));
    }
    if matches!(word_at(words, i), "scene" | "world") && matches!(word_at(words, i + 1), "unit" | "units") {
        return Some((2, QuantityKind::Units, 1.0));
    }
    unit(word_at(words, i)).map(|(kind, scale)| (1, kind, scale))
}

/// Whether word `i` is a unit of time.
pub(super) fn is_time_unit(words: &[Word], i: usize) -> bool {
    unit(word_at(words, i)).is_some_and(|(kind, _)| kind == QuantityKind::Seconds)
}

/// Scale of the unit of time at word `i`.
pub(super) fn time_scale(words: &[Word], i: usize) -> Option<f64> {
    unit(word_at(words, i)).filter(|(kind, _)| *kind == QuantityKind::Seconds).map(|(_, scale)| scale)
}

/// Whether word `i` is a number beyond those that are read: a million or more in digits, a thousand or more in words
/// before a unit, or one with an exponent.
pub(crate) fn is_unread_number(words: &[Word], i: usize) -> bool {
    let word = word_at(words, i);
    let is_large = word.starts_with(|c: char| c.is_ascii_digit()) && word.parse::<f64>().is_ok_and(|v| v >= 1e6);
    let is_power = matches!(word, "thousand" | "million" | "billion" | "trillion");
    is_large || is_power && unit(word_at(words, i + 1)).is_some() || has_exponent(words, i)
}

/// Whether a number as `5e9` begins at word `i`.
fn has_exponent(words: &[Word], i: usize) -> bool {
    let is_digits = |at: usize| word_at(words, at).starts_with(|c: char| c.is_ascii_digit());
    is_digits(i)
        && word_at(words, i + 1) == "e"
        && is_joined(words, i + 1)
        && is_joined(words, i + 2)
        && is_digits(i + 2)
}

/// The numeral at word `i`, with a decimal comma if a unit follows; none inside `5e9`.
pub(super) fn number_at(words: &[Word], i: usize) -> Option<Numeral> {
    if has_exponent(words, i) || i >= 2 && has_exponent(words, i - 2) {
        return None;
    }
    let number = numeral_at(words, i)?;
    let decimals = word_at(words, i + 2);
    let has_comma = number.len == 1
        && word_at(words, i + 1) == ","
        && is_joined(words, i + 1)
        && is_joined(words, i + 2)
        && decimals.bytes().all(|byte| byte.is_ascii_digit());
    let value = format!("{}.{decimals}", word_at(words, i)).parse::<f64>().ok();
    match value.filter(|_| has_comma && decimals.len() < 3 && unit(word_at(words, i + 3)).is_some()) {
        Some(value) => Some(Numeral { len: 3, value, form: NumeralForm::Number }),
        None => Some(number),
    }
}

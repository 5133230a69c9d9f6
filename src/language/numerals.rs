//! Numbers in digits and in words.

use super::quantity::is_joined;
use super::tokenizer::{Word, word_at};

const ONES: [&str; 20] = [
    "zero",
    "one",
    "two",
    "three",
    "four",
    "five",
    "six",
    "seven",
    "eight",
    "nine",
    "ten",
    "eleven",
    "twelve",
    "thirteen",
    "fourteen",
    "fifteen",
    "sixteen",
    "seventeen",
    "eighteen",
    "nineteen",
];
const TENS: [&str; 10] = ["", "", "twenty", "thirty", "forty", "fifty", "sixty", "seventy", "eighty", "ninety"];

/// The English word for a whole number up to twenty; `None` above.
pub fn number_word(value: u32) -> Option<&'static str> {
    if value == 20 { Some("twenty") } else { ONES.get(value as usize).copied() }
}

/// How a numeral is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum NumeralForm {
    /// In digits or number words.
    Number,
    /// As `half`, `a quarter`, `a couple`.
    Fraction,
    /// As `a`, `an` or `another`.
    Article,
}

/// A numeral of the text.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Numeral {
    /// Number of words.
    pub(crate) len: usize,
    pub(crate) value: f64,
    pub(crate) form: NumeralForm,
}

/// The numeral that begins at word `i`, fractions and `a` included.
pub(crate) fn numeral_at(words: &[Word], i: usize) -> Option<Numeral> {
    let fraction = |len, value| Some(Numeral { len, value, form: NumeralForm::Fraction });
    match (word_at(words, i), word_at(words, i + 1), word_at(words, i + 2)) {
        ("half", "a" | "an", _) | ("a", "half", _) => return fraction(2, 0.5),
        ("half", "of", "a" | "an") => return fraction(3, 0.5),
        ("half", _, _) => return fraction(1, 0.5),
        ("a" | "one" | "1", part, _) if denominator(part).is_some() => {
            return fraction(2 + of_a(words, i + 2), 1.0 / denominator(part)?);
        }
        ("a", "couple", next) => return fraction(2 + usize::from(next == "of"), 2.0),
        ("couple", next, _) => return fraction(1 + usize::from(next == "of"), 2.0),
        ("a", "few", _) => return fraction(2, 3.0),
        ("few", _, _) => return fraction(1, 3.0),
        ("three" | "3", "quarter" | "quarters", _) => return fraction(2 + of_a(words, i + 2), 0.75),
        ("two" | "2", "third" | "thirds", _) => return fraction(2 + of_a(words, i + 2), 2.0 / 3.0),
        (_, parts, _) if several_parts(words, i, parts).is_some() => {
            return fraction(2 + of_a(words, i + 2), several_parts(words, i, parts)?);
        }
        (part, "of", _) if denominator(part).is_some() && !is_ordinal(words, i) => {
            return fraction(1 + of_a(words, i + 1), 1.0 / denominator(part)?);
        }
        ("quarter", _, _) => return fraction(1 + of_a(words, i + 1), 0.25),
        _ => {}
    }
    if let Some((len, value)) = cardinal_at(words, i) {
        return Some(with_fraction(words, i, len, value));
    }
    matches!(word_at(words, i), "a" | "an" | "another").then_some(Numeral {
        len: 1,
        value: 1.0,
        form: NumeralForm::Article,
    })
}

/// Whether the fraction at word `i` follows an article that makes it an ordinal: `the third of them`.
fn is_ordinal(words: &[Word], i: usize) -> bool {
    i.checked_sub(1).is_some_and(|before| matches!(word_at(words, before), "the" | "two" | "three" | "2" | "3"))
}

/// `Three fifths`, less than one.
fn several_parts(words: &[Word], i: usize, parts: &str) -> Option<f64> {
    let (len, count) = cardinal_at(words, i)?;
    let share = count / denominator(parts.strip_suffix('s')?)?;
    (len == 1 && share < 1.0).then_some(share)
}

/// The denominator of a fraction in words.
fn denominator(word: &str) -> Option<f64> {
    Some(match word {
        "third" => 3.0,
        "quarter" | "fourth" => 4.0,
        "fifth" => 5.0,
        "sixth" => 6.0,
        "eighth" => 8.0,
        "tenth" => 10.0,
        _ => return None,
    })
}

/// Number of words of `of a` or `of the` at word `i`; 0 without.
fn of_a(words: &[Word], i: usize) -> usize {
    if word_at(words, i) != "of" {
        return 0;
    }
    1 + usize::from(matches!(word_at(words, i + 1), "a" | "an" | "the"))
}

/// The cardinal of `len` words at word `i` with `and a half`, `and a quarter` or a denominator after it.
fn with_fraction(words: &[Word], i: usize, len: usize, value: f64) -> Numeral {
    if let Some(mixed) = mixed_number_at(words, i, len, value) {
        return mixed;
    }
    match (word_at(words, i + len), word_at(words, i + len + 1), word_at(words, i + len + 2)) {
        ("and", "half", _) => Numeral { len: len + 2, value: value + 0.5, form: NumeralForm::Number },
        ("and", "a", "half") => Numeral { len: len + 3, value: value + 0.5, form: NumeralForm::Number },
        ("and", "a", "quarter") => Numeral { len: len + 3, value: value + 0.25, form: NumeralForm::Number },
        // `shot 014 / 35mm` is no fraction.
        ("/", below, _) if is_joined(words, i + len) && below.parse::<f64>().is_ok_and(|d| d > 0.0) => {
            let below: f64 = below.parse().unwrap_or(1.0);
            Numeral { len: len + 2, value: value / below, form: NumeralForm::Fraction }
        }
        _ => Numeral { len, value, form: NumeralForm::Number },
    }
}

/// A whole number with a fraction in digits after it: `1 1/2`.
fn mixed_number_at(words: &[Word], i: usize, len: usize, value: f64) -> Option<Numeral> {
    let digit = |at: usize| word_at(words, at).parse::<f64>().ok().filter(|digit| (1.0..10.0).contains(digit));
    let (above, below) = (digit(i + len)?, digit(i + len + 2)?);
    let is_fraction = word_at(words, i + len + 1) == "/" && above < below;
    is_fraction.then_some(Numeral { len: len + 3, value: value + above / below, form: NumeralForm::Number })
}

/// The cardinal number in digits or words at word `i`: number of words, value.
pub(crate) fn cardinal_at(words: &[Word], i: usize) -> Option<(usize, f64)> {
    let first = word_at(words, i);
    if first.starts_with(|c: char| c.is_ascii_digit() || c == '.') {
        return first.parse::<f64>().ok().filter(|v| v.is_finite() && *v < 1e6).map(|v| (1, v));
    }
    if let Some(hundreds) = hundreds_at(words, i) {
        return Some(hundreds);
    }
    below_hundred_at(words, i)
}

fn hundreds_at(words: &[Word], i: usize) -> Option<(usize, f64)> {
    let many = match word_at(words, i) {
        "a" => Some(1),
        word => ONES.iter().position(|name| *name == word),
    }?;
    if word_at(words, i + 1) != "hundred" {
        return None;
    }
    let and = usize::from(word_at(words, i + 2) == "and");
    let (len, rest) = below_hundred_at(words, i + 2 + and).map_or((2, 0.0), |(len, rest)| (2 + and + len, rest));
    Some((len, many as f64 * 100.0 + rest))
}

fn below_hundred_at(words: &[Word], i: usize) -> Option<(usize, f64)> {
    let word = word_at(words, i);
    if word.is_empty() {
        return None;
    }
    if let Some(value) = ONES.iter().position(|name| *name == word) {
        return Some((1, value as f64));
    }
    let tens = TENS.iter().position(|name| *name == word)? as f64 * 10.0;
    let ones = ONES.iter().position(|name| *name == word_at(words, i + 1)).filter(|ones| (1..=9).contains(ones));
    Some(ones.map_or((1, tens), |ones| (2, tens + ones as f64)))
}

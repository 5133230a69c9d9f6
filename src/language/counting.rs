//! Numbers in words and figures at a place of a sentence.

use super::words::Word;

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

/// The word for a whole number up to twenty.
pub fn number_word(value: u32) -> Option<&'static str> {
    if value == 20 { Some("twenty") } else { ONES.get(value as usize).copied() }
}

/// How a number was said.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Said {
    /// In figures or number words.
    Number,
    /// As `half`, `a quarter`, `one and a half`.
    Fraction,
    /// As `a` or `an`.
    Article,
}

/// A number at some place: how many words it takes, its value, how it was said.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Count {
    pub len: usize,
    pub value: f64,
    pub said: Said,
}

/// Word `i`, or an empty string past the end.
pub fn at(words: &[Word], i: usize) -> &str {
    words.get(i).map_or("", |word| word.text.as_str())
}

/// The number that begins at word `i`, fractions and `a` included.
pub fn count(words: &[Word], i: usize) -> Option<Count> {
    let said = |len, value| Some(Count { len, value, said: Said::Fraction });
    match (at(words, i), at(words, i + 1), at(words, i + 2)) {
        ("half", "a" | "an", _) | ("a", "half", _) => return said(2, 0.5),
        ("half", "of", "a" | "an") => return said(3, 0.5),
        ("half", _, _) => return said(1, 0.5),
        ("a" | "one", "quarter", _) => return said(2 + of_a(words, i + 2), 0.25),
        ("a" | "one", "third", _) => return said(2 + of_a(words, i + 2), 1.0 / 3.0),
        ("a", "couple", _) => return said(2 + usize::from(at(words, i + 2) == "of"), 2.0),
        ("a", "few", _) => return said(2, 3.0),
        ("three", "quarter" | "quarters", _) => return said(2 + of_a(words, i + 2), 0.75),
        ("two", "third" | "thirds", _) => return said(2 + of_a(words, i + 2), 2.0 / 3.0),
        ("quarter", _, _) => return said(1 + of_a(words, i + 1), 0.25),
        _ => {}
    }
    if let Some((len, value)) = cardinal(words, i) {
        return Some(with_half(words, i, len, value));
    }
    matches!(at(words, i), "a" | "an").then_some(Count { len: 1, value: 1.0, said: Said::Article })
}

/// `of a`, `of the` or nothing.
fn of_a(words: &[Word], i: usize) -> usize {
    if at(words, i) != "of" {
        return 0;
    }
    1 + usize::from(matches!(at(words, i + 1), "a" | "an" | "the"))
}

fn with_half(words: &[Word], i: usize, len: usize, value: f64) -> Count {
    match (at(words, i + len), at(words, i + len + 1), at(words, i + len + 2)) {
        ("and", "a", "half") => Count { len: len + 3, value: value + 0.5, said: Said::Number },
        ("and", "a", "quarter") => Count { len: len + 3, value: value + 0.25, said: Said::Number },
        ("/", below, _) if below.parse::<f64>().is_ok_and(|d| d > 0.0) => {
            let below: f64 = below.parse().unwrap_or(1.0);
            Count { len: len + 2, value: value / below, said: Said::Fraction }
        }
        _ => Count { len, value, said: Said::Number },
    }
}

/// A number in figures or words at word `i`, with how many words it takes.
pub fn cardinal(words: &[Word], i: usize) -> Option<(usize, f64)> {
    let first = at(words, i);
    if first.starts_with(|c: char| c.is_ascii_digit() || c == '.') {
        return first.parse::<f64>().ok().filter(|v| v.is_finite() && *v < 1e6).map(|v| (1, v));
    }
    if let Some(hundreds) = hundred(words, i) {
        return Some(hundreds);
    }
    below_hundred(words, i)
}

fn hundred(words: &[Word], i: usize) -> Option<(usize, f64)> {
    let many = match at(words, i) {
        "a" => Some(1),
        word => ONES.iter().position(|name| *name == word),
    }?;
    if at(words, i + 1) != "hundred" {
        return None;
    }
    let and = usize::from(at(words, i + 2) == "and");
    let (len, rest) = below_hundred(words, i + 2 + and).map_or((2, 0.0), |(len, rest)| (2 + and + len, rest));
    Some((len, many as f64 * 100.0 + rest))
}

fn below_hundred(words: &[Word], i: usize) -> Option<(usize, f64)> {
    let word = at(words, i);
    if word.is_empty() {
        return None;
    }
    if let Some(value) = ONES.iter().position(|name| *name == word) {
        return Some((1, value as f64));
    }
    let tens = TENS.iter().position(|name| *name == word)? as f64 * 10.0;
    let ones = ONES.iter().position(|name| *name == at(words, i + 1)).filter(|ones| (1..=9).contains(ones));
    Some(ones.map_or((1, tens), |ones| (2, tens + ones as f64)))
}

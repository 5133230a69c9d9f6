//! Phrases of the table, and where they are in a prompt.

use std::collections::BTreeSet;

use super::row::Row;
use crate::numerals::cardinal_at;
use crate::tokenizer::Word;

/// Most words that a `~` stands for.
const MAX_WILD: usize = 3;

/// One word of a phrase.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Item {
    /// This word.
    Word(String),
    /// A number, in digits or words.
    Number,
    /// One to three words.
    Wild,
}

/// A phrase in a prompt.
#[derive(Debug, Clone, Copy)]
pub(super) struct Found<'a> {
    /// Its first word.
    pub(super) start: usize,
    /// Number of its words.
    pub(super) len: usize,
    /// The number in it.
    pub(super) number: Option<f64>,
    /// Whether it ends in a stuff.
    pub(super) is_stuff: bool,
    /// The line of the table.
    pub(super) row: &'a Row,
}

impl Found<'_> {
    /// The settings that it states.
    pub(super) fn settings(&self) -> Vec<(String, f64)> {
        let value = |fixed: Option<f64>, sign: f64| Some(sign * fixed.or(self.number)?);
        let settings = self.row.settings.iter();
        settings.filter_map(|(name, fixed, sign)| Some((name.clone(), value(*fixed, *sign)?))).collect()
    }
}

/// One place of a phrase: a choice of words, and whether it may be absent.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Part {
    ways: Vec<Vec<Item>>,
    is_optional: bool,
}

/// The parts of a phrase: `(very) shallow|thin focus`, `[a b|c] d`.
///
/// # Errors
/// A reason for a bracket that is not closed, and for a phrase without words that must be there.
pub(super) fn parts_of(text: &str) -> Result<Vec<Part>, &'static str> {
    let mut parts = Vec::new();
    let mut rest = text.trim();
    while !rest.is_empty() {
        let (choices, is_optional, after) = if let Some(inner) = rest.strip_prefix('(') {
            let (group, after) = inner.split_once(')').ok_or("an open bracket")?;
            (group, true, after)
        } else if let Some(inner) = rest.strip_prefix('[') {
            let (group, after) = inner.split_once(']').ok_or("an open bracket")?;
            (group, false, after)
        } else {
            let (word, after) = rest.split_once(' ').unwrap_or((rest, ""));
            (word, false, after)
        };
        parts.push(Part { ways: choices.split('|').map(items_of).collect(), is_optional });
        rest = after.trim_start();
    }
    if parts.iter().all(|part| part.is_optional) { Err("a phrase without words") } else { Ok(parts) }
}

fn items_of(words: &str) -> Vec<Item> {
    let item = |word: &str| match word {
        "#" => Item::Number,
        "~" => Item::Wild,
        word => Item::Word(word.to_owned()),
    };
    words.split_whitespace().map(item).collect()
}

/// The words that a phrase may begin with; empty for a number or any word.
pub(super) fn first_words(parts: &[Part]) -> BTreeSet<String> {
    let mut firsts = BTreeSet::new();
    for part in parts {
        firsts.extend(part.ways.iter().map(|way| match way.first() {
            Some(Item::Word(word)) => word.clone(),
            _ => String::new(),
        }));
        if !part.is_optional {
            break;
        }
    }
    firsts
}

/// Words taken by a phrase or a part of one, and the number in it.
type Taken = (usize, Option<f64>);

/// The longest way in which a phrase is at a word.
pub(super) fn match_at(parts: &[Part], words: (&str, &[Word]), at: usize) -> Option<Taken> {
    let Some((part, rest)) = parts.split_first() else { return Some((0, None)) };
    let mut best = if part.is_optional { match_at(rest, words, at) } else { None };
    for way in &part.ways {
        for (len, number) in ways_at(way, words, at) {
            let whole = match_at(rest, words, at + len).map(|(more, later)| (len + more, number.or(later)));
            if whole.map(|(len, _)| len) > best.map(|(len, _)| len) {
                best = whole;
            }
        }
    }
    best
}

/// Every way in which some items are at a word.
fn ways_at(items: &[Item], (prompt, words): (&str, &[Word]), at: usize) -> Vec<Taken> {
    let Some((item, rest)) = items.split_first() else { return vec![(0, None)] };
    let firsts: Vec<Taken> = match item {
        Item::Word(wanted) => {
            words.get(at).filter(|word| word.text == *wanted).map(|_| (1, None)).into_iter().collect()
        }
        Item::Number => {
            let sign = words.get(at).is_some_and(|word| is_negative(prompt, word));
            let number = cardinal_at(words, at).map(|(len, value)| (len, Some(if sign { -value } else { value })));
            number.into_iter().collect()
        }
        Item::Wild => {
            let is_word = |at: usize| words.get(at).is_some_and(|word| word.text.chars().any(char::is_alphanumeric));
            let num = (0..MAX_WILD).take_while(|k| is_word(at + k)).count();
            (1..=num).map(|len| (len, None)).collect()
        }
    };
    let after = |(len, number): Taken| {
        let further = ways_at(rest, (prompt, words), at + len);
        further.into_iter().map(move |(more, later)| (len + more, number.or(later)))
    };
    firsts.into_iter().flat_map(after).collect()
}

/// Whether a minus sign stands right before a number, after a space.
fn is_negative(prompt: &str, word: &Word) -> bool {
    let before = prompt.get(..word.span[0]).unwrap_or_default();
    let Some(rest) = before.strip_suffix(['-', '\u{2212}']) else { return false };
    rest.is_empty() || rest.ends_with([' ', '(', ','])
}

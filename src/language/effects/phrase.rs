//! Phrases of the table, and where they are in a prompt.

use std::collections::BTreeSet;

use super::item::{Lists, Taken, Text, Ways, first_words as first_of, spans, ways_at, ways_of};
use super::row::Row;

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
    /// Whether other phrases may be among its words.
    pub(super) spans: bool,
    /// Whether a negation is among its words: `the corners should not be dark`.
    pub(super) is_negated: bool,
    /// The line of the table.
    pub(super) row: &'a Row,
}

impl Found<'_> {
    /// The word after it.
    pub(super) fn end(&self) -> usize {
        self.start + self.len
    }

    /// The settings that it states.
    pub(super) fn settings(&self) -> Vec<(String, f64)> {
        let value = |fixed: Option<f64>, sign: f64| Some(sign * fixed.or(self.number)?);
        let settings = self.row.settings.iter();
        settings.filter_map(|(name, fixed, sign)| Some((name.clone(), value(*fixed, *sign)?))).collect()
    }
}

/// One place of a phrase: a choice of words, and whether it may be absent.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Part {
    ways: Ways,
    is_optional: bool,
}

impl Part {
    /// Whether other phrases may be among its words.
    pub(super) fn spans(&self) -> bool {
        self.ways.iter().any(|way| spans(way))
    }
}

/// The parts of a phrase: `(very) shallow|thin focus`, `[a b|c] d`.
///
/// # Errors
/// A reason for a bracket that is not closed, for a phrase without words that must be there, and for an item that is
/// none.
pub(super) fn parts_of(text: &str, lists: &Lists) -> Result<Vec<Part>, &'static str> {
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
        parts.push(Part { ways: ways_of(choices, lists)?, is_optional });
        rest = after.trim_start();
    }
    if parts.iter().all(|part| part.is_optional) { Err("a phrase without words") } else { Ok(parts) }
}

/// The words that a phrase may begin with; empty for a number or any word.
pub(super) fn first_words(parts: &[Part]) -> BTreeSet<String> {
    let mut firsts = BTreeSet::new();
    for part in parts {
        firsts.extend(part.ways.iter().flat_map(|way| first_of(way)));
        if !part.is_optional {
            break;
        }
    }
    firsts
}

/// The longest way in which a phrase is at a word.
pub(super) fn match_at(parts: &[Part], text: Text<'_>, at: usize) -> Option<Taken> {
    let Some((part, rest)) = parts.split_first() else { return Some(Taken::default()) };
    let mut best = if part.is_optional { match_at(rest, text, at) } else { None };
    for way in &part.ways {
        for taken in ways_at(way, text, at) {
            let whole = match_at(rest, text, at + taken.len).map(|further| taken.then(further));
            if whole.map(Taken::rank) > best.map(Taken::rank) {
                best = whole;
            }
        }
    }
    best
}

//! The list of idioms. `prompts/idioms.txt` describes its own format.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::{Arc, OnceLock};

use super::matching::{Found, Piece, Subject, match_at};
use super::parse::{Lists, Output, alternatives, output, pattern};
use crate::error::LanguageError;
use crate::linked::{OBJECT, QUANTITY};
use crate::list_lines::list_lines;
use crate::quantity::Quantity;

const FILE: &str = "prompts/idioms.txt";
static TEXT: &str = include_str!("../../../prompts/idioms.txt");

/// The idioms of the file.
#[derive(Debug, Default)]
pub(super) struct Table {
    idioms: Vec<Idiom>,
    /// Idioms by the word that they begin with, or by the beginning of a placeholder, in the order of the file.
    by_word: BTreeMap<String, Vec<usize>>,
    /// Idioms that may begin with any word.
    others: Vec<usize>,
}

#[derive(Debug)]
struct Idiom {
    pattern: Vec<Piece>,
    output: Vec<Output>,
}

impl Table {
    /// The list that the program ships, read once.
    pub(super) fn embedded() -> Result<&'static Self, LanguageError> {
        static TABLE: OnceLock<Result<Table, LanguageError>> = OnceLock::new();
        TABLE.get_or_init(|| Self::parse(TEXT)).as_ref().map_err(Clone::clone)
    }

    /// Reads a list.
    pub(super) fn parse(text: &str) -> Result<Self, LanguageError> {
        let (mut table, mut lists) = (Self::default(), Lists::new());
        for (number, line) in list_lines(text) {
            let bad = |what| LanguageError::BadData { file: FILE, line: number, what };
            table.take_line(line, &mut lists).map_err(bad)?;
        }
        Ok(table)
    }

    /// Reads a named list (`@name = a | b`) or an idiom (`pattern => words`).
    fn take_line(&mut self, line: &str, lists: &mut Lists) -> Result<(), String> {
        if let Some((name, text)) = line.strip_prefix('@').and_then(|rest| rest.split_once(" = ")) {
            let list = alternatives(text, lists)?;
            lists.insert(name.trim().to_owned(), Arc::new(list));
            return Ok(());
        }
        let (left, right) =
            line.split_once("=>").ok_or("expected \"pattern => words\" or \"@name = words | words\"")?;
        let (pattern, output) = (pattern(left, lists)?, output(right)?);
        if pattern.is_empty() || output.is_empty() {
            return Err("a pattern or what it stands for is empty".to_owned());
        }
        let unbound = output.iter().find_map(|part| match part {
            Output::Captured(name) if !captures(&pattern, name) => Some(name),
            _ => None,
        });
        if let Some(name) = unbound {
            return Err(format!("the pattern does not capture `{name}`"));
        }
        let nth = self.idioms.len();
        let mut firsts = BTreeSet::new();
        if first_words(&pattern, &mut firsts) {
            firsts.into_iter().for_each(|word| self.by_word.entry(word).or_default().push(nth));
        } else {
            self.others.push(nth);
        }
        self.idioms.push(Idiom { pattern, output });
        Ok(())
    }

    /// The longest match that begins at word `at`, and what it stands for.
    pub(super) fn longest_at(
        &self,
        words: &[&str],
        at: usize,
        quantities: &[Quantity],
    ) -> Option<(Found<'_>, &[Output])> {
        let placeholder = |word: &&str| [OBJECT, QUANTITY].into_iter().find(|opening| word.starts_with(opening));
        let key = words.get(at).map(|word| placeholder(word).unwrap_or(word));
        let by_word = key.and_then(|key| self.by_word.get(key));
        let candidates = by_word.into_iter().flatten().chain(&self.others);
        let subject = Subject { words, quantities };
        let mut best: Option<(usize, Found<'_>)> = None;
        for &nth in candidates {
            let Some(found) = match_at(&self.idioms[nth].pattern, subject, at).filter(|found| found.end > at) else {
                continue;
            };
            let is_better = best
                .as_ref()
                .is_none_or(|(other, known)| found.end > known.end || found.end == known.end && nth < *other);
            if is_better {
                best = Some((nth, found));
            }
        }
        best.map(|(nth, found)| (found, self.idioms[nth].output.as_slice()))
    }
}

/// Whether a pattern captures words under a name, in one of its alternatives at least.
fn captures(pieces: &[Piece], name: &str) -> bool {
    pieces.iter().any(|piece| match piece {
        Piece::Object(known) | Piece::Quantity(_, known) | Piece::Gap(known) => known == name,
        Piece::OneOf(alternatives) => alternatives.iter().any(|alternative| captures(alternative, name)),
        Piece::Word(_) | Piece::Verb(_) | Piece::Start | Piece::End => false,
    })
}

/// Collects the words that a pattern may begin with. `false` if they are not known, or if the pattern may match nothing.
fn first_words(pieces: &[Piece], into: &mut BTreeSet<String>) -> bool {
    for piece in pieces {
        match piece {
            Piece::Start => {}
            Piece::Word(word) => {
                into.insert(word.clone());
                return true;
            }
            Piece::Verb(forms) => {
                into.extend(forms.iter().cloned());
                return true;
            }
            Piece::OneOf(alternatives) => {
                // An empty alternative leaves the first word to the next piece.
                let mut is_open = false;
                for alternative in alternatives.iter() {
                    let is_known = first_words(alternative, into);
                    if !is_known && !alternative.is_empty() {
                        return false;
                    }
                    is_open |= alternative.is_empty();
                }
                if !is_open {
                    return true;
                }
            }
            Piece::Object(_) => {
                into.insert(OBJECT.to_owned());
                return true;
            }
            Piece::Quantity(..) => {
                into.insert(QUANTITY.to_owned());
                return true;
            }
            Piece::Gap(_) | Piece::End => return false,
        }
    }
    false
}

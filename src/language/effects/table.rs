//! The table of phrases; `prompts/effects.txt` describes its own format.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::{Arc, OnceLock};

use super::dismissal::Dismissal;
use super::item::{Lists, Taken, Text, ways_of};
use super::phrase::{Found, Part, first_words, match_at, parts_of};
use super::row::{Row, row_of};
use crate::error::LanguageError;
use crate::tokenizer::Word;

const FILE: &str = "prompts/effects.txt";
static TEXT: &str = include_str!("../../../prompts/effects.txt");

/// A phrase and the line that it is of.
#[derive(Debug, Clone)]
pub(super) struct Phrase {
    parts: Vec<Part>,
    /// Whether it ends in a stuff (`*`).
    is_stuff: bool,
    /// Whether other phrases may be among its words.
    spans: bool,
    row: usize,
}

/// Words around phrases, by what they do.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
#[derive(strum::EnumString)]
#[strum(serialize_all = "kebab-case")]
pub(super) enum WordKind {
    /// Asks for little.
    Slight,
    /// Asks for much.
    Strong,
    /// Forbids what follows.
    Negation,
    /// Ends what a negation covers.
    Closes,
    /// Forbids the phrase before it: `grain off`.
    ForbidsBefore,
    /// Leaves the phrase before it to others: `grain in post`.
    Elsewhere,
    /// May stand between a phrase and what forbids it.
    Between,
    /// A `..` may stand for it.
    Loose,
    /// A `..` may stand for it: then the phrase is negated.
    Negates,
    /// Takes back the negation before it.
    TakesBack,
    /// Makes the negation before it a matter of degree.
    Moderates,
    /// May stand between a negation and what it forbids.
    Filler,
}

/// All phrases.
#[derive(Debug, Default)]
pub(super) struct Table {
    words: BTreeMap<WordKind, BTreeSet<String>>,
    lists: Lists,
    /// Names of colors, each with the settings that mean it.
    colors: Vec<(String, String)>,
    rows: Vec<Row>,
    /// Phrases by their first word; those that begin with a number under an empty one.
    phrases: BTreeMap<String, Vec<Phrase>>,
    /// Phrases that forbid the effect before them.
    dismissals: Vec<Dismissal>,
}

impl Table {
    /// The table that the program ships, read once.
    ///
    /// # Errors
    /// [`LanguageError::BadData`] for a line without a colon or a phrase with open brackets.
    pub(super) fn embedded() -> Result<&'static Self, LanguageError> {
        static TABLE: OnceLock<Result<Table, LanguageError>> = OnceLock::new();
        TABLE.get_or_init(|| Self::parse(TEXT)).as_ref().map_err(Clone::clone)
    }

    fn parse(text: &str) -> Result<Self, LanguageError> {
        let mut table = Self::default();
        for (index, line) in text.lines().enumerate() {
            let line = line.trim();
            if !line.is_empty() && !line.starts_with("# ") && line != "#" {
                let bad = |what: &str| LanguageError::BadData { file: FILE, line: index + 1, what: what.to_owned() };
                table.add(line).map_err(bad)?;
            }
        }
        Ok(table)
    }

    fn add(&mut self, line: &str) -> Result<(), &'static str> {
        let (head, phrases) = line.split_once(':').ok_or("no colon")?;
        if let Some(kind) = head.strip_prefix('@') {
            let kind = kind.parse().map_err(|_| "an unknown list of words")?;
            self.words.entry(kind).or_default().extend(phrases.split(',').map(|word| word.trim().to_owned()));
            return Ok(());
        }
        if let Some(opening) = head.strip_prefix('<') {
            return Dismissal::all_of(opening, phrases, &self.lists).map(|more| self.dismissals.extend(more));
        }
        if let Some(name) = head.strip_prefix('$') {
            let choices: Vec<&str> = phrases.split(',').map(str::trim).collect();
            let ways = ways_of(&choices.join("|"), &self.lists)?;
            self.lists.insert(name.to_owned(), Arc::new(ways));
            return Ok(());
        }
        if let Some(name) = head.strip_prefix('%') {
            self.colors.push((name.to_owned(), phrases.trim().to_owned()));
            return Ok(());
        }
        if !head.contains("%color") {
            return self.add_row(head, phrases);
        }
        for (name, settings) in self.colors.clone() {
            self.add_row(&head.replace("%color", &settings), &phrases.replace("%color", &name))?;
        }
        Ok(())
    }

    fn add_row(&mut self, head: &str, phrases: &str) -> Result<(), &'static str> {
        let row = self.rows.len();
        self.rows.push(row_of(head)?);
        for text in phrases.split(',').map(str::trim).filter(|text| !text.is_empty()) {
            let parts = parts_of(text.trim_end_matches('*'), &self.lists)?;
            let spans = parts.iter().any(Part::spans);
            for first in first_words(&parts) {
                let phrase = Phrase { parts: parts.clone(), is_stuff: text.ends_with('*'), spans, row };
                self.phrases.entry(first).or_default().push(phrase);
            }
        }
        Ok(())
    }

    /// Whether the table lists a word under a kind.
    pub(super) fn lists(&self, kind: WordKind, word: &str) -> bool {
        self.words.get(&kind).is_some_and(|words| words.contains(word))
    }

    /// Words of a prompt, with those of them that a `..` may stand for.
    pub(super) fn text<'a>(&'a self, prompt: &'a str, words: &'a [Word]) -> Option<Text<'a>> {
        let of = |kind: WordKind| self.words.get(&kind);
        let (loose, negating) = (of(WordKind::Loose)?, of(WordKind::Negates)?);
        Some(Text { prompt, words, loose, negating, moderating: of(WordKind::Moderates)? })
    }

    /// Phrases that forbid the effect before them.
    pub(super) fn dismissals(&self) -> &[Dismissal] {
        &self.dismissals
    }

    /// The longest phrase that begins at a word.
    pub(super) fn longest_at<'a>(&'a self, prompt: &str, words: &[Word], at: usize) -> Option<Found<'a>> {
        let first = words.get(at)?.text.as_str();
        let own = self.phrases.get(first).into_iter().flatten();
        let numbers = self.phrases.get("").into_iter().flatten();
        let text = self.text(prompt, words)?;
        let mut best: Option<Found<'a>> = None;
        for phrase in own.chain(numbers) {
            if let Some(taken) = match_at(&phrase.parts, text, at)
                && best.as_ref().is_none_or(|best| taken.rank() > (best.len, !best.is_negated))
            {
                let Phrase { is_stuff, spans, row, .. } = *phrase;
                let Taken { len, number, is_negated } = taken;
                best = Some(Found { start: at, len, number, is_stuff, spans, is_negated, row: &self.rows[row] });
            }
        }
        best
    }
}

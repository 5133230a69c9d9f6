//! Phrases behind an effect that forbid it: `the grain has to go`, `keep any grain out of it`, `grain, no thanks`.

use std::collections::BTreeSet;

use super::item::{Lists, Text};
use super::phrase::{Found, Part, match_at, parts_of};
use crate::tokenizer::word_at;

/// Words before an effect among which the verb that belongs to the phrase behind it is looked for.
const OPENING_REACH: usize = 6;
/// Marks that may stand between an effect and a phrase that follows a mark.
const MARKS: [&str; 5] = [",", ":", ";", "?", "("];

/// When a phrase forbids the effect before it.
#[derive(Debug, Clone, PartialEq)]
enum Condition {
    /// Whatever is before the effect.
    None,
    /// One of these verbs is before the effect: `keep` .. `out of it`.
    Opened(BTreeSet<String>),
    /// Nothing, or a mark, is between.
    Mark,
}

/// A phrase that forbids the effect before it.
#[derive(Debug)]
pub(super) struct Dismissal {
    parts: Vec<Part>,
    condition: Condition,
}

impl Dismissal {
    /// The dismissals of a line of the table: `keep|leave` or `,` or nothing, and its phrases.
    ///
    /// # Errors
    /// Those of [`parts_of`].
    pub(super) fn all_of(opening: &str, phrases: &str, lists: &Lists) -> Result<Vec<Self>, &'static str> {
        let condition = match opening {
            "" => Condition::None,
            "," => Condition::Mark,
            verbs => Condition::Opened(verbs.split('|').map(str::to_owned).collect()),
        };
        let texts = phrases.split(',').map(str::trim).filter(|text| !text.is_empty());
        texts.map(|text| Ok(Self { parts: parts_of(text, lists)?, condition: condition.clone() })).collect()
    }

    /// Whether it takes back a negation before the effect (`don't leave the grain out`) and does not repeat it (`no grain,
    /// I hate it`).
    pub(super) fn takes_back(&self) -> bool {
        matches!(self.condition, Condition::Opened(_))
    }

    /// The number of words behind an effect, with the mark between, that forbid it.
    pub(super) fn len_after(&self, text: Text<'_>, found: &Found<'_>) -> Option<usize> {
        let mark = match &self.condition {
            Condition::Opened(verbs) if !is_opened(verbs, text, found.start) => return None,
            Condition::Mark => usize::from(MARKS.contains(&word_at(text.words, found.end()))),
            Condition::None | Condition::Opened(_) => 0,
        };
        let taken = match_at(&self.parts, text, found.end() + mark)?;
        (!taken.is_negated).then_some(taken.len + mark)
    }
}

/// Whether one of some verbs is in the sentence before a word.
fn is_opened(verbs: &BTreeSet<String>, text: Text<'_>, start: usize) -> bool {
    let before = (start.saturating_sub(OPENING_REACH)..start).rev().map(|at| word_at(text.words, at));
    before.take_while(|word| !matches!(*word, "." | ";" | "but" | "then")).any(|word| verbs.contains(word))
}

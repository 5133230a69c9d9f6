//! Effects that a prompt calls for or forbids.
//!
//! Enters: the words of a prompt, and which of them name objects. Leaves: the mentions of effects in order, each with its
//! degree, its settings and whether it is forbidden. `prompts/effects.txt` holds the phrases.

mod lookalike;
mod phrase;
mod row;
mod scope;
mod table;

use std::borrow::Cow;

use cinesplat_lens::{Call, Source};

use super::error::LanguageError;
use super::lexicon::Lexicon;
use super::linked::{Linked, OBJECT};
use super::tokenizer::{Word, span_of, tokenize, word_at};
use lookalike::is_lookalike;
use phrase::Found;
use row::Meaning;
use scope::{degree_of, forbidden};
use table::Table;

/// Name of the slanted horizon in the table and in [`EffectMention::call`].
pub const DUTCH_ANGLE: &str = "dutch-angle";
const ARTICLES: [&str; 3] = ["a", "an", "the"];
/// Words that may stand before a dutch angle and say nothing else.
const LEADS_TO_SLANT: [&str; 8] = ["with", "at", "using", "add", "slight", "subtle", "strong", "heavy"];

/// A mention in a prompt of an effect, or of another request that no camera move can meet.
#[derive(Debug, Clone, PartialEq)]
pub struct EffectMention {
    /// The call for it. Its name is from `prompts/effects.txt`: `depth-of-field`, `motion-blur`, `music` ..
    pub call: Call,
    /// Whether the words forbid it.
    pub is_forbidden: bool,
    /// Byte range of the prompt.
    pub span: [usize; 2],
}

/// The effects that a prompt mentions, each kind once, in the order of the words: effects of the camera, and requests that
/// no camera can meet. Of two mentions of one kind that contradict each other the last one counts. A negated mention
/// (`no motion blur`) is one that forbids; of what is no effect (`without music`) it is omitted.
///
/// # Errors
/// [`LanguageError::BadData`] when the embedded lexicon or the table of phrases is malformed.
pub fn effect_mentions(prompt: &str, linked: &Linked) -> Result<Vec<EffectMention>, LanguageError> {
    let words = tokenize(prompt);
    let placeholders = linked.tokens_text.split(' ').zip(&linked.spans);
    let objects: Vec<[usize; 2]> =
        placeholders.filter(|(word, _)| word.starts_with(OBJECT)).map(|(_, span)| *span).collect();
    let phrases = phrases_in(prompt, &words, &objects)?;
    let mut mentions: Vec<EffectMention> = Vec::new();
    let is_negated = forbidden(Table::embedded()?, &words, &phrases);
    for (at, found) in phrases.iter().enumerate() {
        for mention in mentions_of(prompt, &words, (found, is_negated[at]), &phrases)? {
            let known = mentions.iter_mut().find(|known| known.call.name == mention.call.name);
            match known {
                Some(known) if known.is_forbidden != mention.is_forbidden => *known = mention,
                Some(known) => merge(known, mention),
                None => mentions.push(mention),
            }
        }
    }
    Ok(mentions)
}

/// Which words of a prompt belong to phrases for effects: they name no object and state no quantity of a move.
pub(crate) fn effect_words(prompt: &str, words: &[Word]) -> Result<Vec<bool>, LanguageError> {
    let mut is_effect = vec![false; words.len()];
    for found in phrases_in(prompt, words, &[])? {
        if matches!(found.row.meaning, Meaning::Calls | Meaning::Forbids | Meaning::ForbidsIfNegated) {
            is_effect[found.start..found.start + found.len].fill(true);
        }
    }
    Ok(is_effect)
}

/// Which of some parts of a prompt, in bytes, hold nothing but a phrase for an effect: `bloom` in `push in with bloom`.
///
/// # Errors
/// Those of [`effect_mentions`].
pub fn are_effect_phrases(prompt: &str, parts: &[[usize; 2]]) -> Result<Vec<bool>, LanguageError> {
    let words = tokenize(prompt);
    let is_effect = effect_words(prompt, &words)?;
    let is_phrase = |[start, end]: &[usize; 2]| {
        let is_inside = |word: &Word| (*start..*end).contains(&word.span[0]);
        let mut inside = words.iter().zip(&is_effect).filter(|(word, _)| is_inside(word)).peekable();
        let names_effect = |(word, is_effect): (&Word, &bool)| *is_effect || ARTICLES.contains(&word.text.as_str());
        inside.peek().is_some() && inside.all(names_effect)
    };
    Ok(parts.iter().map(is_phrase).collect())
}

/// The prompt without a dutch angle and the words that lead to it (`with a slight dutch angle`): blanks stand for them,
/// so that every other byte stays where it is. The slant is no move of its own. A prompt that says nothing else stays
/// as it is, and so does a camera that leans over (`roll into a dutch angle`).
///
/// # Errors
/// Those of [`effect_mentions`].
pub fn without_slant(prompt: &str) -> Result<Cow<'_, str>, LanguageError> {
    let words = tokenize(prompt);
    let mut blanked = Cow::Borrowed(prompt);
    for found in
        phrases_in(prompt, &words, &[])?.iter().filter(|found| found.row.names.iter().any(|name| name == DUTCH_ANGLE))
    {
        let leads =
            |at: usize| LEADS_TO_SLANT.contains(&word_at(&words, at)) || ARTICLES.contains(&word_at(&words, at));
        let num_before = (0..found.start).rev().take_while(|at| leads(*at)).count();
        let first = found.start - num_before;
        if first.checked_sub(1).is_some_and(|before| matches!(word_at(&words, before), "to" | "into" | "no" | "not")) {
            continue;
        }
        let end = found.start + found.len;
        let end = end + usize::from(matches!(word_at(&words, end), ":" | ","));
        let [start, end] = span_of(&words[first..end]);
        blanked.to_mut().replace_range(start..end, &" ".repeat(end - start));
    }
    let says_more = blanked.contains(char::is_alphanumeric);
    Ok(if says_more { blanked } else { Cow::Borrowed(prompt) })
}

/// The phrases of the table in a prompt, without those that only look like an effect.
fn phrases_in<'a>(prompt: &str, words: &[Word], objects: &[[usize; 2]]) -> Result<Vec<Found<'a>>, LanguageError> {
    let (table, lexicon) = (Table::embedded()?, Lexicon::embedded()?);
    let mut phrases = Vec::new();
    let mut at = 0;
    while at < words.len() {
        let Some(found) = table.longest_at(prompt, words, at) else {
            at += 1;
            continue;
        };
        at += found.len;
        if found.row.meaning != Meaning::Nothing && !is_lookalike(words, &found, objects, lexicon) {
            phrases.push(found);
        }
    }
    Ok(phrases)
}

/// What a phrase says about each of its effects.
fn mentions_of(
    prompt: &str,
    words: &[Word],
    (found, is_negated): (&Found<'_>, bool),
    phrases: &[Found<'_>],
) -> Result<Vec<EffectMention>, LanguageError> {
    let is_forbidden = match found.row.meaning {
        Meaning::Calls => is_negated,
        Meaning::Forbids if !is_negated => true,
        Meaning::ForbidsIfNegated if is_negated => true,
        Meaning::Forbids | Meaning::ForbidsIfNegated | Meaning::Nothing => return Ok(Vec::new()),
    };
    let span = span_of(&words[found.start..found.start + found.len]);
    let because = prompt.get(span[0]..span[1]).unwrap_or_default().to_lowercase();
    let table = Table::embedded()?;
    let named = found.row.names.iter().filter(|name| !is_forbidden || cinesplat_lens::is_known(name));
    let mentions = named.map(|name| {
        let call = Call {
            degree: degree_of(table, words, found, phrases),
            settings: found.settings(),
            ..Call::new(name, &because, Source::Words)
        };
        EffectMention { call, is_forbidden, span }
    });
    Ok(mentions.collect())
}

/// Adds what a second mention of the same effect says: settings and degree.
fn merge(known: &mut EffectMention, again: EffectMention) {
    for (name, value) in again.call.settings {
        if known.call.setting(&name).is_none() {
            known.call.settings.push((name, value));
        }
    }
    if known.call.degree == cinesplat_lens::Degree::Medium {
        known.call.degree = again.call.degree;
    }
}

//! Effects that a prompt calls for or forbids.
//!
//! Enters: the words of a prompt, and which of them name objects. Leaves: the mentions of effects in order, each with
//! its degree, its settings and whether it is forbidden. `prompts/effects.txt` holds the phrases.

mod dismissal;
mod item;
mod lookalike;
mod phrase;
mod row;
mod scope;
mod table;

use std::borrow::Cow;

use cinesplat_lens::{Call, Source};

use super::blanks::{blank, unless_empty};
use super::error::LanguageError;
use super::lexicon::Lexicon;
use super::linked::{Linked, OBJECT};
use super::tokenizer::{Word, span_of, tokenize, word_at};
use lookalike::is_lookalike;
use phrase::Found;
use row::Meaning;
use scope::{Context, degree_of, forbidden};
use table::{Table, WordKind};

/// Name of the slanted horizon in the table and in [`EffectMention::call`].
pub const DUTCH_ANGLE: &str = "dutch-angle";
const ARTICLES: [&str; 3] = ["a", "an", "the"];
/// Words that may stand before a dutch angle or a number of the camera and say nothing else.
const LEADS_TO_SETTING: [&str; 8] = ["with", "at", "using", "add", "slight", "subtle", "strong", "heavy"];

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

/// Whether a word forbids what follows it, as the table lists such words.
pub(crate) fn is_negation(word: &str) -> bool {
    Table::embedded().is_ok_and(|table| table.lists(WordKind::Negation, word))
}

/// The effects that a prompt mentions, each kind once, in the order of the words: effects of the camera, and requests
/// that no camera can meet. Of two mentions of one kind that contradict each other the last one counts. A negated
/// mention (`no motion blur`) is one that forbids; of what is no effect (`without music`) it is omitted.
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
    let is_negated = forbidden(Context { table: Table::embedded()?, prompt, words: &words, phrases: &phrases });
    let (strong, weak): (Vec<_>, Vec<_>) =
        phrases.iter().enumerate().partition(|(_, found)| found.row.meaning != Meaning::Suggests);
    for (at, found) in strong.into_iter().chain(weak) {
        for mention in mentions_of(prompt, &words, (found, is_negated[at]), &phrases)? {
            add(&mut mentions, mention, found.row.meaning == Meaning::Suggests);
        }
    }
    mentions.sort_by_key(|mention| mention.span);
    Ok(mentions)
}

/// Which words of a prompt belong to phrases for effects: they name no object and state no quantity of a move.
pub(crate) fn effect_words(prompt: &str, words: &[Word]) -> Result<Vec<bool>, LanguageError> {
    let mut is_effect = vec![false; words.len()];
    for found in phrases_in(prompt, words, &[])? {
        if matches!(
            found.row.meaning,
            Meaning::Calls | Meaning::Suggests | Meaning::Forbids | Meaning::ForbidsIfNegated
        ) {
            is_effect[found.start..found.start + found.len].fill(true);
        }
    }
    Ok(is_effect)
}

/// Which of some parts of a prompt, in bytes, hold nothing but phrases for effects: `bloom` in `push in with bloom`, `a
/// bit of vignette`.
///
/// # Errors
/// Those of [`effect_mentions`].
pub fn are_effect_phrases(prompt: &str, parts: &[[usize; 2]]) -> Result<Vec<bool>, LanguageError> {
    let words = tokenize(prompt);
    let is_effect = effect_words(prompt, &words)?;
    let table = Table::embedded()?;
    let says_how_much = |word: &str| [WordKind::Slight, WordKind::Strong].iter().any(|kind| table.lists(*kind, word));
    let is_phrase = |[start, end]: &[usize; 2]| {
        let is_inside = |word: &Word| (*start..*end).contains(&word.span[0]);
        let mut inside = words.iter().zip(&is_effect).filter(|(word, _)| is_inside(word)).peekable();
        let names_effect = |(word, is_effect): (&Word, &bool)| {
            let word = word.text.as_str();
            *is_effect
                || ARTICLES.contains(&word)
                || matches!(word, "of" | "and" | "or" | "," | "with")
                || says_how_much(word)
        };
        let effect = words.iter().zip(&is_effect).any(|(word, is_effect)| *is_effect && is_inside(word));
        inside.peek().is_some() && effect && inside.all(names_effect)
    };
    Ok(parts.iter().map(is_phrase).collect())
}

/// The prompt without what only sets the camera: a dutch angle and the words that lead to it (`with a slight dutch
/// angle`), and the numbers of lens, shutter and film (`with a 180 degree shutter`, `at f/2`, `35 mm film grain`),
/// which are none of a move. Blanks stand for them, so that every other byte stays where it is. A prompt that says
/// nothing else stays as it is, and so does a camera that leans over (`roll into a dutch angle`).
///
/// # Errors
/// Those of [`effect_mentions`].
pub fn without_camera_settings(prompt: &str) -> Result<Cow<'_, str>, LanguageError> {
    let words = tokenize(prompt);
    let mut blanked = Cow::Borrowed(prompt);
    for found in phrases_in(prompt, &words, &[])? {
        let is_slant = found.row.names.iter().any(|name| name == DUTCH_ANGLE);
        if !is_slant && !states_number(&words, &found) {
            continue;
        }
        let leads =
            |at: usize| LEADS_TO_SETTING.contains(&word_at(&words, at)) || ARTICLES.contains(&word_at(&words, at));
        let num_before = (0..found.start).rev().take_while(|at| leads(*at)).count();
        let first = found.start - num_before;
        let before = first.checked_sub(1).map_or("", |before| word_at(&words, before));
        if is_slant && matches!(before, "to" | "into" | "no" | "not") {
            continue;
        }
        let end = found.end() + usize::from(is_slant && matches!(word_at(&words, found.end()), ":" | ","));
        blank(&mut blanked, span_of(&words[first..end]));
    }
    Ok(unless_empty(blanked, prompt))
}

/// Whether a phrase states a number of the camera that is none of a move.
fn states_number(words: &[Word], found: &Found<'_>) -> bool {
    let is_of_camera =
        matches!(found.row.meaning, Meaning::Calls | Meaning::Suggests | Meaning::Forbids) && !found.spans;
    let has_digits =
        || words[found.start..found.end()].iter().any(|word| word.text.starts_with(|c: char| c.is_ascii_digit()));
    is_of_camera && (found.number.is_some() || has_digits())
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
        at += if found.spans { 1 } else { found.len };
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
        Meaning::Suggests if !is_negated => false,
        Meaning::Forbids if !is_negated => true,
        Meaning::ForbidsIfNegated if is_negated => true,
        Meaning::Suggests | Meaning::Forbids | Meaning::ForbidsIfNegated | Meaning::Nothing => return Ok(Vec::new()),
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

/// Adds a mention to those of other phrases; one that only suggests its effect contradicts none.
fn add(mentions: &mut Vec<EffectMention>, mention: EffectMention, suggests: bool) {
    match mentions.iter_mut().find(|known| known.call.name == mention.call.name) {
        Some(known) if !suggests && known.is_forbidden != mention.is_forbidden => *known = mention,
        Some(known) => merge(known, mention),
        None => mentions.push(mention),
    }
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

//! Names that match no object of the scene.
//!
//! Enters: a place in a prompt where no object is named. Leaves: the words there that may be the name of an object, if
//! any. Words about the camera, scenery and misspelled function words are not names.

use super::edit_distance::edit_distance;
use super::inflection::stem;
use super::lexicon::Lexicon;
use super::names::{NameIndex, NamedObject};
use super::tokenizer::{Word, span_of, word_at};

/// Words at the place of an object's name that match no object of the scene.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct UnknownName {
    /// The words, as in the prompt.
    pub name: String,
    /// Byte range of the prompt.
    pub span: [usize; 2],
    /// The scene's nearest names, best first.
    pub nearest: Vec<String>,
    /// Whether the lexicon lists the name as a noun (`elephant`). Otherwise no list contains it.
    pub certain: bool,
}

/// Words that may be the name of an unknown object.
pub(crate) struct UnknownCandidate {
    /// Index of the first word.
    pub(crate) start: usize,
    /// Number of words.
    pub(crate) len: usize,
    /// The lexicon lists the last word as a noun.
    pub(crate) certain: bool,
}

/// Words that the name of an object may follow without a determiner.
const BEFORE_NAMES: [&str; 42] = [
    "on",
    "at",
    "to",
    "toward",
    "towards",
    "around",
    "past",
    "of",
    "from",
    "over",
    "between",
    "onto",
    "into",
    "behind",
    "above",
    "below",
    "beside",
    "along",
    "alongside",
    "orbit",
    "circle",
    "visit",
    "show",
    "me",
    "see",
    "follow",
    "reveal",
    "find",
    "approach",
    "frame",
    "near",
    "through",
    "across",
    "by",
    "under",
    "orbiting",
    "circling",
    "visiting",
    "approaching",
    "following",
    "orbits",
    "circles",
];

/// The candidate for an unknown name at word `i`: a determiner or one of [`BEFORE_NAMES`], then adjectives, then words
/// that are not shot language. `is_known(j)`: word `j` is of the training grammar or begins an object's name.
pub(crate) fn unknown_candidate_at(
    words: &[Word],
    i: usize,
    lexicon: &Lexicon,
    is_known: &dyn Fn(usize) -> bool,
) -> Option<UnknownCandidate> {
    let text = |j: usize| word_at(words, j);
    let previous = i.checked_sub(1).map_or("", text);
    let determined = lexicon.determiners.contains(text(i));
    if !determined && !BEFORE_NAMES.contains(&previous) {
        return None;
    }
    let start = i + usize::from(determined);
    let mut end = start;
    while lexicon.adjectives.contains(text(end)) && !is_noun(lexicon, text(end)) {
        end += 1;
    }
    let (len, certain) = noun_at(words, end, lexicon, is_known)?;
    // `teh`, `ot`: a function word with two letters swapped, without an article before it.
    let is_typo = || lexicon.determiners.iter().chain(&lexicon.function).any(|word| is_transposition(text(end), word));
    // `to survey`, `toward varying heights`: verbs and qualities, not names.
    let no_name = || previous == "to" || ["ing", "ly", "ed"].iter().any(|ending| text(end).ends_with(ending));
    if !determined && !certain && end == start && (is_typo() || no_name()) {
        return None;
    }
    Some(UnknownCandidate { start, len: end + len - start, certain })
}

fn is_noun(lexicon: &Lexicon, word: &str) -> bool {
    lexicon.noun_heads.contains(&stem(word)) && !lexicon.adjectives.contains(word)
}

/// The words of a name at word `start`: number of words, whether the last is a noun of the lexicon.
fn noun_at(words: &[Word], start: usize, lexicon: &Lexicon, is_known: &dyn Fn(usize) -> bool) -> Option<(usize, bool)> {
    let is_word =
        |word: &Word| word.is_alphabetic() && !word.text.starts_with('\'') && !lexicon.is_shot_language(&word.text);
    let is_unknown = |(at, word): &(usize, &Word)| is_word(word) && !is_known(*at);
    let numbered = words.iter().enumerate().skip(start).take(3);
    let run: Vec<&Word> = numbered.take_while(is_unknown).map(|(_, word)| word).collect();
    let certain = run.iter().rposition(|word| is_noun(lexicon, &word.text));
    match certain {
        Some(index) => Some((index + 1, true)),
        None if run.is_empty() => None,
        None => Some((run.len(), false)),
    }
}

/// Whether `word` is `meant` with two neighboring letters swapped; words of 2 to 5 bytes only.
fn is_transposition(word: &str, meant: &str) -> bool {
    let sorted = |w: &str| {
        let mut letters: Vec<char> = w.chars().collect();
        letters.sort_unstable();
        letters
    };
    word.len() > 1 && word.len() < 6 && edit_distance(word, meant) == 1 && sorted(word) == sorted(meant)
}

/// The candidate with the scene's nearest names.
pub(crate) fn unknown_name(
    prompt: &str,
    words: &[Word],
    candidate: &UnknownCandidate,
    index: &NameIndex,
    objects: &[NamedObject],
) -> UnknownName {
    let inside = words.get(candidate.start..candidate.start + candidate.len).unwrap_or_default();
    let span = span_of(inside);
    let name: Vec<String> = inside.iter().map(|word| word.text.clone()).collect();
    UnknownName {
        name: prompt.get(span[0]..span[1]).unwrap_or_default().to_owned(),
        span,
        nearest: index.nearest(&name, objects),
        certain: candidate.certain,
    }
}

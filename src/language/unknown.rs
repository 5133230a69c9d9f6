//! Names that match no object: told apart from camera talk, scenery and slips of the pen.

use super::inflection::stem;
use super::lexicon::Lexicon;
use super::names::{NameIndex, NamedObject, distance};
use super::words::Word;

/// Words in an object's place that name no object of the scene.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct UnknownName {
    /// The words, as they stand in the prompt.
    pub name: String,
    /// Byte range of the prompt.
    pub span: [usize; 2],
    /// The scene's nearest names, best first.
    pub nearest: Vec<String>,
    /// Surely the name of a thing (`elephant`), not a word that nobody here knows.
    pub certain: bool,
}

/// A stretch of words that may name something unknown.
pub(crate) struct Suspect {
    pub(crate) start: usize,
    pub(crate) len: usize,
    pub(crate) certain: bool,
}

/// Words after which a thing is named.
const BEFORE_THINGS: [&str; 42] = [
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

/// The unknown name that begins at word `i`, if one does: a determiner or a word before things, adjectives, and then
/// words that are no talk; `knows` tells of a place whether the phrasebook has that word or an object is named there.
pub(crate) fn suspect_at(
    words: &[Word],
    i: usize,
    lexicon: &Lexicon,
    knows: &dyn Fn(usize) -> bool,
) -> Option<Suspect> {
    let text = |j: usize| words.get(j).map_or("", |word| word.text.as_str());
    let previous = i.checked_sub(1).map_or("", text);
    let determined = lexicon.determiners.contains(text(i));
    if !determined && !BEFORE_THINGS.contains(&previous) {
        return None;
    }
    let start = i + usize::from(determined);
    let mut end = start;
    while lexicon.adjectives.contains(text(end)) && !is_noun(lexicon, text(end)) {
        end += 1;
    }
    let (len, certain) = noun_at(words, end, lexicon, knows)?;
    // `teh`, `ot`: a small word with two letters swapped, where no article stands.
    let slip = || lexicon.determiners.iter().chain(&lexicon.function).any(|word| is_slip(text(end), word));
    // `to survey`, `toward varying heights`: verbs and qualities, no names.
    let no_name = || previous == "to" || ["ing", "ly", "ed"].iter().any(|ending| text(end).ends_with(ending));
    if !determined && !certain && end == start && (slip() || no_name()) {
        return None;
    }
    Some(Suspect { start, len: end + len - start, certain })
}

fn is_noun(lexicon: &Lexicon, word: &str) -> bool {
    lexicon.noun_heads.contains(&stem(word)) && !lexicon.adjectives.contains(word)
}

fn noun_at(words: &[Word], start: usize, lexicon: &Lexicon, knows: &dyn Fn(usize) -> bool) -> Option<(usize, bool)> {
    let is_word = |word: &Word| word.is_alphabetic() && !word.text.starts_with('\'') && !lexicon.is_talk(&word.text);
    let strange = |(at, word): &(usize, &Word)| is_word(word) && !knows(*at);
    let numbered = words.iter().enumerate().skip(start).take(3);
    let run: Vec<&Word> = numbered.take_while(strange).map(|(_, word)| word).collect();
    let certain = run.iter().rposition(|word| is_noun(lexicon, &word.text));
    match certain {
        Some(index) => Some((index + 1, true)),
        None if run.is_empty() => None,
        None => Some((run.len(), false)),
    }
}

fn is_slip(word: &str, meant: &str) -> bool {
    let sorted = |w: &str| {
        let mut letters: Vec<char> = w.chars().collect();
        letters.sort_unstable();
        letters
    };
    word.len() > 1 && word.len() < 6 && distance(word, meant) == 1 && sorted(word) == sorted(meant)
}

/// The suspect as a person is told of it.
pub(crate) fn report(
    prompt: &str,
    words: &[Word],
    suspect: &Suspect,
    index: &NameIndex,
    objects: &[NamedObject],
) -> UnknownName {
    let inside = words.get(suspect.start..suspect.start + suspect.len).unwrap_or_default();
    let span = [inside.first().map_or(0, |w| w.span[0]), inside.last().map_or(0, |w| w.span[1])];
    let name: Vec<String> = inside.iter().map(|word| word.text.clone()).collect();
    UnknownName {
        name: prompt.get(span[0]..span[1]).unwrap_or_default().to_owned(),
        span,
        nearest: index.nearest(&name, objects),
        certain: suspect.certain,
    }
}

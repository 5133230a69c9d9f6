//! Object names in a text: which words mean which object.
//!
//! Enters: the scene's labels and the words of a prompt. Leaves: the longest and best fitting match at a word. Names are
//! compared by the stems of their words. A label is split into qualifiers, head and tail: `golden skull` has the head
//! `skull`, `stack of teal plates` the head `stack` and the tail `teal plate`. A mention may be the whole label, its head
//! with some of its qualifiers, its tail, or a synonym.

use std::collections::BTreeMap;

use super::edit_distance::edit_distance;
use super::error::LanguageError;
use super::inflection::stem;
use super::lexicon::Lexicon;
use super::numbered::{NumberedMention, numbered_mention_at};
use super::tokenizer::{Word, tokenize};

/// An object of the scene with its id and name.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NamedObject {
    /// The N of `<obj-N>`.
    pub id: u32,
    /// Name such as `golden skull`; empty without one.
    pub label: String,
}

/// The objects that a mention names.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct NameMatch {
    /// Number of words.
    pub(crate) len: usize,
    /// Indices of the objects. Several where a plural names all of them.
    pub(crate) objects: Vec<usize>,
    /// Indices of other objects that fit the words equally well.
    pub(crate) alternatives: Vec<usize>,
}

/// The part of a label that a mention matches; later variants fit better.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Fit {
    Synonym,
    Tail,
    Head,
    QualifiedHead,
    Full,
}

/// A label split into its parts, as stems.
#[derive(Debug)]
struct ParsedLabel {
    full: Vec<String>,
    head: String,
    /// Last qualifier and head in one word: `armchair` for `arm chair`.
    joined: String,
    qualifiers: Vec<String>,
    tail: Vec<String>,
    /// The head is a plural.
    plural: bool,
}

/// Labels by the stem of the last word of a mention.
pub(crate) struct NameIndex<'a> {
    labels: Vec<ParsedLabel>,
    by_last: BTreeMap<String, Vec<usize>>,
    lexicon: &'a Lexicon,
    /// Largest number of words of a mention.
    longest: usize,
}

/// Words that end the front of a label, after which its tail begins.
const TAIL_PREPOSITIONS: [&str; 8] = ["of", "with", "on", "in", "for", "from", "at", "under"];

impl<'a> NameIndex<'a> {
    pub(crate) fn new(objects: &[NamedObject], lexicon: &'a Lexicon) -> Self {
        let labels: Vec<ParsedLabel> = objects.iter().map(|object| parse_label(&object.label)).collect();
        let mut by_last: BTreeMap<String, Vec<usize>> = BTreeMap::new();
        for (index, label) in labels.iter().enumerate() {
            for last in last_words(label) {
                by_last.entry(last).or_default().push(index);
            }
        }
        let longest = labels.iter().map(|label| label.full.len()).max().unwrap_or(0).clamp(2, 8);
        Self { labels, by_last, lexicon, longest }
    }

    /// The best of the longest matches that begin at word `start`.
    pub(crate) fn match_at(&self, words: &[Word], start: usize) -> Option<NameMatch> {
        let longest = self.longest.min(words.len().saturating_sub(start));
        (1..=longest).rev().find_map(|len| self.match_of(words.get(start..start + len)?, words.get(start + len)))
    }

    /// The best match of exactly the words `segment`, before the word `next`.
    fn match_of(&self, segment: &[Word], next: Option<&Word>) -> Option<NameMatch> {
        let last = segment.last().filter(|word| word.is_alphabetic())?;
        let second_last = segment.len().checked_sub(2).and_then(|i| segment.get(i));
        let joined = second_last.map(|word| stem(&format!("{}{}", word.text, last.text)));
        let mut fits: Vec<(Fit, usize)> = Vec::new();
        for (key, used) in [(Some(last.stem.clone()), 1), (joined, 2)] {
            let Some(key) = key else { continue };
            let before = segment.get(..segment.len() - used).unwrap_or_default();
            fits.extend(self.candidates(&key).filter_map(|i| Some((self.fit(i, before, &key, segment)?, i))));
        }
        for used in 1..=segment.len().min(3) {
            let (before, name) = segment.split_at(segment.len() - used);
            fits.extend(self.synonymous(&stems(name), before));
            if let [first, second] = name {
                fits.extend(self.synonymous(&stem(&format!("{}{}", first.text, second.text)), before));
            }
        }
        let best = fits.iter().map(|(fit, _)| *fit).max()?;
        let mut chosen: Vec<usize> = fits.iter().filter(|(fit, _)| *fit == best).map(|(_, i)| *i).collect();
        chosen.sort_unstable();
        chosen.dedup();
        // `the chairs` names every object whose label is a singular `chair`.
        let plural = last.text.ends_with('s') && last.stem != last.text;
        let all_singular = chosen.iter().filter_map(|i| self.labels.get(*i)).all(|label| !label.plural);
        if chosen.len() > 1 && plural && all_singular && next.is_none_or(|word| word.text != "'s") {
            return Some(NameMatch { len: segment.len(), objects: chosen, alternatives: Vec::new() });
        }
        let alternatives = chosen.split_off(1);
        Some(NameMatch { len: segment.len(), objects: chosen, alternatives })
    }

    /// Indices of the labels that a mention ending in `key` can name.
    fn candidates(&self, key: &str) -> impl Iterator<Item = usize> {
        self.by_last.get(key).into_iter().flatten().copied()
    }

    /// The fit of the words `segment`, which end in `key` after `before`, to a label; `None` without a match.
    fn fit(&self, index: usize, before: &[Word], key: &str, segment: &[Word]) -> Option<Fit> {
        let label = self.labels.get(index)?;
        // `frame` or `track` alone is a word about the camera, not the name of an object.
        let is_reserved = self.lexicon.camera.contains(key) || self.lexicon.function.contains(key);
        if label.full.len() == segment.len() && label.full.iter().zip(segment).all(|(a, b)| *a == b.stem) {
            return (segment.len() > 1 || !is_reserved).then_some(Fit::Full);
        }
        if is_reserved {
            return None;
        }
        let is_in = |word: &Word, stems: &[String]| stems.contains(&word.stem);
        if head_is(label, key) {
            return match before {
                [] => Some(Fit::Head),
                _ if before.iter().all(|word| is_in(word, &label.qualifiers)) => Some(Fit::QualifiedHead),
                _ => None,
            };
        }
        before.iter().all(|word| is_in(word, &label.tail)).then_some(Fit::Tail)
    }

    /// Objects whose label has a synonym of `name`; the words `before` it must be in the label as well.
    fn synonymous(&self, name: &str, before: &[Word]) -> Vec<(Fit, usize)> {
        let mut found = Vec::new();
        for other in self.lexicon.synonyms.get(name).into_iter().flatten() {
            let last = other.rsplit(' ').next().unwrap_or(other);
            found.extend(
                self.candidates(last).filter(|i| self.front_matches(*i, other, before)).map(|i| (Fit::Synonym, i)),
            );
        }
        found
    }

    /// Whether the front of the label ends in `name` and contains the words `before`.
    fn front_matches(&self, index: usize, name: &str, before: &[Word]) -> bool {
        let Some(label) = self.labels.get(index) else { return false };
        let front: Vec<&String> = label.qualifiers.iter().chain([&label.head]).collect();
        let name: Vec<&str> = name.split(' ').collect();
        front.len() >= name.len()
            && front.iter().rev().zip(name.iter().rev()).all(|(a, b)| *a == b)
            && before.iter().all(|word| front.contains(&&word.stem))
    }

    /// The labels with the least edit distance to the words `name`, shared words counted in their favor; nearest first,
    /// at most three.
    pub(crate) fn nearest(&self, name: &[String], objects: &[NamedObject]) -> Vec<String> {
        let text = name.join(" ");
        let last = name.last().map(|word| stem(word)).unwrap_or_default();
        let mut scored: Vec<(f64, u32, String)> = Vec::new();
        for (object, label) in objects.iter().zip(&self.labels) {
            let shared = label.full.iter().filter(|word| name.iter().any(|n| stem(n) == **word)).count() as f64;
            let whole = relative_distance(&text, &label.full.join(" "));
            let head = relative_distance(&last, &label.head);
            scored.push((whole.min(head) - shared, object.id, display_name(object)));
        }
        scored.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        scored.into_iter().take(3).map(|(_, _, text)| text).collect()
    }

    /// The only object whose head is within one edit of `word` (two from 7 letters); `None` with several.
    pub(crate) fn misspelled(&self, word: &str) -> Option<usize> {
        let count = word.chars().count();
        if count < 4 {
            return None;
        }
        let allowed = if count < 7 { 1 } else { 2 };
        let near = |label: &ParsedLabel| label.head.chars().count() > 3 && edit_distance(word, &label.head) <= allowed;
        let mut found = self.labels.iter().enumerate().filter(|(_, label)| near(label)).map(|(i, _)| i);
        found.next().filter(|_| found.next().is_none())
    }
}

/// The scene's names that are nearest to `name`, best first, at most three: `<obj-3> golden skull`.
///
/// # Errors
/// [`LanguageError::BadData`]: the embedded lexicon is malformed.
pub fn nearest_names(name: &str, objects: &[NamedObject]) -> Result<Vec<String>, LanguageError> {
    let words = tokenize(name);
    if let Some(NumberedMention { id: Some(id), .. }) = numbered_mention_at(&words, 0) {
        let mut near: Vec<&NamedObject> = objects.iter().collect();
        near.sort_by_key(|object| (object.id.abs_diff(id), object.id));
        return Ok(near.into_iter().take(3).map(display_name).collect());
    }
    let words: Vec<String> = words.into_iter().map(|word| word.text).collect();
    Ok(NameIndex::new(objects, Lexicon::embedded()?).nearest(&words, objects))
}

fn head_is(label: &ParsedLabel, key: &str) -> bool {
    label.head == key || label.joined == key
}

fn stems(words: &[Word]) -> String {
    words.iter().map(|word| word.stem.as_str()).collect::<Vec<_>>().join(" ")
}

/// Stems of the words that a mention of the label can end in.
fn last_words(label: &ParsedLabel) -> Vec<String> {
    let mut ends = vec![label.head.clone(), label.joined.clone()];
    ends.extend(label.full.last().cloned());
    ends.extend(label.tail.last().cloned());
    ends.retain(|end| !end.is_empty());
    ends.sort_unstable();
    ends.dedup();
    ends
}

fn parse_label(label: &str) -> ParsedLabel {
    let words = tokenize(label);
    let link = words.iter().position(|word| TAIL_PREPOSITIONS.contains(&word.text.as_str())).filter(|at| *at > 0);
    let (front, rest) = words.split_at(link.unwrap_or(words.len()));
    let stems = |words: &[Word]| words.iter().map(|word| word.stem.clone()).collect::<Vec<_>>();
    let (head, qualifiers) = front.split_last().map_or((None, &[][..]), |(head, before)| (Some(head), before));
    let joined = head.zip(qualifiers.last()).map(|(head, last)| stem(&format!("{}{}", last.text, head.text)));
    ParsedLabel {
        full: stems(&words),
        head: head.map(|word| word.stem.clone()).unwrap_or_default(),
        joined: joined.unwrap_or_default(),
        qualifiers: stems(qualifiers),
        tail: stems(rest.get(1..).unwrap_or_default()),
        plural: head.is_some_and(|word| word.stem != word.text),
    }
}

/// The name of an object in messages: `<obj-3> golden skull`.
pub(crate) fn display_name(object: &NamedObject) -> String {
    if object.label.is_empty() {
        format!("<obj-{}>", object.id)
    } else {
        format!("<obj-{}> {}", object.id, object.label)
    }
}

/// Edit distance over the length of the longer text, 0..=1.
fn relative_distance(a: &str, b: &str) -> f64 {
    edit_distance(a, b) as f64 / a.chars().count().max(b.chars().count()).max(1) as f64
}

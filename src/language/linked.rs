//! A prompt whose objects and quantities are placeholders.

use cinesplat_operator::Limit;

use super::quantity::Quantity;
use super::thing_parts::PartPlace;
use super::timeline::Timeline;
use super::unknown::UnknownName;

/// Limit on the bytes of a prompt.
pub const MAX_PROMPT_BYTES: usize = 8192;
/// Limit on the objects of a prompt: the model has the identifiers `<obj-0>` to `<obj-99>`.
pub const MAX_SLOTS: usize = 100;
/// Limit on the quantities of a prompt; further ones stay words.
pub const MAX_QUANTITIES: usize = 32;
/// How the placeholders of objects and quantities begin.
pub(crate) const OBJECT: &str = "<obj-";
pub(crate) const QUANTITY: &str = "<qty-";

/// The number of a placeholder that begins so.
pub(crate) fn slot_of(word: &str, opening: &str) -> Option<usize> {
    word.strip_prefix(opening)?.strip_suffix('>')?.parse().ok()
}

/// A prompt with its objects and quantities replaced by placeholders, as the model reads it.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Linked {
    /// Lower-case words and punctuation marks, separated by single spaces: `<obj-S>` stands for the object
    /// `slots[S]`, `<qty-Q>` for `quantities[Q]`.
    pub tokens_text: String,
    /// Byte range of the prompt for each word of `tokens_text`, on character boundaries.
    pub spans: Vec<[usize; 2]>,
    /// Id of the object or group per slot, in order of first mention.
    pub slots: Vec<u32>,
    /// Mentions of several objects or of none, which have one slot each.
    pub groups: Vec<Group>,
    /// The quantities, in order.
    pub quantities: Vec<Quantity>,
    /// Bytes of the mentions that say all of a thing: `the whole curtain`, `all of the sideboard`.
    pub wholes: Vec<[usize; 2]>,
    /// Bytes of the mentions that name a part of a thing by a word of its own (`the sole`), and where it sits.
    pub parts: Vec<([usize; 2], PartPlace)>,
    /// Bytes of the clauses in which a thing of the scene is told to act (`make the cat jump`), which are no words of the
    /// list.
    pub acts: Vec<[usize; 2]>,
    /// Limits that the words set for the whole film; these words are none of the list.
    pub limits: Vec<Limit>,
    /// What is seen behind the subjects; these words are none of the list.
    pub backdrops: Vec<Backdrop>,
    /// Names that match no object.
    pub unknown: Vec<UnknownName>,
    /// The parts of a prompt that says part by part what happens when.
    pub timeline: Option<Timeline>,
    /// Bytes of clauses about light, weather and mood, which are no words of the list.
    pub scenery: Vec<[usize; 2]>,
    /// Messages for the user about mentions that fit several objects or are misspelled.
    pub warnings: Vec<String>,
}

/// Objects that words say are seen behind others.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Backdrop {
    /// Ids of what is seen behind.
    pub ids: Vec<u32>,
    /// Ids of what it is seen behind.
    pub of: Vec<u32>,
    /// Byte of the prompt at which the words begin.
    pub at: usize,
}

/// A mention of several objects or of none.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Group {
    /// Id that stands for the group in [`Linked::slots`] and in the network's programs.
    pub id: u32,
    /// Ids of its objects, ascending; empty for a thing that the scene lacks.
    pub members: Vec<u32>,
    /// The words of its first mention, without an article.
    pub name: String,
    /// For something that the scene lacks: the scene's nearest names, best first.
    pub nearest: Vec<String>,
}

impl Group {
    /// Whether the words of a mention name the group; articles and case do not count.
    pub fn is_named(&self, words: &str) -> bool {
        self.name.eq_ignore_ascii_case(without_article(words.trim()))
    }
}

/// A name without the article before it.
pub(crate) fn without_article(name: &str) -> &str {
    let is_article = |word: &str| ["the", "a", "an"].iter().any(|article| word.eq_ignore_ascii_case(article));
    match name.split_once(' ') {
        Some((word, rest)) if is_article(word) => rest.trim_start(),
        _ => name,
    }
}

/// Adds the ids that a list lacks, in their order.
pub fn add_ids(list: &mut Vec<u32>, ids: &[u32]) {
    let new: Vec<u32> = ids.iter().filter(|id| !list.contains(id)).copied().collect();
    list.extend(new);
}

impl Linked {
    /// The words that begin in these bytes of the prompt, each with its own.
    pub fn words_in(&self, bytes: [usize; 2]) -> impl Iterator<Item = (&str, [usize; 2])> {
        let words = self.tokens_text.split(' ').zip(self.spans.iter().copied());
        words.filter(move |(_, span)| (bytes[0]..bytes[1]).contains(&span[0]))
    }

    /// The words that begin in these bytes of the prompt.
    pub fn texts_in(&self, bytes: [usize; 2]) -> Vec<&str> {
        self.words_in(bytes).map(|(word, _)| word).collect()
    }

    /// The words of the sentence in which some bytes begin, with the mark that ends it.
    pub fn sentence_of(&self, bytes: [usize; 2]) -> Vec<&str> {
        let words: Vec<(&str, [usize; 2])> = self.words_in([0, usize::MAX]).collect();
        let ends = |(word, _): &(&str, [usize; 2])| matches!(*word, "." | "!" | "?" | ";");
        let at = words.iter().position(|(_, span)| span[0] >= bytes[0]).unwrap_or(words.len());
        let from = words[..at].iter().rposition(ends).map_or(0, |mark| mark + 1);
        let to = words[at..].iter().position(ends).map_or(words.len(), |mark| at + mark + 1);
        words[from..to].iter().map(|(word, _)| *word).collect()
    }

    /// `ids` with each group replaced by its members, each once. A group without members stays.
    pub fn expanded(&self, ids: &[u32]) -> Vec<u32> {
        let mut out: Vec<u32> = Vec::new();
        for id in ids {
            let group = self.groups.iter().find(|group| group.id == *id && !group.members.is_empty());
            add_ids(&mut out, group.map_or(std::slice::from_ref(id), |group| &group.members));
        }
        out
    }

    /// Objects that some words name, each once.
    pub fn named_by(&self, words: &[&str]) -> Vec<u32> {
        self.expanded(&words.iter().filter_map(|word| self.slot_at(word)).collect::<Vec<u32>>())
    }

    /// `ids` with the members of a group replaced by the group, where all of them are there; larger groups first.
    pub fn grouped(&self, ids: &[u32]) -> Vec<u32> {
        let mut out = ids.to_vec();
        let mut groups: Vec<&Group> = self.groups.iter().filter(|group| group.members.len() > 1).collect();
        groups.sort_by_key(|group| std::cmp::Reverse(group.members.len()));
        for group in groups {
            let first = out.iter().position(|id| group.members.contains(id));
            if let Some(first) = first.filter(|_| group.members.iter().all(|member| out.contains(member))) {
                out[first] = group.id;
                out.retain(|id| !group.members.contains(id));
            }
        }
        out
    }

    /// The groups of what the scene lacks, in order of first mention.
    pub fn missing_groups(&self) -> impl Iterator<Item = &Group> {
        self.groups.iter().filter(|group| group.members.is_empty())
    }

    /// The group of a mention of something that the scene lacks, if `id` is one.
    pub fn missing(&self, id: u32) -> Option<&Group> {
        self.missing_groups().find(|group| group.id == id)
    }
}

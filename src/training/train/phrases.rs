//! Phrases that mean the same to a camera operator, exchanged at random in training.
//!
//! Enters: `prompts/phrases.txt`, whose lines are sets of phrases of which each may stand for any other. Leaves: sentences
//! that say the same in words that their writers did not use.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::OnceLock;

use cinesplat_language::{Linked, link_mentions};
use rand::RngExt;
use rand::seq::IndexedRandom;
use rand_pcg::Pcg64;

static TEXT: &str = include_str!("../../../prompts/phrases.txt");

/// Remark of a set of commands: such a phrase is a noun after an article, as in `a slow push in`.
const COMMAND: &str = "imperative]";
/// Words after which, or one word after which, a command is a noun.
const ARTICLES: [&str; 9] = ["a", "an", "the", "this", "that", "my", "our", "your", "one"];

/// Words of a phrase, as the linked text has them.
type Phrase = Vec<String>;

/// Sets of phrases.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Phrases {
    sets: Vec<Vec<Phrase>>,
    /// Whether the phrases of a set are commands.
    are_commands: Vec<bool>,
    /// Phrases that one set alone has, with that set, by their first words; the longest phrase first.
    by_first_word: BTreeMap<String, Vec<(Phrase, usize)>>,
}

impl Phrases {
    /// The phrases of the repository.
    pub fn embedded() -> &'static Self {
        static PHRASES: OnceLock<Phrases> = OnceLock::new();
        PHRASES.get_or_init(|| Self::parse(TEXT))
    }

    /// Phrases of a text: a set per line, phrases between bars, a remark in brackets before them; `#` starts a comment.
    /// A phrase with a quantity is dropped, because sentences hold placeholders in its place.
    pub fn parse(text: &str) -> Self {
        let lines = text.lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with('#'));
        let (are_commands, sets): (Vec<bool>, Vec<Vec<Phrase>>) =
            lines.map(set_of).filter(|(_, set)| set.len() > 1).unzip();
        let mut sets_of: BTreeMap<&Phrase, BTreeSet<usize>> = BTreeMap::new();
        for (idx, set) in sets.iter().enumerate() {
            set.iter().for_each(|phrase| {
                sets_of.entry(phrase).or_default().insert(idx);
            });
        }
        let mut by_first_word: BTreeMap<String, Vec<(Phrase, usize)>> = BTreeMap::new();
        for (phrase, sets) in sets_of {
            if let ([first, ..], Some(&set), 1) = (phrase.as_slice(), sets.first(), sets.len()) {
                by_first_word.entry(first.clone()).or_default().push((phrase.clone(), set));
            }
        }
        for phrases in by_first_word.values_mut() {
            phrases.sort_by_key(|(phrase, _)| usize::MAX - phrase.len());
        }
        Self { sets, are_commands, by_first_word }
    }

    /// Number of sets.
    pub fn num_sets(&self) -> usize {
        self.sets.len()
    }

    /// All phrases as text, for the vocabulary.
    pub fn texts(&self) -> impl Iterator<Item = String> {
        self.sets.iter().flatten().map(|phrase| phrase.join(" "))
    }

    /// The sentence with each phrase exchanged for another of its set with probability `phrases_frac`. The new words stand
    /// for the bytes of the old ones.
    pub fn exchange(&self, linked: &Linked, phrases_frac: f64, rng: &mut Pcg64) -> Linked {
        let words: Vec<&str> = linked.tokens_text.split(' ').collect();
        let (mut texts, mut spans) = (Vec::with_capacity(words.len()), Vec::with_capacity(words.len()));
        let mut at = 0;
        while at < words.len() {
            let found = self.phrase_at(&words, at).filter(|_| rng.random_bool(phrases_frac));
            let other = found.and_then(|(_, set)| self.sets[set].choose(rng));
            let (len, new) = match (found, other) {
                (Some((len, _)), Some(other)) => (len, other.iter().map(String::as_str).collect()),
                _ => (1, vec![words[at]]),
            };
            let span = [linked.spans[at][0], linked.spans[at + len - 1][1]];
            spans.extend(new.iter().map(|_| span));
            texts.extend(new);
            at += len;
        }
        Linked { tokens_text: texts.join(" "), spans, ..linked.clone() }
    }

    /// Number of words and set of the longest phrase that begins at word `at`, if it can be exchanged there.
    fn phrase_at(&self, words: &[&str], at: usize) -> Option<(usize, usize)> {
        let phrases = self.by_first_word.get(*words.get(at)?)?;
        let begins = |phrase: &Phrase| {
            words.len() >= at + phrase.len() && phrase.iter().zip(&words[at..]).all(|(own, word)| own == word)
        };
        let (phrase, set) = phrases.iter().find(|(phrase, _)| begins(phrase))?;
        // `close-up` and `close shot` are exchanged, but not in `close-up of the`.
        let of_follows = words.get(at + phrase.len()) == Some(&"of") && phrase.last().is_none_or(|word| word != "of");
        let is_noun = words[at.saturating_sub(2)..at].iter().any(|word| ARTICLES.contains(word));
        let stays = of_follows || (is_noun && self.are_commands[*set]);
        (!stays).then_some((phrase.len(), *set))
    }
}

/// The phrases of a line, and whether they are commands.
fn set_of(line: &str) -> (bool, Vec<Phrase>) {
    let (remark, phrases) = match line.split_inclusive(']').next() {
        Some(remark) if remark.starts_with('[') => line.split_at(remark.len()),
        _ => ("", line),
    };
    let linked = phrases.split(" | ").filter_map(|phrase| link_mentions(phrase.trim(), &[]).ok());
    let plain = linked.filter(|linked| linked.quantities.is_empty());
    let words = plain.map(|linked| linked.tokens_text.split(' ').map(str::to_owned).collect());
    (remark.ends_with(COMMAND), words.collect())
}

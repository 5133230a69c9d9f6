//! Byte-pair encoding learned from words, the same on every run.
//!
//! Sennrich et al. 2016, algorithm 1: the most frequent pair of neighboring pieces becomes a piece, again and again. The
//! trainer of `tokenizers` settles ties by the order of a hash table; here they go to the pair that comes first in order
//! of text, so that the same corpus gives the same vocabulary. A piece that does not begin its word has a prefix.

use std::collections::{BTreeMap, BTreeSet};

/// Marks a piece that continues a word.
pub(super) const CONTINUES: &str = "##";
/// Pairs that occur less often stay apart.
const MIN_COUNT: u64 = 2;

/// A learned encoding: pieces in order of their ids, and merges in order of their use.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub(super) struct Pieces {
    pub(super) pieces: Vec<String>,
    pub(super) merges: Vec<(String, String)>,
}

/// Learns up to `max_pieces` pieces from words with their counts. All letters and figures of English are pieces, whether
/// the words have them or not, so that misspelled words fall apart into known pieces.
pub(super) fn learn(words: &BTreeMap<String, u64>, max_pieces: usize) -> Pieces {
    let mut alphabet: BTreeSet<char> = ('a'..='z').chain('0'..='9').collect();
    alphabet.extend(words.keys().flat_map(|word| word.chars()));
    let mut learned = Pieces::default();
    for letter in alphabet {
        learned.pieces.extend([letter.to_string(), format!("{CONTINUES}{letter}")]);
    }
    let mut words: Vec<(Vec<String>, u64)> = words.iter().map(|(word, count)| (letters(word), *count)).collect();
    while learned.pieces.len() < max_pieces {
        let Some((left, right)) = most_frequent_pair(&words) else { break };
        let joined = join(&left, &right);
        words.iter_mut().for_each(|(pieces, _)| merge(pieces, (&left, &right), &joined));
        // Two ways may lead to one piece (`a` + `##bc`, `ab` + `##c`).
        if !learned.pieces.contains(&joined) {
            learned.pieces.push(joined);
        }
        learned.merges.push((left, right));
    }
    learned
}

fn letters(word: &str) -> Vec<String> {
    let piece = |(at, letter): (usize, char)| if at == 0 { letter.to_string() } else { format!("{CONTINUES}{letter}") };
    word.chars().enumerate().map(piece).collect()
}

/// The pair with the highest count; of several the first in order of text.
fn most_frequent_pair(words: &[(Vec<String>, u64)]) -> Option<(String, String)> {
    let mut counts: BTreeMap<(&str, &str), u64> = BTreeMap::new();
    for (pieces, count) in words {
        for pair in pieces.windows(2) {
            *counts.entry((&pair[0], &pair[1])).or_default() += count;
        }
    }
    let mut best: Option<((&str, &str), u64)> = None;
    for (pair, count) in counts {
        if count >= MIN_COUNT && best.is_none_or(|(_, most)| count > most) {
            best = Some((pair, count));
        }
    }
    best.map(|((left, right), _)| (left.to_owned(), right.to_owned()))
}

fn join(left: &str, right: &str) -> String {
    format!("{left}{}", right.strip_prefix(CONTINUES).unwrap_or(right))
}

fn merge(pieces: &mut Vec<String>, (left, right): (&str, &str), joined: &str) {
    let mut at = 0;
    while at + 1 < pieces.len() {
        if pieces[at] == left && pieces[at + 1] == right {
            joined.clone_into(&mut pieces[at]);
            pieces.remove(at + 1);
        }
        at += 1;
    }
}

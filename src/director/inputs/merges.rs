//! Byte-pair encoding learned from words; the result is the same on every run.
//!
//! Sennrich et al. 2016, algorithm 1: merge the most frequent pair of neighboring pieces into a new piece, and repeat. The
//! trainer of `tokenizers` breaks ties by the order of a hash table. Here the pair that is first in lexical order wins, so
//! that the same corpus gives the same vocabulary. A piece that does not begin its word has the prefix `##`.

use std::collections::{BTreeMap, BTreeSet};

/// Prefix of a piece that continues a word.
pub(super) const CONTINUES: &str = "##";
/// Rarer pairs are not merged.
const MIN_COUNT: u64 = 2;

/// A learned encoding.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub(super) struct Pieces {
    /// Pieces in the order of their ids.
    pub(super) pieces: Vec<String>,
    /// Merged pairs in the order in which the tokenizer applies them.
    pub(super) merges: Vec<(String, String)>,
}

/// Learns up to `max_pieces` pieces from words with their counts. All English letters and all digits are pieces, even if
/// no word has them, so that a misspelled word splits into known pieces.
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
        // Two merges may give one piece (`a` + `##bc`, `ab` + `##c`).
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

/// The pair with the highest count; among equals the first in lexical order.
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

//! The words around a number.
//!
//! Each look back or ahead is limited to a constant number of words, so that reading a prompt takes linear time.

use crate::tokenizer::{Word, word_at};

/// Words of approximation before a quantity.
pub(super) const HEDGES: [&str; 10] =
    ["about", "around", "roughly", "approximately", "approx", "some", "nearly", "almost", "exactly", "circa"];
/// Further words between a number and the word that tells what it is.
const FILLERS: [&str; 12] =
    ["like", "maybe", "bout", "ca", "just", "only", "say", "perhaps", "probably", "at", "most", "least"];

/// The `k`-th word before word `i`, or an empty string before the start.
pub(super) fn word_before(words: &[Word], i: usize, k: usize) -> &str {
    i.checked_sub(k).map_or("", |at| word_at(words, at))
}

/// Index after the nearest word before word `i` that is neither a hedge nor a filler.
pub(super) fn after_hedges(words: &[Word], i: usize) -> usize {
    let is_hedge = |word: &&Word| HEDGES.contains(&word.text.as_str()) || FILLERS.contains(&word.text.as_str());
    i - words.iter().take(i).rev().take(3).take_while(is_hedge).count()
}

/// The nearest word before word `i` that is neither a hedge nor a filler.
pub(super) fn cause(words: &[Word], i: usize) -> &str {
    word_before(words, after_hedges(words, i), 1)
}

/// Up to `num_words` words before word `i`, the nearest first.
pub(super) fn back(words: &[Word], i: usize, num_words: usize) -> impl Iterator<Item = &str> {
    words.iter().take(i).rev().take(num_words).map(|word| word.text.as_str())
}

/// [`back`] up to the start of the sentence.
pub(super) fn sentence_back(words: &[Word], i: usize, num_words: usize) -> impl Iterator<Item = &str> {
    back(words, i, num_words).take_while(|word| !matches!(*word, "." | ";" | "!" | "?"))
}

/// [`back`] up to the start of the clause.
pub(super) fn clause_back(words: &[Word], i: usize, num_words: usize) -> impl Iterator<Item = &str> {
    back(words, i, num_words).take_while(|word| !matches!(*word, "." | ";" | "!" | "?" | "," | "then"))
}

/// Whether no space separates word `i` from the word before.
pub(crate) fn is_joined(words: &[Word], i: usize) -> bool {
    let before = i.checked_sub(1).and_then(|at| words.get(at));
    before.zip(words.get(i)).is_some_and(|(before, word)| before.span[1] == word.span[0])
}

/// Whether word `i` is a dash: the mark of a comma, but three bytes long or after a space.
pub(super) fn is_dash(words: &[Word], i: usize) -> bool {
    let width = words.get(i).map_or(0, |word| word.span[1] - word.span[0]);
    word_at(words, i) == "," && i > 0 && (width > 1 || !is_joined(words, i))
}

/// Whether a number that ends before word `i` is the last of its phrase.
pub(super) fn ends_phrase(words: &[Word], i: usize) -> bool {
    matches!(
        word_at(words, i),
        "" | "."
            | ","
            | ";"
            | ")"
            | "!"
            | "?"
            | "then"
            | "and"
            | "before"
            | "while"
            | "or"
            | "each"
            | "but"
            | "so"
            | "as"
            | "ish"
            | "now"
            | "again"
            | "please"
            | "pls"
            | "from"
            | "/"
            | "n"
    )
}

/// Whether word `i` begins a clause.
pub(super) fn begins_clause(words: &[Word], i: usize) -> bool {
    matches!(word_before(words, i, 1), "" | "." | "," | ";" | ":" | "(" | "!" | "?" | ")")
}

/// Whether one of the `num_words` words before word `i` is a unit of time.
pub(super) fn time_before(words: &[Word], i: usize, num_words: usize) -> bool {
    let is_time =
        |word: &str| matches!(word, "s" | "sec" | "secs" | "second" | "seconds" | "min" | "minute" | "minutes");
    back(words, i, num_words).any(is_time)
}

//! The words that forbid an effect: `without motion blur`, and not `motion blur`, which asks for it.
//!
//! Enters: a prompt and the mentions of effects in it. Leaves: the bytes of the prompt from the negation before a
//! mention to its end, or from the mention to the end of its clause.

use super::effects::{EffectMention, is_negation};
use super::tokenizer::{Word, tokenize, word_at};

/// Words that forbid what follows them where `of`, `from`, `off`, `out`, `with` or `than` is next.
const LEADING: [&str; 11] =
    ["free", "clean", "clear", "devoid", "rid", "turn", "turned", "switch", "away", "instead", "rather"];
const FOLLOWING: [&str; 6] = ["of", "from", "off", "out", "with", "than"];
/// Words that end a clause. A comma does so too, unless it stands in a list of mentions.
const ENDS: [&str; 8] = [".", ";", "!", "?", "but", "then", "while", "because"];
/// Most words between a negation and a mention, and behind a mention.
const REACH: usize = 8;

/// The bytes of the words that forbid an effect: the mention with the negation before it (`no fog`, `without fog, grain or a
/// vignette`), or with the rest of its clause (`the grain has to go`). `mentions` are all of the prompt. What is not
/// forbidden is its own span.
pub fn forbidding_words(prompt: &str, mention: &EffectMention, mentions: &[EffectMention]) -> [usize; 2] {
    let [start, end] = mention.span;
    let words = tokenize(prompt);
    let first = words.partition_point(|word| word.span[0] < start);
    let behind = words.partition_point(|word| word.span[0] < end);
    let negates_itself = (first..behind).any(|at| negates(&words, at));
    if !mention.is_forbidden || negates_itself {
        return mention.span;
    }
    let is_in_list = |at: usize| is_mentioned(&words, at, mentions);
    let ends = |at: &usize| {
        let word = word_at(&words, *at);
        ENDS.contains(&word) || word == "," && !at.checked_sub(1).is_some_and(is_in_list)
    };
    let before = (0..first).rev().take_while(|at| !ends(at));
    let mut before = before.scan(0, |num, at| {
        *num += usize::from(!is_in_list(at));
        (*num <= REACH).then_some(at)
    });
    if let Some(at) = before.find(|at| negates(&words, *at)) {
        return [words[at].span[0], end];
    }
    let is_next = |at: &usize| !ends(at) && !matches!(word_at(&words, *at), "," | "and") && !is_in_list(*at);
    let last = (behind..words.len().min(behind + REACH)).take_while(is_next).last();
    [start, last.map_or(end, |at| words[at].span[1])]
}

/// Whether a word begins a negation.
fn negates(words: &[Word], at: usize) -> bool {
    let (word, next) = (word_at(words, at), word_at(words, at + 1));
    is_negation(word) || LEADING.contains(&word) && FOLLOWING.contains(&next)
}

/// Whether a word belongs to the mention of a forbidden effect.
fn is_mentioned(words: &[Word], at: usize, mentions: &[EffectMention]) -> bool {
    let Some(word) = words.get(at) else { return false };
    let holds = |mention: &EffectMention| mention.span[0] <= word.span[0] && word.span[1] <= mention.span[1];
    mentions.iter().filter(|mention| mention.is_forbidden).any(holds)
}

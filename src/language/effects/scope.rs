//! What the words around a phrase make of it: whether it is forbidden, and how much of it is asked for.

use cinesplat_lens::Degree;

use super::phrase::Found;
use super::table::{Table, WordKind};
use crate::tokenizer::{Word, word_at};

/// Words before a phrase among which its degree is looked for.
const DEGREE_REACH: usize = 4;
/// Words that join what one negation covers.
const JOINTS: [&str; 5] = ["or", "nor", "and", ",", "/"];

/// Whether each phrase is forbidden by the words around it.
pub(super) fn forbidden(table: &Table, words: &[Word], phrases: &[Found<'_>]) -> Vec<bool> {
    let mut result = vec![false; phrases.len()];
    let mut scope: Option<usize> = None;
    let mut at = 0;
    while at < words.len() {
        if let Some(idx) = phrases.iter().position(|found| found.start == at) {
            let end = at + phrases[idx].len;
            result[idx] = scope.is_some() != is_forbidden_after(words, end);
            at = end;
            scope = scope.filter(|start| goes_on(words, (end, *start), phrases));
            continue;
        }
        scope = next_scope(table, words, at, scope);
        at += 1;
    }
    result
}

/// The word that a negation began with, if it still covers what follows word `at`.
fn next_scope(table: &Table, words: &[Word], at: usize, scope: Option<usize>) -> Option<usize> {
    let word = word_at(words, at);
    let follows = |k: usize| word_at(words, at + k);
    match word {
        // `no, wait`; `not only`; `no more than a touch of`; `not just`.
        "no" | "not" | "never" if matches!(follows(1), "," | "." | "only" | "just" | "!" | "longer") => None,
        "no" if follows(1) == "more" && follows(2) == "than" => None,
        "instead" | "rather" if matches!(follows(1), "of" | "than") => Some(at),
        "free" if matches!(follows(1), "of" | "from") => Some(at),
        "turn" | "switch" if follows(1) == "off" => Some(at),
        "get" if follows(1) == "rid" => Some(at),
        "of" | "than" | "from" | "off" | "rid" if scope.is_some() => scope,
        _ if scope.is_some() && table.lists(WordKind::TakesBack, word) => None,
        _ if scope.is_some() && table.lists(WordKind::Moderates, word) => None,
        _ if table.lists(WordKind::Negation, word) => Some(at),
        _ if table.lists(WordKind::Filler, word) || JOINTS.contains(&word) || word.starts_with('\'') || word == "t" => {
            scope
        }
        _ if table.lists(WordKind::Slight, word) || table.lists(WordKind::Strong, word) => scope,
        _ => None,
    }
}

/// Whether a negation that covered a phrase goes on behind it: `no grain, vignette or flares`, `without fog and haze`.
fn goes_on(words: &[Word], (end, start): (usize, usize), phrases: &[Found<'_>]) -> bool {
    let joint = word_at(words, end);
    let begins = |at: usize| phrases.iter().find(|found| found.start == at);
    match joint {
        "or" | "nor" | "/" => true,
        // `no blur and shallow focus` asks for focus; `without blur and grain` forbids both.
        "and" => word_at(words, start) != "no" && begins(end + 1).is_some(),
        "," => {
            let next =
                begins(end + 1).or_else(|| begins(end + 2).filter(|_| matches!(word_at(words, end + 1), "or" | "nor")));
            let after = |found: &Found<'_>| found.start + found.len;
            // Only a list that ends in `or` is one.
            next.is_some_and(|found| {
                found.start == end + 2
                    || matches!(word_at(words, after(found)), "or" | "nor")
                    || word_at(words, after(found)) == "," && goes_on(words, (after(found), start), phrases)
            })
        }
        _ => false,
    }
}

/// Whether the words after a phrase forbid it: `grain off`, `blur-free`, `motion blur: none`.
fn is_forbidden_after(words: &[Word], end: usize) -> bool {
    let skip = usize::from(matches!(word_at(words, end), "is" | ":" | "=" | "should" | "must" | "set"));
    let first = word_at(words, end + skip);
    let second = word_at(words, end + skip + 1);
    // `grain yes, flares no`.
    let ends = !second.starts_with(|c: char| c.is_alphanumeric());
    if skip == 0 && first == "no" && ends {
        return true;
    }
    // `flares off the window` come from there.
    let is_origin =
        matches!(first, "off" | "free") && matches!(second, "the" | "a" | "an" | "of" | "its" | "that" | "every");
    !is_origin && matches!(first, "off" | "free" | "disabled" | "removed" | "none" | "zero")
        || matches!(
            (first, second),
            ("turned" | "switched" | "be" | "to", "off" | "zero") | ("not", "wanted" | "needed")
        )
}

/// How much of an effect the words before its phrase, or the first word of it, ask for.
pub(super) fn degree_of(table: &Table, words: &[Word], found: &Found<'_>, phrases: &[Found<'_>]) -> Degree {
    let is_other = |at: usize| phrases.iter().any(|other| other.start <= at && at < other.start + other.len);
    let first = found.start.saturating_sub(DEGREE_REACH);
    let before = (first..found.start).rev().take_while(|&at| {
        !is_other(at) && word_at(words, at).chars().all(char::is_alphanumeric) && !JOINTS.contains(&word_at(words, at))
    });
    let inside = found.start..found.start + found.len;
    for at in before.chain(inside) {
        let word = word_at(words, at);
        if table.lists(WordKind::Slight, word) || word == "too" && at < found.start {
            return Degree::Slight;
        }
        // `not too much`.
        let is_moderate = at > 0 && table.lists(WordKind::Moderates, word_at(words, at - 1));
        if table.lists(WordKind::Strong, word) {
            return if is_moderate { Degree::Slight } else { Degree::Strong };
        }
    }
    Degree::Medium
}

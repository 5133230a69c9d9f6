//! Words that say how a thing lies to another one.

use cinesplat_language::{Mention, Word, is_listed, tokenize};

use super::extent::Relation;
use crate::explained::said;

/// Words of places, by how a thing lies to the other one.
const NEAR: &str = "beside by near nearest closest nearer closer next against alongside behind opposite";
const UNDER: &str = "under below beneath underneath";
const ABOVE: &str = "above over";
const ON: &str = "on atop";
/// Words that may stand beside them.
const BESIDE: &str = "the a an that which who is are 's sits sitting stands standing hanging hangs lying leaning leans up down \
    there here right just directly immediately to in front of wall floor placed hung mounted resting one ones all it";
/// Of these, words of ways, too.
const WAYS: &str = "behind opposite against front alongside";
const PRONOUNS: &str = "it them that this";
/// Words by which a thing is in a corner of the room.
const CORNER: &str = "in the far back left right opposite other near of room over";
/// Most words between a thing and what places it.
const MAX_BETWEEN: usize = 8;

/// The words of a mention before those that place it, the relation, and the words behind it.
pub(super) fn inner_place(words: &[Word]) -> Option<(&[Word], Relation, &[Word])> {
    let at = (1..words.len().saturating_sub(1)).find(|at| relation_of(&words[*at..=*at]).is_some())?;
    Some((&words[..at], relation_of(&words[at..=at])?, &words[at + 1..]))
}

/// The relation that words between two things say; `None` where they say something else besides.
pub(super) fn relation_of(words: &[Word]) -> Option<Relation> {
    let text = |word: &Word| word.text.clone();
    // `The left-hand candle of the sideboard`.
    if words.first().is_some_and(|word| word.text == "of") && words[1..].iter().all(|word| word.text == "the") {
        return Some(Relation::On);
    }
    if is_end_of(words) {
        return Some(Relation::On);
    }
    let mut relation = None;
    for word in words.iter().map(text) {
        let own = match () {
            () if is_listed(NEAR, &word) || word == "front" => Some(Relation::Near),
            () if is_listed(UNDER, &word) => Some(Relation::Under),
            () if is_listed(ABOVE, &word) => Some(Relation::Above),
            () if is_listed(ON, &word) => Some(Relation::On),
            () => None,
        };
        if own.is_none() && !is_listed(BESIDE, &word) {
            return None;
        }
        // `On the wall above it` is above it.
        relation = own.or(relation);
    }
    relation.filter(|_| words.len() <= MAX_BETWEEN)
}

/// Words of an end of a thing.
const ENDS: &str = "at on the very far near other left right front back our your my its a";

/// Whether words between two things say that one is at an end of the other: `the candle at the end of the mantel`.
fn is_end_of(words: &[Word]) -> bool {
    let of = words.iter().position(|word| word.text == "of");
    let Some(of) = of.filter(|of| *of > 1 && is_listed("end edge corner", &words[of - 1].text)) else { return false };
    is_listed("at on", &words[0].text)
        && words[..of - 1].iter().chain(&words[of + 1..]).all(|word| is_listed(ENDS, &word.text))
}

/// The relation that the words from a byte on say to a pronoun: `on the wall above it`.
pub(super) fn relation_to_pronoun(prompt: &str, from: usize) -> Option<Relation> {
    let words = tokenize(prompt.get(from..)?);
    let is_end = |word: &Word| is_listed(PRONOUNS, &word.text) && word.text != "that" || !word.is_alphabetic();
    let at = words.iter().take(MAX_BETWEEN).position(is_end)?;
    is_listed(PRONOUNS, &words[at].text).then(|| relation_of(&words[..at])).flatten()
}

/// Whether the words behind a mention say that it is in a corner.
pub(super) fn says_corner(prompt: &str, mention: &Mention) -> bool {
    let inside = tokenize(said(prompt, mention));
    if inside.last().is_some_and(|word| word.text == "corner") {
        return true;
    }
    let words = tokenize(prompt.get(mention.bytes[1]..).unwrap_or_default());
    let corner = words.iter().take(6).position(|word| word.text == "corner");
    corner.is_some_and(|at| at > 0 && words[..at].iter().all(|word| is_listed(CORNER, &word.text)))
}

/// Whether the words behind a mention say that it stands on the floor.
pub(super) fn says_floor(prompt: &str, mention: &Mention) -> bool {
    let words = tokenize(prompt.get(mention.bytes[1]..).unwrap_or_default());
    let words: Vec<&str> = words.iter().take(4).map(|word| word.text.as_str()).collect();
    let words = words.strip_prefix(&["standing"]).or_else(|| words.strip_prefix(&["down"])).unwrap_or(&words);
    matches!(words, ["on", "the", "floor" | "ground" | "floorboards", ..])
}

/// Whether words between a thing and its place are those of a way, too: a camera goes behind things and along them.
pub(super) fn says_way(words: &[Word]) -> bool {
    words.iter().any(|word| is_listed(WAYS, &word.text))
}

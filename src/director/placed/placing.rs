//! What the words around a mention place it by.

use cinesplat_language::{Mention, is_listed, tokenize};

use super::extent::Relation;
use super::relations::{relation_of, relation_to_pronoun};
use crate::names::FoundMention;

/// What the words behind a mention place it by: the next mention, or, by a pronoun, the one before.
pub(super) fn placed_behind(prompt: &str, found: &[FoundMention], nth: usize) -> Option<(Relation, Vec<u32>)> {
    let end = found[nth].mention.bytes[1];
    if let Some(next) = found.get(nth + 1).filter(|next| !next.mention.ids.is_empty()) {
        let between = tokenize(prompt.get(end..next.mention.bytes[0]).unwrap_or_default());
        if let Some(relation) = relation_of(&between) {
            return Some((relation, next.mention.ids.clone()));
        }
    }
    let before = nth.checked_sub(1).and_then(|before| found.get(before))?;
    relation_to_pronoun(prompt, end).map(|relation| (relation, before.mention.ids.clone()))
}

/// The thing before a mention that has it: `the coffee table with the books`.
pub(super) fn placed_with(prompt: &str, found: &[FoundMention], nth: usize) -> Option<(Relation, Vec<u32>)> {
    let before = &found.get(nth.checked_sub(1)?)?.mention;
    let between = tokenize(prompt.get(before.bytes[1]..found[nth].mention.bytes[0])?);
    let has = between.first().is_some_and(|word| word.text == "with")
        && between[1..].iter().all(|word| is_listed("the its all a an", &word.text));
    (has && matches!(before.ids[..], [_])).then(|| (Relation::On, before.ids.clone()))
}

/// What a later mention places a thing by: `the plant in the corner .. the clock on the wall above it`. The other thing is
/// the only one of its kind, of which
/// there are `num_alike`.
pub(super) fn placed_later(
    prompt: &str,
    found: &[FoundMention],
    nth: usize,
    num_alike: &dyn Fn(&Mention) -> usize,
) -> Option<(Relation, Vec<u32>)> {
    let next = &found.get(nth + 1)?.mention;
    let is_only = matches!(next.ids[..], [_]) && num_alike(next) < 2;
    let relation = match relation_to_pronoun(prompt, next.bytes[1]).filter(|_| is_only)? {
        Relation::Above => Relation::Under,
        Relation::Under => Relation::Above,
        Relation::Near => Relation::Near,
        Relation::On => return None,
    };
    Some((relation, next.ids.clone()))
}

/// The only other thing of the kind from which one was told: `the other one`.
pub(super) fn rest_of(words: &str, narrowed: Option<&(Vec<u32>, u32)>) -> Option<(Vec<u32>, Vec<u32>)> {
    let is_other = tokenize(words).iter().all(|word| is_listed("the other one", &word.text));
    let (alike, one) = narrowed.filter(|_| is_other)?;
    let others: Vec<u32> = alike.iter().filter(|id| *id != one).copied().collect();
    matches!(others[..], [_]).then(|| (alike.clone(), others))
}

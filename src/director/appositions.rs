//! Things that are named together with another mention: `the big plant in the corner, blue potted plant 1,` is one thing that is named
//! twice, `the red and the yellow armchair` are two armchairs.
//!
//! Enters: a prompt and its mentions of objects. Leaves: the mentions, one for what is named twice, and those of names whose noun
//! follows later.

use cinesplat_language::{Mention, NamedObject, Word, is_listed, stem, tokenize};

use crate::explained::{content, drop_mentions, head, is_number, label, replace_mentions, said};
use crate::heads::before_place;
use crate::names::FoundMention;

/// Words between a name and the place that tells it, and between two names that share a noun.
const PLACES: &str = "in on at by near over under beside";
const PAIRS: &str = "and or to";
/// Most words of such a place: `in the far corner`.
const MOST_OF_PLACE: usize = 5;
/// Words behind a name that lead to one more thing of a list.
const LISTS: &str = "and or then";

/// Words behind a thing that is told by what is on it or in it.
const LAID: &str =
    "laid set dressed decorated covered loaded piled topped filled cluttered strewn stacked adorned crowned littered";
const ARTICLES: &str = "the a an its two three four some all";

/// Removes the mentions of what a thing is only told by: `the dining table laid with the plates and the yellow vase`. The bytes left are
/// those of the phrases.
pub(crate) fn drop_contents(prompt: &str, found: &mut Vec<FoundMention>) -> Vec<[usize; 2]> {
    let words = tokenize(prompt);
    let mut phrases = Vec::new();
    for pair in words.windows(2) {
        let [laid, with] = pair else { continue };
        let is_told = |found: &FoundMention| {
            let between = prompt.get(found.mention.bytes[1]..laid.span[0]).unwrap_or("-");
            !found.mention.ids.is_empty() && between.trim().is_empty()
        };
        if !is_listed(LAID, &laid.text) || with.text != "with" || !found.iter().any(is_told) {
            continue;
        }
        let mut end = with.span[1];
        while let Some(next) = found.iter().find(|found| found.mention.bytes[0] >= end) {
            let is_joint = |word: &Word| is_listed(ARTICLES, &word.text) || matches!(word.text.as_str(), "and" | ",");
            let between = prompt.get(end..next.mention.bytes[0]).unwrap_or_default();
            if !tokenize(between).iter().all(is_joint) {
                break;
            }
            end = next.mention.bytes[1];
        }
        if end > with.span[1] {
            phrases.push([laid.span[0], end]);
        }
    }
    phrases.iter().for_each(|phrase| drop_mentions(found, *phrase));
    phrases
}

/// Removes the mentions of things whose full name, with a number, follows behind a comma. The bytes left are those before the names.
pub(crate) fn drop_described(prompt: &str, objects: &[NamedObject], found: &mut Vec<FoundMention>) -> Vec<[usize; 2]> {
    let mut described = Vec::new();
    for nth in (1..found.len()).rev() {
        if is_named_again(prompt, objects, found, nth) {
            let name = found[nth].mention.bytes[0];
            described.push([found.remove(nth - 1).mention.bytes[0], name]);
        }
    }
    described
}

/// Whether a mention is the full name, with a number, of what the mention before names by its kind.
fn is_named_again(prompt: &str, objects: &[NamedObject], found: &[FoundMention], nth: usize) -> bool {
    let (thing, name) = (&found[nth - 1].mention, &found[nth].mention);
    let [id] = name.ids[..] else { return false };
    let text = said(prompt, name);
    let is_full = label(objects, id).is_some_and(|label| label.eq_ignore_ascii_case(text)) && is_number(text);
    let kind = head(before_place(said(prompt, thing)));
    let is_kind = kind.is_some_and(|kind| tokenize(text).iter().any(|word| word.stem == kind));
    let between = prompt.get(thing.bytes[1]..name.bytes[0]).unwrap_or_default().trim();
    let place = between.strip_suffix(',').map(tokenize);
    let is_place =
        |words: &[Word]| words.first().is_none_or(|word| is_listed(PLACES, &word.text)) && words.len() <= MOST_OF_PLACE;
    let behind = prompt.get(name.bytes[1]..).unwrap_or_default();
    let next = found.get(nth + 1).map(|next| prompt.get(name.bytes[1]..next.mention.bytes[0]).unwrap_or_default());
    let lists = |text: &str| tokenize(text).iter().all(|word| is_listed(LISTS, &word.text) || !word.is_alphabetic());
    is_full
        && is_kind
        && !is_number(said(prompt, thing))
        && place.is_some_and(|place| is_place(&place))
        && behind.trim_start().chars().next().is_none_or(|mark| matches!(mark, ',' | '.' | ';' | ')' | ':' | '!' | '?'))
        && next.is_none_or(|between| !lists(between))
}

/// Points a name without a noun at the thing that the noun of the next name makes of it.
pub(crate) fn share_nouns(prompt: &str, objects: &[NamedObject], found: &mut Vec<FoundMention>) {
    let words = tokenize(prompt);
    let text = |at: usize| words.get(at).map_or("", |word| word.text.as_str());
    for at in 0..words.len() {
        let is_pair = is_listed(PAIRS, text(at + 1)) && text(at + 2) == "the" && at > 0 && text(at - 1) == "the";
        let Some(second) = words.get(at + 3).map(|word| word.span).filter(|_| is_pair) else { continue };
        let covers = |found: &&FoundMention| found.mention.bytes[0] <= second[0] && second[1] <= found.mention.bytes[1];
        let Some(other) = found.iter().find(covers) else { continue };
        let [id] = other.mention.ids[..] else { continue };
        let noun = head(said(prompt, &other.mention));
        let told = &words[at];
        let has = |label: &str| content(label).contains(&stem(&told.text));
        let is_of_kind = |object: &&NamedObject| head(&object.label) == noun && object.id != id;
        let is_own = label(objects, id).is_some_and(|label| head(label) == noun && !has(label));
        let mut both = objects.iter().filter(is_of_kind).filter(|object| has(&object.label));
        if let (Some(first), None, true) = (both.next(), both.next(), is_own && noun.is_some()) {
            replace_mentions(found, Mention { bytes: [words[at - 1].span[0], told.span[1]], ids: vec![first.id] });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mentions(
        prompt: &str,
        named: &[(&str, u32)],
        with: fn(&str, &[NamedObject], &mut Vec<FoundMention>),
    ) -> Vec<u32> {
        let labels =
            ["red rug", "red armchair", "yellow armchair", "blue potted plant 1", "blue potted plant 2", "easel 2"];
        let objects: Vec<NamedObject> =
            (1..).zip(labels).map(|(id, label)| NamedObject { id, label: label.to_owned() }).collect();
        let mention = |(words, id): &(&str, u32)| {
            let from = prompt.find(words).unwrap();
            let mention = Mention { bytes: [from, from + words.len()], ids: vec![*id] };
            FoundMention { mention, probability: 1.0, nearest: Vec::new() }
        };
        let mut found: Vec<FoundMention> = named.iter().map(mention).collect();
        with(prompt, &objects, &mut found);
        found.into_iter().flat_map(|found| found.mention.ids).collect()
    }

    #[test]
    fn a_thing_and_its_full_name_are_one() {
        let joined = |prompt: &str, named: &[(&str, u32)]| {
            mentions(prompt, named, |prompt, objects, found| {
                drop_described(prompt, objects, found);
            })
        };
        let plant = ("the big potted plant", 5);
        let name = ("blue potted plant 1", 4);
        let from = ("easel 2", 6);
        let prompt = "reveal the big potted plant in the corner, blue potted plant 1, from behind easel 2.";
        assert_eq!(joined(prompt, &[plant, name, from]), [4, 6]);
        let prompt = "show the big potted plant, blue potted plant 1 and easel 2";
        assert_eq!(joined(prompt, &[plant, name, from]), [5, 4, 6], "a list");
        let prompt = "show the big potted plant, blue potted plant 1, and easel 2";
        assert_eq!(joined(prompt, &[plant, name, from]), [5, 4, 6], "a list");
        let prompt = "pan from easel 2, blue potted plant 1.";
        assert_eq!(joined(prompt, &[from, name]), [6, 4], "other kinds");
        let prompt = "pan off the big potted plant, then over, blue potted plant 1.";
        assert_eq!(joined(prompt, &[plant, name]), [5, 4]);
    }

    #[test]
    fn what_a_thing_is_laid_with_is_not_meant() {
        let left = |prompt: &str, named: &[(&str, u32)]| {
            mentions(prompt, named, |prompt, _, found| {
                drop_contents(prompt, found);
            })
        };
        let all = [("the easel", 6), ("red rug", 1), ("yellow armchair", 3), ("plant", 4)];
        assert_eq!(
            left("start on the easel laid with the red rug and a yellow armchair. Go to the plant", &all),
            [6, 4]
        );
        assert_eq!(
            left("start on the easel with the red rug and a yellow armchair. Go to the plant", &all),
            [6, 1, 3, 4]
        );
        assert_eq!(
            left("start on the easel set with care, the red rug, a yellow armchair and the plant", &all),
            [6, 1, 3, 4]
        );
    }

    #[test]
    fn two_names_share_a_noun() {
        let shared = |prompt: &str, named: &[(&str, u32)]| mentions(prompt, named, share_nouns);
        assert_eq!(
            shared("go between the red and the yellow armchair", &[("the red", 1), ("yellow armchair", 3)]),
            [2, 3]
        );
        assert_eq!(shared("go between the red and the yellow armchair", &[("yellow armchair", 3)]), [2, 3]);
        assert_eq!(shared("show the rug and the yellow armchair", &[("the rug", 1), ("yellow armchair", 3)]), [1, 3]);
    }
}

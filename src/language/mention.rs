//! Linking with known mentions: the words of a prompt in which placeholders stand for objects and quantities.
//!
//! Enters: a prompt, and which of its bytes name which objects. Leaves: [`Linked`]. A mention of several objects, or of
//! none, gets one placeholder too: a group, whose id lies beyond those of objects.

use super::error::LanguageError;
use super::linked::{Group, Linked, MAX_PROMPT_BYTES, MAX_QUANTITIES, MAX_SLOTS, without_article};
use super::plain::plain_words;
use super::quantity::quantity_at;
use super::thing_parts::PartPlace;
use super::timeline::timeline;
use super::tokenizer::{Word, is_listed, span_of, tokenize, word_at};

/// Least id of a group. Objects have ids up to 65,535.
const FIRST_GROUP: u32 = 1 << 20;

/// A mention of objects in a prompt.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Mention {
    /// Its bytes of the prompt.
    pub bytes: [usize; 2],
    /// Ids of the objects that it names, ascending; empty for a thing that the scene lacks.
    pub ids: Vec<u32>,
}

/// Checks that a prompt has words and is not too long.
///
/// # Errors
/// [`LanguageError::TooLong`]: more than [`MAX_PROMPT_BYTES`] · [`LanguageError::Empty`]: no word.
pub fn check_prompt(prompt: &str) -> Result<(), LanguageError> {
    if prompt.len() > MAX_PROMPT_BYTES {
        return Err(LanguageError::TooLong { found: prompt.len(), limit: MAX_PROMPT_BYTES });
    }
    if !tokenize(prompt).iter().any(|word| word.text.contains(char::is_alphanumeric)) {
        return Err(LanguageError::Empty);
    }
    Ok(())
}

/// Replaces the given mentions and the quantities of `prompt` by placeholders. A word belongs to a mention if it begins
/// in its bytes; mentions do not overlap.
///
/// # Errors
/// - [`LanguageError::TooLong`]: more than [`MAX_PROMPT_BYTES`].
/// - [`LanguageError::Empty`]: no word.
/// - [`LanguageError::TooManyObjects`]: more than [`MAX_SLOTS`].
/// - [`LanguageError::BadData`]: an embedded list is malformed.
pub fn link_mentions(prompt: &str, mentions: &[Mention]) -> Result<Linked, LanguageError> {
    link_parts(prompt, mentions, &|_| Ok(None))
}

/// [`link_mentions`], where some mentions name a part of their one object by a word of its own (`the headstock`):
/// `part_of` says where it sits. For ends and for front and back the words are `the top of <obj-0>`.
///
/// # Errors
/// Those of [`link_mentions`].
pub fn link_parts(
    prompt: &str,
    mentions: &[Mention],
    part_of: &dyn Fn(&Mention) -> Result<Option<PartPlace>, LanguageError>,
) -> Result<Linked, LanguageError> {
    check_prompt(prompt)?;
    let mention_at = |at: usize| mentions.iter().find(|mention| (mention.bytes[0]..mention.bytes[1]).contains(&at));
    let words = plain_words(prompt, &tokenize(prompt), &|word| mention_at(word.span[0]).is_some())?;
    let mut linked = Linked { timeline: timeline(prompt, &words), ..Linked::default() };
    // `#2` at the head of the second part of a list is no object.
    let heads: Vec<[usize; 2]> =
        linked.timeline.iter().flat_map(|timeline| &timeline.beats).map(|beat| [beat.start, beat.bytes[0]]).collect();
    let is_head = |at: usize| heads.iter().any(|head| (head[0]..head[1]).contains(&at));
    let mention_at = |at: usize| mention_at(at).filter(|mention| !is_head(mention.bytes[0]));
    let mut i = 0;
    while i < words.len() {
        let at = span_of(&words[i..=i])[0];
        if let Some(mention) = mention_at(at) {
            let inside = |word: &&Word| span_of(std::slice::from_ref(*word))[0] < mention.bytes[1];
            let len = words[i..].iter().take_while(inside).count().max(1);
            let slot = linked.slot_of(mention, prompt)?;
            let part = part_of(mention)?;
            linked.parts.extend(part.map(|part| (span_of(&words[i..i + len]), part)));
            match part.map(|part| part.place) {
                Some(end @ ("top" | "bottom" | "front" | "back")) => {
                    linked.append_part(&["the", end, "of"], slot, &words[i..i + len]);
                }
                Some(_) => linked.append_part(&[], slot, &words[i..i + len]),
                None => linked.append_mention(slot, &words[i..i + len], mention.ids.len() == 1),
            }
            i += len;
            continue;
        }
        let quantity = quantity_at(&words, i).filter(|_| linked.quantities.len() < MAX_QUANTITIES && !is_head(at));
        // `Quarter orbit` states the angle of an orbit.
        let states_orbit = |len: &usize| *len > 1 && matches!(word_at(&words, i + len - 1), "orbit" | "orbits");
        let len = quantity.map_or(1, |(len, _)| len - usize::from(states_orbit(&len)));
        if let Some((_, quantity)) = quantity {
            linked.append(&format!("<qty-{}>", linked.quantities.len()), &words[i..i + len]);
            linked.quantities.push(quantity);
        } else {
            linked.append(word_at(&words, i), &words[i..=i]);
        }
        i += len;
    }
    linked.rewrite_idioms()?;
    linked.drop_last_commas();
    Ok(linked)
}

/// Parts of a thing that a camera can look at, start from or end on.
const PARTS: &str = "top tops bottom bottoms foot feet base head tip tips crown peak rim brim lid roof edge edges side sides \
    front back backs rear corner corners end ends middle center centre part section handle neck nose face seat stem trunk \
    underside surface apex tail";
/// Fractions of a thing, after a word that says which: `the upper half`.
const FRACTIONS: &str = "half halves third";
const WHICH: &str = "top bottom left right upper lower middle front back";
/// Words of a mention that say all of the thing.
const WHOLES: &str = "whole entire all complete full";
/// First words of what a mention chooses from: `the middle of the three`.
const CHOICES: &str = "them these those all both two three four five six seven eight nine ten";

/// Number of words with which a mention of one thing names a part of it: 3 in `the top of the pipes`, 0 in others.
fn part_before(words: &[Word]) -> usize {
    let Some(of) = words.iter().take(4).position(|word| word.text == "of").filter(|of| *of > 0) else { return 0 };
    let is_fraction = is_listed(FRACTIONS, &words[of - 1].text) && of > 1 && is_listed(WHICH, &words[of - 2].text);
    let whole: Vec<&Word> = words[of + 1..].iter().skip_while(|word| word.text == "the").collect();
    let chooses = |word: &&Word| is_listed(CHOICES, &word.text) || !word.is_alphabetic();
    let names_part = is_fraction || is_listed(PARTS, &words[of - 1].text);
    if names_part && whole.first().is_some_and(|word| !chooses(word)) { of + 1 } else { 0 }
}

/// Number of words with which a mention of one thing ends in a part of it: 2 in `the chair's back`, 0 in others.
fn part_behind(words: &[Word]) -> usize {
    match words {
        [_, .., mark, part] if mark.text == "'s" && is_listed(PARTS, &part.text) => 2,
        _ => 0,
    }
}

/// The side that a mention of one thing names with a pronoun: `its left side`.
fn own_side(words: &[Word]) -> Option<&'static str> {
    let [owner, side, name] = words else { return None };
    let is_own = is_listed("its his her their", &owner.text) && is_listed("side flank profile", &name.text);
    ["left", "right"].into_iter().find(|known| is_own && side.text == *known)
}

impl Linked {
    /// The slot of a mention's object or group, a new one at its first mention.
    pub(crate) fn slot_of(&mut self, mention: &Mention, prompt: &str) -> Result<usize, LanguageError> {
        let id = match mention.ids[..] {
            [id] => id,
            _ => self.group_of(mention, prompt),
        };
        if let Some(slot) = self.slots.iter().position(|known| *known == id) {
            return Ok(slot);
        }
        if self.slots.len() >= MAX_SLOTS {
            return Err(LanguageError::TooManyObjects { limit: MAX_SLOTS });
        }
        self.slots.push(id);
        Ok(self.slots.len() - 1)
    }

    /// Appends a mention. The words that name a part of one thing stay, because they say where to look.
    fn append_mention(&mut self, slot: usize, words: &[Word], is_one: bool) {
        if is_one && let Some(side) = own_side(words) {
            self.append_part(&["the", side, "side", "of"], slot, words);
            return;
        }
        let before = if is_one { part_before(words) } else { 0 };
        let behind = if is_one && before == 0 { part_behind(words) } else { 0 };
        let (part, rest) = words.split_at(before);
        let (thing, part_of_thing) = rest.split_at(rest.len() - behind);
        part.iter().for_each(|word| self.append(&word.text, std::slice::from_ref(word)));
        if is_one && thing.len() > 1 && thing.iter().any(|word| is_listed(WHOLES, &word.text)) {
            self.wholes.push(span_of(thing));
        }
        self.append(&format!("<obj-{slot}>"), thing);
        part_of_thing.iter().for_each(|word| self.append(&word.text, std::slice::from_ref(word)));
    }

    /// Appends the words of a part and the thing whose it is, which stand for the words of a mention.
    fn append_part(&mut self, part: &[&str], slot: usize, words: &[Word]) {
        part.iter().for_each(|word| self.append(word, words));
        self.append(&format!("<obj-{slot}>"), words);
    }

    /// Id of the group of a mention. Two things that the scene lacks are the same if their words are.
    fn group_of(&mut self, mention: &Mention, prompt: &str) -> u32 {
        let name = without_article(prompt.get(mention.bytes[0]..mention.bytes[1]).unwrap_or_default().trim());
        let is_same =
            |group: &&Group| group.members == mention.ids && (!group.members.is_empty() || group.is_named(name));
        if let Some(group) = self.groups.iter().find(is_same) {
            return group.id;
        }
        let id = FIRST_GROUP + self.groups.len() as u32;
        self.groups.push(Group { id, members: mention.ids.clone(), name: name.to_owned(), nearest: Vec::new() });
        id
    }

    /// Removes commas behind the last word: what followed them was no part of a move.
    fn drop_last_commas(&mut self) {
        while let Some(rest) = self.tokens_text.strip_suffix(" ,") {
            self.tokens_text.truncate(rest.len());
            self.spans.pop();
        }
    }

    /// Appends `text`, which stands for `words`.
    fn append(&mut self, text: &str, words: &[Word]) {
        if !self.tokens_text.is_empty() {
            self.tokens_text.push(' ');
        }
        self.tokens_text.push_str(text);
        self.spans.push(span_of(words));
    }
}

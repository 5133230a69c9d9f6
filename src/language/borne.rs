//! What stands on a thing, said without names: `the things on the table`, `everything on the shelf`, `the objects on it`.

use super::linked::{Linked, OBJECT, slot_of};
use super::mention::Mention;
use super::tokenizer::{is_listed, tokenize};

/// Words for things of any kind.
const THINGS: &str = "thing things object objects item items stuff everything bits pieces clutter contents ornaments \
    trinkets knickknacks knick-knacks tools utensils props decorations decor treasures bric-a-brac goods products";
/// Words before them.
const BEFORE: &str =
    "the all of these those each every various different many small little lovely single other several";
/// Words between them and the word for where they are.
const BETWEEN: &str = "that which is are 's sitting standing lying resting arranged placed laid set out scattered displayed \
    gathered lined up all right currently there";
/// Words behind `what`.
const STANDS: &str = "'s s is stands sits lies";
/// Words for where they are.
const WHERE: &str = "on in upon atop across inside over";
/// Words between that and what bears them.
const TOP: &str = "top of the its surface";
/// Most things that one mention names.
const MOST_THINGS: usize = 12;

/// Words of a prompt, from the first to behind the last, that say what stands on a thing.
struct Borne {
    words: [usize; 2],
    bearer: u32,
}

impl Linked {
    /// Makes mentions of what stands on a thing: `things_on` gives the ids of the things that stand on an object, in order.
    /// Where nothing stands on it, the words stay.
    pub fn name_what_stands(&mut self, prompt: &str, things_on: &dyn Fn(u32) -> Vec<u32>) {
        let (mut from, mut has_named) = (0, false);
        while let Some(borne) = self.borne_after(prompt, from) {
            let members = things_on(borne.bearer);
            let may_name = !members.is_empty() && members.len() <= MOST_THINGS;
            let is_named = may_name && self.replace(prompt, borne.words, members);
            // What stays is not looked at again.
            from = if is_named { borne.words[0] + 1 } else { borne.words[1] };
            has_named |= is_named;
        }
        if has_named {
            self.drop_unused_slots();
        }
    }

    /// Numbers the slots in order of first mention again, without those that no word stands for any more.
    fn drop_unused_slots(&mut self) {
        let mut kept: Vec<usize> = Vec::new();
        let renumbered = |word: &str| {
            let Some(slot) = slot_of(word, OBJECT) else { return word.to_owned() };
            let place = kept.iter().position(|known| *known == slot).unwrap_or_else(|| {
                kept.push(slot);
                kept.len() - 1
            });
            format!("{OBJECT}{place}>")
        };
        let words: Vec<String> = self.tokens_text.split(' ').map(renumbered).collect();
        self.tokens_text = words.join(" ");
        self.slots = kept.iter().filter_map(|slot| self.slots.get(*slot).copied()).collect();
        self.groups.retain(|group| self.slots.contains(&group.id));
    }

    /// The first words at or after `from` that say what stands on a thing.
    fn borne_after(&self, prompt: &str, from: usize) -> Option<Borne> {
        let words: Vec<&str> = self.tokens_text.split(' ').collect();
        (from..words.len())
            .find_map(|at| self.within_mention(prompt, &words, at).or_else(|| self.spelled_out(&words, at)))
    }

    /// `The things on the table`, taken for a mention of the table.
    fn within_mention(&self, prompt: &str, words: &[&str], at: usize) -> Option<Borne> {
        let bearer = self.slots.get(slot_of(words[at], OBJECT)?).copied()?;
        let [start, end] = *self.spans.get(at)?;
        let said = tokenize(prompt.get(start..end)?);
        let thing = said.iter().position(|word| is_listed(THINGS, &word.text))?;
        let is_leading = said[..thing].iter().all(|word| is_listed(BEFORE, &word.text));
        let place = said.get(thing + 1..)?.iter().find(|word| !is_listed(BETWEEN, &word.text))?;
        (is_leading && is_listed(WHERE, &place.text)).then_some(Borne { words: [at, at + 1], bearer })
    }

    /// Words for things, for where they are, and a mention of what bears them, or `it` for the mention before.
    fn spelled_out(&self, words: &[&str], at: usize) -> Option<Borne> {
        let is_what = words[at] == "what" && words.get(at + 1).is_some_and(|next| is_listed(STANDS, next));
        if !is_listed(THINGS, words[at]) && !is_what && !self.is_unknown_thing(words[at]) {
            return None;
        }
        let skip =
            |from: usize, list: &str| from + words[from..].iter().take_while(|word| is_listed(list, word)).count();
        let place = skip(at + 1, if is_what { STANDS } else { BETWEEN });
        if !words.get(place).is_some_and(|word| is_listed(WHERE, word)) {
            return None;
        }
        let bearer_at = skip(place + 1, TOP);
        let word = *words.get(bearer_at)?;
        let slot = match word {
            // `Looking down at what is on it` looks down at it.
            "it" | "there" if !is_what => words[..at].iter().rev().find_map(|word| slot_of(word, OBJECT))?,
            _ => slot_of(word, OBJECT)?,
        };
        let bearer = self.slots.get(slot).copied()?;
        let first = at - words[..at].iter().rev().take_while(|word| is_listed(BEFORE, word)).count();
        Some(Borne { words: [first, bearer_at + 1], bearer })
    }

    /// Whether a word is a placeholder of things of any kind that no name of the scene fits.
    fn is_unknown_thing(&self, word: &str) -> bool {
        let id = slot_of(word, OBJECT).and_then(|slot| self.slots.get(slot));
        let group = id.and_then(|id| self.missing(*id));
        group.is_some_and(|group| group.name.split_whitespace().last().is_some_and(|name| is_listed(THINGS, name)))
    }

    /// Puts a mention of `members` in the place of some words, and says so; the words stay where the prompt has no slot left.
    fn replace(&mut self, prompt: &str, [from, to]: [usize; 2], members: Vec<u32>) -> bool {
        let bytes = [self.spans[from][0], self.spans[to - 1][1]];
        let Ok(slot) = self.slot_of(&Mention { bytes, ids: members }, prompt) else { return false };
        let placeholder = format!("{OBJECT}{slot}>");
        let mut words: Vec<&str> = self.tokens_text.split(' ').collect();
        words.splice(from..to, [placeholder.as_str()]);
        self.tokens_text = words.join(" ");
        self.spans.splice(from..to, [bytes]);
        true
    }
}

#[cfg(test)]
mod tests {
    use crate::{Mention, link_mentions};

    fn named(prompt: &str, table: &str) -> (String, Vec<Vec<u32>>) {
        let at = prompt.find(table).unwrap();
        let mention = Mention { bytes: [at, at + table.len()], ids: vec![7] };
        let mut linked = link_mentions(prompt, &[mention]).unwrap();
        linked.name_what_stands(prompt, &|id| if id == 7 { vec![2, 5] } else { Vec::new() });
        assert_eq!(linked.tokens_text.split(' ').count(), linked.spans.len());
        let members = linked.groups.iter().map(|group| group.members.clone()).collect();
        (linked.tokens_text, members)
    }

    #[test]
    fn things_on_a_table_are_a_mention() {
        let both = vec![vec![2, 5]];
        let expected = ("pan across <obj-0>".to_owned(), both.clone());
        assert_eq!(named("pan across the things on the table", "the table"), expected);
        assert_eq!(named("pan across all the objects standing on top of the table", "the table"), expected);
        assert_eq!(named("pan across what 's on the table", "the table"), expected);
        assert_eq!(named("pan across the things on the table", "the things on the table"), expected);
        let (text, members) = named("glide along the table , looking at the objects on it", "the table");
        assert_eq!((text.as_str(), members), ("glide along <obj-0> , looking at <obj-1>", both));
    }

    #[test]
    fn what_is_too_much_to_name_stays() {
        for num in [0, 13] {
            let prompt = "slide along the table , so I see each thing on it";
            let mention = Mention { bytes: [12, 21], ids: vec![7] };
            let mut linked = link_mentions(prompt, &[mention]).unwrap();
            linked.name_what_stands(prompt, &|_| (20..20 + num).collect());
            assert_eq!(linked.tokens_text, "slide along <obj-0> , so i see each thing on it");
        }
    }

    #[test]
    fn other_words_stay() {
        for prompt in
            ["push in on the table", "hold on the table", "one thing : push in on the table", "move on it to the table"]
        {
            let (text, members) = named(prompt, "the table");
            assert!(members.is_empty() && text.contains("<obj-0>"), "{text}");
        }
    }
}

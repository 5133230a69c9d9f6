//! Backgrounds of pictures: `with the window behind it`, `the bookshelf in the background`, `framed against the curtain`.
//!
//! Enters: a prompt without its limits. Leaves: what is seen behind what, and the words without these: to the network a background
//! is a second subject.

use std::borrow::Cow;

use super::blanks::blanked;
use super::linked::{Backdrop, Linked};
use super::tokenizer::{Word, is_listed, tokenize, word_at};

/// Words before the name of a background, and the most words of it.
const ARTICLES: &str = "the a an my our your that this those these both its all";
const MOST_WORDS: usize = 5;

/// The prompt with `with the window behind it` as `, the window`, and the bytes at which the words behind the thing stood: in one
/// piece they read as what tells one subject from another.
pub fn without_behind(prompt: &str) -> (Cow<'_, str>, Vec<usize>) {
    let words = tokenize(prompt);
    let found: Vec<[usize; 3]> = (0..words.len()).filter_map(|at| behind_at(&words, at)).collect();
    let ranges: Vec<[usize; 2]> = found
        .iter()
        .flat_map(|[with, behind, last]| [words[*with].span, [words[*behind].span[0], words[*last].span[1]]])
        .collect();
    let mut text = blanked(prompt, &ranges);
    for [with, ..] in &found {
        let [start, _] = words[*with].span;
        text.to_mut().replace_range(start..=start, ",");
    }
    (text, found.iter().map(|[_, behind, _]| words[*behind].span[0]).collect())
}

/// Places of `with`, of `behind` and of the word after it, where the words from one on name a background so.
fn behind_at(words: &[Word], at: usize) -> Option<[usize; 3]> {
    let begins = word_at(words, at) == "with" && is_listed(ARTICLES, word_at(words, at + 1));
    let behind = (at + 3..at + 4 + MOST_WORDS).find(|next| word_at(words, *next) == "behind").filter(|_| begins)?;
    let is_name =
        words[at + 2..behind].iter().all(|word| word.is_alphabetic() && word.text != "with" && word.text != "and");
    let is_pronoun = is_listed("it them him her", word_at(words, behind + 1));
    let ends = words.get(behind + 2).is_none_or(|next| is_listed(ENDS, &next.text));
    (is_name && is_pronoun && ends).then_some([at, behind, behind + 1])
}

/// Words before a background, which say that the picture has it.
const HAS: &str = "with having has have show shows showing see sees seeing and so until till ending ends keep keeping that's leaving leave \
    finishing featuring get getting framing where";
/// Words of those before the first of two things that are a background together.
const SHOWN: &str = "until till with see sees show shows so";
/// What joins a background to a clause that is left without it.
const JOINS: &str = ", ; - with until till ending finishing so that and keeping on when where framing showing";
/// Words between a background and where it is.
const LOOKS: &str = "is are sits sit stands stand standing sitting glows glow glowing visible seen soft softly blurred blurry blurring \
    out of focus dark bright just right directly still clearly nicely showing shining lit all both up there 's lies lying hanging \
    looming framed fills filling going gone hazy somewhere now slightly far appear appears appearing straight show shows come comes \
    into view pop pops";
/// Where a background is, behind which no other thing is named.
const BEHIND: &[&[&str]] = &[
    &["in", "the", "background"],
    &["in", "background"],
    &["in", "the", "back"],
    &["in", "the", "backdrop"],
    &["in", "the", "distance"],
    &["as", "the", "background"],
    &["as", "a", "background"],
    &["as", "your", "backdrop"],
    &["as", "the", "backdrop"],
    &["as", "a", "backdrop"],
    &["as", "backdrop"],
    &["as", "background"],
    &["for", "a", "backdrop"],
    &["for", "a", "background"],
    &["for", "the", "background"],
    &["as", "its", "backdrop"],
    &["in", "bg"],
    &["in", "the", "bg"],
    &["behind"],
    &["at", "the", "back"],
    &["behind", "it"],
    &["behind", "them"],
    &["behind", "him"],
    &["behind", "her"],
    &["behind", "that"],
    &["beyond"],
    &["beyond", "it"],
];
/// Words before a thing that another one is seen against.
const AGAINST: &[&[&str]] = &[
    &["framed", "against"],
    &["set", "against"],
    &["silhouetted", "against"],
    &["seen", "against"],
    &["sits", "against"],
    &["outlined", "against"],
    &["backed", "by"],
];
/// Words that begin with a background: `in the background the tv`.
const OPENS: &[&[&str]] = &[
    &["in", "the", "background"],
    &["behind", "it"],
    &["behind", "them"],
    &["background", ":"],
    &["background", "is"],
    &["backdrop", ":"],
    &["bg", ":"],
    &["bg", "is"],
];
/// Words between those and the thing.
const SEES: &str = "you can see we the is there 's are , sits a stands should be could i want to just also : of";
/// Words behind a background that say that it stays: it is kept in view.
const STAYS: &str = "whole time throughout entire always all constantly";
/// Marks and words that end a clause.
const ENDS: &str = ". , ; : ! ? and then while as before but - ) until";

impl Linked {
    /// The prompt without the words that say what is seen behind its subjects, and with that.
    ///
    /// `behinds` are the bytes that [`without_behind`] returns.
    #[must_use]
    pub fn without_backdrops(self, behinds: &[usize]) -> Self {
        let words: Vec<(&str, [usize; 2])> = self.words_in([0, usize::MAX]).collect();
        let reader = Reader { linked: &self, words: &words, behinds };
        let (mut backdrops, mut bytes, mut at) = (Vec::new(), Vec::new(), 0);
        while at < words.len() {
            let Some(found) = reader.backdrop_at(at) else {
                at += 1;
                continue;
            };
            let [from, end] = found.words;
            let of = found.of.or_else(|| reader.named_before(from));
            let ids = self.expanded(&found.ids);
            at = end.max(at + 1);
            let Some(of) = of.filter(|of| self.expanded(&[*of]) != ids) else { continue };
            bytes.push([words[from].1[0], words[end - 1].1[1]]);
            backdrops.push(Backdrop { ids, of: self.expanded(&[of]), at: words[from].1[0] });
        }
        if backdrops.is_empty() {
            return self;
        }
        let rest = self.without(&bytes, None);
        let Self { limits, acts, scenery, warnings, .. } = self;
        Self { acts, limits, backdrops, scenery, warnings, ..rest }
    }
}

/// A background: its first word and the word behind it, the things, and what it is behind where the words say that.
struct Found {
    words: [usize; 2],
    ids: Vec<u32>,
    of: Option<u32>,
}

struct Reader<'a> {
    linked: &'a Linked,
    words: &'a [(&'a str, [usize; 2])],
    /// Bytes at which `behind it` stood.
    behinds: &'a [usize],
}

impl Reader<'_> {
    fn text(&self, at: usize) -> &str {
        self.words.get(at).map_or("", |(word, _)| word)
    }

    /// The thing that a word stands for, which the scene has.
    fn thing(&self, at: usize) -> Option<u32> {
        self.linked.slot_at(self.text(at)).filter(|id| self.linked.missing(*id).is_none())
    }

    /// The word behind one of some phrases that stand at a word; the longest.
    fn after_one_of(&self, at: usize, phrases: &[&[&str]]) -> Option<usize> {
        let stands = |phrase: &&&[&str]| phrase.iter().enumerate().all(|(nth, word)| self.text(at + nth) == *word);
        phrases.iter().filter(stands).map(|phrase| at + phrase.len()).max()
    }

    fn ends_clause(&self, at: usize) -> bool {
        at >= self.words.len() || is_listed(ENDS, self.text(at))
    }

    /// The thing that the words name last before a word.
    fn named_before(&self, at: usize) -> Option<u32> {
        (0..at).rev().find_map(|before| self.thing(before))
    }

    fn backdrop_at(&self, at: usize) -> Option<Found> {
        let found = self.thing(at).map_or_else(|| self.led_in(at), |id| self.placed(at, id))?;
        let stays = (0..4).any(|nth| is_listed(STAYS, self.text(found.words[1] + nth)));
        (!stays).then_some(found)
    }

    /// `with the window behind it`, `the bed soft in the background`; `at` is the thing.
    fn placed(&self, at: usize, id: u32) -> Option<Found> {
        let before = at.checked_sub(1).map_or("", |before| self.text(before));
        let is_listed_thing = matches!(before, "," | "-" | ";" | ".");
        if matches!(before, "use" | "using") {
            return self.used(at, id);
        }
        if !is_listed_thing && !is_listed(HAS, before) {
            return None;
        }
        let mut place = at + 1;
        while is_listed(LOOKS, self.text(place)) && place - at <= 5 {
            place += 1;
        }
        let next = self.words.get(place).map_or(usize::MAX, |(_, span)| span[0]);
        let is_behind = |byte: &usize| (self.words[place - 1].1[1]..next).contains(byte);
        let stood = self.behinds.iter().any(is_behind).then_some(place);
        let end = self.after_one_of(place, BEHIND).or(stood)?;
        // `With the window behind the armchair`, of which something was said before.
        let said = |id: &u32| (0..at).any(|before| self.thing(before) == Some(*id));
        let of = self.thing(end).filter(|_| self.text(end - 1) == "behind").filter(said);
        let end = end + usize::from(of.is_some());
        // `Push past the chair, the lamp behind it and the desk` lists what is passed.
        // `Until the sideboard and the vase show up behind it`.
        let pair = at.checked_sub(2).filter(|_| before == "and").and_then(|first| Some((first, self.thing(first)?)));
        let pair = pair.filter(|(first, _)| *first > 0 && is_listed(SHOWN, self.text(first - 1)));
        let first = pair.map_or(at, |(first, _)| first);
        let is_whole = self.ends_clause(end) && (of.is_some() || self.named_before(first).is_some());
        let ids = pair.into_iter().map(|(_, id)| id).chain([id]).collect();
        is_whole.then(|| Found { words: [self.first_word(first), end], ids, of })
    }

    /// `Use the window as backdrop and push in on the globe`; `at` is the thing.
    fn used(&self, at: usize, id: u32) -> Option<Found> {
        let end = self.after_one_of(at + 1, BEHIND).filter(|_| self.text(at + 1) == "as")?;
        let of = (end..self.words.len()).find_map(|behind| self.thing(behind))?;
        let end = end + usize::from(matches!(self.text(end), "and" | ","));
        Some(Found { words: [at - 1, end], ids: vec![id], of: Some(of) })
    }

    /// `framed against the window`, `behind it you can see the window`; `at` is the first word.
    fn led_in(&self, at: usize) -> Option<Found> {
        if let Some(thing) = self.after_one_of(at, AGAINST) {
            let id = self.thing(thing)?;
            return self.ends_clause(thing + 1).then_some(Found { words: [at, thing + 1], ids: vec![id], of: None });
        }
        let is_first = at == 0 || is_listed(", . ; : - with and", self.text(at - 1));
        let mut thing = self.after_one_of(at, OPENS).filter(|_| is_first)?;
        while is_listed(SEES, self.text(thing)) && thing - at <= 9 {
            thing += 1;
        }
        let id = self.thing(thing)?;
        self.ends_clause(thing + 1).then(|| Found { words: [self.first_word(at), thing + 1], ids: vec![id], of: None })
    }

    /// The first of the words that join a background to what stands before it.
    fn first_word(&self, at: usize) -> usize {
        (0..at).rev().take_while(|before| is_listed(JOINS, self.text(*before))).last().unwrap_or(at)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixture::linked;

    /// The words that are left, and what is behind what.
    fn read(text: &str) -> (String, Vec<[u32; 2]>) {
        let read = linked(text).without_backdrops(&[]);
        let pairs = read.backdrops.iter().map(|backdrop| [backdrop.ids[0], backdrop.of[0]]).collect();
        (read.tokens_text, pairs)
    }

    #[test]
    fn what_is_behind_a_subject_is_its_background() {
        let behind = vec![[7, 5]];
        for text in [
            "push in on <obj-0> with <obj-1> behind it",
            "push in on <obj-0> , <obj-1> soft in the background",
            "push in on <obj-0> with <obj-1> as a backdrop",
            "push in on <obj-0> , behind it you can see <obj-1>",
            "push in on <obj-0> framed against <obj-1>",
            "push in on <obj-0> until <obj-1> glows behind it",
            "push in on <obj-0> with <obj-1> behind <obj-0>",
        ] {
            assert_eq!(read(text), ("push in on <obj-0>".to_owned(), behind.clone()), "{text}");
        }
        let three =
            Linked { slots: vec![5, 7, 9], ..linked("arc around <obj-0> until <obj-1> and <obj-2> show up behind it") };
        let read_three = three.without_backdrops(&[]);
        assert_eq!(read_three.tokens_text, "arc around <obj-0>");
        assert_eq!((&read_three.backdrops[0].ids[..], &read_three.backdrops[0].of[..]), (&[7, 9][..], &[5][..]));
        assert_eq!(
            read("use <obj-1> as backdrop and push in on <obj-0>"),
            ("push in on <obj-0>".to_owned(), behind.clone())
        );
        assert_eq!(read("<obj-0> , <obj-1> behind , pull back").0, "<obj-0> , pull back");
    }

    #[test]
    fn a_background_behind_a_pronoun_is_no_description() {
        let split = |text: &'static str| without_behind(text).0.into_owned();
        assert_eq!(
            split("push in on the chair with the tall window behind it"),
            "push in on the chair ,    the tall window          "
        );
        assert_eq!(split("the cup with the tv glowing behind it."), "the cup ,    the tv glowing          .");
        assert_eq!(without_behind("the cup with the tv behind it").1, [20]);
        for text in ["go to the chair with the window behind it all", "the mug with a handle", "pan with the tv behind"]
        {
            assert_eq!(split(text), text);
        }
    }

    #[test]
    fn a_goal_or_what_stays_in_view_is_no_background() {
        for text in [
            "pan from <obj-0> to <obj-1> behind it",
            "pull back from <obj-0> to reveal <obj-1> behind it",
            "truck past <obj-0> with <obj-1> in the background the whole time",
            "welcome them with <obj-1> out there behind <obj-0> and pan",
            "push in with <obj-1> behind",
        ] {
            assert_eq!(read(text), (text.to_owned(), vec![]), "{text}");
        }
    }
}

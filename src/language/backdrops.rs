//! Backgrounds of pictures: `with the window behind it`, `the bookshelf in the background`, `framed against the curtain`.
//!
//! Enters: a prompt without its limits. Leaves: what is seen behind what, and the words without these: to the network a background
//! is a second subject.

use super::linked::{Backdrop, Linked};
use super::tokenizer::is_listed;

/// Words before a background, which say that the picture has it.
const HAS: &str = "with having has have show shows showing see sees seeing and so until till ending ends keep keeping that's leaving leave \
    finishing featuring get getting framing where";
/// What joins a background to a clause that is left without it.
const JOINS: &str = ", ; - with until till ending finishing so that and keeping on when where framing showing";
/// Words between a background and where it is.
const LOOKS: &str = "is are sits sit stands stand standing sitting glows glow glowing visible seen soft softly blurred blurry blurring \
    out of focus dark bright just right directly still clearly nicely showing shining lit all both up there 's lies lying hanging \
    looming framed fills filling going gone hazy somewhere now slightly far appears appearing straight";
/// Where a background is, behind which no other thing is named.
const BEHIND: &[&[&str]] = &[
    &["in", "the", "background"],
    &["in", "background"],
    &["in", "the", "back"],
    &["in", "the", "backdrop"],
    &["in", "the", "distance"],
    &["as", "the", "background"],
    &["as", "a", "background"],
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
    #[must_use]
    pub fn without_backdrops(self) -> Self {
        let words: Vec<(&str, [usize; 2])> = self.words_in([0, usize::MAX]).collect();
        let reader = Reader { linked: &self, words: &words };
        let (mut backdrops, mut bytes, mut at) = (Vec::new(), Vec::new(), 0);
        while at < words.len() {
            let Some(found) = reader.backdrop_at(at) else {
                at += 1;
                continue;
            };
            let [from, end] = found.words;
            let of = found.of.or_else(|| reader.named_before(from));
            let ids = self.expanded(&[found.id]);
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
        Self { backdrops, limits, acts, scenery, warnings, ..rest }
    }
}

/// A background: its first word and the word behind it, the thing, and what it is behind where the words say that.
struct Found {
    words: [usize; 2],
    id: u32,
    of: Option<u32>,
}

struct Reader<'a> {
    linked: &'a Linked,
    words: &'a [(&'a str, [usize; 2])],
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
        if !is_listed_thing && !is_listed(HAS, before) {
            return None;
        }
        let mut place = at + 1;
        while is_listed(LOOKS, self.text(place)) && place - at <= 5 {
            place += 1;
        }
        let end = self.after_one_of(place, BEHIND)?;
        // `With the window behind the armchair`.
        let of = self.thing(end).filter(|_| self.text(end - 1) == "behind");
        let end = end + usize::from(of.is_some());
        // `Push past the chair, the lamp behind it and the desk` lists what is passed.
        let is_whole = self.ends_clause(end) && (of.is_some() || self.named_before(at).is_some());
        is_whole.then(|| Found { words: [self.first_word(at), end], id, of })
    }

    /// `framed against the window`, `behind it you can see the window`; `at` is the first word.
    fn led_in(&self, at: usize) -> Option<Found> {
        if let Some(thing) = self.after_one_of(at, AGAINST) {
            let id = self.thing(thing)?;
            return self.ends_clause(thing + 1).then_some(Found { words: [at, thing + 1], id, of: None });
        }
        let is_first = at == 0 || is_listed(", . ; : - with and", self.text(at - 1));
        let mut thing = self.after_one_of(at, OPENS).filter(|_| is_first)?;
        while is_listed(SEES, self.text(thing)) && thing - at <= 9 {
            thing += 1;
        }
        let id = self.thing(thing)?;
        self.ends_clause(thing + 1).then(|| Found { words: [self.first_word(at), thing + 1], id, of: None })
    }

    /// The first of the words that join a background to what stands before it.
    fn first_word(&self, at: usize) -> usize {
        (0..at).rev().take_while(|before| is_listed(JOINS, self.text(*before))).last().unwrap_or(at)
    }
}

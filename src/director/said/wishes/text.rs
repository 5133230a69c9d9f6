//! The sentences of a message, and their words of what comes first and last.

use std::ops::Range;

use cinesplat_language::{Linked, is_listed};

/// Marks that end a sentence.
const SENTENCE_MARKS: [&str; 4] = [".", "!", "?", ";"];
/// Words that lead on to something else.
const THENS: &str = "then before after afterwards until next";
/// Words behind `and` that lead on to something else.
const GOES_ON: &str = "end ends ending finish finishes finishing come comes coming leave leaves leaving only last lastly finally \
    then settle give";
/// Words by which something comes first, and by which it comes last.
const FIRST: &str = "first firstly start starts starting begin begins beginning open opens opening";
const LAST: &str = "end ends ending finish finishes finishing last lastly finally ultimately until conclude concludes";
/// Words that stand for what was named before.
const PRONOUNS: &str = "it that this them those these";
/// What is left, and words behind `last` that make it a time.
const LEFT: &str = "us them me people viewers everyone everybody guests customers you the it";
const TIMES: &str = "month year week night time summer winter century days weeks minute second";
/// How a sentence begins that only says what something is like: `you know in games when ..`.
const LIKENESS: [&[&str]; 3] = [&["you", "know"], &["imagine", "those"], &["ever", "seen"]];

/// The words of a message.
pub(super) struct Text<'a> {
    /// The words and marks.
    pub(super) words: Vec<&'a str>,
    /// The number of the sentence of each.
    sentences: Vec<usize>,
}

impl<'a> Text<'a> {
    /// The words of a linked message.
    pub(super) fn of(linked: &'a Linked) -> Self {
        Self::new(linked.tokens_text.split(' ').collect())
    }

    pub(super) fn new(words: Vec<&'a str>) -> Self {
        let mut sentence = 0;
        let mut number = |word: &&str| {
            let own = sentence;
            sentence += usize::from(SENTENCE_MARKS.contains(word));
            own
        };
        let sentences = words.iter().map(&mut number).collect();
        Self { words, sentences }
    }

    /// The words of the sentence of a word.
    pub(super) fn sentence(&self, at: usize) -> Range<usize> {
        let Some(number) = self.sentences.get(at) else { return at..at };
        let from = self.sentences.partition_point(|other| other < number);
        from..self.sentences.partition_point(|other| other <= number)
    }

    /// The words in a range of them.
    pub(super) fn slice(&self, range: Range<usize>) -> &[&'a str] {
        self.words.get(range).unwrap_or_default()
    }

    /// Whether some words of a range are listed.
    pub(super) fn has(&self, range: Range<usize>, list: &str) -> bool {
        self.slice(range).iter().any(|word| is_listed(list, word))
    }

    /// Whether the sentence of a word only says what something is like.
    pub(super) fn is_likeness(&self, at: usize) -> bool {
        let sentence = self.slice(self.sentence(at));
        LIKENESS.iter().any(|opening| sentence.starts_with(opening))
    }

    /// Whether the words just before a word rule it out.
    pub(super) fn is_denied(&self, at: usize) -> bool {
        self.words[..at].iter().rev().take(3).any(|word| is_listed("no not never without 't dont", word))
    }

    /// The words behind a thing that are about it: up to the next thing or what leads on to it.
    pub(super) fn behind(&self, at: usize) -> Range<usize> {
        let end = self.sentence(at).end;
        let leads_on = |nth: usize| {
            let next = self.words.get(nth + 1).copied().unwrap_or_default();
            self.words[nth] == "and" && is_listed(GOES_ON, next)
        };
        let ends = |nth: &usize| is_object(self.words[*nth]) || is_listed(THENS, self.words[*nth]) || leads_on(*nth);
        at + 1..(at + 1..end).find(ends).unwrap_or(end)
    }

    /// The words before a thing that are about it.
    pub(super) fn before(&self, at: usize) -> Range<usize> {
        let start = self.sentence(at).start;
        let thing = (start..at).rev().find(|nth| is_object(self.words[*nth]));
        let start = thing.map_or(start, |thing| thing + 1);
        // `It comes first, then ..` is about the thing before.
        let is_taken = |nth: usize| {
            self.words[nth] == "first" && thing.is_some_and(|thing| nth == thing + 1 || self.is_pronoun(nth, thing))
        };
        let leads_on =
            |nth: &usize| is_listed(THENS, self.words[*nth]) && self.words[*nth] != "until" || is_taken(*nth);
        (start..at).rev().find(leads_on).map_or(start, |nth| nth + 1)..at
    }

    /// Whether a pronoun stands before a word, for the thing at `thing`.
    fn is_pronoun(&self, nth: usize, thing: usize) -> bool {
        self.words[thing + 1..nth].iter().rev().take(2).any(|word| is_listed(PRONOUNS, word))
    }

    /// Whether the words put a thing at `at` first: `we begin with it`, `it comes first`.
    pub(super) fn opens(&self, at: usize) -> bool {
        let mut behind = self.behind(at);
        let is_own = |nth: usize| self.words[nth] == "first" && (nth == at + 1 || self.is_pronoun(nth, at));
        self.has(self.before(at), FIRST) || behind.any(is_own)
    }

    /// Whether the word behind `last` makes it a time: `last month`.
    fn is_time(&self, nth: usize) -> bool {
        let next = self.words.get(nth + 1).copied().unwrap_or_default();
        self.words[nth] == "last" && (is_listed(TIMES, next) || next.starts_with("<qty"))
    }

    /// Whether the words put a thing at `at` last: `end on it`, `leave them with it`.
    pub(super) fn closes(&self, at: usize) -> bool {
        let is_last = |nth: usize| {
            let next = self.words.get(nth + 1).copied().unwrap_or_default();
            let is_time = self.is_time(nth);
            let is_left = matches!(self.words[nth], "leave" | "leaves" | "leaving") && is_listed(LEFT, next);
            let rests = self.words[nth] == "rest" && nth > 0 && self.words[nth - 1] == "to";
            is_listed(LAST, self.words[nth]) && !is_time && next != "of" || is_left || rests
        };
        let mut behind = self.behind(at);
        // `That comes last`.
        let is_own = |nth: usize| {
            self.words[nth] == "last"
                && !self.is_time(nth)
                && (nth == at + 1 || matches!(self.words[nth - 1], "comes" | "is" | "be" | "come"))
        };
        self.before(at).any(is_last) || behind.any(is_own)
    }
}

/// Whether a word stands for a thing.
pub(super) fn is_object(word: &str) -> bool {
    word.starts_with("<obj-")
}

#[cfg(test)]
#[expect(clippy::redundant_closure_for_method_calls, reason = "the methods are those of one lifetime")]
mod tests {
    use super::*;

    fn at_thing(text: &str, is_asked: impl for<'a> Fn(&Text<'a>, usize) -> bool) -> bool {
        let text = Text::new(text.split(' ').collect());
        let at = text.words.iter().position(|word| *word == "<obj-0>").unwrap();
        is_asked(&text, at)
    }

    #[test]
    fn words_say_what_comes_first() {
        let opens = |text| at_thing(text, |text, at| text.opens(at));
        assert!(opens("please begin from <obj-0> of coffee , and show little by little"));
        assert!(opens("<obj-0> first , then <obj-1>"));
        assert!(opens("<obj-0> where he read , that first . then <obj-1>"));
        assert!(opens("i imagine we start somewhere small , like <obj-0> or <obj-1>"));
        assert!(!opens("first <obj-1> and then <obj-0>"));
        assert!(!opens("<obj-1> first , <obj-0>"));
        assert!(!opens("<obj-0> , <obj-1> first"));
    }

    #[test]
    fn words_say_what_comes_last() {
        let closes = |text| at_thing(text, |text, at| text.closes(at));
        assert!(closes("it should finish on <obj-0> ."));
        assert!(closes("show <obj-1> . leave them with <obj-0> looking gorgeous"));
        assert!(closes("<obj-1> , and come to rest by <obj-0>"));
        assert!(closes("the world gets bigger until <obj-0> is there"));
        assert!(closes("in the end up to <obj-0>"));
        assert!(closes("<obj-0> is the dragon so that comes last and it fills <obj-1>"));
        assert!(!closes("i scanned <obj-0> last month"));
        assert!(!closes("the last <qty-0> of <obj-0>"));
        assert!(!closes("we end on <obj-1> . <obj-0> is hers"));
    }

    #[test]
    fn a_likeness_is_no_wish() {
        assert!(at_thing("you know in games when <obj-0> flies ? that .", |text, at| text.is_likeness(at)));
        assert!(!at_thing("you know games ? that . <obj-0>", |text, at| text.is_likeness(at)));
    }
}

//! Prompts of people who correct themselves: `finish close on the jar, no wait, medium on the skull`.
//!
//! What follows the correction replaces the words before it that are built alike: a thing a thing, a direction a
//! direction, a size with its thing a size with its thing. The rest of the sentence stays.

use super::linked::{Linked, OBJECT, QUANTITY};

/// What people say when they correct themselves, longest first. Commas do not count.
const CORRECTIONS: [&[&str]; 20] = [
    &["no", "wait", "scratch", "that"],
    &["wait", "no", "scratch", "that"],
    &["no", "wait", "sorry"],
    &["wait", "my", "mistake"],
    &["no", "my", "mistake"],
    &["sorry", "my", "mistake"],
    &["no", "scratch", "that"],
    &["no", "make", "that"],
    &["wait", "make", "that"],
    &["sorry", "i", "mean"],
    &["no", "i", "mean"],
    &["no", "wait"],
    &["wait", "no"],
    &["no", "sorry"],
    &["sorry", "no"],
    &["scratch", "that"],
    &["strike", "that"],
    &["i", "mean"],
    &["er", "no"],
    &["actually", "no"],
];
/// Most words of a denial in brackets.
const MAX_DENIED: usize = 6;
/// Most words of a phrase with a preposition.
const MAX_PHRASE: usize = 4;
/// Marks that may stand among the words of a correction and around them.
const MARKS: [&str; 8] = [",", ".", "-", ":", ";", "\u{2026}", "\u{2013}", "\u{2014}"];
/// Verbs that begin a phrase which is said once more: `push in on the jar, scratch that, push in on the mug`.
const VERBS: [&str; 28] = [
    "push", "pull", "pan", "tilt", "zoom", "dolly", "truck", "track", "crane", "orbit", "circle", "arc", "go", "move",
    "come", "look", "start", "end", "finish", "begin", "open", "fly", "rise", "turn", "swing", "slide", "hold", "show",
];
/// Words that say nothing about how a phrase is built.
const FILLERS: [&str; 8] = ["the", "a", "an", "to", "of", "just", "rather", "it"];
/// Words of a size.
const SIZES: [&str; 16] =
    ["ecu", "xcu", "bcu", "cu", "mcu", "ms", "mls", "mws", "ls", "ws", "fs", "els", "ews", "close", "wide", "medium"];
const DIRECTIONS: [&str; 7] = ["left", "right", "up", "down", "clockwise", "counterclockwise", "anticlockwise"];
const PREPOSITIONS: [&str; 10] = ["on", "at", "from", "toward", "towards", "past", "over", "around", "round", "behind"];

/// How a word builds a phrase.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Thing,
    Quantity,
    Size,
    Direction,
    Preposition,
}

fn kind(word: &str) -> Option<Kind> {
    match word {
        _ if word.starts_with(OBJECT) => Some(Kind::Thing),
        _ if word.starts_with(QUANTITY) => Some(Kind::Quantity),
        _ if SIZES.contains(&word) => Some(Kind::Size),
        _ if DIRECTIONS.contains(&word) => Some(Kind::Direction),
        _ if PREPOSITIONS.contains(&word) => Some(Kind::Preposition),
        _ => None,
    }
}

impl Linked {
    /// The words without things that are denied beside the thing that is meant: `on the vase (not the sideboard!)`, `not the
    /// plates, the teapot I mean`. `None` for prompts without one.
    #[must_use]
    pub fn without_denied(&self) -> Option<Self> {
        let words: Vec<(&str, [usize; 2])> = self.words_in([0, usize::MAX]).collect();
        let texts: Vec<&str> = words.iter().map(|(word, _)| *word).collect();
        let [from, to] = (0..texts.len()).find_map(|at| denied_at(&texts, at))?;
        let kept = (0..from).chain(to..words.len()).map(|at| words[at]);
        Some(Self { timeline: self.timeline.clone(), ..self.of_words(kept, None) })
    }

    /// The words as they stand after the last correction: what it replaces and the words of the correction left out.
    /// `None` for prompts without one, or whose correction replaces nothing that is built alike.
    #[must_use]
    pub fn corrected(&self) -> Option<Self> {
        if let Some(turned) = self.reversed().or_else(|| self.turned()) {
            return Some(turned);
        }
        let words: Vec<(&str, [usize; 2])> = self.words_in([0, usize::MAX]).collect();
        let texts: Vec<&str> = words.iter().map(|(word, _)| *word).collect();
        let [from, to] = (0..texts.len()).rev().find_map(|at| correction_at(&texts, at))?;
        let start = replaced(&texts[..from], &texts[to..])?;
        let start = start - fillers_again(&texts[..start], &texts[to..]);
        let kept = (0..start).chain(to..words.len()).map(|at| words[at]);
        let corrected = self.of_words(kept, None);
        // Nobody corrects away all that he talks about.
        (self.slots.is_empty() || !corrected.slots.is_empty()).then_some(corrected)
    }
}

impl Linked {
    /// The words with the two things before `other way round` exchanged: `turn from the palm to the guitar, no sorry, other way round,
    /// guitar to palm`. `None` for prompts without that.
    fn reversed(&self) -> Option<Self> {
        let mut words: Vec<(&str, [usize; 2])> = self.words_in([0, usize::MAX]).collect();
        let texts: Vec<&str> = words.iter().map(|(word, _)| *word).collect();
        let round =
            texts.windows(3).position(|three| matches!(three, ["other", "way", "round" | "around" | "about"]))?;
        let is_filler = |at: &usize| MARKS.contains(&texts[*at]) || REVERSALS.contains(&texts[*at]);
        let from = round - (0..round).rev().take_while(is_filler).count();
        if !texts[from..round].iter().any(|word| REVERSALS[..8].contains(word)) {
            return None;
        }
        let is_thing = |at: &usize| texts[*at].starts_with(OBJECT);
        let second = (0..from).rev().find(is_thing)?;
        let first = (0..second)
            .rev()
            .find(is_thing)
            .filter(|first| second - first < 5 && texts[*first..second].contains(&"to"))?;
        let mut to = round + 3;
        // What is said again.
        let again: Vec<usize> =
            (to..texts.len()).take(7).take_while(|at| !matches!(texts[*at], "." | ";" | "!")).collect();
        let named: Vec<usize> = again.iter().copied().filter(|at| is_thing(at)).collect();
        if let [one, other] = named[..]
            && (texts[one], texts[other]) == (texts[second], texts[first])
        {
            to = other + 1;
        }
        let (one, other) = (words[first].0, words[second].0);
        (words[first].0, words[second].0) = (other, one);
        let kept = (0..from).chain(to..words.len()).map(|at| words[at]);
        Some(self.of_words(kept.collect::<Vec<_>>().into_iter(), None))
    }
}

/// What people say before they turn a way around, and words beside it.
const REVERSALS: [&str; 12] =
    ["no", "sorry", "wait", "actually", "rather", "mean", "scratch", "oops", "the", "i", "or", "that"];

/// The words of the denial of a thing that begins at word `at`, in brackets or before `.. I mean`.
fn denied_at(words: &[&str], at: usize) -> Option<[usize; 2]> {
    let word = |at: usize| words.get(at).copied().unwrap_or_default();
    let is_thing = |at: &usize| word(*at).starts_with(OBJECT);
    if word(at) == "(" && word(at + 1) == "not" {
        let close = (at + 2..words.len()).take(MAX_DENIED).find(|at| word(*at) == ")")?;
        let others = (at + 2..close).filter(|at| !is_thing(at) && !FILLERS.contains(&word(*at)) && word(*at) != "!");
        let is_only = others.into_iter().all(|at| PREPOSITIONS.contains(&word(at)));
        return ((at + 2..close).any(|at| is_thing(&at)) && is_only).then_some([at, close + 1]);
    }
    let begins = at == 0 || MARKS.contains(&word(at - 1)) || matches!(word(at - 1), "no" | "and" | "but");
    let first = (at + 1..words.len()).find(|at| !FILLERS.contains(&word(*at)))?;
    let second = (first + 2..words.len()).find(|at| !FILLERS.contains(&word(*at)))?;
    let is_meant = matches!((word(second + 1), word(second + 2)), ("i", "mean" | "meant") | ("instead", _));
    let is_pair = is_thing(&first) && word(first + 1) == "," && is_thing(&second);
    // `Not the left one, the right one: ..`, where nothing is said before that the denial could belong to.
    let is_first = at == 0 || matches!(word(at - 1), "." | "!" | ";");
    let is_instead = is_first && matches!(word(second + 1), "" | ":" | "." | ";" | "!" | "-");
    (word(at) == "not" && begins && is_pair && (is_meant || is_instead)).then_some([at, first + 2])
}

/// The words of the correction that begins at word `at`, with the marks around it.
pub(super) fn correction_at(words: &[&str], at: usize) -> Option<[usize; 2]> {
    let is_mark = |at: &usize| words.get(*at).is_some_and(|word| MARKS.contains(word));
    let end_of = |phrase: &&[&str]| {
        phrase.iter().try_fold(at, |next, wanted| {
            let next = next + if next > at { (next..words.len()).take_while(is_mark).count() } else { 0 };
            (words.get(next) == Some(wanted)).then_some(next + 1)
        })
    };
    // `The abstract... no, on the easel`.
    let breaks_off = || {
        let before = |back: usize| at.checked_sub(back).and_then(|at| words.get(at)).copied().unwrap_or_default();
        let is_broken = matches!(before(1), "\u{2026}" | "\u{2014}") || before(1) == "." && before(2) == ".";
        (words[at] == "no" && is_broken && words.get(at + 1) == Some(&",")).then_some(at + 1)
    };
    let end = CORRECTIONS.iter().find_map(end_of).or_else(breaks_off)?;
    let end = end + (end..words.len()).take_while(is_mark).count();
    let end = end + denied_again(words, end);
    let before = (0..at).rev().take_while(is_mark).count();
    Some([at - before, end])
}

/// Number of the words that only say again what is taken back, with the marks behind them: `.. no wait, not the mug, the
/// plates`.
fn denied_again(words: &[&str], at: usize) -> usize {
    let is_mark = |word: &&&str| MARKS.contains(*word);
    let Some(rest) = words.get(at..).filter(|rest| rest.first() == Some(&"not")) else { return 0 };
    let thing = 1 + rest[1..].iter().take_while(|word| FILLERS.contains(word) || PREPOSITIONS.contains(word)).count();
    let marks = rest.iter().skip(thing + 1).take_while(is_mark).count();
    // `Not the mug the plates`, as people say it aloud.
    let is_named = |word: &&str| word.starts_with(OBJECT) && rest.get(thing) != Some(word);
    let goes_on = rest.iter().skip(thing + 1).find(|word| !FILLERS.contains(word)).is_some_and(is_named);
    let is_denied = rest.get(thing).is_some_and(|word| word.starts_with(OBJECT)) && (marks > 0 || goes_on);
    if is_denied { thing + 1 + marks } else { 0 }
}

/// The word before the correction from which on the words behind it replace what stands there: the last one that begins
/// a phrase of the same kinds of words, up to two.
fn replaced(before: &[&str], behind: &[&str]) -> Option<usize> {
    let kinds_from = |words: &[&str]| -> Vec<Option<Kind>> {
        words.iter().filter(|word| !FILLERS.contains(word)).take(2).map(|word| kind(word)).collect()
    };
    // A verb is said once more with all that belongs to it.
    let names =
        |words: &[&str]| words.iter().take_while(|word| !MARKS.contains(word)).any(|word| word.starts_with(OBJECT));
    let verb = behind.first().filter(|word| VERBS.contains(word) && names(behind));
    let again = verb.and_then(|verb| before.iter().rposition(|word| word == verb));
    if let Some(again) = again.filter(|again| names(&before[*again..])) {
        return Some(again);
    }
    // The same preposition just before what is taken back, whatever stood behind it.
    let preposition = behind.first().filter(|word| PREPOSITIONS.contains(word) && names(behind));
    let just_before = before.len().saturating_sub(MAX_PHRASE)..before.len();
    let said = preposition.and_then(|word| just_before.rev().find(|at| before[*at] == *word));
    if let Some(said) = said.filter(|at| !before[*at..].iter().any(|word| MARKS.contains(word))) {
        return Some(said);
    }
    let wanted = kinds_from(behind);
    let first = wanted.first().copied().flatten()?;
    let num = if first == Kind::Size || first == Kind::Preposition { 2 } else { 1 };
    let wanted = wanted.get(..num)?;
    (0..before.len()).rev().find(|&at| {
        !FILLERS.contains(&before[at]) && kinds_from(&before[at..]).get(..num).is_some_and(|found| found == wanted)
    })
}

/// Number of the words before what is replaced that are said again with it: `to the left, no wait, to the right`.
fn fillers_again(before: &[&str], behind: &[&str]) -> usize {
    let again = behind.iter().take_while(|word| FILLERS.contains(word)).count();
    let longest =
        (1..=again.min(before.len())).rev().find(|num| before[before.len() - num..] == behind[again - num..again]);
    longest.unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn corrected(text: &str) -> Option<String> {
        let words: Vec<&str> = text.split(' ').collect();
        let [from, to] = (0..words.len()).rev().find_map(|at| correction_at(&words, at))?;
        let start = replaced(&words[..from], &words[to..])?;
        let start = start - fillers_again(&words[..start], &words[to..]);
        Some([&words[..start], &words[to..]].concat().join(" "))
    }

    #[test]
    fn a_verb_that_is_said_again_replaces_its_phrase() {
        let push = Some("push in on <obj-1> , end on a close up".to_owned());
        assert_eq!(corrected("push in on <obj-0> . . . scratch that , push in on <obj-1> , end on a close up"), push);
        assert_eq!(
            corrected("hold , then pan to <obj-0> , no wait , pan to <obj-1>").as_deref(),
            Some("hold , then pan to <obj-1>")
        );
        assert_eq!(corrected("hold on <obj-0> , no wait , hold longer"), None);
        assert_eq!(corrected("go left , no wait , go to <obj-0>"), None);
    }

    #[test]
    fn who_breaks_off_says_a_phrase_anew() {
        let easel = Some("past <obj-0> , hold on <obj-1> , then tilt down".to_owned());
        assert_eq!(corrected("past <obj-0> , hold on the abstract . . . no , on <obj-1> , then tilt down"), easel);
        assert_eq!(corrected("hold on the abstract \u{2026} no , on <obj-1>").as_deref(), Some("hold on <obj-1>"));
        assert_eq!(corrected("past <obj-0> . no , on <obj-1>"), None);
    }

    #[test]
    fn words_before_a_direction_are_said_once() {
        assert_eq!(corrected("slide to the left , no wait , to the right").as_deref(), Some("slide to the right"));
        assert_eq!(corrected("go left , no , make that right , slowly").as_deref(), Some("go right , slowly"));
    }

    #[test]
    fn what_is_taken_back_may_be_said_again() {
        let plates = Some("go for <obj-1> beside it".to_owned());
        assert_eq!(corrected("go for <obj-0> . . . no wait , not <obj-0> , <obj-1> beside it"), plates);
        assert_eq!(
            corrected("go for the <obj-0> , wait no , not on <obj-0> . <obj-1> beside it"),
            plates.clone().map(|text| text.replace("for", "for the"))
        );
        assert_eq!(corrected("go for <obj-0> no sorry not <obj-0> <obj-1> beside it"), plates);
        assert_eq!(corrected("go for <obj-0> , no wait , not so fast"), None);
    }

    #[test]
    fn a_mistake_is_taken_back() {
        let right = Some("turn to <obj-1> and stop".to_owned());
        assert_eq!(corrected("turn to <obj-0> , wait , my mistake , <obj-1> and stop"), right);
    }

    /// A prompt of words, each a byte of it; `<obj-0>` is object 7, `<obj-1>` object 4.
    fn worded(text: &str) -> Linked {
        let spans = (0..text.split(' ').count()).map(|at| [at, at]).collect();
        Linked { tokens_text: text.to_owned(), spans, slots: vec![7, 4], ..Linked::default() }
    }

    #[test]
    fn what_is_denied_before_what_is_meant_is_left_out() {
        let left = |text: &str| worded(text).without_denied().map(|linked| linked.tokens_text);
        assert_eq!(left("not <obj-0> , <obj-1> : push in").as_deref(), Some("<obj-0> : push in"));
        assert_eq!(left("push in but not <obj-0> , <obj-1> : yes"), None);
        assert_eq!(left("not <obj-0> , <obj-1> or the door"), None);
    }

    #[test]
    fn a_way_is_turned_around() {
        let reversed = |text: &str| worded(text).corrected().map(|linked| (linked.tokens_text, linked.slots));
        let turned = Some(("turn from <obj-0> to <obj-1> . just turn".to_owned(), vec![4, 7]));
        let said = "turn from <obj-0> to <obj-1> , no sorry , other way round , <obj-1> to <obj-0> . just turn";
        assert_eq!(reversed(said), turned);
        assert_eq!(reversed("turn from <obj-0> to <obj-1> , or rather the other way round . just turn"), turned);
        assert_eq!(reversed("go from <obj-0> to <obj-1> the other way round"), None);
    }
}

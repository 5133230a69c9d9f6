//! Timelines: prompts that say part by part what happens when.
//!
//! Enters: the words of a prompt. Leaves: its beats, each with its bytes and its length where that is stated: `0-3s
//! wide, 3-6s the lamp`, `0:00 hold | 0:04 push in`, `T+0 .. T+3 ..`, `3s orbit, 2s hold`, `first third: ..`, `1) .. 2)
//! ..`, `.. cut to ..`, lines with dashes. A prompt with fewer than two beats is no timeline. The text before the first beat is the
//! introduction.

mod bullets;
mod holds;
mod shares;
mod stamp;

use super::tokenizer::{Word, span_of, word_at};
use bullets::bullets;
use holds::move_behind_hold;
use stamp::{Stamp, StampKind, begins_item, cut_at, stamp_at};

/// What a prompt says part by part.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Timeline {
    /// Bytes of the prompt before the first beat; empty without any.
    pub introduction: [usize; 2],
    /// The beats in order, at least two.
    pub beats: Vec<Beat>,
}

/// One part of a timeline.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Beat {
    /// Bytes of what happens in it, without its time.
    pub bytes: [usize; 2],
    /// Byte at which its time begins.
    pub start: usize,
    /// How long it lasts, where that is stated; 0 s for a picture of one moment.
    pub length: Option<BeatLength>,
    /// Whether it begins with a cut.
    pub cut: bool,
}

impl Beat {
    /// Its length in seconds, where it is stated so.
    pub fn secs(&self) -> Option<f64> {
        match self.length {
            Some(BeatLength::Secs(secs)) => Some(secs),
            _ => None,
        }
    }
}

/// Length of a beat.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum BeatLength {
    /// In seconds.
    Secs(f64),
    /// As a fraction of the film: the `first third`.
    Share(f64),
}

/// Most parts: each takes a run of the network.
const MAX_BEATS: usize = 32;
/// Words after the last time that only say that the film ends there.
const ENDINGS: [&str; 12] =
    ["end", "ends", "out", "cut", "done", "fin", "finish", "stop", "over", "black", "fade", "finished"];

/// The timeline of a prompt, if it is one.
pub(crate) fn timeline(prompt: &str, words: &[Word]) -> Option<Timeline> {
    let all = stamps(prompt, words);
    let families: [fn(&StampKind) -> bool; 4] = [
        |kind| matches!(kind, StampKind::Span(..) | StampKind::Point(_)),
        |kind| matches!(kind, StampKind::Share(_)),
        |kind| matches!(kind, StampKind::Length(_)),
        |kind| matches!(kind, StampKind::Number(_)),
    ];
    let listed = families.iter().find_map(|is_member| {
        let mut stamps: Vec<Stamp> = Vec::new();
        for stamp in all.iter().filter(|stamp| is_member(&stamp.kind)) {
            if stamps.last().is_none_or(|last| last.end <= stamp.at) {
                stamps.push(*stamp);
            }
        }
        is_sequence(words, &stamps).then(|| beats_of(words, &stamps)).flatten()
    });
    let lines = || beats_of(words, &bullets(prompt, words));
    let pictures = || cut_list(words).and_then(|(end, stamps)| beats_of(&words[..end], &stamps));
    listed.or_else(lines).or_else(pictures).or_else(|| beats_of(words, &cuts(words)))
}

/// Words before a number that make it no number of a list: `pan to chair 2.`, `hold for 2.`.
const BEFORE_AMOUNTS: [&str; 14] =
    ["to", "on", "at", "for", "from", "of", "with", "and", "between", "past", "around", "over", "in", "by"];

/// The stamps of all kinds that begin an item. The next number of a list needs no mark before it where no number with
/// one is there: `1. the mug 2. the jar`.
fn stamps(prompt: &str, words: &[Word]) -> Vec<Stamp> {
    let stamp_of = |i: usize| Some((stamp_at(prompt, words, i)?, begins_item(prompt, words, i)));
    let found: Vec<(Stamp, bool)> = (0..words.len()).filter_map(stamp_of).collect();
    let number_of = |stamp: &Stamp| match stamp.kind {
        StampKind::Number(number) => Some(number),
        _ => None,
    };
    let marked: Vec<u32> = found.iter().filter(|(_, begins)| *begins).filter_map(|(at, _)| number_of(at)).collect();
    let mut last = None;
    let is_member = |(stamp, begins): &(Stamp, bool)| {
        let number = number_of(stamp);
        let is_next = number.is_some_and(|number| last == number.checked_sub(1) && !marked.contains(&number));
        let before = stamp.at.checked_sub(1).map_or("", |before| word_at(words, before));
        let counts = *begins || is_next && !BEFORE_AMOUNTS.contains(&before);
        if counts {
            last = number.or(last);
        }
        counts
    };
    found.into_iter().filter(is_member).map(|(stamp, _)| stamp).collect()
}

/// The pictures that a prompt cuts between: the first from its start, the others from the cuts to them. Empty without a
/// cut.
fn cuts(words: &[Word]) -> Vec<Stamp> {
    let cuts: Vec<Stamp> = (0..words.len()).filter_map(|i| cut_at(words, i)).collect();
    let opening = Stamp { at: 0, end: 0, kind: StampKind::Cut };
    if cuts.is_empty() || cuts.len() >= MAX_BEATS { Vec::new() } else { [vec![opening], cuts].concat() }
}

/// The sentences of a prompt of which the last one says that cuts lie between them, and the word behind them: `Wide. Close on
/// the vase. Hard cuts between.`
fn cut_list(words: &[Word]) -> Option<(usize, Vec<Stamp>)> {
    let is_end = |at: &usize| matches!(word_at(words, *at), "." | ";" | "!");
    let last = words.iter().rposition(Word::is_alphabetic)?;
    let end = (0..last).rev().find(is_end)? + 1;
    let is_between =
        |at: usize| matches!(word_at(words, at), "cuts" | "cut") && matches!(word_at(words, at + 1), "between" | "in");
    let says_so = (end..words.len().min(end + 4)).any(is_between) && word_at(words, end) != "no";
    let starts = [0].into_iter().chain((0..end - 1).filter(is_end).map(|at| at + 1));
    let stamps: Vec<Stamp> = starts.map(|at| Stamp { at, end: at, kind: StampKind::Cut }).collect();
    (says_so && (2..MAX_BEATS).contains(&stamps.len())).then_some((end, stamps))
}

/// Whether stamps of one kind are a timeline: in order, and so that the first begins the list.
fn is_sequence(words: &[Word], stamps: &[Stamp]) -> bool {
    let [first, .., _] = stamps else { return false };
    if stamps.len() > MAX_BEATS {
        return false;
    }
    let in_order = stamps.windows(2).all(|pair| match (pair[0].kind, pair[1].kind) {
        (StampKind::Number(a), StampKind::Number(b)) => b == a + 1,
        (StampKind::Length(_) | StampKind::Share(_), _) => true,
        // `t=4 we are in close-up. t=4 to t=6 nothing moves.`
        (StampKind::Point(at), StampKind::Span(start, _)) if at > 0.0 => at <= start,
        (before, after) => before.start_secs() + 1e-3 < after.start_secs(),
    });
    match first.kind {
        // `Panel 12, .. panel 13, ..` is a piece of a longer list.
        StampKind::Number(number) => {
            let is_named = |stamp: &Stamp| matches!(word_at(words, stamp.at), "panel" | "shot" | "setup" | "beat");
            in_order && (number == 1 || stamps.iter().all(is_named))
        }
        StampKind::Span(start, _) | StampKind::Point(start) => {
            in_order && (start == 0.0 || stamps.len() > 2 || first.at == 0)
        }
        // `10 s: 3s orbit, ..`: lengths are a list only from its start on.
        StampKind::Length(_) => first.at == 0 || matches!(word_at(words, first.at - 1), ":" | "."),
        StampKind::Share(_) | StampKind::Cut => in_order,
    }
}

fn beats_of(words: &[Word], stamps: &[Stamp]) -> Option<Timeline> {
    let texts = stamps.iter().enumerate().map(|(nth, stamp)| {
        let end = stamps.get(nth + 1).map_or(words.len(), |next| next.at);
        trimmed(words, stamp.end, end)
    });
    let texts: Vec<[usize; 2]> = texts.collect();
    let mut beats: Vec<Beat> = Vec::with_capacity(stamps.len());
    let mut cut = false;
    for (nth, (stamp, text)) in stamps.iter().zip(&texts).enumerate() {
        let next = stamps.get(nth + 1).map(|next| next.kind.start_secs());
        let length = match stamp.kind {
            StampKind::Span(start, end) => Some(BeatLength::Secs(end - start)),
            StampKind::Point(start) => next.map(|next| BeatLength::Secs(next - start)),
            StampKind::Length(secs) => Some(BeatLength::Secs(secs)),
            StampKind::Share(share) => Some(BeatLength::Share(share)),
            StampKind::Number(_) | StampKind::Cut => None,
        };
        let is_last = nth + 1 == stamps.len();
        let is_end = is_last
            && matches!(stamp.kind, StampKind::Point(_) | StampKind::Number(_) | StampKind::Cut)
            && words[text[0]..text[1]]
                .iter()
                .all(|word| ENDINGS.contains(&word.text.as_str()) || !word.is_alphabetic());
        if is_end {
            break;
        }
        let start = words.get(stamp.at).map_or(0, |word| word.span[0]);
        let text = if is_last { without_ending(words, *text) } else { *text };
        let (text, cuts) = without_cut(words, text).map_or_else(|| without_joint(words, text), |text| (text, true));
        if text[0] == text[1] {
            return None;
        }
        cut |= stamp.kind == StampKind::Cut && nth > 0;
        let is_length = matches!(stamp.kind, StampKind::Length(_));
        let behind = move_behind_hold(words, text).filter(|_| is_length);
        let own = trimmed(words, text[0], behind.unwrap_or(text[1]));
        let own = without_joint(words, own).0;
        beats.push(Beat { bytes: span_of(&words[own[0]..own[1]]), start, length, cut });
        if let Some(at) = behind {
            let [from, to] = without_opening(words, trimmed(words, at, text[1]));
            let bytes = span_of(&words[from..to]);
            beats.push(Beat { bytes, start: bytes[0], length: None, cut: false });
        }
        cut = cuts;
    }
    let [first, ..] = stamps else { return None };
    let before = trimmed(words, 0, first.at);
    let introduction = span_of(&words[before[0]..before[1]]);
    (beats.len() > 1).then_some(Timeline { introduction, beats })
}

/// The last part without a sentence that only says that the film ends: `push in on the jar. out.`
fn without_ending(words: &[Word], [start, end]: [usize; 2]) -> [usize; 2] {
    let is_end = |word: &Word| ENDINGS.contains(&word.text.as_str());
    let last = words[start..end].iter().rposition(|word| !is_end(word) && word.is_alphabetic()).map_or(0, |at| at + 1);
    let kept = start + last;
    let is_sentence = words.get(kept).is_some_and(|word| matches!(word.text.as_str(), "." | ";" | "/"));
    if last > 0 && is_sentence { [start, kept] } else { [start, end] }
}

/// A part without the sentence that says when it is cut: `static on the vase. CUT at 0:04.` `None` without one.
fn without_cut(words: &[Word], [start, end]: [usize; 2]) -> Option<[usize; 2]> {
    let is_time = |word: &Word| {
        let is_number = word.text.starts_with(|c: char| c.is_ascii_digit());
        is_number || matches!(word.text.as_str(), "at" | "on" | ":" | "s" | "sec" | "seconds" | "hard" | "." | "-")
    };
    let at = start + words[start..end].iter().rposition(|word| matches!(word.text.as_str(), "cut" | "cuts"))?;
    // `Hard cut` is one thing.
    let at = at - usize::from(at > start && matches!(word_at(words, at - 1), "hard" | "smash" | "jump" | "straight"));
    let begins = at > start && matches!(word_at(words, at - 1), "." | ";" | ",");
    let mut rest = words[at..end].iter().skip_while(|word| !matches!(word.text.as_str(), "cut" | "cuts")).skip(1);
    (begins && rest.all(is_time)).then(|| trimmed(words, start, at))
}

/// A part without the words that lead to the next one, and whether they are a cut: `push in, then`, `push in, cut to`.
fn without_joint(words: &[Word], [start, end]: [usize; 2]) -> ([usize; 2], bool) {
    let is_joint = |word: &Word| matches!(word.text.as_str(), "then" | "and" | "next" | "cut" | "to" | "," | "." | ";");
    let kept = words[start..end].iter().rposition(|word| !is_joint(word)).map_or(start, |last| start + last + 1);
    let cuts = words[kept..end].iter().any(|word| word.text == "cut");
    let is_joined = cuts || words[kept..end].iter().any(|word| matches!(word.text.as_str(), "then" | "and" | "next"));
    if is_joined { ([start, kept], cuts) } else { ([start, end], false) }
}

/// A part without the words that only lead to it: `then pan right`.
fn without_opening(words: &[Word], [start, end]: [usize; 2]) -> [usize; 2] {
    let leads = |at: &usize| matches!(word_at(words, *at), "then" | "and" | ",");
    [start + (start..end).take_while(leads).count(), end]
}

/// The words `start..end` without marks at either end.
fn trimmed(words: &[Word], start: usize, end: usize) -> [usize; 2] {
    let is_mark =
        |word: &Word| matches!(word.text.as_str(), "," | "." | ";" | ":" | "/" | ")" | "(" | "]" | "[" | ">" | "=");
    let skipped = words[start..end].iter().take_while(|word| is_mark(word)).count();
    let first = start + skipped;
    let kept = words[first..end]
        .iter()
        .rposition(|word| !matches!(word.text.as_str(), "," | "." | ";" | ":" | "/" | "(" | "["));
    [first, kept.map_or(first, |last| first + last + 1)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mention::link_mentions;

    #[test]
    fn sentences_with_cuts_between_are_pictures() {
        let parts = |prompt: &str| -> Vec<(String, bool)> {
            let timeline = link_mentions(prompt, &[]).unwrap().timeline;
            let beats = timeline.map(|timeline| timeline.beats).unwrap_or_default();
            beats.iter().map(|beat| (prompt[beat.bytes[0]..beat.bytes[1]].to_owned(), beat.cut)).collect()
        };
        let three = [("Wide first", false), ("Medium of the chair", true), ("Close on the vase", true)];
        let three = three.map(|(text, cut)| (text.to_owned(), cut));
        assert_eq!(parts("Wide first. Medium of the chair. Close on the vase. Hard cuts between, no moves."), three);
        assert_eq!(parts("Wide first. Close on the vase. No cuts between."), []);
        assert_eq!(parts("Panel 12, low. Panel 13, over it.").len(), 2);
    }

    #[test]
    fn equations_are_time_codes_of_beats() {
        let lengths = |prompt: &str| {
            let timeline = link_mentions(prompt, &[]).unwrap().timeline;
            timeline.map(|timeline| timeline.beats.iter().map(Beat::secs).collect::<Vec<_>>())
        };
        assert_eq!(lengths("t=0 on the mug. t=4 pan to the jar. t=8 end."), Some(vec![Some(4.0), Some(4.0)]));
        let moment = Some(vec![Some(4.0), Some(0.0), Some(2.0)]);
        assert_eq!(lengths("t=0s wide of the mug. t=4s close on it. t=4 to t=6 nothing moves. end."), moment);
    }
}

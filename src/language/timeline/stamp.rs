//! What a part of a timeline begins with.

use super::shares::share_at;
use crate::numerals::{cardinal_at, number_word};
use crate::quantity::{Instant, InstantForm, QuantityKind, frames_per_sec, instant_at, is_joined, link_at, unit};
use crate::tokenizer::{Word, word_at};

/// The beginning of a part.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Stamp {
    /// Index of its first word.
    pub(super) at: usize,
    /// Index after its last word.
    pub(super) end: usize,
    pub(super) kind: StampKind,
}

/// What it says.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum StampKind {
    /// From and to, seconds.
    Span(f64, f64),
    /// From, seconds.
    Point(f64),
    /// Seconds.
    Length(f64),
    /// Fraction of the film.
    Share(f64),
    /// Number in a list.
    Number(u32),
    /// A cut.
    Cut,
}

impl StampKind {
    /// When the part starts, seconds; 0 where the stamp does not say it.
    pub(super) fn start_secs(self) -> f64 {
        match self {
            Self::Span(start, _) | Self::Point(start) => start,
            _ => 0.0,
        }
    }
}

/// Whether word `i` is the first of a line, a cell or a clause.
pub(super) fn begins_item(prompt: &str, words: &[Word], i: usize) -> bool {
    let Some(before) = i.checked_sub(1).and_then(|at| words.get(at)) else { return true };
    let gap = words.get(i).and_then(|word| prompt.get(before.span[1]..word.span[0])).unwrap_or_default();
    // `(1) t = 0-4 s` is an item by its number.
    if before.text == ")" && is_equated(prompt, words, i) {
        return false;
    }
    // `T+3` and `2)` begin a part wherever they stand.
    let stands_out = match (word_at(words, i), word_at(words, i + 1)) {
        ("t", "+") => true,
        (number, ")") => before.text != "(" && number.bytes().all(|byte| byte.is_ascii_digit()),
        _ => false,
    };
    stands_out
        || gap.contains(['\n', '|', '\u{2022}', '*'])
        || matches!(before.text.as_str(), "(" | "[")
        || before.text == "#" && begins_item(prompt, words, i - 1)
        || matches!(before.text.as_str(), "," | "." | ";" | ":" | "/" | "!" | "?" | ")" | "then" | "and")
            && !is_joined(words, i)
}

/// Whether the prompt has `=` behind word `i`, as in `t=4`; it is no word.
fn is_equated(prompt: &str, words: &[Word], i: usize) -> bool {
    // Plain words for shorthand have the bytes of all of it.
    let both = words.get(i).zip(words.get(i + 1)).and_then(|(word, next)| prompt.get(word.span[0]..next.span[1]));
    both.is_some_and(|both| both.contains('='))
}

/// The stamp that begins at word `i`.
pub(super) fn stamp_at(prompt: &str, words: &[Word], i: usize) -> Option<Stamp> {
    let stamp = |end, kind| Some(Stamp { at: i, end, kind });
    if let Some((end, share)) = share_at(words, i) {
        return stamp(end, StampKind::Share(share));
    }
    if let Some((end, kind)) = labelled_time_at(prompt, words, i) {
        return stamp(end, kind);
    }
    if let Some((end, number)) = list_number_at(prompt, words, i) {
        let at = i - usize::from(i > 0 && word_at(words, i - 1) == "#");
        return Some(Stamp { at, end, kind: StampKind::Number(number) });
    }
    if let Some((end, kind)) = frames_at(words, i) {
        return stamp(end, kind);
    }
    let start = match (word_at(words, i), word_at(words, i + 1)) {
        ("t", "+") => i + 2,
        ("t", _) if is_equated(prompt, words, i) => i + 1,
        ("from" | "at" | "by" | "second" | "sec" | "secs" | "seconds" | "tc" | "timecode", _) => i + 1,
        _ => i,
    };
    let is_named = start > i;
    let first = instant_at(words, start)?;
    if let Some((end, kind)) = span_from(words, start, first) {
        return stamp(end, kind);
    }
    let is_named_time = is_named && word_at(words, i) != "by" && !other_unit(words, first.end);
    let is_code = first.form == InstantForm::Clock || is_named_time;
    match first.form {
        _ if is_code && word_at(words, i) != "from" => stamp(first.end, StampKind::Point(first.secs)),
        InstantForm::Measure if !is_named && first.secs > 0.0 && begins_work(words, first.end) => {
            stamp(first.end, StampKind::Length(first.secs))
        }
        _ => None,
    }
}

/// Words that deny a cut behind them, and how far behind.
const DENIALS: [&str; 14] = [
    "no",
    "not",
    "never",
    "without",
    "avoid",
    "than",
    "instead",
    "don",
    "dont",
    "'t",
    "t",
    "\u{2019}t",
    "cannot",
    "nor",
];
const DENIED_WORDS: usize = 6;

/// The cut that begins at word `i`: `cut to`, `then smash cut to`, `cuts back to`, and none that is denied.
pub(super) fn cut_at(words: &[Word], i: usize) -> Option<Stamp> {
    let is_mark = |at: &usize| matches!(word_at(words, *at), "," | "." | ";" | ":" | "!" | "?");
    let mut before = (0..i).rev().take(DENIED_WORDS).take_while(|at| !is_mark(at));
    let is_cut = matches!(word_at(words, i), "cut" | "cuts")
        && !before.any(|at| DENIALS.contains(&word_at(words, at)))
        && !(i > 0 && matches!(word_at(words, i - 1), "a" | "the"));
    let lingers = matches!(word_at(words, i + 1), "back" | "straight" | "directly" | "right" | "over" | "now");
    let to = i + 1 + usize::from(lingers);
    if !is_cut || word_at(words, to) != "to" {
        return None;
    }
    let leads = |at: &usize| {
        matches!(
            word_at(words, *at),
            "then" | "and" | "we" | "hard" | "smash" | "jump" | "match" | "quick" | "straight"
        )
    };
    let at = (0..i).rev().take_while(leads).last().unwrap_or(i);
    let end = to + 1 + usize::from(word_at(words, to + 1) == ":");
    Some(Stamp { at, end, kind: StampKind::Cut })
}

/// A span of time that begins with `first`.
fn span_from(words: &[Word], start: usize, first: Instant) -> Option<(usize, StampKind)> {
    let link = link_at(words, start, first)?;
    // `t=4 to t=6`.
    let to = first.end + link;
    let last = instant_at(words, to + usize::from(word_at(words, to) == "t"))?;
    let is_code = start > 0 && word_at(words, start - 1) == "t";
    if other_unit(words, first.end) || other_unit(words, last.end) {
        return None;
    }
    let is_time = [first.form, last.form].iter().any(|form| *form != InstantForm::Bare)
        || is_code
        || first.secs == 0.0
        || is_written_as_code(word_at(words, start))
        || matches!(word_at(words, last.end), ":" | ")");
    (is_time && last.secs > first.secs).then_some((last.end, StampKind::Span(first.secs, last.secs)))
}

/// Whether a number has a leading zero, as those of clocks have: the `03` of `03-06`.
fn is_written_as_code(number: &str) -> bool {
    number.len() == 2 && number.starts_with('0')
}

/// `frames 0-48`, `fr 48 to 96`: the word after it, and the span.
fn frames_at(words: &[Word], i: usize) -> Option<(usize, StampKind)> {
    let is_frames = matches!(word_at(words, i), "frames" | "frame" | "fr" | "frs");
    let first = instant_at(words, i + 1).filter(|first| is_frames && first.form == InstantForm::Bare)?;
    let link = link_at(words, i + 1, first)?;
    let last = instant_at(words, first.end + link).filter(|last| last.form == InstantForm::Bare)?;
    // The first frame is 0 or 1.
    let first_frame = if first.secs <= 1.0 { 0.0 } else { first.secs };
    let rate = frames_per_sec(words);
    let is_span = last.secs > first_frame + 1.0;
    is_span.then(|| (last.end, StampKind::Span(first_frame / rate, last.secs / rate)))
}

/// Whether word `i` is a unit of something else than time.
fn other_unit(words: &[Word], i: usize) -> bool {
    let other = matches!(word_at(words, i), "x" | "fps" | "k" | "/" | "per" | "times" | "frames");
    other || unit(word_at(words, i)).is_some_and(|(kind, _)| kind != QuantityKind::Seconds)
}

/// Whether what follows a length is what happens in it, not what the length is of.
fn begins_work(words: &[Word], end: usize) -> bool {
    let next = word_at(words, end);
    !matches!(
        next,
        "" | ")"
            | ","
            | "total"
            | "long"
            | "overall"
            | "later"
            | "of"
            | "in"
            | "max"
            | "tops"
            | "each"
            | "per"
            | "is"
            | "or"
            | "film"
            | "video"
            | "clip"
            | "shot"
            | "."
            | ";"
            | "before"
            | "after"
            | "then"
            | "and"
            | "altogether"
            | "all"
            | "please"
            | "thanks"
            | "sharp"
            | "flat"
    )
}

/// What the parts of a list are called.
const LABELS: [&str; 15] = [
    "shot", "beat", "step", "part", "move", "frame", "pos", "position", "panel", "scene", "segment", "phase",
    "section", "clip", "setup",
];

/// Such names in short, and those of drawings, before a number and a colon: `P1:`, `box 2:`.
const SHORT_LABELS: [&str; 9] = ["p", "pnl", "sh", "seg", "box", "sketch", "drawing", "thumbnail", "pic"];

/// `shot 1, 0:00-0:04:`, `step 2 (4 s):`, `A, 3 s:`: the word after it, and the time of the part.
fn labelled_time_at(prompt: &str, words: &[Word], i: usize) -> Option<(usize, StampKind)> {
    let is_number = |at: usize| {
        let word = word_at(words, at);
        let is_word = || (1..=20).any(|number| number_word(number) == Some(word));
        word.len() <= 2 && word.parse::<u32>().is_ok() || is_word()
    };
    let is_letter = |at: usize| matches!(word_at(words, at), "a" | "b" | "c" | "d" | "e" | "f" | "g" | "h");
    let is_capital = || {
        let text = words.get(i).and_then(|word| prompt.get(word.span[0]..word.span[1])).unwrap_or_default();
        text.chars().all(char::is_uppercase)
    };
    let label = if LABELS.contains(&word_at(words, i)) && (is_number(i + 1) || is_letter(i + 1)) {
        2
    } else {
        usize::from(is_letter(i) && is_capital())
    };
    let mark = word_at(words, i + label);
    if label == 0 || !matches!(mark, "," | "(" | "[" | ":") {
        return None;
    }
    let start = i + label + 1;
    let first = instant_at(words, start)?;
    let (end, kind) = span_from(words, start, first).or_else(|| {
        let is_length = first.form == InstantForm::Measure && first.secs > 0.0;
        is_length.then_some((first.end, StampKind::Length(first.secs)))
    })?;
    let closed = end + usize::from(matches!(word_at(words, end), ")" | "]"));
    let is_head = closed > end || matches!(word_at(words, closed), ":" | "," | ".");
    is_head.then_some((closed + usize::from(word_at(words, closed) == ":"), kind))
}

/// `1)`, `2.`, `#3`, `shot 4:`, `beat two:`: the word after it, and the number.
fn list_number_at(prompt: &str, words: &[Word], i: usize) -> Option<(usize, u32)> {
    let is_named = LABELS.contains(&word_at(words, i));
    let after_mark = i > 0 && matches!(word_at(words, i - 1), "#" | "(");
    let is_letter = SHORT_LABELS.contains(&word_at(words, i)) && word_at(words, i + 2) == ":";
    let is_named = is_named || is_letter;
    let at = i + usize::from(is_named);
    let word = words.get(at)?;
    let number = match word.text.parse::<u32>() {
        // `Frame 48` is a time.
        Ok(number) if word.text.len() <= 2 && (number <= 20 || word_at(words, i) != "frame") => number,
        _ if is_named => (1..=20).find(|number| number_word(*number) == Some(word.text.as_str()))?,
        _ => return None,
    };
    let mark = word_at(words, at + 1);
    let is_closed = match mark {
        ")" => true,
        _ if after_mark && word_at(words, i - 1) == "#" => true,
        ":" | "." | "," | "/" => is_named || after_mark || mark == "." && is_followed_by_space(prompt, words, at + 1),
        _ => false,
    };
    let is_measure = cardinal_at(words, at).is_some_and(|(len, _)| len > 1);
    // `#2 pan left` has no mark behind the number.
    let has_mark = matches!(mark, ")" | ":" | "." | "," | "/");
    (is_closed && !is_measure && number > 0).then_some((at + 1 + usize::from(has_mark), number))
}

/// Whether a space follows word `i`.
fn is_followed_by_space(prompt: &str, words: &[Word], i: usize) -> bool {
    words.get(i).and_then(|word| prompt.get(word.span[1]..)).is_some_and(|rest| rest.starts_with(char::is_whitespace))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tokenizer::tokenize;

    fn kinds(prompt: &str) -> Vec<StampKind> {
        let words = tokenize(prompt);
        let begins = (0..words.len()).filter(|at| begins_item(prompt, &words, *at));
        begins.filter_map(|at| stamp_at(prompt, &words, at)).map(|stamp| stamp.kind).collect()
    }

    #[test]
    fn time_codes_may_be_equations() {
        let codes = [StampKind::Point(0.0), StampKind::Point(4.0)];
        assert_eq!(kinds("t=0s wide of the mug. t=4s close on it"), codes);
        assert_eq!(kinds("T = 0 on the mug; T = 4 pan to the jar"), codes);
        assert_eq!(kinds("wide. t=4 to t=6 nothing moves")[0], StampKind::Span(4.0, 6.0));
        assert_eq!(kinds("00-03 hold / 03-06 pan right"), [StampKind::Span(0.0, 3.0), StampKind::Span(3.0, 6.0)]);
        assert_eq!(kinds("a t 4 tube"), []);
        assert_eq!(kinds("at t = 4 only the mug is in shot"), []);
        assert_eq!(kinds("(1) t = 0-4 s orbit")[..], [StampKind::Number(1)]);
    }
}

//! Time codes and spans of time, each read as one duration: `0:02-0:05`, `0-3s`, `from 2 to 5 seconds`, `at 0:05`.
//!
//! A span lasts from its start to its end. A time code alone lasts from the time code before it, or from 0:00.

use super::belonging::{is_counted, is_heading};
use super::context::{back, begins_clause, is_dash, is_joined, time_before, word_before};
use super::kind::{Found, QuantityKind, found};
use super::unit::time_scale;
use crate::numerals::cardinal_at;
use crate::tokenizer::{Word, word_at};

/// Number of words in which the time code before another is searched.
const LOOK_BACK: usize = 64;
/// Longest span without a unit, in seconds.
const MAX_BARE_SECS: f64 = 120.0;

/// One end of a span.
#[derive(Clone, Copy)]
pub(crate) struct Instant {
    /// Index of the word after it.
    pub(crate) end: usize,
    /// Seconds.
    pub(crate) secs: f64,
    /// How it is written.
    pub(crate) form: InstantForm,
}

/// How an instant is written.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum InstantForm {
    /// `0:05`
    Clock,
    /// `5 s`
    Measure,
    /// `5`
    Bare,
}

/// A span or a time code.
pub(super) fn clock_at(words: &[Word], i: usize) -> Option<Found> {
    span_at(words, i).or_else(|| code_at(words, i)).or_else(|| secs_alone_at(words, i))
}

/// `:07` as seven seconds.
fn secs_alone_at(words: &[Word], i: usize) -> Option<Found> {
    let is_alone = word_at(words, i) == ":" && !is_joined(words, i) && is_joined(words, i + 1);
    let goes_on = word_at(words, i + 2) == ":" && is_joined(words, i + 2);
    let secs = sixtieths(word_at(words, i + 1)).filter(|_| is_alone && !goes_on)?;
    (secs > 0.0).then(|| found(2, QuantityKind::Seconds, secs))
}

/// A span of time, its value end minus start.
fn span_at(words: &[Word], i: usize) -> Option<Found> {
    let start = instant_at(words, i)?;
    let link = link_at(words, i, start)?;
    let end = instant_at(words, start.end + link)?;
    let is_span = match (start.form, end.form) {
        // `50 degrees at 0:00 to 25 degrees at 0:06` spans two angles.
        (InstantForm::Clock, InstantForm::Bare) => !has_other_unit(words, end.end),
        (InstantForm::Clock, _) | (_, InstantForm::Clock) => true,
        (InstantForm::Measure, _) => word_at(words, start.end) != "or",
        (InstantForm::Bare, InstantForm::Measure) => is_certain(words, i, start, end),
        (InstantForm::Bare, InstantForm::Bare) => is_span_without_unit(words, i, start, end),
    };
    let secs = end.secs - start.secs;
    (is_span && secs > 0.0).then(|| found(end.end - i, QuantityKind::Seconds, secs))
}

/// Whether `2 to 5 seconds` is a span and no estimate.
fn is_certain(words: &[Word], i: usize, start: Instant, end: Instant) -> bool {
    let before = word_before(words, i, 1);
    // `Shot 4 - 6 sec`: the first number is a name.
    if is_heading(before) && is_dash(words, start.end) && start.secs > 0.0 {
        return false;
    }
    start.secs == 0.0
        || matches!(before, "from" | "between" | "t" | "time")
        || before == "(" && end.secs - start.secs > 1.0
        || word_at(words, end.end) == ":"
        || continues(words, i, start)
}

/// Whether two numbers without a unit are a span: `3-6` after `0-3s`, `0-3:` at the start of a list item.
fn is_span_without_unit(words: &[Word], i: usize, start: Instant, end: Instant) -> bool {
    let after = word_at(words, end.end);
    let is_hyphen = words.get(start.end).is_some_and(|word| word.after_hyphen);
    let is_list_item = begins_clause(words, i) && is_hyphen && (start.secs == 0.0 || after == ":");
    let is_time = is_list_item || matches!(word_before(words, i, 1), "t") || continues(words, i, start);
    is_time && end.secs <= MAX_BARE_SECS && !has_other_unit(words, end.end) && !is_counted(words, end.end)
}

/// Whether the word behind a number is the unit of another thing than a time.
fn has_other_unit(words: &[Word], i: usize) -> bool {
    matches!(
        word_at(words, i),
        "%" | "x" | "mm" | "m" | "cm" | "deg" | "degrees" | "\u{B0}" | "k" | "fps" | "percent" | "/"
    )
}

/// Whether a span or a time code before word `i` ends where this one starts.
fn continues(words: &[Word], i: usize, start: Instant) -> bool {
    let first = i.saturating_sub(LOOK_BACK);
    let ends_span = |at: &usize| {
        let after_link = words.get(*at).is_some_and(|word| word.after_hyphen)
            || matches!(word_before(words, *at, 1), "to" | "till" | "until")
            || *at > 0 && is_dash(words, at - 1);
        after_link && instant_at(words, *at).is_some_and(|instant| (instant.secs - start.secs).abs() < 1e-9)
    };
    (begins_clause(words, i) || word_before(words, i, 1) == "/")
        && (first..i).rev().any(|at| ends_span(&at))
        && (time_before(words, i, LOOK_BACK) || has_zero(words, i))
}

/// Whether a bare zero, where the first span of a list starts, precedes word `i`.
fn has_zero(words: &[Word], i: usize) -> bool {
    back(words, i, LOOK_BACK).any(|word| word.bytes().all(|byte| byte == b'0'))
}

/// Number of words between the ends of a span, from the word after its start.
pub(crate) fn link_at(words: &[Word], i: usize, start: Instant) -> Option<usize> {
    let at = start.end;
    match word_at(words, at) {
        "to" | "till" | "until" | "til" | "thru" | "through" | ">" => Some(1),
        "and" if word_before(words, i, 1) == "between" => Some(1),
        "," if is_dash(words, at) => Some(1),
        "." if word_at(words, at + 1) == "." && is_joined(words, at + 1) => Some(2),
        _ => {
            let are_clocks = start.form == InstantForm::Clock && digits_of_clock_at(words, at).is_some();
            (are_clocks || words.get(at).is_some_and(|word| word.after_hyphen)).then_some(0)
        }
    }
}

/// The time code or number at word `i`.
pub(crate) fn instant_at(words: &[Word], i: usize) -> Option<Instant> {
    if let Some((len, secs)) = digits_of_clock_at(words, i) {
        let unit = usize::from(time_scale(words, i + len).is_some());
        return Some(Instant { end: i + len + unit, secs, form: InstantForm::Clock });
    }
    let (len, value) = cardinal_at(words, i)?;
    match time_scale(words, i + len) {
        Some(scale) => Some(Instant { end: i + len + 1, secs: value * scale, form: InstantForm::Measure }),
        None => Some(Instant { end: i + len, secs: value, form: InstantForm::Bare }),
    }
}

/// A time code alone, as the time since the one before.
fn code_at(words: &[Word], i: usize) -> Option<Found> {
    let (len, secs) = digits_of_clock_at(words, i)?;
    let earlier = i.saturating_sub(LOOK_BACK)..i;
    let last = earlier.rev().find_map(|at| digits_of_clock_at(words, at));
    let unit = usize::from(time_scale(words, i + len).is_some());
    let after_preposition =
        matches!(word_before(words, i, 1), "at" | "by" | "until" | "till" | "to" | "from" | "around" | "runtime");
    if secs >= 60.0 && unit == 0 && last.is_none() && !after_preposition {
        return None;
    }
    let since = last.map_or(0.0, |(_, last)| last);
    let duration = if secs > since { secs - since } else { secs };
    (duration > 0.0).then(|| found(len + unit, QuantityKind::Seconds, duration))
}

/// Frames a second of films whose words state frames and no rate.
const FRAMES_PER_SEC: f64 = 24.0;

/// Frames a second that the words state (`25 fps`), or the usual ones.
pub(crate) fn frames_per_sec(words: &[Word]) -> f64 {
    // Every frame number asks for the rate: words are compared before a number is parsed.
    rate_of(words.windows(2).map(|pair| [pair[0].text.as_str(), pair[1].text.as_str()]))
}

/// The rate of frames that pairs of words in a row state, or the usual one.
pub(crate) fn rate_of<'a>(pairs: impl Iterator<Item = [&'a str; 2]>) -> f64 {
    let mut rates = pairs.filter(|pair| pair[1] == "fps").filter_map(|pair| pair[0].parse().ok());
    rates.find(|rate| (1.0..=240.0).contains(rate)).unwrap_or(FRAMES_PER_SEC)
}

/// The frame number `f72` at word `i`, two words, in seconds.
fn frame_at(words: &[Word], i: usize) -> Option<f64> {
    let number = |at: usize| {
        let is_frame = word_at(words, at) == "f" && is_joined(words, at + 1);
        whole(word_at(words, at + 1), 1..=5).filter(|_| is_frame)
    };
    // `f8` may be an aperture; frames come as spans.
    let is_span = number(i + 2).is_some() || i >= 2 && number(i - 2).is_some();
    number(i).filter(|_| is_span).map(|number| number / frames_per_sec(words))
}

/// The time code `m:ss` or `h:mm:ss` at word `i`: number of words, seconds. No ratio as `16:9`.
fn digits_of_clock_at(words: &[Word], i: usize) -> Option<(usize, f64)> {
    if let Some(secs) = frame_at(words, i) {
        return Some((2, secs));
    }
    let minutes = whole(word_at(words, i), 1..=2)?;
    let is_inner = i > 0 && word_at(words, i - 1) == ":" && is_joined(words, i);
    let colon = |at: usize| word_at(words, at) == ":" && is_joined(words, at) && is_joined(words, at + 1);
    if is_inner || !colon(i + 1) || minutes >= 10.0 {
        return None;
    }
    let secs = sixtieths(word_at(words, i + 2))?;
    if colon(i + 3) {
        let last = sixtieths(word_at(words, i + 4))?;
        return Some((5, (minutes * 60.0 + secs) * 60.0 + last));
    }
    let is_other =
        matches!(word_at(words, i + 3), "scale" | "model" | "aspect" | "ratio" | "am" | "pm" | "crop" | "macro");
    (!is_other).then_some((3, minutes * 60.0 + secs))
}

/// The value of a run of digits of one of these lengths.
fn whole(word: &str, lengths: std::ops::RangeInclusive<usize>) -> Option<f64> {
    let is_whole = word.bytes().all(|byte| byte.is_ascii_digit()) && lengths.contains(&word.len());
    word.parse().ok().filter(|_| is_whole)
}

/// Two digits below 60, with decimals.
fn sixtieths(word: &str) -> Option<f64> {
    whole(word.split('.').next().unwrap_or_default(), 2..=2)?;
    word.parse().ok().filter(|value| *value < 60.0)
}

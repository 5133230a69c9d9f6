//! Times that a number without a unit states: `hold for 3`, `count three`, `at second 6`, `12 total`, `1m30`.

use super::belonging::bare_number;
use super::context::{
    after_hedges, back, begins_clause, cause, ends_phrase, is_joined, sentence_back, time_before, word_before,
};
use super::kind::{Found, QuantityKind, found};
use super::unit::is_time_unit;
use crate::numerals::cardinal_at;
use crate::tokenizer::{Word, word_at};

/// Longest time without a unit, in seconds.
const MAX_BARE_SECS: f64 = 60.0;
/// Number of words in which a time with a unit makes a number without one a time.
const LOOK_BACK: usize = 30;

/// A time without a plain unit.
pub(super) fn time_at(words: &[Word], i: usize) -> Option<Found> {
    minutes_and_seconds_at(words, i).or_else(|| bare_time_at(words, i))
}

/// `1m30`, `1 min 30`, `2 minutes and 5 seconds`.
fn minutes_and_seconds_at(words: &[Word], i: usize) -> Option<Found> {
    let (len, minutes) = cardinal_at(words, i)?;
    let unit = word_at(words, i + len);
    let is_minute = matches!(unit, "min" | "mins" | "minute" | "minutes");
    let joined = unit == "m" && is_joined(words, i + len) && is_joined(words, i + len + 1);
    let and = usize::from(is_minute && word_at(words, i + len + 1) == "and");
    let rest = i + len + 1 + and;
    let (rest_len, secs) = cardinal_at(words, rest).filter(|(_, secs)| *secs < 60.0)?;
    let end = rest + rest_len;
    let has_unit = is_time_unit(words, end);
    let is_height = || {
        let speaks_of_height = |word: &str| {
            matches!(
                word,
                "height"
                    | "high"
                    | "at"
                    | "eye"
                    | "eyes"
                    | "up"
                    | "above"
                    | "off"
                    | "lens"
                    | "rise"
                    | "tall"
                    | "are"
                    | "h"
            )
        };
        back(words, i, 3).any(speaks_of_height)
            || matches!(word_at(words, end), "high" | "above" | "off" | "away" | "from" | "tall" | "up")
    };
    let is_time = has_unit && (is_minute || joined)
        || is_minute && and == 0
        || joined && word_at(words, rest).len() == 2 && !is_height();
    is_time.then(|| found(end + usize::from(has_unit) - i, QuantityKind::Seconds, minutes * 60.0 + secs))
}

/// A number that the words around make a time.
fn bare_time_at(words: &[Word], i: usize) -> Option<Found> {
    let (end, secs) = bare_number(words, i).filter(|(_, secs)| *secs <= 10.0 * MAX_BARE_SECS)?;
    let is_time = is_total(words, i, end)
        || secs <= MAX_BARE_SECS
            && (is_held(words, i, end)
                || time_before(words, i, LOOK_BACK) && is_time_after_another(words, i, end, secs));
    is_time.then(|| found(end - i, QuantityKind::Seconds, secs))
}

/// `12 total`, `15 all in`, `total 12`.
fn is_total(words: &[Word], i: usize, end: usize) -> bool {
    let next = [0, 1].map(|k| word_at(words, end + k));
    matches!(next, ["total" | "overall" | "altogether", _] | ["all", "in"] | ["in", "total" | "all"])
        || matches!(cause(words, i), "total" | "duration" | "runtime") && ends_phrase(words, end)
        || cause(words, i) == "of"
            && word_before(words, after_hedges(words, i), 2) == "total"
            && ends_phrase(words, end)
}

/// `hold 3`, `wait three`, `stay there for five`.
fn is_held(words: &[Word], i: usize, end: usize) -> bool {
    let holds = |word: &str| {
        matches!(
            word,
            "hold"
                | "holds"
                | "holding"
                | "wait"
                | "waits"
                | "pause"
                | "pauses"
                | "stay"
                | "stays"
                | "count"
                | "linger"
                | "lingers"
                | "rest"
                | "rests"
                | "sit"
                | "sits"
                | "static"
                | "still"
                | "stop"
                | "stops"
                | "freeze"
                | "settle"
                | "settles"
                | "park"
                | "remain"
                | "dwell"
        )
    };
    let cause = cause(words, i);
    let of_height = back(words, i, 3).any(|word| matches!(word, "altitude" | "height" | "alt"));
    let is_list =
        cause == "stay" && time_before(words, i, 12) || matches!(cause, "hold" | "wait") && time_before(words, i, 12);
    if is_list && !of_height {
        return true;
    }
    // `orbit for 60` is an angle.
    let is_figure = word_at(words, i).starts_with(|c: char| c.is_ascii_digit());
    let is_angle = is_figure && bare_number(words, i).is_some_and(|(_, value)| value > 40.0);
    let for_digits = cause == "for" && !is_angle && word_at(words, i).starts_with(|c: char| c.is_ascii_digit());
    let moves_in = matches!(
        word_before(words, i, 2),
        "zoom" | "push" | "dolly" | "move" | "come" | "go" | "punch" | "crash" | "and" | "cut"
    );
    let arrives = cause == "in" && is_figure && !moves_in && matches!(word_at(words, end), "" | "." | "!" | "/");
    arrives
        || ends_phrase(words, end)
            && !of_height
            && (holds(cause) && cause != "static" && cause != "stop"
                || for_digits
                || cause == "for"
                    && !is_angle
                    && (sentence_back(words, i, 12).any(holds) || time_before(words, i, LOOK_BACK)))
}

/// A number in a list of times: `first 10`, `in two`, `4 on the pots`, `of 15`.
fn is_time_after_another(words: &[Word], i: usize, end: usize, secs: f64) -> bool {
    let cause = cause(words, i);
    let next = word_at(words, end);
    let is_share = matches!(cause, "first" | "last" | "next" | "remaining" | "final");
    let of_rest = cause == "of" && back(words, i, 6).any(|word| matches!(word, "left" | "rest" | "remainder" | "out"));
    let goes_on = begins_clause(words, i) || matches!(cause, "then" | "and");
    let is_clause = goes_on
        && secs <= 15.0
        && (next.len() > 4 && next.ends_with("ing")
            || matches!(
                next,
                "on" | "in"
                    | "to"
                    | "back"
                    | "hold"
                    | "holding"
                    | "still"
                    | "static"
                    | "for"
                    | "toward"
                    | "towards"
                    | "around"
                    | "of"
                    | "at"
                    | "out"
                    | "more"
            ));
    let is_second_thought = match word_before(words, i, 1) {
        "maybe" | "or" => time_before(words, i, 8) && ends_phrase(words, end),
        "full" => ends_phrase(words, end),
        // `3 seconds, no, make it five`
        "it" => matches!(word_before(words, i, 2), "make" | "call" | "say") && ends_phrase(words, end),
        _ => false,
    };
    let is_summand = next == "+" || word_before(words, i, 1) == "+";
    is_share && word_at(words, i) != "one"
        || is_second_thought
        || is_summand
        || matches!(next, "each" | "apiece")
        || of_rest
        || is_clause
        || matches!(cause, "in" | "after" | "takes" | "over") && ends_phrase(words, end)
        || matches!([next, word_at(words, end + 1)], ["of", "those" | "them" | "which"])
}

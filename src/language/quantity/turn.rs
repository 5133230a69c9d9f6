//! Angles as multiples of a turn, with its noun: `a quarter turn`, `full circle`, `2 laps`.

use super::context::word_before;
use super::kind::{Found, QuantityKind, found};
use super::unit::number_at;
use crate::numerals::{Numeral, NumeralForm, cardinal_at};
use crate::tokenizer::{Word, word_at};

/// A multiple of a turn.
pub(super) fn turn_at(words: &[Word], i: usize) -> Option<Found> {
    whole_turn_at(words, i).or_else(|| turns_at(words, i))
}

/// A number of turns in degrees, stated by `len` words.
pub(super) fn degrees(len: usize, turns: f64) -> Found {
    found(len, QuantityKind::Degrees, turns * 360.0)
}

/// Whether word `i` is `around`.
pub(super) fn is_around(words: &[Word], i: usize) -> bool {
    matches!(word_at(words, i), "around" | "round")
}

fn is_turn(word: &str) -> bool {
    matches!(
        word,
        "turn"
            | "turns"
            | "circle"
            | "circles"
            | "revolution"
            | "revolutions"
            | "rotation"
            | "rotations"
            | "orbit"
            | "orbits"
            | "lap"
            | "laps"
            | "loop"
            | "loops"
            | "spin"
            | "spins"
            | "round"
            | "rounds"
            | "circuit"
            | "circuits"
            | "rev"
            | "revs"
    )
}

/// Whether `a` before the noun means one whole turn: `a lap`, no `an orbit`.
fn is_counted_turn(word: &str) -> bool {
    matches!(word, "lap" | "loop" | "revolution" | "circuit")
}

/// `full circle` and `whole turn` without an article, `semicircle`, `lap around`, `first lap`.
fn whole_turn_at(words: &[Word], i: usize) -> Option<Found> {
    match (word_at(words, i), word_at(words, i + 1)) {
        ("semicircle", _) => Some(degrees(1, 0.5)),
        ("semi", "circle") | ("a", "semicircle") => Some(degrees(2, 0.5)),
        ("whole" | "entire", _) if word_before(words, i, 1) == "the" => None,
        ("full" | "complete" | "whole" | "entire", turn) if is_turn(turn) => {
            let (more, turns) = and_more(words, i + 2);
            Some(degrees(2 + more, 1.0 + turns))
        }
        ("full", "way" | "ways") if is_around(words, i + 2) => Some(degrees(3, 1.0)),
        ("barrel", "roll" | "rolls") => Some(degrees(1, 1.0)),
        ("lap", "around" | "round" | "of") if word_before(words, i, 1) != "a" => Some(degrees(1, 1.0)),
        ("turn", "entire" | "complete") | ("first" | "second" | "last" | "another", "lap") => Some(degrees(2, 1.0)),
        _ => None,
    }
}

/// A numeral with a noun of turning: `two full turns`, `a turn and a half`, `one big loop`.
fn turns_at(words: &[Word], i: usize) -> Option<Found> {
    let number = number_at(words, i)?;
    let number = range_end(words, i, number);
    let noun = i + number.len;
    let adjective = word_at(words, noun);
    let is_whole = matches!(adjective, "full" | "whole" | "complete" | "entire");
    let is_other = matches!(
        adjective,
        "big" | "small" | "slow" | "quick" | "wide" | "tight" | "single" | "smooth" | "clean" | "fast" | "more"
    );
    let noun = noun + usize::from(is_whole || is_other);
    let turn = word_at(words, noun);
    // `a quarter roll`: the move is another, the angle is the same.
    if number.form == NumeralForm::Fraction
        && matches!(turn, "roll" | "pan" | "arc" | "flip" | "barrel")
        && number.value < 1.0
    {
        return Some(degrees(number.len, number.value));
    }
    // `one full barrel roll`: the noun stays a word.
    if turn == "barrel" && word_at(words, noun + 1).starts_with("roll") {
        return Some(degrees(noun + 1 - i, number.value));
    }
    let is_turn = is_turn(turn) || matches!(turn, "sweep" | "sweeps") && (is_whole || number.value > 1.0);
    if !is_turn || number.value >= 15.0 {
        return None;
    }
    let (more, turns) = match word_at(words, noun + 1) {
        "complete" | "entire" if is_article(number) => (1, 0.0),
        _ => and_more(words, noun + 1),
    };
    // `do a lap around it` is the verb of an orbit without an angle.
    let is_verb = matches!(
        word_before(words, i, 1),
        "do" | "does" | "doing" | "make" | "makes" | "making" | "take" | "run" | "running"
    );
    if is_article(number)
        && is_verb
        && noun == i + 1
        && more == 0
        && matches!(word_at(words, noun + 1), "around" | "round" | "of")
    {
        return None;
    }
    let counts = !is_article(number) || is_whole || is_counted_turn(turn) || more > 0;
    counts.then(|| degrees(noun + 1 + more - i, number.value + turns))
}

fn is_article(number: Numeral) -> bool {
    number.form == NumeralForm::Article
}

/// `2 to 3 turns` and `one or two laps` as their mean.
fn range_end(words: &[Word], i: usize, first: Numeral) -> Numeral {
    let next = i + first.len;
    let link = usize::from(matches!(word_at(words, next), "to" | "or"));
    match cardinal_at(words, next + link) {
        Some((len, value))
            if link == 1 && first.form == NumeralForm::Number && is_turn(word_at(words, next + 1 + len)) =>
        {
            Numeral { len: first.len + 1 + len, value: f64::midpoint(first.value, value), form: first.form }
        }
        _ => first,
    }
}

/// `and a half`, `and a bit` after a turn: number of words, turns.
fn and_more(words: &[Word], i: usize) -> (usize, f64) {
    match [0, 1, 2].map(|k| word_at(words, i + k)) {
        ["and", "half", _] => (2, 0.5),
        ["and", "a", "half"] => (3, 0.5),
        ["and", "a", "quarter"] => (3, 0.25),
        ["and", "a", "bit"] => (3, 0.0),
        _ => (0, 0.0),
    }
}

//! Angles as parts and multiples of a way around something: `once around`, `circle it twice`, `to the other side`.

use super::context::{clause_back, sentence_back, word_before};
use super::kind::Found;
use super::turn::{degrees, is_around};
use super::unit::number_at;
use crate::numerals::{NumeralForm, numeral_at};
use crate::tokenizer::{Word, word_at};

/// A part or a multiple of a way around something.
pub(super) fn way_around_at(words: &[Word], i: usize) -> Option<Found> {
    around_at(words, i).or_else(|| times_at(words, i)).or_else(|| part_at(words, i))
}

/// `once around`, `circle it once`, `halfway around`.
fn around_at(words: &[Word], i: usize) -> Option<Found> {
    match word_at(words, i) {
        "once" if is_around(words, i + 1) || circles_before(words, i) || turns_just_before(words, i) => {
            Some(degrees(1, 1.0))
        }
        "twice" if is_around(words, i + 1) || circles_before(words, i) || turns_just_before(words, i) => {
            Some(degrees(1, 2.0))
        }
        "halfway" if is_around(words, i + 1) || circles_before(words, i) || orbits_before(words, i) => {
            Some(degrees(1, 0.5))
        }
        "to" if other_side(words, i + 1) && goes_around(words, i) => Some(degrees(4, 0.5)),
        "half" if word_at(words, i + 1) == "way" => {
            let is_turn = is_around(words, i + 2) || circles_before(words, i) || orbits_before(words, i);
            is_turn.then(|| degrees(2, 0.5))
        }
        _ => {
            let number = numeral_at(words, i).filter(|n| n.form == NumeralForm::Fraction && n.value < 1.0)?;
            // The numeral already includes `of the` of `a third of the`.
            let of = usize::from(word_at(words, i + number.len) == "of");
            let the = of + usize::from(word_at(words, i + number.len + of) == "the");
            let way = i + number.len + the;
            let is_part = word_at(words, way) == "way"
                && (is_around(words, way + 1) || orbits_before(words, i) || goes_round_before(words, i, way + 1));
            is_part.then(|| degrees(number.len + the + 1, number.value))
        }
    }
}

/// `circle it three times`, `one and a half times round`, `spin one time`.
fn times_at(words: &[Word], i: usize) -> Option<Found> {
    let number = number_at(words, i).filter(|n| n.form != NumeralForm::Article && n.value < 15.0)?;
    let times = i + number.len;
    if word_at(words, times) == "more" && is_around(words, times + 1) {
        return Some(degrees(number.len + 1, number.value));
    }
    if !matches!(word_at(words, times), "times" | "time" | "x") {
        return None;
    }
    let is_turn = is_around(words, times + 1) || circles_before(words, times) || turns_just_before(words, i);
    is_turn.then(|| degrees(number.len + 1, number.value))
}

/// A part of a turn without a noun: `circle it one third`, `spin a quarter about it`.
fn part_at(words: &[Word], i: usize) -> Option<Found> {
    let number = numeral_at(words, i).filter(|n| n.form == NumeralForm::Fraction && n.value < 1.0)?;
    let end = i + number.len;
    let ends = matches!(
        word_at(words, end),
        "" | "." | "," | ";" | "then" | "and" | "about" | "on" | "around" | "round" | "clockwise" | "counter"
    );
    let after_comma = word_before(words, i, 1) == "," && sentence_back(words, i, 10).any(is_circling);
    let turns = turns_just_before(words, i) || circles_in_clause(words, i) || after_comma;
    let to_side =
        matches!([0, 1, 2].map(|k| word_at(words, end + k)), ["to", "the", "left" | "right"] | ["left" | "right", ..]);
    let ends = ends || to_side;
    let by_part = word_before(words, i, 1) == "by" && !orbits_before(words, i);
    let is_share = by_part || matches!(word_before(words, i, 1), "to" | "at" | "other" | "first" | "second");
    (ends && turns && !is_share).then(|| degrees(number.len, number.value))
}

/// Whether a verb of turning stands right before word `i`, with at most a direction between.
fn turns_just_before(words: &[Word], i: usize) -> bool {
    let mut rest = clause_back(words, i, 4).skip_while(|word| {
        matches!(
            *word,
            "round" | "around" | "left" | "right" | "it" | "camera" | "the" | "just" | "on" | "spot" | "about" | "up"
        )
    });
    rest.next().is_some_and(|word| {
        matches!(
            word,
            "turn"
                | "turns"
                | "turning"
                | "spinning"
                | "rotating"
                | "arc"
                | "spin"
                | "spins"
                | "rotate"
                | "rotates"
                | "twirl"
                | "twirls"
                | "circle"
                | "orbit"
                | "whirl"
                | "revolve"
                | "lap"
        )
    })
}

fn is_circling(word: &str) -> bool {
    matches!(word, "around" | "round") || ["circl", "orbit", "revolv", "loop"].iter().any(|stem| word.starts_with(stem))
}

/// Whether the clause before word `i` circles something.
fn circles_in_clause(words: &[Word], i: usize) -> bool {
    circles_within(words, i, 10)
}

/// Whether the clause circles something at most `num_words` before word `i`.
fn circles_within(words: &[Word], i: usize, num_words: usize) -> bool {
    clause_back(words, i, num_words).take_while(|word| *word != "and").any(is_circling)
}

/// Whether the clause before word `i` has the verb `orbit` or `circle`.
fn orbits_before(words: &[Word], i: usize) -> bool {
    clause_back(words, i, 10)
        .take_while(|word| *word != "and")
        .any(|word| matches!(word, "orbit" | "orbits" | "orbiting" | "circle"))
}

/// Whether the clause goes round something and no further than the part of the way that ends before word `end`: `go round
/// the cactus three quarters of the way,`.
fn goes_round_before(words: &[Word], i: usize, end: usize) -> bool {
    let ends = matches!(word_at(words, end), "" | "." | "," | ";" | "then" | "and" | "!" | ")");
    ends && circles_within(words, i, 8)
}

/// Whether the same sentence has a verb of circling within 10 words before word `i`, so that `once` counts turns.
fn circles_before(words: &[Word], i: usize) -> bool {
    let ends_here = matches!(
        word_at(words, i + 1),
        "" | "."
            | ","
            | ";"
            | "then"
            | "and"
            | "over"
            | "in"
            | "to"
            | "clockwise"
            | "counter"
            | "counterclockwise"
            | "slowly"
            | "anticlockwise"
            | "for"
            | "left"
            | "right"
            | "before"
            | "("
            | ")"
            | "taking"
            | "lasting"
            | "during"
            | "within"
            | "at"
            | "while"
            | "with"
            | "quickly"
            | "fast"
            | "cw"
            | "ccw"
            | "!"
            | "anti"
            | "n"
    );
    let mut clause = sentence_back(words, i, 10).take_while(|word| *word != "then").peekable();
    ends_here && clause.peek().is_some_and(|word| !matches!(*word, "," | "and")) && clause.any(is_circling)
}

/// `the other side`.
fn other_side(words: &[Word], i: usize) -> bool {
    word_at(words, i) == "the"
        && matches!(word_at(words, i + 1), "other" | "far" | "opposite")
        && matches!(word_at(words, i + 2), "side" | "end")
}

/// Whether the clause goes around something within 10 words before word `i`.
fn goes_around(words: &[Word], i: usize) -> bool {
    clause_back(words, i, 10)
        .any(|word| matches!(word, "around" | "round") || ["circl", "orbit", "arc"].iter().any(|s| word.starts_with(s)))
}

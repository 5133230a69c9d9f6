//! Angles without a unit: `tilt up 10`, `a 180`, `turn 90 right`, `a right angle`, `turn around`.

use super::belonging::belongs_elsewhere;
use super::context::{ends_phrase, word_before};
use super::kind::{Found, QuantityKind, found};
use super::topic::turns_before;
use crate::numerals::cardinal_at;
use crate::tokenizer::{Word, word_at};

/// Numbers that are angles without a unit or a verb of turning.
const PLAIN_DEGREES: [f64; 13] = [15.0, 30.0, 45.0, 60.0, 75.0, 90.0, 120.0, 135.0, 180.0, 270.0, 360.0, 540.0, 720.0];

/// An angle without a unit.
pub(super) fn bare_angle_at(words: &[Word], i: usize) -> Option<Found> {
    let degrees = |len, value| Some(found(len, QuantityKind::Degrees, value));
    match [0, 1, 2].map(|k| word_at(words, i + k)) {
        ["a", "right", "angle"] if word_before(words, i, 1) != "at" => return degrees(3, 90.0),
        ["u", "turn", _] => return degrees(2, 180.0),
        ["a", "u", "turn"] => return degrees(3, 180.0),
        ["behind", "you" | "us" | "me", _] if word_before(words, i, 1) == "look" => return degrees(2, 180.0),
        ["all", "the", "way"] if turns_on_the_spot(words, i) && is_round(words, i + 3) => return degrees(4, 360.0),
        ["around" | "round" | "about", ..] if turns_on_the_spot(words, i) && ends_turn(words, i + 1) => {
            return degrees(1, 180.0);
        }
        _ => {}
    }
    let (len, value) = cardinal_at(words, i)?;
    let is_figure = word_at(words, i).starts_with(|c: char| c.is_ascii_digit());
    let (len, value) = colloquial_at(words, i).unwrap_or((len, value));
    let is_angle = (is_figure || value >= 180.0) && PLAIN_DEGREES.contains(&value)
        || (5.0..=1080.0).contains(&value) && turns_before(words, i) && ends_angle(words, i + len);
    let tilts_to = word_before(words, i, 1) == "to" && turns_before(words, i - 1) && is_direction(words, i + len);
    let is_angle = is_angle || tilts_to && value <= 180.0;
    (is_angle && !belongs_elsewhere(words, i, i + len)).then(|| found(len, QuantityKind::Degrees, value))
}

/// `one eighty`, `three sixty`: the degrees of a turn as they are spoken.
fn colloquial_at(words: &[Word], i: usize) -> Option<(usize, f64)> {
    match [0, 1].map(|k| word_at(words, i + k)) {
        ["one", "eighty"] => Some((2, 180.0)),
        ["two", "seventy"] => Some((2, 270.0)),
        ["three", "sixty"] => Some((2, 360.0)),
        _ => None,
    }
}

fn is_round(words: &[Word], i: usize) -> bool {
    matches!(word_at(words, i), "around" | "round")
}

fn is_direction(words: &[Word], i: usize) -> bool {
    matches!(
        word_at(words, i),
        "left"
            | "right"
            | "up"
            | "down"
            | "cw"
            | "ccw"
            | "clockwise"
            | "counter"
            | "counterclockwise"
            | "anticlockwise"
    )
}

/// Whether a number before word `i` can be the angle of a turn.
fn ends_angle(words: &[Word], i: usize) -> bool {
    ends_phrase(words, i)
        || is_direction(words, i)
        || matches!(
            word_at(words, i),
            "the"
                | "at"
                | "with"
                | "for"
                | "around"
                | "round"
                | "about"
                | "on"
                | "to"
                | "in"
                | "more"
                | "over"
                | "toward"
                | "towards"
        )
}

/// Whether the word before word `i` turns the camera on its spot.
fn turns_on_the_spot(words: &[Word], i: usize) -> bool {
    matches!(word_before(words, i, 1), "turn" | "turns" | "turning") && word_before(words, i, 2) != "a"
}

/// Whether `turn around` before word `i` has no object.
fn ends_turn(words: &[Word], i: usize) -> bool {
    matches!(
        word_at(words, i),
        "" | "." | "," | ";" | "and" | "then" | "there" | "at" | "on" | "!" | "in" | "so" | "again"
    )
}

//! Factors on the distance or the focal length: `twice as close`, `halfway`, `2x`, `50% closer`, `double the distance`.

use super::context::{clause_back, ends_phrase, is_joined, word_before};
use super::kind::{Found, QuantityKind, found};
use crate::numerals::{Numeral, NumeralForm, cardinal_at, numeral_at};
use crate::tokenizer::{Word, word_at};

/// A factor on the distance or the focal length.
pub(super) fn factor_at(words: &[Word], i: usize) -> Option<Found> {
    let (len, value) = multiple_at(words, i)
        .or_else(|| part_of_way_at(words, i))
        .or_else(|| factor_of_at(words, i))
        .or_else(|| percent_more_at(words, i))
        .or_else(|| part_of_distance_at(words, i))?;
    Some(found(len, QuantityKind::Factor, value))
}

/// `a factor of 2`.
fn factor_of_at(words: &[Word], i: usize) -> Option<(usize, f64)> {
    let article = usize::from(word_at(words, i) == "a");
    if word_at(words, i + article) != "factor" || word_at(words, i + article + 1) != "of" {
        return None;
    }
    cardinal_at(words, i + article + 2).map(|(len, value)| (article + 2 + len, value))
}

/// `halfway`, `a third of the way`: the factor is the rest of the distance.
fn part_of_way_at(words: &[Word], i: usize) -> Option<(usize, f64)> {
    let is_turn = |j| matches!(word_at(words, j), "around" | "round") || circles_before(words, i);
    match (word_at(words, i), word_at(words, i + 1)) {
        ("halfway", _) if !is_turn(i + 1) => return Some((1, 0.5)),
        ("half", "way") if !is_turn(i + 2) => return Some((2, 0.5)),
        ("half", "the") if word_at(words, i + 2) == "way" && !is_turn(i + 3) => return Some((3, 0.5)),
        _ => {}
    }
    let number = fraction_at(words, i)?;
    let of = usize::from(word_at(words, i + number.len) == "of");
    let the = of + usize::from(word_at(words, i + number.len + of) == "the");
    let end = i + number.len + the;
    let is_way = word_at(words, end) == "way" && !matches!(word_at(words, end + 1), "around" | "round");
    is_way.then_some((number.len + the + 1, 1.0 - number.value))
}

/// `a third of the distance`, `halve the distance`, `closer by half`.
fn part_of_distance_at(words: &[Word], i: usize) -> Option<(usize, f64)> {
    let next = [0, 1, 2].map(|k| word_at(words, i + k));
    match next {
        ["halve", "the" | "your" | "our", "distance"] => return Some((3, 0.5)),
        ["a", "half", _] if is_nearer_by(words, i) && ends_phrase(words, i + 2) => return Some((2, 0.5)),
        ["half", "of", "now"] if word_before(words, i, 1) == "distance" => return Some((3, 0.5)),
        ["half", ..] if is_nearer_by(words, i) && ends_phrase(words, i + 1) => return Some((1, 0.5)),
        _ => {}
    }
    let number = fraction_at(words, i)?;
    let the = usize::from(matches!(word_at(words, i + number.len), "the" | "that"));
    (word_at(words, i + number.len + the) == "distance").then_some((number.len + the + 1, number.value))
}

/// Whether `closer by` or `by` after a verb of approach stands before word `i`.
fn is_nearer_by(words: &[Word], i: usize) -> bool {
    word_before(words, i, 1) == "by"
        && (matches!(word_before(words, i, 2), "closer" | "nearer" | "in" | "tighter" | "then")
            || clause_back(words, i, 4).any(|word| word == "distance"))
}

fn fraction_at(words: &[Word], i: usize) -> Option<Numeral> {
    numeral_at(words, i).filter(|n| n.form == NumeralForm::Fraction && n.value < 1.0)
}

/// `50% closer`, `10 percent bigger`, `zoom in 30%`.
fn percent_more_at(words: &[Word], i: usize) -> Option<(usize, f64)> {
    let (len, value) = cardinal_at(words, i).filter(|(_, value)| *value > 0.0)?;
    let sign = match [0, 1].map(|k| word_at(words, i + len + k)) {
        ["%" | "percent" | "pct", _] => 1,
        ["per", "cent"] => 2,
        _ => return None,
    };
    let end = i + len + sign;
    let share = value / 100.0;
    let zooms = zooms_before(words, i);
    let (more, factor) = match [0, 1, 2].map(|k| word_at(words, end + k)) {
        ["closer" | "nearer", ..] => (1, 1.0 - share),
        ["further" | "farther", "away" | "back" | "out", _] => (2, 1.0 + share),
        ["further" | "farther", ..] => (1, 1.0 + share),
        ["of", "the", "distance"] => (3, share),
        ["bigger" | "larger" | "tighter", ..] if zooms => (1, 1.0 + share),
        ["bigger" | "larger" | "tighter", ..] => (1, 1.0 / (1.0 + share)),
        ["smaller", ..] if zooms && share < 1.0 => (1, 1.0 - share),
        ["smaller", ..] if share < 1.0 => (1, 1.0 / (1.0 - share)),
        _ => match [word_before(words, i, 1), word_before(words, i, 2)] {
            ["in", "zoom" | "zooms" | "zooming"] | ["zoom", _] => (0, if share > 1.0 { share } else { 1.0 + share }),
            ["in", "jump" | "push" | "dolly" | "punch" | "move" | "go" | "come"]
            | ["out", "zoom" | "zooms" | "zooming"]
                if share < 1.0 =>
            {
                (0, 1.0 - share)
            }
            _ => return None,
        },
    };
    Some((len + sign + more, factor))
}

/// `twice as close`, `half the distance`, `three times as far`, `2x`, `x2`.
fn multiple_at(words: &[Word], i: usize) -> Option<(usize, f64)> {
    let (len, times) = times_at(words, i)?;
    let rest = [0, 1, 2].map(|k| word_at(words, i + len + k));
    let larger = if zooms_before(words, i) { times } else { 1.0 / times };
    let (more, value) = match rest {
        ["as", "far", "away" | "back" | "out"] => (3, times),
        ["the" | "that" | "this", "distance", _]
        | ["as", "far", _]
        | ["farther" | "further", "away" | "back" | "out", _] => (2, times),
        ["farther" | "further" | "distance", _, _] => (1, times),
        ["as", "close" | "near", _] => (2, 1.0 / times),
        ["closer" | "nearer", _, _] => (1, 1.0 / times),
        ["as", "big" | "large", "as"] if !is_current(word_at(words, i + len + 3)) => return None,
        ["as" | "more", "big" | "large", _] | ["the" | "its", "size", _] => (2, larger),
        ["bigger" | "larger", _, _] => (1, larger),
        ["speed" | "faster" | "slower" | "as", ..] => return None,
        _ if is_bare_multiple(words, i, len) => (0, times),
        _ => return None,
    };
    Some((len + more, value))
}

/// Whether a comparison is with the present size: `twice as big as now`.
fn is_current(word: &str) -> bool {
    matches!(word, "now" | "before" | "it" | "currently" | "this")
}

/// Whether `2x`, `x2`, or `3 times` after a zoom stands alone.
fn is_bare_multiple(words: &[Word], i: usize, len: usize) -> bool {
    let last = word_at(words, i + len - 1);
    last == "x"
        || word_at(words, i) == "x"
        || last == "times"
            && zooms_before(words, i)
            && (ends_phrase(words, i + len) || word_before(words, i, 1).starts_with("zoom"))
}

/// `half`, `twice`, `double`, `triple`, `3 times`, `3 x`, `x3`.
fn times_at(words: &[Word], i: usize) -> Option<(usize, f64)> {
    match word_at(words, i) {
        "half" if word_at(words, i + 1) == "of" => return Some((2, 0.5)),
        "half" => return Some((1, 0.5)),
        "twice" | "double" | "dbl" => return Some((1, 2.0)),
        "triple" => return Some((1, 3.0)),
        "x" if is_joined(words, i + 1) => return cardinal_at(words, i + 1).map(|(len, value)| (len + 1, value)),
        _ => {}
    }
    let (len, value) = cardinal_at(words, i)?;
    matches!(word_at(words, i + len), "times" | "x").then_some((len + 1, value)).filter(|_| value > 0.0)
}

/// Whether one of the 14 words before word `i` is about a zoom.
fn zooms_before(words: &[Word], i: usize) -> bool {
    let mut back = words.iter().take(i).rev().take(14);
    back.any(|word| word.text.starts_with("zoom") || word.text == "lens" || word.text.starts_with("punch"))
}

/// Whether the clause before word `i` circles something, so that `halfway` is an angle.
fn circles_before(words: &[Word], i: usize) -> bool {
    let is_circling =
        |word: &str| matches!(word, "around" | "round" | "orbit" | "orbits" | "circle" | "circles" | "circling");
    clause_back(words, i, 10).take_while(|word| *word != "and").any(is_circling)
}

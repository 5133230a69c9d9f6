//! Quantities of a sentence: times, angles, lengths, and factors on a distance or a lens.
//!
//! Defaults: a turn is 360 degrees, `around it to the other side` 180; `a couple` is 2, `a few` 3, a beat 1 s; lengths are in scene units taken as meters
//! (feet, inches and centimeters converted); `twice as close` is the factor 0.5 on the distance, `twice as far` 2; `twice
//! as big` 0.5 on the distance, or 2 on the lens when the sentence speaks of a zoom; `halfway` 0.5 on the distance.

use super::counting::{Count, Said, at, cardinal, count};
use super::words::Word;

/// What a number of the prompt counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum QuantityKind {
    /// A time.
    Seconds,
    /// An angle.
    Degrees,
    /// A length in scene units.
    Units,
    /// A factor: on the distance, or on the focal length for zooms.
    Factor,
}

/// A number of the prompt.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quantity {
    /// What it counts.
    pub kind: QuantityKind,
    /// How much.
    pub value: f64,
}

const HEDGES: [&str; 10] =
    ["about", "around", "roughly", "approximately", "approx", "some", "nearly", "almost", "exactly", "circa"];
const BARE_ANGLES: [f64; 12] = [15.0, 30.0, 45.0, 60.0, 75.0, 90.0, 120.0, 135.0, 180.0, 270.0, 360.0, 720.0];

/// The quantity that begins at word `i`, with the number of words it takes.
pub(crate) fn quantity_at(words: &[Word], i: usize) -> Option<(usize, Quantity)> {
    let hedge = usize::from(HEDGES.contains(&at(words, i)));
    let start = i + hedge;
    // `around once`, `some` and the like are no hedges: what they hedge has to be a number.
    let found = factor(words, start).or_else(|| around(words, start)).or_else(|| measured(words, start))?;
    let (len, quantity) = found;
    let hedged_article =
        hedge == 1 && matches!(at(words, i), "around" | "some") && quantity.kind == QuantityKind::Factor;
    (quantity.value > 0.0 && !hedged_article).then_some((len + hedge, quantity))
}

fn of(kind: QuantityKind, value: f64) -> Quantity {
    Quantity { kind, value }
}

/// A count with its unit: `2.5 s`, `a full circle`, `45 degrees`.
fn measured(words: &[Word], i: usize) -> Option<(usize, Quantity)> {
    if let Some(found) = whole_turn(words, i) {
        return Some(found);
    }
    let number = ranged(words, i, count(words, i)?);
    let unit_idx = i + number.len;
    if number.said == Said::Number && number.value >= 15.0 && is_turn(at(words, unit_idx)) {
        return bare_angle(words, i, number);
    }
    let whole = usize::from(matches!(at(words, unit_idx), "full" | "whole" | "complete" | "entire"));
    if is_turn(at(words, unit_idx + whole)) && (number.said != Said::Article || whole == 1) {
        return Some((number.len + whole + 1, of(QuantityKind::Degrees, number.value * 360.0)));
    }
    let Some((kind, scale)) = unit(at(words, unit_idx + whole)) else { return bare_angle(words, i, number) };
    let second_is_ordinal =
        number.said == Said::Article && at(words, unit_idx) == "second" && !speaks_of_time(words, i, unit_idx + 1);
    (!second_is_ordinal).then_some((number.len + whole + 1, of(kind, number.value * scale)))
}

/// `5 to 6` and `5 - 6` before a unit: their mean.
fn ranged(words: &[Word], i: usize, first: Count) -> Count {
    if first.said != Said::Number {
        return first;
    }
    let next = i + first.len;
    let link = usize::from(matches!(at(words, next), "to" | "or" | ","));
    let Some((len, value)) = cardinal(words, next + link) else { return first };
    let ends_in_unit = unit(at(words, next + link + len)).is_some();
    if ends_in_unit && at(words, next) != "," {
        return Count { len: first.len + link + len, value: f64::midpoint(first.value, value), said: Said::Number };
    }
    first
}

fn unit(word: &str) -> Option<(QuantityKind, f64)> {
    Some(match word {
        "s" | "sec" | "secs" | "second" | "seconds" | "beat" | "beats" => (QuantityKind::Seconds, 1.0),
        "min" | "mins" | "minute" | "minutes" => (QuantityKind::Seconds, 60.0),
        "degree" | "degrees" | "deg" | "degs" | "\u{B0}" => (QuantityKind::Degrees, 1.0),
        "m" | "meter" | "meters" | "metre" | "metres" | "unit" | "units" => (QuantityKind::Units, 1.0),
        "cm" | "centimeter" | "centimeters" | "centimetre" | "centimetres" => (QuantityKind::Units, 0.01),
        "ft" | "foot" | "feet" => (QuantityKind::Units, 0.3048),
        "inch" | "inches" => (QuantityKind::Units, 0.0254),
        "yard" | "yards" => (QuantityKind::Units, 0.9144),
        _ => return None,
    })
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
            | "round"
    )
}

/// `full circle`, `whole turn` without an article, `semicircle`.
fn whole_turn(words: &[Word], i: usize) -> Option<(usize, Quantity)> {
    match (at(words, i), at(words, i + 1)) {
        ("semicircle", _) => Some((1, of(QuantityKind::Degrees, 180.0))),
        ("semi", "circle") | ("a", "semicircle") => Some((2, of(QuantityKind::Degrees, 180.0))),
        ("full" | "complete" | "whole" | "entire", turn) if is_turn(turn) => {
            Some((2, of(QuantityKind::Degrees, 360.0)))
        }
        _ => None,
    }
}

/// `360` and other round angles without a unit.
fn bare_angle(words: &[Word], i: usize, number: Count) -> Option<(usize, Quantity)> {
    let after = at(words, i + number.len);
    let other_unit = matches!(after, "mm" | "k" | "p" | "fps" | "x" | "frames" | "frame" | "percent" | "%" | "/");
    let figure = at(words, i).starts_with(|c: char| c.is_ascii_digit());
    (number.said == Said::Number && figure && !other_unit && BARE_ANGLES.contains(&number.value))
        .then_some((number.len, of(QuantityKind::Degrees, number.value)))
}

/// Whether `a second` before word `next` is a time and not the next of several.
fn speaks_of_time(words: &[Word], i: usize, next: usize) -> bool {
    let before = i.checked_sub(1).map_or("", |p| at(words, p));
    matches!(
        before,
        "for"
            | "hold"
            | "over"
            | "pause"
            | "wait"
            | "about"
            | "lasting"
            | "takes"
            | "taking"
            | "within"
            | "stay"
            | "linger"
            | "rest"
            | "holding"
            | "pausing"
            | "just"
            | "holds"
            | "pauses"
            | "around"
            | "there"
            | "still"
    ) || matches!(
        at(words, next),
        "" | "." | "," | ";" | "then" | "and" | "before" | "while" | ")" | "hold" | "pause" | "or"
    )
}

/// `once around`, `circle it once`, `halfway around`.
fn around(words: &[Word], i: usize) -> Option<(usize, Quantity)> {
    let degrees = |len, value| Some((len, of(QuantityKind::Degrees, value)));
    let next_is_around = |j| matches!(at(words, j), "around" | "round");
    match at(words, i) {
        "once" if next_is_around(i + 1) || circles_before(words, i) => degrees(1, 360.0),
        "twice" if next_is_around(i + 1) || circles_before(words, i) => degrees(1, 720.0),
        "halfway" if next_is_around(i + 1) || circles_before(words, i) => degrees(1, 180.0),
        "to" if other_side(words, i + 1) && goes_around(words, i) => degrees(4, 180.0),
        "half" if at(words, i + 1) == "way" && (next_is_around(i + 2) || circles_before(words, i)) => degrees(2, 180.0),
        _ => {
            let number = count(words, i).filter(|n| n.said == Said::Fraction && n.value < 1.0)?;
            // `a third of the` was taken with the number.
            let way = usize::from(at(words, i + number.len) == "the");
            let whole = at(words, i + number.len + way) == "way" && next_is_around(i + number.len + way + 1);
            if whole { degrees(number.len + way + 1, number.value * 360.0) } else { None }
        }
    }
}

/// Whether a verb of circling stands shortly before, so that `once` counts turns.
fn circles_before(words: &[Word], i: usize) -> bool {
    let after = at(words, i + 1);
    let ends_here = matches!(
        after,
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
    );
    let mut back = words.iter().take(i).rev().take(10).map(|word| word.text.as_str());
    let clause = back.by_ref().take_while(|word| !matches!(*word, "." | ";" | "then"));
    let mut clause = clause.peekable();
    ends_here
        && clause.peek().is_some_and(|word| !matches!(*word, "," | "and"))
        && clause.any(|word| {
            matches!(word, "around" | "round")
                || ["circl", "orbit", "revolv", "loop"].iter().any(|stem| word.starts_with(stem))
        })
}

/// `the other side`.
fn other_side(words: &[Word], i: usize) -> bool {
    at(words, i) == "the"
        && matches!(at(words, i + 1), "other" | "far" | "opposite")
        && matches!(at(words, i + 2), "side" | "end")
}

/// Whether the clause before word `i` speaks of going around something.
fn goes_around(words: &[Word], i: usize) -> bool {
    let back = words.iter().take(i).rev().take(10).map(|word| word.text.as_str());
    let mut clause = back.take_while(|word| !matches!(*word, "." | ";" | "," | "then"));
    clause
        .any(|word| matches!(word, "around" | "round") || ["circl", "orbit", "arc"].iter().any(|s| word.starts_with(s)))
}

/// Factors on the distance or the lens.
fn factor(words: &[Word], i: usize) -> Option<(usize, Quantity)> {
    let (len, value) = multiple(words, i).or_else(|| way(words, i)).or_else(|| factor_of(words, i))?;
    Some((len, of(QuantityKind::Factor, value)))
}

/// `a factor of 2`.
fn factor_of(words: &[Word], i: usize) -> Option<(usize, f64)> {
    let article = usize::from(at(words, i) == "a");
    if at(words, i + article) != "factor" || at(words, i + article + 1) != "of" {
        return None;
    }
    cardinal(words, i + article + 2).map(|(len, value)| (article + 2 + len, value))
}

/// `halfway`, `a third of the way`: the rest of the distance remains.
fn way(words: &[Word], i: usize) -> Option<(usize, f64)> {
    let around_follows = |j| matches!(at(words, j), "around" | "round");
    match (at(words, i), at(words, i + 1)) {
        ("halfway", next) if next != "around" && next != "round" && !circles_before(words, i) => return Some((1, 0.5)),
        ("half", "way") if !around_follows(i + 2) && !circles_before(words, i) => return Some((2, 0.5)),
        ("half", "the") if at(words, i + 2) == "way" && !around_follows(i + 3) => return Some((3, 0.5)),
        _ => {}
    }
    let number = count(words, i).filter(|n| n.said == Said::Fraction && n.value < 1.0)?;
    let the = usize::from(at(words, i + number.len) == "the");
    let end = i + number.len + the;
    (at(words, end) == "way" && !around_follows(end + 1)).then_some((number.len + the + 1, 1.0 - number.value))
}

/// `twice as close`, `half the distance`, `three times as far`, `2x`.
fn multiple(words: &[Word], i: usize) -> Option<(usize, f64)> {
    let (len, times) = times(words, i)?;
    let rest = [0, 1, 2].map(|k| at(words, i + len + k));
    let larger = if zooms_before(words, i) { times } else { 1.0 / times };
    let (more, value) = match rest {
        ["as", "far", "away"] => (3, times),
        ["the", "distance", _] | ["as", "far", _] | ["farther" | "further", "away", _] => (2, times),
        ["farther" | "further", _, _] => (1, times),
        ["as", "close" | "near", _] => (2, 1.0 / times),
        ["closer" | "nearer", _, _] => (1, 1.0 / times),
        ["as", "big" | "large", _] | ["the" | "its", "size", _] => (2, larger),
        ["bigger" | "larger", _, _] => (1, larger),
        _ if at(words, i + len - 1) == "x" => (0, times),
        _ => return None,
    };
    Some((len + more, value))
}

/// `half`, `twice`, `double`, `3 times`, `3 x`, `a factor of 3`.
fn times(words: &[Word], i: usize) -> Option<(usize, f64)> {
    match at(words, i) {
        "half" if at(words, i + 1) == "of" => return Some((2, 0.5)),
        "half" => return Some((1, 0.5)),
        "twice" | "double" => return Some((1, 2.0)),
        "triple" => return Some((1, 3.0)),
        _ => {}
    }
    let (len, value) = cardinal(words, i)?;
    matches!(at(words, i + len), "times" | "x").then_some((len + 1, value)).filter(|_| value > 0.0)
}

fn zooms_before(words: &[Word], i: usize) -> bool {
    let mut back = words.iter().take(i).rev().take(14);
    back.any(|word| word.text.starts_with("zoom") || word.text == "lens" || word.text.starts_with("punch"))
}

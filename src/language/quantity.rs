//! Quantities of a prompt: times, angles, lengths, and factors on a distance or a focal length.
//!
//! Enters: words. Leaves: a value with its kind. A turn is 360 degrees, `around it to the other side` 180. `a couple` is
//! 2, `a few` 3, a beat 1 s. Lengths are in scene units, taken as meters; feet, inches, yards and centimeters are
//! converted. `twice as close` is the factor 0.5 on the distance, `twice as far` 2, `halfway` 0.5. `twice as big` is 0.5
//! on the distance, or 2 on the focal length in a sentence about a zoom.

use super::numerals::{Numeral, NumeralForm, cardinal_at, numeral_at};
use super::tokenizer::{Word, word_at};

/// Dimension of a quantity.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum QuantityKind {
    /// A time, in seconds.
    Seconds,
    /// An angle, in degrees.
    Degrees,
    /// A length in scene units.
    Units,
    /// A factor on the distance to the subject, or on the focal length for zooms.
    Factor,
}

/// A quantity that a prompt states.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quantity {
    /// Its dimension.
    pub kind: QuantityKind,
    /// Its value in the unit of `kind`, above 0 and finite.
    pub value: f64,
}

/// Words of approximation before a quantity.
const HEDGES: [&str; 10] =
    ["about", "around", "roughly", "approximately", "approx", "some", "nearly", "almost", "exactly", "circa"];
/// Numbers that are angles without a unit.
const BARE_ANGLES: [f64; 12] = [15.0, 30.0, 45.0, 60.0, 75.0, 90.0, 120.0, 135.0, 180.0, 270.0, 360.0, 720.0];

/// The quantity that begins at word `i`, with the number of words it takes.
pub(crate) fn quantity_at(words: &[Word], i: usize) -> Option<(usize, Quantity)> {
    let hedge = usize::from(HEDGES.contains(&word_at(words, i)));
    let start = i + hedge;
    let (len, quantity) =
        factor_at(words, start).or_else(|| around_at(words, start)).or_else(|| measure_at(words, start))?;
    // `around` and `some` before a factor are prepositions, not hedges.
    let is_preposition =
        hedge == 1 && matches!(word_at(words, i), "around" | "some") && quantity.kind == QuantityKind::Factor;
    (quantity.value > 0.0 && !is_preposition).then_some((len + hedge, quantity))
}

fn quantity(kind: QuantityKind, value: f64) -> Quantity {
    Quantity { kind, value }
}

/// A numeral with its unit: `2.5 s`, `a full circle`, `45 degrees`.
fn measure_at(words: &[Word], i: usize) -> Option<(usize, Quantity)> {
    if let Some(found) = whole_turn_at(words, i) {
        return Some(found);
    }
    let number = mean_of_range(words, i, numeral_at(words, i)?);
    let unit_idx = i + number.len;
    if number.form == NumeralForm::Number && number.value >= 15.0 && is_turn(word_at(words, unit_idx)) {
        return bare_angle_at(words, i, number);
    }
    let whole = usize::from(matches!(word_at(words, unit_idx), "full" | "whole" | "complete" | "entire"));
    if is_turn(word_at(words, unit_idx + whole)) && (number.form != NumeralForm::Article || whole == 1) {
        return Some((number.len + whole + 1, quantity(QuantityKind::Degrees, number.value * 360.0)));
    }
    let Some((kind, scale)) = unit(word_at(words, unit_idx + whole)) else { return bare_angle_at(words, i, number) };
    let second_is_ordinal = number.form == NumeralForm::Article
        && word_at(words, unit_idx) == "second"
        && !second_is_time(words, i, unit_idx + 1);
    (!second_is_ordinal).then_some((number.len + whole + 1, quantity(kind, number.value * scale)))
}

/// The mean of `5 to 6` or `5 - 6` before a unit; `first` itself where no range begins.
fn mean_of_range(words: &[Word], i: usize, first: Numeral) -> Numeral {
    if first.form != NumeralForm::Number {
        return first;
    }
    let next = i + first.len;
    let link = usize::from(matches!(word_at(words, next), "to" | "or" | ","));
    let Some((len, value)) = cardinal_at(words, next + link) else { return first };
    let ends_in_unit = unit(word_at(words, next + link + len)).is_some();
    if ends_in_unit && word_at(words, next) != "," {
        return Numeral {
            len: first.len + link + len,
            value: f64::midpoint(first.value, value),
            form: NumeralForm::Number,
        };
    }
    first
}

/// Kind and scale of a unit.
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

/// Whether word `i` is a number beyond those that are read: a million or more in digits, a thousand or more in words
/// before a unit.
pub(super) fn is_unread_number(words: &[Word], i: usize) -> bool {
    let word = word_at(words, i);
    let is_large = word.starts_with(|c: char| c.is_ascii_digit()) && word.parse::<f64>().is_ok_and(|v| v >= 1e6);
    let is_power = matches!(word, "thousand" | "million" | "billion" | "trillion");
    is_large || is_power && unit(word_at(words, i + 1)).is_some()
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

/// `full circle` and `whole turn` without an article, `semicircle`.
fn whole_turn_at(words: &[Word], i: usize) -> Option<(usize, Quantity)> {
    match (word_at(words, i), word_at(words, i + 1)) {
        ("semicircle", _) => Some((1, quantity(QuantityKind::Degrees, 180.0))),
        ("semi", "circle") | ("a", "semicircle") => Some((2, quantity(QuantityKind::Degrees, 180.0))),
        ("full" | "complete" | "whole" | "entire", turn) if is_turn(turn) => {
            Some((2, quantity(QuantityKind::Degrees, 360.0)))
        }
        _ => None,
    }
}

/// One of [`BARE_ANGLES`] in digits without a unit.
fn bare_angle_at(words: &[Word], i: usize, number: Numeral) -> Option<(usize, Quantity)> {
    let after = word_at(words, i + number.len);
    let other_unit = matches!(after, "mm" | "k" | "p" | "fps" | "x" | "frames" | "frame" | "percent" | "%" | "/");
    let figure = word_at(words, i).starts_with(|c: char| c.is_ascii_digit());
    (number.form == NumeralForm::Number && figure && !other_unit && BARE_ANGLES.contains(&number.value))
        .then_some((number.len, quantity(QuantityKind::Degrees, number.value)))
}

/// Whether `a second`, between word `i` and word `next`, is a time. Otherwise `second` is an ordinal.
fn second_is_time(words: &[Word], i: usize, next: usize) -> bool {
    let before = i.checked_sub(1).map_or("", |p| word_at(words, p));
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
        word_at(words, next),
        "" | "." | "," | ";" | "then" | "and" | "before" | "while" | ")" | "hold" | "pause" | "or"
    )
}

/// `once around`, `circle it once`, `halfway around`.
fn around_at(words: &[Word], i: usize) -> Option<(usize, Quantity)> {
    let degrees = |len, value| Some((len, quantity(QuantityKind::Degrees, value)));
    let next_is_around = |j| matches!(word_at(words, j), "around" | "round");
    match word_at(words, i) {
        "once" if next_is_around(i + 1) || circles_before(words, i) => degrees(1, 360.0),
        "twice" if next_is_around(i + 1) || circles_before(words, i) => degrees(1, 720.0),
        "halfway" if next_is_around(i + 1) || circles_before(words, i) => degrees(1, 180.0),
        "to" if other_side(words, i + 1) && goes_around(words, i) => degrees(4, 180.0),
        "half" if word_at(words, i + 1) == "way" && (next_is_around(i + 2) || circles_before(words, i)) => {
            degrees(2, 180.0)
        }
        _ => {
            let number = numeral_at(words, i).filter(|n| n.form == NumeralForm::Fraction && n.value < 1.0)?;
            // The numeral already includes `of the` of `a third of the`.
            let way = usize::from(word_at(words, i + number.len) == "the");
            let whole = word_at(words, i + number.len + way) == "way" && next_is_around(i + number.len + way + 1);
            if whole { degrees(number.len + way + 1, number.value * 360.0) } else { None }
        }
    }
}

/// Whether the same clause has a verb of circling within 10 words before word `i`, so that `once` counts turns.
fn circles_before(words: &[Word], i: usize) -> bool {
    let after = word_at(words, i + 1);
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
    word_at(words, i) == "the"
        && matches!(word_at(words, i + 1), "other" | "far" | "opposite")
        && matches!(word_at(words, i + 2), "side" | "end")
}

/// Whether the clause goes around something within 10 words before word `i`.
fn goes_around(words: &[Word], i: usize) -> bool {
    let back = words.iter().take(i).rev().take(10).map(|word| word.text.as_str());
    let mut clause = back.take_while(|word| !matches!(*word, "." | ";" | "," | "then"));
    clause
        .any(|word| matches!(word, "around" | "round") || ["circl", "orbit", "arc"].iter().any(|s| word.starts_with(s)))
}

/// A factor on the distance or the focal length.
fn factor_at(words: &[Word], i: usize) -> Option<(usize, Quantity)> {
    let (len, value) = multiple_at(words, i).or_else(|| part_of_way_at(words, i)).or_else(|| factor_of_at(words, i))?;
    Some((len, quantity(QuantityKind::Factor, value)))
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
    let around_follows = |j| matches!(word_at(words, j), "around" | "round");
    match (word_at(words, i), word_at(words, i + 1)) {
        ("halfway", next) if next != "around" && next != "round" && !circles_before(words, i) => return Some((1, 0.5)),
        ("half", "way") if !around_follows(i + 2) && !circles_before(words, i) => return Some((2, 0.5)),
        ("half", "the") if word_at(words, i + 2) == "way" && !around_follows(i + 3) => return Some((3, 0.5)),
        _ => {}
    }
    let number = numeral_at(words, i).filter(|n| n.form == NumeralForm::Fraction && n.value < 1.0)?;
    let the = usize::from(word_at(words, i + number.len) == "the");
    let end = i + number.len + the;
    (word_at(words, end) == "way" && !around_follows(end + 1)).then_some((number.len + the + 1, 1.0 - number.value))
}

/// `twice as close`, `half the distance`, `three times as far`, `2x`.
fn multiple_at(words: &[Word], i: usize) -> Option<(usize, f64)> {
    let (len, times) = times_at(words, i)?;
    let rest = [0, 1, 2].map(|k| word_at(words, i + len + k));
    let larger = if zooms_before(words, i) { times } else { 1.0 / times };
    let (more, value) = match rest {
        ["as", "far", "away"] => (3, times),
        ["the", "distance", _] | ["as", "far", _] | ["farther" | "further", "away", _] => (2, times),
        ["farther" | "further", _, _] => (1, times),
        ["as", "close" | "near", _] => (2, 1.0 / times),
        ["closer" | "nearer", _, _] => (1, 1.0 / times),
        ["as", "big" | "large", _] | ["the" | "its", "size", _] => (2, larger),
        ["bigger" | "larger", _, _] => (1, larger),
        _ if word_at(words, i + len - 1) == "x" => (0, times),
        _ => return None,
    };
    Some((len + more, value))
}

/// `half`, `twice`, `double`, `triple`, `3 times`, `3 x`.
fn times_at(words: &[Word], i: usize) -> Option<(usize, f64)> {
    match word_at(words, i) {
        "half" if word_at(words, i + 1) == "of" => return Some((2, 0.5)),
        "half" => return Some((1, 0.5)),
        "twice" | "double" => return Some((1, 2.0)),
        "triple" => return Some((1, 3.0)),
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

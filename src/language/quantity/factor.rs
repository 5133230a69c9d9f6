//! Factors on the distance or the focal length: `twice as close`, `halfway`, `2x`, `50% closer`, `double the distance`.

use super::context::{clause_back, ends_phrase, is_joined, word_before};
use super::kind::{Found, QuantityKind, found};
use crate::numerals::{Numeral, NumeralForm, cardinal_at, numeral_at};
use crate::tokenizer::{Word, is_listed, word_at};

/// A factor on the distance or the focal length.
pub(super) fn factor_at(words: &[Word], i: usize) -> Option<Found> {
    let (len, value) = multiple_at(words, i)
        .or_else(|| part_of_way_at(words, i))
        .or_else(|| factor_of_at(words, i))
        .or_else(|| half_again_at(words, i))
        .or_else(|| more_at(words, i))
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

/// Words for the way between the camera and a thing, and for that way as it is at first.
const DISTANCES: &str = "distance gap separation";
const AT_FIRST: &str = "what where original present current initial starting first";
/// Verbs that leave of a distance what they do not name: `close two thirds of the gap`.
const CLOSES: &str = "close closes closing cover covers covering cross crosses crossing eat eats eating lose travel travels \
    traveling travelling swallow";

/// `a third of the distance`, `halve the gap`, `close a third of the gap`, `the gap is a third of what it was`.
fn part_of_distance_at(words: &[Word], i: usize) -> Option<(usize, f64)> {
    let article = usize::from(matches!(word_at(words, i + 1), "the" | "your" | "our"));
    let is_distance = |at: usize| is_listed(DISTANCES, word_at(words, at));
    match word_at(words, i) {
        "halve" | "halves" | "halving" if is_distance(i + 1 + article) => return Some((2 + article, 0.5)),
        "half" if word_before(words, i, 1) == "distance" && word_at(words, i + 1) == "of" => {
            return (word_at(words, i + 2) == "now").then_some((3, 0.5));
        }
        _ => {}
    }
    let number = fraction_at(words, i)?;
    let end = i + number.len;
    let the = usize::from(matches!(word_at(words, end), "the" | "that" | "this" | "our" | "your"));
    if is_distance(end + the) {
        let is_closed = is_listed(CLOSES, word_before(words, i, 1));
        return Some((number.len + the + 1, if is_closed { 1.0 - number.value } else { number.value }));
    }
    let of = usize::from(word_at(words, end) == "of");
    let the = usize::from(word_at(words, end + of) == "the");
    let is_of_first =
        (word_before(words, end, 1) == "of" || of > 0) && is_listed(AT_FIRST, word_at(words, end + of + the));
    let is_about = clause_back(words, i, 8).any(|word| is_listed(DISTANCES, word));
    (is_of_first && is_about).then_some((number.len, number.value))
}

/// `back off by half again`, `half again as far`, `half as far again`: one and a half times.
fn half_again_at(words: &[Word], i: usize) -> Option<(usize, f64)> {
    let next = [0, 1, 2, 3].map(|k| word_at(words, i + k));
    let (len, what) = match next {
        ["half", "again", "as", "far" | "much"] => (4, next[3]),
        ["half", "as", "far" | "much", "again"] => (4, next[2]),
        ["half", "again", ..] => (2, ""),
        _ => return None,
    };
    let is_farther = what == "far" || clause_back(words, i, 8).any(|word| is_listed(RETREATS, word));
    is_farther.then_some((len, 1.5))
}

fn fraction_at(words: &[Word], i: usize) -> Option<Numeral> {
    numeral_at(words, i).filter(|n| n.form == NumeralForm::Fraction && n.value < 1.0)
}

/// Words of a way back.
const RETREATS: &str = "back away off out farther further retreat retreats retreating withdraw";

/// `50% closer`, `a third closer`, `10 percent bigger`, `zoom in 30%`, `closer by a third`.
fn more_at(words: &[Word], i: usize) -> Option<(usize, f64)> {
    let percent = percent_at(words, i);
    let fraction = || fraction_at(words, i).map(|number| (number.len, number.value));
    let (len, share) = percent.or_else(fraction)?;
    let end = i + len;
    let zooms = zooms_before(words, i);
    let (more, factor) = match [0, 1, 2].map(|k| word_at(words, end + k)) {
        ["closer" | "nearer", ..] => (1, 1.0 - share),
        ["further" | "farther", "away" | "back" | "out" | "off", _] => (2, 1.0 + share),
        ["further" | "farther", ..] => (1, 1.0 + share),
        ["of", "the", "distance"] if percent.is_some() => (3, share),
        ["bigger" | "larger" | "tighter", ..] if zooms => (1, 1.0 + share),
        ["bigger" | "larger" | "tighter", ..] => (1, 1.0 / (1.0 + share)),
        ["smaller", ..] if zooms && share < 1.0 => (1, 1.0 - share),
        ["smaller", ..] if share < 1.0 => (1, 1.0 / (1.0 - share)),
        _ if word_before(words, i, 1) == "by" => (0, changed_by(words, i, end, share)?),
        _ if percent.is_none() => return None,
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
    (factor > 0.0).then_some((len + more, factor))
}

/// A percentage: number of words, and the share.
fn percent_at(words: &[Word], i: usize) -> Option<(usize, f64)> {
    let (len, value) = cardinal_at(words, i).filter(|(_, value)| *value > 0.0)?;
    let sign = match [0, 1].map(|k| word_at(words, i + len + k)) {
        ["%" | "percent" | "pct", _] => 1,
        ["per", "cent"] => 2,
        _ => return None,
    };
    Some((len + sign, value / 100.0))
}

/// What is left of the distance where a clause says that it changes `by` a share of it: `closer by a third`, `cut the gap by half`.
fn changed_by(words: &[Word], i: usize, end: usize, share: f64) -> Option<f64> {
    let says = |list: &str| clause_back(words, i, 8).any(|word| is_listed(list, word));
    let is_distance = says(DISTANCES);
    if !ends_phrase(words, end) && !is_listed("on to toward towards", word_at(words, end)) {
        return None;
    }
    if zooms_before(words, i) && !is_distance {
        return if says("in") { Some(1.0 + share) } else { says("out").then_some(1.0 - share) };
    }
    let is_less =
        says("closer nearer in tighter") || is_distance && says("cut reduce shrink shorten decrease lessen close");
    let is_more =
        says("farther further back away off out") || is_distance && says("increase lengthen stretch grow widen");
    match (is_less, is_more) {
        (true, false) => Some(1.0 - share),
        (false, true) => Some(1.0 + share),
        // `Then by half`, `distance by half`.
        _ if word_before(words, i, 2) == "then" || is_distance => Some(1.0 - share),
        _ => None,
    }
}

/// `twice as close`, `half the distance`, `three times as far`, `2x`, `x2`.
fn multiple_at(words: &[Word], i: usize) -> Option<(usize, f64)> {
    let (len, times) = times_at(words, i)?;
    let rest = [0, 1, 2].map(|k| word_at(words, i + len + k));
    // `Half closer` is no multiple.
    if times < 1.0 && matches!(rest[0], "closer" | "nearer" | "farther" | "further" | "bigger" | "smaller") {
        return None;
    }
    let larger = if zooms_before(words, i) { times } else { 1.0 / times };
    let (more, value) = match rest {
        ["as", "far", "away" | "back" | "out"] => (3, times),
        ["the" | "that" | "this" | "your" | "our", "distance" | "gap", _]
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
        || last.ends_with("fold") && (zooms_before(words, i) || ends_phrase(words, i + len))
        || last == "times"
            && zooms_before(words, i)
            && (ends_phrase(words, i + len) || word_before(words, i, 1).starts_with("zoom"))
}

/// `half`, `twice`, `double`, `triple`, `3 times`, `3 x`, `x3`.
fn times_at(words: &[Word], i: usize) -> Option<(usize, f64)> {
    match word_at(words, i) {
        "half" if word_at(words, i + 1) == "of" => return Some((2, 0.5)),
        "half" => return Some((1, 0.5)),
        "twice" | "double" | "dbl" | "twofold" => return Some((1, 2.0)),
        "triple" | "threefold" | "thrice" => return Some((1, 3.0)),
        "quadruple" | "fourfold" => return Some((1, 4.0)),
        "fivefold" => return Some((1, 5.0)),
        "tenfold" => return Some((1, 10.0)),
        "x" if is_joined(words, i + 1) => return cardinal_at(words, i + 1).map(|(len, value)| (len + 1, value)),
        _ => {}
    }
    let (len, value) = cardinal_at(words, i)?;
    matches!(word_at(words, i + len), "times" | "x").then_some((len + 1, value)).filter(|_| value > 0.0)
}

/// Whether one of the 14 words before word `i` is about a zoom.
fn zooms_before(words: &[Word], i: usize) -> bool {
    let mut back = words.iter().take(i).rev().take(14);
    back.any(|word| word.text.starts_with("zoom") || word.text == "lens" || is_zoom(&word.text))
}

fn is_zoom(word: &str) -> bool {
    ["punch", "magnif", "enlarg"].iter().any(|verb| word.starts_with(verb))
}

/// Whether the clause before word `i` circles something, so that `halfway` is an angle.
fn circles_before(words: &[Word], i: usize) -> bool {
    let is_circling =
        |word: &str| matches!(word, "around" | "round" | "orbit" | "orbits" | "circle" | "circles" | "circling");
    clause_back(words, i, 10).take_while(|word| *word != "and").any(is_circling)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tokenizer::tokenize;

    /// The first factor of a text.
    fn factor(text: &str) -> String {
        let words = tokenize(text);
        let found = (0..words.len()).find_map(|i| factor_at(&words, i));
        found.map(|(_, quantity)| format!("{:.2}", quantity.value)).unwrap_or_default()
    }

    #[test]
    fn shares_of_a_distance_are_factors() {
        assert_eq!(factor("get a third closer to the ladles"), "0.67");
        assert_eq!(factor("go a quarter nearer"), "0.75");
        assert_eq!(factor("halve the gap to the vase"), "0.50");
        assert_eq!(factor("close two thirds of the distance"), "0.33");
        assert_eq!(factor("two thirds of the distance"), "0.67");
        assert_eq!(factor("back off by half again"), "1.50");
        assert_eq!(factor("half again as far away"), "1.50");
        assert_eq!(factor("come closer by a third"), "0.67");
        assert_eq!(factor("go a third further away"), "1.33");
        assert_eq!(factor("until the gap is a third of what it was"), "0.33");
        assert_eq!(factor("half closer"), "0.50");
        assert_eq!(factor("zoom in by a third on the vase"), "1.33");
        assert_eq!(factor("twice as close"), "0.50");
        assert_eq!(factor("magnify the vase threefold"), "3.00");
    }

    #[test]
    fn other_shares_are_none() {
        assert_eq!(factor("the left third of the frame"), "");
        assert_eq!(factor("stop half a metre closer"), "");
        assert_eq!(factor("the second half again"), "");
    }
}

//! Moves that go on to another thing: `pan right from the easel to the palm and continue to the skull`.

use cinesplat_language::{Linked, is_listed};
use cinesplat_operator::Step;
use cinesplat_trajectory::Move;

/// Words before what goes on, and what goes on.
const BEFORE: &str = "and then , ; to";
const GOES_ON: [&[&str]; 10] = [
    &["continue"],
    &["continues"],
    &["continuing"],
    &["carry", "on"],
    &["carries", "on"],
    &["carrying", "on"],
    &["keep", "going"],
    &["keeps", "going"],
    &["go", "on"],
    &["goes", "on"],
];
/// Words between it and the thing.
const WAYS: &str =
    "on onward onwards further farther down up left right over across along all the way in same direction";
const TO: &str = "to toward towards onto until till";

/// Makes a way to another thing the move before, where the words say that this one goes on.
pub(crate) fn go_on(linked: &Linked, steps: &mut [Step]) {
    for nth in 1..steps.len() {
        let before = &steps[nth - 1];
        let (movement, either_way) = (before.movement, before.either_way);
        let turns_or_slides = matches!(
            movement,
            Move::PanLeft
                | Move::PanRight
                | Move::TiltUp
                | Move::TiltDown
                | Move::TruckLeft
                | Move::TruckRight
                | Move::PedestalUp
                | Move::PedestalDown
        );
        let step = &mut steps[nth];
        let words = linked.texts_in(step.words.unwrap_or_default());
        let is_plain = step.via.is_none() && step.with.is_empty() && step.start.subjects.is_empty() && !step.cut;
        let is_way = matches!(step.movement, Move::Follow | Move::PushIn) && step.end.size.is_none();
        if turns_or_slides && is_plain && is_way && !step.end.subjects.is_empty() && goes_on(&words) {
            (step.movement, step.either_way) = (movement, either_way);
        }
    }
}

/// Whether words say that a move goes on to a thing.
fn goes_on(words: &[&str]) -> bool {
    let from = words.iter().take_while(|word| is_listed(BEFORE, word)).count();
    let Some(phrase) = GOES_ON.iter().find(|phrase| words[from..].starts_with(phrase)) else { return false };
    let rest = &words[from + phrase.len()..];
    let ways = rest.iter().take_while(|word| is_listed(WAYS, word)).count();
    rest.get(ways).is_some_and(|word| is_listed(TO, word))
}

#[cfg(test)]
mod tests {
    use super::super::fixture::{about, linked};
    use super::*;

    fn second(first: Move, text: &str) -> Move {
        let at = text.find(" and").unwrap();
        let mut steps = [about(first, &[5], [0, at]), about(Move::Follow, &[7], [at + 1, text.len()])];
        go_on(&linked(text), &mut steps);
        steps[1].movement
    }

    #[test]
    fn a_move_goes_on_to_another_thing() {
        assert_eq!(second(Move::PanRight, "pan right to <obj-0> and continue to <obj-1>"), Move::PanRight);
        assert_eq!(second(Move::TiltDown, "tilt down <obj-0> and carry on down to <obj-1>"), Move::TiltDown);
        assert_eq!(second(Move::PanRight, "pan right to <obj-0> and go to <obj-1>"), Move::Follow);
        assert_eq!(second(Move::PushIn, "push in on <obj-0> and continue to <obj-1>"), Move::Follow);
    }
}

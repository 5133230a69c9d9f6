//! Turns that the words make travels: `a metre to the left`, `pan right half a meter`, `to the left, pointing the same way all along`.
//!
//! No turn is as long as a meter, and who rules turns out asks for none.

use cinesplat_language::{Linked, QuantityKind, is_listed};
use cinesplat_operator::{Amount, Framing, Motion, Pass, Program, Step, Via};
use cinesplat_trajectory::Move;

use super::directions::is_form;

/// Words between a length and the side to which it leads.
const TO: &str = "to the towards toward over camera by about of";
/// Verbs of a turn on the spot.
const TURNS: [&str; 11] =
    ["pan", "turn", "look", "swing", "rotate", "pivot", "swivel", "whip", "tilt", "sweep", "glance"];
/// Words before such a verb that rule it out, and words between the two.
const BANS: &str = "no not without never zero 't dont nor don";
const BANNED: &str = "any a the or and , pan panning tilt tilting turn turning rotate rotating do it camera to";

/// Travels to the side where a turn is as long as a length, or where the film rules turns out and no verb asks for one.
pub(crate) fn travel_instead_of_turning(linked: &Linked, program: &mut Program) {
    let forbidden = program.forbidden.clone();
    for step in &mut program.steps {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let Some(travel) = travel_of(step.movement) else { continue };
        let is_banned = Motion::of(step.movement).is_some_and(|motion| forbidden.contains(&motion))
            || forbidden.contains(&Motion::Turn);
        let is_ruled_out = is_banned && !asks_for_turn(&words) && words.contains(&side(step.movement));
        let is_meant = step.start.subjects.is_empty() && (is_length(linked, step, &words) || is_ruled_out);
        if names_slide(&words, side(step.movement)) || is_meant {
            (step.movement, step.either_way) = (travel, false);
        }
    }
}

/// Whether the words name a travel to a side and no turn: `truck right until the plates are out of frame`.
fn names_slide(words: &[&str], side: &str) -> bool {
    let is_slide = |at: usize| {
        ["truck", "crab", "strafe"].iter().any(|verb| is_form(words[at], verb)) && words.get(at + 1) == Some(&side)
    };
    let turns = |word: &&str| TURNS.iter().any(|verb| is_form(word, verb));
    (0..words.len()).any(is_slide) && !words.iter().any(turns)
}

/// Goes along what the network begins a way in at where the words go along it: `move forward along the length of the table, keeping
/// the vase centered`.
pub(crate) fn go_along(linked: &Linked, steps: &mut [Step]) {
    for step in steps {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let is_open =
            step.via.is_none() && step.start == Framing { subjects: step.start.subjects.clone(), ..Framing::default() };
        let goes = matches!(step.movement, Move::PushIn | Move::Follow | Move::TruckLeft | Move::TruckRight) && is_open;
        let is_along = |at: usize| {
            let rest = words[at + 1..].iter().find(|word| !is_listed("the whole full length of side edge", word));
            words[at] == "along"
                && rest
                    .and_then(|word| linked.slot_at(word))
                    .is_some_and(|id| linked.expanded(&[id]) == step.start.subjects)
        };
        if goes && !step.start.subjects.is_empty() && (0..words.len()).any(is_along) {
            let objects = std::mem::take(&mut step.start.subjects);
            step.via = Some(Via { how: Pass::Along, objects });
        }
    }
}

/// Slides along what the words go along, past what they pass, to the thing behind `to`: `slide right along the sideboard past the books to
/// the candle`.
pub(crate) fn slide_along_to(linked: &Linked, steps: &mut [Step]) {
    for step in steps.iter_mut().filter(|step| matches!(step.movement, Move::TruckLeft | Move::TruckRight)) {
        // Where a step ends too soon, the words behind it say where to.
        let from = step.words.map_or(0, |[from, _]| from);
        let words = linked.texts_in([from, usize::MAX]);
        let thing = |at: usize| words.get(at).and_then(|word| linked.slot_at(word)).map(|id| linked.expanded(&[id]));
        let said = (0..words.len()).take_while(|at| !is_listed(". ; ! ? then", words[*at])).find_map(|at| {
            let along = thing(at + 1).filter(|_| words[at] == "along")?;
            let past = thing(at + 3).filter(|_| words[at + 2] == "past");
            let to = at + if past.is_some() { 4 } else { 2 };
            let end = thing(to + 1).filter(|_| words[to] == "to")?;
            Some((along, end))
        });
        let Some((along, end)) = said.filter(|(along, end)| along != end) else { continue };
        if step.end.subjects != end {
            step.end = Framing { subjects: end, ..Framing::default() };
        }
        if step.start.subjects == along {
            step.start = Framing::default();
        }
        step.via = Some(Via { how: Pass::Along, objects: along });
    }
}

/// The travel to the side to which a turn turns.
fn travel_of(turn: Move) -> Option<Move> {
    match turn {
        Move::PanLeft => Some(Move::TruckLeft),
        Move::PanRight => Some(Move::TruckRight),
        Move::TiltUp => Some(Move::PedestalUp),
        Move::TiltDown => Some(Move::PedestalDown),
        _ => None,
    }
}

fn side(turn: Move) -> &'static str {
    match turn {
        Move::PanLeft => "left",
        Move::PanRight => "right",
        Move::TiltUp => "up",
        _ => "down",
    }
}

/// Whether the extent of a step is a length that stands beside the side to which it leads.
fn is_length(linked: &Linked, step: &Step, words: &[&str]) -> bool {
    let Some(Amount::Units(units)) = step.amount else { return false };
    let side = side(step.movement);
    let is_own = |at: usize| {
        let quantity = linked.quantity_at(words[at]).filter(|quantity| quantity.kind == QuantityKind::Units);
        let behind = words[at + 1..].iter().find(|word| !is_listed(TO, word));
        let before = words[..at].iter().rev().find(|word| !is_listed(TO, word));
        quantity.is_some_and(|quantity| (quantity.value - units).abs() < 1e-9)
            && [behind, before].into_iter().flatten().any(|word| *word == side)
    };
    (0..words.len()).any(is_own)
}

/// Whether words have a verb of a turn that they do not rule out.
fn asks_for_turn(words: &[&str]) -> bool {
    let is_ruled_out = |at: usize| {
        let before = words[..at].iter().rev().find(|word| !is_listed(BANNED, word));
        before.is_some_and(|word| is_listed(BANS, word))
    };
    (0..words.len()).any(|at| TURNS.iter().any(|verb| is_form(words[at], verb)) && !is_ruled_out(at))
}

#[cfg(test)]
mod tests {
    use super::super::fixture::{about, linked};
    use super::*;
    use cinesplat_language::Quantity;

    fn moved(text: &str, turn: Move, forbidden: &[Motion]) -> Move {
        let quantity = Quantity { kind: QuantityKind::Units, value: 1.0 };
        let linked = Linked { quantities: vec![quantity], ..linked(text) };
        let amount = text.contains("<qty-0>").then_some(Amount::Units(1.0));
        let steps = vec![Step { amount, words: Some([0, text.len()]), ..Step::of(turn) }];
        let mut program = Program { steps, forbidden: forbidden.to_vec(), ..Program::default() };
        travel_instead_of_turning(&linked, &mut program);
        program.steps[0].movement
    }

    #[test]
    fn a_way_along_a_thing_does_not_begin_at_it() {
        let along = |text: &str| {
            let start = Framing { subjects: vec![5], ..Framing::default() };
            let mut steps = vec![Step { start, words: Some([0, text.len()]), ..Step::of(Move::PushIn) }];
            go_along(&linked(text), &mut steps);
            steps[0].via.as_ref().map(|via| via.objects.clone())
        };
        assert_eq!(along("move forward along the length of <obj-0> to <obj-1>"), Some(vec![5]));
        assert_eq!(along("move forward from <obj-0> along to <obj-1>"), None);
    }

    #[test]
    fn a_truck_that_is_called_so_is_no_pan() {
        assert_eq!(moved("truck right until <obj-0> is out of frame", Move::PanRight, &[]), Move::TruckRight);
        assert_eq!(moved("truck right while panning left", Move::PanRight, &[]), Move::PanRight);
        assert_eq!(moved("swing right to the truck", Move::PanRight, &[]), Move::PanRight);
    }

    #[test]
    fn a_length_to_a_side_is_a_travel() {
        assert_eq!(moved("<qty-0> to the left would be grand", Move::PanLeft, &[]), Move::TruckLeft);
        assert_eq!(moved("pan right <qty-0>", Move::PanRight, &[]), Move::TruckRight);
        assert_eq!(moved("up by <qty-0> please", Move::TiltUp, &[]), Move::PedestalUp);
        assert_eq!(moved("pan left to <obj-0> , which is <qty-0> away", Move::PanLeft, &[]), Move::PanLeft);
        assert_eq!(moved("pan left to <obj-0>", Move::PanLeft, &[]), Move::PanLeft);
    }

    #[test]
    fn who_rules_turns_out_travels() {
        assert_eq!(moved("over to the left , no panning", Move::PanLeft, &[Motion::Pan]), Move::TruckLeft);
        assert_eq!(moved("to the right without turning", Move::PanRight, &[Motion::Turn]), Move::TruckRight);
        assert_eq!(moved("pan left , no tilting", Move::PanLeft, &[Motion::Tilt]), Move::PanLeft);
        assert_eq!(moved("turn to the left , no panning", Move::PanLeft, &[Motion::Pan]), Move::PanLeft);
        assert_eq!(moved("to <obj-0> , no panning", Move::PanLeft, &[Motion::Pan]), Move::PanLeft);
    }

    #[test]
    fn a_slide_along_a_thing_leads_to_what_stands_behind_to() {
        let text = "slide right along <obj-0> past <obj-0> to <obj-1> , then pull back";
        let mut step = about(Move::TruckRight, &[5], [0, 38]);
        step.start.subjects = vec![5];
        slide_along_to(&linked(text), std::slice::from_mut(&mut step));
        assert_eq!((&step.start.subjects[..], &step.end.subjects[..]), (&[][..], &[7][..]));
        assert_eq!(step.via, Some(Via { how: Pass::Along, objects: vec![5] }));
    }
}

//! Ways round a thing that come nearer on the way: `curve off to the left and finish up closer to it, a third of the way nearer`.
//!
//! They are one move with one amount. The network reads the amount as a second move, or as a part of a turn.

use cinesplat_language::{Linked, is_listed};
use cinesplat_operator::{Amount, Framing, Step};
use cinesplat_trajectory::Move;

use super::briefs::is_camera_verb;
use super::directions::is_form;
use crate::direction::Direction;

/// Words of a way that ends nearer, and of one that ends farther away.
const NEARER: &str = "closer nearer close tighter";
const FARTHER: &str = "further farther away wider";
/// Words of a second move of its own.
const THEN: &str = "then next after afterwards finally before";

/// Makes one move of a way round and of the words that say how much nearer it ends, and gives the amount to the distance.
pub(crate) fn come_nearer_round(linked: &Linked, direction: &mut Direction) {
    for nth in (1..direction.program.steps.len()).rev() {
        let [first, second] = &direction.program.steps[nth - 1..=nth] else { continue };
        if let Some(one) = joined(linked, first, second) {
            direction.join_steps(nth, one);
        }
    }
    for step in direction.program.steps.iter_mut().filter(|step| step.movement.is_circular()) {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let travel = match step.amount.filter(|_| step.with.is_empty()) {
            Some(Amount::Factor(factor)) => way_by(&words, factor),
            _ if step.with.is_empty() && ends_nearer(&words) => Some(Move::PushIn),
            _ => None,
        };
        step.with.extend(travel);
    }
}

/// Verbs of an arrival.
const ENDS: [&str; 7] = ["end", "finish", "wind", "get", "come", "land", "close"];

/// Whether words end nearer than they begin: `arc to the right and end up nearer`.
fn ends_nearer(words: &[&str]) -> bool {
    (1..words.len()).any(|at| {
        let verb =
            words[..at].iter().rev().find(|word| !is_listed("up a bit little slightly ever gradually slowly", word));
        matches!(words[at], "closer" | "nearer") && verb.is_some_and(|verb| ENDS.iter().any(|end| is_form(verb, end)))
    })
}

/// The way in or out that words and a factor on the distance say.
fn way_by(words: &[&str], factor: f64) -> Option<Move> {
    let says = |list: &str| words.iter().any(|word| is_listed(list, word));
    match () {
        () if factor < 1.0 && says(NEARER) => Some(Move::PushIn),
        () if factor > 1.0 && says(FARTHER) => Some(Move::PullOut),
        () => None,
    }
}

/// One way of a way round and of a step whose words only say how much nearer it ends.
fn joined(linked: &Linked, first: &Step, second: &Step) -> Option<Step> {
    let Some(Amount::Factor(factor)) = second.amount else { return None };
    let (own, words) = (linked.texts_in(first.words?), linked.texts_in(second.words?));
    let is_one = first.movement.is_circular()
        && first.with.is_empty()
        && (first.amount.is_none() || first.amount == second.amount)
        && (second.end.subjects.is_empty() || second.end.subjects == first.end.subjects);
    let plain = Step {
        end: Framing { subjects: second.end.subjects.clone(), ..Framing::default() },
        amount: second.amount,
        words: second.words,
        ..Step::of(second.movement)
    };
    let adds = *second == plain
        && !(0..words.len()).any(|at| is_camera_verb(&words, at))
        && !words.iter().any(|word| is_listed(THEN, word));
    let travel = way_by(&words, factor).or_else(|| way_by(&own, factor));
    let travel = travel.filter(|travel| *travel == second.movement && is_one && adds)?;
    let words = first.joint_words(second);
    Some(Step { with: vec![travel], amount: second.amount, words, ..first.clone() })
}

#[cfg(test)]
mod tests {
    use super::super::fixture::{about, direction, linked};
    use super::*;

    fn read(text: &str, comma: usize, second: Option<Move>) -> Vec<Step> {
        let factor = Some(Amount::Factor(0.75));
        let end = if second.is_some() { comma } else { text.len() };
        let mut steps = vec![Step { amount: factor, ..about(Move::ArcLeft, &[5], [0, end]) }];
        steps.extend(second.map(|way| Step { amount: factor, ..about(way, &[5], [comma, text.len()]) }));
        let mut direction = direction(steps);
        come_nearer_round(&linked(text), &mut direction);
        direction.program.steps
    }

    #[test]
    fn a_way_round_that_ends_nearer_is_one_move() {
        let text = "curve off to the left and finish closer to <obj-0> , <qty-0> nearer at least";
        let comma = text.find(',').unwrap();
        let steps = read(text, comma, Some(Move::PushIn));
        assert_eq!(
            (steps.len(), &steps[0].with[..], steps[0].amount),
            (1, &[Move::PushIn][..], Some(Amount::Factor(0.75)))
        );
        assert_eq!(read("arc left around <obj-0> , ending <qty-0> closer", 0, None)[0].with, [Move::PushIn]);
    }

    #[test]
    fn a_way_in_behind_a_way_round_is_a_second_move() {
        let text = "arc left around <obj-0> , then push in <qty-0> closer";
        assert_eq!(read(text, text.find(',').unwrap(), Some(Move::PushIn)).len(), 2);
        assert!(ends_nearer(&["arc", "right", "and", "end", "up", "nearer"]));
        assert!(ends_nearer(&["all", "round", "it", ",", "slowly", "getting", "a", "bit", "nearer"]));
        assert!(!ends_nearer(&["arc", "right", "around", "the", "closer", "chair"]));
        assert!(read("arc left <qty-0> of the way around <obj-0>", 0, None)[0].with.is_empty());
    }
}

//! Turns all the way round: `spin all the way around on the spot`, `look right round the whole room`, `one complete turn
//! around the anvil`.

use cinesplat_language::Linked;
use cinesplat_operator::{Amount, Framing, Step};
use cinesplat_trajectory::Move;

use super::directions::is_form;
use super::open::as_orbit;
use crate::direction::Direction;

/// Words of a turn back to where it began, one after the other.
const ALL_ROUND: [&[&str]; 10] = [
    &["all", "the", "way", "round"],
    &["all", "the", "way", "around"],
    &["the", "whole", "way", "round"],
    &["the", "whole", "way", "around"],
    &["right", "round", "the", "room"],
    &["right", "around", "the", "room"],
    &["all", "around", "the", "room"],
    &["all", "round", "the", "room"],
    &["around", "the", "whole", "room"],
    &["round", "the", "whole", "room"],
];

/// Words of a turn that does not come round, and words that deny what follows them.
const SHORT: [&str; 5] = ["almost", "nearly", "half", "quarter", "halfway"];
const DENIALS: [&str; 6] = ["not", "'t", "n't", "without", "no", "never"];

/// What is complete is one circle, and not a part of it: `one full round of the pillar`.
const COMPLETE: [&str; 5] = ["complete", "full", "entire", "whole", "completely"];
const CIRCLES: [&str; 14] = [
    "circle",
    "turn",
    "round",
    "lap",
    "circuit",
    "orbit",
    "loop",
    "revolution",
    "around",
    "rotation",
    "ring",
    "walkaround",
    "pass",
    "spin",
];

/// Gives a pan without a goal, or a circle about its subject, a full turn where its words lead all the way round and state
/// no angle.
pub(crate) fn turn_all_round(linked: &Linked, steps: &mut [Step]) {
    for step in steps {
        let pans = matches!(step.movement, Move::PanLeft | Move::PanRight) && step.end.subjects.is_empty();
        let circles = step.movement.is_circular()
            && step.end.side.is_none()
            && (step.start.subjects.is_empty() || step.start.subjects == step.end.subjects);
        let is_open = !matches!(step.amount, Some(Amount::Degrees(_) | Amount::Factor(_))) && !step.returns;
        let Some(span) = step.words.filter(|_| (pans || circles) && is_open) else { continue };
        let words = linked.texts_in(span);
        let is_all = |at: usize| ALL_ROUND.iter().any(|said| words[at..].starts_with(said));
        let is_complete =
            |at: usize| COMPLETE.contains(&words[at]) && words.get(at + 1).is_some_and(|word| CIRCLES.contains(word));
        let is_said = |at: usize| {
            let before = &words[at.saturating_sub(4)..at];
            (is_all(at) || circles && is_complete(at)) && !before.iter().any(|word| DENIALS.contains(word))
        };
        if (0..words.len()).any(is_said) && !words.iter().any(|word| SHORT.contains(word)) {
            step.amount = Some(Amount::Degrees(360.0));
        }
    }
}

/// Words that only say again how far a circle goes.
const AGAIN: [&str; 16] = [
    "one", "a", "just", "only", "single", "that", "is", "'s", "so", "exactly", "in", "total", "and", "it", "the",
    "close",
];

/// Makes one circle of two of which the second only says again how far the first goes: `all the way round the globe, one full
/// circle`.
pub(crate) fn join_said_again(linked: &Linked, direction: &mut Direction) {
    for nth in (1..direction.program.steps.len()).rev() {
        let [first, second] = [&direction.program.steps[nth - 1], &direction.program.steps[nth]];
        let (a, b) = (as_orbit(first.movement), as_orbit(second.movement));
        let circles = matches!(a, Move::OrbitLeft | Move::OrbitRight) && (a == b || second.either_way);
        let same = second.amount.is_some()
            && (first.amount == second.amount || first.amount.is_none())
            && (second.end.subjects.is_empty() || second.end.subjects == first.end.subjects);
        let words = linked.texts_in(second.words.unwrap_or_default());
        let is_plain = |word: &&str| {
            AGAIN.contains(word)
                || COMPLETE.contains(word)
                || CIRCLES.contains(word)
                || linked.is_quantity(word)
                || !word.starts_with(char::is_alphanumeric) && linked.slot_at(word).is_none()
        };
        if circles && same && !second.cut && first.words != second.words && words.iter().all(is_plain) {
            let (amount, words) = (second.amount, first.joint_words(second));
            direction.join_steps(nth, Step { amount, words, ..first.clone() });
        }
    }
}

/// Makes a full circle of a circle whose end another step tells: `circle him, and come home where you began`.
pub(crate) fn close_circles(linked: &Linked, direction: &mut Direction) {
    for nth in (1..direction.program.steps.len()).rev() {
        let [first, second] = [&direction.program.steps[nth - 1], &direction.program.steps[nth]];
        let turns = first.movement.is_circular();
        let is_open = !matches!(first.amount, Some(Amount::Degrees(_) | Amount::Factor(_)));
        let (a, b) = (as_orbit(first.movement), as_orbit(second.movement));
        let goes_on = a == b || first.either_way && a.opposite() == Some(b);
        let words = linked.texts_in(second.words.unwrap_or_default());
        let circles = ["orbit", "circle", "arc", "go", "travel", "retrace", "reverse", "spin", "round", "around"];
        let is_told = words.iter().any(|word| circles.iter().any(|verb| is_form(word, verb)));
        let is_plain = second.amount.is_none() && second.with.is_empty() && second.duration_secs.is_none();
        let keeps = second.end == Framing::default() || second.end.subjects == first.end.subjects;
        if turns && is_open && goes_on && second.returns && is_plain && keeps && !is_told && first.words != second.words
        {
            let words = first.joint_words(second);
            let one = Step { amount: Some(Amount::Degrees(360.0)), returns: false, words, ..first.clone() };
            direction.join_steps(nth, one);
        }
    }
}

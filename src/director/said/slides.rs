//! Slides along a thing that are told in several clauses: `tracking shot along the counter, moving right from the refrigerator to
//! the stove, camera parallel to the fronts the whole way`.
//!
//! The network makes a step of each clause. They are one slide, which goes along the thing from the one end to the other.

use cinesplat_language::{Linked, is_listed};
use cinesplat_operator::{Framing, Pass, Step, Via};
use cinesplat_trajectory::Move;

use super::directions::says_any;
use crate::direction::Direction;

/// Words of a slide that comes after another one.
const AFTER: &str = "then next after again back another second finally";
/// Words of how a camera is held.
const POSTURES: &str = "parallel square level perpendicular";
/// Words of all the film.
const THROUGHOUT: [&[&str]; 6] = [
    &["the", "whole", "way"],
    &["all", "the", "way"],
    &["the", "whole", "time"],
    &["the", "entire", "time"],
    &["throughout"],
    &["at", "all", "times"],
];

/// Makes one step of the clauses of a slide.
pub(crate) fn join_slides(linked: &Linked, direction: &mut Direction) {
    let mut nth = 1;
    while nth < direction.program.steps.len() {
        let [first, second] = &direction.program.steps[nth - 1..=nth] else { break };
        let words = linked.texts_in(second.words.unwrap_or_default());
        let comes_after = words.iter().any(|word| is_listed(AFTER, word));
        if !comes_after && is_posture(first, second, &words) {
            direction.remove_step(nth);
        } else if let Some(one) = joined(first, second).filter(|_| !comes_after) {
            direction.join_steps(nth, one);
        } else {
            nth += 1;
        }
    }
}

fn slides(step: &Step) -> bool {
    matches!(step.movement, Move::TruckLeft | Move::TruckRight)
}

fn is_along(via: &Via) -> bool {
    matches!(via.how, Pass::Along)
}

/// One slide of two, of which the first says what it goes along and the second where it ends.
fn joined(first: &Step, second: &Step) -> Option<Step> {
    let is_one_way = first.movement == second.movement && !second.cut && !second.returns;
    let is_open = first.end == Framing::default() && first.via.as_ref().is_some_and(is_along);
    let from_same = second.start.subjects.is_empty() || second.start.subjects == first.start.subjects;
    let starts = first.start.subjects.is_empty() || from_same;
    let ends = second.via.is_none() && !second.end.subjects.is_empty();
    let is_slide = slides(first) && is_one_way && is_open && starts && ends;
    let start = if first.start.subjects.is_empty() { &second.start } else { &first.start };
    is_slide.then(|| Step {
        start: start.clone(),
        end: second.end.clone(),
        duration_secs: first.duration_secs.or(second.duration_secs),
        easing: first.easing.or(second.easing),
        words: first.joint_words(second),
        ..first.clone()
    })
}

/// Whether a step behind a slide only says how the camera is held all the way.
fn is_posture(first: &Step, second: &Step, words: &[&str]) -> bool {
    let is_held = words.iter().any(|word| is_listed(POSTURES, word)) && says_any(words, &THROUGHOUT);
    slides(first) && is_held && matches!(second.movement, Move::Follow | Move::Static) && !second.cut
}

#[cfg(test)]
mod tests {
    use super::*;

    fn about(id: u32) -> Framing {
        Framing { subjects: vec![id], ..Framing::default() }
    }

    fn along(id: u32) -> Step {
        let via = Via { how: Pass::Along, objects: vec![id] };
        Step { start: about(4), via: Some(via), ..Step::of(Move::TruckRight) }
    }

    #[test]
    fn a_slide_along_a_counter_ends_where_the_next_clause_says() {
        let second = Step { start: about(4), end: about(6), ..Step::of(Move::TruckRight) };
        let one = Step { end: about(6), ..along(5) };
        assert_eq!(joined(&along(5), &second), Some(one));
        let other_way = Step { movement: Move::TruckLeft, ..second };
        assert_eq!(joined(&along(5), &other_way), None);
    }

    #[test]
    fn a_camera_that_is_held_parallel_all_the_way_is_no_move() {
        let words = ["camera", "parallel", "to", "<obj-5>", "the", "whole", "way"];
        assert!(is_posture(&along(5), &Step::of(Move::Follow), &words));
        assert!(!is_posture(&along(5), &Step::of(Move::PushIn), &words));
        assert!(!is_posture(&along(5), &Step::of(Move::Follow), &words[..4]));
    }
}

//! Words that tell where a thing is, and are no way to what stands beside it: `come to rest on the telescope over by the window`.

use cinesplat_language::{Linked, is_listed};
use cinesplat_operator::Step;
use cinesplat_trajectory::Move;

use crate::direction::Direction;

/// Words of a place beside something, and the words around them.
const PLACES: &str = "by near beside next under above behind opposite";
const AROUND: &str = "over right there just up down to at the in of front ,";

/// Drops a way to the thing by which the words behind a goal tell where that stands.
pub(crate) fn drop_told_places(linked: &Linked, direction: &mut Direction) {
    let mut nth = 1;
    while nth < direction.program.steps.len() {
        let [before, step] = &direction.program.steps[nth - 1..=nth] else { break };
        if is_told_place(linked, before, step) {
            direction.remove_step(nth);
        } else {
            nth += 1;
        }
    }
}

fn is_told_place(linked: &Linked, before: &Step, step: &Step) -> bool {
    let goes = matches!(step.movement, Move::Follow | Move::PushIn | Move::Static);
    let is_plain = step.via.is_none() && step.with.is_empty() && step.start.subjects.is_empty() && !step.cut;
    let ([from, _], [_, to]) = (before.words.unwrap_or_default(), step.words.unwrap_or_default());
    let words = linked.texts_in([from, to]);
    let stands_for = |ids: &[u32]| words.iter().rposition(|word| linked.stands_for(word, ids));
    let (Some(goal), Some(beside)) = (stands_for(&before.end.subjects), stands_for(&step.end.subjects)) else {
        return false;
    };
    let between = words.get(goal + 1..beside).unwrap_or_default();
    let tells = |word: &&str| is_listed(PLACES, word);
    let is_place = |word: &&str| tells(word) || is_listed(AROUND, word);
    let ends = words[beside + 1..].iter().all(|word| !word.chars().any(char::is_alphanumeric));
    goes && is_plain && between.iter().any(tells) && between.iter().all(is_place) && ends
}

#[cfg(test)]
mod tests {
    use super::super::fixture::{about, direction, linked};
    use super::*;

    #[test]
    fn where_a_goal_stands_is_no_further_goal() {
        let count = |text: &str| {
            let at = text.find("<obj-0>").unwrap() + 7;
            let steps = vec![about(Move::Follow, &[5], [0, at]), about(Move::Follow, &[7], [0, text.len()])];
            let mut direction = direction(steps);
            drop_told_places(&linked(text), &mut direction);
            direction.program.steps.len()
        };
        assert_eq!(count("come to rest on <obj-0> over by the <obj-1> ."), 1);
        assert_eq!(count("come to <obj-0> , right next to <obj-1>"), 1);
        assert_eq!(count("come to <obj-0> and go on to <obj-1>"), 2);
        assert_eq!(count("come to <obj-0> then over by <obj-1> and hold it"), 2);
    }
}

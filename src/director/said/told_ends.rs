//! Prompts that tell the last picture first: `Finish on the bust, filling the frame. We begin by the door, then wander past the
//! armchair.`

use cinesplat_language::{Linked, is_listed};
use cinesplat_trajectory::Move;

use crate::direction::Direction;

const ENDS: &str = "end ends ending finish finishes finishing final last";
const BEGINS: &str = "begin begins beginning start starts starting open opens opening";
/// Words of the first sentence before `end`, and words of another one before `begin`.
const MOST_BEFORE: usize = 4;
const MARKS: &str = ". ! ? ;";

/// Moves the steps of a first sentence that tells the end behind those of the others, where one of these tells the beginning.
pub(crate) fn move_told_ends(linked: &Linked, direction: &mut Direction) {
    let words: Vec<(&str, [usize; 2])> = linked.words_in([0, usize::MAX]).collect();
    let mut sentences = words.split_inclusive(|(word, _)| is_listed(MARKS, word));
    let says = |sentence: &[(&str, [usize; 2])], list: &str| {
        let at = sentence.iter().position(|(word, _)| is_listed(list, word));
        at.is_some_and(|at| at <= MOST_BEFORE && sentence[..at].iter().all(|(word, _)| !word.starts_with('<')))
    };
    let Some(first) = sentences.next().filter(|first| says(first, ENDS) && !says(first, BEGINS)) else { return };
    let Some(end) = first.last().map(|(_, span)| span[1]) else { return };
    if linked.timeline.is_some() || !sentences.any(|sentence| says(sentence, BEGINS)) {
        return;
    }
    let steps = &mut direction.program.steps;
    let is_told = |words: Option<[usize; 2]>| words.is_some_and(|[_, to]| to <= end);
    let told = steps.iter().take_while(|step| is_told(step.words)).count();
    if told == 0 || told == steps.len() || steps[told..].iter().any(|step| is_told(step.words)) {
        return;
    }
    // What was read as a rest at the beginning is where the film gets to.
    let rests = |movement: Move| movement == Move::Static;
    steps[..told].iter_mut().filter(|step| rests(step.movement)).for_each(|step| step.movement = Move::Follow);
    direction.move_to_end(told);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::direction::StepCertainty;
    use crate::said::fixture::{about, direction, linked};

    /// The moves of a rest and a flight, whose words begin at three of the words.
    fn moves(text: &str, firsts: [usize; 3]) -> Vec<Move> {
        let linked = linked(text);
        let words = |nth: usize| [linked.spans[firsts[nth]][0], linked.spans[firsts[nth + 1] - 1][1]];
        let steps = vec![about(Move::Static, &[5], words(0)), about(Move::FlyThrough, &[7], words(1))];
        let certainty = steps.iter().map(|step| StepCertainty::of(1.0, step.words));
        let mut direction = Direction { certainty: certainty.collect(), ..direction(steps) };
        move_told_ends(&linked, &mut direction);
        direction.program.steps.iter().map(|step| step.movement).collect()
    }

    #[test]
    fn an_end_that_is_told_first_comes_last() {
        assert_eq!(moves("finish on <obj-0> . begin at <obj-1>", [0, 4, 7]), [Move::FlyThrough, Move::Follow]);
        assert_eq!(moves("start on <obj-0> . end at <obj-1> .", [0, 4, 8]), [Move::Static, Move::FlyThrough]);
        assert_eq!(moves("finish on <obj-0> . go past <obj-1>", [0, 4, 7]), [Move::Static, Move::FlyThrough]);
    }
}

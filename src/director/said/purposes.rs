//! Why somebody wants a move: `pan over both windows, so one can see how the drapes hang`. It is no move of its own.

use cinesplat_language::{Linked, is_listed};

use crate::direction::Direction;

/// Who sees, what they do, and what follows where it is told why.
const PEOPLE: &str = "one you we i people viewers they everyone everybody anyone buyers customers guests";
const MAY: &str = "can could may might will get to really";
const SEES: &str = "see tell notice appreciate feel understand learn grasp sense imagine";
const HOW: &str = "how what why whether";
/// Most words before them, which are still about the move before: `, left to right, so ..`.
const MOST_BEFORE: usize = 6;

/// Removes a step that only comes from the words that tell why, behind another step.
pub(crate) fn drop_purposes(linked: &Linked, direction: &mut Direction) {
    for nth in (1..direction.program.steps.len()).rev() {
        let step = &direction.program.steps[nth];
        let words = linked.texts_in(step.words.unwrap_or_default());
        let Some(at) = purpose(&words) else { continue };
        let names = words[..at].iter().any(|word| linked.slot_at(word).is_some() || linked.is_quantity(word));
        if names || at > MOST_BEFORE {
            continue;
        }
        let before = &direction.program.steps[nth - 1];
        let joint = before.joint_words(step);
        direction.program.steps[nth - 1].words = joint;
        direction.remove_step(nth);
    }
}

/// Where the words begin that tell why.
fn purpose(words: &[&str]) -> Option<usize> {
    let word = |at: usize| words.get(at).copied().unwrap_or_default();
    (0..words.len()).find(|at| {
        let person = at + 1 + usize::from(word(at + 1) == "that");
        let verb = (person + 1..person + 4).find(|at| !is_listed(MAY, word(*at))).unwrap_or(person + 1);
        words[*at] == "so"
            && is_listed(PEOPLE, word(person))
            && is_listed(SEES, word(verb))
            && is_listed(HOW, word(verb + 1))
    })
}

#[cfg(test)]
mod tests {
    use super::super::fixture::{about, direction, linked};
    use super::*;
    use cinesplat_trajectory::Move;

    fn num_steps(text: &str) -> usize {
        let at = text.find(" ,").unwrap();
        let steps = vec![about(Move::PanRight, &[5], [0, at]), about(Move::PanRight, &[7], [at, text.len()])];
        let mut direction = direction(steps);
        drop_purposes(&linked(text), &mut direction);
        direction.program.steps.len()
    }

    #[test]
    fn why_somebody_wants_a_move_is_no_move() {
        assert_eq!(num_steps("pan over <obj-0> , so one can see how <obj-1> hang"), 1);
        assert_eq!(num_steps("pan over <obj-0> , left to right , so one can see how <obj-1> hang"), 1);
        assert_eq!(num_steps("pan over <obj-0> , so that you get to see what <obj-1> is like"), 1);
        assert_eq!(num_steps("pan over <obj-0> , then tilt up to <obj-1> so one can see how it hangs"), 2);
        assert_eq!(num_steps("pan over <obj-0> , so we see <obj-1>"), 2);
    }
}

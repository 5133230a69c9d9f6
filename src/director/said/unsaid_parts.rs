//! Parts of things that no words name: `from tight on the skull swoop backwards` begins on the skull, and not on its top.

use cinesplat_language::{Linked, is_listed};
use cinesplat_operator::{Amount, Step, SubjectPart};
use cinesplat_trajectory::Move;

/// Words of parts and of places on a thing.
const PARTS: &str = "top tops tip tips upper uppermost head heads crown peak rim lid roof up high higher bottom bottoms base bases foot \
    feet lower lowest below under underside down left right lefthand righthand edge edges side sides corner corners face eye eyes front \
    neck body arm arms leg legs half third part parts detail details";

/// Shows all of a thing where the words of a step name no part of it. Tilts and rises lead from one end to the other by themselves.
pub(crate) fn drop_unsaid_parts(linked: &Linked, steps: &mut [Step]) {
    for step in steps {
        let travels = matches!(
            step.movement,
            Move::PushIn | Move::PullOut | Move::ZoomIn | Move::ZoomOut | Move::OrbitLeft | Move::OrbitRight
        );
        let words: Vec<(&str, [usize; 2])> = linked.words_in(step.words.unwrap_or_default()).collect();
        let names_part = |(word, span): &(&str, [usize; 2])| {
            is_listed(PARTS, word) || linked.parts.iter().any(|(bytes, _)| bytes[0] <= span[0] && span[1] <= bytes[1])
        };
        // `At the end` is no end of a thing.
        let ends = |at: usize| {
            let before = |num: usize| at.checked_sub(num).map_or("", |at| words[at].0);
            words[at].0 == "end"
                && (matches!(before(1), "far" | "near" | "left" | "right")
                    || words.get(at + 1).is_some_and(|(word, _)| *word == "of"))
        };
        if travels && !words.is_empty() && !words.iter().any(names_part) && !(0..words.len()).any(ends) {
            step.start.part = SubjectPart::Middle;
            step.end.part = SubjectPart::Middle;
        }
    }
}

/// Words of a move that goes far.
const FAR: &str = "lot lots way far all big long large huge sweeping sweep sweeps full fully whole entire right much deep deeply across wide \
    massive massively great good plenty miles spin spins spinning twirl whirl circling revolve dramatic dramatically complete completely round circle circles lap laps revolution \
    proper loads tons substantial substantially major half halfway once";

/// Takes back that a circle goes far where no words say so.
pub(crate) fn drop_unsaid_amounts(linked: &Linked, steps: &mut [Step]) {
    for step in steps.iter_mut().filter(|step| step.movement.is_circular() && step.amount == Some(Amount::Large)) {
        let words = linked.texts_in(step.words.unwrap_or_default());
        // `To the right` is no `right round`.
        let is_side = |at: usize| words[at] == "right" && words.get(at + 1).is_none_or(|next| *next != "round");
        if !words.is_empty() && !(0..words.len()).any(|at| is_listed(FAR, words[at]) && !is_side(at)) {
            step.amount = None;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::fixture::{about, linked};
    use super::*;

    fn part(text: &str, movement: Move) -> SubjectPart {
        let mut step = about(movement, &[5], [0, text.len()]);
        step.start.part = SubjectPart::Top;
        drop_unsaid_parts(&linked(text), std::slice::from_mut(&mut step));
        step.start.part
    }

    #[test]
    fn only_words_show_a_part_of_a_thing() {
        assert_eq!(part("from tight on <obj-0> swoop backwards and downwards", Move::PullOut), SubjectPart::Middle);
        assert_eq!(part("start close on <obj-0> , zoom out", Move::ZoomOut), SubjectPart::Middle);
        assert_eq!(part("close on <obj-0> , pull out , <obj-1> in at the end", Move::PullOut), SubjectPart::Middle);
        assert_eq!(part("close on the far end of <obj-0> , pull out", Move::PullOut), SubjectPart::Top);
        assert_eq!(part("from tight on the top of <obj-0> swoop backwards", Move::PullOut), SubjectPart::Top);
        assert_eq!(part("from up on <obj-0> pull back", Move::PullOut), SubjectPart::Top);
        assert_eq!(part("tilt over <obj-0>", Move::TiltDown), SubjectPart::Top);
    }

    #[test]
    fn only_words_make_a_circle_large() {
        let amount = |text: &str| {
            let mut step = about(Move::OrbitRight, &[5], [0, text.len()]);
            step.amount = Some(Amount::Large);
            drop_unsaid_amounts(&linked(text), std::slice::from_mut(&mut step));
            step.amount
        };
        assert_eq!(amount("orbit right around <obj-0>"), None);
        assert_eq!(amount("a big orbit around <obj-0>"), Some(Amount::Large));
        assert_eq!(amount("orbit right round <obj-0>"), Some(Amount::Large));
    }
}

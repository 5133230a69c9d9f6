//! What a move is aimed at all the way: `crane down from the lamp to the toolbox, always aimed at the toolbox`, `crane up from the bench,
//! keep the bed in the middle all the way`.

use cinesplat_language::{Linked, is_listed};
use cinesplat_operator::{Look, Motion, Pass, Step, Via};
use cinesplat_trajectory::Move;

/// Words of what lasts, and of a camera that is aimed or a thing that stays in the middle.
const LASTS: &str = "always constantly throughout keep keeps keeping stay stays staying";
const AIMS: &str = "aimed aim pointed pointing point trained looking look facing focused locked fixed centered centred middle center centre";
/// Most words between them, and between them and the thing.
const NEAR: usize = 5;

/// Aims a rise or a descent at its subject all the way, where the network begins it with a picture of the place from which it sets out, or
/// passes that.
pub(crate) fn stay_aimed(linked: &Linked, steps: &mut [Step]) {
    for step in steps.iter_mut().filter(|step| Motion::of(step.movement) == Some(Motion::Rise)) {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let place = match &step.via {
            None => step.start.subjects.clone(),
            Some(via) if via.how == Pass::Past && step.start.subjects.is_empty() => via.objects.clone(),
            Some(_) => continue,
        };
        let goal = linked.expanded(&step.end.subjects);
        let is_open = goal.len() == 1 && !place.is_empty() && !linked.expanded(&place).contains(&goal[0]);
        if is_open && is_aimed(linked, &words, &goal) && sets_out(linked, &words, &linked.expanded(&place)) {
            step.start.subjects.clone_from(&step.end.subjects);
            step.start.size = None;
            step.via = Some(Via { how: Pass::From, objects: place });
        }
    }
}

/// Words of a slide whose camera is square to what it slides along.
const SQUARE: [[&str; 2]; 5] =
    [["straight", "at"], ["straight", "on"], ["square", "to"], ["square", "on"], ["head", "on"]];

/// Keeps a slide square to what the words look straight at: `slide along the counter, looking straight at the units` turns to none of them.
pub(crate) fn slide_straight(linked: &Linked, steps: &mut [Step]) {
    for step in steps.iter_mut().filter(|step| matches!(step.movement, Move::TruckLeft | Move::TruckRight)) {
        let words = linked.texts_in(step.words.unwrap_or_default());
        if words.windows(2).any(|pair| SQUARE.iter().any(|square| pair == square)) {
            step.look = step.look.take().filter(|look| !matches!(look, Look::At(_)));
        }
    }
}

/// Whether words set out from a thing.
fn sets_out(linked: &Linked, words: &[&str], ids: &[u32]) -> bool {
    let is_place = |at: usize| linked.stands_for(words[at], ids);
    (0..words.len()).any(|at| is_place(at) && words[..at].iter().rev().take(NEAR).any(|word| *word == "from"))
}

/// Whether words keep the camera aimed at some things.
fn is_aimed(linked: &Linked, words: &[&str], ids: &[u32]) -> bool {
    (0..words.len()).any(|at| {
        let around = &words[at.saturating_sub(NEAR)..words.len().min(at + 1 + NEAR)];
        let names = |word: &&str| linked.stands_for(word, ids);
        is_listed(AIMS, words[at]) && around.iter().any(|word| is_listed(LASTS, word)) && around.iter().any(names)
    })
}

#[cfg(test)]
mod tests {
    use super::super::fixture::{about, linked};
    use super::*;

    fn start(text: &str) -> (Vec<u32>, Option<Via>) {
        let mut step = about(Move::CraneDown, &[7], [0, text.len()]);
        step.start.subjects = vec![5];
        let mut steps = [step];
        stay_aimed(&linked(text), &mut steps);
        (steps[0].start.subjects.clone(), steps[0].via.clone())
    }

    #[test]
    fn a_slide_that_looks_straight_at_things_turns_to_none_of_them() {
        let look = |text: &str| {
            let mut slide = about(Move::TruckRight, &[7], [0, text.len()]);
            slide.look = Some(Look::At(vec![5]));
            let mut steps = [slide];
            slide_straight(&linked(text), &mut steps);
            steps[0].look.clone()
        };
        assert_eq!(look("slide right to <obj-1> , looking straight at <obj-0>"), None);
        assert!(look("slide right to <obj-1> , looking at <obj-0>").is_some());
    }

    #[test]
    fn who_is_aimed_at_all_the_way_is_seen_first() {
        let from = Some(Via { how: Pass::From, objects: vec![5] });
        assert_eq!(start("crane down from <obj-0> to <obj-1> , always aimed at <obj-1> ,"), (vec![7], from.clone()));
        assert_eq!(start("crane up from <obj-0> . keep <obj-1> in the middle all the way"), (vec![7], from));
        assert_eq!(start("crane down from <obj-0> to <obj-1> , aimed at <obj-1> at the end"), (vec![5], None));
        assert_eq!(start("crane down from <obj-0> to <obj-1>"), (vec![5], None));
        let text = "crane down from up by <obj-0> to <obj-1> , always aimed at <obj-1>";
        let mut by = about(Move::CraneDown, &[7], [0, text.len()]);
        by.via = Some(Via { how: Pass::Past, objects: vec![5] });
        let mut steps = [by];
        stay_aimed(&linked(text), &mut steps);
        assert_eq!((&steps[0].start.subjects, steps[0].via.as_ref().map(|via| via.how)), (&vec![7], Some(Pass::From)));
    }
}

//! What is seen when the camera sets off: `a metre to the left, with the chair in the middle when we set off`, `truck right, to begin
//! with the lamp is at the edge`.
//!
//! The network takes the picture for that of the end, because it is said last.

use cinesplat_language::Linked;
use cinesplat_operator::{Framing, Step};
use cinesplat_trajectory::Move;

use super::directions::says_any;

/// Phrases of the first moment.
const SETS_OFF: [&[&str]; 20] = [
    &["when", "we", "set", "off"],
    &["as", "we", "set", "off"],
    &["when", "you", "set", "off"],
    &["when", "it", "sets", "off"],
    &["when", "we", "start"],
    &["as", "we", "start"],
    &["when", "you", "start"],
    &["when", "it", "starts"],
    &["when", "we", "begin"],
    &["when", "it", "begins"],
    &["at", "the", "start"],
    &["at", "the", "beginning"],
    &["at", "the", "outset"],
    &["at", "the", "off"],
    &["to", "begin", "with"],
    &["to", "start", "with"],
    &["at", "first"],
    &["initially"],
    &["in", "the", "first", "frame"],
    &["on", "the", "first", "frame"],
];
/// Words between the clause of a first picture and what stands before it.
const JOINTS: [&str; 6] = [",", ".", ";", ":", "and", "but"];
/// Words of a picture.
const SEEN: [&str; 13] = [
    "middle", "center", "centre", "centered", "centred", "frame", "shot", "view", "picture", "edge", "visible", "see",
    "have",
];

/// Begins a travel or a turn to the side with the picture that the words give for the time when it sets off.
pub(crate) fn begin_as_set_off(linked: &Linked, steps: &mut [Step]) {
    let leads_aside = |step: &&mut Step| {
        matches!(
            step.movement,
            Move::TruckLeft | Move::TruckRight | Move::PedestalUp | Move::PedestalDown | Move::PanLeft | Move::PanRight
        )
    };
    for step in steps.iter_mut().filter(leads_aside) {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let Some(id) = seen_first(linked, &words) else { continue };
        let is_open = step.start.subjects.is_empty() && step.via.is_none();
        if is_open && linked.expanded(&step.end.subjects) == linked.expanded(&[id]) {
            step.start = Framing { height: step.start.height, ..std::mem::take(&mut step.end) };
        }
    }
}

/// The only thing that words name, in a clause that says when it is seen: at first.
fn seen_first(linked: &Linked, words: &[&str]) -> Option<u32> {
    let mut clauses = words.split(|word| JOINTS.contains(word));
    let of_first = clauses.find(|clause| {
        says_any(clause, &SETS_OFF)
            && clause.iter().any(|word| SEEN.contains(word))
            && clause.iter().any(|word| linked.slot_at(word).is_some())
    })?;
    let named = |words: &[&str]| words.iter().filter_map(|word| linked.slot_at(word)).collect::<Vec<_>>();
    match (&named(of_first)[..], &named(words)[..]) {
        ([id], [_]) => Some(*id),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::super::fixture::{about, linked};
    use super::*;

    fn ends(text: &str, movement: Move) -> (Vec<u32>, Vec<u32>) {
        let mut steps = [about(movement, &[5], [0, text.len()])];
        begin_as_set_off(&linked(text), &mut steps);
        let [step] = steps;
        (step.start.subjects, step.end.subjects)
    }

    #[test]
    fn what_is_seen_when_the_camera_sets_off_is_the_first_picture() {
        let first = (vec![5], vec![]);
        let text = "<qty-0> to the left would be grand , and have <obj-0> bang in the middle when we set off";
        assert_eq!(ends(text, Move::TruckLeft), first);
        assert_eq!(ends("truck right , at the start we have <obj-0> in frame", Move::TruckRight), first);
        assert_eq!(ends("pedestal up and to begin with <obj-0> is in the center", Move::PedestalUp), first);
    }

    #[test]
    fn what_is_seen_at_last_stays_last() {
        let last = (vec![], vec![5]);
        assert_eq!(ends("truck left until <obj-0> is in the middle", Move::TruckLeft), last);
        assert_eq!(ends("slow at the start , truck left until <obj-0> is in frame", Move::TruckLeft), last);
        assert_eq!(ends("at the start <obj-1> is in view , truck left to <obj-0>", Move::TruckLeft), last);
    }
}

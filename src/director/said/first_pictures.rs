//! First pictures that the words name without a verb: `the knives on the wall, the whole set in view; come down from there to the jar`.

use cinesplat_language::{Linked, is_listed};
use cinesplat_operator::{Framing, Step, SubjectPart};
use cinesplat_trajectory::{Move, ShotSize};

use super::briefs::is_camera_verb;

/// Marks that end a first picture.
const MARKS: [&str; 5] = [".", ";", ":", "!", "then"];
/// Words of what is seen, and of all of a thing.
const VIEWS: &str = "view frame shot picture sight visible";
const WHOLES: &str = "whole all entire full complete";
/// Words that deny, or name what is not seen.
const NOT: &str = "no not never without 't avoid";

/// Begins with what the words name before their first verb, where the first move leads on from there to something else.
pub(crate) fn begin_at_named(linked: &Linked, steps: &mut [Step]) {
    let Some(step) = steps.first_mut() else { return };
    let words = linked.texts_in([0, usize::MAX]);
    let Some(end) = words.iter().position(|word| MARKS.contains(word)) else { return };
    let (opening, rest) = words.split_at(end);
    let says = |list: &str| opening.iter().any(|word| is_listed(list, word));
    let leads_on = rest.windows(2).any(|pair| matches!(pair, ["from", "there" | "here"]));
    let is_picture = !(0..opening.len()).any(|at| opening[at] != "frame" && is_camera_verb(opening, at)) && !says(NOT);
    let Some(id) = opening.iter().take(3).find_map(|word| linked.slot_at(word)).filter(|_| is_picture) else { return };
    let ids = linked.expanded(&[id]);
    let is_own = step.words.is_some_and(|[from, _]| linked.spans.first().is_some_and(|first| from <= first[1]));
    let is_open = step.start.subjects.is_empty() && step.movement != Move::Static && step.via.is_none();
    let whole = says(WHOLES) && says(VIEWS);
    if is_own && linked.expanded(&step.start.subjects) == ids && step.start.size.is_none() {
        step.start.whole |= whole;
    }
    let is_other = !step.end.subjects.is_empty() && linked.expanded(&step.end.subjects) != ids;
    if is_own && is_open && is_other && (leads_on || says(VIEWS)) {
        // The size was read from the words that call it whole.
        let size = step.start.size.filter(|_| !whole);
        step.start = Framing { subjects: ids, whole, size, part: SubjectPart::Middle, ..step.start.clone() };
    }
}

/// Sizes of first pictures, by the words before `of`.
const SIZES: [(&[&str], ShotSize); 7] = [
    (&["extreme", "close-up"], ShotSize::ExtremeCloseUp),
    (&["close-up"], ShotSize::CloseUp),
    (&["close", "up"], ShotSize::CloseUp),
    (&["closeup"], ShotSize::CloseUp),
    (&["medium", "shot"], ShotSize::Medium),
    (&["wide", "shot"], ShotSize::Long),
    (&["long", "shot"], ShotSize::Long),
];

/// Begins with the size of the picture that the first words name, where a move about the same thing follows: `close-up of the bust, arc
/// left around it`.
pub(crate) fn size_named(linked: &Linked, steps: &mut [Step]) {
    let Some(step) = steps.first_mut().filter(|step| step.movement != Move::Static) else { return };
    let words = linked.texts_in([0, usize::MAX]);
    let from = words.iter().take_while(|word| is_listed("a an the tight nice slow", word)).count();
    let Some((phrase, size)) = SIZES.iter().find(|(phrase, _)| words[from..].starts_with(phrase)) else { return };
    let rest = &words[from + phrase.len()..];
    let (Some(&of), Some(&named)) = (rest.first(), rest.iter().skip(1).find(|word| **word != "the")) else { return };
    let named_at = rest.iter().position(|word| *word == named).unwrap_or_default();
    let is_ended = rest.get(named_at + 1).is_some_and(|word| matches!(*word, "," | "." | ";" | ":" | "then" | "first"));
    if !(matches!(of, "of" | "on") && is_ended) {
        return;
    }
    let is_of_it = |framing: &Framing| linked.stands_for(named, &framing.subjects);
    let is_sized = |framing: &Framing| framing.size.is_some() || framing.height_frac.is_some() || framing.whole;
    if is_of_it(&step.start) && !is_sized(&step.start) {
        step.start.size = Some(*size);
    } else if step.start == Framing::default() && is_of_it(&step.end) && !is_sized(&step.end) {
        step.start = Framing { subjects: step.end.subjects.clone(), size: Some(*size), ..Framing::default() };
    }
}

#[cfg(test)]
mod tests {
    use super::super::fixture::{about, linked};
    use super::*;

    #[test]
    fn the_size_of_the_first_picture_is_that_of_the_move_around_it() {
        let size = |text: &str| {
            let mut steps = [about(Move::ArcLeft, &[5], [0, text.len()])];
            size_named(&linked(text), &mut steps);
            steps[0].start.size
        };
        assert_eq!(size("close-up of <obj-0> , arc left around it"), Some(ShotSize::CloseUp));
        assert_eq!(size("wide shot of <obj-0> . arc left"), Some(ShotSize::Long));
        assert_eq!(size("close-up of <obj-1> , arc left around <obj-0>"), None);
        assert_eq!(size("close-up of <obj-0> and <obj-1> , arc left around it"), None);
    }

    fn start(text: &str) -> (Vec<u32>, bool) {
        let mut steps = [about(Move::CraneDown, &[7], [0, text.len()])];
        begin_at_named(&linked(text), &mut steps);
        (steps[0].start.subjects.clone(), steps[0].start.whole)
    }

    #[test]
    fn a_picture_that_is_named_first_is_the_first_one() {
        let text = "<obj-0> on the wall , the whole set in view ; come down from there and settle on <obj-1>";
        assert_eq!(start(text), (vec![5], true));
        assert_eq!(start("the <obj-0> . from there sink to <obj-1>"), (vec![5], false));
        assert_eq!(start("<obj-0> , all in frame . crane down to <obj-1>"), (vec![5], true));
    }

    #[test]
    fn what_is_named_with_a_verb_or_for_its_place_is_not() {
        let none = (vec![], false);
        assert_eq!(start("crane down past <obj-0> in view ; land on <obj-1>"), none);
        assert_eq!(start("<obj-0> not in view ; come down to <obj-1>"), none);
        assert_eq!(start("<obj-0> : come down to <obj-1>"), none);
        assert_eq!(start("<obj-1> in frame ; come down on it from there"), none);
    }
}

//! Moves that go on to another thing: `pan right from the easel to the palm and continue to the skull`.

use cinesplat_language::{Linked, is_listed};
use cinesplat_operator::{Framing, Pass, Step, Via};
use cinesplat_trajectory::{Move, ShotSize};

use super::briefs::is_camera_verb;
use crate::direction::Direction;

/// Words before what goes on, and what goes on.
const BEFORE: &str = "and then , ; to";
const GOES_ON: [&[&str]; 10] = [
    &["continue"],
    &["continues"],
    &["continuing"],
    &["carry", "on"],
    &["carries", "on"],
    &["carrying", "on"],
    &["keep", "going"],
    &["keeps", "going"],
    &["go", "on"],
    &["goes", "on"],
];
/// Words between it and the thing.
const WAYS: &str =
    "on onward onwards further farther down up left right over across along all the way in same direction";
const TO: &str = "to toward towards onto until till";

/// Makes a way to another thing the move before, where the words say that this one goes on.
pub(crate) fn go_on(linked: &Linked, steps: &mut [Step]) {
    for nth in 1..steps.len() {
        let before = &steps[nth - 1];
        let (movement, either_way) = (before.movement, before.either_way);
        // From where a look back ends, the way goes on that it interrupted.
        let goes_back = before.returns;
        let turns_or_slides = matches!(
            movement,
            Move::PanLeft
                | Move::PanRight
                | Move::TiltUp
                | Move::TiltDown
                | Move::TruckLeft
                | Move::TruckRight
                | Move::PedestalUp
                | Move::PedestalDown
        );
        let step = &mut steps[nth];
        let words = linked.texts_in(step.words.unwrap_or_default());
        let is_plain = step.via.is_none() && step.with.is_empty() && step.start.subjects.is_empty() && !step.cut;
        let is_way = matches!(step.movement, Move::Follow | Move::PushIn) && step.end.size.is_none();
        if turns_or_slides && !goes_back && is_plain && is_way && !step.end.subjects.is_empty() && goes_on(&words) {
            (step.movement, step.either_way) = (movement, either_way);
        }
    }
}

/// Slides on along something from what the step before shows on it: `hold on the vase, then track right along the sideboard to the
/// cactus` does not go back to the sideboard.
pub(crate) fn slide_on(steps: &mut [Step]) {
    for step in steps.iter_mut().skip(1).filter(|step| !step.cut && !step.end.subjects.is_empty()) {
        let slides = matches!(step.movement, Move::TruckLeft | Move::TruckRight);
        let along = step.via.as_ref().filter(|via| slides && via.how == Pass::Along);
        let begins_with = Framing { subjects: step.start.subjects.clone(), ..Framing::default() };
        if along.is_some_and(|via| via.objects == step.start.subjects) && step.start == begins_with {
            step.start = Framing::default();
        }
    }
}

/// Words of who only arrives where a turn leads.
const LANDS: &str = "land lands landing settle settles settling finish finishes finishing end ends ending stop stops stopping arrive arrives \
    arriving come comes";

/// Words before what is passed on the way there.
const PAST: &str = "past by over across via the";

/// Joins a turn or a slide with its arrival, where that is a second one to the same thing: `pan left off the tv, past the armchair, and
/// land on the curtain`.
pub(crate) fn join_arrivals(linked: &Linked, steps: &mut Vec<Step>) {
    let passed = |step: &Step| -> Vec<u32> {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let is_past = |at: &usize| words[..*at].iter().rev().find(|word| **word != "the") == Some(&"past");
        let passed: Vec<u32> = (0..words.len()).filter(is_past).filter_map(|at| linked.slot_at(words[at])).collect();
        linked.expanded(&passed)
    };
    let arrives = |before: &Step, step: &Step| {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let is_before =
            |word: &&str| is_listed(BEFORE, word) || is_listed(PAST, word) || linked.slot_at(word).is_some();
        let mut said = words.iter().copied().skip_while(is_before);
        let lands = said.next().is_some_and(|word| is_listed(LANDS, word))
            || step.words == before.words && words.iter().any(|word| is_listed(LANDS, word));
        let plain = Step {
            words: step.words,
            end: before.end.clone(),
            either_way: step.either_way,
            ..Step::of(before.movement)
        };
        let is_plain = *step == plain && !step.end.subjects.is_empty();
        let turns = matches!(
            step.movement,
            Move::PanLeft | Move::PanRight | Move::TiltUp | Move::TiltDown | Move::TruckLeft | Move::TruckRight
        );
        turns && is_plain && !before.returns && lands
    };
    let mut nth = 1;
    while nth < steps.len() {
        if arrives(&steps[nth - 1], &steps[nth]) {
            let arrival = steps.remove(nth);
            let mut passed = passed(&arrival);
            passed.retain(|id| !arrival.end.subjects.contains(id) && !steps[nth - 1].start.subjects.contains(id));
            if !passed.is_empty() && steps[nth - 1].via.is_none() {
                steps[nth - 1].via = Some(Via { how: Pass::Past, objects: passed });
            }
            if let (Some(own), Some(words)) = (steps[nth - 1].words.as_mut(), arrival.words) {
                own[1] = own[1].max(words[1]);
            }
        } else {
            nth += 1;
        }
    }
}

/// Ends a move on the picture that its words finish on: `crane up and back over the desk and finish on a high wide shot of the desk with the
/// chair`, of which the network makes a way of its own.
pub(crate) fn finish_on_picture(linked: &Linked, direction: &mut Direction) {
    direction.join_pairs(|first, second| {
        let ([_, to], [_, end]) = (first.words?, second.words?);
        let words = linked.texts_in([to, end]);
        let lands = words.iter().find(|word| !is_listed(BEFORE, word)).is_some_and(|word| is_listed(LANDS, word));
        let opens = matches!(first.movement, Move::PullOut | Move::ZoomOut | Move::CraneUp | Move::PedestalUp);
        let is_wide = second.end.whole
            || matches!(second.end.size, Some(ShotSize::MediumLong | ShotSize::Long | ShotSize::ExtremeLong));
        let shows = !second.end.subjects.is_empty()
            && first.end.subjects.iter().all(|id| second.end.subjects.contains(id))
            && first.end.size.is_none();
        let end = Framing { angle: second.end.angle.or(first.end.angle), ..second.end.clone() };
        let plain = Step { words: second.words, end: second.end.clone(), ..Step::of(second.movement) };
        let is_plain = *second == plain && matches!(second.movement, Move::Follow | Move::Static);
        (lands && opens && is_wide && shows && is_plain && !first.returns).then(|| Step {
            end,
            words: first.joint_words(second),
            ..first.clone()
        })
    });
}

/// Most words between the joint and where a rise leads.
const LEADS_WITHIN: usize = 3;

/// Makes one rise of two in a row where the words of the second are only where the first one leads: `crane up from the height of the bench
/// to up near the ceiling`.
pub(crate) fn join_rises(linked: &Linked, direction: &mut Direction) {
    direction.join_pairs(|first, second| {
        let rises = |step: &Step| matches!(step.movement, Move::CraneUp | Move::PedestalUp);
        let words = linked.texts_in(second.words?);
        let leads = words.iter().take(LEADS_WITHIN).any(|word| is_listed("from to up until till", word))
            && !(0..words.len().min(LEADS_WITHIN)).any(|at| is_camera_verb(&words, at) || words[at] == "then");
        // `From the height of the bench` is where it begins.
        let height = Framing { height: second.start.height, ..Framing::default() };
        let is_plain = second.with.is_empty()
            && second.via.is_none()
            && second.start == height
            && second.end.subjects.is_empty()
            && second.duration_secs.is_none()
            && !second.cut;
        let is_open = first.end.angle.is_none() && first.end.size.is_none() && first.duration_secs.is_none();
        let begins = first.start == Framing::default() && second.start.height.is_some();
        let start =
            if begins { Framing { subjects: first.end.subjects.clone(), ..height } } else { first.start.clone() };
        (rises(first) && rises(second) && leads && is_plain && is_open).then(|| Step {
            start,
            end: Framing { angle: second.end.angle, height: second.end.height, ..first.end.clone() },
            words: first.joint_words(second),
            ..first.clone()
        })
    });
}

/// Drops steps of which the words are but a mark and that only repeat the step before, or rest.
pub(crate) fn drop_wordless(linked: &Linked, steps: &mut Vec<Step>) {
    let mut nth = 1;
    while nth < steps.len() {
        let words = linked.texts_in(steps[nth].words.unwrap_or_default());
        let is_mark = !words.is_empty() && words.iter().all(|word| !word.chars().any(char::is_alphanumeric));
        let (before, step) = (&steps[nth - 1], &steps[nth]);
        let is_same = step.movement == before.movement && step.via == before.via;
        let is_rest = *step == Step { words: step.words, ..Step::of(Move::Static) };
        if is_mark && (is_same || is_rest) {
            let step = steps.remove(nth);
            if steps[nth - 1].end.subjects.is_empty() {
                steps[nth - 1].end = step.end;
            }
        } else {
            nth += 1;
        }
    }
}

/// Whether words say that a move goes on to a thing.
fn goes_on(words: &[&str]) -> bool {
    let from = words.iter().take_while(|word| is_listed(BEFORE, word)).count();
    let Some(phrase) = GOES_ON.iter().find(|phrase| words[from..].starts_with(phrase)) else { return false };
    let rest = &words[from + phrase.len()..];
    let ways = rest.iter().take_while(|word| is_listed(WAYS, word)).count();
    rest.get(ways).is_some_and(|word| is_listed(TO, word))
}

#[cfg(test)]
mod tests {
    use super::super::fixture::{about, direction, linked};
    use super::*;
    use cinesplat_trajectory::ShotAngle;

    fn second(first: Move, text: &str) -> Move {
        let at = text.find(" and").unwrap();
        let mut steps = [about(first, &[5], [0, at]), about(Move::Follow, &[7], [at + 1, text.len()])];
        go_on(&linked(text), &mut steps);
        steps[1].movement
    }

    #[test]
    fn where_a_rise_leads_is_no_further_rise() {
        let count = |text: &str| {
            let at = text.find(" up near").unwrap_or_else(|| text.find(" then").unwrap());
            let mut second = about(Move::CraneUp, &[], [at + 1, text.len()]);
            second.end.angle = Some(ShotAngle::High);
            let mut direction = direction(vec![about(Move::CraneUp, &[5], [0, at]), second]);
            join_rises(&linked(text), &mut direction);
            (direction.program.steps.len(), direction.program.steps[0].end.angle)
        };
        assert_eq!(count("crane up at <obj-0> to up near the ceiling"), (1, Some(ShotAngle::High)));
        assert_eq!(count("crane up at <obj-0> then crane up high").0, 2);
    }

    #[test]
    fn a_rise_that_finishes_on_a_wide_shot_is_one_move() {
        let read = |text: &str, movement: Move| {
            let at = text.find(" and").unwrap();
            let mut last = about(Move::Follow, &[5, 7], [at + 4, text.len()]);
            last.end.whole = true;
            let mut direction = direction(vec![about(movement, &[5], [0, at]), last]);
            finish_on_picture(&linked(text), &mut direction);
            let steps = direction.program.steps;
            (steps.len(), steps[0].end.subjects.clone())
        };
        let text = "crane up over <obj-0> and finish on a wide shot of <obj-0> with <obj-1>";
        assert_eq!(read(text, Move::CraneUp), (1, vec![5, 7]));
        assert_eq!(read(text, Move::PushIn).0, 2, "a way in ends nearer");
        assert_eq!(read("crane up over <obj-0> and walk on to <obj-0> and <obj-1>", Move::CraneUp).0, 2);
    }

    #[test]
    fn a_slide_along_a_table_begins_with_what_is_shown_on_it() {
        let text = "hold on <obj-1> and track right along <obj-0>";
        let slide = |start: &[u32]| {
            let mut slide = about(Move::TruckRight, &[9], [16, text.len()]);
            slide.start.subjects = start.to_vec();
            slide.via = Some(Via { how: Pass::Along, objects: vec![5] });
            let mut steps = [about(Move::Static, &[7], [0, 15]), slide];
            slide_on(&mut steps);
            steps[1].start.subjects.clone()
        };
        assert_eq!(slide(&[5]), [0; 0]);
        assert_eq!(slide(&[7]), [7]);
    }

    #[test]
    fn a_turn_arrives_once() {
        let text = "pan left off <obj-0> , past <obj-1> , and land on <obj-0>";
        let steps = |second: [usize; 2]| {
            let mut steps = vec![about(Move::PanLeft, &[9], [0, 20]), about(Move::PanLeft, &[9], second)];
            join_arrivals(&linked(text), &mut steps);
            steps
        };
        assert_eq!(steps([0, text.len()]).len(), 2);
        let joined = steps([21, text.len()]);
        assert_eq!((joined.len(), joined[0].via.clone()), (1, Some(Via { how: Pass::Past, objects: vec![7] })));
        assert_eq!(steps([0, 20]).len(), 2);
    }

    #[test]
    fn a_move_goes_on_to_another_thing() {
        assert_eq!(second(Move::PanRight, "pan right to <obj-0> and continue to <obj-1>"), Move::PanRight);
        assert_eq!(second(Move::TiltDown, "tilt down <obj-0> and carry on down to <obj-1>"), Move::TiltDown);
        assert_eq!(second(Move::PanRight, "pan right to <obj-0> and go to <obj-1>"), Move::Follow);
        assert_eq!(second(Move::PushIn, "push in on <obj-0> and continue to <obj-1>"), Move::Follow);
    }
}

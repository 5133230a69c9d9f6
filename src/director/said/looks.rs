//! How the words say that a picture looks: `symmetrical in frame`, `both seen from above`, `the table with all that lies on it`, `roll
//! over 15 degrees`.

use cinesplat_language::{Linked, is_listed};
use cinesplat_operator::{Amount, FramePlace, Framing, Step, SubjectSide};
use cinesplat_trajectory::{Move, ShotAngle};

use super::directions::is_form;

/// Words of a picture that is the same on both sides.
const SYMMETRIC: &str = "symmetrical symmetric symmetry symmetrically";

/// Sees its subject from the front where the picture is to be symmetrical.
pub(crate) fn face_symmetric(linked: &Linked, steps: &mut [Step]) {
    for step in steps.iter_mut().filter(|step| !step.movement.is_circular()) {
        let words = linked.texts_in(step.words.unwrap_or_default());
        if step.end.side == Some(SubjectSide::FromFront) && step.end.place == Some(FramePlace::AtCenter) {
            level_view(step);
        }
        let at = words.iter().position(|word| is_listed(SYMMETRIC, word));
        let Some(at) = at.filter(|_| step.end.side.is_none() && !step.end.subjects.is_empty()) else { continue };
        step.end.side = Some(SubjectSide::FromFront);
        level_view(step);
        // The thing that the words call so is the first one.
        let named = words[..at].iter().rev().take(3).find_map(|word| linked.slot_at(word));
        if let Some(id) = named.map(|id| linked.expanded(&[id])).filter(|ids| ids.len() == 1).map(|ids| ids[0])
            && let Some(place) = linked.expanded(&step.end.subjects).iter().position(|own| *own == id)
        {
            let mut subjects = linked.expanded(&step.end.subjects);
            subjects.swap(0, place);
            step.end.subjects = subjects;
        }
    }
}

/// Looks level at what is symmetrical, where the words leave that open: from above its uprights would lean.
fn level_view(step: &mut Step) {
    let is_open = step.end.angle.is_none() && step.end.height.is_none() && step.end.elevation_deg.is_none();
    let keeps = matches!(step.movement, Move::PushIn | Move::PullOut | Move::Static | Move::ZoomIn | Move::ZoomOut);
    if is_open && keeps {
        step.end.angle = Some(ShotAngle::EyeLevel);
    }
}

/// Shows what a step is about, whatever was read as avoided: nothing is hidden in its own picture.
pub(crate) fn show_subjects(linked: &Linked, steps: &mut [Step]) {
    for step in steps {
        let shown = linked.expanded(&[&step.start.subjects[..], &step.end.subjects[..]].concat());
        if !step.end.hidden && !step.start.hidden {
            step.avoid.retain(|id| !linked.expanded(&[*id]).iter().any(|id| shown.contains(id)));
        }
    }
}

/// Rolls a picture at rest whose words roll the camera by an angle: `look at the bed and slowly roll over 15 degrees`.
pub(crate) fn roll_as_said(linked: &Linked, steps: &mut [Step]) {
    for step in steps.iter_mut().filter(|step| step.movement == Move::Static && step.with.is_empty()) {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let rolls = words.iter().any(|word| is_form(word, "roll"));
        if rolls && matches!(step.amount, Some(Amount::Degrees(_))) {
            let says = |list: &str| words.iter().any(|word| is_listed(list, word));
            let (left, right) = (says("left anticlockwise counterclockwise"), says("right clockwise"));
            step.movement = if left && !right { Move::RollCcw } else { Move::RollCw };
            step.either_way = left == right;
        }
    }
}

/// Rolls the horizon back by the angle by which it was rolled before: `roll 15 degrees left, then undo it`.
pub(crate) fn roll_back(linked: &Linked, steps: &mut Vec<Step>) {
    let rolled = |step: &Step| {
        let moves = std::iter::once(&step.movement).chain(&step.with);
        moves.copied().find(|movement| matches!(movement, Move::RollCw | Move::RollCcw))
    };
    let undoes = |words: &[&str]| words.windows(2).any(|pair| matches!(pair, ["undo" | "undoing", "it"]));
    let Some(first) = steps.iter().position(|step| rolled(step).is_some()) else { return };
    let Some(back) = rolled(&steps[first]).map(|roll| if roll == Move::RollCw { Move::RollCcw } else { Move::RollCw })
    else {
        return;
    };
    let amount = steps[first].amount;
    let says = |step: &Step| undoes(&linked.texts_in(step.words.unwrap_or_default()));
    let Some(nth) = steps.iter().position(says) else { return };
    let is_back = nth > first && matches!(steps[nth].movement, Move::RollCw | Move::RollCcw | Move::Static);
    if is_back {
        let step = &mut steps[nth];
        (step.movement, step.amount, step.returns, step.either_way) = (back, amount, false, false);
    } else if steps[first + 1..].iter().all(|step| rolled(step).is_none()) {
        let undone = Step { amount, words: steps[first].words, ..Step::of(back) };
        steps.insert(first + 1, undone);
    }
}

/// Rests on what a travel begins and ends with: there is no way between.
pub(crate) fn rest_where_nothing_leads(steps: &mut [Step]) {
    for step in steps.iter_mut().filter(|step| step.movement == Move::Follow && step.via.is_none()) {
        let plain = Framing { subjects: step.end.subjects.clone(), ..Framing::default() };
        let is_there = step.start == plain && step.end == plain && !plain.subjects.is_empty();
        if is_there && step.with.is_empty() && step.look.is_none() && !step.returns {
            (step.movement, step.start) = (Move::Static, Framing::default());
        }
    }
}

/// Goes nearer or back where a picture at rest has two sizes of its subject: `t0: 25 % of frame height; t_end: 60 %`.
pub(crate) fn lead_between_sizes(steps: &mut [Step]) {
    for step in steps.iter_mut().filter(|step| step.movement == Move::Static && step.with.is_empty()) {
        let (Some(from), Some(to)) = (step.start.height_frac, step.end.height_frac) else { continue };
        let is_one = step.start.subjects.is_empty() || step.start.subjects == step.end.subjects;
        if is_one && !step.end.subjects.is_empty() && (from - to).abs() > 1e-6 {
            step.start.subjects.clone_from(&step.end.subjects);
            step.movement = if to > from { Move::PushIn } else { Move::PullOut };
        }
    }
}

/// Looks down at last where a rise ends on what is seen from above: `then lift so both are seen together from above`.
pub(crate) fn look_down_from_above(linked: &Linked, steps: &mut [Step]) {
    for step in steps.iter_mut().filter(|step| matches!(step.movement, Move::PedestalUp | Move::CraneUp)) {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let is_open = step.end.angle.is_none() && step.end.elevation_deg.is_none() && !step.end.subjects.is_empty();
        if is_open && words.windows(2).any(|pair| matches!(pair, ["from", "above" | "overhead"])) {
            (step.movement, step.end.angle) = (Move::CraneUp, Some(ShotAngle::High));
        }
    }
}

/// Backs away from what was seen where that is how something is revealed: `reveal the plates beside it by backing away`.
pub(crate) fn reveal_by_leaving(linked: &Linked, steps: &mut [Step]) {
    for nth in 0..steps.len() {
        let before = nth.checked_sub(1).map(|before| steps[before].end.subjects.clone()).unwrap_or_default();
        let step = &mut steps[nth];
        let words = linked.texts_in(step.words.unwrap_or_default());
        let leaves = |at: usize| {
            matches!(words.get(at + 1), Some(&"back" | &"away" | &"out" | &"off"))
                && ["back", "pull", "move", "draw", "dolly", "step"].iter().any(|verb| is_form(words[at], verb))
        };
        let is_by = (1..words.len()).any(|at| leaves(at) && matches!(words[at - 1], "by" | "while" | "as"));
        if step.movement == Move::Reveal && is_by && step.via.is_none() && !step.end.subjects.is_empty() {
            let shown = if step.start.subjects.is_empty() { before } else { step.start.subjects.clone() };
            let mut subjects = step.end.subjects.clone();
            subjects.extend(shown.into_iter().filter(|id| !step.end.subjects.contains(id)).collect::<Vec<_>>());
            (step.movement, step.with) = (Move::PullOut, Vec::new());
            (step.end.subjects, step.end.whole) = (subjects, true);
        }
    }
}

/// Shows all of what bears the things that are listed with everything on it, and not these alone: `the table with the bread, the books
/// and all that lies on it`.
pub(crate) fn show_bearer(linked: &Linked, steps: &mut [Step]) {
    for step in steps {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let is_all = |at: usize| {
            is_listed("all everything rest anything", words[at])
                && words[at..]
                    .iter()
                    .take(8)
                    .collect::<Vec<_>>()
                    .windows(2)
                    .any(|pair| *pair[0] == "on" && matches!(*pair[1], "it" | "top" | "there"))
        };
        let Some(all) = (0..words.len()).find(|at| is_all(*at)) else { continue };
        let Some(with) = words[..all].iter().position(|word| matches!(*word, "with" | "including")) else { continue };
        let Some(bearer) = words[..with].iter().rev().find_map(|word| linked.slot_at(word)) else { continue };
        let ids = linked.expanded(&[bearer]);
        let listed: Vec<u32> = words[with..all].iter().filter_map(|word| linked.slot_at(word)).collect();
        let listed = linked.expanded(&listed);
        let shown = linked.expanded(&step.end.subjects);
        let is_of_list = !shown.is_empty() && shown.iter().all(|id| ids.contains(id) || listed.contains(id));
        if ids.len() == 1 && is_of_list && shown != ids {
            step.end.subjects.clone_from(&ids);
            step.end.whole = true;
            if !step.start.subjects.is_empty()
                && linked.expanded(&step.start.subjects).iter().all(|id| listed.contains(id))
            {
                step.start.subjects = ids;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::fixture::{about, linked};
    use super::*;

    #[test]
    fn a_symmetrical_picture_is_seen_from_the_front() {
        let text = "pull back until <obj-1> is symmetrical in frame with <obj-0>";
        let mut steps = [about(Move::PullOut, &[5, 7], [0, text.len()])];
        face_symmetric(&linked(text), &mut steps);
        assert_eq!((steps[0].end.side, &steps[0].end.subjects[..]), (Some(SubjectSide::FromFront), &[7, 5][..]));
    }

    #[test]
    fn nothing_is_hidden_in_its_own_picture() {
        let mut steps = [Step { avoid: vec![5, 9], ..about(Move::Static, &[5], [0, 1]) }];
        show_subjects(&linked("hold"), &mut steps);
        assert_eq!(steps[0].avoid, [9]);
    }

    #[test]
    fn a_camera_that_is_rolled_does_not_rest() {
        let text = "look at <obj-0> and slowly roll the camera <qty-0>";
        let held = Step { amount: Some(Amount::Degrees(15.0)), ..about(Move::Static, &[5], [0, text.len()]) };
        let mut steps = [held];
        roll_as_said(&linked(text), &mut steps);
        assert_eq!((steps[0].movement, steps[0].either_way), (Move::RollCw, true));
    }

    #[test]
    fn a_way_from_a_thing_to_itself_is_a_rest() {
        let start = Framing { subjects: vec![5], ..Framing::default() };
        let mut steps = [Step { start, ..about(Move::Follow, &[5], [0, 1]) }];
        rest_where_nothing_leads(&mut steps);
        assert_eq!(steps[0].movement, Move::Static);
    }

    #[test]
    fn what_is_seen_from_above_is_looked_down_on() {
        let text = "then lift so <obj-0> are seen from above";
        let mut steps = [about(Move::PedestalUp, &[5], [0, text.len()])];
        look_down_from_above(&linked(text), &mut steps);
        assert_eq!((steps[0].movement, steps[0].end.angle), (Move::CraneUp, Some(ShotAngle::High)));
    }

    #[test]
    fn a_table_with_all_that_is_on_it_is_the_table() {
        let shown = |text: &str| {
            let mut steps = [about(Move::PedestalUp, &[5, 7], [0, text.len()])];
            show_bearer(&linked(text), &mut steps);
            steps[0].end.subjects.clone()
        };
        assert_eq!(shown("view of <obj-0> with <obj-1> and all that lies on it in the picture"), [5]);
        assert_eq!(shown("view of <obj-0> with <obj-1>"), [5, 7]);
    }

    #[test]
    fn what_is_revealed_by_backing_away_is_pulled_back_to() {
        let text = "open on <obj-0> , then reveal <obj-1> beside it by backing away";
        let mut steps = [about(Move::Static, &[5], [0, 15]), about(Move::Reveal, &[7], [17, text.len()])];
        reveal_by_leaving(&linked(text), &mut steps);
        assert_eq!((steps[1].movement, &steps[1].end.subjects[..]), (Move::PullOut, &[7, 5][..]));
    }

    #[test]
    fn a_horizon_is_rolled_back_by_as_much() {
        let text = "roll left <qty-0> on <obj-0> , undo it , and pull back";
        let roll = Step { amount: Some(Amount::Degrees(15.0)), ..about(Move::RollCcw, &[5], [0, 27]) };
        let back = |second: Step| {
            let mut steps = vec![roll.clone(), second];
            roll_back(&linked(text), &mut steps);
            (steps.len(), steps[1].movement, steps[1].amount)
        };
        let undone = Some(Amount::Degrees(15.0));
        assert_eq!(back(about(Move::RollCcw, &[5], [28, 39])), (2, Move::RollCw, undone));
        assert_eq!(back(about(Move::PullOut, &[5], [28, text.len()])), (3, Move::RollCw, undone));
        assert_eq!(back(about(Move::PullOut, &[5], [42, text.len()])).0, 2);
    }
}

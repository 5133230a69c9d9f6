//! What clauses beside a move say of how the camera is, and no move of their own: `lens just above the tabletop`, `camera at half of
//! the neck`, `hold that two seconds`, `until the bed is symmetrical in frame`, `creep in ten percent`.

use cinesplat_language::{Linked, QuantityKind, is_listed};
use cinesplat_operator::{Amount, Framing, Step, SubjectSide};
use cinesplat_trajectory::{Move, ShotAngle};

use super::briefs::is_camera_verb;
use super::directions::is_form;
use super::open::as_orbit;
use crate::direction::Direction;

/// What is at a height, and words by which it is.
const CAMERAS: &str = "lens camera cam";
const LEVELS: &str = "at above level below over around about just a touch bit slightly little inch hair half of the same height as with \
    is in line well";

/// Takes a clause about the height of the camera for no move, and what it names for no subject.
pub(crate) fn drop_camera_heights(linked: &Linked, direction: &mut Direction) {
    for nth in (0..direction.program.steps.len()).rev() {
        let num_steps = direction.program.steps.len();
        let step = &direction.program.steps[nth];
        let words = linked.texts_in(step.words.unwrap_or_default());
        let Some((at, ids)) = height_clause(linked, &words) else { continue };
        let first = words.iter().position(|word| !matches!(*word, "," | "and" | "." | "the" | "with"));
        let is_bare = step.duration_secs.is_none() && step.amount.is_none() && !step.cut;
        if first == Some(at) && num_steps > 1 && is_bare {
            direction.remove_step(nth);
            continue;
        }
        let step = &mut direction.program.steps[nth];
        let named = words[..at].iter().find_map(|word| linked.slot_at(word)).map(|id| linked.expanded(&[id]));
        let circles = matches!(as_orbit(step.movement), Move::OrbitLeft | Move::OrbitRight);
        if let Some(named) =
            named.filter(|named| circles && linked.expanded(&step.end.subjects) == ids && *named != ids)
        {
            step.end.subjects = named;
        }
    }
}

/// A clause about the camera's height at its end, without a verb of a move: its first word, and the things that it names.
fn height_clause(linked: &Linked, words: &[&str]) -> Option<(usize, Vec<u32>)> {
    let clause = |at: usize| {
        let begins = at == 0 || matches!(words[at - 1], "," | "and" | "." | "the" | "with");
        let thing = (at + 1..words.len()).find(|at| !is_listed(LEVELS, words[*at]))?;
        let id = linked.slot_at(words[thing])?;
        let is_end = words.get(thing + 1).is_none_or(|word| matches!(*word, "." | "," | ";" | "!"));
        (begins && is_listed(CAMERAS, words[at]) && thing > at + 1 && is_end).then(|| (at, linked.expanded(&[id])))
    };
    let at = (0..words.len()).find_map(clause)?;
    (!(at.0..words.len()).any(|nth| is_camera_verb(words, nth))).then_some(at)
}

/// Keeps the picture that is there where the words only hold it: `hold that two seconds`.
pub(crate) fn hold_what_is_there(linked: &Linked, steps: &mut [Step]) {
    for nth in 1..steps.len() {
        let before = linked.expanded(&steps[nth - 1].end.subjects);
        let step = &mut steps[nth];
        let words = linked.texts_in(step.words.unwrap_or_default());
        let holds =
            words.iter().take(3).any(|word| is_form(word, "hold") || is_form(word, "keep") || is_form(word, "stay"))
                && words.iter().take(4).any(|word| is_listed("that it there this", word));
        let names = words.iter().any(|word| linked.slot_at(word).is_some());
        let is_part = linked.expanded(&step.end.subjects).iter().all(|id| before.contains(id));
        let is_same = step.end == Framing { subjects: step.end.subjects.clone(), ..Framing::default() }
            && linked.expanded(&step.end.subjects) == before;
        if holds && !names && is_part && !is_same && step.movement == Move::Static && step.duration_secs.is_some() {
            step.end = Framing::default();
        }
    }
}

/// Words of a picture that is the same on both sides.
const SYMMETRIC: &str = "symmetrical symmetric symmetry symmetrically";

/// Sees its subject from the front where the picture is to be symmetrical.
pub(crate) fn face_symmetric(linked: &Linked, steps: &mut [Step]) {
    for step in steps.iter_mut().filter(|step| !matches!(as_orbit(step.movement), Move::OrbitLeft | Move::OrbitRight)) {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let at = words.iter().position(|word| is_listed(SYMMETRIC, word));
        let Some(at) = at.filter(|_| step.end.side.is_none() && !step.end.subjects.is_empty()) else { continue };
        step.end.side = Some(SubjectSide::FromFront);
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

/// Goes in or out by a share of the way, which is no size of the subject: `creep in ten percent`.
pub(crate) fn move_by_share(linked: &Linked, steps: &mut [Step]) {
    for step in steps
        .iter_mut()
        .filter(|step| matches!(step.movement, Move::PushIn | Move::PullOut | Move::ZoomIn | Move::ZoomOut))
    {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let share = |at: usize| {
            let quantity = linked.quantity_at(words[at]).filter(|quantity| quantity.kind == QuantityKind::Percent)?;
            let by = words[..at].iter().rev().find(|word| !is_listed("by about roughly maybe just only", word))?;
            let is_last = words.get(at + 1).is_none_or(|word| !is_listed("of full high", word));
            (is_listed("in out closer nearer back forward", by) && is_last).then_some(quantity.value / 100.0)
        };
        let Some(frac) = (0..words.len()).find_map(share) else { continue };
        if step.end.height_frac.is_none_or(|own| (own - frac).abs() < 1e-6) && step.amount.is_none() {
            let nears = matches!(step.movement, Move::PushIn | Move::ZoomIn);
            step.end.height_frac = None;
            step.amount = Some(Amount::Factor(if nears { 1.0 - frac } else { 1.0 + frac }));
        }
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

/// Light and what it comes from.
const LIGHTS: &str = "light sunlight daylight sun glow sunshine moonlight";

/// Takes light that comes from something for no picture of that: `golden light from the windows`.
pub(crate) fn drop_light(linked: &Linked, direction: &mut Direction) {
    for nth in (0..direction.program.steps.len()).rev() {
        let num_steps = direction.program.steps.len();
        let step = &direction.program.steps[nth];
        let words = linked.texts_in(step.words.unwrap_or_default());
        let lights = |at: usize| {
            let leads = matches!(words.get(at + 1), Some(&"from" | &"through")) && is_listed(LIGHTS, words[at]);
            leads && words[at + 1..].iter().take(3).any(|word| linked.slot_at(word).is_some())
        };
        let is_picture = step.movement == Move::Static && step.duration_secs.is_none() && words.len() < 9;
        if num_steps > 1
            && is_picture
            && (0..words.len()).any(lights)
            && !(0..words.len()).any(|at| is_camera_verb(&words, at))
        {
            direction.remove_step(nth);
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
    use super::super::fixture::{direction, linked};
    use super::*;
    use cinesplat_language::Quantity;

    fn about(movement: Move, ids: &[u32], words: [usize; 2]) -> Step {
        let end = Framing { subjects: ids.to_vec(), ..Framing::default() };
        Step { end, words: Some(words), ..Step::of(movement) }
    }

    #[test]
    fn the_height_of_a_camera_is_no_move() {
        let left = |text: &str, comma: usize| {
            let steps = vec![about(Move::PushIn, &[5], [0, comma]), about(Move::FlyThrough, &[7], [comma, text.len()])];
            let mut direction = direction(steps);
            drop_camera_heights(&linked(text), &mut direction);
            direction.program.steps.len()
        };
        assert_eq!(left("push on <obj-0> , lens just above <obj-1> .", 15), 1);
        assert_eq!(left("push on <obj-0> , camera moves over <obj-1> .", 15), 2);
        let text = "rotate around <obj-0> , camera at half of <obj-1> .";
        let mut direction = direction(vec![about(Move::ArcRight, &[7], [0, text.len()])]);
        drop_camera_heights(&linked(text), &mut direction);
        assert_eq!(direction.program.steps[0].end.subjects, [5]);
    }

    #[test]
    fn who_holds_that_keeps_the_picture() {
        let text = "pull back from <obj-0> . hold that <qty-0>";
        let held = Step { duration_secs: Some(2.0), ..about(Move::Static, &[5], [25, text.len()]) };
        let mut steps = [about(Move::PullOut, &[5, 7], [0, 24]), held];
        hold_what_is_there(&linked(text), &mut steps);
        assert_eq!(steps[1].end, Framing::default());
    }

    #[test]
    fn a_symmetrical_picture_is_seen_from_the_front() {
        let text = "pull back until <obj-1> is symmetrical in frame with <obj-0>";
        let mut steps = [about(Move::PullOut, &[5, 7], [0, text.len()])];
        face_symmetric(&linked(text), &mut steps);
        assert_eq!((steps[0].end.side, &steps[0].end.subjects[..]), (Some(SubjectSide::FromFront), &[7, 5][..]));
    }

    #[test]
    fn a_share_of_the_way_is_no_size() {
        let amount = |text: &str| {
            let ten = Quantity { kind: QuantityKind::Percent, value: 10.0 };
            let linked = Linked { quantities: vec![ten], ..linked(text) };
            let mut steps = [about(Move::PushIn, &[5], [0, text.len()])];
            steps[0].end.height_frac = Some(0.1);
            move_by_share(&linked, &mut steps);
            (steps[0].amount, steps[0].end.height_frac)
        };
        assert_eq!(amount("on <obj-0> , creep in <qty-0> over"), (Some(Amount::Factor(0.9)), None));
        assert_eq!(amount("push in until it takes <qty-0> of the frame"), (None, Some(0.1)));
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
    fn light_from_a_window_is_no_picture_of_it() {
        let text = "push in on <obj-0> , golden light from <obj-1>";
        let steps = vec![about(Move::PushIn, &[5], [0, 18]), about(Move::Static, &[7], [20, text.len()])];
        let mut direction = direction(steps);
        drop_light(&linked(text), &mut direction);
        assert_eq!(direction.program.steps.len(), 1);
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
}

//! Ways into a room: `come in from the grey door, walk up to the table`. Who comes in at a door stands there first and looks
//! into the room.

use cinesplat_language::{Linked, is_listed};
use cinesplat_objects::Object;
use cinesplat_operator::{Framing, Pass, Step, Via};
use cinesplat_trajectory::{Move, ShotSize};

use super::called::is_called;
use super::directions::is_form;
use crate::direction::Direction;

/// What one comes in by.
const DOORS: &str = "door doors doorway entrance gate archway arch hatch";
/// Verbs of somebody who comes in, and words between the verb and the door.
const ENTERS: [&str; 10] = ["come", "enter", "walk", "step", "go", "move", "glide", "fly", "drift", "float"];
const INTO: &str = "in inside into through from";

/// Words by which a door is what the first picture shows.
const LOOKS: &str =
    "show shows showing see seeing view views picture frame framed focus on of tight wide shot pan tilt turn up";

/// Begins at the door by which the words come in what the next step does.
pub(crate) fn come_in_at_doors(linked: &Linked, objects: &[Object], direction: &mut Direction) {
    if let Some(first) = direction.program.steps.first_mut() {
        leave_door(linked, objects, first);
    }
    let mut nth = 1;
    while nth < direction.program.steps.len() {
        let [first, second] = &direction.program.steps[nth - 1..=nth] else { break };
        match entered(linked, objects, first, second) {
            Some(one) => direction.join_steps(nth, one),
            None => nth += 1,
        }
    }
}

/// Begins a way at the door from which the words lead, which is behind the camera then: `glide from the door to the sofa`.
fn leave_door(linked: &Linked, objects: &[Object], step: &mut Step) {
    let goes = matches!(step.movement, Move::PushIn | Move::Follow | Move::FlyThrough) && step.with.is_empty();
    let door = &step.start.subjects;
    let is_door = !door.is_empty() && door.iter().all(|id| is_called(objects, *id, DOORS));
    let passes = step.via.as_ref().is_some_and(|via| via.objects.iter().any(|id| !door.contains(id)));
    let ends = !step.end.subjects.is_empty() && !step.end.subjects.iter().any(|id| door.contains(id));
    let words = linked.texts_in(step.words.unwrap_or_default());
    let Some(at) = words.iter().position(|word| linked.slot_at(word).is_some_and(|id| linked.expanded(&[id]) == *door))
    else {
        return;
    };
    let before = &words[at.saturating_sub(4)..at];
    let leads = before.iter().any(|word| is_listed("from at by in inside near beside", word));
    let looks =
        words[..at].iter().any(|word| is_listed(LOOKS, word) || is_form(word, "look") || is_form(word, "close"));
    // `With the full room on show` is what there is to see from it.
    let size = step.start.size.filter(|size| *size == ShotSize::Long);
    let is_plain = step.start == Framing { subjects: door.clone(), size, ..Framing::default() };
    if goes && is_door && !passes && ends && leads && !looks && is_plain {
        let objects = std::mem::take(&mut step.start).subjects;
        step.via = Some(Via { how: Pass::From, objects });
    }
}

/// The second step, from the door that the first one only comes in by.
fn entered(linked: &Linked, objects: &[Object], first: &Step, second: &Step) -> Option<Step> {
    let is_door = |id: &u32| is_called(objects, *id, DOORS);
    let words = linked.texts_in(first.words?);
    let mut named = words.iter().enumerate().filter_map(|(at, word)| Some((at, linked.slot_at(word)?)));
    let (at, door) = named.next().filter(|_| named.next().is_none())?;
    let door = linked.expanded(&[door]);
    let comes = words[..at].iter().any(|word| ENTERS.iter().any(|verb| is_form(word, verb)))
        && words[..at].iter().any(|word| is_listed(INTO, word) || is_form(word, "enter"));
    let shown = |framing: &Framing| framing.subjects.iter().all(|id| door.contains(id));
    let is_entry = comes && door.iter().any(is_door) && shown(&first.start) && shown(&first.end);
    let goes = matches!(second.movement, Move::PushIn | Move::Follow | Move::FlyThrough)
        && !second.cut
        && second.via.is_none()
        && second.start.subjects.iter().all(|id| door.contains(id))
        && !second.end.subjects.is_empty()
        && !second.end.subjects.iter().any(|id| door.contains(id));
    (is_entry && goes).then(|| {
        let angle = second.end.angle.or(first.end.angle).or(first.start.angle);
        let end = Framing { angle, ..second.end.clone() };
        let via = Some(Via { how: Pass::From, objects: door });
        Step { start: Framing::default(), end, via, words: first.joint_words(second), ..second.clone() }
    })
}

#[cfg(test)]
mod tests {
    use super::super::fixture::{direction, linked};
    use super::*;
    use glam::DVec3;

    fn directed(text: &str, split: usize) -> Vec<Step> {
        let object = |id, label| Object::from_box(id, label, DVec3::ZERO, DVec3::ONE);
        let objects = [object(5, "gray door"), object(7, "dining table")];
        let about = |id: u32| Framing { subjects: vec![id], ..Framing::default() };
        let step = |id: u32, words| Step { end: about(id), words: Some(words), ..Step::of(Move::PushIn) };
        let steps = vec![step(5, [0, split]), step(7, [split, text.len()])];
        let mut direction = direction(steps);
        come_in_at_doors(&linked(text), &objects, &mut direction);
        direction.program.steps
    }

    #[test]
    fn who_comes_in_at_a_door_begins_there() {
        let steps = directed("come in from <obj-0> , walk up to <obj-1>", 22);
        assert_eq!(steps.len(), 1);
        assert_eq!(steps[0].via, Some(Via { how: Pass::From, objects: vec![5] }));
        assert_eq!(directed("push in on <obj-0> , walk up to <obj-1>", 20).len(), 2);
    }

    #[test]
    fn a_way_from_a_door_begins_at_it() {
        let led = |text: &str| {
            let about = |id: u32| Framing { subjects: vec![id], ..Framing::default() };
            let words = Some([0, text.len()]);
            let step = Step { start: about(5), end: about(7), words, ..Step::of(Move::Follow) };
            let mut direction = direction(vec![step]);
            let object = |id, label| Object::from_box(id, label, DVec3::ZERO, DVec3::ONE);
            let objects = [object(5, "gray door"), object(7, "dining table")];
            come_in_at_doors(&linked(text), &objects, &mut direction);
            direction.program.steps.remove(0).via
        };
        let from = Some(Via { how: Pass::From, objects: vec![5] });
        assert_eq!(led("glide from the <obj-0> to <obj-1>"), from);
        assert_eq!(led("begin at the <obj-0> and walk to <obj-1>"), from);
        assert_eq!(led("begin tight on the <obj-0> , then go from it to <obj-1>"), None);
        assert_eq!(led("swing the view from <obj-0> to <obj-1>"), None);
    }
}

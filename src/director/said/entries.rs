//! Ways into a room: `come in from the grey door, walk up to the table`. Who comes in at a door stands there first and looks
//! into the room.

use cinesplat_language::{Linked, is_listed};
use cinesplat_objects::Object;
use cinesplat_operator::{Framing, Pass, Step, Via};
use cinesplat_trajectory::{Move, ShotAngle, ShotSize};

use super::called::is_called;
use super::directions::is_form;
use super::openings::OPENS;
use crate::direction::Direction;
use crate::keys::MAX_KEYS;

/// What one comes in by.
const DOORS: &str = "door doors doorway entrance gate archway arch hatch";
/// Verbs of somebody who comes in, and words between the verb and the door.
const ENTERS: [&str; 10] = ["come", "enter", "walk", "step", "go", "move", "glide", "fly", "drift", "float"];
const INTO: &str = "in inside into through from";

/// Words by which a door is what the first picture shows.
const LOOKS: &str =
    "show shows showing see seeing view views picture frame framed focus on of tight wide shot pan tilt turn up";

/// Words of a body that is at a place, and most words before that place.
const POSTURES: &str =
    "standing stand stood seated sitting sit sat lying lie perched kneeling crouched crouching leaning waiting";
const MAX_BEFORE_PLACE: usize = 9;

/// Begins at the door by which the words come in what the next step does.
pub(crate) fn come_in_at_doors(linked: &Linked, objects: &[Object], direction: &mut Direction) {
    if let Some(first) = direction.program.steps.first_mut() {
        leave_door(linked, objects, first);
        begin_at_place(linked, objects, first);
    }
    pass_from_door(linked, objects, direction);
    if let [first, _, ..] = &mut direction.program.steps[..] {
        move_in_by_door(linked, objects, first);
    }
    let mut nth = 1;
    while nth < direction.program.steps.len() {
        let [first, second] = &direction.program.steps[nth - 1..=nth] else { break };
        if let Some(two) = entered_past(linked, objects, first, second) {
            direction.program.steps.splice(nth - 1..=nth, two);
        }
        let [first, second] = &direction.program.steps[nth - 1..=nth] else { break };
        match entered(linked, objects, first, second) {
            Some(one) => direction.join_steps(nth, one),
            None => nth += 1,
        }
    }
}

/// Begins a way at the door from which the words lead, which is behind the camera then: `glide from the door to the sofa`.
fn leave_door(linked: &Linked, objects: &[Object], step: &mut Step) {
    let goes = matches!(step.movement, Move::PushIn | Move::Follow | Move::FlyThrough)
        && step.with.iter().all(|with| *with == Move::Handheld);
    let door = &step.start.subjects;
    let is_door = !door.is_empty() && door.iter().all(|id| is_called(objects, *id, DOORS));
    let passes = step.via.as_ref().is_some_and(|via| via.objects.iter().any(|id| !door.contains(id)));
    let ends = !step.end.subjects.is_empty() && !step.end.subjects.iter().any(|id| door.contains(id));
    let words = linked.texts_in(step.words.unwrap_or_default());
    let Some(at) = words.iter().position(|word| linked.stands_for(word, door)) else {
        return;
    };
    let before = &words[at.saturating_sub(4)..at];
    let leads = before.iter().any(|word| is_listed("from at by in inside near beside", word));
    let looks = says_look(&words[..at]);
    // `With the full room on show` is what there is to see from it.
    let size = step.start.size.filter(|size| *size == ShotSize::Long);
    // `In from the door at eye level` is how high somebody walks.
    let angle = step.start.angle.filter(|angle| *angle == ShotAngle::EyeLevel);
    let is_plain = step.start == Framing { subjects: door.clone(), size, angle, ..Framing::default() };
    if goes && is_door && !passes && ends && leads && !looks && is_plain {
        let objects = std::mem::take(&mut step.start).subjects;
        step.via = Some(Via { how: Pass::From, objects });
    }
}

/// Whether words before a place make it what a picture shows.
fn says_look(words: &[&str]) -> bool {
    words.iter().any(|word| is_listed(LOOKS, word) || is_form(word, "look") || is_form(word, "close"))
}

/// Makes two ways of one that leads in from a door, past something and on: `in from the door, past the desk, end at the window`
/// shows the desk.
fn pass_from_door(linked: &Linked, objects: &[Object], direction: &mut Direction) {
    let Some(step) = direction.program.steps.first().filter(|_| direction.program.steps.len() < MAX_KEYS) else {
        return;
    };
    let Some(via) = step.via.as_ref().filter(|via| via.how == Pass::Past && via.objects.len() == 1) else { return };
    let without_passed = Step { via: None, ..step.clone() };
    let mut led = without_passed.clone();
    leave_door(linked, objects, &mut led);
    let on_way = !step.end.subjects.contains(&via.objects[0]) && !step.start.subjects.contains(&via.objects[0]);
    let words = linked.words_in(step.words.unwrap_or_default());
    let mut named = words.filter(|(word, _)| linked.stands_for(word, &via.objects));
    let Some((_, [_, passed])) = named.next().filter(|_| led != without_passed && on_way) else { return };
    let [from, to] = step.words.unwrap_or_default();
    let secs = step.duration_secs.map(|secs| secs / 2.0);
    let end = Framing { subjects: via.objects.clone(), angle: step.end.angle, ..Framing::default() };
    let first = Step { movement: Move::Follow, end, duration_secs: secs, words: Some([from, passed]), ..led.clone() };
    let second = Step {
        movement: Move::Follow,
        via: None,
        start: Framing::default(),
        duration_secs: secs,
        words: Some([passed, to]),
        ..led
    };
    direction.insert_rest(0, first);
    direction.program.steps[1] = second;
}

/// Begins at the place where the words say that the camera is, and sees what there is to see from it: `start in the doorway,
/// hold`, `standing in the doorway, pan left`, `seated at the desk, look at the clock`, `begin next to the bed, walk to the door`.
fn begin_at_place(linked: &Linked, objects: &[Object], step: &mut Step) {
    let words = linked.texts_in(step.words.unwrap_or_default());
    let Some((at, id)) = words.iter().enumerate().find_map(|(at, word)| Some((at, linked.slot_at(word)?))) else {
        return;
    };
    let place = linked.expanded(&[id]);
    let [one] = place[..] else { return };
    if says_look(&words[..at]) || at > MAX_BEFORE_PLACE || step.via.as_ref().is_some_and(|via| via.objects != place) {
        return;
    }
    let before = &words[..at];
    let last = before.iter().rposition(|word| *word != "the").map_or("", |last| before[last]);
    let is_body = before.iter().any(|word| is_listed(POSTURES, word));
    let is_within = is_called(objects, one, DOORS) && is_listed("in inside within at by", last);
    let is_beside = is_listed("by beside", last) || before.windows(2).any(|pair| pair == ["next", "to"]);
    let is_at = is_body && is_listed("at on in by beside near to", last);
    let travels =
        matches!(step.movement, Move::PushIn | Move::Follow | Move::FlyThrough | Move::TruckLeft | Move::TruckRight);
    let opens = before.iter().any(|word| OPENS.contains(word)) || is_body;
    let starts_there = |framing: &Framing| framing.subjects == place;
    let leads_away = !step.end.subjects.is_empty() && !starts_there(&step.end);
    let is_way = opens && travels && leads_away && (is_within || is_beside || is_at);
    let rests = step.movement == Move::Static && (step.end.subjects.is_empty() || starts_there(&step.end));
    let turns = matches!(step.movement, Move::PanLeft | Move::PanRight | Move::TiltUp | Move::TiltDown);
    let is_held = (opens && rests || is_body && turns && !starts_there(&step.end)) && (is_within || is_at);
    let is_free = |framing: &Framing| framing.side.is_none() && framing.angle.is_none();
    if !(is_way || is_held) || !is_free(&step.start) || !is_free(&step.end) {
        return;
    }
    for framing in [&mut step.start, &mut step.end] {
        if framing.subjects == place {
            // `Start in the doorway, wide`.
            let size = framing.size.filter(|size| *size == ShotSize::Long);
            *framing = Framing { size, ..Framing::default() };
        }
    }
    step.via = Some(Via { how: Pass::From, objects: place });
}

/// Moves into the room from the door by which the words come in at it, and that no step leaves: `come in at the door like a buyer,
/// glance right at the stove`.
fn move_in_by_door(linked: &Linked, objects: &[Object], step: &mut Step) {
    let words = linked.texts_in(step.words.unwrap_or_default());
    let comes_at = |at: usize| {
        let comes = is_form(words[at], "come") || is_form(words[at], "walk") || is_form(words[at], "step");
        let behind = words.get(at + 1..at + 3).is_some_and(|behind| matches!(behind, ["in", "at" | "by"]));
        let door = words.get(at + 3..)?.iter().find(|word| **word != "the")?;
        linked.slot_at(door).filter(|_| comes && behind)
    };
    let Some(id) = (0..words.len()).find_map(comes_at) else { return };
    let door = linked.expanded(&[id]);
    let is_door = door.iter().all(|id| is_called(objects, *id, DOORS));
    let nears = matches!(step.movement, Move::PushIn | Move::Follow) && step.via.is_none();
    if is_door && nears && step.end.subjects == door && step.start.subjects.iter().all(|id| door.contains(id)) {
        step.movement = Move::PushIn;
        step.start = Framing::default();
        step.end = Framing { angle: step.end.angle, height: step.end.height, ..Framing::default() };
        step.via = Some(Via { how: Pass::From, objects: door });
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

/// As [`entered`], where the next step goes past something: `walk in from the door, carry on past the table and finish at the
/// window` goes from the door to the table, and past it to the window.
fn entered_past(linked: &Linked, objects: &[Object], first: &Step, second: &Step) -> Option<[Step; 2]> {
    let passed = second.via.as_ref().filter(|via| via.how == Pass::Past && via.objects.len() == 1)?;
    let on_way = !second.end.subjects.contains(&passed.objects[0]) && first.end.subjects.is_empty();
    let end = Framing { subjects: passed.objects.clone(), ..Framing::default() };
    let to_passed = Step { via: None, end, words: first.words, ..second.clone() };
    let to_passed = entered(linked, objects, first, &to_passed).filter(|_| on_way)?;
    let to_passed = Step { movement: first.movement, words: first.words, ..to_passed };
    Some([to_passed, Step { start: Framing::default(), ..second.clone() }])
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
    fn a_film_begins_where_the_words_say_that_the_camera_is() {
        let object = |id, label| Object::from_box(id, label, DVec3::ZERO, DVec3::ONE);
        let objects = [object(5, "gray door"), object(7, "desk"), object(9, "bed")];
        let begun = |text: &str, movement, start: &[u32], end: &[u32]| {
            let about = |ids: &[u32]| Framing { subjects: ids.to_vec(), ..Framing::default() };
            let step =
                Step { start: about(start), end: about(end), words: Some([0, text.len()]), ..Step::of(movement) };
            let mut direction = direction(vec![step]);
            come_in_at_doors(&linked(text), &objects, &mut direction);
            let step = direction.program.steps.remove(0);
            (step.via.map(|via| via.objects), step.start.subjects, step.end.subjects)
        };
        let at = |place: u32, end: &[u32]| (Some(vec![place]), Vec::new(), end.to_vec());
        assert_eq!(begun("start in the <obj-0> and hold", Move::Static, &[], &[5]), at(5, &[]));
        assert_eq!(begun("standing in the <obj-0> , pan left", Move::PanLeft, &[5], &[]), at(5, &[]));
        assert_eq!(begun("seated at <obj-1> , tilt up to <obj-0>", Move::TiltUp, &[7], &[5]), at(7, &[5]));
        assert_eq!(begun("begin next to <obj-1> , walk to <obj-0>", Move::Follow, &[7], &[5]), at(7, &[5]));
        let seen = |start: &[u32], end: &[u32]| (None, start.to_vec(), end.to_vec());
        assert_eq!(begun("start on <obj-0> and hold", Move::Static, &[], &[5]), seen(&[], &[5]));
        assert_eq!(begun("start at <obj-1> , go to the bed", Move::Follow, &[7], &[9]), seen(&[7], &[9]));
        assert_eq!(begun("begin with a view of <obj-0>", Move::Static, &[], &[5]), seen(&[], &[5]));
    }

    #[test]
    fn a_way_from_a_door_past_something_shows_it() {
        let text = "in from the <obj-0> , past <obj-1> , end at the window";
        let about = |id: u32| Framing { subjects: vec![id], ..Framing::default() };
        let via = Some(Via { how: Pass::Past, objects: vec![7] });
        let words = Some([0, text.len()]);
        let mut direction =
            direction(vec![Step { start: about(5), end: about(9), via, words, ..Step::of(Move::FlyThrough) }]);
        let object = |id, label| Object::from_box(id, label, DVec3::ZERO, DVec3::ONE);
        come_in_at_doors(&linked(text), &[object(5, "gray door"), object(7, "desk")], &mut direction);
        let [first, second] = &direction.program.steps[..] else { panic!("{:?}", direction.program.steps) };
        assert_eq!(first.via, Some(Via { how: Pass::From, objects: vec![5] }));
        assert_eq!((&first.end.subjects, &second.end.subjects), (&vec![7], &vec![9]));
        assert_eq!(second.via, None);
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

    #[test]
    fn who_walks_in_past_something_goes_there_from_the_door() {
        let text = "walk in from <obj-0> at eye level , carry on past <obj-1> and finish at it";
        let object = |id, label| Object::from_box(id, label, DVec3::ZERO, DVec3::ONE);
        let objects = [object(5, "gray door"), object(7, "dining table"), object(9, "window")];
        let about = |id: u32| Framing { subjects: vec![id], ..Framing::default() };
        let first = Step { start: about(5), words: Some([0, 36]), ..Step::of(Move::PushIn) };
        let past = Some(Via { how: Pass::Past, objects: vec![7] });
        let second = Step { end: about(9), via: past, words: Some([37, text.len()]), ..Step::of(Move::FlyThrough) };
        let mut direction = direction(vec![first, second]);
        come_in_at_doors(&linked(text), &objects, &mut direction);
        let steps = &direction.program.steps;
        let from = steps[0].via.as_ref().map(|via| (via.how, via.objects.clone()));
        assert_eq!((from, &steps[0].end.subjects), (Some((Pass::From, vec![5])), &vec![7]));
        assert_eq!(steps[1].end.subjects, [9]);
    }
}

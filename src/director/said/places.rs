//! What the words say of where things are and how they are seen.

use cinesplat_language::Linked;
use cinesplat_operator::{Amount, FramePlace, Framing, Motion, Pass, Step, SubjectPart};
use cinesplat_trajectory::{Move, ShotAngle};

use super::briefs::directs;
use crate::direction::Direction;

/// Words that say where a thing is, and the way past that the network may read into them.
const PLACINGS: [(&[&str], Pass); 10] = [
    (&["under"], Pass::Under),
    (&["below"], Pass::Under),
    (&["beneath"], Pass::Under),
    (&["underneath"], Pass::Under),
    (&["over"], Pass::Over),
    (&["above"], Pass::Over),
    (&["behind"], Pass::Behind),
    (&["beside"], Pass::Past),
    (&["next", "to"], Pass::Past),
    (&["in", "front", "of"], Pass::Front),
];

/// Words that say on what a thing stands, and no way of any kind.
const INSIDE: [&[&str]; 8] = [
    &["in", "the", "middle", "of"],
    &["in", "the", "center", "of"],
    &["in", "the", "centre", "of"],
    &["at", "the", "end", "of"],
    &["at", "the", "edge", "of"],
    &["on", "top", "of"],
    &["standing", "on"],
    &["sitting", "on"],
];

/// Removes ways past an object that only say which thing is meant: `push in on the cupboard under the tv`.
pub(crate) fn drop_descriptions(linked: &Linked, steps: &mut [Step]) {
    let may_pass = |step: &&mut Step| {
        stays_before_subject(step.movement) || matches!(step.movement, Move::FlyThrough | Move::Follow)
    };
    for step in steps.iter_mut().filter(may_pass) {
        let (Some(via), Some(words)) = (&step.via, step.words) else { continue };
        let words = linked.texts_in(words);
        let id_at = |at: usize| linked.slot_at(words.get(at)?);
        // `Push in on the doors under the counter`: nothing is passed on the way to itself.
        let nears = matches!(step.movement, Move::PushIn | Move::ZoomIn | Move::Static);
        if nears && via.objects == step.end.subjects {
            step.via = None;
            continue;
        }
        let is_subject = |id: &u32| step.end.subjects.contains(id) || step.start.subjects.contains(id);
        let describes = |at: usize, placing: &[&str]| {
            let is_place = |id: &u32| via.objects == [*id];
            words[at..].starts_with(placing)
                && at.checked_sub(1).and_then(id_at).is_some_and(|id| is_subject(&id))
                && id_at(at + placing.len()).is_some_and(|id| is_place(&id) && !is_subject(&id))
        };
        let is_inside = |placing: &&&[&str]| (0..words.len()).any(|at| describes(at, placing));
        if INSIDE.iter().any(|placing| is_inside(&placing)) {
            step.via = None;
            if step.movement == Move::FlyThrough {
                step.movement = Move::PushIn;
            }
            continue;
        }
        let mut placings = PLACINGS.iter().filter(|(_, how)| *how == via.how);
        if placings.any(|(placing, _)| (0..words.len()).any(|at| describes(at, placing))) {
            step.via = None;
            if step.movement == Move::FlyThrough {
                step.movement = Move::PushIn;
            }
        }
    }
}

/// Begins a turn or a slide at what the words lead from, where the network reads that it is passed: `tilt down 30° from
/// the plates`.
pub(crate) fn begin_at_source(linked: &Linked, steps: &mut [Step]) {
    for step in steps {
        let (Some(via), Some(words)) = (&step.via, step.words) else { continue };
        let words = linked.texts_in(words);
        let leads_from = |at: usize| {
            let id = words.get(at + 1).and_then(|word| linked.slot_at(word));
            words[at] == "from" && id.is_some_and(|id| via.objects == [id])
        };
        let leaves = step.movement.looks_elsewhere() || Motion::of(step.movement) == Some(Motion::Rise);
        let is_open = via.how == Pass::Past && step.start.subjects.is_empty() && step.end.subjects.is_empty();
        if leaves && is_open && !words.contains(&"past") && (0..words.len()).any(leads_from) {
            step.start.subjects.clone_from(&via.objects);
            step.via = None;
        }
    }
}

/// Begins a move at what the words lead from before they say it: `From the mirror I want to go down to the cactus`.
pub(crate) fn leave_from(linked: &Linked, direction: &mut Direction) {
    for nth in (1..direction.program.steps.len()).rev() {
        let [source, step] = &direction.program.steps[nth - 1..=nth] else { continue };
        let words = linked.texts_in(source.words.unwrap_or_default());
        let is_source = words.first() == Some(&"from")
            && !words.contains(&"to")
            && !source.start.subjects.is_empty()
            && source.end == Framing::default()
            && source.via.is_none()
            && !directs(&words[1..]);
        if is_source && step.start == Framing::default() && !step.cut && step.end.subjects != source.start.subjects {
            let one = Step { start: source.start.clone(), words: source.joint_words(step), ..step.clone() };
            direction.join_steps(nth, one);
        }
    }
}

/// A pair is passed, not gone along, where the words say `past`: `truck right past the two easels`.
pub(crate) fn pass_pairs(linked: &Linked, steps: &mut [Step]) {
    for step in steps {
        let (Some(via), Some(words)) = (&mut step.via, step.words) else { continue };
        let says = |wanted: &str| linked.words_in(words).any(|(word, _)| word == wanted);
        if via.how == Pass::Along && linked.expanded(&via.objects).len() == 2 && says("past") && !says("along") {
            via.how = Pass::Past;
        }
    }
}

/// Stands nowhere but above what it sees straight from above: `begin from above the desk, vertical view`.
pub(crate) fn stand_above(steps: &mut [Step]) {
    for step in steps {
        let is_overhead = step.movement == Move::Static && step.end.angle == Some(ShotAngle::Overhead);
        step.via = step.via.take().filter(|via| !(is_overhead && via.how == Pass::From));
    }
}

/// Begins a rise that ends looking down with no view from above: `lift off from its foot and end looking down on it`.
pub(crate) fn rise_to_above(steps: &mut [Step]) {
    let is_above = |framing: &Framing| matches!(framing.angle, Some(ShotAngle::High | ShotAngle::Overhead));
    for step in steps.iter_mut().filter(|step| matches!(step.movement, Move::CraneUp | Move::PedestalUp)) {
        if is_above(&step.start) && is_above(&step.end) && step.start.part == SubjectPart::Bottom {
            step.start.angle = None;
        }
    }
}

/// Cranes down from a picture from straight above to a level one, which no descent that keeps its pitch does.
pub(crate) fn crane_from_above(steps: &mut [Step]) {
    for nth in 1..steps.len() {
        let is_overhead = steps[nth - 1].end.angle == Some(ShotAngle::Overhead);
        let step = &mut steps[nth];
        let is_level = matches!(step.end.angle, Some(ShotAngle::EyeLevel | ShotAngle::Low));
        if is_overhead && is_level && step.movement == Move::PedestalDown && step.start.angle.is_none() {
            step.movement = Move::CraneDown;
            // The camera turns to its subject on the way.
            step.with.retain(|with| !matches!(with, Move::PanLeft | Move::PanRight));
        }
    }
}

/// Passes, on a turn from one thing to another, what the words lead across: `sweep right across the curtain and land on the
/// armchair`.
pub(crate) fn pass_across(linked: &Linked, steps: &mut [Step]) {
    let turns = |step: &&mut Step| {
        matches!(step.movement, Move::PanLeft | Move::PanRight) && step.via.is_none() && !step.end.subjects.is_empty()
    };
    for step in steps.iter_mut().filter(turns) {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let across = words.iter().enumerate().filter(|(_, word)| matches!(**word, "across" | "past" | "via"));
        let mut passed = across.filter_map(|(at, _)| {
            let next = at + 1 + usize::from(words.get(at + 1) == Some(&"the"));
            Some(linked.expanded(&[linked.slot_at(words.get(next)?)?]))
        });
        let (Some(objects), None) = (passed.next(), passed.next()) else { continue };
        let is_other = |id: &u32| !step.end.subjects.contains(id) && !step.start.subjects.contains(id);
        if objects.iter().all(is_other) {
            step.via = Some(cinesplat_operator::Via { how: Pass::Past, objects });
        }
    }
}

/// Words before a length by which it is a height (`rise to two meters`), and words behind it.
const TO_HEIGHTS: [&str; 4] = ["to", "at", "of", "until"];
const HEIGHTS: [&str; 9] = ["above", "over", "off", "high", "height", "altitude", "from", "level", "tall"];
/// Words that may stand before a length of either kind.
const ROUGHLY: [&str; 7] = ["about", "around", "roughly", "a", "some", "approximately", "maybe"];

/// Makes a length the way of a rise or a descent where the words beside it do not say that it is a height: `rise about
/// half a meter`.
pub(crate) fn rise_by_lengths(linked: &Linked, steps: &mut [Step]) {
    let moves = |step: &&mut Step| {
        matches!(step.movement, Move::CraneUp | Move::CraneDown | Move::PedestalUp | Move::PedestalDown)
    };
    for step in steps.iter_mut().filter(moves).filter(|step| step.amount.is_none() && step.end.height.is_some()) {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let mut lengths = words.iter().enumerate().filter(|(_, word)| linked.is_quantity(word)).map(|(at, _)| at);
        let (Some(at), None) = (lengths.next(), lengths.next()) else { continue };
        let before = words[..at].iter().rev().find(|word| !ROUGHLY.contains(word)).copied().unwrap_or_default();
        let behind = words.get(at + 1).copied().unwrap_or_default();
        if !TO_HEIGHTS.contains(&before) && !HEIGHTS.contains(&behind) {
            step.amount = step.end.height.take().map(Amount::Units);
        }
    }
}

/// Whether a move goes to its subject, or stays before it, and so passes nothing else.
fn stays_before_subject(movement: Move) -> bool {
    let circles_or_nears = matches!(
        movement,
        Move::PushIn
            | Move::PullOut
            | Move::ZoomIn
            | Move::ZoomOut
            | Move::DollyZoomIn
            | Move::DollyZoomOut
            | Move::Static
            | Move::OrbitLeft
            | Move::OrbitRight
            | Move::ArcLeft
            | Move::ArcRight
    );
    circles_or_nears || movement.looks_elsewhere()
}

/// Words behind a side of the frame.
const THIRDS: [&str; 5] = ["third", "side", "edge", "half", "thirds"];

/// Begins and ends at the places in the frame that the words name one after the other: `the chair on the right third. Slide until
/// it sits on the left third`.
pub(crate) fn place_ends(linked: &Linked, steps: &mut [Step]) {
    for step in steps.iter_mut().filter(|step| step.start.place.is_some() || step.end.place.is_some()) {
        let same = !step.start.subjects.is_empty() && step.start.subjects == step.end.subjects;
        let words = linked.texts_in(step.words.unwrap_or_default());
        if let Some([first, last]) = frame_sides(&words).filter(|_| same && step.start.place == step.end.place) {
            (step.start.place, step.end.place) = (Some(first), Some(last));
        }
    }
}

/// The only two sides of the frame that the words name, in order.
fn frame_sides(words: &[&str]) -> Option<[FramePlace; 2]> {
    let side_at = |at: usize| {
        let is_third = words.get(at + 1).is_some_and(|word| THIRDS.contains(word));
        let is_of_thing =
            words.get(at + 2) == Some(&"of") && !words[at + 3..].iter().take(2).any(|word| *word == "frame");
        let before = words[..at].iter().rev().find(|word| **word != "the");
        let is_placed = is_third && !is_of_thing && before.is_some_and(|word| matches!(*word, "on" | "in" | "at"));
        match words[at] {
            "left" if is_placed => Some(FramePlace::AtLeft),
            "right" if is_placed => Some(FramePlace::AtRight),
            _ => None,
        }
    };
    let sides: Vec<FramePlace> = (0..words.len()).filter_map(side_at).collect();
    matches!(sides[..], [first, last] if first != last).then(|| [sides[0], sides[1]])
}

/// Gives a framing that says how its subjects are seen, but not which, the subjects of the step's other framing, or
/// what it passes: `tilt from the foot of the lamp post up to its lantern`.
pub(crate) fn complete_framings(steps: &mut [Step]) {
    for step in steps {
        let passed = step.via.as_ref().map(|via| via.objects.clone()).unwrap_or_default();
        let [start, end] = [&step.start, &step.end].map(|framing| framing.subjects.clone());
        let complete = |framing: &mut Framing, others: [&Vec<u32>; 2]| {
            let is_seen = framing.part != SubjectPart::default() || framing.side.is_some() || framing.place.is_some();
            if framing.subjects.is_empty() && is_seen {
                framing.subjects = others.into_iter().find(|ids| !ids.is_empty()).cloned().unwrap_or_default();
            }
        };
        complete(&mut step.start, [&end, &passed]);
        complete(&mut step.end, [&start, &passed]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_sides_of_the_frame_are_its_first_and_its_last_place() {
        let sides = |text: &str| frame_sides(&text.split(' ').collect::<Vec<_>>());
        let across = Some([FramePlace::AtRight, FramePlace::AtLeft]);
        assert_eq!(sides("<obj-0> on the right third . slide right until it sits on the left third"), across);
        assert_eq!(sides("<obj-0> in the right half of the frame , then in the left half"), across);
        assert_eq!(sides("<obj-0> on the right third . slide to the left"), None);
        assert_eq!(sides("from <obj-0> on the left side of <obj-1> to the one on the right side"), None);
        assert_eq!(sides("on the left third , then on the left third"), None);
    }
}

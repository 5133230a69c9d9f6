//! What is said in relation to what was said before: `back half that distance`, `closer, half a metre or so`, `sway left, right, and
//! left once more`, `while tracking left`, `simultaneously`.

use cinesplat_language::{Linked, QuantityKind, is_listed};
use cinesplat_operator::{Amount, FramePlace, Framing, Lens, Look, MAX_SECOND_MOVES, Pass, Step, SubjectPart, Via};
use cinesplat_trajectory::{Move, ShotAngle};

use super::directions::is_form;
use crate::direction::Direction;

/// Shares of an extent in words, and what they are of.
const SHARES: [(&[&str], f64); 8] = [
    (&["half"], 0.5),
    (&["a", "third", "of"], 1.0 / 3.0),
    (&["one", "third", "of"], 1.0 / 3.0),
    (&["a", "quarter", "of"], 0.25),
    (&["twice"], 2.0),
    (&["double"], 2.0),
    (&["three", "times"], 3.0),
    (&["the", "same"], 1.0),
];
const EXTENTS: &str = "distance way amount angle much far length";

/// Gives a step the share of the extent of the step before that the words state: `dolly in 1.5 m, then back half that distance`.
pub(crate) fn take_relative_amounts(linked: &Linked, steps: &mut [Step]) {
    let mut extent = None;
    for step in steps {
        let words = linked.texts_in(step.words.unwrap_or_default());
        if let (Some(share), Some(before)) = (share_in(linked, &words), extent) {
            step.amount = Some(match before {
                Amount::Degrees(degrees) => Amount::Degrees(share * degrees),
                Amount::Units(units) => Amount::Units(share * units),
                other => other,
            });
            // The factor that is made of it is none of a picture.
            step.end.distance = None;
        }
        if let Some(amount @ (Amount::Degrees(_) | Amount::Units(_))) = step.amount {
            extent = Some(amount);
        }
    }
}

/// The share of what was said before that some words state.
fn share_in(linked: &Linked, words: &[&str]) -> Option<f64> {
    (0..words.len()).find_map(|at| {
        let of_words = SHARES.iter().find(|(share, _)| words[at..].starts_with(share));
        let factor = linked.quantity_at(words[at]).filter(|quantity| quantity.kind == QuantityKind::Factor);
        let percent = linked.quantity_at(words[at]).filter(|quantity| quantity.kind == QuantityKind::Percent);
        let (share, end) = match (of_words, factor, percent) {
            (Some((share, value)), ..) => (*value, at + share.len()),
            (None, Some(factor), _) => (factor.value, at + 1),
            (None, None, Some(percent)) => (percent.value / 100.0, at + 1),
            (None, None, None) => return None,
        };
        let end = end + usize::from(words.get(end) == Some(&"of"));
        let is_that = words.get(end) == Some(&"that") && words.get(end + 1).is_none_or(|word| is_listed(EXTENTS, word));
        is_that.then_some(share)
    })
}

/// Words before a length by which it is how far the camera comes, and not where it stops.
const BY: &str = ", by about around roughly just - maybe another some";

/// Comes closer by a length: `go closer to the bench, half a metre or so` does not stop half a metre before it.
pub(crate) fn come_closer_by(linked: &Linked, steps: &mut [Step]) {
    for step in steps.iter_mut().filter(|step| step.movement == Move::PushIn && step.amount.is_none()) {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let nears = words.iter().any(|word| matches!(*word, "closer" | "nearer" | "forward" | "forwards"));
        let Some(distance) = step.end.distance.filter(|_| nears) else { continue };
        let is_length = |word: &str| linked.quantity_at(word).is_some_and(|q| (q.value - distance).abs() < 1e-9);
        let Some(at) = words.iter().position(|word| is_length(word)) else { continue };
        let is_by = at > 0 && is_listed(BY, words[at - 1]);
        let behind = words.get(at + 1).copied().unwrap_or_default();
        if is_by && !matches!(behind, "from" | "of" | "away" | "off" | "to" | "before" | "short") {
            (step.amount, step.end.distance) = (Some(Amount::Units(distance)), None);
        }
    }
}

/// Leaves the start of a turn open that would begin with the picture that it ends on.
pub(crate) fn turn_from_elsewhere(steps: &mut [Step]) {
    for step in steps.iter_mut().filter(|step| step.movement.looks_elsewhere() && step.amount.is_none()) {
        if step.start == step.end && step.start.place.is_some() {
            step.start = Framing::default();
        }
    }
}

/// Verbs of a way to a side, and words before it that make it one at the same time.
const SIDEWAYS: [&str; 9] = ["track", "truck", "slide", "drift", "crab", "move", "travel", "glide", "shift"];
const MEANWHILE: &str = "while whilst as and";

/// Moves to a side at the same time where the words say so: `sink while tracking left`.
pub(crate) fn move_aside_meanwhile(linked: &Linked, steps: &mut [Step]) {
    for step in steps {
        let goes_aside = |movement: &Move| matches!(movement, Move::TruckLeft | Move::TruckRight);
        let lifts = matches!(
            step.movement,
            Move::CraneUp | Move::CraneDown | Move::PedestalUp | Move::PedestalDown | Move::PushIn | Move::PullOut
        );
        if !lifts || step.with.iter().any(goes_aside) || step.with.len() >= MAX_SECOND_MOVES {
            continue;
        }
        let words = linked.texts_in(step.words.unwrap_or_default());
        let side = (1..words.len()).find_map(|at| {
            let gerund = words[at].ends_with("ing") && SIDEWAYS.iter().any(|verb| is_form(words[at], verb));
            let joins = words[at.saturating_sub(3)..at].iter().any(|word| is_listed(MEANWHILE, word));
            let behind = words[at + 1..].iter().take(3).find(|word| matches!(**word, "left" | "right"))?;
            (gerund && joins).then_some(*behind == "left")
        });
        step.with.extend(side.map(|is_left| if is_left { Move::TruckLeft } else { Move::TruckRight }));
    }
}

/// Begins a tilt from the floor to a thing at its lower end.
pub(crate) fn tilt_from_floor(linked: &Linked, steps: &mut [Step]) {
    for step in steps.iter_mut().filter(|step| step.movement == Move::TiltUp && step.start == Framing::default()) {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let is_from = words.windows(3).any(|three| {
            matches!(three, ["from", "the", floor] if is_listed("floor ground floorboards carpet bottom", floor))
        });
        if is_from && !step.end.subjects.is_empty() {
            let subjects = step.end.subjects.clone();
            step.start = Framing { subjects, part: SubjectPart::Bottom, ..Framing::default() };
        }
    }
}

/// Words of a high camera.
const HIGH: &str = "high above over overhead down top aerial bird birds birdseye sky air";

/// Begins a rise where the words leave it open: `a drone shot, climbing the trunk` does not begin up in the air.
pub(crate) fn climb_from_below(linked: &Linked, steps: &mut [Step]) {
    for step in steps.iter_mut().filter(|step| matches!(step.movement, Move::CraneUp | Move::PedestalUp)) {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let is_drone = words.iter().any(|word| word.starts_with("drone"));
        if is_drone && step.start.angle == Some(ShotAngle::High) && !words.iter().any(|word| is_listed(HIGH, word)) {
            step.start.angle = None;
        }
    }
}

/// Travels to a waypoint that is seen from straight above, where its words only say how the camera looks there: `WP3: directly above
/// the candle, looking down`.
pub(crate) fn travel_above(linked: &Linked, steps: &mut [Step]) {
    for nth in 1..steps.len() {
        let (before, rest) = steps.split_at_mut(nth);
        let (Some(before), Some(step)) = (before.last(), rest.first_mut()) else { return };
        let words = linked.texts_in(step.words.unwrap_or_default());
        let is_above = words.iter().any(|word| matches!(*word, "above" | "over"));
        let is_other = step.end.subjects != before.end.subjects;
        let is_look = words.iter().any(|word| matches!(*word, "looking" | "facing" | "pointing" | "aimed"));
        let tilts = words.iter().any(|word| is_form(word, "tilt"));
        let overhead = step.end.angle == Some(ShotAngle::Overhead);
        if step.movement == Move::TiltDown && overhead && is_above && is_look && is_other && !tilts {
            step.movement = Move::Follow;
        }
    }
}

/// Ends on the whole room where a flight ends high up in a corner of it: `and out high in a corner`.
pub(crate) fn end_in_corner(linked: &Linked, steps: &mut [Step]) {
    let last = steps.len().saturating_sub(1);
    for (nth, step) in steps.iter_mut().enumerate().skip(1) {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let is_high = step.end.angle == Some(ShotAngle::High) || words.contains(&"high");
        let is_open = step.end.subjects.is_empty() && step.start == Framing::default() && step.via.is_none();
        let flies = matches!(step.movement, Move::FlyThrough | Move::Follow | Move::CraneUp | Move::PedestalUp);
        if nth == last && is_high && is_open && flies && words.contains(&"corner") {
            step.movement = Move::PullOut;
            step.end = Framing { angle: Some(ShotAngle::High), whole: true, ..Framing::default() };
        }
    }
}

/// Rises from a low angle where both ends of a rise are said to be low: `a low angle, spiralling upward around it`.
pub(crate) fn rise_from_low(steps: &mut [Step]) {
    for step in steps {
        let rises = |movement: &Move| matches!(movement, Move::CraneUp | Move::PedestalUp);
        let is_low = matches!(step.start.angle, Some(ShotAngle::Low | ShotAngle::Worm));
        if is_low && step.start.angle == step.end.angle && (rises(&step.movement) || step.with.iter().any(rises)) {
            step.end.angle = None;
        }
    }
}

/// Leaves out that a way passes what it begins at: `begin on the pillows, ease across the bed toward the window`.
pub(crate) fn begin_at_passed(steps: &mut [Step]) {
    for step in steps.iter_mut().filter(|step| step.movement == Move::PushIn) {
        let starts = &step.start.subjects;
        let other = step.end.subjects.iter().all(|id| !starts.contains(id)) && !step.end.subjects.is_empty();
        let passes = |via: &mut Via| {
            matches!(via.how, Pass::Over | Pass::Past | Pass::Along) && via.objects.iter().all(|id| starts.contains(id))
        };
        if other {
            step.via.take_if(passes);
        }
    }
}

/// Verbs of the end of a way, before `on` what it ends on.
const STOPS: [&str; 7] = ["stop", "end", "finish", "settle", "land", "halt", "rest"];

/// Ends a slide on the thing that its words stop on, where they name no other: `glide along the shelf of teapots and stop on the
/// red one`.
pub(crate) fn stop_on_only(linked: &Linked, steps: &mut [Step]) {
    for step in steps.iter_mut().filter(|step| matches!(step.movement, Move::TruckLeft | Move::TruckRight)) {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let stopped = (0..words.len().saturating_sub(2)).find_map(|at| {
            let is_stop = STOPS.iter().any(|verb| is_form(words[at], verb));
            let is_on = matches!(words[at + 1], "on" | "at" | "with");
            linked.slot_at(words[at + 2]).filter(|_| is_stop && is_on)
        });
        let Some(id) = stopped.filter(|_| step.end.subjects.is_empty()) else { continue };
        let ids = linked.expanded(&[id]);
        if step.via.as_ref().is_some_and(|via| via.how == Pass::Along && via.objects == ids) {
            step.via = None;
            step.end = Framing { subjects: ids, place: Some(FramePlace::AtCenter), ..step.end.clone() };
        }
    }
}

/// Words by which something holds all the time.
const ALL_ALONG: [&[&str]; 8] = [
    &["all", "along"],
    &["throughout"],
    &["the", "whole", "time"],
    &["the", "whole", "way"],
    &["at", "all", "times"],
    &["all", "the", "time"],
    &["all", "the", "way", "through"],
    &["the", "entire", "time"],
];

/// Goes round a thing a little where the words keep it in its place in the frame on a way to a side: `slide right, the
/// skull parked on the left third all along`.
pub(crate) fn stay_in_place(linked: &Linked, steps: &mut [Step]) {
    for step in steps.iter_mut().filter(|step| step.start == Framing::default() && step.end.place.is_some()) {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let holds = (0..words.len()).any(|at| ALL_ALONG.iter().any(|along| words[at..].starts_with(along)));
        // A slide with nothing turned would leave it behind.
        let arc = match step.movement {
            Move::TruckLeft => Move::ArcLeft,
            Move::TruckRight => Move::ArcRight,
            _ => continue,
        };
        if holds && !step.end.subjects.is_empty() {
            (step.movement, step.amount) = (arc, step.amount.or(Some(Amount::Slight)));
        }
    }
}

/// Words of further ways to sides: `to the right`, `and left once more`.
const ONCE_MORE: &str = "to the and then . , again once more back over it a little bit slowly gently";

/// Goes to each side that the words list behind one verb: `we sway to the left ... to the right ... and to the left once more`.
pub(crate) fn sway_to_each(linked: &Linked, direction: &mut Direction) {
    let words: Vec<(&str, [usize; 2])> = linked.words_in([0, usize::MAX]).collect();
    for nth in (0..direction.program.steps.len()).rev() {
        let step = &direction.program.steps[nth];
        if !matches!(step.movement, Move::TruckLeft | Move::TruckRight | Move::PanLeft | Move::PanRight) {
            continue;
        }
        let Some([from, _]) = step.words else { continue };
        let next = direction.program.steps.get(nth + 1).and_then(|step| step.words).map_or(usize::MAX, |next| next[0]);
        let own: Vec<(&str, [usize; 2])> =
            words.iter().filter(|(_, span)| (from..next).contains(&span[0])).copied().collect();
        let sides = sides_in(&own);
        if sides.len() < 3 {
            continue;
        }
        let moved = |is_left: bool| match step.movement {
            Move::TruckLeft | Move::TruckRight => [Move::TruckRight, Move::TruckLeft][usize::from(is_left)],
            _ => [Move::PanRight, Move::PanLeft][usize::from(is_left)],
        };
        let mut base = Step { either_way: false, ..step.clone() };
        if matches!(step.movement, Move::TruckLeft | Move::TruckRight) && !step.end.subjects.is_empty() {
            // What all of them would end on is what they look at.
            base.look = Some(Look::At(std::mem::take(&mut base.end).subjects));
        }
        let swayed: Vec<Step> =
            sides.iter().map(|is_left| Step { movement: moved(*is_left), ..base.clone() }).collect();
        let certainty = direction.certainty.get(nth).cloned();
        let cameras = direction.step_cameras.get(nth).copied();
        for (more, step) in swayed.into_iter().enumerate() {
            if more == 0 {
                direction.program.steps[nth] = step;
                continue;
            }
            direction.program.steps.insert(nth + more, step);
            if let Some(certainty) = &certainty {
                direction.certainty.insert(nth + more, certainty.clone());
            }
            if let Some(cameras) = cameras {
                direction.step_cameras.insert(nth + more, cameras);
            }
        }
    }
}

/// The sides that words list one after another, whether each is the left one: nothing else stands between them.
fn sides_in(words: &[(&str, [usize; 2])]) -> Vec<bool> {
    let mut sides = Vec::new();
    let first = words.iter().position(|(word, _)| matches!(*word, "left" | "right"));
    for (word, _) in words.iter().skip(first.unwrap_or(words.len())) {
        match *word {
            "left" => sides.push(true),
            "right" => sides.push(false),
            word if is_listed(ONCE_MORE, word) || !word.contains(char::is_alphanumeric) => {}
            _ => break,
        }
    }
    let alternates = sides.windows(2).all(|two| two[0] != two[1]);
    if alternates { sides } else { Vec::new() }
}

/// Words that begin what happens at the same time as the item of a list before it.
const AT_ONCE: &str = "simultaneously concurrently meanwhile";

/// Joins a step that happens at the same time as the one before it: `2) yaw left. 3) simultaneously FOV to 60°`.
pub(crate) fn join_simultaneous(linked: &Linked, direction: &mut Direction) {
    for nth in (1..direction.program.steps.len()).rev() {
        let [before, step] = &direction.program.steps[nth - 1..=nth] else { continue };
        let words = linked.texts_in(step.words.unwrap_or_default());
        let is_at_once = words.iter().take(4).any(|word| is_listed(AT_ONCE, word));
        let is_plain = step.with.is_empty() && step.via.is_none() && step.start == Framing::default();
        let fits = before.movement != Move::Static
            && step.movement != Move::Static
            && before.movement != step.movement
            && before.with.len() < MAX_SECOND_MOVES;
        let same =
            step.end.subjects.is_empty() || before.end.subjects.is_empty() || before.end.subjects == step.end.subjects;
        if !(is_at_once && is_plain && fits && same) {
            continue;
        }
        let shown = direction.program.steps[..nth].iter().rev().find_map(|step| step.end.lens.or(step.start.lens));
        let mut with = before.with.clone();
        with.push(match (step.movement, shown, step.end.lens) {
            (Move::ZoomIn | Move::ZoomOut, Some(Lens::FovDeg(first)), Some(Lens::FovDeg(last))) => {
                if last > first {
                    Move::ZoomOut
                } else {
                    Move::ZoomIn
                }
            }
            (movement, ..) => movement,
        });
        let lens = before.end.lens.or(step.end.lens);
        let end = Framing { lens, size: before.end.size.or(step.end.size), ..before.end.clone() };
        let one = Step { with, end, words: before.joint_words(step), ..before.clone() };
        direction.join_steps(nth, one);
    }
}

#[cfg(test)]
mod tests {
    use super::super::fixture::{about, direction, linked};
    use super::*;
    use cinesplat_language::Quantity;

    fn measured(text: &str, kind: QuantityKind, value: f64) -> Linked {
        Linked { quantities: vec![Quantity { kind, value }; 2], ..linked(text) }
    }

    fn step(movement: Move, text: &str) -> Step {
        about(movement, &[5], [0, text.len()])
    }

    #[test]
    fn a_share_of_a_way_is_measured() {
        let text = "dolly in <qty-0> . back half that distance";
        let linked = measured(text, QuantityKind::Units, 1.5);
        let first = Step { amount: Some(Amount::Units(1.5)), words: Some([0, 18]), ..Step::of(Move::PushIn) };
        let back = Step { amount: Some(Amount::Factor(0.5)), words: Some([19, text.len()]), ..Step::of(Move::PullOut) };
        let mut steps = vec![first, back];
        take_relative_amounts(&linked, &mut steps);
        assert_eq!(steps[1].amount, Some(Amount::Units(0.75)));
    }

    #[test]
    fn closer_by_a_length_is_no_distance() {
        let nearer = |text: &str| {
            let linked = measured(text, QuantityKind::Units, 0.5);
            let mut steps = vec![step(Move::PushIn, text)];
            steps[0].end.distance = Some(0.5);
            come_closer_by(&linked, &mut steps);
            (steps[0].amount, steps[0].end.distance)
        };
        assert_eq!(nearer("go closer to <obj-0> , <qty-0> or so"), (Some(Amount::Units(0.5)), None));
        assert_eq!(nearer("go closer to <obj-0> , <qty-0> from it"), (None, Some(0.5)));
    }

    #[test]
    fn a_way_to_a_side_joins_a_descent() {
        let with = |text: &str| {
            let mut steps = vec![step(Move::CraneDown, text)];
            move_aside_meanwhile(&linked(text), &mut steps);
            steps.remove(0).with
        };
        assert_eq!(with("sink by <obj-0> while tracking left"), [Move::TruckLeft]);
        assert_eq!(with("sink to <obj-0> on the left"), []);
    }

    #[test]
    fn sides_in_a_list_are_ways() {
        let text = "sway to the left . . . to the right . . . and to the left once more before <obj-0>";
        let mut swayed = direction(vec![step(Move::TruckLeft, text)]);
        sway_to_each(&linked(text), &mut swayed);
        let moves: Vec<Move> = swayed.program.steps.iter().map(|step| step.movement).collect();
        assert_eq!(moves, [Move::TruckLeft, Move::TruckRight, Move::TruckLeft]);
        let text = "slide to the left past the right side of <obj-0>";
        let mut slid = direction(vec![step(Move::TruckLeft, text)]);
        sway_to_each(&linked(text), &mut slid);
        assert_eq!(slid.program.steps.len(), 1);
    }

    #[test]
    fn what_happens_at_once_is_one_step() {
        let text = "yaw left . simultaneously zoom out";
        let pan = Step { words: Some([0, 8]), ..Step::of(Move::PanLeft) };
        let zoom = Step { words: Some([11, text.len()]), ..Step::of(Move::ZoomOut) };
        let mut joined = direction(vec![pan, zoom]);
        join_simultaneous(&linked(text), &mut joined);
        assert_eq!((joined.program.steps.len(), &joined.program.steps[0].with[..]), (1, &[Move::ZoomOut][..]));
    }

    #[test]
    fn tilts_climbs_and_waypoints_begin_and_end_as_said() {
        let text = "tilt from the floor to <obj-0>";
        let mut steps = vec![step(Move::TiltUp, text)];
        tilt_from_floor(&linked(text), &mut steps);
        assert_eq!(steps[0].start.part, SubjectPart::Bottom);
        let text = "a drone shot climbing <obj-0>";
        let mut steps = vec![step(Move::CraneUp, text)];
        steps[0].start.angle = Some(ShotAngle::High);
        climb_from_below(&linked(text), &mut steps);
        assert_eq!(steps[0].start.angle, None);
        let text = "at <obj-1> . above <obj-0> , looking down";
        let mut down = Step { words: Some([13, text.len()]), ..step(Move::TiltDown, text) };
        down.end.angle = Some(ShotAngle::Overhead);
        let mut steps = vec![about(Move::Static, &[7], [0, 12]), down];
        travel_above(&linked(text), &mut steps);
        assert_eq!(steps[1].movement, Move::Follow);
    }

    #[test]
    fn ways_begin_and_end_where_the_words_say() {
        let low = Framing { angle: Some(ShotAngle::Low), ..Framing::default() };
        let mut steps =
            vec![Step { start: low.clone(), end: low, with: vec![Move::CraneUp], ..Step::of(Move::OrbitLeft) }];
        rise_from_low(&mut steps);
        assert_eq!((steps[0].start.angle, steps[0].end.angle), (Some(ShotAngle::Low), None));
        let start = Framing { subjects: vec![7], ..Framing::default() };
        let via = Some(Via { how: Pass::Over, objects: vec![7] });
        let mut steps = vec![Step { start, via, ..step(Move::PushIn, "ease to <obj-0>") }];
        begin_at_passed(&mut steps);
        assert_eq!(steps[0].via, None);
        let text = "glide along <obj-0> and stop on <obj-0>";
        let via = Some(Via { how: Pass::Along, objects: vec![5] });
        let mut steps = vec![Step { via, words: Some([0, text.len()]), ..Step::of(Move::TruckLeft) }];
        stop_on_only(&linked(text), &mut steps);
        assert_eq!((&steps[0].end.subjects[..], &steps[0].via), (&[5][..], &None));
        let text = "round it , and out high in a corner";
        let out = Step {
            end: Framing { angle: Some(ShotAngle::High), ..Framing::default() },
            words: Some([11, text.len()]),
            ..Step::of(Move::FlyThrough)
        };
        let mut steps = vec![Step::of(Move::OrbitLeft), out];
        end_in_corner(&linked(text), &mut steps);
        assert_eq!((steps[1].movement, steps[1].end.whole), (Move::PullOut, true));
    }

    #[test]
    fn a_place_that_holds_holds_from_the_start() {
        let text = "slide right , <obj-0> on the left third all along";
        let mut steps = vec![step(Move::TruckRight, text)];
        steps[0].end.place = Some(FramePlace::AtLeft);
        stay_in_place(&linked(text), &mut steps);
        assert_eq!(steps[0].movement, Move::ArcRight);
    }
}

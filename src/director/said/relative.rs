//! What is said in relation to what was said before, or to where the camera is: `back half that distance`, `closer, half a metre or
//! so`, `tilt from the floor up`, `stop on the red one`.

use cinesplat_language::{Linked, Quantity, QuantityKind, is_listed};
use cinesplat_operator::{Amount, FramePlace, Framing, Look, Motion, Pass, Program, Step, SubjectPart, Via};
use cinesplat_trajectory::{Move, ShotAngle};

use super::directions::is_form;

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
        // A way back by half the distance that is left would come nearer.
        if let (Move::PullOut, Some(Amount::Factor(share)), Some(Amount::Units(units))) =
            (step.movement, step.amount, extent)
            && share < 1.0
        {
            step.amount = Some(Amount::Units(share * units));
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
        let (share, end) = match (of_words, linked.quantity_at(words[at])) {
            (Some((share, value)), _) => (*value, at + share.len()),
            (None, Some(Quantity { kind: QuantityKind::Factor, value })) => (value, at + 1),
            (None, Some(Quantity { kind: QuantityKind::Percent, value })) => (value / 100.0, at + 1),
            (None, _) => return None,
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

/// Pans to the right where the words turn clockwise, as seen from above: `yaw by 120° clockwise`.
pub(crate) fn pan_clockwise(linked: &Linked, steps: &mut [Step]) {
    for step in steps.iter_mut().filter(|step| matches!(step.movement, Move::PanLeft | Move::PanRight)) {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let says = |list: &str| words.iter().any(|word| is_listed(list, word));
        if says("left right counter anti") {
            continue;
        }
        if says("clockwise cw") {
            (step.movement, step.either_way) = (Move::PanRight, false);
        } else if says("counterclockwise anticlockwise ccw acw") {
            (step.movement, step.either_way) = (Move::PanLeft, false);
        }
    }
}

/// Words of a high camera.
const HIGH: &str = "high above over overhead down top aerial bird birds birdseye sky air";

/// Begins a rise where the words leave it open: `a drone shot, climbing the trunk` does not begin up in the air.
pub(crate) fn climb_from_below(linked: &Linked, steps: &mut [Step]) {
    for step in steps.iter_mut().filter(|step| matches!(step.movement, Move::CraneUp | Move::PedestalUp)) {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let is_drone = linked.tokens_text.split(' ').any(|word| word.starts_with("drone"));
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
    let [_, .., step] = steps else { return };
    let words = linked.texts_in(step.words.unwrap_or_default());
    let is_high = step.end.angle == Some(ShotAngle::High) || words.contains(&"high");
    let is_open = step.end.subjects.is_empty() && step.start == Framing::default() && step.via.is_none();
    let flies = matches!(step.movement, Move::FlyThrough | Move::Follow | Move::CraneUp | Move::PedestalUp);
    if is_high && is_open && flies && words.contains(&"corner") {
        step.movement = Move::PullOut;
        step.end = Framing { angle: Some(ShotAngle::High), whole: true, ..Framing::default() };
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
    rise_from_passed(steps);
    rise_from_named(steps);
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

/// Begins a rise or a descent at what it passes on the way to something else: `up past the drawers until the knives are in the
/// middle`.
fn rise_from_passed(steps: &mut [Step]) {
    let Some(step) = steps.first_mut() else { return };
    let rises = matches!(step.movement, Move::CraneUp | Move::CraneDown | Move::PedestalUp | Move::PedestalDown);
    let is_open = step.start == Framing::default() && step.look.is_none();
    let passed = step.via.take_if(|via| {
        let leads_on = !step.end.subjects.is_empty() && via.objects.iter().all(|id| !step.end.subjects.contains(id));
        rises && is_open && leads_on && via.how == Pass::Past
    });
    if let Some(via) = passed {
        step.start.subjects = via.objects;
    }
}

/// Rises from the thing that a reveal sets out from: `crane up from the chair to reveal the desk` begins with the chair.
fn rise_from_named(steps: &mut [Step]) {
    for step in steps.iter_mut().filter(|step| step.movement == Move::Reveal && step.via.is_none()) {
        let leads_on = |ids: &[u32]| !ids.is_empty() && ids.iter().all(|id| !step.start.subjects.contains(id));
        let way = match step.with[..] {
            [Move::PedestalUp | Move::CraneUp] => Some(Move::CraneUp),
            [Move::PedestalDown | Move::CraneDown] => Some(Move::CraneDown),
            _ => None,
        };
        let is_named = !step.start.subjects.is_empty() && !step.start.hidden && leads_on(&step.end.subjects);
        if let Some(way) = way.filter(|_| is_named) {
            (step.movement, step.with) = (way, Vec::new());
        }
    }
}

/// Looks straight ahead, and turns nowhere, on a way straight up or down: `down like a lift, the camera facing dead ahead`.
pub(crate) fn level_lifts(program: &mut Program) {
    let [step] = &mut program.steps[..] else { return };
    let is_lift = matches!(step.movement, Move::PedestalUp | Move::PedestalDown) && step.with.is_empty();
    if is_lift && step.look == Some(Look::Ahead) {
        step.look = None;
        program.forbid(Motion::Turn);
    }
}

/// Turns nowhere on a way that is said to go straight up or down from one thing to another: `boom straight up from the drawers until
/// we're level with the plates`.
pub(crate) fn lift_straight(linked: &Linked, program: &mut Program) {
    let [step] = &mut program.steps[..] else { return };
    let words = linked.texts_in(step.words.unwrap_or_default());
    let is_straight = words.windows(2).any(|pair| pair[0] == "straight" && matches!(pair[1], "up" | "down"));
    let is_lift = matches!(step.movement, Move::PedestalUp | Move::PedestalDown) && step.with.is_empty();
    let leads = !step.start.subjects.is_empty() && !step.end.subjects.is_empty();
    if is_lift && is_straight && leads && step.look.is_none() && step.start.subjects != step.end.subjects {
        program.forbid(Motion::Turn);
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

#[cfg(test)]
mod tests {
    use super::super::fixture::{about, linked};
    use super::*;

    #[test]
    fn a_lift_that_goes_straight_up_turns_nowhere() {
        let forbids = |text: &str| {
            let start = about(Move::Static, &[5], [0, 1]).end;
            let step = Step { start, ..about(Move::PedestalUp, &[7], [0, text.len()]) };
            let mut program = Program { steps: vec![step], ..Program::default() };
            lift_straight(&linked(text), &mut program);
            program.forbidden
        };
        assert_eq!(forbids("pedestal straight up from <obj-0> to the height of <obj-1>"), [Motion::Turn]);
        assert_eq!(forbids("pedestal up from <obj-0> to the height of <obj-1>"), []);
    }

    fn measured(text: &str, kind: QuantityKind, value: f64) -> Linked {
        Linked { quantities: vec![Quantity { kind, value }; 2], ..linked(text) }
    }

    fn step(movement: Move, text: &str) -> Step {
        about(movement, &[5], [0, text.len()])
    }

    #[test]
    fn a_rise_begins_at_what_it_sets_out_from() {
        let via = |ids: &[u32]| Some(Via { how: Pass::Past, objects: ids.to_vec() });
        let mut steps = [Step { via: via(&[7]), ..about(Move::CraneUp, &[5], [0, 9]) }];
        begin_at_passed(&mut steps);
        assert_eq!((&steps[0].start.subjects[..], &steps[0].via), (&[7][..], &None));
        let mut steps = [Step { via: via(&[7]), ..about(Move::TruckLeft, &[5], [0, 9]) }];
        begin_at_passed(&mut steps);
        assert!(steps[0].start.subjects.is_empty() && steps[0].via.is_some());
        let reveal = |start: &[u32], way: Move| {
            let start = Framing { subjects: start.to_vec(), ..Framing::default() };
            let mut steps = [Step { start, with: vec![way], ..about(Move::Reveal, &[5], [0, 9]) }];
            begin_at_passed(&mut steps);
            (steps[0].movement, steps[0].with.len())
        };
        assert_eq!(reveal(&[7], Move::PedestalUp), (Move::CraneUp, 0));
        assert_eq!(reveal(&[], Move::PedestalUp), (Move::Reveal, 1));
        assert_eq!(reveal(&[7], Move::TruckLeft), (Move::Reveal, 1));
    }

    #[test]
    fn a_lift_that_faces_ahead_turns_nowhere() {
        let ahead = Step { look: Some(Look::Ahead), ..about(Move::PedestalDown, &[5], [0, 9]) };
        let mut program = Program { steps: vec![ahead], ..Program::default() };
        level_lifts(&mut program);
        assert_eq!((&program.forbidden[..], &program.steps[0].look), (&[Motion::Turn][..], &None));
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
        let text = "yaw 120 degrees clockwise from <obj-0>";
        let mut steps = vec![step(Move::PanLeft, text)];
        pan_clockwise(&linked(text), &mut steps);
        assert_eq!(steps[0].movement, Move::PanRight);
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

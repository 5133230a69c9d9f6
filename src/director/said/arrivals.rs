//! Ways that the words begin and end at things: `leave the door, drive past the chairs`, `then hover in front of the
//! telescope`.

use cinesplat_language::Linked;
use cinesplat_operator::{Framing, Pass, Step, Via};
use cinesplat_trajectory::{Move, ShotAngle};

use super::directions::is_form;
use crate::direction::Direction;

/// Verbs of a camera that comes to a stop.
const STOPS: [&str; 10] = ["stop", "halt", "hover", "brake", "park", "land", "finish", "settle", "arrive", "pull"];
/// Verbs of a camera that goes its way with its eyes ahead, and words of one that slides.
const DRIVES: [&str; 10] = ["drive", "walk", "ride", "run", "fly", "stroll", "wander", "cruise", "race", "march"];
const SLIDES: [&str; 10] =
    ["truck", "slide", "crab", "track", "sideways", "sideway", "lateral", "left", "right", "along"];
/// Verbs of a camera that sets out from a thing.
const LEAVES: [&str; 4] = ["leave", "exit", "depart", "start"];

/// Lets ways begin and end at the things that the words name for it.
pub(crate) fn go_between_stops(linked: &Linked, steps: &mut [Step]) {
    go_to_stop(linked, steps);
    for step in steps {
        drive_away(linked, step);
    }
}

/// Ends a slide at the thing at which the next words stop, and rests there: `truck left along the bench, candle first, pull up on
/// the vase`.
pub(crate) fn end_at_stops(linked: &Linked, steps: &mut [Step]) {
    for nth in 1..steps.len() {
        let (before, rest) = steps.split_at_mut(nth);
        let (Some(slide), Some(stop)) = (before.last_mut(), rest.first_mut()) else { continue };
        let is_truck = matches!(slide.movement, Move::TruckLeft | Move::TruckRight);
        let own = linked.texts_in(slide.words.unwrap_or_default());
        let first = own.windows(2).find(|pair| pair[1] == "first").and_then(|pair| linked.slot_at(pair[0]));
        if is_truck
            && first.is_some_and(|id| linked.expanded(&[id]) == slide.end.subjects)
            && slide.start.subjects.is_empty()
        {
            slide.start.subjects.clone_from(&slide.end.subjects);
        }
        let is_slide = is_truck && slide.duration_secs.is_none();
        let is_open = slide.end.subjects.is_empty() || slide.end.subjects == slide.start.subjects;
        let words = linked.texts_in(stop.words.unwrap_or_default());
        let stops =
            words.iter().take(5).any(|word| word.starts_with("stop") || STOPS.iter().any(|verb| is_form(word, verb)));
        let is_rest = matches!(stop.movement, Move::Static | Move::Follow)
            && !stop.cut
            && !stop.end.subjects.is_empty()
            && stop.end.subjects != slide.start.subjects
            && stop.start.subjects.is_empty();
        if is_slide && is_open && stops && is_rest {
            slide.end.subjects.clone_from(&stop.end.subjects);
            stop.movement = Move::Static;
        }
    }
}

/// Goes toward a thing over which the network flies before it shows it: `drift in low across the table top, and close on the teapot`. Above
/// it a camera would look straight down.
pub(crate) fn arrive_at_passed(linked: &Linked, direction: &mut Direction) {
    direction.join_pairs(|first, second| {
        let over = first.via.as_ref().filter(|via| via.how == Pass::Over)?;
        let is_bare = first.end.subjects.is_empty() && first.duration_secs.is_none() && !first.returns;
        let comes = matches!(second.movement, Move::Static | Move::Follow | Move::PushIn)
            && !second.cut
            && second.start.subjects.is_empty()
            && second.duration_secs.is_none()
            && second.via.is_none();
        let is_way = first.movement == Move::FlyThrough && is_bare && comes && over.objects == second.end.subjects;
        is_way.then(|| {
            let is_low = linked.texts_in(first.words.unwrap_or_default()).contains(&"low");
            let angle = second.end.angle.or(is_low.then_some(ShotAngle::Low));
            let end = Framing { angle, ..second.end.clone() };
            let words = first.joint_words(second);
            Step { start: first.start.clone(), end, speed: first.speed, words, ..Step::of(Move::PushIn) }
        })
    });
}

/// Goes to the thing before which the words stop: a camera that only turned to it would not be in front of it.
fn go_to_stop(linked: &Linked, steps: &mut [Step]) {
    for nth in 1..steps.len() {
        let shown = steps[nth - 1].end.subjects.clone();
        let step = &mut steps[nth];
        let words = linked.texts_in(step.words.unwrap_or_default());
        let is_goal = |word: &&str| step.end.subjects.iter().any(|id| linked.names(word, *id));
        let in_front =
            |at: usize| words[at..].starts_with(&["in", "front", "of"]) && words[at + 3..].iter().take(3).any(is_goal);
        let stops = |at: usize| words[..at].iter().any(|word| STOPS.iter().any(|verb| is_form(word, verb)));
        let is_other = !step.end.subjects.is_empty() && step.end.subjects != shown && !step.cut;
        let pulls_up = |at: usize| {
            is_form(words[at], "pull")
                && matches!(words.get(at + 1..at + 3), Some(["up", "at" | "by" | "beside" | "in"]))
        };
        let rises = matches!(step.movement, Move::CraneUp | Move::PedestalUp) && step.start.subjects.is_empty();
        let arrives = step.movement == Move::Static && (0..words.len()).any(|at| in_front(at) && stops(at))
            || rises && (0..words.len()).any(pulls_up);
        if is_other && arrives {
            step.movement = Move::Follow;
        }
        // `Retreat to the window`: it is behind the camera.
        let backs = |at: usize| {
            let is_verb = ["retreat", "withdraw"].iter().any(|verb| is_form(words[at], verb));
            let is_back = words[at] == "back" && matches!(words.get(at + 1), Some(&("up" | "off" | "away")));
            let to = at + 1 + usize::from(is_back);
            (is_verb || is_back) && words.get(to) == Some(&"to") && words[to..].iter().take(3).any(is_goal)
        };
        if step.movement == Move::PullOut && is_other && !step.end.whole && (0..words.len()).any(backs) {
            step.end.subjects.clear();
        }
    }
}

/// Drives from the thing that the words leave, where the network reads a slide: nobody drives sideways.
fn drive_away(linked: &Linked, step: &mut Step) {
    let words = linked.texts_in(step.words.unwrap_or_default());
    let has = |verbs: &[&str]| words.iter().any(|word| verbs.iter().any(|verb| is_form(word, verb)));
    let is_slide = matches!(step.movement, Move::TruckLeft | Move::TruckRight);
    let goes = !step.start.subjects.is_empty() && !step.end.subjects.is_empty();
    if !is_slide || !goes || step.start.subjects == step.end.subjects || !has(&DRIVES) || has(&SLIDES) {
        return;
    }
    (step.movement, step.either_way) = (Move::FlyThrough, false);
    let leaves = |at: usize| {
        let is_verb = words[at] == "from" || LEAVES.iter().any(|verb| is_form(words[at], verb));
        let next = || words[at + 1..].iter().take(3);
        is_verb && next().any(|word| step.start.subjects.iter().any(|id| linked.names(word, *id)))
    };
    if (0..words.len()).any(leaves) {
        let objects = std::mem::take(&mut step.start.subjects);
        step.via = Some(Via { how: Pass::From, objects });
    }
}

#[cfg(test)]
mod tests {
    use super::super::fixture::{direction, linked, read, seen};
    use super::*;
    use cinesplat_operator::Framing;

    fn directed(text: &str, steps: Vec<Step>) -> Vec<Step> {
        let mut steps: Vec<Step> =
            steps.into_iter().map(|step| Step { words: Some([0, text.len()]), ..step }).collect();
        go_between_stops(&linked(text), &mut steps);
        steps
    }

    fn about(id: u32) -> Framing {
        Framing { subjects: vec![id], ..Framing::default() }
    }

    #[test]
    fn what_is_flown_over_and_then_shown_is_gone_to() {
        let text = "drift in low across <obj-0> | and close on it";
        let (linked, mut steps) = read(text, &[(Move::FlyThrough, 5), (Move::Static, 5)]);
        steps[0].end = Framing::default();
        steps[0].via = Some(Via { how: Pass::Over, objects: vec![5] });
        let mut near = direction(steps);
        arrive_at_passed(&linked, &mut near);
        assert_eq!(seen(&near.program.steps), [(Move::PushIn, vec![5])]);
        assert_eq!(near.program.steps[0].end.angle, Some(ShotAngle::Low));
        let (linked, mut steps) = read(text, &[(Move::FlyThrough, 5), (Move::Static, 7)]);
        steps[0].via = Some(Via { how: Pass::Over, objects: vec![5] });
        let mut other = direction(steps);
        arrive_at_passed(&linked, &mut other);
        assert_eq!(other.program.steps.len(), 2);
    }

    #[test]
    fn a_stop_in_front_of_a_thing_is_a_way_to_it() {
        let steps =
            || vec![Step { end: about(5), ..Step::of(Move::PushIn) }, Step { end: about(7), ..Step::of(Move::Static) }];
        assert_eq!(directed("in on <obj-0> , then hover in front of <obj-1>", steps())[1].movement, Move::Follow);
        assert_eq!(directed("in on <obj-0> , then hold on <obj-1>", steps())[1].movement, Move::Static);
    }

    #[test]
    fn a_slide_ends_where_it_stops() {
        let text = "truck left along , <obj-0> first , pull up on <obj-1>";
        let slide = Step { end: about(5), words: Some([0, 31]), ..Step::of(Move::TruckLeft) };
        let stop = Step { end: about(7), words: Some([32, text.len()]), ..Step::of(Move::Follow) };
        let mut steps = [slide, stop];
        end_at_stops(&linked(text), &mut steps);
        assert_eq!((&steps[0].start, &steps[0].end, steps[1].movement), (&about(5), &about(7), Move::Static));
    }

    #[test]
    fn who_drives_looks_where_he_goes() {
        let truck = Step { start: about(5), end: about(7), ..Step::of(Move::TruckRight) };
        let driven = directed("leave <obj-0> and drive to <obj-1>", vec![truck.clone()]);
        assert_eq!((driven[0].movement, driven[0].start.subjects.len()), (Move::FlyThrough, 0));
        assert_eq!(directed("slide from <obj-0> to <obj-1>", vec![truck])[0].movement, Move::TruckRight);
    }
}

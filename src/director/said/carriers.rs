//! Whether the camera travels or turns, by the verb that carries it: `float up to its headstock` is no tilt, and `pan across
//! to the guitar` no walk.

use cinesplat_language::{Linked, is_listed};
use cinesplat_operator::{Amount, Framing, Motion, Pass, Program, Step};
use cinesplat_trajectory::{Move, ShotSize};

use super::directions::{is_form, place_behind, says_any};
use super::small_moves::pan_as_said;
use crate::direction::Direction;

/// Verbs of a camera that goes up or down itself.
const CARRIES: [&str; 12] =
    ["float", "drift", "glide", "travel", "climb", "ride", "fly", "sail", "soar", "ascend", "descend", "slide"];
/// Words between them and the way.
const BETWEEN: [&str; 10] =
    ["slowly", "gently", "smoothly", "softly", "straight", "right", "gracefully", "on", "all", "steadily"];
/// Words of a turn on the spot, besides forms of `tilt` and `pan`.
const TURNS: &str = "tilt tilts tilted tilting look looks looking gaze gazes gazing eye eyes glance glances head lens pan pans \
    panning pivot pivots swivel angle angled angling nod tripod spot";
/// Words of a way over the ground.
const TRAVELS: [&str; 17] = [
    "walk", "dolly", "track", "truck", "push", "pull", "fly", "glide", "slide", "drift", "travel", "go", "move",
    "orbit", "circle", "follow", "crane",
];

/// Gives the steps the moves that their verbs carry, and shows what they were read to pass or to be seen from.
pub(crate) fn carry_as_said(linked: &Linked, steps: &mut [Step]) {
    carry_tilts(linked, steps);
    pan_to_things(linked, steps);
    rest_on_source(linked, steps);
    reveal_passed(steps);
}

/// Verbs of somebody who carries the camera up or down, what is carried, and words between them.
const LIFTS: [&str; 14] = [
    "lift", "raise", "hoist", "lower", "drop", "bring", "move", "take", "boom", "jib", "push", "send", "elevate",
    "rise",
];
const CAMERAS: [&str; 6] = ["camera", "cam", "lens", "rig", "it", "tripod"];
const DETERMINERS: [&str; 4] = ["the", "my", "our", "your"];
/// Words that rule out what stands behind them, and words between the two.
const BANS: [&str; 8] = ["no", "not", "without", "never", "zero", "'t", "dont", "nor"];
const BANNED: [&str; 10] = ["any", "a", "the", "pan", "panning", "or", "and", "do", "it", "camera"];

/// Whether the words lift or lower the camera and rule out that it tilts: `lift the camera straight up to the teapot, no tilting`.
fn lifts_level(words: &[&str]) -> bool {
    let is_ban = |at: usize| {
        let before = words[..at].iter().rev().take(4).find(|word| !BANNED.contains(word));
        before.is_some_and(|word| BANS.contains(word))
    };
    let is_banned = (0..words.len()).any(|at| is_form(words[at], "tilt") && is_ban(at));
    let is_lift = |at: usize| {
        let thing = at + 1 + words[at + 1..].iter().take(1).take_while(|word| DETERMINERS.contains(word)).count();
        LIFTS.iter().any(|verb| is_form(words[at], verb)) && words.get(thing).is_some_and(|word| CAMERAS.contains(word))
    };
    let moves = |at: usize| {
        let camera = words[..at].iter().rev().take(2).any(|word| matches!(*word, "camera" | "cam"));
        camera && ["lift", "rise", "lower", "drop", "climb", "sink"].iter().any(|verb| is_form(words[at], verb))
    };
    is_banned && (0..words.len()).any(|at| is_lift(at) || moves(at))
}

/// Makes a tilt a rise or a descent where the words carry the camera up or down and name no turn, or rule it out.
fn carry_tilts(linked: &Linked, steps: &mut [Step]) {
    for step in steps.iter_mut().filter(|step| matches!(step.movement, Move::TiltUp | Move::TiltDown)) {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let behind = linked.words_in([step.words.unwrap_or_default()[1], usize::MAX]).map(|(word, _)| word);
        let near: Vec<&str> = words.iter().copied().chain(behind.take(5)).collect();
        if lifts_level(&near) {
            step.movement = if step.movement == Move::TiltUp { Move::PedestalUp } else { Move::PedestalDown };
            continue;
        }
        let is_carried = |way: &[&str]| (0..words.len()).any(|at| carries(&words, at, way));
        if words.iter().any(|word| is_listed(TURNS, word)) {
            continue;
        }
        step.movement = match step.movement {
            Move::TiltUp if is_carried(&["up", "upward", "upwards"]) => Move::PedestalUp,
            Move::TiltDown if is_carried(&["down", "downward", "downwards"]) => Move::PedestalDown,
            movement => movement,
        };
    }
}

/// Whether a verb at word `at` carries the camera one of the ways.
fn carries(words: &[&str], at: usize, ways: &[&str]) -> bool {
    let is_verb = CARRIES.iter().any(|verb| is_form(words[at], verb));
    is_verb && words.get(place_behind(words, at, &BETWEEN)).is_some_and(|word| ways.contains(word))
}

/// Turns on the spot where the words pan to a thing and travel nowhere.
fn pan_to_things(linked: &Linked, steps: &mut [Step]) {
    let travels = |step: &Step| matches!(step.movement, Move::Follow | Move::TruckLeft | Move::TruckRight);
    for step in steps.iter_mut().filter(|step| travels(step) && step.via.is_none() && step.with.is_empty()) {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let pans = words.iter().any(|word| is_form(word, "pan"));
        // `Let go of it`.
        let is_let = |at: usize| at > 0 && is_form(words[at - 1], "let");
        let goes = (0..words.len()).any(|at| !is_let(at) && TRAVELS.iter().any(|verb| is_form(words[at], verb)));
        if pans && !goes && !step.end.subjects.is_empty() {
            pan_as_said(step, &words);
        }
    }
}

/// Shows what a picture at rest was read to be seen from, where no words say where the camera is: `00:07-00:10 sit on TV`.
fn rest_on_source(linked: &Linked, steps: &mut [Step]) {
    for step in steps.iter_mut().filter(|step| step.movement == Move::Static && step.end == Framing::default()) {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let is_source = step.via.as_ref().is_some_and(|via| via.how == Pass::From);
        let says_place = words.iter().any(|word| is_listed("from behind over at by beside near stand", word));
        if is_source && !says_place {
            show_passed(step);
        }
    }
}

/// Reveals what a reveal without a subject was read to pass.
fn reveal_passed(steps: &mut [Step]) {
    let shows_nothing = |step: &&mut Step| {
        step.movement == Move::Reveal && step.start.subjects.is_empty() && step.end.subjects.is_empty()
    };
    steps.iter_mut().filter(shows_nothing).for_each(show_passed);
}

/// Ends a step on what it passes instead of passing it.
fn show_passed(step: &mut Step) {
    step.end.subjects = step.via.take().map(|via| via.objects).unwrap_or_default();
}

/// Phrases of all sides of a thing.
const ALL_SIDES: [&[&str]; 9] = [
    &["every", "side"],
    &["every", "angle"],
    &["all", "sides"],
    &["all", "angles"],
    &["each", "side"],
    &["from", "all", "around"],
    &["from", "all", "round"],
    &["whole", "way", "round"],
    &["whole", "way", "around"],
];
/// Certainty of a picture at rest below which it may be one that the words do not ask for.
const UNSURE: f64 = 0.5;

/// Goes once around a thing of which the words want every side, where a picture at rest was read: `visitors can't walk round
/// it, so the film must do it for them. Every side legible`.
pub(crate) fn show_all_sides(linked: &Linked, direction: &mut Direction) {
    let words: Vec<&str> = linked.tokens_text.split(' ').collect();
    let is_sure = direction.certainty.iter().any(|step| step.probability >= UNSURE);
    let says = says_any(&words, &ALL_SIDES);
    if let [step] = &mut direction.program.steps[..]
        && step.movement == Move::Static
        && step.with.is_empty()
        && !step.end.subjects.is_empty()
        && says
        && !is_sure
    {
        step.end = Framing { subjects: std::mem::take(&mut step.end.subjects), ..Framing::default() };
        (step.movement, step.either_way, step.amount) = (Move::OrbitRight, true, Some(Amount::Degrees(360.0)));
        direction.step_cameras.clear();
    }
}

/// Goes from picture to picture of a list where the words rule out cuts: `no cuts: 1) rack, wide 2) mug, tight`.
pub(crate) fn flow_without_cuts(program: &mut Program) {
    if !program.forbidden.contains(&Motion::Cut) {
        return;
    }
    for nth in 1..program.steps.len() {
        let (before, rest) = program.steps.split_at_mut(nth);
        let (Some(before), Some(step)) = (before.last(), rest.first_mut()) else { continue };
        let is_other = !step.end.subjects.is_empty() && before.end.subjects != step.end.subjects;
        let is_plain = step.movement == Move::Static && step.start == Framing::default() && step.via.is_none();
        let is_sized = step.end.size.is_some_and(|size| Some(size) != before.end.size || size < ShotSize::Medium);
        if is_plain && is_other && is_sized && step.with.is_empty() && step.duration_secs.is_none() {
            (step.movement, step.cut) = (Move::Follow, false);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn some_verbs_carry_the_camera_up() {
        let up = |text: &str| {
            let words: Vec<&str> = text.split(' ').collect();
            (0..words.len()).any(|at| carries(&words, at, &["up"]))
        };
        assert!(up("from the foot of <obj-0> we float up to its headstock"));
        assert!(up("travel slowly up the neck"));
        assert!(!up("run the eye up <obj-0>"));
        assert!(!up("float over to <obj-0> and look up"));
    }

    #[test]
    fn a_tilt_that_is_ruled_out_lifts_the_camera() {
        let lifts = |text: &str| lifts_level(&text.split(' ').collect::<Vec<_>>());
        assert!(lifts("lift the camera straight up to <obj-0> , no tilting"));
        assert!(lifts("the camera drops from <obj-0> to <obj-1> , without any tilt"));
        assert!(lifts("raise it to <obj-0> , don 't tilt"));
        assert!(!lifts("lift the camera 's gaze up to <obj-0>"));
        assert!(!lifts("look up to <obj-0> , no panning , just tilt"));
        assert!(!lifts("lift your eyes to <obj-0> , no tilting of the horizon"));
    }
}

//! How the camera stands, which is no move: `the guitar, camera down low, looking up at it`.

use cinesplat_language::Linked;
use cinesplat_operator::{Framing, Speed, Step};
use cinesplat_trajectory::{Move, ShotAngle};

use super::directions::is_form;
use crate::direction::Direction;

/// Verbs of a camera that goes down, or is brought down.
const SINKS: [&str; 24] = [
    "lower", "drop", "sink", "descend", "crane", "boom", "jib", "pedestal", "come", "go", "get", "move", "dip", "duck",
    "bring", "take", "travel", "float", "glide", "slide", "fall", "drift", "ease", "crouch",
];
/// What is down low, and words between it and `down low`.
const CAMERAS: [&str; 6] = ["camera", "cam", "lens", "tripod", "we", "angle"];
const BETWEEN: [&str; 9] = ["is", "are", "'re", "'s", "stays", "sits", "way", "right", "really"];

/// Rests where the film begins with a camera that is down low and that nothing brings there. What rests behind it holds the same
/// picture.
pub(crate) fn stand_low(linked: &Linked, direction: &mut Direction) {
    let Some(first) = direction.program.steps.first_mut() else { return };
    let sinks = matches!(first.movement, Move::CraneDown | Move::PedestalDown);
    let is_open = first.start == Framing::default() && first.with.is_empty() && first.amount.is_none();
    if !sinks || !is_open || !stands_low(&linked.texts_in(first.words.unwrap_or_default())) {
        return;
    }
    (first.movement, first.either_way, first.speed) = (Move::Static, false, Speed::Normal);
    let [first, second, ..] = &direction.program.steps[..] else { return };
    let goes_on = Step { words: second.words, duration_secs: second.duration_secs, ..Step::of(Move::Static) };
    if *second == goes_on && first.duration_secs.is_none() {
        let one = Step { duration_secs: second.duration_secs, words: first.joint_words(second), ..first.clone() };
        direction.join_steps(1, one);
    }
}

/// Verbs of a camera that stays in the air, words of where it is, and verbs of one that goes down.
const HOVERS: [&str; 3] = ["hover", "hang", "float"];
const ABOVE: [&str; 3] = ["above", "over", "overhead"];
const DESCENDS: [&str; 12] =
    ["lower", "drop", "sink", "descend", "crane", "boom", "come", "go", "dip", "fall", "dive", "settle"];
/// Words of a way forward.
const FORWARD: [&str; 6] = ["forward", "forwards", "closer", "nearer", "towards", "toward"];
const GOES: [&str; 8] = ["come", "go", "move", "walk", "creep", "push", "glide", "step"];

/// Rests above what the words hover over, and goes forward with a camera that is only down at a height: `we hover high above the plant,
/// staring down at it`, `camera down at ankle height, now come forward`.
pub(crate) fn stay_up_and_down(linked: &Linked, steps: &mut [Step]) {
    let sinks = |step: &&mut Step| {
        matches!(step.movement, Move::CraneDown | Move::PedestalDown) && step.with.is_empty() && step.amount.is_none()
    };
    for step in steps.iter_mut().filter(sinks) {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let is_verb = |at: usize, verbs: &[&str]| verbs.iter().any(|verb| is_form(words[at], verb));
        let hovers = (0..words.len())
            .any(|at| is_verb(at, &HOVERS) && words[at + 1..].iter().take(3).any(|word| ABOVE.contains(word)));
        let is_down = |at: usize| {
            let before = words[..at].iter().rev().find(|word| !BETWEEN.contains(word));
            words[at] == "down"
                && matches!(words.get(at + 1), Some(&"at" | &"low"))
                && before.is_some_and(|word| CAMERAS.contains(word))
        };
        let forward = (1..words.len()).any(|at| FORWARD.contains(&words[at]) && is_verb(at - 1, &GOES));
        let is_there = step.end.subjects == step.start.subjects && step.start.angle.is_some();
        if hovers && is_there && !(0..words.len()).any(|at| is_verb(at, &DESCENDS)) {
            step.end = std::mem::take(&mut step.start);
            (step.movement, step.either_way) = (Move::Static, false);
        } else if forward && (0..words.len()).any(is_down) && !step.end.subjects.is_empty() {
            (step.movement, step.either_way) = (Move::PushIn, false);
        }
    }
}

/// Who is on the floor when the film begins.
const WAKES: [&str; 4] = ["wake", "lie", "sprawl", "lying"];
/// Heights of eyes on the floor and of those of who stands, scene units.
const FLOOR_EYES: f64 = 0.3;
const STANDING_EYES: f64 = 1.6;

/// Begins near the floor where somebody wakes up there, and rises to where he stands: `you come to on the floor, you get up`.
pub(crate) fn rise_from_floor(linked: &Linked, steps: &mut [Step]) {
    let Some(step) = steps.iter_mut().take(2).find(|step| matches!(step.movement, Move::PedestalUp | Move::CraneUp))
    else {
        return;
    };
    let words = linked.texts_in([0, step.words.unwrap_or_default()[1]]);
    let ground =
        words.windows(3).position(|three| three[0] == "on" && matches!(three[2], "floor" | "ground" | "carpet"));
    let wakes = |at: usize| {
        let before = &words[at.saturating_sub(5)..at];
        before.iter().any(|word| WAKES.iter().any(|verb| is_form(word, verb)) || *word == "waking")
            || before.ends_with(&["come", "to"])
            || before.ends_with(&["comes", "to"])
            || before.ends_with(&["flat", "out"])
    };
    if !ground.is_some_and(wakes) || step.start.height.is_some() {
        return;
    }
    if step.start.subjects.is_empty() {
        step.start.subjects.clone_from(&step.end.subjects);
    }
    (step.start.height, step.start.angle) = (Some(FLOOR_EYES), None);
    if step.end.height.is_none() && step.end.angle != Some(ShotAngle::Overhead) {
        (step.end.height, step.end.angle) = (Some(STANDING_EYES), None);
    }
}

/// Whether the words say that the camera is down low, and nothing brings it there.
fn stands_low(words: &[&str]) -> bool {
    let is_low = |at: usize| {
        let before = words[..at].iter().rev().find(|word| !BETWEEN.contains(word));
        words[at..].starts_with(&["down", "low"]) && before.is_some_and(|word| CAMERAS.contains(word))
    };
    (0..words.len()).any(is_low) && !words.iter().any(|word| SINKS.iter().any(|verb| is_form(word, verb)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_camera_that_is_down_low_is_not_brought_there() {
        let low = |text: &str| stands_low(&text.split(' ').collect::<Vec<_>>());
        assert!(low("we want <obj-0> , camera down low looking up at it"));
        assert!(low("on <obj-0> , the lens is way down low"));
        assert!(!low("get the camera down low on <obj-0>"));
        assert!(!low("come down low to <obj-0>"));
        assert!(!low("<obj-0> is down low"));
    }

    #[test]
    fn a_camera_that_hovers_or_is_down_does_not_sink() {
        let moved = |text: &str| {
            let start = Framing { subjects: vec![5], angle: Some(ShotAngle::Overhead), ..Framing::default() };
            let end = Framing { subjects: vec![5], ..Framing::default() };
            let mut steps = [Step { start, end, words: Some([0, text.len()]), ..Step::of(Move::CraneDown) }];
            stay_up_and_down(&super::super::fixture::linked(text), &mut steps);
            steps[0].movement
        };
        assert_eq!(moved("we hover high above <obj-0> , staring down at it ."), Move::Static);
        assert_eq!(moved("hanging over <obj-0> , looking straight down"), Move::Static);
        assert_eq!(moved("hover above <obj-0> , then sink down to it"), Move::CraneDown);
        assert_eq!(moved("camera down at ankle height , now come forwards to <obj-0>"), Move::PushIn);
        assert_eq!(moved("camera down at last , close on <obj-0>"), Move::CraneDown);
        assert_eq!(moved("come down low and forward to <obj-0>"), Move::CraneDown);
    }

    #[test]
    fn who_wakes_on_the_floor_rises_from_it() {
        let heights = |text: &str| {
            let end = Framing { subjects: vec![5], ..Framing::default() };
            let mut steps = [Step { end, words: Some([0, text.len()]), ..Step::of(Move::PedestalUp) }];
            rise_from_floor(&super::super::fixture::linked(text), &mut steps);
            (steps[0].start.height, steps[0].end.height)
        };
        let rises = (Some(FLOOR_EYES), Some(STANDING_EYES));
        assert_eq!(heights("you come to on the floor , you pedestal up , look at <obj-0>"), rises);
        assert_eq!(heights("you 're lying on the floor . you pedestal up"), rises);
        assert_eq!(heights("the lamp on the floor . pedestal up"), (None, None));
    }
}

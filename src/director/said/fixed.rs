//! Cameras that stay where they are: `camera position fixed`, `position locked`, `the camera stays put, it just looks`.

use cinesplat_language::Linked;
use cinesplat_operator::{Framing, Motion, Program, Step};
use cinesplat_trajectory::Move;

use super::directions::is_form;

/// What is fixed, and how.
const PLACES: [&str; 3] = ["position", "location", "viewpoint"];
const FIXED: [&str; 8] = ["fixed", "locked", "constant", "unchanged", "static", "frozen", "unchanging", "stationary"];
/// Words between them.
const BETWEEN: [&str; 6] = ["is", "stays", "remains", "kept", "held", "be"];
/// Phrases of the same meaning.
const PHRASES: [&[&str]; 33] = [
    &["stays", "put"],
    &["stay", "put"],
    &["same", "spot"],
    &["one", "spot"],
    &["only", "the", "head", "moves"],
    &["just", "the", "head", "moves"],
    &["tripod", "head"],
    &["tripod", "'s", "nailed"],
    &["tripod", "is", "nailed"],
    &["on", "sticks"],
    &["off", "sticks"],
    &[",", "sticks"],
    &["on", "a", "tripod"],
    &["from", "a", "tripod"],
    &["tripod", "throughout"],
    &["single", "spot"],
    &["feet", "still"],
    &["feet", "stay"],
    &["feet", "planted"],
    &["feet", "don", "'t", "move"],
    &["feet", "do", "not", "move"],
    &["no", "walking"],
    &["not", "walking"],
    &["without", "walking"],
    &["no", "travel"],
    &["no", "travelling"],
    &["no", "traveling"],
    &["stays", "where", "it", "is"],
    &["without", "moving", "the", "camera"],
    &["tripod", "untouched"],
    &["no", "translation"],
    &["zero", "translation"],
    &["without", "translation"],
];
/// Verbs of a turn, behind which `in place` is on the spot.
const TURNS: [&str; 8] = ["rotate", "turn", "pivot", "spin", "swivel", "pan", "tilt", "revolve"];
/// Words that deny the verb behind them.
const DENIALS: [&str; 8] = ["no", "not", "without", "zero", "never", "'t", "dont", "nor"];
/// Verbs by which a rise or a way is one whatever else is said.
const TRAVELS: [&str; 15] = [
    "push", "pull", "crane", "pedestal", "boom", "jib", "dolly", "truck", "travel", "walk", "fly", "orbit", "slide",
    "rise", "descend",
];
/// Words after which the camera stays for a while only.
const AFTERWARDS: [&str; 6] = ["then", "until", "for", "before", "while", "first"];
/// Whose place it is where it is not the camera's.
const OTHERS: [&str; 8] = ["its", "their", "screen", "same", "'s", "subject", "subjects", "they"];

/// Rules a travel out where the words say so, and turns what would travel only to show another thing: nobody who says
/// that the camera stays put asks for a way by `go down to the vase`.
pub(crate) fn stay_put(linked: &Linked, program: &mut Program) {
    let words: Vec<&str> = linked.tokens_text.split(' ').collect();
    let is_of_thing = |at: usize| at > 0 && linked.slot_at(words[at - 1]).is_some();
    // `No dolly` is none.
    let is_denied = |at: usize| words[at.saturating_sub(2)..at].iter().any(|word| DENIALS.contains(word));
    let is_travel = |at: &usize| TRAVELS.iter().any(|verb| is_form(words[*at], verb)) && !is_denied(*at);
    if !(0..words.len()).any(|at| is_fixed(&words, at) && !is_of_thing(at)) || (0..words.len()).any(|at| is_travel(&at))
    {
        return;
    }
    let zooms = words.iter().any(|word| is_form(word, "zoom") || *word == "lens");
    turn_steps(linked, &mut program.steps, zooms, |_| true);
    if !program.steps.iter().any(travels) {
        program.forbid(Motion::Travel);
    }
}

/// Words that lock the camera off in a sentence of their own.
const LOCKED: [&[&str]; 5] =
    [&["lock", "off"], &["locked", "off"], &["static", "shot"], &["static"], &["no", "movement"]];

/// Rests where a sentence of its own locks the camera off and nothing tells it to move: `Lock-off. The chest in the middle.`
pub(crate) fn lock_off(linked: &Linked, steps: &mut [Step]) {
    let words: Vec<&str> = linked.tokens_text.split(' ').collect();
    let ends = |at: usize| matches!(words.get(at), Some(&("." | ":" | ";" | "!")));
    let begins = |at: usize| at == 0 || ends(at - 1);
    let is_locked = (0..words.len())
        .any(|at| begins(at) && LOCKED.iter().any(|locked| words[at..].starts_with(locked) && ends(at + locked.len())));
    let goes = |at: usize| TRAVELS.iter().any(|verb| is_form(words[at], verb)) || is_form(words[at], "zoom");
    if let [step] = steps
        && is_locked
        && !(0..words.len()).any(goes)
        && matches!(step.movement, Move::PushIn | Move::PullOut | Move::Follow)
    {
        (step.movement, step.amount, step.either_way) = (Move::Static, None, false);
        step.start = Framing::default();
    }
}

/// Turns what would travel in steps that are said to turn on the spot: `rotate in place from the vase to the chair`.
pub(crate) fn turn_in_place(linked: &Linked, steps: &mut [Step]) {
    turn_steps(linked, steps, false, |words| {
        let is_place =
            |at: usize| words[at..].starts_with(&["in", "place"]) || words[at..].starts_with(&["on", "the", "spot"]);
        let turns = |at: usize| {
            let before = words[at.saturating_sub(3)..at].iter();
            is_place(at) && before.into_iter().any(|word| TURNS.iter().any(|verb| is_form(word, verb)))
        };
        (0..words.len()).any(turns)
    });
}

/// Turns what would travel in the steps whose words ask for it; `zooms` says that the words of the film do.
fn turn_steps(linked: &Linked, steps: &mut [Step], zooms: bool, is_asked: impl Fn(&[&str]) -> bool) {
    let mut shown: Vec<u32> = Vec::new();
    for step in steps {
        let words = linked.texts_in(step.words.unwrap_or_default());
        if is_asked(&words) {
            turn_instead(step, &shown, zooms, &words);
        }
        shown.clone_from(if step.end.subjects.is_empty() { &step.start.subjects } else { &step.end.subjects });
    }
}

/// Whether the words from word `at` on say that the camera stays where it is.
fn is_fixed(words: &[&str], at: usize) -> bool {
    let between = words[at + 1..].iter().take(2).take_while(|word| BETWEEN.contains(word)).count();
    if at > 0 && OTHERS.contains(&words[at - 1]) {
        return false;
    }
    let phrase = PHRASES.iter().find(|phrase| words[at..].starts_with(phrase));
    let stated = PLACES.contains(&words[at]) && words.get(at + 1 + between).is_some_and(|word| FIXED.contains(word));
    let end = phrase.map_or(at + 2 + between, |phrase| at + phrase.len());
    let goes_on = words.iter().skip(end).take(2).any(|word| AFTERWARDS.contains(word));
    (stated || phrase.is_some()) && !goes_on
}

/// Turns what would travel to another thing than the one that is `shown`, and zooms where it would go nearer to that one;
/// `words` are the step's.
fn turn_instead(step: &mut Step, shown: &[u32], zooms: bool, words: &[&str]) {
    // `Camera is going right`, where it only turns.
    if step.end == Framing::default() && step.via.is_none() && step.with.is_empty() && step.amount.is_none() {
        step.movement = match step.movement {
            Move::TruckLeft => Move::PanLeft,
            Move::TruckRight => Move::PanRight,
            movement => movement,
        };
    }
    let leads = !step.end.subjects.is_empty() && step.via.is_none() && step.with.is_empty() && !step.returns;
    if !leads || step.end.height.is_some() || step.amount.is_some() && !step.movement.is_circular() {
        return;
    }
    let begins_with = if step.start.subjects.is_empty() { shown } else { &step.start.subjects };
    let is_other = !begins_with.is_empty() && begins_with != step.end.subjects;
    let says = |list: &[&str]| words.iter().any(|word| list.contains(word));
    let (up, down) = (says(&["up", "upward", "upwards"]), says(&["down", "downward", "downwards"]));
    let (left, right) =
        (says(&["left", "anticlockwise", "counterclockwise", "counter-clockwise"]), says(&["right", "clockwise"]));
    // The way to another thing.
    let turn = match (up && !down, down && !up, left && !right, right && !left) {
        (_, _, true, _) => (Move::PanLeft, false),
        (_, _, _, true) => (Move::PanRight, false),
        (true, ..) => (Move::TiltUp, false),
        (_, true, ..) => (Move::TiltDown, false),
        _ => (Move::PanRight, true),
    };
    (step.movement, step.either_way) = match step.movement {
        Move::Follow => turn,
        Move::PanLeft | Move::PanRight if says(&["clockwise", "anticlockwise", "counterclockwise"]) => turn,
        Move::CraneUp | Move::PedestalUp => (Move::TiltUp, false),
        Move::CraneDown | Move::PedestalDown => (Move::TiltDown, false),
        Move::PullOut if zooms && !is_other => (Move::ZoomOut, false),
        Move::PushIn if !is_other => (Move::ZoomIn, false),
        Move::PushIn | Move::PullOut | Move::TruckLeft | Move::TruckRight if is_other => turn,
        // `Camera is going right, stop at the chair`.
        Move::Static if is_other && (!step.start.subjects.is_empty() || left != right) => turn,
        movement if is_other && movement.is_circular() => {
            step.amount = None;
            turn
        }
        movement => (movement, step.either_way),
    };
}

/// Whether a step moves the camera from its place.
fn travels(step: &Step) -> bool {
    let stays = |movement: &Move| {
        movement.looks_elsewhere()
            || matches!(
                movement,
                Move::Static
                    | Move::ZoomIn
                    | Move::ZoomOut
                    | Move::RollCw
                    | Move::RollCcw
                    | Move::WhipPan
                    | Move::RackFocus
            )
    };
    !std::iter::once(&step.movement).chain(&step.with).all(stays) || step.via.is_some()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_camera_that_only_turns_goes_nowhere() {
        let text = "camera is going right , no travel";
        let linked = super::super::fixture::linked(text);
        let step = Step { words: Some([0, text.len()]), ..Step::of(Move::TruckRight) };
        let mut program = Program { steps: vec![step], ..Program::default() };
        stay_put(&linked, &mut program);
        assert_eq!(program.steps[0].movement, Move::PanRight);
        assert_eq!(program.forbidden, [Motion::Travel]);
    }

    #[test]
    fn a_position_that_is_fixed_is_told_from_one_that_is_not() {
        let says = |text: &str| {
            let words: Vec<&str> = text.split(' ').collect();
            (0..words.len()).any(|at| is_fixed(&words, at))
        };
        assert!(says("tripod , position locked"));
        assert!(says("camera position is fixed"));
        assert!(says("the camera stays put , it just looks"));
        assert!(!says("keep its position fixed in the frame"));
        assert!(!says("move to a fixed position"));
        assert!(!says("the camera stays put for two seconds , then rises up to the shelf"));
        assert!(!says("the subject stays put"));
        assert!(says("pan right past <obj-0> , stop on <obj-1> . one take , sticks ."));
        assert!(says("look around from a tripod , ending on <obj-0>"));
        assert!(!says("<obj-0> sticks out behind <obj-1>"));
    }
}

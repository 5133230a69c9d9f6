//! Motions that the network reads as ruled out although the words ask for them: a ban holds where it is said.

use cinesplat_language::Linked;
use cinesplat_operator::{Motion, Program, Step};
use cinesplat_trajectory::Move;

use super::directions::is_form;

/// Words that rule out what follows, and words that rule out what stands before.
const BANS: [&str; 10] = ["no", "not", "without", "never", "zero", "don", "dont", "nor", "'t", "avoid"];
const LOCKS: [&str; 10] =
    ["locked", "fixed", "constant", "unchanged", "off", "frozen", "not", "never", "zero", "disabled"];
/// Words that may stand between `no` and what it rules out.
const LISTED: [&str; 18] = [
    "pan", "panning", "tilt", "tilting", "roll", "rolling", "zoom", "zooming", "dolly", "or", "and", ",", "any", "nor",
    "camera", "pitch", "yaw", "the",
];
/// Words of a motion.
const NAMES: [(Motion, &[&str]); 5] = [
    (Motion::Pan, &["pan", "yaw", "heading"]),
    (Motion::Tilt, &["tilt", "pitch"]),
    (Motion::Roll, &["roll", "horizon"]),
    (Motion::Zoom, &["zoom", "lens", "fov", "focal"]),
    (Motion::Rise, &["rise", "height", "altitude", "climb"]),
];
pub(super) const SENTENCE_ENDS: [&str; 4] = [".", ";", "!", "?"];

/// Takes back bans of what a step asks for: those that no words say, and those that only the words of another step say.
/// A ban in the words of the same step stays: it is a contradiction.
pub(crate) fn drop_misplaced_bans(linked: &Linked, program: &mut Program) {
    let steps = &program.steps;
    let stays = |motion: &Motion| {
        let Some((_, names)) = NAMES.iter().find(|(named, _)| named == motion) else { return true };
        let mut asking = steps.iter().filter(|step| asks_for(step, *motion));
        let places = said_at(linked, names);
        asking.all(|step| places.iter().any(|place| !belongs_to_other(steps, step, *place)))
    };
    program.forbidden.retain(stays);
}

/// Ways of the camera that words ask for by name.
const WAYS: [&str; 12] =
    ["truck", "dolly", "track", "crane", "walk", "crawl", "strafe", "slide", "push", "pull", "orbit", "pedestal"];
/// Words of who stays for a while.
const RESTS: [&str; 4] = ["put", "parked", "still", "place"];

/// Takes back a ban of travel that the words say of a turn or of a rest, where another step travels by name: `pan right with
/// your feet planted. Then truck left a metre`, `0-4 s truck right, 4-6 s stay put`.
pub(crate) fn keep_travel_bans_to_turns(linked: &Linked, program: &mut Program) {
    let turns =
        program.steps.iter().any(|step| [Motion::Pan, Motion::Tilt].iter().any(|motion| asks_for(step, *motion)));
    let travels = |step: &Step| {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let is_denied = |at: usize| words[..at].iter().rev().take(3).any(|word| BANS.contains(word));
        let is_named = (0..words.len()).any(|at| WAYS.iter().any(|verb| is_form(words[at], verb)) && !is_denied(at));
        Motion::of(step.movement).is_none() && step.movement != Move::Static && is_named
    };
    let rests = program.steps.iter().any(|step| {
        let words = linked.texts_in(step.words.unwrap_or_default());
        step.movement == Move::Static && step.duration_secs.is_some() && words.iter().any(|word| RESTS.contains(word))
    });
    if (turns || rests) && program.steps.iter().any(travels) {
        program.forbidden.retain(|motion| *motion != Motion::Travel);
    }
}

/// Whether one of a step's moves is such a motion.
pub(crate) fn asks_for(step: &Step, motion: Motion) -> bool {
    std::iter::once(&step.movement).chain(&step.with).any(|movement| Motion::of(*movement) == Some(motion))
}

/// Whether a sentence is about other steps alone.
fn belongs_to_other(steps: &[Step], asking: &Step, sentence: [usize; 2]) -> bool {
    let is_about = |step: &Step| step.words.is_some_and(|[from, to]| from < sentence[1] && sentence[0] < to);
    !is_about(asking) && steps.iter().any(is_about)
}

/// The sentences that rule out what has one of these names, in bytes.
fn said_at(linked: &Linked, names: &[&str]) -> Vec<[usize; 2]> {
    let words: Vec<(&str, [usize; 2])> = linked.words_in([0, usize::MAX]).collect();
    let is_ban = |at: &usize| {
        let is_named = names.iter().any(|name| is_form(words[*at].0, name));
        let mut before = words[..*at].iter().rev().map(|(word, _)| *word).skip_while(|word| LISTED.contains(word));
        let mut behind = words[*at + 1..].iter().map(|(word, _)| *word).take(3);
        is_named && (before.next().is_some_and(|word| BANS.contains(&word)) || behind.any(|word| LOCKS.contains(&word)))
    };
    let ends = |at: &usize| SENTENCE_ENDS.contains(&words[*at].0);
    let sentence = |at: usize| {
        let from = (0..at).rev().find(ends).map_or(0, |end| words[end].1[1]);
        [from, (at..words.len()).find(ends).map_or(usize::MAX, |end| words[end].1[1])]
    };
    (0..words.len()).filter(is_ban).map(sentence).collect()
}

/// Rules out turns where the words do (`no rotation`), and tilts and rolls where a turn is about the vertical axis and
/// nothing else.
pub(crate) fn rule_out_turns(linked: &Linked, program: &mut Program) {
    let words: Vec<&str> = linked.tokens_text.split(' ').collect();
    let is_turn = |word: &&&str| {
        **word == "rotation" || ["rotate", "turn", "yaw", "pan", "spin"].iter().any(|verb| is_form(word, verb))
    };
    let is_said = words.windows(2).enumerate().any(|(at, pair)| {
        let sentence = |word: &&&str| !SENTENCE_ENDS.contains(*word);
        let near = || words[..at].iter().rev().take_while(sentence).take(6);
        let limits =
            words[at + 2..].iter().take(1).chain(near()).any(|word| matches!(*word, "only" | "purely" | "just"));
        pair == ["vertical", "axis"] && near().any(|word| is_turn(&word)) && limits
    });
    let bans_turns = words.windows(2).any(|pair| matches!(pair, ["no" | "without" | "zero", "rotation" | "rotations"]));
    let turns = |step: &Step| [Motion::Pan, Motion::Tilt, Motion::Roll].iter().any(|motion| asks_for(step, *motion));
    let may_turn = program.steps.iter().all(|step| !turns(step) && !step.movement.is_circular());
    if bans_turns && may_turn {
        program.forbid(Motion::Turn);
    }
    for motion in [Motion::Tilt, Motion::Roll] {
        if is_said && !program.steps.iter().any(|step| asks_for(step, motion)) {
            program.forbid(motion);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::fixture::{about, linked};
    use super::*;

    #[test]
    fn a_ban_of_travel_is_that_of_the_turn_where_another_step_travels_by_name() {
        let is_kept = |text: &str| {
            let steps = vec![about(Move::PanRight, &[5], [0, 20]), about(Move::TruckLeft, &[7], [20, text.len()])];
            let mut program = Program { steps, forbidden: vec![Motion::Travel], ..Program::default() };
            keep_travel_bans_to_turns(&linked(text), &mut program);
            !program.forbidden.is_empty()
        };
        assert!(!is_kept("pan right , planted . then truck left a metre"));
        assert!(is_kept("pan right , planted . then on to <obj-1>"));
        assert!(is_kept("pan right , planted . then do not truck to <obj-1>"));
    }

    #[test]
    fn a_rest_among_ways_bans_no_travel() {
        let text = "truck right along <obj-0> , stay put , push in on <obj-1>";
        let [rest, way] = [text.find("stay").unwrap(), text.find("push").unwrap()];
        let still = Step { duration_secs: Some(2.0), ..about(Move::Static, &[], [rest, way]) };
        let steps = vec![about(Move::TruckRight, &[5], [0, rest]), still, about(Move::PushIn, &[7], [way, text.len()])];
        let mut program = Program { steps, forbidden: vec![Motion::Travel], ..Program::default() };
        keep_travel_bans_to_turns(&linked(text), &mut program);
        assert_eq!(program.forbidden, []);
    }
}

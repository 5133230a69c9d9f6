//! Rests on each of several things: `turn from the wall to the chair and then to the lamp, dwelling on each for a second`.

use cinesplat_language::{Linked, MAX_STEPS, QuantityKind};
use cinesplat_operator::{Framing, Step};
use cinesplat_trajectory::Move;

use super::directions::is_form;
use crate::direction::Direction;

const RESTS: [&str; 10] = ["hold", "pause", "stop", "rest", "dwell", "linger", "wait", "settle", "stay", "halt"];
const EACH: [&str; 3] = ["each", "every", "all"];
/// Words between the two.
const BETWEEN: [&str; 18] = [
    "on", "upon", "at", "for", "with", "a", "of", "in", "front", "there", "briefly", "shortly", "about", "the", "good",
    "full", "facing", "beside",
];
/// How long a rest is that has no length.
const REST_SECS: f64 = 1.0;

/// Rests on what each step arrives at, and on what the first one leaves, where the words ask for a rest on each.
pub(crate) fn rest_on_each(linked: &Linked, direction: &mut Direction) {
    let words: Vec<&str> = linked.tokens_text.split(' ').collect();
    let steps = &direction.program.steps;
    let asks = |at: &usize| is_rest_on_each(linked, &words, *at) || is_time_of_each(linked, &words, *at, steps);
    let Some(at) = (0..words.len()).find(asks) else { return };
    let stated = stated_secs(linked, &words, at);
    let secs = stated.unwrap_or(REST_SECS);
    let byte = linked.spans.get(at).map_or(0, |span| span[0]);
    let steps = &mut direction.program.steps;
    travel_between_rests(steps, stated);
    let arrives = |step: &Step| step.movement != Move::Static && !step.end.subjects.is_empty() && !step.returns;
    let is_place = |step: &Step| {
        let rests = step.movement == Move::Static && !step.end.subjects.is_empty();
        rests || arrives(step) && !step.start.subjects.is_empty()
    };
    let places = steps.iter().filter(|step| arrives(step)).count() + usize::from(steps.first().is_some_and(is_place));
    if places < 2 {
        return;
    }
    for step in steps.iter_mut() {
        let is_secs = step.duration_secs.is_some_and(|own| stated.is_some() && (own - secs).abs() < 1e-9);
        if is_secs && step.movement != Move::Static {
            step.duration_secs = None;
        } else if step.movement == Move::Static && step.duration_secs.is_none() {
            step.duration_secs = stated;
        }
    }
    let rest = |framing: &Framing, words| Step {
        end: framing.clone(),
        duration_secs: Some(secs),
        words,
        ..Step::of(Move::Static)
    };
    let first = steps.first().filter(|step| arrives(step) && !step.start.subjects.is_empty());
    if let Some(opening) = first.map(|step| rest(&step.start, step.words)) {
        direction.insert_rest(0, opening);
    }
    for nth in (0..direction.program.steps.len()).rev() {
        let steps = &direction.program.steps;
        let rests = steps.get(nth + 1).is_some_and(|next| next.movement == Move::Static && !next.cut);
        let is_before = steps[nth].words.is_none_or(|[from, _]| from <= byte);
        if arrives(&steps[nth]) && !rests && is_before && steps.len() < MAX_STEPS {
            let held = rest(&steps[nth].end, steps[nth].words);
            direction.insert_rest(nth + 1, held);
        }
    }
}

/// Travels to what the network holds behind another picture: each of a list of places is one to arrive at and to rest on, as in
/// `waypoint A = guitar, B = palm, C = chest; dwell 2 s facing each`.
fn travel_between_rests(steps: &mut [Step], stated: Option<f64>) {
    for nth in 1..steps.len() {
        let before = steps[nth - 1].end.subjects.clone();
        let step = &mut steps[nth];
        let plain = Framing { subjects: step.end.subjects.clone(), place: step.end.place, ..Framing::default() };
        let is_other = !step.end.subjects.is_empty() && !before.is_empty() && step.end.subjects != before;
        let is_open = step.duration_secs.is_none() || step.duration_secs == stated;
        let rests = step.movement == Move::Static && step.with.is_empty() && !step.cut && step.via.is_none();
        if rests && is_other && is_open && step.end == plain && step.start == Framing::default() {
            (step.movement, step.duration_secs) = (Move::Follow, None);
        }
    }
}

/// Whether the words at word `at` ask for a rest on each thing.
fn is_rest_on_each(linked: &Linked, words: &[&str], at: usize) -> bool {
    if !EACH.contains(&words[at]) {
        return false;
    }
    let before = words[..at].iter().rev().find(|word| !BETWEEN.contains(word) && !linked.is_quantity(word));
    // `All the way`, `every time`.
    let is_else =
        words.get(at + 1).is_some_and(|word| matches!(*word, "the" | "time" | "along" | "over" | "of" | "around"));
    before.is_some_and(|before| RESTS.iter().any(|verb| is_form(before, verb))) && !(is_else && words[at] != "each")
}

/// Whether the words at word `at` give each thing of a list its time: `vanity -> shower -> tub, 4 s each`.
fn is_time_of_each(linked: &Linked, words: &[&str], at: usize, steps: &[Step]) -> bool {
    let is_secs = |word: &str| linked.quantity_at(word).is_some_and(|quantity| quantity.kind == QuantityKind::Seconds);
    let lists = |step: &Step| matches!(step.movement, Move::Follow | Move::Static) && !step.end.subjects.is_empty();
    let before = at.checked_sub(1).map_or("", |before| words[before]);
    matches!(words[at], "each" | "apiece" | "per") && is_secs(before) && steps.len() > 1 && steps.iter().all(lists)
}

/// How long each rest is, where the words around word `at` state that.
fn stated_secs(linked: &Linked, words: &[&str], at: usize) -> Option<f64> {
    let secs = |word: &&str| linked.quantity_at(word).filter(|quantity| quantity.kind == QuantityKind::Seconds);
    let behind = words[at + 1..].iter().take(8).take_while(|word| !matches!(**word, "." | ";"));
    behind.chain(words[..at].iter().rev().take(3)).find_map(secs).map(|quantity| quantity.value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rest_on_each_is_told_from_others() {
        let rests = |text: &str| {
            let words: Vec<&str> = text.split(' ').collect();
            (0..words.len()).any(|at| is_rest_on_each(&Linked::default(), &words, at))
        };
        assert!(rests("turn to <obj-0> then to <obj-1> , dwelling upon each item for no less than a second"));
        assert!(rests("a pause at each stage"));
        assert!(rests("stop briefly at every one"));
        assert!(rests("dwell facing each one"));
        assert!(!rests("hold all the way"));
        assert!(!rests("show each of them"));
    }

    #[test]
    fn each_place_is_one_to_arrive_at() {
        let rest = |id: u32, secs: Option<f64>| Step {
            end: Framing { subjects: vec![id], ..Framing::default() },
            duration_secs: secs,
            ..Step::of(Move::Static)
        };
        let moves = |mut steps: Vec<Step>| {
            travel_between_rests(&mut steps, Some(2.0));
            steps.iter().map(|step| step.movement).collect::<Vec<_>>()
        };
        assert_eq!(moves(vec![rest(1, Some(2.0)), rest(2, Some(2.0))]), [Move::Static, Move::Follow]);
        assert_eq!(moves(vec![rest(1, None), rest(1, None)]), [Move::Static, Move::Static]);
        assert_eq!(moves(vec![rest(1, None), rest(2, Some(5.0))]), [Move::Static, Move::Static]);
    }
}

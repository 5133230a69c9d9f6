//! Lists of things to rest on while the eye wanders: `wander, rest on the glass, the fruit, the candle, and take in the whole at
//! last`.

use cinesplat_language::{Linked, MAX_STEPS};
use cinesplat_operator::{Framing, Speed, Step};
use cinesplat_trajectory::Move;

use super::directions::{is_form, says_any};
use crate::direction::{Direction, StepCertainty};

/// Verbs of a rest, and words between them and what it is on.
const RESTS: [&str; 8] = ["rest", "linger", "pause", "dwell", "stop", "settle", "halt", "land"];
const ON: [&str; 5] = ["on", "upon", "at", "over", "by"];
/// Verbs and words of a way from one thing to the next.
const WANDERS: [&str; 10] =
    ["wander", "roam", "travel", "drift", "journey", "stroll", "ramble", "explore", "meander", "browse"];
/// Words between things of a list.
const LINKS: [&str; 9] = [",", "and", "then", "on", "the", "a", "&", "or", "finally"];
/// Words of all that there is, and verbs before them.
const WHOLES: [&str; 4] = ["whole", "entire", "everything", "all"];
const SEES: [&str; 9] = ["take", "see", "show", "reveal", "embrace", "end", "finish", "widen", "survey"];
/// How long a rest is, and in a slow film.
const REST_SECS: f64 = 1.0;
const SLOW_REST_SECS: f64 = 2.0;

/// Goes from thing to thing of a list to rest on that the network reads as one picture, and out to all of them where the words
/// take in the whole.
pub(crate) fn visit_listed(linked: &Linked, direction: &mut Direction) {
    for nth in (0..direction.program.steps.len()).rev() {
        let step = &direction.program.steps[nth];
        let words = linked.texts_in(step.words.unwrap_or_default());
        let Some((ids, end)) = listed(&words, &|word| linked.slot_at(word)) else { continue };
        let places: Vec<Vec<u32>> = ids.iter().map(|id| linked.expanded(&[*id])).collect();
        let shown = linked.expanded(&step.end.subjects);
        let is_one_picture = shown.len() > 1
            && shown.iter().all(|id| places.iter().any(|place| place.contains(id)))
            && matches!(step.movement, Move::Static | Move::Follow | Move::PushIn | Move::FlyThrough);
        let wholes = takes_in_whole(&words[end..]);
        let num_steps = direction.program.steps.len() + 2 * places.len();
        if !is_one_picture || num_steps > MAX_STEPS {
            continue;
        }
        let visits = visits(step, &places, wholes);
        let certainty = direction.certainty.get(nth).cloned();
        let certainties: Vec<StepCertainty> = visits.iter().filter_map(|_| certainty.clone()).collect();
        direction.program.steps.splice(nth..=nth, visits);
        if nth < direction.certainty.len() {
            direction.certainty.splice(nth..=nth, certainties);
        }
        // The network's cameras are those of one picture.
        direction.step_cameras.clear();
    }
}

/// Words that show several things one after the other.
const IN_TURN: [&[&str]; 8] = [
    &["one", "after", "the", "other"],
    &["one", "after", "another"],
    &["one", "by", "one"],
    &["in", "turn"],
    &["each", "in", "turn"],
    &["in", "sequence"],
    &["in", "succession"],
    &["individually"],
];

/// Shows the things of one picture one after the other where the words say so: `show both chairs one after the other`.
pub(crate) fn visit_in_turn(linked: &Linked, direction: &mut Direction) {
    for nth in (0..direction.program.steps.len()).rev() {
        let step = &direction.program.steps[nth];
        let words = linked.texts_in(step.words.unwrap_or_default());
        let shown = linked.expanded(&step.end.subjects);
        let is_picture = matches!(step.movement, Move::Static | Move::Follow | Move::PushIn) && step.with.is_empty();
        let is_open = step.end.size.is_none() && step.start.subjects.is_empty() && step.via.is_none();
        let num_steps = direction.program.steps.len() + shown.len();
        let is_list = (2..=4).contains(&shown.len()) && num_steps <= MAX_STEPS;
        if !(is_picture && is_open && is_list && says_any(&words, &IN_TURN)) {
            continue;
        }
        let distance = take_echoes(linked, direction, nth, &shown);
        let step = &direction.program.steps[nth];
        let framed = |id: u32| Framing { subjects: vec![id], distance, ..Framing::default() };
        let way = |(nth, id): (usize, &u32)| Step {
            movement: if nth == 0 { Move::Static } else { Move::Follow },
            end: framed(*id),
            start: Framing::default(),
            ..step.clone()
        };
        let steps: Vec<Step> = shown.iter().enumerate().map(way).collect();
        let certainty = direction.certainty.get(nth).cloned();
        let certainties: Vec<StepCertainty> = steps.iter().filter_map(|_| certainty.clone()).collect();
        direction.program.steps.splice(nth..=nth, steps);
        if nth < direction.certainty.len() {
            direction.certainty.splice(nth..=nth, certainties);
        }
        direction.step_cameras.clear();
    }
}

/// Removes what is said of all things of a list behind it as if they were one picture: `visit the four plates in turn, dwell at
/// each, keep half a metre away`. The distance from them is left.
fn take_echoes(linked: &Linked, direction: &mut Direction, nth: usize, shown: &[u32]) -> Option<f64> {
    let is_all = |step: &Step| {
        let rests = matches!(step.movement, Move::Static | Move::Follow | Move::PushIn);
        let is_open = step.start.subjects.is_empty() || linked.expanded(&step.start.subjects) == shown;
        let subjects = linked.expanded(&step.end.subjects);
        rests && is_open && (subjects == shown || subjects.is_empty() && step.movement == Move::Static)
    };
    let mut distance = direction.program.steps[nth].end.distance;
    while direction.program.steps.get(nth + 1).is_some_and(is_all) {
        distance = distance.or(direction.program.steps[nth + 1].end.distance);
        direction.remove_step(nth + 1);
    }
    distance
}

/// A rest on each place in order, with a way between two of them, and a way out to all where the words take in the whole.
fn visits(step: &Step, places: &[Vec<u32>], wholes: bool) -> Vec<Step> {
    let secs = if step.speed == Speed::Slow { SLOW_REST_SECS } else { REST_SECS };
    let framed = |subjects: &[u32]| Framing { subjects: subjects.to_vec(), ..Framing::default() };
    let of = |movement: Move, end: Framing| Step { end, speed: step.speed, words: step.words, ..Step::of(movement) };
    let rest =
        |place: &[u32]| Step { duration_secs: Some(secs), speed: Speed::Normal, ..of(Move::Static, framed(place)) };
    let mut steps = Vec::new();
    for (nth, place) in places.iter().enumerate() {
        if nth > 0 {
            steps.push(of(Move::Follow, framed(place)));
        }
        steps.push(rest(place));
    }
    if wholes {
        steps.push(of(Move::PullOut, Framing { whole: true, ..framed(&places.concat()) }));
    }
    steps
}

/// The things of a list to rest on where the words wander, and the word behind it; two or more.
fn listed(words: &[&str], slot: &dyn Fn(&str) -> Option<u32>) -> Option<(Vec<u32>, usize)> {
    let wanders = words.iter().any(|word| WANDERS.iter().any(|verb| is_form(word, verb)));
    let rests = |at: &usize| {
        RESTS.iter().any(|verb| is_form(words[*at], verb)) && words.get(at + 1).is_some_and(|word| ON.contains(word))
    };
    let from = (0..words.len()).find(rests).filter(|_| wanders)? + 2;
    let (mut ids, mut end): (Vec<u32>, usize) = (Vec::new(), from);
    for at in from..words.len() {
        // `The candle that will burn down`.
        let is_told = ids.is_empty()
            || words[end..at].iter().all(|word| LINKS.contains(word))
            || words[at - 1] == "the"
            || words[at - 1] == ",";
        match slot(words[at]) {
            Some(id) if is_told => {
                ids.extend(Some(id).filter(|id| !ids.contains(id)));
                end = at + 1;
            }
            None if matches!(words[at], "." | ";") => break,
            _ => {}
        }
    }
    (ids.len() > 1).then_some((ids, end))
}

/// Whether words show all of the scene: `and take in the whole at last`.
fn takes_in_whole(words: &[&str]) -> bool {
    let sees = |at: usize| words[..at].iter().rev().take(4).any(|word| SEES.iter().any(|verb| is_form(word, verb)));
    (0..words.len()).any(|at| WHOLES.contains(&words[at]) && sees(at))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn list(text: &str) -> Option<(Vec<u32>, bool)> {
        let words: Vec<&str> = text.split(' ').collect();
        let slot = |word: &str| word.strip_prefix("<obj-")?.strip_suffix('>')?.parse().ok();
        let (ids, end) = listed(&words, &slot)?;
        Some((ids, takes_in_whole(&words[end..])))
    }

    #[test]
    fn a_list_to_rest_on_is_visited_thing_by_thing() {
        let text = "wander , rest on <obj-0> , <obj-1> , <obj-2> that will burn down , and take in the whole at last";
        assert_eq!(list(text), Some((vec![0, 1, 2], true)));
        assert_eq!(list("roaming the table , pausing at <obj-0> and <obj-1>"), Some((vec![0, 1], false)));
        assert_eq!(list("rest on <obj-0> and <obj-1>"), None);
        assert_eq!(list("wander over to <obj-0> and rest on <obj-1>"), None);
        assert_eq!(list("drift past <obj-0> . the rest of <obj-1> and <obj-2>"), None);
    }

    #[test]
    fn a_visit_rests_on_each_and_ends_on_all() {
        let moves: Vec<Move> =
            visits(&Step::of(Move::Follow), &[vec![1], vec![2]], true).iter().map(|step| step.movement).collect();
        assert_eq!(moves, [Move::Static, Move::Follow, Move::Static, Move::PullOut]);
    }

    #[test]
    fn things_are_shown_one_after_the_other() {
        let moves = |text: &str| {
            let end = Framing { subjects: vec![5, 7], ..Framing::default() };
            let step = Step { end, words: Some([0, text.len()]), ..Step::of(Move::Static) };
            let mut direction = super::super::fixture::direction(vec![step]);
            visit_in_turn(&super::super::fixture::linked(text), &mut direction);
            direction.program.steps.iter().map(|step| (step.movement, step.end.subjects.clone())).collect::<Vec<_>>()
        };
        let each = vec![(Move::Static, vec![5]), (Move::Follow, vec![7])];
        assert_eq!(moves("show <obj-0> and <obj-1> one after the other"), each);
        assert_eq!(moves("show <obj-0> and <obj-1>").len(), 1);
    }
}

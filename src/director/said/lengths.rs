//! How long the film is, where its words end with that.

use cinesplat_language::{Linked, QuantityKind, is_listed};
use cinesplat_operator::{Program, Speed};
use cinesplat_trajectory::Move;

use crate::direction::Direction;

/// Marks that end a clause.
const MARKS: [&str; 5] = [",", ".", ";", "!", ":"];
/// Words that may stand beside the length of a film.
const BESIDE: [&str; 11] =
    ["total", "long", "all", "about", "roughly", "around", "approx", "or", "so", "overall", "altogether"];

/// Least time of a step of a film whose whole length is stated.
const LEAST_STEP_SECS: f64 = 1.5;

/// Whether a word is this time.
fn is_length_word(linked: &Linked, word: &str, secs: f64) -> bool {
    linked
        .quantity_at(word)
        .is_some_and(|quantity| quantity.kind == QuantityKind::Seconds && (quantity.value - secs).abs() < 1e-9)
}

/// Gives the film the length of which the words say that it is all of it: `12 seconds altogether`, `in total 20 seconds`.
pub(crate) fn take_total(linked: &Linked, direction: &mut Direction) {
    let words: Vec<&str> = linked.tokens_text.split(' ').collect();
    let text = |at: usize| words.get(at).copied().unwrap_or_default();
    let says_all = |at: usize| {
        let behind = matches!(text(at), "altogether" | "overall" | "total")
            || matches!((text(at), text(at + 1)), ("in", "total" | "all") | ("all", "in" | "together" | "told"));
        behind && !text(at + 2).starts_with("<qty")
    };
    let mut totals = (0..words.len()).filter_map(|at| Some((at, linked.secs_at(words[at])?)));
    let total = totals.find(|(at, _)| says_all(at + 1)).map(|(_, secs)| secs);
    let alone = (direction.program.steps.len() > 1)
        .then(|| last_sentence_secs(linked, &words).or_else(|| clause_secs(linked, &words)))
        .flatten();
    let Some(secs) = total.or(alone) else { return };
    let is_total = |own: f64| (own - secs).abs() < 1e-9;
    let once = linked.quantities.iter().filter(|other| is_total(other.value)).count() == 1;
    let program = &mut direction.program;
    if program.duration_secs.is_none_or(is_total) && once {
        program.duration_secs = Some(secs);
        for step in &mut program.steps {
            step.duration_secs = step.duration_secs.filter(|own| !is_total(*own));
        }
    }
}

/// Words of a last sentence that only says how long the film is: `take about 20 seconds`.
const TAKES: [&str; 24] = [
    "take", "takes", "make", "it", "should", "this", "that", "the", "last", "lasting", "run", "runs", "time", "in",
    "whole", "thing", "film", "clip", "shot", "video", "please", "be", "i", "need",
];

/// The time of a last sentence that says nothing else.
fn last_sentence_secs(linked: &Linked, words: &[&str]) -> Option<f64> {
    let is_end = |word: &&str| matches!(*word, "." | "!" | ";");
    let mut sentences = words.split(is_end).filter(|sentence| !sentence.is_empty()).rev();
    let sentence = sentences.next()?;
    sentences.next()?;
    let is_length = |word: &&&str| linked.secs_at(word).is_some();
    let [secs] = sentence.iter().filter(is_length).collect::<Vec<_>>()[..] else { return None };
    let is_plain =
        |word: &&str| linked.is_quantity(word) || BESIDE.contains(word) || TAKES.contains(word) || *word == ",";
    let takes = sentence.iter().any(|word| TAKES.contains(word) || BESIDE.contains(word));
    (takes && sentence.iter().all(is_plain)).then(|| linked.secs_at(secs)).flatten()
}

/// Least time of a clause of its own that is no hold's.
const LEAST_CLAUSE_SECS: f64 = 8.0;
/// Words of a hold, whose time may stand in a clause of its own.
const HOLDS: &str = "hold holding stay staying rest static still linger pause keep dwell wait freeze";

/// The time that stands alone in a clause, and is too long for that of one step: `Certainly not like a drone. 20 seconds.`
fn clause_secs(linked: &Linked, words: &[&str]) -> Option<f64> {
    let clauses: Vec<&[&str]> = words.split(|word| MARKS.contains(word)).filter(|clause| !clause.is_empty()).collect();
    let alone = |nth: usize| {
        let [word, beside @ ..] = clauses[nth] else { return None };
        let secs = linked.secs_at(word).filter(|secs| *secs >= LEAST_CLAUSE_SECS)?;
        let holds = nth > 0 && clauses[nth - 1].iter().any(|word| is_listed(HOLDS, word));
        (!holds && beside.iter().all(|word| BESIDE.contains(word))).then_some(secs)
    };
    (0..clauses.len()).rev().find_map(alone)
}

/// Takes the length of the film from a step of several, which would leave the others none of it.
pub(crate) fn share_film_length(program: &mut Program) {
    let Some(secs) = program.duration_secs.filter(|_| program.steps.len() > 1) else { return };
    for step in &mut program.steps {
        step.duration_secs = step.duration_secs.filter(|own| *own < secs);
    }
}

/// Gives the film a length that stands alone in a clause behind all moves: `.., then a slow zoom in on the vase, airy
/// loft, 12 seconds`. Where a step has a length of its own, or the last one holds, it is the last step's.
pub(crate) fn take_film_length(linked: &Linked, program: &mut Program) {
    let Some((last, others)) = program.steps.split_last_mut() else { return };
    let is_open = program.duration_secs.is_none() && others.iter().all(|step| step.duration_secs.is_none());
    let is_own = matches!(last.movement, Move::Static | Move::WhipPan) || last.speed == Speed::Fast;
    let fits = |secs: &f64| *secs >= LEAST_STEP_SECS * (others.len() + 1) as f64;
    let Some(secs) = last.duration_secs.filter(|_| is_open && !others.is_empty() && !is_own).filter(fits) else {
        return;
    };
    let words = linked.texts_in([0, usize::MAX]);
    let mut clauses = words.split(|word| MARKS.contains(word)).filter(|clause| !clause.is_empty()).rev();
    // What is behind it says nothing of a move: `12 seconds, seamless`.
    let is_length = |clause: &[&str]| {
        clause.iter().filter(|word| is_length_word(linked, word, secs)).count() == 1
            && clause.iter().all(|word| linked.is_quantity(word) || BESIDE.contains(word))
    };
    if clauses.next().is_some_and(is_length) {
        last.duration_secs = None;
        program.duration_secs = Some(secs);
    }
}

#[cfg(test)]
mod tests {
    use cinesplat_operator::Step;

    use super::*;

    #[test]
    fn a_step_of_several_does_not_last_as_long_as_the_film() {
        let step = |secs: f64| Step { duration_secs: Some(secs), ..Step::of(Move::Static) };
        let shared = |steps: Vec<Step>| {
            let mut program = Program { steps, duration_secs: Some(15.0), ..Program::default() };
            share_film_length(&mut program);
            program.steps.iter().map(|step| step.duration_secs).collect::<Vec<_>>()
        };
        assert_eq!(shared(vec![Step::of(Move::FlyThrough), step(15.0)]), [None, None]);
        assert_eq!(shared(vec![Step::of(Move::FlyThrough), step(4.0)]), [None, Some(4.0)]);
        assert_eq!(shared(vec![step(15.0)]), [Some(15.0)]);
    }
}

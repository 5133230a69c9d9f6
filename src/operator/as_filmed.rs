//! A program as a camera operator takes it: the same steps, put so that each is filmed as its words mean it.

use cinesplat_trajectory::Move;

use crate::program::{Framing, Look, Pass, Program, Step, Via};

/// The program with the move first where a step says `handheld` before it, with flights that set out from a thing at
/// that thing, and with slides from thing to thing that look where they go.
pub(super) fn as_filmed(program: &Program) -> Program {
    let mut filmed = program.clone();
    for (nth, step) in filmed.steps.iter_mut().enumerate() {
        if sways_first(step) {
            // The sway takes its time from the move.
            step.movement = step.with.remove(0);
            step.with.push(Move::Handheld);
        }
        if slides_between(step) {
            step.via = step.via.take().filter(|via| via.how != Pass::Along);
            let looks_back = matches!(&step.look, Some(Look::At(ids)) if *ids == step.start.subjects);
            step.look = step.look.take().filter(|_| !looks_back);
        }
        if (nth == 0 || step.cut) && departs(step) {
            let objects = std::mem::take(&mut step.start.subjects);
            step.via = Some(Via { how: Pass::From, objects });
        }
    }
    filmed
}

/// Whether a step says `handheld` before its move. A whip pan and a reveal, whose first further move is their
/// direction, and a view over a shoulder stay.
fn sways_first(step: &Step) -> bool {
    let leads = |movement: &Move| !matches!(movement, Move::WhipPan | Move::Reveal | Move::Static | Move::Handheld);
    let passes = step.via.as_ref().is_some_and(|via| via.how == Pass::Past);
    step.movement == Move::Handheld && step.with.first().is_some_and(leads) && !passes
}

/// Whether a step slides from one thing to another: what it goes along on the way (`along the shelves from the mug to
/// the plates`) is told by both, and a look at the first one would keep it from the second.
fn slides_between(step: &Step) -> bool {
    let [start, end] = [&step.start.subjects, &step.end.subjects];
    matches!(step.movement, Move::TruckLeft | Move::TruckRight) && !start.is_empty() && !end.is_empty() && start != end
}

/// Whether a step flies or walks from one thing to another: `walk from the door to the windows` begins at the door and
/// looks ahead. A stated picture of the first thing is a picture to open on.
fn departs(step: &Step) -> bool {
    let [start, end] = [&step.start, &step.end];
    let is_place = *start == Framing { subjects: start.subjects.clone(), ..Framing::default() };
    let goes = start.subjects.len() == 1 && !end.subjects.is_empty() && start.subjects != end.subjects;
    step.movement == Move::FlyThrough && step.via.is_none() && is_place && goes
}

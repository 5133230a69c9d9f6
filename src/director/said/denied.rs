//! What a clause only denies: `don't go up to the pictures`, `ignore the note about ending on the mirror`, `do not tilt down`.

use cinesplat_language::{Linked, add_ids, is_listed};
use cinesplat_operator::{Framing, Limit, Program, Step};

use super::briefs::is_camera_verb;
use crate::direction::Direction;

/// Words that deny what follows, and verbs of what does not count any more.
const DENIES: &str = "not 't dont don't never cannot can't nor";
const IGNORES: &str = "ignore ignoring disregard disregarding";
/// Verbs by which something is seen, and those by which the camera is near it.
const SHOWS: &str =
    "show showing see seeing film filming look looking shoot shooting include including feature featuring";
const NEARS: &str = "go going get getting come coming near close closer up walk wander fly push creep head dolly";
/// Words that may stand between a denial and a thing.
const BETWEEN: &str = "to over towards toward at on in into onto end ending finish finishing stop stopping land landing pan panning \
    tilt zoom drift swing cut cutting the a an any about earlier previous last old first note notes instruction point bit by \
    through around round ever you we me let want need back all that my your his her their of from be any one";
/// Words before a denial by which it is no ban: `until you can't see the lamp`.
const CONDITIONS: &str = "until till if unless when where so once before after";
/// Marks and words that end a clause.
const ENDS: &str = ". , ; : ! ? ) but then";
/// How near the camera comes to what it is not to go to, scene units.
const BERTH: f64 = 0.5;

/// How a thing is denied.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Denial {
    /// It is not to be seen.
    Shown,
    /// The camera does not go there.
    Neared,
    /// What was said of it does not count.
    Ignored,
}

/// Removes the steps that lead to what the words only deny, and the moves that they only rule out, where others remain.
pub(crate) fn drop_denied(linked: &Linked, direction: &mut Direction) {
    let words = linked.texts_in([0, usize::MAX]);
    for (id, denial) in denied(linked, &words) {
        let ids = linked.expanded(&[id]);
        let is_of_it = |framing: &Framing| {
            !framing.hidden && !framing.subjects.is_empty() && framing.subjects.iter().all(|id| ids.contains(id))
        };
        let mut is_dropped = false;
        for nth in (0..direction.program.steps.len()).rev() {
            if direction.program.steps.len() > 1 && is_of_it(&direction.program.steps[nth].end) {
                direction.remove_step(nth);
                is_dropped = true;
            }
        }
        let program = &mut direction.program;
        for step in &mut program.steps {
            // A way to one thing that reads as one along another: `truck along the sofa, and don't go up to the pictures`.
            let leads_on = step.via.is_some() || !step.start.subjects.is_empty();
            if is_of_it(&step.end) && leads_on {
                step.end = Framing::default();
                is_dropped = true;
            }
            if is_of_it(&step.start) && denial != Denial::Neared {
                step.start = Framing::default();
            }
        }
        let is_shown = program.steps.iter().any(|step| is_of_it(&step.end) || is_of_it(&step.start));
        match denial {
            Denial::Shown if is_dropped && !is_shown => {
                program.steps.iter_mut().for_each(|step| add_ids(&mut step.avoid, &ids));
            }
            Denial::Neared if is_dropped => stay_clear(linked, program, &ids),
            _ => {}
        }
    }
    for nth in (0..direction.program.steps.len()).rev() {
        if direction.program.steps.len() > 1 && is_ruled_out(linked, &direction.program.steps[nth]) {
            direction.remove_step(nth);
        }
    }
}

/// Keeps the camera away from some things, among the limits that the words state.
fn stay_clear(linked: &Linked, program: &mut Program, ids: &[u32]) {
    if program.limits.is_empty() {
        program.limits.clone_from(&linked.limits);
    }
    program.limits.extend(ids.iter().map(|id| Limit::Clear(Some(*id), BERTH)));
    program.limits.sort_by_key(Limit::rank);
}

/// The things that no words name but to deny them.
fn denied(linked: &Linked, words: &[&str]) -> Vec<(u32, Denial)> {
    let mentions: Vec<(usize, u32)> =
        words.iter().enumerate().filter_map(|(at, word)| Some((at, linked.slot_at(word)?))).collect();
    let mut out: Vec<(u32, Denial)> = Vec::new();
    for (at, id) in &mentions {
        let Some(denial) = denial_at(words, *at) else { continue };
        let others = mentions.iter().filter(|(other, other_id)| other != at && other_id == id);
        let is_only = others.clone().all(|(other, _)| denial_at(words, *other).is_some());
        if is_only && !out.iter().any(|(known, _)| known == id) {
            out.push((*id, denial));
        }
    }
    out
}

/// How the clause of a thing at a word denies it.
fn denial_at(words: &[&str], at: usize) -> Option<Denial> {
    let before = |from: usize| words[..from].iter().rev();
    let is_between = |word: &&&str| [BETWEEN, SHOWS, NEARS].iter().any(|list| is_listed(list, word));
    let num = before(at).take(9).take_while(is_between).count();
    let denier = at.checked_sub(num + 1)?;
    let said = &words[denier + 1..at];
    if is_listed(IGNORES, words[denier]) {
        return Some(Denial::Ignored);
    }
    let has = |list: &str| said.iter().any(|word| is_listed(list, word));
    let is_condition =
        before(denier).take(6).take_while(|word| !is_listed(ENDS, word)).any(|word| is_listed(CONDITIONS, word));
    // `You can't miss the lamp`, `not the lamp`: other rules.
    if !is_listed(DENIES, words[denier]) || is_condition {
        return None;
    }
    match (has(SHOWS), has(NEARS)) {
        (true, _) => Some(Denial::Shown),
        (false, true) => Some(Denial::Neared),
        (false, false) => has("end ending pan panning through").then_some(Denial::Ignored),
    }
}

/// Whether all moves that the words of a step name are ruled out there.
fn is_ruled_out(linked: &Linked, step: &Step) -> bool {
    let is_open = step.end.subjects.is_empty() && step.start.subjects.is_empty() && step.via.is_none();
    let words = linked.texts_in(step.words.unwrap_or_default());
    let verbs: Vec<usize> = (0..words.len()).filter(|at| is_camera_verb(&words, *at)).collect();
    let is_denied = |at: &usize| {
        let mut before = words[..*at].iter().rev().skip_while(|word| is_listed("ever to even at all", word));
        before.next().is_some_and(|word| is_listed(DENIES, word))
    };
    is_open && step.amount.is_none() && !verbs.is_empty() && verbs.iter().all(is_denied)
}

#[cfg(test)]
mod tests {
    use super::super::fixture::{about, direction, linked};
    use super::*;
    use cinesplat_operator::Level;
    use cinesplat_trajectory::Move;

    fn left(text: &str, steps: Vec<Step>) -> Direction {
        let mut read = direction(steps);
        drop_denied(&linked(text), &mut read);
        read
    }

    #[test]
    fn what_is_only_denied_is_no_goal() {
        let two = |second: u32| vec![about(Move::TruckRight, &[5], [0, 20]), about(Move::PushIn, &[second], [20, 90])];
        let read = left("slide along <obj-0> and don 't go up to <obj-1>", two(7));
        assert_eq!((read.program.steps.len(), &read.program.limits[..]), (1, &[Limit::Clear(Some(7), BERTH)][..]));
        let read = left("slide along <obj-0> , and not to show <obj-1>", two(7));
        assert_eq!((read.program.steps.len(), &read.program.steps[0].avoid[..]), (1, &[7][..]));
        let read = left("slide along <obj-0> . ignore the earlier note about ending on <obj-1>", two(7));
        assert_eq!((read.program.steps.len(), read.program.limits.len()), (1, 0));
    }

    #[test]
    fn a_denied_way_leaves_the_limits_that_the_words_state() {
        let said = "slide along <obj-0> and don 't go up to <obj-1>";
        let limits = vec![Limit::Below(Level::Units(1.4)), Limit::Speed(0.3)];
        let mut read = direction(vec![about(Move::TruckRight, &[5], [0, 20]), about(Move::PushIn, &[7], [20, 90])]);
        drop_denied(&Linked { limits: limits.clone(), ..linked(said) }, &mut read);
        assert_eq!(read.program.limits, [limits[0], Limit::Clear(Some(7), BERTH), limits[1]]);
    }

    #[test]
    fn what_is_named_elsewhere_or_left_out_of_sight_at_the_end_stays() {
        let two = || vec![about(Move::TruckRight, &[5], [0, 20]), about(Move::PushIn, &[7], [20, 90])];
        let num = |text: &str| left(text, two()).program.steps.len();
        assert_eq!(num("slide along <obj-0> , don 't go to <obj-1> yet , then go to <obj-1>"), 2);
        assert_eq!(num("slide along <obj-0> until you can 't see <obj-1>"), 2);
        assert_eq!(num("slide along <obj-0> , don 't stop until <obj-1>"), 2);
    }

    #[test]
    fn a_move_that_is_only_ruled_out_is_none() {
        let rise = Step { words: Some([18, 90]), ..Step::of(Move::PedestalDown) };
        let read =
            left("push in on <obj-0> do not tilt down at any point", vec![about(Move::PushIn, &[5], [0, 18]), rise]);
        assert_eq!(read.program.steps.len(), 1);
    }
}

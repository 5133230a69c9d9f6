//! Clauses that the network leaves out: `.. for two seconds; draw back until the armchair and the sideboard are in it too`.
//!
//! Enters: a linked prompt and what was read of it. Leaves: the same with the steps of such clauses, each read by itself.

use cinesplat_language::{Linked, is_listed};
use cinesplat_trajectory::Move;

use crate::direction::Direction;
use crate::error::DirectorError;
use crate::keys::MAX_KEYS;
use crate::said::directs;

/// Marks and words between which a clause stands.
const JOINTS: &str = ". ! ? ; : , then and before";
/// Words of a clause that asks for nothing of its own: it rules something out, or tells where a thing is.
const SETS_ASIDE: &str = "no not never without avoid except ignore ignoring don't doesn't isn't instead skip skipping forget leave leaving \
    if unless which who whose where";
/// Least certainty of what such a clause is read as.
const LEAST: f64 = 0.2;
/// The same where no word says what the camera does.
const LEAST_UNSAID: f64 = 0.4;

/// Adds the steps of the clauses that no step comes from and that name things which the film does not show; each is read with
/// `read`.
///
/// # Errors
/// Those of `read`.
pub(crate) fn add_lost_clauses(
    linked: &Linked,
    direction: &mut Direction,
    read: &dyn Fn(&Linked) -> Result<Direction, DirectorError>,
) -> Result<(), DirectorError> {
    if direction.program.steps.is_empty() || direction.program.steps.iter().any(|step| step.words.is_none()) {
        return Ok(());
    }
    for bytes in lost(linked, direction) {
        let nth =
            direction.program.steps.iter().take_while(|step| step.words.is_some_and(|at| at[0] < bytes[0])).count();
        let before = nth.checked_sub(1).and_then(|nth| direction.program.steps.get(nth));
        let subject = before.and_then(|step| linked.id_of(&step.end.subjects));
        let found = read(&linked.part(bytes, subject))?;
        let says = directs(&linked.texts_in(bytes));
        if is_sound(&found, says) && direction.program.steps.len() + found.program.steps.len() < MAX_KEYS {
            direction.insert_all(nth, found);
        }
    }
    Ok(())
}

/// Bytes of the clauses that are left out, the last one first.
fn lost(linked: &Linked, direction: &Direction) -> Vec<[usize; 2]> {
    let spans = || direction.program.steps.iter().filter_map(|step| step.words).chain(direction.unmet.iter().copied());
    let is_covered = |span: &[usize; 2]| spans().any(|own| own[0] <= span[0] && span[0] < own[1]);
    let shown = direction.program.object_ids();
    let words: Vec<(&str, [usize; 2])> = linked.words_in([0, usize::MAX]).collect();
    let mut found = Vec::new();
    let mut from = 0;
    while from < words.len() {
        let len = words[from..].iter().take_while(|(_, span)| !is_covered(span)).count();
        let (gap, end) = (&words[from..from + len], from + len);
        let begins = from == 0
            || is_listed(JOINTS, words[from - 1].0)
            || gap.first().is_some_and(|(word, _)| is_listed(JOINTS, word));
        let ends = end == words.len()
            || is_listed(JOINTS, words[end].0)
            || gap.last().is_some_and(|(word, _)| is_listed(JOINTS, word));
        let texts: Vec<&str> = gap.iter().map(|(word, _)| *word).collect();
        let is_new = linked.named_by(&texts).iter().any(|id| !shown.contains(id) && linked.missing(*id).is_none());
        let asks = !texts.iter().any(|word| is_listed(SETS_ASIDE, word));
        if let ([(_, first), .., (_, last)], true) = (gap, begins && ends && is_new && asks) {
            found.push([first[0], last[1]]);
        }
        from = end + 1;
    }
    found.reverse();
    found
}

/// Whether what a clause is read as is a film of something: any, where the words say what the camera does, else one that moves.
fn is_sound(found: &Direction, says: bool) -> bool {
    let moves = found.program.steps.iter().any(|step| step.movement != Move::Static);
    (says || moves)
        && !found.program.object_ids().is_empty()
        && found.program.steps.iter().all(|step| step.words.is_some())
        && found.certainty.iter().all(|step| step.probability >= if says { LEAST } else { LEAST_UNSAID })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::direction::StepCertainty;
    use crate::said::fixture::{about, direction, linked};

    /// A step that shows one thing, of some words, and is quite sure.
    fn shown(movement: Move, id: u32, words: [usize; 2]) -> Direction {
        let certainty = vec![StepCertainty::of(0.9, Some(words))];
        Direction { certainty, ..direction(vec![about(movement, &[id], words)]) }
    }

    #[test]
    fn a_clause_that_no_step_comes_from_is_read_by_itself() {
        let moves = |text: &str| {
            let linked = linked(text);
            let mut direction = shown(Move::Static, 5, [0, 10]);
            let read = |part: &Linked| Ok(shown(Move::PullOut, 7, [part.spans[0][0], usize::MAX]));
            add_lost_clauses(&linked, &mut direction, &read).unwrap();
            direction.program.steps.iter().map(|step| step.movement).collect::<Vec<Move>>()
        };
        assert_eq!(moves("the <obj-0> ; pull back to <obj-1>"), [Move::Static, Move::PullOut]);
        assert_eq!(moves("the <obj-0> ; pull back to <obj-0>"), [Move::Static]);
        assert_eq!(moves("the <obj-0> ; never pull back to <obj-1>"), [Move::Static]);
        assert_eq!(moves("the <obj-0> which stands on <obj-1>"), [Move::Static]);
    }
}

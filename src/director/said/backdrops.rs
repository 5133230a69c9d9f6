//! What is seen behind the subjects: `with the window behind it`.

use cinesplat_language::{Backdrop, Linked, add_ids};
use cinesplat_operator::{Framing, Step};
use cinesplat_trajectory::Move;

/// Puts the backgrounds that the words name behind their subjects: at the end of the step that they are said of, or where it
/// begins with that subject.
pub(crate) fn set_backdrops(linked: &Linked, steps: &mut [Step]) {
    for backdrop in &linked.backdrops {
        let said_of =
            steps.iter().rposition(|step| step.words.is_none_or(|[from, _]| from <= backdrop.at)).unwrap_or(0);
        let mut order = (0..=said_of).rev().chain(said_of + 1..steps.len());
        let shows = |step: &Step| shows(&step.end, backdrop) || shows(&step.start, backdrop);
        let nth = order.find(|nth| steps.get(*nth).is_some_and(shows)).unwrap_or(said_of);
        let Some(step) = steps.get_mut(nth) else { continue };
        let begins = shows_only_at_start(step, backdrop) && step.movement != Move::Static;
        let framing = if begins { &mut step.start } else { &mut step.end };
        framing.subjects.retain(|id| !backdrop.ids.contains(id));
        add_ids(&mut framing.backdrop, &backdrop.ids);
        step.keep.retain(|id| !backdrop.ids.contains(id));
    }
}

/// Whether a framing is about what something is seen behind.
fn shows(framing: &Framing, backdrop: &Backdrop) -> bool {
    framing.subjects.iter().any(|id| backdrop.of.contains(id))
}

fn shows_only_at_start(step: &Step, backdrop: &Backdrop) -> bool {
    let stays = step.end.subjects.is_empty() && keeps_subject(step);
    shows(&step.start, backdrop) && !shows(&step.end, backdrop) && !stays
}

/// Whether the move keeps its subject until the end.
fn keeps_subject(step: &Step) -> bool {
    matches!(step.movement, Move::PushIn | Move::ZoomIn | Move::ArcLeft | Move::ArcRight)
}

#[cfg(test)]
mod tests {
    use super::super::fixture::{about, linked};
    use super::*;

    fn with_backdrop(steps: &mut [Step], at: usize) {
        let backdrops = vec![Backdrop { ids: vec![7], of: vec![5], at }];
        set_backdrops(&Linked { backdrops, ..linked("push in on <obj-0>") }, steps);
    }

    #[test]
    fn a_background_is_that_of_the_picture_it_is_said_of() {
        let mut steps = [about(Move::PushIn, &[5], [0, 10]), about(Move::PanLeft, &[9], [12, 30])];
        with_backdrop(&mut steps, 10);
        assert_eq!((&steps[0].end.backdrop[..], &steps[1].end.backdrop[..]), (&[7][..], &[][..]));
        let mut steps = [about(Move::Static, &[9], [0, 10]), about(Move::PushIn, &[5], [12, 30])];
        with_backdrop(&mut steps, 31);
        assert_eq!((&steps[0].end.backdrop[..], &steps[1].end.backdrop[..]), (&[][..], &[7][..]));
    }

    #[test]
    fn a_picture_that_is_left_has_its_background_at_first() {
        let start = Framing { subjects: vec![5], ..Framing::default() };
        let mut steps = [Step { start, ..about(Move::PanLeft, &[9], [0, 30]) }];
        with_backdrop(&mut steps, 10);
        assert_eq!((&steps[0].start.backdrop[..], &steps[0].end.backdrop[..]), (&[7][..], &[][..]));
    }

    #[test]
    fn a_background_is_no_second_subject() {
        let mut steps = [about(Move::PushIn, &[5, 7], [0, 30])];
        steps[0].keep = vec![7];
        with_backdrop(&mut steps, 10);
        assert_eq!((&steps[0].end.subjects[..], steps[0].keep.len()), (&[5][..], 0));
    }
}

//! What a film keeps for its end: `let us find the guitar last`, `close along the top, never the whole thing until the last moments`.

use cinesplat_language::{Linked, is_listed};
use cinesplat_operator::{Framing, Step};
use cinesplat_trajectory::{Move, ShotSize};

use super::directions::is_form;
use crate::direction::Direction;

/// Verbs of what is seen only then, and words of the end of a film.
const FINDS: [&str; 4] = ["find", "discover", "notice", "spot"];
const LAST: &str = "last lastly finally late";
/// Words of a near picture.
const CLOSE: &str = "close closeup close-up tight near details detail macro";
/// Most words between a verb and the end.
const NEAR: usize = 5;
/// Most words between `the whole` and those that keep it for the end.
const AROUND: usize = 8;

/// Shows at its end what a film keeps for it.
pub(crate) fn keep_for_end(linked: &Linked, direction: &mut Direction) {
    find_last(linked, direction);
    show_whole_last(linked, direction);
}

/// Begins where the one thing that is found last is not seen.
fn find_last(linked: &Linked, direction: &mut Direction) {
    let words = linked.texts_in([0, usize::MAX]);
    let mut moving = direction.program.steps.iter_mut().filter(|step| step.movement != Move::Static);
    let (Some(step), None) = (moving.next(), moving.next()) else { return };
    let is_way = matches!(step.movement, Move::Follow | Move::PushIn | Move::FlyThrough);
    let is_open = step.start == Framing::default() && step.via.is_none() && step.with.is_empty() && step.look.is_none();
    if is_way && is_open && step.end.subjects.len() == 1 && finds_last(&words) {
        step.movement = Move::Reveal;
    }
}

fn finds_last(words: &[&str]) -> bool {
    let is_find = |at: usize| FINDS.iter().any(|verb| is_form(words[at], verb));
    let behind = |at: usize| words[at + 1..].iter().take(NEAR).take_while(|word| **word != ".");
    (0..words.len()).any(|at| is_find(at) && behind(at).any(|word| is_listed(LAST, word)))
}

/// Goes close along a thing first and shows all of it then.
fn show_whole_last(linked: &Linked, direction: &mut Direction) {
    let [step] = &direction.program.steps[..] else { return };
    let words = linked.texts_in([0, usize::MAX]);
    let slides = matches!(
        step.movement,
        Move::TruckLeft | Move::TruckRight | Move::PedestalUp | Move::PedestalDown | Move::ArcLeft | Move::ArcRight
    );
    let is_of_one = step.end.subjects.len() == 1
        && (step.start.subjects.is_empty() || step.start.subjects == step.end.subjects)
        && step.via.as_ref().is_none_or(|via| via.objects == step.end.subjects);
    let is_plain = step.duration_secs.is_none() && !step.returns && step.end.size.is_none();
    if !(slides && is_of_one && is_plain && keeps_whole_back(&words)) {
        return;
    }
    let subjects = step.end.subjects.clone();
    let whole = Framing { subjects: subjects.clone(), whole: true, ..Framing::default() };
    let close = Framing { subjects, size: Some(ShotSize::CloseUp), ..Framing::default() };
    let first = Step { start: close, end: Framing::default(), via: None, ..step.clone() };
    let last = Step { end: whole, speed: step.speed, words: step.words, ..Step::of(Move::PullOut) };
    direction.replace_steps(vec![first, last]);
}

/// Whether words show details, and all of the thing only at last.
fn keeps_whole_back(words: &[&str]) -> bool {
    let is_close = words.iter().any(|word| is_listed(CLOSE, word));
    let is_whole = |at: usize| is_listed("whole entire complete full all", words[at]);
    let waits = |at: usize| {
        let to = words.len().min(at + 1 + AROUND);
        words[at + 1..to].iter().any(|word| is_listed("until till only", word))
            && words[at.saturating_sub(AROUND)..to].iter().any(|word| is_listed("last end finally very", word))
    };
    is_close && (0..words.len()).any(|at| is_whole(at) && waits(at))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::said::fixture::{about, direction, linked};

    fn moves(text: &str, movement: Move) -> Vec<Move> {
        let mut direction = direction(vec![about(movement, &[5], [0, text.len()])]);
        keep_for_end(&linked(text), &mut direction);
        direction.program.steps.iter().map(|step| step.movement).collect()
    }

    #[test]
    fn what_is_found_last_is_not_seen_first() {
        assert_eq!(moves("drift , let us find <obj-0> last", Move::Follow), [Move::Reveal]);
        assert_eq!(moves("drift and discover <obj-0> only at last", Move::PushIn), [Move::Reveal]);
        assert_eq!(moves("drift over to <obj-0> at last", Move::Follow), [Move::Follow]);
        assert_eq!(moves("find <obj-0> . the last one on the left", Move::Follow), [Move::Follow]);
    }

    #[test]
    fn details_come_before_the_whole_thing() {
        let said = "close along the top of <obj-0> , never the whole thing until the last moments";
        assert_eq!(moves(said, Move::TruckRight), [Move::TruckRight, Move::PullOut]);
        assert_eq!(moves("slide along the whole of <obj-0>", Move::TruckRight), [Move::TruckRight]);
    }
}

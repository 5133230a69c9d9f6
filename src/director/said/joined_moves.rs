//! Steps that are one: a move and what is said behind it of where it goes, a slide and the things that it passes, a picture and its
//! roll, a push and the dolly zoom that it is.

use cinesplat_language::{Linked, is_listed};
use cinesplat_operator::{Framing, Pass, Step, SubjectPart};
use cinesplat_trajectory::Move;

use super::briefs::is_camera_verb;
use crate::direction::Direction;

/// Joins a move with the words behind it that only say from where to where it goes: `tilt up the bookshelf, from the bottom shelf to
/// the candle on top`.
pub(super) fn join_continued(linked: &Linked, direction: &mut Direction) {
    for nth in (1..direction.program.steps.len()).rev() {
        let [before, step] = [&direction.program.steps[nth - 1], &direction.program.steps[nth]];
        let words = linked.texts_in(step.words.unwrap_or_default());
        let lead = words.iter().position(|word| !matches!(*word, "," | ";" | "all" | "right"));
        let continues = lead.is_some_and(|lead| words[lead] == "from") && words.contains(&"to");
        let moves = (0..words.len()).any(|at| is_camera_verb(&words, at));
        let is_same = before.movement == step.movement && before.via.is_none() && !step.cut;
        let is_open = before.end.size.is_none() && before.amount.is_none();
        if !continues || moves || !is_same || !is_open || step.start.subjects.is_empty() || before.words == step.words {
            continue;
        }
        let start = if before.start.subjects == step.start.subjects && step.start.part == SubjectPart::Middle {
            before.start.clone()
        } else {
            step.start.clone()
        };
        let joined = Step { start, end: step.end.clone(), words: step.joint_words(before), ..before.clone() };
        direction.join_steps(nth, joined);
    }
}

/// Passes, on a slide along something, what the words behind it only list: `slide right along the sideboard: plant, books, radio`.
pub(super) fn pass_listed(linked: &Linked, direction: &mut Direction) {
    let is_bare = |step: &Step| {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let is_name = |word: &&str| is_listed(", . and the then finally", word) || linked.slot_at(word).is_some();
        let names = words.iter().any(|word| linked.slot_at(word).is_some());
        names && words.iter().all(is_name) && step.end.subjects.len() == 1 && step.via.is_none()
    };
    let mut nth = 0;
    while nth < direction.program.steps.len() {
        let step = &direction.program.steps[nth];
        let slides = matches!(step.movement, Move::TruckLeft | Move::TruckRight);
        let is_along = step.via.as_ref().is_some_and(|via| via.how == Pass::Along);
        let words = linked.texts_in(step.words.unwrap_or_default());
        let lists = words.contains(&":");
        let listed = direction.program.steps[nth + 1..].iter().take_while(|step| is_bare(step)).count();
        if slides && is_along && lists && listed > 0 {
            let last = direction.program.steps[nth + listed].clone();
            let words = last.joint_words(&direction.program.steps[nth]);
            for at in (nth + 1..=nth + listed).rev() {
                direction.remove_step(at);
            }
            let step = &mut direction.program.steps[nth];
            (step.end, step.words) = (last.end, words);
        }
        nth += 1;
    }
}

/// Rolls the picture that the step before only shows, where both are about the same: nothing else moves.
pub(super) fn roll_on_the_spot(linked: &Linked, direction: &mut Direction) {
    for nth in (1..direction.program.steps.len()).rev() {
        let [before, step] = [&direction.program.steps[nth - 1], &direction.program.steps[nth]];
        let shown = linked.expanded(&before.end.subjects);
        let own = linked.expanded(&step.end.subjects);
        let plain = Framing { subjects: step.end.subjects.clone(), ..Framing::default() };
        let rolls = matches!(step.movement, Move::RollCw | Move::RollCcw) && step.start == Framing::default();
        let is_same = step.end == plain && !own.is_empty() && own.iter().all(|id| shown.contains(id));
        let rest = Step { end: before.end.clone(), words: before.words, speed: before.speed, ..Step::of(Move::Static) };
        if rolls && is_same && *before == rest {
            let joined = Step { end: before.end.clone(), words: step.joint_words(before), ..step.clone() };
            direction.join_steps(nth, joined);
        }
    }
}

/// Most bytes of a push and its dolly zoom.
const MOST_BYTES: usize = 160;

/// Joins a push with the dolly zoom on the same thing behind it: `walk towards the plant and the background stretches away`.
pub(super) fn join_dolly_zooms(direction: &mut Direction) {
    for nth in (1..direction.program.steps.len()).rev() {
        let [before, step] = [&direction.program.steps[nth - 1], &direction.program.steps[nth]];
        let way = match step.movement {
            Move::DollyZoomIn => Move::PushIn,
            Move::DollyZoomOut => Move::PullOut,
            _ => continue,
        };
        let is_plain = before.amount.is_none() && before.end.size.is_none() && !before.end.whole;
        let is_same = before.end.subjects == step.end.subjects || step.end.subjects.is_empty();
        let words = step.joint_words(before);
        let joined = words.is_some_and(|[from, to]| to - from < MOST_BYTES);
        if before.movement == way && is_plain && is_same && joined && before.start.subjects.is_empty() {
            let mut one = Step { words, ..step.clone() };
            one.end.subjects.clone_from(&before.end.subjects);
            direction.join_steps(nth, one);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::fixture::{direction, read, seen};
    use super::*;
    use cinesplat_operator::Via;

    #[test]
    fn a_push_and_a_dolly_zoom_on_one_thing_are_one() {
        let (_, steps) =
            read("walk towards <obj-0> | and the background stretches", &[(Move::PushIn, 5), (Move::DollyZoomIn, 5)]);
        let mut read = direction(steps);
        join_dolly_zooms(&mut read);
        assert_eq!(seen(&read.program.steps), [(Move::DollyZoomIn, vec![5])]);
    }

    #[test]
    fn from_and_to_behind_a_move_are_its_own() {
        let (linked, mut steps) =
            read("tilt up <obj-0> | , from the bottom to <obj-1>", &[(Move::TiltUp, 5), (Move::TiltUp, 7)]);
        steps[0].start.subjects = vec![5];
        steps[0].start.part = SubjectPart::Bottom;
        steps[1].start.subjects = vec![5];
        let mut read = direction(steps);
        join_continued(&linked, &mut read);
        assert_eq!(seen(&read.program.steps), [(Move::TiltUp, vec![7])]);
        assert_eq!(read.program.steps[0].start.part, SubjectPart::Bottom);
    }

    #[test]
    fn a_slide_passes_what_is_listed_behind_it() {
        let moves = [(Move::TruckRight, 5), (Move::Follow, 7), (Move::Follow, 5)];
        let (linked, mut steps) = read("slide right along <obj-0> : <obj-0> , | <obj-1> , | <obj-0> .", &moves);
        steps[0].via = Some(Via { how: Pass::Along, objects: vec![9] });
        let mut read = direction(steps);
        pass_listed(&linked, &mut read);
        assert_eq!(seen(&read.program.steps), [(Move::TruckRight, vec![5])]);
    }

    #[test]
    fn a_roll_of_the_picture_before_is_one_picture() {
        let (linked, mut steps) =
            read("top shot of <obj-0> | let the camera roll", &[(Move::Static, 5), (Move::RollCw, 5)]);
        steps[0].end.whole = true;
        let mut read = direction(steps);
        roll_on_the_spot(&linked, &mut read);
        assert_eq!(seen(&read.program.steps), [(Move::RollCw, vec![5])]);
        assert!(read.program.steps[0].end.whole);
    }
}

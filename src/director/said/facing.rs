//! First pictures that face a thing, and last ones that look down on it: `start face to face with it, then crane up and over until
//! we look down on its top`.

use cinesplat_language::{Linked, is_listed};
use cinesplat_operator::{Framing, Step, SubjectPart, SubjectSide};
use cinesplat_trajectory::{Move, ShotAngle, ShotSize};

use super::briefs::is_camera_verb;
use super::directions::{is_form, says_any};
use super::openings::OPENS;

/// Words of a picture in which a thing faces us.
const FACES: [&[&str]; 17] = [
    &["face", "to", "face"],
    &["eye", "to", "eye"],
    &["nose", "to", "nose"],
    &["head", "on"],
    &["dead", "on"],
    &["square", "on"],
    &["face", "on"],
    &["frontal"],
    &["frontally"],
    &["full", "face"],
    &["in", "front", "of", "it"],
    &["in", "front", "of", "him"],
    &["in", "front", "of", "her"],
    &["in", "the", "eye"],
    &["in", "the", "eyes"],
    &["facing", "us"],
    &["looking", "at", "us"],
];
/// Verbs that say where the camera is, besides those that open a film.
const STANDS: [&str; 6] = ["look", "stand", "face", "hold", "rest", "stare"];
/// Words of a look from above, and words of the top of a thing.
const DOWN: [&[&str]; 8] = [
    &["down", "on"],
    &["down", "onto"],
    &["down", "upon"],
    &["down", "at"],
    &["from", "above"],
    &["straight", "down"],
    &["above", "it"],
    &["over", "the", "top"],
];

/// Whether words say that a thing faces us: `face to face`, `head on`.
pub(super) fn are_face_to_face(words: &[&str]) -> bool {
    says_any(words, &FACES)
}

/// Begins with the front of a thing where the words face it before any move.
pub(crate) fn begin_face_to_face(linked: &Linked, steps: &mut [Step]) {
    let Some(step) = steps.first_mut() else { return };
    let words = linked.texts_in(step.words.unwrap_or_default());
    let is_move = |at: usize| {
        let stands = OPENS.contains(&words[at]) || STANDS.iter().any(|verb| is_form(words[at], verb));
        let comes = ["come", "go", "get", "bring"].iter().any(|verb| is_form(words[at], verb));
        is_camera_verb(&words, at) && !stands || comes
    };
    let opening = (0..words.len()).find(|at| is_move(*at)).unwrap_or(words.len());
    let faces = are_face_to_face(&words[..opening]);
    let rests = step.movement == Move::Static;
    let mut framing = if rests { step.end.clone() } else { step.start.clone() };
    let is_open = framing.side.is_none() && framing.angle.is_none_or(|angle| angle != ShotAngle::Overhead);
    if !faces || !is_open || step.movement == Move::Reveal {
        return;
    }
    if framing.subjects.is_empty() {
        framing.subjects.clone_from(&step.end.subjects);
    }
    // Of several things each has its own front.
    if framing.subjects.len() > 1 {
        return;
    }
    framing.side = Some(SubjectSide::FromFront);
    if rests {
        step.end = framing;
    } else {
        step.start = framing;
    }
}

/// Rests on the first picture where its words only open on it, and the network has read the second step's rise or descent into it.
pub(crate) fn rest_on_openings(linked: &Linked, steps: &mut [Step]) {
    let [first, second, ..] = steps else { return };
    let words = linked.texts_in(first.words.unwrap_or_default());
    let opens = words.iter().take(3).any(|word| OPENS.contains(word) || *word == "face")
        || words.first().is_some_and(|word| is_listed("tight close wide medium macro full", word));
    let says_move =
        (0..words.len()).any(|at| is_camera_verb(&words, at) && !OPENS.contains(&words[at]) || words[at] == "from");
    let lifts = matches!(
        first.movement,
        Move::CraneUp | Move::CraneDown | Move::PedestalUp | Move::PedestalDown | Move::TiltUp | Move::TiltDown
    );
    let is_told = first.movement == second.movement && first.words != second.words;
    if !opens || says_move || !lifts || !is_told || first.amount.is_some() || first.end.subjects.is_empty() {
        return;
    }
    let start = std::mem::take(&mut first.start);
    let own = linked.expanded(&start.subjects) == linked.expanded(&first.end.subjects);
    let end = if own { start } else { std::mem::take(&mut first.end) };
    *first = Step { end, words: first.words, duration_secs: first.duration_secs, ..Step::of(Move::Static) };
}

/// Rests close on what the words look at up close, which leads nowhere up: `we look first at the teeth, up close`.
pub(crate) fn rest_up_close(linked: &Linked, steps: &mut [Step]) {
    for step in steps {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let up_close = words.windows(2).any(|two| two == ["up", "close"]);
        let ups = words.iter().filter(|word| is_listed("up upward upwards", word)).count();
        let says_move = (0..words.len()).any(|at| is_camera_verb(&words, at) && !OPENS.contains(&words[at]));
        let lifts = matches!(step.movement, Move::TiltUp | Move::PedestalUp | Move::CraneUp);
        let is_plain = step.amount.is_none() && step.with.is_empty() && !step.end.subjects.is_empty();
        if up_close && ups == 1 && !says_move && lifts && is_plain {
            let end = Framing { size: Some(ShotSize::CloseUp), angle: None, ..step.end.clone() };
            *step = Step { end, words: step.words, duration_secs: step.duration_secs, ..Step::of(Move::Static) };
        }
    }
}

/// Ends a rise above its subject, and not aimed at the upper end of it, where the words look down on its top.
pub(crate) fn look_down_on_tops(linked: &Linked, steps: &mut [Step]) {
    for step in steps {
        let rises = matches!(step.movement, Move::CraneUp | Move::PedestalUp | Move::Follow | Move::PushIn);
        let words = linked.texts_in(step.words.unwrap_or_default());
        let end = &step.end;
        let is_free = end.elevation_deg.is_none() && end.height.is_none() && end.angle != Some(ShotAngle::Low);
        let is_top = end.part == SubjectPart::Top && end.subjects.len() == 1;
        let behind = words.iter().position(|word| ["up", "rise", "lift"].iter().any(|verb| is_form(word, verb)));
        if !rises || !is_free || !is_top || !says_any(&words[behind.unwrap_or(0)..], &DOWN) {
            continue;
        }
        step.movement = Move::CraneUp;
        step.end =
            Framing { angle: Some(ShotAngle::Overhead), part: SubjectPart::Middle, ..std::mem::take(&mut step.end) };
    }
}

#[cfg(test)]
mod tests {
    use super::super::fixture::linked;
    use super::*;

    fn step(text: &str, [from, to]: [usize; 2], movement: Move) -> Step {
        let end = Framing { subjects: vec![5], ..Framing::default() };
        Step { end, words: Some([from, to.min(text.len())]), ..Step::of(movement) }
    }

    #[test]
    fn a_film_begins_with_the_front_that_it_faces() {
        let side = |text: &str, movement| {
            let mut steps = vec![step(text, [0, usize::MAX], movement)];
            begin_face_to_face(&linked(text), &mut steps);
            [steps[0].start.side, steps[0].end.side]
        };
        let front = Some(SubjectSide::FromFront);
        assert_eq!(side("start face to face with <obj-0> and rise", Move::CraneUp), [front, None]);
        assert_eq!(side("head on to <obj-0> , hold", Move::Static), [None, front]);
        assert_eq!(side("look <obj-0> in the eye , then go up", Move::CraneUp), [front, None]);
        assert_eq!(side("come down in front of it and stop face to face", Move::CraneDown), [None, None]);
    }

    #[test]
    fn an_opening_rests_before_the_move() {
        let text = "start on <obj-0> , level with it , then crane up";
        let mut steps = vec![step(text, [0, 33], Move::CraneUp), step(text, [33, 50], Move::CraneUp)];
        rest_on_openings(&linked(text), &mut steps);
        assert_eq!([steps[0].movement, steps[1].movement], [Move::Static, Move::CraneUp]);
        let text = "start on <obj-0> , rise over it , then crane up";
        let mut steps = vec![step(text, [0, 33], Move::CraneUp), step(text, [33, 50], Move::CraneUp)];
        rest_on_openings(&linked(text), &mut steps);
        assert_eq!(steps[0].movement, Move::CraneUp);
    }

    #[test]
    fn up_close_is_no_way_up() {
        let movement = |text: &str| {
            let mut steps = vec![step(text, [0, usize::MAX], Move::TiltUp)];
            rest_up_close(&linked(text), &mut steps);
            (steps[0].movement, steps[0].end.size)
        };
        assert_eq!(movement("we look first at <obj-0> , up close"), (Move::Static, Some(ShotSize::CloseUp)));
        assert_eq!(movement("tilt up to <obj-0> , up close"), (Move::TiltUp, None));
    }

    #[test]
    fn a_rise_ends_above_what_the_words_look_down_on() {
        let angle = |text: &str| {
            let mut steps = vec![step(text, [0, usize::MAX], Move::CraneUp)];
            steps[0].end.part = SubjectPart::Top;
            look_down_on_tops(&linked(text), &mut steps);
            (steps[0].end.angle, steps[0].end.part)
        };
        let above = (Some(ShotAngle::Overhead), SubjectPart::Middle);
        assert_eq!(angle("crane up and over until we look down on the top of <obj-0>"), above);
        assert_eq!(angle("rise until you see the top of <obj-0> from above"), above);
        assert_eq!(angle("rise to the top of <obj-0>"), (None, SubjectPart::Top));
    }
}

//! Moves that the words name, about what they were said of: `from the left chair truck to the right chair`, `pan right to the bucket,
//! push`, `hold on the mask`, `straight down, no tilt`.

use cinesplat_language::{Linked, add_ids, is_listed};
use cinesplat_operator::{Look, Pass, Step, SubjectPart, SubjectSide, Via};
use cinesplat_trajectory::Move;

use super::briefs::is_camera_verb;
use super::directions::is_form;
use super::joined_moves::{join_continued, join_dolly_zooms, pass_listed, roll_on_the_spot};
use crate::direction::Direction;

/// Words that deny the verb behind them, and how many of the words before may be one.
const DENIALS: &str = "no not never without 't dont nor instead than of counter";
const NUM_BEFORE: usize = 3;
/// Verbs that say no way.
const STOPS: [&str; 10] = ["hold", "rest", "pause", "linger", "stop", "start", "begin", "finish", "land", "settle"];

/// The move that a verb names and that leaves its side open.
fn named(word: &str) -> Option<Move> {
    let named = [("pan", Move::PanRight), ("truck", Move::TruckRight)];
    named.into_iter().find(|(verb, _)| is_form(word, verb)).map(|(_, movement)| movement)
}

/// Whether the word at `at` is denied.
fn is_denied(words: &[&str], at: usize) -> bool {
    words[..at].iter().rev().take(NUM_BEFORE).any(|word| is_listed(DENIALS, word))
}

/// Corrects moves, and what they are about, by what their words name.
pub(crate) fn take_named_moves(linked: &Linked, direction: &mut Direction) {
    join_continued(linked, direction);
    pass_listed(linked, direction);
    let steps = &mut direction.program.steps;
    show_until(linked, steps);
    move_as_named(linked, steps);
    rest_as_named(linked, steps);
    stay_with_subject(linked, steps);
    face_on_the_way(linked, direction);
    travel_without_tilt(linked, &mut direction.program.steps);
    show_all_of_number(linked, &mut direction.program.steps);
    join_dolly_zooms(direction);
    land_where_next_starts(&mut direction.program.steps);
    roll_on_the_spot(linked, direction);
    end_on_both(linked, &mut direction.program.steps);
    rise_along_itself(&mut direction.program.steps);
}

/// Pans and slides where the words of a way name no other move.
fn move_as_named(linked: &Linked, steps: &mut [Step]) {
    for step in steps {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let verbs = (0..words.len()).filter(|&at| is_camera_verb(&words, at) && !is_denied(&words, at));
        let mut verbs = verbs.filter(|&at| !STOPS.iter().any(|stop| is_form(words[at], stop)));
        let (Some(first), None) = (verbs.next(), verbs.next()) else { continue };
        let is_way = matches!(step.movement, Move::Follow | Move::FlyThrough) && step.with.is_empty();
        let Some(movement) = named(words[first]).filter(|_| is_way && step.via.is_none()) else { continue };
        (step.movement, step.either_way) = (movement, true);
    }
}

/// Words that stand for more than the thing shown last, or for an earlier one.
const OTHERS: &str = "either neither both all they them everything room whole entire other others another first began beginning opening ones one \
    each every everyone pair two three four five six seven group scene start where back again same there rest next former latter";

/// Moves about the thing that the step before ends on, where the words of a step name nothing.
fn stay_with_subject(linked: &Linked, steps: &mut [Step]) {
    for nth in 1..steps.len() {
        let words = linked.texts_in(steps[nth].words.unwrap_or_default());
        let names = words.iter().any(|word| linked.slot_at(word).is_some() || is_listed(OTHERS, word));
        let own = steps[nth - 1].words != steps[nth].words && !words.is_empty();
        let [before] = steps[nth - 1].end.subjects[..] else { continue };
        let step = &mut steps[nth];
        let [subject] = step.end.subjects[..] else { continue };
        let is_plain = step.start.subjects.is_empty() && step.via.is_none() && step.look.is_none() && !step.returns;
        let is_about = step.movement.is_circular()
            || matches!(step.movement, Move::PushIn | Move::PullOut | Move::ZoomIn | Move::ZoomOut | Move::Static);
        if own && !names && is_plain && is_about && subject != before {
            step.end.subjects = vec![before];
        }
    }
}

/// Verbs of a rest.
const RESTS: [&str; 7] = ["hold", "rest", "linger", "dwell", "pause", "stay", "settle"];

/// Rests where the words of a step say that it rests on something, and no move.
fn rest_as_named(linked: &Linked, steps: &mut [Step]) {
    for nth in 1..steps.len() {
        let words = linked.texts_in(steps[nth].words.unwrap_or_default());
        let lead = words.iter().position(|word| !is_listed("and then , ; . finally", word)).unwrap_or(0);
        let rests = words.get(lead).is_some_and(|word| RESTS.iter().any(|rest| is_form(word, rest)))
            && words.get(lead + 1) == Some(&"on")
            && words.get(lead + 2..).is_some_and(|rest| rest.iter().take(2).any(|word| linked.slot_at(word).is_some()));
        let moves = (lead + 1..words.len()).any(|at| is_camera_verb(&words, at));
        // A turn to a thing on which it then rests is a turn.
        let repeats = steps[nth].movement.is_circular()
            && (steps[nth].movement == steps[nth - 1].movement
                || nth > 1 && steps[nth].movement == steps[nth - 2].movement);
        if rests && !moves && repeats {
            let (end, words) = (steps[nth].end.clone(), steps[nth].words);
            steps[nth] = Step { end, words, duration_secs: steps[nth].duration_secs, ..Step::of(Move::Static) };
        }
    }
}

/// Words of a camera that faces something on its way.
const FACES: &str = "facing looking watching";
const BETWEEN: &str = "in a straight line , and while always the at to still";

/// Looks at what the words after a way only say that it faces: `from the left speaker to the right one, facing the stage`.
fn face_on_the_way(linked: &Linked, direction: &mut Direction) {
    for nth in (1..direction.program.steps.len()).rev() {
        let steps = &mut direction.program.steps;
        let words = linked.texts_in(steps[nth].words.unwrap_or_default());
        let faces = words.iter().any(|word| is_listed(FACES, word));
        let is_rest =
            |word: &&str| is_listed(BETWEEN, word) || is_listed(FACES, word) || linked.slot_at(word).is_some();
        let travels = matches!(steps[nth - 1].movement, Move::Follow | Move::TruckLeft | Move::TruckRight);
        let faced = steps[nth].end.subjects.clone();
        let is_way = steps[nth].movement == Move::Follow || steps[nth].movement == Move::Static;
        if faces && words.iter().all(is_rest) && travels && is_way && !faced.is_empty() {
            steps[nth - 1].look.get_or_insert(Look::At(faced));
            direction.remove_step(nth);
        }
    }
}

/// Goes straight up or down where the words rule out a tilt and name none.
fn travel_without_tilt(linked: &Linked, steps: &mut [Step]) {
    let words: Vec<&str> = linked.tokens_text.split(' ').collect();
    let tilts = |at: usize| is_form(words[at], "tilt");
    let denies =
        |at: usize| words[..at].iter().rev().take(2).any(|word| is_listed("no not never without 't dont", word));
    let (mut denied, mut named) = (false, false);
    for at in (0..words.len()).filter(|at| tilts(*at)) {
        if denies(at) { denied = true } else { named = true }
    }
    if !denied || named {
        return;
    }
    for step in steps {
        step.movement = match step.movement {
            Move::TiltUp => Move::PedestalUp,
            Move::TiltDown => Move::PedestalDown,
            movement => movement,
        };
    }
}

/// Shows everything so far where the words of a step mean all of it by number: `widen the lens so all three are in`.
fn show_all_of_number(linked: &Linked, steps: &mut [Step]) {
    for nth in 1..steps.len() {
        let words = linked.texts_in(steps[nth].words.unwrap_or_default());
        let names = words.iter().any(|word| linked.slot_at(word).is_some());
        let number = words.windows(2).find_map(|two| match two {
            ["all", "three"] => Some(3),
            ["all", "four"] => Some(4),
            ["them", "both"] => Some(2),
            _ => None,
        });
        let Some(number) = number.filter(|_| !names) else { continue };
        let mut shown: Vec<u32> = Vec::new();
        for step in &steps[..nth] {
            add_ids(&mut shown, &step.start.subjects);
            step.via.iter().for_each(|via| add_ids(&mut shown, &via.objects));
            add_ids(&mut shown, &step.end.subjects);
        }
        let leaves = matches!(steps[nth].movement, Move::PullOut | Move::ZoomOut | Move::CraneUp | Move::Static);
        if leaves && shown.len() == number {
            steps[nth].end.subjects = shown;
            steps[nth].end.whole = true;
        }
    }
}

fn goes_up_or_down(step: &Step) -> bool {
    matches!(step.movement, Move::TiltUp | Move::TiltDown | Move::PedestalUp | Move::PedestalDown)
}

/// Turns to the part of a thing from which the next move starts: `whip left to the guitar, and tilt up it from the body to the head`
/// does not land on its middle.
fn land_where_next_starts(steps: &mut [Step]) {
    for nth in 1..steps.len() {
        let next = &steps[nth];
        let (subjects, part) = (next.start.subjects.clone(), next.start.part);
        let rises = goes_up_or_down(next);
        let before = &mut steps[nth - 1];
        let turns = matches!(before.movement, Move::PanLeft | Move::PanRight | Move::WhipPan);
        let is_open = before.end.part == SubjectPart::Middle && before.end.size.is_none() && !before.end.whole;
        if rises && turns && is_open && part != SubjectPart::Middle && before.end.subjects == subjects {
            before.end.part = part;
        }
    }
}

/// Drops the way along a thing of a rise from its foot to its top, which is that way.
fn rise_along_itself(steps: &mut [Step]) {
    for step in steps {
        let rises = goes_up_or_down(step);
        let is_own = |via: &Via| {
            via.how == Pass::Along
                && (via.objects == step.end.subjects
                    || step.end.subjects.is_empty() && via.objects == step.start.subjects)
        };
        // Who starts behind a bench has passed behind it.
        let is_start = |via: &Via| via.how == Pass::Behind && via.objects == step.start.subjects;
        let starts_behind = step.start.side == Some(SubjectSide::FromBack);
        let is_said =
            |via: &Via| rises && is_own(via) || starts_behind && step.movement != Move::Reveal && is_start(via);
        if step.via.as_ref().is_some_and(is_said) {
            step.via = None;
        }
    }
}

/// Words of a picture that something is in.
const PICTURES: &str = "shot frame picture view";

/// Ends with what a way leads until: `up over the stool, until both easels stand side by side in the shot`.
fn show_until(linked: &Linked, steps: &mut [Step]) {
    for step in steps {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let Some(until) = words.iter().position(|word| is_listed("until till", word)) else { continue };
        let is_in =
            |at: &usize| words[*at] == "in" && words[*at + 1..].iter().take(2).any(|word| is_listed(PICTURES, word));
        let Some(end) = (until..words.len()).find(is_in) else { continue };
        let ids: Vec<u32> = words[until..end].iter().filter_map(|word| linked.slot_at(word)).collect();
        let shown = linked.expanded(&step.end.subjects);
        let is_missing = |id: &u32| linked.expanded(&[*id]).iter().any(|id| !shown.contains(id));
        let opens = matches!(
            step.movement,
            Move::CraneUp
                | Move::PedestalUp
                | Move::PullOut
                | Move::ZoomOut
                | Move::TruckLeft
                | Move::TruckRight
                | Move::Follow
        );
        if opens && ids.iter().any(is_missing) && step.end.place.is_none() {
            step.end.subjects = ids;
            step.end.whole = true;
        }
    }
}

/// Ends with both of two things that the words of a turn or a way call by their number: `tilt up to the two lamps`.
fn end_on_both(linked: &Linked, steps: &mut [Step]) {
    for step in steps {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let says = words.iter().any(|word| is_listed("both two pair", word));
        let ends_on_two = linked.expanded(&step.end.subjects).len() == 2;
        let turns = matches!(
            step.movement,
            Move::PanLeft | Move::PanRight | Move::TiltUp | Move::TiltDown | Move::WhipPan | Move::Static
        );
        let is_open = step.end.size.is_none() && step.end.place.is_none() && step.end.part == SubjectPart::Middle;
        if says && ends_on_two && turns && is_open {
            step.end.whole = true;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::fixture::{direction, read, seen};
    use super::*;

    #[test]
    fn a_way_whose_words_name_a_slide_or_a_turn_is_one() {
        let moved = |text: &str| {
            let (linked, mut steps) = read(text, &[(Move::Follow, 7)]);
            move_as_named(&linked, &mut steps);
            steps[0].movement
        };
        assert_eq!(moved("from <obj-0> truck to <obj-1>"), Move::TruckRight);
        assert_eq!(moved("from <obj-0> pan to <obj-1>"), Move::PanRight);
        assert_eq!(moved("walk to <obj-1> without a pan"), Move::Follow);
    }

    #[test]
    fn a_move_that_names_nothing_is_about_what_was_shown_last() {
        let shown = |text: &str| {
            let (linked, mut steps) = read(text, &[(Move::PanRight, 7), (Move::PushIn, 5)]);
            stay_with_subject(&linked, &mut steps);
            steps[1].end.subjects[0]
        };
        assert_eq!(shown("pan right to <obj-1> | then push"), 7);
        assert_eq!(shown("pan right to <obj-1> | then push in on the first one"), 5);
        assert_eq!(shown("pan right to <obj-1> | then push in on <obj-0>"), 5);
    }

    #[test]
    fn a_rest_is_no_second_circle() {
        let (linked, mut steps) =
            read("circle <obj-0> | and hold on <obj-1>", &[(Move::OrbitRight, 5), (Move::OrbitRight, 7)]);
        rest_as_named(&linked, &mut steps);
        assert_eq!(seen(&steps), [(Move::OrbitRight, vec![5]), (Move::Static, vec![7])]);
    }

    #[test]
    fn what_a_way_faces_is_looked_at() {
        let (linked, steps) =
            read("go from here to there | in a straight line facing <obj-1>", &[(Move::Follow, 5), (Move::Follow, 7)]);
        let mut read = direction(steps);
        face_on_the_way(&linked, &mut read);
        let steps = read.program.steps;
        assert_eq!(seen(&steps), [(Move::Follow, vec![5])]);
        assert_eq!(steps[0].look, Some(Look::At(vec![7])));
    }

    #[test]
    fn without_a_tilt_the_camera_travels() {
        let moved = |text: &str| {
            let (linked, mut steps) = read(text, &[(Move::TiltDown, 5)]);
            travel_without_tilt(&linked, &mut steps);
            steps[0].movement
        };
        assert_eq!(moved("the camera goes down itself , not tilt"), Move::PedestalDown);
        assert_eq!(moved("tilt down , then no tilt"), Move::TiltDown);
    }

    #[test]
    fn all_three_are_those_shown() {
        let moves = [(Move::PedestalUp, 1), (Move::Follow, 2), (Move::ZoomOut, 2)];
        let (linked, mut steps) = read("rise | carry on | widen the lens so all three are in", &moves);
        steps[0].start.subjects = vec![3];
        show_all_of_number(&linked, &mut steps);
        assert_eq!(steps[2].end.subjects, [3, 1, 2]);
        assert!(steps[2].end.whole);
    }

    #[test]
    fn a_turn_lands_where_the_tilt_behind_it_starts() {
        let (_, mut steps) = read("whip to <obj-0> | tilt up it", &[(Move::WhipPan, 5), (Move::TiltUp, 5)]);
        steps[1].start.subjects = vec![5];
        steps[1].start.part = SubjectPart::Bottom;
        steps[1].via = Some(Via { how: Pass::Along, objects: vec![5] });
        land_where_next_starts(&mut steps);
        rise_along_itself(&mut steps);
        assert_eq!(steps[0].end.part, SubjectPart::Bottom);
        assert_eq!(steps[1].via, None);
    }

    #[test]
    fn both_things_that_a_turn_ends_on_are_whole() {
        let whole = |text: &str| {
            let (linked, mut steps) = read(text, &[(Move::TiltUp, 5)]);
            steps[0].end.subjects.push(7);
            end_on_both(&linked, &mut steps);
            steps[0].end.whole
        };
        assert!(whole("tilt up to the two lamps"));
        assert!(!whole("tilt up to the lamps"));
    }

    #[test]
    fn a_way_ends_with_what_it_leads_until() {
        let (linked, mut steps) = read("rise until both <obj-0> stand side by side in the shot", &[(Move::CraneUp, 9)]);
        steps[0].end.subjects.clear();
        show_until(&linked, &mut steps);
        assert_eq!(steps[0].end.subjects, [5]);
        assert!(steps[0].end.whole);
    }
}

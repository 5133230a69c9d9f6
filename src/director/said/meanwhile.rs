//! What happens at the same time, and one way after another behind one verb: `sink while tracking left`, `3) simultaneously FOV to
//! 60°`, `sway left, right, and left once more`.

use cinesplat_language::{Linked, is_listed};
use cinesplat_operator::{Framing, Lens, Look, MAX_SECOND_MOVES, Program, Step};
use cinesplat_trajectory::Move;

use super::directions::is_form;
use crate::direction::Direction;

/// Verbs of a way to a side, and words before it that make it one at the same time.
const SIDEWAYS: [&str; 9] = ["track", "truck", "slide", "drift", "crab", "move", "travel", "glide", "shift"];
const MEANWHILE: &str = "while whilst as and";

/// Moves to a side at the same time where the words say so: `sink while tracking left`.
pub(crate) fn move_aside_meanwhile(linked: &Linked, steps: &mut [Step]) {
    for step in steps {
        let goes_aside = |movement: &Move| matches!(movement, Move::TruckLeft | Move::TruckRight);
        let lifts = matches!(
            step.movement,
            Move::CraneUp | Move::CraneDown | Move::PedestalUp | Move::PedestalDown | Move::PushIn | Move::PullOut
        );
        if !lifts || step.with.iter().any(goes_aside) || step.with.len() >= MAX_SECOND_MOVES {
            continue;
        }
        let words = linked.texts_in(step.words.unwrap_or_default());
        let side = (1..words.len()).find_map(|at| {
            let gerund = words[at].ends_with("ing") && SIDEWAYS.iter().any(|verb| is_form(words[at], verb));
            let joins = words[at.saturating_sub(3)..at].iter().any(|word| is_listed(MEANWHILE, word));
            let behind = words[at + 1..].iter().take(3).find(|word| matches!(**word, "left" | "right"))?;
            (gerund && joins).then_some(*behind == "left")
        });
        step.with.extend(side.map(|is_left| if is_left { Move::TruckLeft } else { Move::TruckRight }));
    }
}

/// Words of further ways to sides: `to the right`, `and left once more`.
const ONCE_MORE: &str = "to the and then . , again once more back over it a little bit slowly gently";

/// Goes to each side that the words list behind one verb: `we sway to the left ... to the right ... and to the left once more`.
pub(crate) fn sway_to_each(linked: &Linked, direction: &mut Direction) {
    for nth in (0..direction.program.steps.len()).rev() {
        let step = &direction.program.steps[nth];
        if !matches!(step.movement, Move::TruckLeft | Move::TruckRight | Move::PanLeft | Move::PanRight) {
            continue;
        }
        let Some([from, _]) = step.words else { continue };
        let next = direction.program.steps.get(nth + 1).and_then(|step| step.words).map_or(usize::MAX, |next| next[0]);
        let sides = sides_in(&linked.texts_in([from, next]));
        if sides.len() < 3 {
            continue;
        }
        let travels = matches!(step.movement, Move::TruckLeft | Move::TruckRight);
        let [left, right] = if travels { [Move::TruckLeft, Move::TruckRight] } else { [Move::PanLeft, Move::PanRight] };
        let mut base = Step { either_way: false, ..step.clone() };
        if travels && !step.end.subjects.is_empty() {
            // What all of them would end on is what they look at.
            base.look = Some(Look::At(std::mem::take(&mut base.end).subjects));
        }
        let swayed = |is_left: &bool| Step { movement: if *is_left { left } else { right }, ..base.clone() };
        let mut swayed: Vec<Step> = sides.iter().map(swayed).collect();
        direction.program.steps[nth] = swayed.remove(0);
        let more = swayed.len();
        let others = Direction {
            program: Program { steps: swayed, ..Program::default() },
            step_cameras: direction.step_cameras.get(nth).map_or_else(Vec::new, |cameras| vec![*cameras; more]),
            certainty: direction.certainty.get(nth).map_or_else(Vec::new, |certainty| vec![certainty.clone(); more]),
            ..Direction::default()
        };
        direction.insert_all(nth + 1, others);
    }
}

/// The sides that words list one after another, whether each is the left one: nothing else stands between them.
fn sides_in(words: &[&str]) -> Vec<bool> {
    let mut sides = Vec::new();
    let first = words.iter().position(|word| matches!(*word, "left" | "right"));
    for word in words.iter().skip(first.unwrap_or(words.len())) {
        match *word {
            "left" => sides.push(true),
            "right" => sides.push(false),
            word if is_listed(ONCE_MORE, word) || !word.contains(char::is_alphanumeric) => {}
            _ => break,
        }
    }
    let alternates = sides.windows(2).all(|two| two[0] != two[1]);
    if alternates { sides } else { Vec::new() }
}

/// Words that begin what happens at the same time as the item of a list before it.
const AT_ONCE: &str = "simultaneously concurrently meanwhile";

/// Joins a step that happens at the same time as the one before it: `2) yaw left. 3) simultaneously FOV to 60°`.
pub(crate) fn join_simultaneous(linked: &Linked, direction: &mut Direction) {
    for nth in (1..direction.program.steps.len()).rev() {
        let [before, step] = &direction.program.steps[nth - 1..=nth] else { continue };
        let words = linked.texts_in(step.words.unwrap_or_default());
        let is_at_once = words.iter().take(4).any(|word| is_listed(AT_ONCE, word));
        let is_plain = step.with.is_empty() && step.via.is_none() && step.start == Framing::default();
        let fits = before.movement != Move::Static
            && step.movement != Move::Static
            && before.movement != step.movement
            && before.with.len() < MAX_SECOND_MOVES;
        let same =
            step.end.subjects.is_empty() || before.end.subjects.is_empty() || before.end.subjects == step.end.subjects;
        if !(is_at_once && is_plain && fits && same) {
            continue;
        }
        let shown = direction.program.steps[..nth].iter().rev().find_map(|step| step.end.lens.or(step.start.lens));
        let mut with = before.with.clone();
        with.push(match (step.movement, shown, step.end.lens) {
            (Move::ZoomIn | Move::ZoomOut, Some(Lens::FovDeg(first)), Some(Lens::FovDeg(last))) => {
                if last > first {
                    Move::ZoomOut
                } else {
                    Move::ZoomIn
                }
            }
            (movement, ..) => movement,
        });
        let lens = before.end.lens.or(step.end.lens);
        let end = Framing { lens, size: before.end.size.or(step.end.size), ..before.end.clone() };
        let one = Step { with, end, words: before.joint_words(step), ..before.clone() };
        direction.join_steps(nth, one);
    }
}

#[cfg(test)]
mod tests {
    use super::super::fixture::{about, direction, linked};
    use super::*;

    fn step(movement: Move, text: &str) -> Step {
        about(movement, &[5], [0, text.len()])
    }

    #[test]
    fn a_way_to_a_side_joins_a_descent() {
        let with = |text: &str| {
            let mut steps = vec![step(Move::CraneDown, text)];
            move_aside_meanwhile(&linked(text), &mut steps);
            steps.remove(0).with
        };
        assert_eq!(with("sink by <obj-0> while tracking left"), [Move::TruckLeft]);
        assert_eq!(with("sink to <obj-0> on the left"), []);
    }

    #[test]
    fn sides_in_a_list_are_ways() {
        let text = "sway to the left . . . to the right . . . and to the left once more before <obj-0>";
        let mut swayed = direction(vec![step(Move::TruckLeft, text)]);
        sway_to_each(&linked(text), &mut swayed);
        let moves: Vec<Move> = swayed.program.steps.iter().map(|step| step.movement).collect();
        assert_eq!(moves, [Move::TruckLeft, Move::TruckRight, Move::TruckLeft]);
        let text = "slide to the left past the right side of <obj-0>";
        let mut slid = direction(vec![step(Move::TruckLeft, text)]);
        sway_to_each(&linked(text), &mut slid);
        assert_eq!(slid.program.steps.len(), 1);
    }

    #[test]
    fn what_happens_at_once_is_one_step() {
        let text = "yaw left . simultaneously zoom out";
        let pan = Step { words: Some([0, 8]), ..Step::of(Move::PanLeft) };
        let zoom = Step { words: Some([11, text.len()]), ..Step::of(Move::ZoomOut) };
        let mut joined = direction(vec![pan, zoom]);
        join_simultaneous(&linked(text), &mut joined);
        assert_eq!((joined.program.steps.len(), &joined.program.steps[0].with[..]), (1, &[Move::ZoomOut][..]));
    }
}

//! Turns all the way round: `spin all the way around on the spot`, `look right round the whole room`, `one complete turn
//! around the anvil`.

use cinesplat_language::{Linked, MAX_STEPS, is_listed};
use cinesplat_operator::{Amount, Framing, Step, SubjectSide};
use cinesplat_trajectory::Move;

use super::directions::is_form;
use super::open::as_orbit;
use crate::direction::Direction;

/// Words of a turn back to where it began, one after the other.
const ALL_ROUND: [&[&str]; 10] = [
    &["all", "the", "way", "round"],
    &["all", "the", "way", "around"],
    &["the", "whole", "way", "round"],
    &["the", "whole", "way", "around"],
    &["right", "round", "the", "room"],
    &["right", "around", "the", "room"],
    &["all", "around", "the", "room"],
    &["all", "round", "the", "room"],
    &["around", "the", "whole", "room"],
    &["round", "the", "whole", "room"],
];

/// Words of a turn that does not come round, and words that deny what follows them.
const SHORT: [&str; 5] = ["almost", "nearly", "half", "quarter", "halfway"];
const DENIALS: [&str; 6] = ["not", "'t", "n't", "without", "no", "never"];

/// What is complete is one circle, and not a part of it: `one full round of the pillar`.
const COMPLETE: [&str; 5] = ["complete", "full", "entire", "whole", "completely"];
const CIRCLES: [&str; 14] = [
    "circle",
    "turn",
    "round",
    "lap",
    "circuit",
    "orbit",
    "loop",
    "revolution",
    "around",
    "rotation",
    "ring",
    "walkaround",
    "pass",
    "spin",
];

/// Verbs of a way that ends somewhere behind a circle.
const ENDS: [&str; 8] = ["end", "finish", "land", "stop", "settle", "arrive", "halt", "come"];

/// Circles what the words circle, or what the step before ends on where they circle `it`, and only then ends elsewhere: `swoop up
/// to the lamp, circle it once and land in front of the fridge`, `.. and come to rest looking at the fridge`.
pub(crate) fn end_behind_circles(linked: &Linked, direction: &mut Direction) {
    for nth in (0..direction.program.steps.len()).rev() {
        let step = &direction.program.steps[nth];
        let words = linked.texts_in(step.words.unwrap_or_default());
        let Some(goal) = goal_behind_circle(&words, &|word| linked.slot_at(word)) else { continue };
        let before = nth.checked_sub(1).map(|before| direction.program.steps[before].end.subjects.clone());
        let circled = goal.circled.map(|id| linked.expanded(&[id])).or(before).unwrap_or_default();
        let subjects = linked.expanded(&[goal.id]);
        let num_steps = direction.program.steps.len();
        let is_one = subjects != step.end.subjects || circled.is_empty() || circled == subjects;
        if !step.movement.is_circular() || is_one || num_steps >= MAX_STEPS {
            continue;
        }
        let side = goal.is_in_front.then_some(SubjectSide::FromFront);
        let end = Framing { subjects, side, ..Framing::default() };
        let way = Step {
            end,
            words: step.words,
            speed: step.speed,
            either_way: goal.movement == Move::PanRight,
            ..Step::of(goal.movement)
        };
        direction.program.steps[nth].end = Framing { subjects: circled, ..Framing::default() };
        direction.insert_rest(nth + 1, way);
    }
}

/// What words end at behind a circle.
struct Goal {
    /// The slot of what is circled; none for `it`.
    circled: Option<u32>,
    id: u32,
    is_in_front: bool,
    /// How the camera gets there.
    movement: Move,
}

/// The thing at which words end behind a circle about another one or about `it`.
fn goal_behind_circle(words: &[&str], slot: &dyn Fn(&str) -> Option<u32>) -> Option<Goal> {
    let rounds = ["circle", "orbit", "loop", "around", "round", "arc"];
    let centers = |at: usize| words[at + 1..].iter().take(3).find_map(|word| slot(word));
    let is_it = |at: usize| matches!(words.get(at + 1), Some(&"it" | &"its"));
    let circles =
        |at: &usize| rounds.iter().any(|verb| is_form(words[*at], verb)) && (is_it(*at) || centers(*at).is_some());
    let circle = (0..words.len()).find(circles)?;
    let is_end =
        |at: &usize| ENDS.iter().any(|verb| is_form(words[*at], verb)) && matches!(words[at - 1], "and" | "then" | ",");
    let end = (circle + 2..words.len()).find(is_end)?;
    let behind = words.get(end + 1..)?;
    let at = behind.iter().take(6).position(|word| slot(word).is_some())?;
    let says = |word: &str| behind[..at].contains(&word);
    let looks = says("looking") || says("facing");
    if words[end].starts_with("com") && !says("rest") {
        return None;
    }
    let movement = match (looks, says("up"), says("down")) {
        (true, true, _) => Move::TiltUp,
        (true, _, true) => Move::TiltDown,
        (true, ..) => Move::PanRight,
        _ => Move::Follow,
    };
    let circled = if is_it(circle) { None } else { centers(circle) };
    Some(Goal { circled, id: slot(behind[at])?, is_in_front: says("front"), movement })
}

/// Rests on the picture with which a circle about another thing is said to begin: `close up of the laptop, then orbit the desk`.
pub(crate) fn begin_before_circles(direction: &mut Direction) {
    let [first, ..] = &direction.program.steps[..] else { return };
    let (start, end) = (&first.start, &first.end);
    let is_other = !start.subjects.is_empty() && !end.subjects.iter().any(|id| start.subjects.contains(id));
    let is_picture = start.size.is_some() && !end.subjects.is_empty();
    if !first.movement.is_circular() || !is_other || !is_picture || direction.program.steps.len() >= MAX_STEPS {
        return;
    }
    let circle = Step { start: Framing::default(), ..first.clone() };
    let rest = Step { end: start.clone(), words: first.words, ..Step::of(Move::Static) };
    direction.insert_rest(0, rest);
    direction.program.steps[1] = circle;
}

/// Gives a pan without a goal, or a circle about its subject, a full turn where its words lead all the way round and state
/// no angle.
pub(crate) fn turn_all_round(linked: &Linked, steps: &mut [Step]) {
    for step in steps {
        let pans = matches!(step.movement, Move::PanLeft | Move::PanRight) && step.end.subjects.is_empty();
        let circles = step.movement.is_circular()
            && step.end.side.is_none()
            && (step.start.subjects.is_empty() || step.start.subjects == step.end.subjects);
        let is_open = !matches!(step.amount, Some(Amount::Degrees(_) | Amount::Factor(_))) && !step.returns;
        let Some(span) = step.words.filter(|_| (pans || circles) && is_open) else { continue };
        let words = linked.texts_in(span);
        let is_all = |at: usize| ALL_ROUND.iter().any(|said| words[at..].starts_with(said));
        let is_complete =
            |at: usize| COMPLETE.contains(&words[at]) && words.get(at + 1).is_some_and(|word| CIRCLES.contains(word));
        let is_said = |at: usize| {
            let before = &words[at.saturating_sub(4)..at];
            (is_all(at) || circles && is_complete(at)) && !before.iter().any(|word| DENIALS.contains(word))
        };
        if (0..words.len()).any(is_said) && !words.iter().any(|word| SHORT.contains(word)) {
            step.amount = Some(Amount::Degrees(360.0));
        }
    }
}

/// Words that only say again how far a circle goes.
const AGAIN: [&str; 16] = [
    "one", "a", "just", "only", "single", "that", "is", "'s", "so", "exactly", "in", "total", "and", "it", "the",
    "close",
];

/// Makes one circle of two of which the second only says again how far the first goes: `all the way round the globe, one full
/// circle`.
pub(crate) fn join_said_again(linked: &Linked, direction: &mut Direction) {
    for nth in (1..direction.program.steps.len()).rev() {
        let [first, second] = [&direction.program.steps[nth - 1], &direction.program.steps[nth]];
        let (a, b) = (as_orbit(first.movement), as_orbit(second.movement));
        let circles = matches!(a, Move::OrbitLeft | Move::OrbitRight) && (a == b || second.either_way);
        let same = second.amount.is_some()
            && (first.amount == second.amount || first.amount.is_none())
            && (second.end.subjects.is_empty() || second.end.subjects == first.end.subjects);
        let words = linked.texts_in(second.words.unwrap_or_default());
        let is_plain = |word: &&str| {
            AGAIN.contains(word)
                || COMPLETE.contains(word)
                || CIRCLES.contains(word)
                || linked.is_quantity(word)
                || !word.starts_with(char::is_alphanumeric) && linked.slot_at(word).is_none()
        };
        if circles && same && !second.cut && first.words != second.words && words.iter().all(is_plain) {
            let (amount, words) = (second.amount, first.joint_words(second));
            direction.join_steps(nth, Step { amount, words, ..first.clone() });
        }
    }
}

/// Makes a full circle of a circle whose end another step tells: `circle him, and come home where you began`.
pub(crate) fn close_circles(linked: &Linked, direction: &mut Direction) {
    for nth in (1..direction.program.steps.len()).rev() {
        let [first, second] = [&direction.program.steps[nth - 1], &direction.program.steps[nth]];
        let turns = first.movement.is_circular();
        let is_full = first.amount == Some(Amount::Degrees(360.0));
        let is_open = is_full || !matches!(first.amount, Some(Amount::Degrees(_) | Amount::Factor(_)));
        let (a, b) = (as_orbit(first.movement), as_orbit(second.movement));
        let goes_on = a == b || first.either_way && a.opposite() == Some(b);
        let words = linked.texts_in(second.words.unwrap_or_default());
        let circles = ["orbit", "circle", "arc", "go", "travel", "retrace", "reverse", "spin", "round", "around"];
        let is_told = words.iter().any(|word| circles.iter().any(|verb| is_form(word, verb)));
        let is_plain = second.amount.is_none() && second.with.is_empty() && second.duration_secs.is_none();
        let keeps = second.end == Framing::default() || second.end.subjects == first.end.subjects;
        let is_own = first.words != second.words && !is_told || is_full && first.words == second.words;
        if turns && is_open && goes_on && second.returns && is_plain && keeps && is_own {
            let words = first.joint_words(second);
            let one = Step { amount: Some(Amount::Degrees(360.0)), returns: false, words, ..first.clone() };
            direction.join_steps(nth, one);
        }
    }
}

/// Words of one movement.
const ONE: &str = "one single continuous";

/// Goes round in one way where the words want one movement and only sides of a thing were read: `profile from left, then front, then
/// profile from right, in one movement only`.
pub(crate) fn go_round_in_one(linked: &Linked, direction: &mut Direction) {
    let words = linked.texts_in([0, usize::MAX]);
    let is_one = words.windows(2).any(|two| is_listed(ONE, two[0]) && matches!(two[1], "movement" | "move" | "go"));
    let [first, .., last] = &direction.program.steps[..] else { return };
    let sees_side = |step: &Step| {
        let turns = step.movement == Move::Static || step.movement.is_circular();
        turns && step.end.side.is_some() && step.end.subjects == last.end.subjects && step.duration_secs.is_none()
    };
    if !is_one || !direction.program.steps.iter().all(sees_side) || first.end.side == last.end.side {
        return;
    }
    let movement = if last.movement.is_circular() { as_orbit(last.movement) } else { Move::OrbitRight };
    let start = Framing { subjects: first.end.subjects.clone(), side: first.end.side, ..Framing::default() };
    let one = Step {
        start,
        end: last.end.clone(),
        either_way: true,
        speed: last.speed,
        words: direction.span(),
        ..Step::of(movement)
    };
    direction.replace_steps(vec![one]);
}

#[cfg(test)]
mod tests {
    use super::super::fixture::{about, direction, linked};
    use super::*;

    #[test]
    fn a_circle_does_not_begin_at_another_thing() {
        use cinesplat_trajectory::ShotSize;
        let start = Framing { subjects: vec![5], size: Some(ShotSize::CloseUp), ..Framing::default() };
        let mut direction = direction(vec![Step { start: start.clone(), ..about(Move::OrbitLeft, &[7], [0, 9]) }]);
        begin_before_circles(&mut direction);
        let [rest, circle] = &direction.program.steps[..] else { panic!("two steps") };
        assert_eq!((rest.movement, &rest.end), (Move::Static, &start));
        assert_eq!((circle.movement, &circle.start), (Move::OrbitLeft, &Framing::default()));
    }

    #[test]
    fn it_is_circled_before_the_way_ends_elsewhere() {
        let steps = |text: &str| {
            let steps = vec![about(Move::Follow, &[5], [0, 8]), about(Move::OrbitRight, &[7], [0, text.len()])];
            let mut direction = direction(steps);
            end_behind_circles(&linked(text), &mut direction);
            direction.program.steps.into_iter().map(|step| (step.movement, step.end.subjects)).collect::<Vec<_>>()
        };
        let three = vec![(Move::Follow, vec![5]), (Move::OrbitRight, vec![5]), (Move::Follow, vec![7])];
        assert_eq!(steps("up to <obj-0> , circle it once and land in front of <obj-1>"), three);
        assert_eq!(steps("up to <obj-0> , circle <obj-1> and end there").len(), 2);
        let looks = steps("up to <obj-0> , circle it once and come to rest looking at <obj-1>");
        assert_eq!(looks.last(), Some(&(Move::PanRight, vec![7])));
        let up = steps("once round <obj-0> and end looking up to <obj-1>");
        assert_eq!(up[1..], [(Move::OrbitRight, vec![5]), (Move::TiltUp, vec![7])]);
    }
}

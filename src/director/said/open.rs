//! Directions that follow from other words, or from none: ways back, and directions that the prompt leaves open.

use cinesplat_language::{Linked, Senses};
use cinesplat_operator::{Amount, Framing, Step};
use cinesplat_trajectory::Move;

use super::directions::CORRECTIONS;
use crate::error::DirectorError;

/// Words that may name a direction, besides those of the senses `left` and `right`. (Some phrases with `right` have
/// another sense: `right round`.)
const DIRECTION_WORDS: [&str; 17] = [
    "clock",
    "clockwise",
    "oclock",
    "cw",
    "ccw",
    "l",
    "r",
    "lft",
    "rgt",
    "rt",
    "rite",
    "minus",
    "plus",
    "x",
    "y",
    "ltr",
    "rtl",
];

/// Marks the direction of sideways moves as open where the prompt names none. A step that depends on another one (a
/// return, a second orbit) keeps the direction that the network read. `senses` has one entry per word.
///
/// # Errors
/// [`DirectorError::Language`] for a damaged list of senses.
pub(crate) fn open_unstated_directions(
    linked: &Linked,
    senses: &[Senses],
    steps: &mut [Step],
) -> Result<(), DirectorError> {
    let sideways = Senses::named(&["left", "right"])?;
    let mut words = linked.tokens_text.split(' ');
    if words.any(may_say_direction) || senses.iter().any(|senses| senses.overlaps(sideways)) {
        return Ok(());
    }
    let moves: Vec<Move> = steps.iter().map(|step| step.movement).collect();
    let of_family =
        |movement: Move| moves.iter().filter(|other| **other == movement || other.opposite() == Some(movement)).count();
    for step in steps.iter_mut().filter(|step| is_sideways(step.movement) && of_family(step.movement) == 1) {
        step.either_way |= !step.returns;
    }
    Ok(())
}

fn may_say_direction(word: &str) -> bool {
    word.starts_with("left")
        || word.starts_with("right")
        || DIRECTION_WORDS.contains(&word)
        // Arrows.
        || word.chars().any(|letter| !letter.is_ascii() && !letter.is_alphanumeric())
}

/// Words of a step that retraces the step before.
const RETRACES: [&str; 13] = [
    "retrace",
    "retraces",
    "retracing",
    "reverse",
    "reverses",
    "reversing",
    "return",
    "returns",
    "undo",
    "rewind",
    "rewinds",
    "rewinding",
    "backtrack",
];
/// Words behind `reverse` or `return` that make it another thing: `the reverse side`, `until it returns to view`.
const OTHER_THINGS: [&str; 6] = ["side", "angle", "shot", "view", "frame", "sight"];

/// Reverses a step that retraces the move before, which the network may read as the same move again: `orbit 30 degrees to
/// the left, then retrace it`.
pub(crate) fn reverse_retraced(linked: &Linked, steps: &mut [Step]) {
    for nth in 1..steps.len() {
        if !steps[nth].words.is_some_and(|words| says_retrace(linked, words)) {
            continue;
        }
        let moving = |step: &Step| step.movement != Move::Static;
        let Some(there) = steps[..nth].iter().rposition(moving) else { continue };
        let (movement, amount) = (steps[there].movement, steps[there].amount);
        // What goes back to the start of the film takes the way on which it came.
        let words = linked.texts_in(steps[nth].words.unwrap_or_default());
        let goes_back = steps[nth].returns
            && words.iter().any(|word| RETRACES.contains(word) && !word.starts_with("return"))
            && steps[..nth].iter().filter(|step| moving(step)).count() == 1
            && matches!(
                steps[nth].movement,
                Move::Follow | Move::PullOut | Move::TruckLeft | Move::TruckRight | Move::PushIn
            );
        let is_again =
            (goes_back || as_orbit(movement) == as_orbit(steps[nth].movement)) && returns_on_itself(movement);
        let is_approach = nears(movement) && nears(steps[nth].movement);
        let Some(back) = movement.opposite().filter(|_| is_again || is_approach) else { continue };
        // A film that has moved nowhere else ends where it began, whichever way it went.
        let is_open = steps[there].either_way && !steps[..there].iter().any(moving);
        if goes_back && steps[nth].end.subjects.is_empty() {
            let circled = steps[there].end.subjects.clone();
            steps[nth].end.subjects = circled;
        }
        steps[there].either_way = is_open;
        let with = steps[there].with.clone();
        let [source, goal] = [&steps[there].start, &steps[there].end].map(|framing| framing.subjects.clone());
        let about = |ids: &[u32]| Framing { subjects: ids.to_vec(), ..Framing::default() };
        let step = &mut steps[nth];
        // Who rose on the way out sinks on the way back.
        let sinks = |second: &Move| with.contains(second).then(|| second.opposite()).flatten();
        step.with = step.with.iter().map(|second| sinks(second).unwrap_or(*second)).collect();
        step.either_way = is_open;
        step.returns |= is_open || is_approach && there == 0;
        step.movement = if is_open { movement } else { back };
        step.amount = step.amount.or(amount);
        // What it began with is what it comes back to.
        if !source.is_empty() && step.end == about(&goal) {
            step.end = about(&source);
        }
    }
}

/// Whether a step is a move of a family, or the other way.
fn is_of(family: Move, step: &Step) -> bool {
    let own = as_orbit(step.movement);
    own == family || own.opposite() == Some(family)
}

/// Leaves the way back open where the way there is: `slide from one to the other, and slide back to where we began`.
pub(crate) fn come_back_either_way(steps: &mut [Step]) {
    for nth in 1..steps.len() {
        let family = as_orbit(steps[nth].movement);
        let is_open = steps[..nth].iter().any(|step| step.either_way && is_of(family, step));
        steps[nth].either_way |= steps[nth].returns && is_sideways(family) && is_open;
    }
}

/// Turns a circle, a slide or a pan around whose words go the other way than the last one did: `it keeps circling the chair, then it
/// stalls, then it goes round the other way`.
pub(crate) fn go_other_way(linked: &Linked, steps: &mut [Step]) {
    for nth in 1..steps.len() {
        let words = linked.texts_in(steps[nth].words.unwrap_or_default());
        let says = words
            .windows(2)
            .any(|pair| matches!(pair[0], "other" | "opposite") && matches!(pair[1], "way" | "direction" | "sense"));
        let family = as_orbit(steps[nth].movement);
        let Some(there) = steps[..nth].iter().rposition(|step| is_of(family, step)) else { continue };
        let Some(back) = steps[there].movement.opposite() else { continue };
        if says && is_sideways(steps[nth].movement) && !steps[nth].returns {
            steps[there].either_way = false;
            (steps[nth].movement, steps[nth].either_way) = (back, false);
        }
    }
}

/// Makes a part of a circle of a factor: `go round the teapot like half way`.
pub(crate) fn turn_by_parts(linked: &Linked, steps: &mut [Step]) {
    for step in steps {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let is_around = words.iter().any(|word| matches!(*word, "around" | "round" | "about"));
        let nears = words.iter().any(|word| matches!(*word, "closer" | "distance" | "close" | "radius" | "nearer"));
        let circles = step.movement.is_circular();
        if let Some(Amount::Factor(factor)) = step.amount.filter(|_| circles && is_around && !nears)
            && factor < 1.0
        {
            step.amount = Some(Amount::Degrees(360.0 * factor));
        }
    }
}

/// Words of what is as it was at first, and of what that is.
const FIRSTS: [&str; 5] = ["initial", "original", "starting", "opening", "first"];
const STATES: [&str; 19] = [
    "focal",
    "lens",
    "frame",
    "framing",
    "pose",
    "position",
    "view",
    "viewpoint",
    "height",
    "size",
    "composition",
    "spot",
    "place",
    "point",
    "zoom",
    "setting",
    "shot",
    "picture",
    "distance",
];

/// Ends a step where the film began where its words say so: `zoom back out to the initial focal length`.
pub(crate) fn return_to_first(linked: &Linked, steps: &mut [Step]) {
    for step in steps.iter_mut().skip(1).filter(|step| !step.returns && !step.cut) {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let is_back = words.windows(3).any(|three| {
            matches!(three[0], "the" | "its" | "our" | "to") && FIRSTS.contains(&three[1]) && STATES.contains(&three[2])
        });
        let leads = words.iter().any(|word| matches!(*word, "back" | "return" | "returns" | "returning"));
        step.returns |= is_back && leads && step.movement != Move::Static;
    }
}

fn says_retrace(linked: &Linked, bytes: [usize; 2]) -> bool {
    let words = linked.texts_in(bytes);
    let says_otherwise = |word: &&str| {
        CORRECTIONS.contains(word) || may_say_direction(word) || matches!(*word, "up" | "down" | "in" | "out")
    };
    let retraces = |at: usize| {
        RETRACES.contains(&words[at]) && !words[at + 1..].iter().take(2).any(|word| OTHER_THINGS.contains(word))
    };
    // `From shelf A to shelf B and back again`.
    let is_bare = words.contains(&"back") && words.iter().all(|word| BARE_BACK.contains(word));
    is_bare || !words.iter().any(says_otherwise) && (0..words.len()).any(retraces)
}

/// All the words of a step that only goes back.
const BARE_BACK: [&str; 8] = ["and", "then", "back", "again", "once", "more", ",", "."];

/// A move with an arc as an orbit: both are circles about a subject.
pub(crate) fn as_orbit(movement: Move) -> Move {
    match movement {
        Move::ArcLeft => Move::OrbitLeft,
        Move::ArcRight => Move::OrbitRight,
        other => other,
    }
}

/// Whether a move brings a subject closer or takes it away, by the camera's way or by its lens.
fn nears(movement: Move) -> bool {
    matches!(
        movement,
        Move::PushIn | Move::PullOut | Move::ZoomIn | Move::ZoomOut | Move::DollyZoomIn | Move::DollyZoomOut
    )
}

/// Whether the opposite move, from where the move ends, leads back to where it began.
fn returns_on_itself(movement: Move) -> bool {
    let is_straight = matches!(
        movement,
        Move::TiltUp
            | Move::TiltDown
            | Move::PedestalUp
            | Move::PedestalDown
            | Move::CraneUp
            | Move::CraneDown
            | Move::ZoomIn
            | Move::ZoomOut
    );
    is_straight || is_sideways(movement)
}

fn is_sideways(movement: Move) -> bool {
    matches!(
        movement,
        Move::PanLeft
            | Move::PanRight
            | Move::RollCw
            | Move::RollCcw
            | Move::TruckLeft
            | Move::TruckRight
            | Move::OrbitLeft
            | Move::OrbitRight
            | Move::ArcLeft
            | Move::ArcRight
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::said::fixture::{about, linked};

    #[test]
    fn a_circle_goes_the_other_way_than_the_one_before() {
        let text = "circle <obj-0> , then round the other way";
        let mut steps = [
            Step { either_way: true, ..about(Move::OrbitLeft, &[5], [0, 14]) },
            Step { either_way: true, ..about(Move::OrbitLeft, &[5], [17, text.len()]) },
        ];
        go_other_way(&linked(text), &mut steps);
        assert_eq!(
            steps.map(|step| (step.movement, step.either_way)),
            [(Move::OrbitLeft, false), (Move::OrbitRight, false)]
        );
    }

    #[test]
    fn a_way_back_is_as_open_as_the_way_there() {
        let there = Step { either_way: true, ..about(Move::TruckRight, &[7], [0, 9]) };
        let back = Step { returns: true, ..about(Move::TruckRight, &[5], [9, 20]) };
        let mut steps = [there, back];
        come_back_either_way(&mut steps);
        assert!(steps[1].either_way);
    }

    #[test]
    fn what_goes_back_comes_to_what_it_began_with() {
        let text = "pan right from <obj-0> to <obj-1> and back again";
        let at = text.find(" and").unwrap();
        let first = Step { start: about(Move::Static, &[5], [0, 1]).end, ..about(Move::PanRight, &[7], [0, at]) };
        let mut steps = [first, about(Move::PanRight, &[7], [at + 1, text.len()])];
        reverse_retraced(&linked(text), &mut steps);
        assert_eq!((steps[1].movement, &steps[1].end.subjects[..]), (Move::PanLeft, &[5][..]));
        let text = "zoom in on <obj-0> , then reverse it";
        let mut steps = [about(Move::ZoomIn, &[5], [0, 18]), about(Move::DollyZoomIn, &[5], [21, text.len()])];
        reverse_retraced(&linked(text), &mut steps);
        assert_eq!((steps[1].movement, steps[1].returns), (Move::ZoomOut, true));
    }
}

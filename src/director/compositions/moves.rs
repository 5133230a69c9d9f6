//! The move that leads from one described picture to another, and words that name one.

use cinesplat_language::Linked;
use cinesplat_operator::{FramePlace, Framing, Lens, Motion, Step};
use cinesplat_trajectory::Move;

use crate::said::is_form;

/// Verbs and nouns of moves.
const MOVES: [&str; 58] = [
    "push",
    "pull",
    "pan",
    "tilt",
    "truck",
    "zoom",
    "orbit",
    "arc",
    "dolly",
    "crane",
    "pedestal",
    "whip",
    "circle",
    "roll",
    "jib",
    "boom",
    "crab",
    "track",
    "slide",
    "glide",
    "drift",
    "fly",
    "go",
    "rise",
    "sink",
    "descend",
    "ascend",
    "lower",
    "raise",
    "rotate",
    "spin",
    "swing",
    "swoop",
    "sweep",
    "approach",
    "retreat",
    "follow",
    "walk",
    "reveal",
    "turn",
    "yaw",
    "climb",
    "lift",
    "drop",
    "come",
    "step",
    "creep",
    "retrace",
    "pass",
    "carry",
    "hover",
    "float",
    "sail",
    "dive",
    "leave",
    "enter",
    "cross",
    "translate",
];
/// Words that rule a motion out, and how far they reach.
const BANS: [&str; 9] = ["no", "not", "without", "never", "zero", "don", "dont", "nor", "any"];
const BAN_REACH: usize = 5;

/// Whether a word names a move.
pub(super) fn is_move_word(word: &str) -> bool {
    MOVES.iter().any(|verb| is_form(word, verb))
}

/// Whether the words ask for a move, and do not only rule some out.
pub(super) fn names_move(linked: &Linked) -> bool {
    let words: Vec<&str> = linked.tokens_text.split(' ').collect();
    let is_banned = |at: usize| {
        let before = words[..at].iter().rev().take(BAN_REACH).take_while(|word| !matches!(**word, "." | ";" | ":"));
        before.into_iter().any(|word| BANS.contains(word))
    };
    let leads = |at: usize| {
        let next = words[at + 1..].iter().take(2);
        next.into_iter().any(|word| matches!(*word, "in" | "close" | "closer" | "near" | "nearer" | "away" | "back"))
    };
    // `The slider moves to the right`.
    let goes = |at: usize| {
        let next = words[at + 1..].iter().take(3);
        next.into_iter().any(|word| matches!(*word, "left" | "right" | "up" | "down" | "forward" | "backward"))
    };
    let names = |at: usize| match words[at] {
        // `the lower third`, `the back wall`.
        "lower" => false,
        "back" => matches!(words.get(at + 1), Some(&("away" | "off" | "up" | "out"))),
        // `Get in close on the vase`.
        "get" | "come" | "go" | "move" if leads(at) => true,
        word if is_form(word, "move") => goes(at),
        word => is_move_word(word),
    };
    (0..words.len()).any(|at| names(at) && !is_banned(at))
}

/// Whether there is a word besides marks and numbers.
pub(super) fn has_words(linked: &Linked) -> bool {
    linked.tokens_text.split(' ').any(|word| word.starts_with(char::is_alphabetic))
}

/// The move from one picture to another, and whether its direction is open.
pub(crate) fn leading_move(start: &Framing, end: &Framing, forbidden: &[Motion]) -> (Move, bool) {
    let forbids = |motions: &[Motion]| motions.iter().any(|motion| forbidden.contains(motion));
    let stays = forbids(&[Motion::Travel]);
    let pair = |of: &dyn Fn(&Framing) -> Option<f64>| of(start).zip(of(end)).filter(|(a, b)| (a - b).abs() > 1e-9);
    let nears = growth(start, end);
    if let Some((from, to)) = pair(&|framing| framing.lens.and_then(focal)) {
        return (if to > from { Move::ZoomIn } else { Move::ZoomOut }, false);
    }
    let same = start.subjects.first() == end.subjects.first() || start.subjects.is_empty() || end.subjects.is_empty();
    if !same {
        let shifts = forbids(&[Motion::Turn, Motion::Pan]) && !stays;
        return (if shifts { Move::TruckRight } else { Move::PanRight }, true);
    }
    if let Some((from, to)) = pair(&|framing| framing.elevation_deg) {
        return (if to > from { Move::CraneUp } else { Move::CraneDown }, false);
    }
    if let Some(nears) = nears {
        let movement = match (nears, stays) {
            (true, false) => Move::PushIn,
            (false, false) => Move::PullOut,
            (true, true) => Move::ZoomIn,
            (false, true) => Move::ZoomOut,
        };
        return (movement, false);
    }
    if let Some((from, to)) = pair(&|framing| framing.height) {
        return (if to > from { Move::PedestalUp } else { Move::PedestalDown }, false);
    }
    if let Some(movement) = turn_between(start.place, end.place) {
        let slides = forbids(&[Motion::Turn, Motion::Pan]) && !stays;
        return (if slides { slide_of(movement) } else { movement }, false);
    }
    if end.hidden != start.hidden {
        return (Move::PanRight, true);
    }
    (Move::Static, false)
}

/// Whether the subject grows, where it changes its size.
fn growth(start: &Framing, end: &Framing) -> Option<bool> {
    let by_height = start.height_frac.zip(end.height_frac).filter(|(a, b)| (a - b).abs() > 1e-3).map(|(a, b)| b > a);
    let by_distance = start.distance.zip(end.distance).filter(|(a, b)| (a - b).abs() > 1e-3).map(|(a, b)| b < a);
    // Sizes are listed from the closest to the widest.
    let by_size = start.size.zip(end.size).filter(|(a, b)| a != b).map(|(a, b)| b < a);
    by_height.or(by_distance).or(by_size)
}

/// The focal length of a lens over the height of the frame.
fn focal(lens: Lens) -> Option<f64> {
    match lens {
        Lens::FocalMm(mm) => Some(mm / 24.0),
        Lens::FovDeg(degrees) => Some(0.5 / (degrees.to_radians() / 2.0).tan()),
        Lens::Wide | Lens::Long => None,
    }
}

/// The turn that moves a subject from one place in the frame to another: the camera turns left where it goes right.
fn turn_between(start: Option<FramePlace>, end: Option<FramePlace>) -> Option<Move> {
    let ([x0, y0], [x1, y1]) = (steps_of(start?), steps_of(end?));
    match (x1 - x0, y1 - y0) {
        (0, 0) => None,
        (0, up) => Some(if up > 0 { Move::TiltDown } else { Move::TiltUp }),
        (right, _) => Some(if right > 0 { Move::PanLeft } else { Move::PanRight }),
    }
}

/// Thirds from the middle, to the right and up.
fn steps_of(place: FramePlace) -> [i32; 2] {
    match place {
        FramePlace::AtLeft => [-1, 0],
        FramePlace::AtRight => [1, 0],
        FramePlace::AtUpper => [0, 1],
        FramePlace::AtLower => [0, -1],
        FramePlace::AtUpperLeft => [-1, 1],
        FramePlace::AtUpperRight => [1, 1],
        FramePlace::AtLowerLeft => [-1, -1],
        FramePlace::AtLowerRight => [1, -1],
        FramePlace::AtCenter => [0, 0],
    }
}

fn slide_of(turn: Move) -> Move {
    match turn {
        Move::PanLeft => Move::TruckLeft,
        Move::PanRight => Move::TruckRight,
        Move::TiltUp => Move::PedestalUp,
        Move::TiltDown => Move::PedestalDown,
        other => other,
    }
}

/// Gives a turn between two places of one subject the direction that leads from one to the other.
pub(super) fn turns_towards(steps: &mut [Step]) {
    for step in steps {
        let same = !step.start.subjects.is_empty() && step.start.subjects == step.end.subjects;
        let Some(turn) = turn_between(step.start.place, step.end.place).filter(|_| same) else { continue };
        for wanted in [turn, slide_of(turn)] {
            if step.movement == wanted || step.movement.opposite() == Some(wanted) {
                (step.movement, step.either_way) = (wanted, false);
            }
        }
    }
}

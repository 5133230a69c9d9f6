//! What the words before a number speak of: turning, lenses, the picture.

use super::context::{after_hedges, back};
use crate::tokenizer::Word;

/// Verbs of turning.
pub(super) const TURNING: [&str; 60] = [
    "pan",
    "pans",
    "panning",
    "tilt",
    "tilts",
    "tilting",
    "tilted",
    "roll",
    "rolls",
    "rolling",
    "rolled",
    "rotate",
    "rotates",
    "rotating",
    "rotation",
    "turn",
    "turns",
    "turning",
    "turned",
    "spin",
    "spins",
    "spinning",
    "swing",
    "swings",
    "swinging",
    "orbit",
    "orbits",
    "orbiting",
    "arc",
    "arcs",
    "arcing",
    "yaw",
    "yaws",
    "yawing",
    "pitch",
    "twist",
    "twists",
    "twisting",
    "twirl",
    "circle",
    "circles",
    "circling",
    "swivel",
    "swivels",
    "whip",
    "whips",
    "whirl",
    "revolve",
    "revolves",
    "revolving",
    "dutch",
    "canted",
    "bank",
    "flick",
    "sweep",
    "poi",
    "gimbal",
    "look",
    "looks",
    "go",
];
/// Words between a verb of turning and its angle.
const DIRECTIONS: [&str; 30] = [
    "left",
    "right",
    "up",
    "down",
    "by",
    "minus",
    "another",
    "it",
    "cw",
    "ccw",
    "clockwise",
    "counter",
    "counterclockwise",
    "anticlockwise",
    "anti",
    "around",
    "round",
    "over",
    "back",
    "the",
    "camera",
    "cam",
    "horizon",
    "slowly",
    "quickly",
    "full",
    "hard",
    "l",
    "r",
    "a",
];

/// Whether a clause before word `i` speaks of turning, with only directions in between.
pub(super) fn turns_before(words: &[Word], i: usize) -> bool {
    let start = after_hedges(words, i);
    let mut rest = back(words, start, 5).skip_while(|word| DIRECTIONS.contains(word));
    rest.next().is_some_and(|word| TURNING.contains(&word))
}

/// Whether the words near word `i` speak of lenses.
pub(super) fn is_about_lenses(words: &[Word], i: usize) -> bool {
    let is_lens = |word: &str| {
        word.starts_with("zoom")
            || word.starts_with("compress")
            || word.starts_with("lens")
            || matches!(
                word,
                "focal"
                    | "prime"
                    | "tele"
                    | "telephoto"
                    | "tighten"
                    | "tightening"
                    | "widen"
                    | "widening"
                    | "mm"
                    | "portrait"
                    | "glass"
            )
    };
    back(words, i, 14).any(is_lens)
}

/// Whether the word is a picture as a whole.
pub(super) fn is_picture(word: &str) -> bool {
    matches!(word, "frame" | "picture" | "image" | "screen" | "view" | "viewport" | "pic" | "photo" | "framing")
}

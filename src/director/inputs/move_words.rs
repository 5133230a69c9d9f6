//! Words that name a camera move in every context.

const STEMS: [&str; 18] = [
    "push", "pull", "pan", "tilt", "truck", "zoom", "orbit", "arc", "dolly", "dollie", "crane", "pedestal", "whip",
    "circl", "hold", "paus", "roll", "jib",
];
const ENDINGS: [&str; 14] = ["", "s", "es", "ing", "ning", "e", "y", "ies", "ying", "ed", "ned", "ped", "ping", "bing"];

/// Whether a lower-case word names a camera move in every context.
pub(super) fn names_move(word: &str) -> bool {
    STEMS.iter().any(|stem| word.strip_prefix(stem).is_some_and(|ending| ENDINGS.contains(&ending)))
}

//! Sentences about things, not about pictures of them: `This guitar is a ten out of ten! Slow pan up from the body ..`.

use cinesplat_language::Linked;
use cinesplat_operator::{Framing, Step};
use cinesplat_trajectory::Move;

use crate::direction::Direction;

/// Verbs that say what a thing is.
const COPULAS: [&str; 8] = ["is", "'s", "are", "was", "were", "looks", "'re", "feels"];
/// Words of pictures and cameras.
const PICTURES: [&str; 43] = [
    "see",
    "show",
    "shown",
    "look",
    "looking",
    "watch",
    "frame",
    "framed",
    "framing",
    "shot",
    "view",
    "picture",
    "image",
    "camera",
    "lens",
    "visible",
    "seen",
    "centered",
    "centred",
    "center",
    "centre",
    "start",
    "begin",
    "end",
    "open",
    "close",
    "hold",
    "still",
    "static",
    "left",
    "right",
    "middle",
    "third",
    "first",
    "last",
    "top",
    "subject",
    "focus",
    "where",
    "screen",
    "foreground",
    "background",
    "there",
];
/// Marks that end a sentence.
const ENDS: [&str; 4] = [".", "!", "?", ";"];

/// Removes pictures at rest that only come from a sentence about what a thing is, where another step follows.
pub(crate) fn drop_statements(linked: &Linked, direction: &mut Direction) {
    for nth in (0..direction.program.steps.len()).rev() {
        let steps = &direction.program.steps;
        let is_followed = nth + 1 < steps.len();
        if is_followed && is_plain(&steps[nth]) && is_statement(&linked.texts_in(steps[nth].words.unwrap_or_default()))
        {
            direction.remove_step(nth);
        }
    }
}

/// Whether a step rests on a thing and says no more.
fn is_plain(step: &Step) -> bool {
    let shown = Framing { subjects: step.end.subjects.clone(), ..Framing::default() };
    let begun = Framing { subjects: step.start.subjects.clone(), ..Framing::default() };
    step.movement == Move::Static
        && step.end == shown
        && step.start == begun
        && step.with.is_empty()
        && step.via.is_none()
        && step.duration_secs.is_none()
}

/// Whether words are whole sentences that say what something is, and nothing of a picture.
fn is_statement(words: &[&str]) -> bool {
    words.last().is_some_and(|word| ENDS.contains(word))
        && words.iter().any(|word| COPULAS.contains(word))
        && !words.iter().any(|word| PICTURES.contains(word))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_thing_is_is_no_picture() {
        let states = |text: &str| is_statement(&text.split(' ').collect::<Vec<_>>());
        assert!(states("this <obj-0> is a 10 out of 10 !"));
        assert!(states("<obj-0> is the heart of this home !"));
        assert!(!states("<obj-0> is in the center of the frame ."));
        assert!(!states("<obj-0> is what we see first ."));
        assert!(!states("<obj-0> is big , then"));
    }
}

//! Which way the camera goes in a dolly zoom: `pull away while the chair keeps its size`.
//!
//! The network knows a dolly zoom by its names and effects, but sometimes not the way of the camera beside them.

use cinesplat_language::Linked;
use cinesplat_operator::Step;
use cinesplat_trajectory::Move;

use super::directions::{CORRECTIONS, is_form, own_words};

/// Verbs of a camera, or of those who carry it.
const TRAVELS: [&str; 16] = [
    "dolly", "track", "move", "go", "travel", "come", "push", "pull", "step", "back", "rush", "reverse", "slide",
    "glide", "walk", "roll",
];
const BACK: [&str; 6] = ["back", "backward", "backwards", "away", "out", "rearward"];
const FORWARD: [&str; 9] = ["in", "into", "forward", "forwards", "toward", "towards", "closer", "nearer", "inward"];
/// Verbs that say the way by themselves: `with the camera retreating`.
const RETREATS: [&str; 4] = ["retreat", "withdraw", "recede", "reverse"];
const ADVANCES: [&str; 2] = ["advance", "approach"];
/// What goes the other way in a dolly zoom.
const OTHERS: [&str; 14] = [
    "background",
    "backdrop",
    "surroundings",
    "room",
    "wall",
    "walls",
    "world",
    "scene",
    "everything",
    "lens",
    "zoom",
    "focal",
    "behind",
    "perspective",
];
/// Words between a verb and what goes.
const NUM_BEFORE: usize = 3;

/// Gives dolly zooms the way that the words of their steps say, where they say one. Words that several steps share say
/// nothing about one step.
pub(crate) fn take_said_dolly_zooms(linked: &Linked, steps: &mut [Step]) {
    for nth in 0..steps.len() {
        let Some(span) = own_words(steps, nth) else { continue };
        let words = linked.texts_in(span);
        let goes = |ways: &[&str], verbs: &[&str]| says_travel(&words, ways) || says_alone(&words, verbs);
        let said = match (goes(&BACK, &RETREATS), goes(&FORWARD, &ADVANCES)) {
            (true, false) => Move::DollyZoomOut,
            (false, true) => Move::DollyZoomIn,
            _ => continue,
        };
        if words.iter().any(|word| CORRECTIONS.contains(word)) {
            continue;
        }
        let is_said = |movement: Move| movement == said || movement.opposite() == Some(said);
        let step = &mut steps[nth];
        if is_said(step.movement) {
            step.movement = said;
            step.either_way = false;
        }
        step.with.iter_mut().filter(|movement| is_said(**movement)).for_each(|movement| *movement = said);
    }
}

/// Makes a dolly zoom a plain way where its words keep the lens and name no zoom: `dolly back on the same lens`.
pub(crate) fn keep_said_lens(linked: &Linked, steps: &mut [Step]) {
    for step in steps {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let keeps = words.windows(2).any(|pair| matches!(pair, ["same" | "fixed" | "constant" | "prime", "lens"]));
        let zooms = words.iter().any(|word| {
            is_form(word, "zoom") || matches!(*word, "vertigo" | "hitchcock" | "background" | "backdrop" | "size")
        });
        if keeps && !zooms {
            step.movement = match step.movement {
                Move::DollyZoomIn => Move::PushIn,
                Move::DollyZoomOut => Move::PullOut,
                movement => movement,
            };
        }
    }
}

/// Whether the camera does what one of the verbs says by itself.
fn says_alone(words: &[&str], verbs: &[&str]) -> bool {
    let is_others = |at: usize| words[at.saturating_sub(NUM_BEFORE)..at].iter().any(|word| OTHERS.contains(word));
    (0..words.len()).any(|at| verbs.iter().any(|verb| is_form(words[at], verb)) && !is_others(at))
}

/// Whether a verb of the camera is followed by one of the ways: `tracks slowly backwards`, `pulling away`, but not `the
/// background pulls away`.
fn says_travel(words: &[&str], ways: &[&str]) -> bool {
    // The zoom of a dolly zoom is the camera's.
    let is_other =
        |word: &str, at: usize| OTHERS.contains(&word) && !(word == "zoom" && at > 0 && words[at - 1] == "dolly");
    (0..words.len()).any(|at| {
        let behind = words.get(at + 1..).unwrap_or_default().iter().take(2);
        let before = &words[at.saturating_sub(NUM_BEFORE)..at];
        TRAVELS.iter().any(|verb| is_form(words[at], verb))
            && behind.into_iter().any(|word| ways.contains(word))
            && !before.iter().zip(at.saturating_sub(NUM_BEFORE)..).any(|(word, at)| is_other(word, at))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_camera_goes_and_not_the_background() {
        let says = |text: &str, ways: &[&str]| says_travel(&text.split(' ').collect::<Vec<_>>(), ways);
        assert!(says("track slowly backwards while the lens goes longer", &BACK));
        assert!(says("the vertigo thing but pulling away", &BACK));
        assert!(!says("rushing forward while the background pulls back", &BACK));
        assert!(says("rushing forward while the background pulls back", &FORWARD));
        assert!(!says("backing off while the lens goes in", &FORWARD));
        let alone = |text: &str| says_alone(&text.split(' ').collect::<Vec<_>>(), &RETREATS);
        assert!(alone("the vertigo effect with the camera retreating"));
        assert!(!alone("the vertigo effect with the background receding"));
    }
}

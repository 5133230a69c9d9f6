//! Which moves there are, whatever the network reads: a camera on a tripod does not shake, a person who only looks does
//! not walk, a spiral goes around.

use cinesplat_language::{LanguageError, Linked, Senses};
use cinesplat_operator::Step;
use cinesplat_trajectory::Move;

use super::senses::says;

/// Takes a shake away that the words do not say: `pan from the armchair to the television, tripod`. `senses` has one entry
/// per word.
///
/// # Errors
/// [`LanguageError::BadData`] for a damaged list of senses.
pub(crate) fn drop_unsaid_shake(linked: &Linked, senses: &[Senses], steps: &mut [Step]) -> Result<(), LanguageError> {
    let shake = Senses::named(&["shake"])?;
    for step in steps {
        if step.with.contains(&Move::Handheld) && !says(linked, senses, step, shake) {
            step.with.retain(|movement| *movement != Move::Handheld);
        }
    }
    Ok(())
}

/// What wanders while its owner stays.
const GAZES: [&str; 7] = ["gaze", "gazes", "glance", "glances", "eyes", "stare", "eye"];
/// Words after an eye that make it a height, and words before it that make it one of the camera's places.
const HEIGHTS: [&str; 5] = ["level", "height", "line", "contact", "high"];
/// Words by which the owner of a gaze goes somewhere, too.
const GOES: [&str; 8] = ["walk", "walks", "walking", "camera", "drone", "fly", "travel", "follow"];

/// Turns a way from one thing to another that only a gaze goes into a turn on the spot: `his gaze wanders from the wall
/// over to the chair`.
pub(crate) fn turn_gazes(linked: &Linked, steps: &mut [Step]) {
    for step in steps.iter_mut().filter(|step| step.movement == Move::Follow && step.via.is_none()) {
        let words: Vec<&str> = linked.words_in(step.words.unwrap_or_default()).map(|(word, _)| word).collect();
        let mut gazes = words.iter().enumerate().filter(|(_, word)| GAZES.contains(word));
        let is_gaze = gazes.any(|(at, _)| words.get(at + 1).is_none_or(|next| !HEIGHTS.contains(next)));
        let leads = !step.start.subjects.is_empty() && step.start.subjects != step.end.subjects;
        let goes = words.iter().any(|word| GOES.contains(word));
        if is_gaze && leads && !goes {
            (step.movement, step.either_way) = (Move::PanRight, true);
        }
    }
}

/// Words by which a camera stands still.
const STILL: [&str; 9] =
    ["frozen", "still", "static", "motionless", "locked", "fixed", "immobile", "unmoving", "stationary"];

/// Holds a slanted picture that stands still: `dutch-angle close-up of the skull, camera frozen`. The slant is an effect.
pub(crate) fn hold_slants(linked: &Linked, steps: &mut [Step]) {
    let rolls = |movement: &Move| matches!(movement, Move::RollCw | Move::RollCcw);
    for step in steps.iter_mut().filter(|step| rolls(&step.movement)) {
        let is_still = linked.words_in(step.words.unwrap_or_default()).any(|(word, _)| STILL.contains(&word));
        if is_still && step.with.iter().all(rolls) {
            (step.movement, step.either_way, step.amount) = (Move::Static, false, None);
            step.with.clear();
        }
    }
}

/// Lines that go around while they rise or sink.
const SPIRALS: [&str; 12] = [
    "spiral",
    "spirals",
    "spiraling",
    "spiralling",
    "corkscrew",
    "corkscrews",
    "corkscrewing",
    "helix",
    "helical",
    "coil",
    "coils",
    "coiling",
];

/// Makes a rise or a descent go around its subject where the words say so: `spirals down around it`.
pub(crate) fn circle_spirals(linked: &Linked, steps: &mut [Step]) {
    for step in steps.iter_mut().filter(|step| !step.end.subjects.is_empty()) {
        let lift = match step.movement {
            Move::CraneUp | Move::PedestalUp => Move::CraneUp,
            Move::CraneDown | Move::PedestalDown => Move::CraneDown,
            _ => continue,
        };
        let lifts = step.with.iter().all(|with| *with == step.movement || *with == lift);
        if lifts && linked.words_in(step.words.unwrap_or_default()).any(|(word, _)| SPIRALS.contains(&word)) {
            // A rise to a stated angle is a crane first, because an orbit keeps its angle.
            if step.end.angle.is_some() {
                (step.movement, step.with) = (lift, vec![Move::OrbitRight]);
            } else {
                (step.movement, step.either_way, step.with) = (Move::OrbitRight, true, vec![lift]);
            }
        }
    }
}

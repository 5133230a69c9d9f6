//! Films from straight above that rise: `overhead shot looking straight down at the table, rising slowly`.
//!
//! The network reads a way up to a view from above, or a look at each thing that is seen below. What is said before the way
//! is the picture that the film begins with.

use cinesplat_language::{Linked, is_listed};
use cinesplat_operator::{Framing, Step};
use cinesplat_trajectory::{Move, ShotAngle};

use super::directions::{is_form, says_any};
use crate::direction::Direction;

/// Words of a view from straight above.
const FROM_ABOVE: [&[&str]; 9] = [
    &["straight", "down"],
    &["directly", "down"],
    &["vertically", "down"],
    &["top", "shot"],
    &["top", "view"],
    &["overhead", "shot"],
    &["overhead", "view"],
    &["bird's-eye"],
    &["top-down"],
];
/// Verbs of a way up.
const RISES: [&str; 7] = ["rise", "raise", "climb", "lift", "ascend", "float", "go"];
/// Words that make what follows the end of a way.
const ENDS: &str = "end ends ending until till finish finishes finishing to into then";

/// Rises straight up above what the film looks down on from its beginning.
pub(crate) fn rise_from_above(linked: &Linked, direction: &mut Direction) {
    let steps = &direction.program.steps;
    if !says_overhead_rise(&linked.texts_in([0, usize::MAX])) || !steps.iter().all(is_look_or_rise) {
        return;
    }
    let Some(rise) = steps.iter().find(|step| rises(step)) else { return };
    let subjects = |step: &Step| [&step.start, &step.end].map(|framing| framing.subjects.clone());
    let Some(subjects) = steps.iter().flat_map(subjects).find(|subjects| !subjects.is_empty()) else { return };
    let start = Framing { subjects, angle: Some(ShotAngle::Overhead), ..Framing::default() };
    let end_subjects = start.subjects.clone();
    let one = Step {
        start,
        speed: rise.speed,
        duration_secs: rise.duration_secs,
        easing: rise.easing,
        words: direction.span(),
        end: Framing { subjects: end_subjects, ..Framing::default() },
        ..Step::of(Move::PullOut)
    };
    direction.replace_steps(vec![one]);
}

fn rises(step: &Step) -> bool {
    matches!(step.movement, Move::CraneUp | Move::PedestalUp)
}

fn is_look_or_rise(step: &Step) -> bool {
    let is_look = matches!(step.movement, Move::Static | Move::Follow | Move::PullOut | Move::TiltDown);
    (rises(step) || is_look) && step.via.is_none() && !step.cut
}

/// Whether words look straight down before they rise.
fn says_overhead_rise(words: &[&str]) -> bool {
    let is_rise = |at: usize| {
        let is_up = |verb: &str| verb != "go" && verb != "float" || words.get(at + 1) == Some(&"up");
        RISES.iter().any(|verb| is_form(words[at], verb) && is_up(verb))
    };
    let Some(rise) = (0..words.len()).find(|at| is_rise(*at)) else { return false };
    let ends = words[..rise].iter().any(|word| is_listed(ENDS, word));
    let is_above = says_any(&words[..rise], &FROM_ABOVE);
    // `Then rise to eye level`.
    let stays = !words[rise..].iter().any(|word| is_listed("level until till tilt pan orbit circle push", word));
    is_above && !ends && stays
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_view_from_above_comes_before_the_way_up() {
        let is_said = |text: &str| says_overhead_rise(&text.split(' ').collect::<Vec<&str>>());
        assert!(is_said("overhead shot looking straight down at <obj-0> with <obj-1> , rising slowly"));
        assert!(is_said("top shot : look straight down on <obj-0> with <obj-1> , and let the camera rise slowly"));
        assert!(!is_said("rise over <obj-0> and look straight down on it"));
        assert!(!is_said("start on <obj-0> , end on an overhead shot , rising slowly"));
        assert!(!is_said("overhead shot of <obj-0> , rising until the whole room is seen"));
    }
}

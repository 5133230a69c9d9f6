//! Films that are asked for as such and read as one picture at rest: `a little film for the invitation .. show the whole table and
//! then the wine glasses close`.
//!
//! Nobody who asks for a film wants a photo. It goes in on what the picture shows, from what else is named, or around all of it.

use cinesplat_language::{Linked, is_listed};
use cinesplat_operator::{Amount, Framing};
use cinesplat_trajectory::Move;

use super::briefs::{denied, pace};
use crate::direction::Direction;

/// Words of a film.
const FILMS: &str =
    "film films video clip spot teaser ad advert commercial campaign reel movie trailer movement movements";
/// Words of a picture that stays as it is.
const STILLS: &str =
    "static still photo photograph picture image hold locked tripod fixed poster thumbnail frozen motionless";
/// Words between which such a word is only the end of a film: `end on a still frame`.
const ENDS: &str = "end ends ending finish finishes finishing last final";
/// Fewest words of such a film.
const FEWEST_WORDS: usize = 12;
/// Most things that its first picture brings together.
const MOST_TOGETHER: usize = 5;

/// Moves a film that is read as one picture at rest.
pub(crate) fn move_still_films(linked: &Linked, direction: &mut Direction) {
    let words: Vec<&str> = linked.tokens_text.split(' ').collect();
    let [step] = &mut direction.program.steps[..] else { return };
    let is_still = step.movement == Move::Static
        && step.with.is_empty()
        && step.via.is_none()
        && step.duration_secs.is_none()
        && !step.end.subjects.is_empty();
    if !is_still || !asks_for_film(&words) {
        return;
    }
    let denied = denied(linked, &words);
    let mut others = linked.named_by(&words);
    others.retain(|id| !step.end.subjects.contains(id) && !denied.contains(id) && linked.missing(*id).is_none());
    step.speed = pace(&words);
    if others.len() > MOST_TOGETHER {
        others.clear();
    }
    step.start = Framing::default();
    if step.end.whole {
        step.end.subjects.extend(others);
        (step.movement, step.either_way, step.amount) = (Move::ArcRight, true, Some(Amount::Slight));
        return;
    }
    step.movement = Move::PushIn;
    if others.is_empty() {
        (step.either_way, step.amount) = (false, None);
    } else {
        step.start = Framing { subjects: others, whole: true, ..Framing::default() };
    }
}

/// Whether words ask for a film, and not for a picture at rest.
fn asks_for_film(words: &[&str]) -> bool {
    let is_denied = |at: usize| at > 0 && is_listed("no not without never", words[at - 1]);
    let is_film = (0..words.len()).any(|at| is_listed(FILMS, words[at]) && !is_denied(at));
    let is_end = |at: usize| words[..at].iter().rev().take(4).any(|word| is_listed(ENDS, word));
    let is_still = (0..words.len()).any(|at| is_listed(STILLS, words[at]) && !is_end(at));
    words.len() >= FEWEST_WORDS && is_film && !is_still
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_film_is_no_photo() {
        let asks = |text: &str| asks_for_film(&text.split(' ').collect::<Vec<&str>>());
        assert!(asks("a little film for the invitation , show <obj-0> and then <obj-1> close , so that people come"));
        assert!(asks("30 second spot : sell <obj-0> . elegant movement , end on a still frame for our logo"));
        assert!(!asks("a static film of <obj-0> with <obj-1> on the left and nothing else in the picture"));
        assert!(!asks("no movement at all please , just <obj-0> with <obj-1> behind it , that is all"));
    }
}

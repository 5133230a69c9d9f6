//! Moves that the network takes for rest, or for another one: `rings, tiny move left`, `close up going up`, `rack the view over
//! to the loaf by panning only`.

use cinesplat_language::Linked;
use cinesplat_operator::{Amount, Step};
use cinesplat_trajectory::Move;

use super::directions::{CORRECTIONS, PLACES, is_form, place_behind, says_any};

/// Verbs of a camera that goes somewhere, and words between them and where.
const GOES: [&str; 11] =
    ["move", "slide", "shift", "drift", "glide", "nudge", "inch", "travel", "go", "float", "creep"];
const BETWEEN: [&str; 9] = ["slowly", "gently", "a", "bit", "little", "slightly", "to", "the", "straight"];
/// Words of a small way.
const SMALL: [&str; 11] =
    ["tiny", "slight", "slightly", "small", "little", "smidge", "hair", "tad", "touch", "teeny", "whisker"];
/// Words of a turn that does not travel, and that nothing else is asked for.
const PANS: [&[&str]; 9] = [
    &["panning", "only"],
    &["pan", "only"],
    &["only", "pan"],
    &["only", "panning"],
    &["by", "panning"],
    &["just", "pan"],
    &["just", "panning"],
    &["purely", "panning"],
    &["pure", "pan"],
];

/// Moves what rests in the direction that its words say, where they say one.
pub(crate) fn move_rests(linked: &Linked, steps: &mut [Step]) {
    for nth in 0..steps.len() {
        let (before, rest) = steps.split_at_mut(nth);
        let Some(step) = rest.first_mut() else { continue };
        let is_shared = before.iter().any(|other| other.words == step.words);
        if step.movement != Move::Static || !step.with.is_empty() || step.returns || is_shared {
            continue;
        }
        let words = linked.texts_in(step.words.unwrap_or_default());
        if words.iter().any(|word| CORRECTIONS.contains(word)) {
            continue;
        }
        let ways: Vec<Move> = (0..words.len()).filter_map(|at| way_at(&words, at)).collect();
        let [way] = ways[..] else { continue };
        step.movement = way;
        if words.iter().any(|word| SMALL.contains(word)) {
            step.amount = step.amount.or(Some(Amount::Slight));
        }
    }
}

/// The way that a verb at word `at` leads.
fn way_at(words: &[&str], at: usize) -> Option<Move> {
    let is_verb = GOES.iter().any(|verb| is_form(words[at], verb));
    let place = place_behind(words, at, &BETWEEN);
    let next = words.get(place + 1).copied().unwrap_or_default();
    // `Going up` is a rise, `go up to the door` a way.
    let goes_on = next.starts_with(|c: char| c == '<' || c.is_alphabetic());
    let way = match words.get(place).copied()? {
        "left" if !PLACES.contains(&next) => Move::TruckLeft,
        "right" if !PLACES.contains(&next) => Move::TruckRight,
        "up" | "upward" | "upwards" if !goes_on => Move::PedestalUp,
        "down" | "downward" | "downwards" if !goes_on => Move::PedestalDown,
        _ => return None,
    };
    is_verb.then_some(way)
}

/// Turns on the spot where the words ask for nothing but a turn.
pub(crate) fn turn_only(linked: &Linked, steps: &mut [Step]) {
    for step in steps.iter_mut().filter(|step| matches!(step.movement, Move::RackFocus | Move::Follow)) {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let behind = linked.words_in([step.words.unwrap_or_default()[1], usize::MAX]).map(|(word, _)| word);
        let near: Vec<&str> = words.iter().copied().chain(behind.take(4)).collect();
        if says_any(&near, &PANS) {
            pan_as_said(step, &words);
            step.with.clear();
        }
    }
}

/// Makes a step a pan in the direction that its words say, or in any where they say none.
pub(super) fn pan_as_said(step: &mut Step, words: &[&str]) {
    let is_left = words.contains(&"left");
    step.either_way = !is_left && !words.contains(&"right");
    step.movement = if is_left { Move::PanLeft } else { Move::PanRight };
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_way_is_told_from_a_place() {
        let way = |text: &str| {
            let words: Vec<&str> = text.split(' ').collect();
            (0..words.len()).find_map(|at| way_at(&words, at))
        };
        assert_eq!(way("<obj-0> - really close , tiny move left ;"), Some(Move::TruckLeft));
        assert_eq!(way("<obj-0> close up going up"), Some(Move::PedestalUp));
        assert_eq!(way("drifting gently to the right"), Some(Move::TruckRight));
        assert_eq!(way("going up to <obj-0>"), None);
        assert_eq!(way("move to the left side of <obj-0>"), None);
        assert_eq!(way("hold , left of <obj-0>"), None);
    }
}

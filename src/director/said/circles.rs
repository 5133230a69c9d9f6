//! Turns all the way round: `spin all the way around on the spot`, `look right round the whole room`.

use cinesplat_language::Linked;
use cinesplat_operator::{Amount, Step};
use cinesplat_trajectory::Move;

/// Words of a turn back to where it began, one after the other.
const ALL_ROUND: [&[&str]; 10] = [
    &["all", "the", "way", "round"],
    &["all", "the", "way", "around"],
    &["the", "whole", "way", "round"],
    &["the", "whole", "way", "around"],
    &["right", "round", "the", "room"],
    &["right", "around", "the", "room"],
    &["all", "around", "the", "room"],
    &["all", "round", "the", "room"],
    &["around", "the", "whole", "room"],
    &["round", "the", "whole", "room"],
];

/// Words of a turn that does not come round.
const SHORT: [&str; 7] = ["not", "'t", "n't", "without", "almost", "nearly", "half"];

/// Gives a pan without a goal and without an angle a full turn, where its words lead all the way round.
pub(crate) fn turn_all_round(linked: &Linked, steps: &mut [Step]) {
    for step in steps {
        let turns = matches!(step.movement, Move::PanLeft | Move::PanRight) && step.end.subjects.is_empty();
        let is_open = !matches!(step.amount, Some(Amount::Degrees(_) | Amount::Factor(_)));
        let Some(span) = step.words.filter(|_| turns && is_open) else { continue };
        let words = linked.texts_in(span);
        let is_short = words.iter().any(|word| SHORT.contains(word));
        if !is_short && ALL_ROUND.iter().any(|said| words.windows(said.len()).any(|window| window == *said)) {
            step.amount = Some(Amount::Degrees(360.0));
        }
    }
}

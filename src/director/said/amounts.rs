//! Extents of moves stay with the words that state them: `low cam, slow push, 360 spin around the skull`.

use cinesplat_language::{Linked, QuantityKind};
use cinesplat_operator::{Amount, Step};

use super::directions::own_words;

/// Takes an extent from a step whose own words do not state it where those of another step of the same extent do.
pub(crate) fn leave_to_owner(linked: &Linked, steps: &mut [Step]) {
    let stated: Vec<bool> = (0..steps.len()).map(|nth| states_amount(linked, steps, nth)).collect();
    for nth in 0..steps.len() {
        let Some(amount) = steps[nth].amount.filter(|_| !stated[nth] && own_words(steps, nth).is_some()) else {
            continue;
        };
        let movement = steps[nth].movement;
        let is_owner = |(other, step): (usize, &Step)| {
            other != nth && stated[other] && step.amount == Some(amount) && step.movement != movement
        };
        if steps.iter().enumerate().any(is_owner) && !repeats(linked, &steps[nth]) {
            steps[nth].amount = None;
        }
    }
}

/// Words by which a step takes over the extent of another one.
const SAME: [&str; 9] = ["same", "again", "back", "each", "other", "both", "likewise", "reverse", "return"];

fn repeats(linked: &Linked, step: &Step) -> bool {
    step.returns || linked.words_in(step.words.unwrap_or_default()).any(|(word, _)| SAME.contains(&word))
}

/// Whether a step's words hold the quantity of its amount.
fn states_amount(linked: &Linked, steps: &[Step], nth: usize) -> bool {
    let wanted = match steps[nth].amount {
        Some(Amount::Degrees(value)) => (QuantityKind::Degrees, value),
        Some(Amount::Units(value)) => (QuantityKind::Units, value),
        _ => return false,
    };
    let is_wanted = |word: &str| {
        linked
            .quantity_at(word)
            .is_some_and(|quantity| quantity.kind == wanted.0 && (quantity.value - wanted.1).abs() < 1e-9)
    };
    linked.words_in(steps[nth].words.unwrap_or_default()).any(|(word, _)| is_wanted(word))
}

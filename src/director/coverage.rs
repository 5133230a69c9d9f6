//! What keys leave out of the words that they come from.

use super::codes::{AMOUNT_QUANTITY, Field, KeyCode, NEXT_SEGMENT, NEXT_STOP, PLACES};
use super::model::Prompt;

/// A step as its keys have it, in places.
struct StepUse {
    span: Option<[usize; 2]>,
    objects: Vec<usize>,
    quantities: Vec<usize>,
}

impl StepUse {
    fn spans(&self, token: usize) -> bool {
        self.span.is_some_and(|[first, last]| (first..=last).contains(&token))
    }
}

/// What keys pass over.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) struct LeftOut {
    /// Mentions of objects and quantities.
    pub(super) mentions: usize,
    /// Words for moves.
    pub(super) moves: usize,
}

/// What the keys pass over: mentions within the words of steps none of which uses them, mentions that no step uses at
/// all, words for moves (`is_move`, one a token) that are not among the words of a step. As long as the keys do not stop,
/// only words before the last step's can be told to have been passed over.
pub(super) fn left_out(prompt: &Prompt, is_move: &[bool], keys: &[KeyCode], film: Option<usize>) -> LeftOut {
    let steps = steps(keys);
    let stops = keys.last().is_some_and(|key| key.class(Field::Next) == NEXT_STOP);
    let passed = match steps.last().and_then(|step| step.span) {
        _ if stops => prompt.tokens.len(),
        Some([first, _]) => first,
        None => 0,
    };
    let mut left_out = LeftOut::default();
    for (token_idx, token) in prompt.tokens.iter().enumerate().take(passed) {
        let within: Vec<&StepUse> = steps.iter().filter(|step| step.spans(token_idx)).collect();
        let used = |uses: &dyn Fn(&StepUse) -> bool| match within.as_slice() {
            [] => !stops || steps.iter().any(uses),
            within => within.iter().any(|step| uses(step)),
        };
        let is_used = match (token.object, token.quantity) {
            (Some(place), _) => used(&|step| step.objects.contains(&place)),
            (_, Some(place)) => film == Some(place) || used(&|step| step.quantities.contains(&place)),
            _ => true,
        };
        left_out.mentions += usize::from(!is_used);
        left_out.moves += usize::from(stops && within.is_empty() && is_move.get(token_idx) == Some(&true));
    }
    left_out
}

/// Whether a word tells of a move whatever stands around it.
pub(super) fn tells_of_move(word: &str) -> bool {
    const STEMS: [&str; 18] = [
        "push", "pull", "pan", "tilt", "truck", "zoom", "orbit", "arc", "dolly", "dollie", "crane", "pedestal", "whip",
        "circl", "hold", "paus", "roll", "jib",
    ];
    const ENDINGS: [&str; 14] =
        ["", "s", "es", "ing", "ning", "e", "y", "ies", "ying", "ed", "ned", "ped", "ping", "bing"];
    STEMS.iter().any(|stem| word.strip_prefix(stem).is_some_and(|ending| ENDINGS.contains(&ending)))
}

fn steps(keys: &[KeyCode]) -> Vec<StepUse> {
    let is_step = |(_, key): &(usize, &KeyCode)| key.class(Field::Next) == NEXT_SEGMENT;
    keys.iter().enumerate().filter(is_step).map(|(idx, key)| step(key, keys.get(idx + 1))).collect()
}

fn step(key: &KeyCode, end: Option<&KeyCode>) -> StepUse {
    let place = |pointer: &Option<u8>| pointer.and_then(|place| usize::from(place).checked_sub(1));
    let arrived = end.map_or(&[][..], |end| &end.objects[..PLACES]);
    let amount = key.quantities[0].filter(|_| key.class(Field::Amount) == AMOUNT_QUANTITY);
    StepUse {
        span: key.span,
        objects: key.objects[PLACES..].iter().chain(arrived).filter_map(place).collect(),
        quantities: [amount, key.quantities[1]].iter().filter_map(place).collect(),
    }
}

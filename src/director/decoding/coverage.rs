//! Coverage of the text by keys: mentions and move words that no step uses.

use strum::VariantArray;

use crate::codes::{Field, KeyCode, MAX_SUBJECTS, NEXT_SEGMENT, NEXT_STOP, QuantityRole};
use crate::inputs::Prompt;

/// The parts of the text that one step uses.
struct StepCoverage {
    /// First and last token.
    span: Option<[usize; 2]>,
    /// Indices of objects.
    objects: Vec<usize>,
    /// Indices of quantities.
    quantities: Vec<usize>,
}

impl StepCoverage {
    fn spans(&self, token: usize) -> bool {
        self.span.is_some_and(|[first, last]| (first..=last).contains(&token))
    }
}

/// Numbers of omissions.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) struct Omissions {
    /// Mentions of objects and quantities.
    pub(super) mentions: usize,
    /// Words that name a move.
    pub(super) moves: usize,
}

/// Omissions of keys. A mention inside the spans of steps is omitted when none of these steps uses it. A mention outside
/// all spans is omitted when no step uses it. A move word (`is_move`, per token) is omitted when it is in no span.
/// Before the keys stop, a later step may still use what follows, so only tokens before the span of the last step count,
/// and of these only mentions inside spans.
pub(super) fn omissions(prompt: &Prompt, is_move: &[bool], keys: &[KeyCode], film_length: Option<usize>) -> Omissions {
    let steps = steps(keys);
    let stops = keys.last().is_some_and(|key| key.class(Field::Next) == NEXT_STOP);
    let passed = match steps.last().and_then(|step| step.span) {
        _ if stops => prompt.tokens.len(),
        Some([first, _]) => first,
        None => 0,
    };
    let mut omissions = Omissions::default();
    for (token_idx, token) in prompt.tokens.iter().enumerate().take(passed) {
        let within: Vec<&StepCoverage> = steps.iter().filter(|step| step.spans(token_idx)).collect();
        let used = |uses: &dyn Fn(&StepCoverage) -> bool| match within.as_slice() {
            [] => !stops || steps.iter().any(uses),
            within => within.iter().any(|step| uses(step)),
        };
        let is_used = match (token.object, token.quantity) {
            (Some(idx), _) => used(&|step| step.objects.contains(&idx)),
            (_, Some(idx)) => film_length == Some(idx) || used(&|step| step.quantities.contains(&idx)),
            _ => true,
        };
        omissions.mentions += usize::from(!is_used);
        omissions.moves += usize::from(stops && within.is_empty() && is_move.get(token_idx) == Some(&true));
    }
    omissions
}

fn steps(keys: &[KeyCode]) -> Vec<StepCoverage> {
    let is_step = |(_, key): &(usize, &KeyCode)| key.class(Field::Next) == NEXT_SEGMENT;
    keys.iter().enumerate().filter(is_step).map(|(idx, key)| step(key, keys.get(idx + 1))).collect()
}

fn step(key: &KeyCode, end: Option<&KeyCode>) -> StepCoverage {
    let idx = |pointer: &Option<u8>| pointer.and_then(|pointer| usize::from(pointer).checked_sub(1));
    let arrived = end.map_or(&[][..], |end| &end.objects[..MAX_SUBJECTS]);
    let of_start =
        QuantityRole::VARIANTS.iter().filter(|role| !role.is_arrival()).filter_map(|role| key.quantity(*role));
    let of_end = end.into_iter().flat_map(|end| {
        QuantityRole::VARIANTS.iter().filter(|role| role.is_arrival()).filter_map(|role| end.quantity(*role))
    });
    StepCoverage {
        span: key.span,
        objects: key.objects[MAX_SUBJECTS..].iter().chain(arrived).filter_map(idx).collect(),
        quantities: of_start.chain(of_end).collect(),
    }
}

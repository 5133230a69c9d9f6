//! What a step's own words mean.

use cinesplat_language::{Linked, Senses};
use cinesplat_operator::Step;

/// Whether a word of a step has one of these senses. `senses` has one entry per word of the prompt.
pub(crate) fn says(linked: &Linked, senses: &[Senses], step: &Step, wanted: Senses) -> bool {
    let [from, to] = step.words.unwrap_or_default();
    let is_said = |span: &[usize; 2]| (from..to).contains(&span[0]);
    linked.spans.iter().zip(senses).any(|(span, senses)| is_said(span) && senses.overlaps(wanted))
}

//! Sentences glued together.

use cinesplat_language::{Linked, MAX_QUANTITIES, MAX_SLOTS};

use super::sentence::Sentence;

/// Distance between the ids of joined sentences.
const ID_STEP: u32 = 100_000;
/// Bytes between joined sentences.
const GAP_BYTES: usize = 1;

/// A sentence behind another one, and how much its ids grew; `None` where there are too many objects or quantities. A phrase
/// is a sentence without steps.
pub(super) fn join(mut first: Sentence, second: &Sentence) -> Option<(Sentence, u32)> {
    let (num_slots, num_quantities) = (first.linked.slots.len(), first.linked.quantities.len());
    if num_slots + second.linked.slots.len() > MAX_SLOTS
        || num_quantities + second.linked.quantities.len() > MAX_QUANTITIES
    {
        return None;
    }
    if !second.linked.tokens_text.starts_with(char::is_alphanumeric) {
        trim_end(&mut first.linked);
    }
    let linked = &mut first.linked;
    let offset = linked.spans.last().map_or(0, |[_, end]| *end) + GAP_BYTES;
    for word in second.linked.tokens_text.split(' ').filter(|word| !word.is_empty()) {
        let shifted = |prefix: &str, by: usize| {
            let number: usize = word.strip_prefix(prefix)?.strip_suffix('>')?.parse().ok()?;
            Some(format!("{prefix}{}>", number + by))
        };
        let word = shifted("<obj-", num_slots).or_else(|| shifted("<qty-", num_quantities)).unwrap_or(word.to_owned());
        if !linked.tokens_text.is_empty() {
            linked.tokens_text.push(' ');
        }
        linked.tokens_text.push_str(&word);
    }
    let later = |bytes: [usize; 2]| bytes.map(|byte| byte + offset);
    linked.spans.extend(second.linked.spans.iter().copied().map(later));
    // Without objects before it the second keeps its ids, and with them its groups.
    let id_offset = linked.slots.iter().max().map_or(0, |max| ID_STEP * (max / ID_STEP + 1));
    linked.slots.extend(second.linked.slots.iter().map(|id| id + id_offset));
    linked.quantities.extend(second.linked.quantities.iter().copied());
    if id_offset == 0 {
        linked.groups.extend(second.linked.groups.iter().cloned());
    }
    first.unmet.extend(second.unmet.iter().copied().map(later));
    let program = second.program.clone().with_ids(&|ids| ids.iter().map(|id| id + id_offset).collect());
    first.program.duration_secs = first.program.duration_secs.or(program.duration_secs);
    first.program.forbidden.extend(program.forbidden);
    first.program.steps.extend(program.steps.into_iter().map(|mut step| {
        step.words = step.words.map(later);
        step
    }));
    Some((first, id_offset))
}

/// Takes the punctuation off the end.
fn trim_end(linked: &mut Linked) {
    let trimmed = linked.tokens_text.trim_end_matches([' ', '.', '!', ',', ';', '-']).len();
    if trimmed > 0 {
        linked.spans.truncate(linked.tokens_text[..trimmed].split(' ').count());
        linked.tokens_text.truncate(trimmed);
    }
}

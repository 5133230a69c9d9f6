//! Times beside the two values of a range: `50° at 0:00 to 25° at 0:06` says no more of the camera than `50° to 25°`.

use cinesplat_language::{Linked, QuantityKind};

/// The words without the times of ranges.
pub(super) fn without_instants(linked: &Linked) -> Linked {
    let words: Vec<&str> = linked.tokens_text.split(' ').collect();
    let times = (0..words.len()).filter_map(|at| times_of_range(linked, &words, at)).flatten();
    let bytes = |[from, to]: [usize; 2]| Some([linked.spans.get(from)?[0], linked.spans.get(to - 1)?[1]]);
    let bytes: Vec<[usize; 2]> = times.filter_map(bytes).collect();
    if bytes.is_empty() { linked.clone() } else { linked.without(&bytes, None) }
}

/// The words of both times of the range that begins at word `at`.
fn times_of_range(linked: &Linked, words: &[&str], at: usize) -> Option<[[usize; 2]; 2]> {
    let first = linked.quantity_at(words[at])?;
    let link = time_at(linked, words, at + 1)?;
    let is_link = |word: &&str| matches!(*word, "to" | ">" | "," | "\u{2192}" | "and");
    let second = link + usize::from(words.get(link).is_some_and(is_link));
    let value = words.get(second).and_then(|word| linked.quantity_at(word))?;
    let end = time_at(linked, words, second + 1)?;
    (value.kind == first.kind && first.kind != QuantityKind::Seconds).then_some([[at + 1, link], [second + 1, end]])
}

/// The word behind the time at word `i`: `at 0 : 00`, `at 6 s`, `at t 0`.
fn time_at(linked: &Linked, words: &[&str], i: usize) -> Option<usize> {
    let word = |at: usize| words.get(at).copied().unwrap_or_default();
    let is_secs = |at: usize| linked.quantity_at(word(at)).is_some_and(|other| other.kind == QuantityKind::Seconds);
    let at = i + 1 + usize::from(word(i + 1) == "t");
    match word(at) {
        _ if word(i) != "at" => None,
        "0" | "00" if word(at + 1) == ":" => Some(at + 3),
        "0" => Some(at + 1 + usize::from(word(at + 1) == "s")),
        _ => is_secs(at).then_some(at + 1),
    }
}

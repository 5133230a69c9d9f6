//! Words of a prompt that ask for a stop between two steps.

use super::program::Program;

/// Words that ask the camera to stop, in lower case.
const STOP_WORDS: [&str; 14] = [
    "stop", "stops", "stopping", "pause", "pauses", "pausing", "halt", "halts", "settle", "settles", "wait", "freeze",
    "linger", "beat",
];

/// Whether a prompt asks for a stop between two neighboring steps: in the words from the start of the first step to the
/// start of the second one, or in those of the second one before its move (`stop, then zoom in`).
pub(super) fn asks_for_stop(program: &Program, prompt: &str, first: usize, second: usize) -> bool {
    let words = |index: usize| program.steps.get(index).and_then(|step| step.words);
    let (Some([from, _]), Some([to, end])) = (words(first), words(second)) else { return false };
    let split = |text: &str| -> Vec<String> {
        let words = text.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty());
        words.map(str::to_lowercase).collect()
    };
    let is_stop = |word: &String| STOP_WORDS.contains(&word.as_str());
    let opening = split(prompt.get(to..end).unwrap_or_default());
    let before_move = opening.iter().rposition(|word| word == "then").map_or(1, |then| then.max(1)).min(opening.len());
    split(prompt.get(from..to).unwrap_or_default()).iter().chain(&opening[..before_move]).any(is_stop)
}

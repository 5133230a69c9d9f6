//! Parts that are lines with a dash or a dot before each of them: `- start: wide \n- mid: arc right \n- end: close on the mug`.

use super::stamp::{Stamp, StampKind};
use crate::tokenizer::{Word, word_at};

/// Marks at the beginning of such a line.
const BULLETS: [char; 6] = ['-', '\u{2013}', '\u{2014}', '\u{2022}', '*', '\u{B7}'];
/// What such a line may be called.
const LABELS: [&str; 16] = [
    "start",
    "mid",
    "middle",
    "end",
    "begin",
    "beginning",
    "open",
    "opening",
    "finish",
    "then",
    "next",
    "last",
    "first",
    "second",
    "third",
    "final",
];

/// The lines of a list, numbered from 1; empty unless at least two lines are items of one.
pub(super) fn bullets(prompt: &str, words: &[Word]) -> Vec<Stamp> {
    let items = (0..words.len()).filter(|at| begins_bullet(prompt, words, *at));
    let stamp = |(number, at): (u32, usize)| {
        let is_mark = |at: usize| {
            let written = words.get(at).and_then(|word| prompt.get(word.span[0]..word.span[1])).unwrap_or_default();
            written.chars().all(|letter| BULLETS.contains(&letter))
        };
        let text = at + usize::from(is_mark(at));
        let is_label = LABELS.contains(&word_at(words, text)) && word_at(words, text + 1) == ":";
        let end = if is_label { text + 2 } else { text };
        Stamp { at, end, kind: StampKind::Number(number) }
    };
    let stamps: Vec<Stamp> = (1..).zip(items).map(stamp).collect();
    if stamps.len() > 1 { stamps } else { Vec::new() }
}

/// Whether word `at` is the first of a line, or the mark before it, and a mark and a space begin the line.
fn begins_bullet(prompt: &str, words: &[Word], at: usize) -> bool {
    let Some(word) = words.get(at) else { return false };
    let before = at.checked_sub(1).and_then(|before| words.get(before)).map_or(0, |before| before.span[1]);
    let gap = prompt.get(before..word.span[0]).unwrap_or_default();
    // The mark may be a word or lie between two words.
    let rest = prompt.get(word.span[0]..).unwrap_or_default();
    let line = gap.rfind('\n').map(|end| &gap[end + 1..]).or_else(|| (at == 0).then_some(gap));
    let Some(line) = line else { return false };
    let is_item = |text: &str| {
        let mut letters = text.chars();
        letters.next().is_some_and(|first| BULLETS.contains(&first)) && letters.next().is_some_and(char::is_whitespace)
    };
    if line.trim().is_empty() { is_item(rest) } else { is_item(line.trim_start()) }
}

#[cfg(test)]
mod tests {
    use crate::mention::link_mentions;

    #[test]
    fn lines_with_dashes_are_parts() {
        let parts = |prompt: &str| -> Vec<String> {
            let timeline = link_mentions(prompt, &[]).unwrap().timeline;
            let beats = timeline.map(|timeline| timeline.beats).unwrap_or_default();
            beats.iter().map(|beat| prompt[beat.bytes[0]..beat.bytes[1]].to_owned()).collect()
        };
        let three = ["wide", "arc right 90 degrees", "close up"];
        assert_eq!(parts("- start: wide\n- mid: arc right 90 degrees\n- end: close up"), three);
        assert_eq!(parts("* wide\n* arc right 90 degrees\n* close up"), three);
        assert_eq!(parts("Two moves:\n\u{2022} pan left\n\u{2022} push in"), ["pan left", "push in"]);
        assert_eq!(parts("pan left - push in - tilt up"), [""; 0]);
    }
}

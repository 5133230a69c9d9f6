//! Chains of shorthand: `MCU guitar > truck L > van WS > hold 3`, one thing after the other.

use std::borrow::Cow;

use super::tokenizer::{Word, tokenize};

/// Words of moves and holds, as stems.
const MOVES: [&str; 30] = [
    "pan",
    "tilt",
    "truck",
    "push",
    "pull",
    "orbit",
    "arc",
    "crane",
    "boom",
    "dolly",
    "zoom",
    "hold",
    "track",
    "whip",
    "rise",
    "ped",
    "pedestal",
    "roll",
    "static",
    "crab",
    "jib",
    "pi",
    "po",
    "lock",
    "rack",
    "circle",
    "establish",
    "drift",
    "settle",
    "stop",
];
/// Abbreviations and words of sizes.
const SIZES: [&str; 18] = [
    "ecu", "xcu", "bcu", "cu", "mcu", "ms", "mls", "mws", "ls", "ws", "fs", "els", "ews", "vws", "wide", "close",
    "tight", "medium",
];
/// Most words of a link of a chain.
const MAX_LINK_WORDS: usize = 12;

/// The prompt with a semicolon for each arrow of a chain of moves; every other byte stays where it is. Arrows from one size
/// or thing to another are no chain of moves.
pub fn without_arrows(prompt: &str) -> Cow<'_, str> {
    let arrows = arrows(prompt);
    let ends = arrows.iter().map(|arrow| arrow[0]).chain([prompt.len()]);
    let starts = [0].into_iter().chain(arrows.iter().map(|arrow| arrow[1]));
    let links: Vec<Vec<Word>> =
        starts.zip(ends).map(|(start, end)| tokenize(prompt.get(start..end).unwrap_or_default())).collect();
    let moves = |link: &&Vec<Word>| link.iter().any(|word| MOVES.contains(&word.stem.as_str()));
    let is_chain = arrows.len() > 1
        && links.iter().all(|link| (1..=MAX_LINK_WORDS).contains(&link.len()))
        // A sentence in a link is no shorthand.
        && links.iter().flatten().all(|word| !matches!(word.text.as_str(), "." | ";" | "!" | "?" | ":"))
        && links.iter().filter(moves).count() > 1;
    if !is_chain {
        return Cow::Borrowed(prompt);
    }
    let is_size = |word: Option<&Word>| word.is_some_and(|word| SIZES.contains(&word.text.as_str()));
    let mut out = prompt.to_owned();
    for (nth, [start, end]) in arrows.iter().enumerate() {
        if !(is_size(links[nth].last()) && is_size(links[nth + 1].first())) {
            out.replace_range(*start..*end, &format!("{:>width$}", ";", width = end - start));
        }
    }
    Cow::Owned(out)
}

/// The bytes of each arrow: `>`, `->`, `=>`, `>>`, `\u{2192}`, none of which closes `<obj-3>`.
fn arrows(prompt: &str) -> Vec<[usize; 2]> {
    let mut arrows: Vec<[usize; 2]> = Vec::new();
    for (at, letter) in prompt.char_indices().filter(|(_, letter)| matches!(letter, '>' | '\u{2192}')) {
        let before = &prompt[..at];
        let opened = before.rfind('<').map(|open| &before[open..]);
        let is_mention = opened.and_then(|text| text.strip_prefix("<obj-"));
        if is_mention.is_some_and(|number| number.bytes().all(|byte| byte.is_ascii_digit())) {
            continue;
        }
        let shaft = before.len() - before.trim_end_matches(['-', '=', '>', '\u{2013}']).len();
        arrows.retain(|arrow| arrow[1] <= at - shaft);
        arrows.push([at - shaft, at + letter.len_utf8()]);
    }
    arrows
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arrows_between_moves_end_clauses() {
        let read = |prompt| without_arrows(prompt).into_owned();
        assert_eq!(read("MCU guitar > truck L > hold 3"), "MCU guitar ; truck L ; hold 3");
        assert_eq!(read("push in -> pan left \u{2192} <obj-3> => out"), "push in  ; pan left   ; <obj-3>  ; out");
        // One size to another, things, and a single arrow stay.
        assert_eq!(read("MCU > CU guitar > truck L > pan R"), "MCU > CU guitar ; truck L ; pan R");
        for kept in [
            "vanity -> shower -> tub",
            "pan <obj-1> > <obj-2>",
            "push in, MCU > CU",
            "pan R: wall > tub > bed. Push in on it",
        ] {
            assert_eq!(read(kept), kept);
        }
    }
}

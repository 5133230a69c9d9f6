//! One of several things by its place in their row: `slide right along the three pictures, then push in on the last one`.

use cinesplat_language::{Mention, Word, is_listed, tokenize};

use crate::explained::{is_linked, replace_mentions};
use crate::names::FoundMention;
use crate::placed::{Flank, Places, outermost};

/// Words of the last and the first of a row, and what stands behind them.
const LASTS: &str = "last final";
const FIRSTS: &str = "first";
const ONES: &[&[&str]] = &[&["one"], &["of", "them"], &["of", "these"], &["of", "those"]];
/// Most words before such a phrase among which the side is sought to which the camera moves along the row.
const MOST_BACK: usize = 24;

/// Points `the last one` and `the first one` at one of the things of the last mention of several.
pub(crate) fn point_by_order(prompt: &str, places: Places<'_>, found: &mut Vec<FoundMention>) {
    let words = tokenize(prompt);
    for at in 1..words.len() {
        let Some(len) = phrase_len(&words, at) else { continue };
        let bytes = [words[at - 1].span[0], words[at + len - 1].span[1]];
        let row = found.iter().rev().find(|found| found.mention.bytes[1] <= bytes[0] && found.mention.ids.len() > 2);
        let Some(row) = row.map(|row| row.mention.ids.clone()) else { continue };
        let mut before = words[..at - 1].iter().rev().take(MOST_BACK).filter(|word| !is_linked(found, word.span));
        let side = before.find_map(|word| match word.text.as_str() {
            "left" => Some(Flank::Left),
            "right" => Some(Flank::Right),
            _ => None,
        });
        let is_last = is_listed(LASTS, &words[at].text);
        let toward = side.map(|side| if is_last == (side == Flank::Left) { Flank::Left } else { Flank::Right });
        let by_side = toward.and_then(|flank| outermost(places, &row, flank));
        let by_id = if is_last { row.iter().max() } else { row.iter().min() };
        if let Some(id) = by_side.or(by_id.copied()) {
            replace_mentions(found, Mention { bytes, ids: vec![id] });
        }
    }
}

/// Words of `last one` at a word behind `the`.
fn phrase_len(words: &[Word], at: usize) -> Option<usize> {
    let is_order = is_listed(LASTS, &words[at].text) || is_listed(FIRSTS, &words[at].text);
    let ones = ONES.iter().find(|ones| {
        ones.iter().enumerate().all(|(nth, one)| words.get(at + 1 + nth).is_some_and(|word| word.text == **one))
    });
    (is_order && words[at - 1].text == "the").then(|| ones.map(|ones| 1 + ones.len())).flatten()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_one_is_the_last_of_the_row() {
        let ids = |prompt: &str| {
            let start = prompt.find("three pictures").unwrap();
            let mention = Mention { bytes: [start, start + 14], ids: vec![4, 5, 6] };
            let mut found = vec![FoundMention { mention, probability: 1.0, nearest: Vec::new() }];
            let places = Places { objects: &[], up: glam::DVec3::Y };
            point_by_order(prompt, places, &mut found);
            found.last().map(|found| found.mention.ids.clone()).unwrap_or_default()
        };
        assert_eq!(ids("slide along the three pictures , then push in on the last one"), [6]);
        assert_eq!(ids("slide along the three pictures and return to the first of them"), [4]);
        assert_eq!(ids("slide along the three pictures for the last time"), [4, 5, 6]);
    }
}

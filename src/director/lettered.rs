//! Things that a prompt gives letters to and then calls by them: `item A: the drawers. Item B: the chest. A sweep from A to B,
//! then back off until both are in shot`.

use std::collections::BTreeMap;

use cinesplat_language::{Mention, NamedObject, Word, is_listed, number_word, tokenize};

use crate::explained::{drop_mentions, replace_mentions};
use crate::names::FoundMention;

/// What things with letters may be called.
const KINDS: &str = "item point subject target object position pos waypoint thing stop station";
/// Letters of things.
const LETTERS: &str = "ABCDEFGH";

/// A letter and the mention that it stands for.
struct Definition {
    letter: char,
    ids: Vec<u32>,
    bytes: [usize; 2],
}

/// Makes mentions of the letters, and of `all three` behind them. The bytes left are those that say what the letters stand for.
pub(crate) fn name_lettered(prompt: &str, objects: &[NamedObject], found: &mut Vec<FoundMention>) -> Vec<[usize; 2]> {
    let words = tokenize(prompt);
    let definitions = definitions(prompt, &words, found);
    let letters: BTreeMap<char, &Vec<u32>> = definitions.iter().map(|each| (each.letter, &each.ids)).collect();
    let is_label = |letter: &str| objects.iter().any(|object| object.label.ends_with(&format!(" {letter}")));
    let is_inside = |word: &Word| definitions.iter().any(|each| (each.bytes[0]..each.bytes[1]).contains(&word.span[0]));
    let mentions = words.iter().filter(|word| !is_inside(word)).filter_map(|word| {
        let letter = letter_of(prompt, word)?;
        let ids = letters.get(&letter).filter(|_| !is_label(&letter.to_string()))?;
        Some(Mention { bytes: word.span, ids: (*ids).clone() })
    });
    let mut mentions: Vec<Mention> = mentions.collect();
    // A letter that is said once more may be the end of a name.
    if letters.len() < 2 || letters.len() != definitions.len() || mentions.len() < 2 {
        return Vec::new();
    }
    let all = || definitions.iter().flat_map(|each| each.ids.clone()).collect();
    let behind = mentions.iter().map(|mention| mention.bytes[1]).min().unwrap_or_default();
    let ends = all_at(&words, definitions.len()).filter(|bytes| bytes[0] > behind);
    mentions.extend(ends.map(|bytes| Mention { bytes, ids: all() }));
    let defined: Vec<[usize; 2]> = definitions.iter().map(|each| each.bytes).collect();
    defined.iter().for_each(|bytes| drop_mentions(found, *bytes));
    mentions.into_iter().for_each(|mention| replace_mentions(found, mention));
    defined
}

/// The capital letter that a word is.
fn letter_of(prompt: &str, word: &Word) -> Option<char> {
    let text = prompt.get(word.span[0]..word.span[1])?;
    let mut letters = text.chars();
    let letter = letters.next().filter(|letter| LETTERS.contains(*letter))?;
    letters.next().is_none().then_some(letter)
}

/// The letters of `item A: the drawers.`, `A = the drawers`.
fn definitions(prompt: &str, words: &[Word], found: &[FoundMention]) -> Vec<Definition> {
    let text = |at: usize| words.get(at).map_or("", |word| word.text.as_str());
    let definition = |at: usize| {
        let letter = letter_of(prompt, words.get(at)?)?;
        let gap = prompt.get(words[at].span[1]..words.get(at + 1)?.span[0]).unwrap_or_default();
        let is_equal = gap.trim() == "=";
        let value = at + 1 + usize::from(text(at + 1) == ":");
        let value_byte = words.get(value).filter(|_| is_equal || value > at + 1)?.span[0];
        let is_within = |found: &&FoundMention| {
            let [from, _] = found.mention.bytes;
            let article = matches!(text(value), "the" | "a") && words.get(value + 1).is_some_and(|w| w.span[0] == from);
            from == value_byte || article
        };
        let mention = &found.iter().find(is_within)?.mention;
        let kind = at.checked_sub(1).filter(|before| is_listed(KINDS, text(*before))).unwrap_or(at);
        let end = words.iter().find(|word| word.span[0] >= mention.bytes[1]);
        let is_mark = |word: &&Word| matches!(word.text.as_str(), "." | ";" | ",");
        let end = end.filter(is_mark).map_or(mention.bytes[1], |mark| mark.span[1]);
        Some(Definition { letter, ids: mention.ids.clone(), bytes: [words[kind].span[0], end] })
    };
    (0..words.len()).filter_map(definition).collect()
}

/// The bytes of `all three`, `both`, `all of them`.
fn all_at(words: &[Word], num: usize) -> Option<[usize; 2]> {
    let text = |at: usize| words.get(at).map_or("", |word| word.text.as_str());
    let count = u32::try_from(num).ok().and_then(number_word).unwrap_or_default();
    (0..words.len()).find_map(|at| {
        let len = match [text(at), text(at + 1), text(at + 2)] {
            ["both", ..] if num == 2 => 1,
            ["all", "of", "them"] => 3,
            ["all", number, _] if number == count => 2,
            _ => return None,
        };
        Some([words[at].span[0], words[at + len - 1].span[1]])
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::said::fixture::labelled;

    #[test]
    fn letters_stand_for_things() {
        let objects = labelled(&["pink drawers", "teal cabinet", "drawer chest"]);
        let named = |prompt: &str| {
            let name = |(id, label): (u32, &str)| {
                let start = prompt.find(label)?;
                let mention = Mention { bytes: [start, start + label.len()], ids: vec![id] };
                Some(FoundMention { mention, probability: 1.0, nearest: Vec::new() })
            };
            let mut found: Vec<FoundMention> =
                (1..).zip(["pink drawers", "teal cabinet", "drawer chest"]).filter_map(name).collect();
            let blank = name_lettered(prompt, &objects, &mut found);
            let said = found.iter().map(|found| {
                let [from, to] = found.mention.bytes;
                (prompt[from..to].to_owned(), found.mention.ids.clone())
            });
            (blank.len(), said.collect::<Vec<_>>())
        };
        let said = |text: &str, ids: &[u32]| (text.to_owned(), ids.to_vec());
        assert_eq!(
            named(
                "Item A: pink drawers. Item B: teal cabinet. C = drawer chest. Sweep A\u{2192}B\u{2192}C, then show all three."
            ),
            (3, vec![said("A", &[1]), said("B", &[2]), said("C", &[3]), said("all three", &[1, 2, 3])])
        );
        assert_eq!(named("A: pink drawers. B: teal cabinet.").0, 0);
        assert_eq!(named("A pan from pink drawers to teal cabinet").0, 0);
    }
}

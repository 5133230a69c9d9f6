//! Parts of things, and where they sit: `the headstock`, `its pot`, `the left earcup`, `the badge at the back`.
//!
//! `prompts/parts.txt` lists them and describes its own format.

use std::collections::BTreeMap;
use std::sync::OnceLock;

use super::error::LanguageError;
use super::list_lines::list_lines;
use super::tokenizer::{Word, is_listed, tokenize};

const FILE: &str = "prompts/parts.txt";
static TEXT: &str = include_str!("../../prompts/parts.txt");
const PLACES: [&str; 7] = ["top", "bottom", "front", "back", "left", "right", "middle"];
/// Words before a part that say nothing else.
const BEFORE: &str = "the a its his her their this that very guitar 's whole eye tuning both two skull near nearer far left right \
    one each other upper lower front rubber little small tiny big chunky fat knobbly";
/// Words behind a part, before words of where it is.
const BEHIND: &str = "of on at in from";

/// Where a part of a thing sits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PartPlace {
    /// `top`, `bottom`, `front`, `back`, `left`, `right` or `middle`.
    pub place: &'static str,
    /// A picture of it is a close one.
    pub is_small: bool,
}

/// The parts of things of one kind, or of all.
#[derive(Debug)]
struct Part {
    /// Words of labels; empty for all things.
    kinds: Vec<&'static str>,
    place: PartPlace,
}

/// Parts by the last words of their names; what stands before it belongs to the name, too. In the order of the list.
#[derive(Debug, Default)]
struct Parts(BTreeMap<&'static str, Vec<(Vec<&'static str>, Part)>>);

impl Parts {
    /// The list that the program ships, read once.
    fn embedded() -> Result<&'static Self, LanguageError> {
        static PARTS: OnceLock<Result<Parts, LanguageError>> = OnceLock::new();
        PARTS.get_or_init(|| Self::parse(TEXT)).as_ref().map_err(Clone::clone)
    }

    fn parse(text: &'static str) -> Result<Self, LanguageError> {
        let mut parts = Self::default();
        for (number, line) in list_lines(text) {
            let what = "expected \"PLACE | name\" or \"PLACE of KIND | name\"".to_owned();
            let bad = || LanguageError::BadData { file: FILE, line: number, what: what.clone() };
            let (head, names) = line.split_once(" | ").ok_or_else(bad)?;
            let (place, kinds) = head.split_once(" of ").unwrap_or((head, ""));
            let (place, is_small) = place.strip_suffix(" small").map_or((place, false), |place| (place, true));
            let place = *PLACES.iter().find(|known| **known == place).ok_or_else(bad)?;
            let kinds: Vec<&str> = kinds.split(", ").filter(|kind| !kind.is_empty()).collect();
            for name in names.split(", ") {
                let mut words: Vec<&str> = name.split_ascii_whitespace().collect();
                let last = words.pop().ok_or_else(bad)?;
                let part = Part { kinds: kinds.clone(), place: PartPlace { place, is_small } };
                parts.0.entry(last).or_default().push((words, part));
            }
        }
        // The longest name counts, then the first of the list.
        parts.0.values_mut().for_each(|named| named.sort_by_key(|(rest, _)| std::cmp::Reverse(rest.len())));
        Ok(parts)
    }

    /// The part that words end in, of a thing with such a label, and the number of its words.
    fn found(&self, words: &[Word], label: &[Word]) -> Option<(usize, PartPlace)> {
        let (last, before) = words.split_last()?;
        // `His face` is that of a person, whatever he is called.
        let is_person = words.iter().any(|word| is_listed("his her", &word.text));
        let is_of = |part: &Part| {
            part.kinds.is_empty()
                || label.iter().any(|word| part.kinds.contains(&word.text.as_str()))
                || is_person && part.kinds.contains(&"person")
        };
        let ends_in = |rest: &[&str]| {
            before.len() >= rest.len()
                && before[before.len() - rest.len()..].iter().zip(rest).all(|(word, known)| word.text == *known)
        };
        let mut named = self.0.get(last.text.as_str())?.iter();
        let (rest, part) = named.find(|(rest, part)| ends_in(rest) && is_of(part))?;
        Some((rest.len() + 1, part.place))
    }
}

/// The part of the thing labelled `label` that a mention with these words names, and where it sits. What the label says
/// itself is the thing.
///
/// # Errors
/// [`LanguageError::BadData`] when the embedded list is malformed.
pub fn part_of(words: &str, label: &str) -> Result<Option<PartPlace>, LanguageError> {
    let (parts, words, label) = (Parts::embedded()?, tokenize(words), tokenize(label));
    let is_label = |text: &str| label.iter().any(|word| word.text == text);
    // `The sole of the shoe`.
    let tail = words.iter().position(|word| is_listed(BEHIND, &word.text)).filter(|at| {
        *at > 0 && words[at + 1..].iter().all(|word| is_label(&word.text) || is_listed(BEFORE, &word.text))
    });
    let words = &words[..tail.unwrap_or(words.len())];
    let Some((len, place)) = parts.found(words, &label) else { return Ok(None) };
    let (before, name) = words.split_at(words.len() - len);
    // `The feet of the stand` are at the bottom, where the stand is.
    let inner = before.iter().rposition(|word| word.text == "of");
    if let Some(of) = inner.filter(|of| before[of + 1..].iter().all(|word| is_listed(BEFORE, &word.text))) {
        let is_part = |words: &[Word]| parts.found(words, &label).is_some() || is_end(words);
        return Ok(is_part(&words[..of]).then_some(place));
    }
    // `The stand's foot`.
    let owner = before.iter().rposition(|word| word.text == "'s");
    if let Some(mark) = owner.filter(|mark| *mark + 1 == before.len())
        && let Some((_, place)) = parts.found(&before[..mark], &label)
    {
        return Ok(Some(place));
    }
    // The pot of `the teapot` is all of it.
    if name.last().is_some_and(|last| label.iter().any(|word| word.text.ends_with(&last.text))) {
        return Ok(None);
    }
    let says_label = before.iter().all(|word| is_listed(BEFORE, &word.text) || is_label(&word.text));
    Ok(says_label.then_some(place))
}

/// Whether words name an end of something: `the very bottom`.
fn is_end(words: &[Word]) -> bool {
    words
        .last()
        .is_some_and(|word| is_listed("top bottom front back side end ends edge middle center centre", &word.text))
}

/// The part of a thing of its own kind that begins at the first of some words, with the number of its words: `sole` of a
/// shoe.
///
/// # Errors
/// [`LanguageError::BadData`] when the embedded list is malformed.
pub fn own_part_at(words: &[Word], label: &str) -> Result<Option<usize>, LanguageError> {
    let (parts, label) = (Parts::embedded()?, tokenize(label));
    let is_own = |named: &[(Vec<&str>, Part)], word: &str| {
        let mut named = named.iter().filter(|(_, part)| !part.kinds.is_empty());
        named.any(|(_, part)| part.kinds.contains(&word))
    };
    let lengths = (1..=words.len().min(3)).rev();
    let mut found = lengths.filter(|len| {
        let last = words[len - 1].text.as_str();
        let named = parts.0.get(last).is_some_and(|named| label.iter().any(|word| is_own(named, &word.text)));
        named && parts.found(&words[..*len], &label).is_some_and(|(own, _)| own == *len)
    });
    Ok(found.next())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_part_of_a_thing_is_told_from_the_thing() {
        let place = |words: &str, label: &str| part_of(words, label).unwrap().map(|part| part.place);
        assert_eq!(place("the headstock", "electric guitar"), Some("top"));
        assert_eq!(place("the guitar's bridge", "electric guitar"), Some("bottom"));
        assert_eq!(place("the front", "armchair"), Some("front"));
        assert_eq!(place("its pot", "palm tree"), Some("bottom"));
        assert_eq!(place("the lamp shade", "lamp shade"), None);
        assert_eq!(place("the stand", "music stand"), None);
        assert_eq!(place("the golden head", "statue"), None);
        assert_eq!(place("the statue", "statue"), None);
        assert_eq!(place("the pot", "red teapot"), None);
        assert_eq!(place("the sole of the shoe", "running shoe"), Some("bottom"));
        assert_eq!(place("the left earcup", "headphones"), Some("left"));
        assert_eq!(place("its face", "stuffed bear"), Some("front"));
        assert_eq!(place("the screen", "laptop"), Some("top"));
        assert_eq!(place("the screen", "folding screen"), None);
        assert_eq!(place("the feet of the stand", "tall brown object"), Some("bottom"));
        assert_eq!(place("the tip of its crown", "palm"), Some("top"));
        assert_eq!(place("the stand's foot", "tall brown object"), Some("bottom"));
        assert_eq!(place("the friend of the stand", "guitar"), None);
        assert_eq!(place("his face", "large gray object"), Some("top"));
        assert_eq!(place("her shoes", "large gray object"), Some("bottom"));
        assert_eq!(place("his face", "head"), Some("front"));
    }

    #[test]
    fn small_parts_are_told_from_large_ones() {
        let is_small = |words: &str, label: &str| part_of(words, label).unwrap().unwrap().is_small;
        assert!(is_small("the badge", "sports car"));
        assert!(is_small("the label", "wine bottle"));
        assert!(!is_small("the legs", "oak table"));
    }

    #[test]
    fn damage_is_named_by_its_line() {
        for text in ["above | lid", "top lid", "top | "] {
            assert!(Parts::parse(text).unwrap_err().to_string().contains("line 1"), "{text}");
        }
    }
}

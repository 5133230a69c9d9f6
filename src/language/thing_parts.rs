//! Parts of things, and where they sit: `the headstock`, `its pot`, `the left earcup`, `the badge at the back`.
//!
//! `prompts/parts.txt` lists them and describes its own format.

use std::collections::BTreeMap;
use std::sync::OnceLock;

use super::error::LanguageError;
use super::list_lines::list_lines;
use super::things::{Relation, Things};
use super::tokenizer::{Word, is_listed, tokenize};

const FILE: &str = "prompts/parts.txt";
static TEXT: &str = include_str!("../../prompts/parts.txt");
const PLACES: [&str; 8] = ["top", "bottom", "front", "back", "left", "right", "middle", "sides"];
/// Words before a part that say nothing else.
const BEFORE: &str = "the a its his her their this that very guitar 's whole eye tuning both two skull near nearer far left right \
    one each other upper lower front rubber little small tiny big chunky fat knobbly";
/// Words behind a part, before words of where it is.
const BEHIND: &str = "of on at in from";

/// Where a part of a thing sits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PartPlace {
    /// `top`, `bottom`, `front`, `back`, `left`, `right`, `middle` or `sides`.
    pub place: &'static str,
    /// A picture of it is a close one.
    pub is_small: bool,
    /// Where its lower and upper end are between those of the thing, percent; `None` where things differ too much.
    pub heights_percent: Option<[u8; 2]>,
}

/// A part that a prompt names, of which it is known how high it sits.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SaidPart {
    /// Its name as the prompt says it.
    pub name: String,
    /// The words of the prompt that are its name.
    pub words: std::ops::Range<usize>,
    /// Where it sits.
    pub place: PartPlace,
}

/// The parts of things of one kind, or of all.
#[derive(Debug)]
struct Part {
    /// Words of labels; empty for all things.
    kinds: Vec<&'static str>,
    place: PartPlace,
}

impl Part {
    /// Whether a thing with such a label is of one of its kinds.
    fn is_of(&self, label: &[Word]) -> bool {
        label.iter().any(|word| self.kinds.contains(&word.text.as_str()))
    }
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
            let what = "expected \"PLACE | name\" or \"PLACE small LOW..HIGH of KIND | name\"".to_owned();
            let bad = || LanguageError::BadData { file: FILE, line: number, what: what.clone() };
            let (head, names) = line.split_once(" | ").ok_or_else(bad)?;
            let (place, kinds) = head.split_once(" of ").unwrap_or((head, ""));
            let mut rest = place.split_ascii_whitespace();
            let place = rest.next().ok_or_else(bad)?;
            let mut is_small = false;
            let mut heights_percent = None;
            for word in rest {
                match word.split_once("..") {
                    None if word == "small" => is_small = true,
                    Some((low, high)) => {
                        let [low, high] =
                            [low, high].map(|text| text.parse().ok().filter(|percent| *percent <= 100_u8));
                        heights_percent = Some(low.zip(high).filter(|(low, high)| low < high).ok_or_else(bad)?.into());
                    }
                    None => return Err(bad()),
                }
            }
            let place = *PLACES.iter().find(|known| **known == place).ok_or_else(bad)?;
            let kinds: Vec<&str> = kinds.split(", ").filter(|kind| !kind.is_empty()).collect();
            for name in names.split(", ") {
                let mut words: Vec<&str> = name.split_ascii_whitespace().collect();
                let last = words.pop().ok_or_else(bad)?;
                let part = Part { kinds: kinds.clone(), place: PartPlace { place, is_small, heights_percent } };
                parts.0.entry(last).or_default().push((words, part));
            }
        }
        // The longest name counts, then the first of the list.
        parts.0.values_mut().for_each(|named| named.sort_by_key(|(rest, _)| std::cmp::Reverse(rest.len())));
        Ok(parts)
    }

    /// The part that words end in, of a thing with such a label, and the number of its words. Parts whose heights are known are
    /// for scans of one thing, which is divided by them ([`said_parts`]).
    fn found(&self, words: &[Word], label: &[Word]) -> Option<(usize, PartPlace)> {
        // `His face` is that of a person, whatever he is called.
        let is_person = words.iter().any(|word| is_listed("his her", &word.text));
        let is_of =
            |part: &Part| part.kinds.is_empty() || part.is_of(label) || is_person && part.kinds.contains(&"person");
        self.first(words, &is_of)
    }

    /// As [`Self::found`], among the parts that `fits` accepts.
    fn first(&self, words: &[Word], fits: &dyn Fn(&Part) -> bool) -> Option<(usize, PartPlace)> {
        let (last, before) = words.split_last()?;
        let ends_in = |rest: &[&str]| {
            before.len() >= rest.len()
                && before[before.len() - rest.len()..].iter().zip(rest).all(|(word, known)| word.text == *known)
        };
        let mut named = self.0.get(last.text.as_str())?.iter();
        let (rest, part) = named.find(|(rest, part)| ends_in(rest) && fits(part))?;
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
    // `The white seat` is all of a white armchair.
    let (kind, looks) = label.split_last().map_or((None, &label[..]), |(kind, looks)| (Some(kind), looks));
    let is_look = |word: &Word| looks.iter().any(|look| look.text == word.text) && !is_listed(BEFORE, &word.text);
    if before.iter().any(is_look) && kind.is_some_and(|kind| is_kind(name, &kind.text)) {
        return Ok(None);
    }
    let says_label = before.iter().all(|word| is_listed(BEFORE, &word.text) || is_label(&word.text));
    Ok(says_label.then_some(place))
}

/// Whether a name stands for things of a kind as well: `seat` for an armchair.
fn is_kind(name: &[Word], kind: &str) -> bool {
    let stems: Vec<&str> = name.iter().map(|word| word.stem.as_str()).collect();
    Things::embedded().is_related(kind, &stems.join(" "), &[Relation::Same, Relation::Broader])
}

/// The parts of a thing labelled `label` that a prompt names and whose heights are known, in the order of the prompt. Where the
/// label tells nothing of its kind, it is the first of the list that has such a part.
///
/// # Errors
/// [`LanguageError::BadData`] when the embedded list is malformed.
pub fn said_parts(words: &[Word], label: &str) -> Result<Vec<SaidPart>, LanguageError> {
    let (parts, label) = (Parts::embedded()?, tokenize(label));
    let all = || parts.0.values().flatten().map(|(_, part)| part);
    let is_known = all().any(|part| part.place.heights_percent.is_some() && part.is_of(&label));
    let fits = |part: &Part| part.place.heights_percent.is_some() && (!is_known || part.is_of(&label));
    let mut said: Vec<SaidPart> = Vec::new();
    for end in 1..=words.len() {
        let Some((len, place)) = parts.first(&words[..end], &fits) else { continue };
        let named = &words[end - len..end];
        let is_label = label.iter().any(|word| word.text.ends_with(&named[len - 1].text));
        // `At eye level` is how high a camera is, and the `eye sockets` are no eye.
        let is_more = words.get(end).is_some_and(|next| is_listed("level height sockets socket holes", &next.text));
        if !is_label && !is_more {
            // The `seat cushion` is no seat.
            said.retain(|before| before.words.end <= end - len);
            let name: Vec<&str> = named.iter().map(|word| word.text.as_str()).collect();
            said.push(SaidPart { name: name.join(" "), words: end - len..end, place });
        }
    }
    Ok(said)
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
    fn parts_of_known_heights_are_found_in_a_prompt() {
        let names = |prompt: &str, label: &str| -> Vec<String> {
            said_parts(&tokenize(prompt), label).unwrap().into_iter().map(|part| part.name).collect()
        };
        assert_eq!(names("rise from the carved feet to the crest", "armchair"), ["feet", "crest"]);
        assert_eq!(names("push in on the seat cushion", "armchair"), ["seat cushion"]);
        // Whatever the thing is, it is what has such parts.
        assert_eq!(names("close on one of the padded arms", "large cream object"), ["arms"]);
        assert_eq!(names("at eye level, toward the eye sockets", "skull"), ["eye sockets"]);
        assert_eq!(names("orbit the crest", "crest"), Vec::<String>::new());
        assert_eq!(names("close on the lid", "guitar"), Vec::<String>::new());
        let [boots] = &said_parts(&tokenize("boots first, then him"), "man").unwrap()[..] else { panic!() };
        assert_eq!((boots.words.clone(), boots.place.heights_percent), (0..1, Some([0, 14])));
        let parse = |text| Parts::parse(text).map(|_| ());
        assert!(parse("top small 80..100 of jug | lid\n").is_ok());
        for bad in ["top 90..80 | lid\n", "top 0..101 | lid\n", "top tiny | lid\n", "lid\n"] {
            assert!(parse(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn a_part_of_a_thing_is_told_from_the_thing() {
        let place = |words: &str, label: &str| part_of(words, label).unwrap().map(|part| part.place);
        assert_eq!(place("the headstock", "electric guitar"), Some("top"));
        assert_eq!(place("the guitar's bridge", "electric guitar"), Some("bottom"));
        assert_eq!(place("the front", "armchair"), Some("front"));
        assert_eq!(place("its pot", "palm tree"), Some("bottom"));
        assert_eq!(place("the lamp shade", "lamp shade"), None);
        assert_eq!(place("the white seat", "white armchair"), None);
        assert_eq!(place("the chair seat", "white chair"), Some("front"));
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

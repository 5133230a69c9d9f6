//! Heights of the camera in words: `at knee height`, `from a cat's point of view`, `aerial`.
//!
//! `prompts/heights.txt` lists the names and describes its own format.

use std::collections::BTreeMap;
use std::sync::OnceLock;

use crate::error::LanguageError;
use crate::linked::Linked;
use crate::list_lines::list_lines;

const FILE: &str = "prompts/heights.txt";
static TEXT: &str = include_str!("../../prompts/heights.txt");

/// A height that words state.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SpokenHeight {
    /// Above the floor, meters.
    Meters(f64),
    /// From the air, which is no height of its own.
    Air,
}

/// The names of the list, by their first words: the other words, and the height. Longest first.
type Names = BTreeMap<&'static str, Vec<(Vec<&'static str>, SpokenHeight)>>;

#[derive(Debug, Default)]
struct Heights {
    /// What stands before `height`.
    levels: Names,
    /// Whose eyes the camera looks through.
    eyes: Names,
}

/// Words behind a level.
const LEVELS: [&str; 3] = ["height", "level", "heights"];
/// Words behind what is as high as a level, and words before it.
const HIGH: &str = "high";
const BEFORE_HIGH: [&str; 9] = ["at", "from", "camera", "cam", "lens", "about", "roughly", "around", "down"];
/// Words of a view through somebody's eyes, behind `cat's`.
const VIEWS: [&[&str]; 16] = [
    &["eye", "view"],
    &["eyes", "view"],
    &["eye", "level"],
    &["eye", "height"],
    &["eye", "perspective"],
    &["point", "of", "view"],
    &["angle", "of", "view"],
    &["pov"],
    &["perspective"],
    &["view"],
    &["viewpoint"],
    &["vantage", "point"],
    &["vantage"],
    &["height"],
    &["level"],
    &["eyes"],
];
/// Words of a view before `of a cat`, and words by which somebody is the camera.
const VIEWS_OF: [&[&str]; 20] = [
    &["the", "way"],
    &["how"],
    &["point", "of", "view", "of"],
    &["pov", "of"],
    &["perspective", "of"],
    &["viewpoint", "of"],
    &["view", "of"],
    &["eyes", "of"],
    &["height", "of"],
    &["level", "of"],
    &["eye", "level", "of"],
    &["seen", "by"],
    &["viewed", "by"],
    &["you", "are"],
    &["you", "'re"],
    &["you", "were"],
    &["be"],
    &["we", "are"],
    &["i", "am"],
    &["as"],
];
/// Words behind `as a cat`, without which it is no view: `as a cat sees it`.
const SEES: [&str; 12] = [
    "sees",
    "would",
    "might",
    "see",
    "looks",
    "does",
    "experiences",
    "could",
    "walking",
    "sitting",
    "standing",
    "when",
];
const ARTICLES: [&str; 6] = ["a", "an", "the", "some", "any", "one"];
/// Words between an article and a being.
const TELLS: [&str; 12] =
    ["small", "little", "young", "tiny", "curious", "old", "big", "sleepy", "hungry", "scared", "typical", "shy"];
/// What is seen from the air without the name of anybody who flies.
const AIR: [&[&str]; 9] = [
    &["aerial"],
    &["aerials"],
    &["from", "the", "air"],
    &["from", "the", "sky"],
    &["from", "up", "in", "the", "air"],
    &["from", "high", "up", "in", "the", "air"],
    &["drone", "shot"],
    &["drone", "footage"],
    &["helicopter", "shot"],
];
/// Verbs and places of what is close above the ground.
const SKIMS: [&str; 11] =
    ["skim", "skims", "skimming", "hug", "hugs", "hugging", "graze", "grazing", "shave", "shaving", "brushing"];
const GROUNDS: [&str; 12] =
    ["floor", "ground", "carpet", "floorboards", "grass", "deck", "pavement", "tiles", "sand", "tarmac", "rug", "lawn"];
/// Height of a camera that skims the floor, meters.
const SKIM_METERS: f64 = 0.1;

impl Heights {
    fn embedded() -> Result<&'static Self, LanguageError> {
        static HEIGHTS: OnceLock<Result<Heights, LanguageError>> = OnceLock::new();
        HEIGHTS.get_or_init(|| Self::parse(TEXT)).as_ref().map_err(Clone::clone)
    }

    fn parse(text: &'static str) -> Result<Self, LanguageError> {
        let mut heights = Self::default();
        for (number, line) in list_lines(text) {
            let bad = || LanguageError::BadData {
                file: FILE,
                line: number,
                what: "expected \"level METERS | name, name\" or \"eyes METERS | name, name\"".to_owned(),
            };
            let (head, names) = line.split_once(" | ").ok_or_else(bad)?;
            let (kind, value) = head.split_once(' ').ok_or_else(bad)?;
            let height = match value.parse() {
                Ok(meters) => SpokenHeight::Meters(meters),
                Err(_) if value == "sky" => SpokenHeight::Air,
                Err(_) => return Err(bad()),
            };
            let list = match kind {
                "level" => &mut heights.levels,
                "eyes" => &mut heights.eyes,
                _ => return Err(bad()),
            };
            for name in names.split(", ") {
                let mut words = name.split(' ');
                let first = words.next().filter(|word| !word.is_empty()).ok_or_else(bad)?;
                list.entry(first).or_default().push((words.collect(), height));
            }
        }
        for names in heights.levels.values_mut().chain(heights.eyes.values_mut()) {
            names.sort_by_key(|(rest, _)| std::cmp::Reverse(rest.len()));
        }
        Ok(heights)
    }

    /// The height that begins at word `at`: the word after it, and the height.
    fn height_at(&self, words: &[&str], at: usize) -> Option<(usize, SpokenHeight)> {
        let rest = &words[at..];
        if let Some(said) = AIR.iter().find(|said| rest.starts_with(said)) {
            return Some((at + said.len(), SpokenHeight::Air));
        }
        if SKIMS.contains(&words[at]) {
            let ground = rest.iter().skip(1).take(3).position(|word| GROUNDS.contains(word))?;
            let passes =
                rest[1..=ground].iter().all(|word| matches!(*word, "the" | "along" | "over" | "just" | "across"));
            return passes.then_some((at + 2 + ground, SpokenHeight::Meters(SKIM_METERS)));
        }
        self.level_at(words, at).or_else(|| self.eyes_at(words, at))
    }

    /// `knee height`, `at waist level`, `the height of the knees`.
    fn level_at(&self, words: &[&str], at: usize) -> Option<(usize, SpokenHeight)> {
        if let Some((end, height)) = found_in(&self.levels, words, at) {
            let owned = end + usize::from(words.get(end) == Some(&"'s"));
            let next = words.get(owned).copied().unwrap_or_default();
            let before = at.checked_sub(1).map_or(",", |before| words[before]);
            let is_high = next == HIGH && (BEFORE_HIGH.contains(&before) || !before.contains(char::is_alphabetic));
            return (LEVELS.contains(&next) || is_high).then_some((owned + 1, height));
        }
        let is_of = matches!(words[at], "height" | "level") && words.get(at + 1) == Some(&"of");
        let next =
            at + 2 + usize::from(words.get(at + 2).is_some_and(|word| ARTICLES.contains(word) || is_owner(word)));
        found_in(&self.levels, words, next).filter(|_| is_of)
    }

    /// `a cat's point of view`, `as seen by a toddler`, `you are a mouse`.
    fn eyes_at(&self, words: &[&str], at: usize) -> Option<(usize, SpokenHeight)> {
        if let Some((end, height)) = found_in(&self.eyes, words, at) {
            let owned = end + usize::from(matches!(words.get(end), Some(&("'s" | "'"))));
            let view = VIEWS.iter().find(|view| words.get(owned..).is_some_and(|rest| rest.starts_with(view)))?;
            return Some((owned + view.len(), height));
        }
        let said = VIEWS_OF.iter().find(|said| words[at..].starts_with(said))?;
        let is_told = |word: &&&str| ARTICLES.contains(*word) || TELLS.contains(*word);
        let tells = words[at + said.len()..].iter().take(3).take_while(is_told).count();
        let (end, height) = found_in(&self.eyes, words, at + said.len() + tells)?;
        let sees = || words[end..].iter().take(2).any(|word| SEES.contains(word));
        let is_compared = matches!(said.last(), Some(&("as" | "way" | "how")));
        // `You are a seagull` says how it flies.
        let is_persona = matches!(said[0], "you" | "we" | "i" | "be") && height == SpokenHeight::Air;
        let is_view = tells > 0 && (!is_compared || sees()) && !is_persona;
        is_view.then_some((end, height))
    }
}

fn is_owner(word: &str) -> bool {
    matches!(word, "my" | "your" | "his" | "her" | "their" | "our")
}

/// The name that begins at word `at`: the word after it, and its height.
fn found_in(names: &Names, words: &[&str], at: usize) -> Option<(usize, SpokenHeight)> {
    let rest = words.get(at + 1..)?;
    // `Chair-seat height`.
    let hyphen = usize::from(rest.first() == Some(&"-"));
    let begins = |name: &[&str]| {
        if rest.starts_with(name) { Some(0) } else { rest[hyphen..].starts_with(name).then_some(hyphen) }
    };
    let (len, height) = names.get(words[at])?.iter().find_map(|(name, height)| {
        begins(name).filter(|skipped| *skipped == 0 || !name.is_empty()).map(|skipped| (name.len() + skipped, height))
    })?;
    Some((at + 1 + len, *height))
}

impl Linked {
    /// The heights of the camera that the words name, each with the range of its words.
    ///
    /// # Errors
    /// [`LanguageError::BadData`] when the embedded list is malformed.
    pub fn spoken_heights(&self) -> Result<Vec<([usize; 2], SpokenHeight)>, LanguageError> {
        let heights = Heights::embedded()?;
        let words: Vec<&str> = self.tokens_text.split(' ').collect();
        let (mut found, mut at) = (Vec::new(), 0);
        while at < words.len() {
            let height = heights.height_at(&words, at);
            found.extend(height.map(|(end, height)| ([at, end], height)));
            at = height.map_or(at + 1, |(end, _)| end);
        }
        Ok(found)
    }
}

/// Whether a word names a piece of furniture or a body whose height is known, so that `table height` need not be about a
/// table of the scene.
pub(super) fn is_level_name(word: &str) -> bool {
    Heights::embedded().is_ok_and(|heights| {
        heights.levels.get(word).is_some_and(|names| names.iter().any(|(rest, _)| rest.is_empty()))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn heights(text: &str) -> Vec<SpokenHeight> {
        let linked = Linked { tokens_text: text.to_owned(), ..Linked::default() };
        linked.spoken_heights().unwrap().into_iter().map(|(_, height)| height).collect()
    }

    #[test]
    fn heights_are_known_by_bodies_furniture_and_eyes() {
        for (text, meters) in [
            ("push in at knee height", 0.5),
            ("boom up from chair - seat height", 0.45),
            ("camera waist high , push in", 1.0),
            ("at table level", 0.75),
            ("from the height of your hips", 0.95),
            ("from a cat 's point of view", 0.25),
            ("a small child 's eye view of <obj-0>", 1.1),
            ("through the eyes of a little mouse", 0.05),
            ("as seen by a toddler", 0.8),
            ("as a dog would see it", 0.5),
            ("the way a child would see it", 1.1),
            ("imagine you are a mouse", 0.05),
            ("from the perspective of a seated person", 1.2),
            ("skim along the floor", 0.1),
        ] {
            assert_eq!(heights(text), [SpokenHeight::Meters(meters)], "{text}");
        }
        assert_eq!(heights("aerial orbit , then a drone 's eye view"), [SpokenHeight::Air; 2]);
    }

    #[test]
    fn other_heights_are_not() {
        for text in [
            "frame <obj-0> waist high",
            "like a cat",
            "as a child",
            "the knee of <obj-0>",
            "hug the wall",
            "you are a gull",
        ] {
            assert_eq!(heights(text), [], "{text}");
        }
    }

    #[test]
    fn damage_is_named_by_its_line() {
        for text in ["level 0.5 knee", "level x | knee", "legs 0.5 | knee", "level 0.5 | "] {
            assert!(Heights::parse(text).unwrap_err().to_string().contains("line 1"), "{text}");
        }
    }
}

//! The lexicon file: lists of adjectives, nouns, synonyms, camera words. `prompts/lexicon.txt` describes its
//! own format.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::OnceLock;

use strum::VariantArray;

use super::error::LanguageError;
use super::list_lines::list_lines;
use super::tokenizer::{Word, tokenize};

const FILE: &str = "prompts/lexicon.txt";
static TEXT: &str = include_str!("../../prompts/lexicon.txt");

/// Word lists that distinguish the names of objects from the language of shots.
#[derive(Debug, Default)]
pub struct Lexicon {
    pub(crate) determiners: BTreeSet<String>,
    pub(crate) adjectives: BTreeSet<String>,
    /// Names of objects, as written in the file.
    nouns: Vec<String>,
    /// Stems of the last words of `nouns`.
    pub(crate) noun_heads: BTreeSet<String>,
    /// A name (stems, separated by spaces) to the names of the same meaning.
    pub(crate) synonyms: BTreeMap<String, BTreeSet<String>>,
    pub(crate) camera: BTreeSet<String>,
    scene: BTreeSet<String>,
    pub(crate) function: BTreeSet<String>,
}

/// A list of words of the lexicon.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[derive(strum::VariantArray)]
pub enum WordList {
    /// `the`, `my`.
    Determiners,
    /// `red`, `wooden`.
    Adjectives,
    /// Last words of the names of things.
    Nouns,
    /// Words of film and camera.
    Camera,
    /// Places and surroundings.
    Scene,
    /// Function words.
    Function,
}

/// A `[section]` of the file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[derive(strum::EnumString)]
#[strum(serialize_all = "lowercase")]
enum Section {
    Determiners,
    Adjectives,
    Nouns,
    Synonyms,
    Camera,
    Scene,
    Function,
}

impl Lexicon {
    /// The lexicon that the program ships, read once.
    ///
    /// # Errors
    /// [`LanguageError::BadData`] when the embedded file has an unknown section or an entry before any section.
    pub fn embedded() -> Result<&'static Self, LanguageError> {
        static LEXICON: OnceLock<Result<Lexicon, LanguageError>> = OnceLock::new();
        LEXICON.get_or_init(|| Self::parse(TEXT)).as_ref().map_err(Clone::clone)
    }

    /// Adjectives that may qualify an object (`red`, `wooden`), in alphabetical order.
    pub fn adjectives(&self) -> impl ExactSizeIterator<Item = &str> {
        self.adjectives.iter().map(String::as_str)
    }

    /// Names of things that scenes hold (`armchair`, `coffee table`), in the order of the file.
    pub fn nouns(&self) -> &[String] {
        &self.nouns
    }

    /// Words of film and camera, and function words.
    pub(crate) fn shot_words(&self) -> impl Iterator<Item = &str> {
        self.camera.iter().chain(&self.function).map(String::as_str)
    }

    fn parse(text: &str) -> Result<Self, LanguageError> {
        let mut lexicon = Self::default();
        let mut section = None;
        for (number, line) in list_lines(text) {
            let bad = |what: String| LanguageError::BadData { file: FILE, line: number, what };
            if let Some(name) = line.strip_prefix('[').and_then(|rest| rest.strip_suffix(']')) {
                section = Some(name.parse().map_err(|_| bad(format!("unknown section \"{name}\"")))?);
            } else {
                let section = section.ok_or_else(|| bad("an entry before any section".to_owned()))?;
                lexicon.add(section, line);
            }
        }
        Ok(lexicon)
    }

    fn add(&mut self, section: Section, line: &str) {
        let entries = || line.split(',').map(str::trim).filter(|entry| !entry.is_empty());
        let words = || entries().flat_map(tokenize).map(|word| word.text);
        match section {
            Section::Determiners => self.determiners.extend(words()),
            Section::Adjectives => self.adjectives.extend(words()),
            Section::Camera => self.camera.extend(words()),
            Section::Scene => self.scene.extend(words()),
            Section::Function => self.function.extend(words()),
            Section::Nouns => {
                self.nouns.extend(entries().map(str::to_owned));
                self.noun_heads.extend(entries().filter_map(last_stem));
            }
            Section::Synonyms => self.add_synonyms(&entries().map(stems).collect::<Vec<_>>()),
        }
    }

    fn add_synonyms(&mut self, group: &[String]) {
        for name in group {
            let others = group.iter().filter(|other| *other != name).cloned();
            self.synonyms.entry(name.clone()).or_default().extend(others);
        }
    }

    /// The lists that hold a word, one flag per [`WordList`].
    pub fn lists_of(&self, word: &Word) -> [bool; WordList::VARIANTS.len()] {
        let text = &word.text;
        [
            self.determiners.contains(text),
            self.adjectives.contains(text),
            self.noun_heads.contains(&word.stem),
            self.camera.contains(text),
            self.scene.contains(text),
            self.function.contains(text),
        ]
    }

    /// Whether the word belongs to the language of shots rather than to the names of objects.
    pub(crate) fn is_shot_language(&self, word: &str) -> bool {
        self.camera.contains(word)
            || self.scene.contains(word)
            || self.function.contains(word)
            || self.determiners.contains(word)
            || self.adjectives.contains(word)
    }
}

fn stems(entry: &str) -> String {
    tokenize(entry).into_iter().map(|word| word.stem).collect::<Vec<_>>().join(" ")
}

fn last_stem(entry: &str) -> Option<String> {
    tokenize(entry).pop().map(|word| word.stem)
}

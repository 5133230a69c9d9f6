use std::collections::{BTreeMap, BTreeSet};
use std::sync::OnceLock;

use super::LanguageError;
use super::words::words;

const FILE: &str = "prompts/lexicon.txt";
static TEXT: &str = include_str!("../../prompts/lexicon.txt");

/// Word lists: what may qualify an object, what is camera talk, what is scenery, which words mean the same thing.
#[derive(Debug, Default)]
pub struct Lexicon {
    pub determiners: BTreeSet<String>,
    pub adjectives: BTreeSet<String>,
    /// Names of things, as written.
    pub nouns: Vec<String>,
    /// Single words that head a name of a thing.
    pub noun_heads: BTreeSet<String>,
    /// Name (stems, parted by spaces) to the names of the same meaning.
    pub synonyms: BTreeMap<String, BTreeSet<String>>,
    pub camera: BTreeSet<String>,
    pub scene: BTreeSet<String>,
    pub function: BTreeSet<String>,
    /// Name of an effect and a wording for it as words; longest wordings first.
    pub effects: Vec<(String, Vec<String>)>,
}

impl Lexicon {
    /// The lexicon that the program ships, read once.
    ///
    /// # Errors
    /// [`LanguageError::BadData`] when the embedded file has a section that nobody knows.
    pub fn embedded() -> Result<&'static Self, LanguageError> {
        static LEXICON: OnceLock<Result<Lexicon, LanguageError>> = OnceLock::new();
        LEXICON.get_or_init(|| Self::parse(TEXT)).as_ref().map_err(Clone::clone)
    }

    fn parse(text: &str) -> Result<Self, LanguageError> {
        let mut lexicon = Self::default();
        let mut section = String::new();
        for (index, line) in text.lines().enumerate() {
            let line = line.trim();
            if line.is_empty() || line.starts_with('#') {
                continue;
            }
            if let Some(name) = line.strip_prefix('[').and_then(|rest| rest.strip_suffix(']')) {
                name.clone_into(&mut section);
            } else if !lexicon.take(&section, line) {
                return Err(LanguageError::BadData { file: FILE, line: index + 1, what: format!("section {section}") });
            }
        }
        lexicon.effects.sort_by_key(|(_, wording)| std::cmp::Reverse(wording.len()));
        Ok(lexicon)
    }

    fn take(&mut self, section: &str, line: &str) -> bool {
        let entries = || line.split(',').map(str::trim).filter(|entry| !entry.is_empty());
        let singles = || entries().flat_map(words).map(|word| word.text);
        match section {
            "determiners" => self.determiners.extend(singles()),
            "adjectives" => self.adjectives.extend(singles()),
            "camera" => self.camera.extend(singles()),
            "scene" => self.scene.extend(singles()),
            "function" => self.function.extend(singles()),
            "nouns" => {
                self.nouns.extend(entries().map(str::to_owned));
                self.noun_heads.extend(entries().filter_map(last_stem));
            }
            "synonyms" => self.take_synonyms(&entries().map(stems).collect::<Vec<_>>()),
            "effects" => return self.take_effects(line),
            _ => return false,
        }
        true
    }

    fn take_synonyms(&mut self, group: &[String]) {
        for name in group {
            let others = group.iter().filter(|other| *other != name).cloned();
            self.synonyms.entry(name.clone()).or_default().extend(others);
        }
    }

    fn take_effects(&mut self, line: &str) -> bool {
        let Some((name, wordings)) = line.split_once(':') else { return false };
        let wordings = wordings.split(',').map(|w| words(w).into_iter().map(|word| word.text).collect::<Vec<_>>());
        self.effects.extend(wordings.filter(|w| !w.is_empty()).map(|w| (name.trim().to_owned(), w)));
        true
    }

    /// Whether the word belongs to the language of shots rather than to the scene's things.
    pub fn is_talk(&self, word: &str) -> bool {
        self.camera.contains(word)
            || self.scene.contains(word)
            || self.function.contains(word)
            || self.determiners.contains(word)
            || self.adjectives.contains(word)
    }
}

fn stems(entry: &str) -> String {
    words(entry).into_iter().map(|word| word.stem).collect::<Vec<_>>().join(" ")
}

fn last_stem(entry: &str) -> Option<String> {
    words(entry).pop().map(|word| word.stem)
}

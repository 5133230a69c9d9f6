//! Misspelled words of command: `utnil`, `pnn`, `crain`.
//!
//! Only a word that is no English word is mended, only into a word of the language of shots, and only if one such word
//! is nearest: one edit, or two in words of eight letters and more.

use std::collections::BTreeSet;
use std::sync::OnceLock;

use crate::edit_distance::edit_distance;
use crate::error::LanguageError;
use crate::inflection::stem;
use crate::known_words::KnownWords;
use crate::lexicon::Lexicon;
use crate::things::Things;

static ENGLISH: &str = include_str!("../../../prompts/english.txt");

/// Least letters of a word that is mended.
const MIN_LETTERS: usize = 3;
/// Least letters of a word in which two edits are mended.
const LONG_LETTERS: usize = 8;

/// The words that spelling knows.
#[derive(Debug)]
pub(super) struct Spelling {
    /// In lexical order.
    english: Vec<&'static str>,
    /// Words of command.
    commands: Vec<&'static str>,
}

impl Spelling {
    /// The lists that the program ships, read once.
    pub(super) fn embedded() -> Result<&'static Self, LanguageError> {
        static SPELLING: OnceLock<Result<Spelling, LanguageError>> = OnceLock::new();
        SPELLING.get_or_init(Self::read).as_ref().map_err(Clone::clone)
    }

    fn read() -> Result<Self, LanguageError> {
        let lexicon = Lexicon::embedded()?;
        let english: Vec<&str> = ENGLISH.lines().filter(|line| !line.starts_with('#')).collect();
        let is_english = |word: &&str| english.binary_search(word).is_ok();
        let shots = lexicon.shot_words().chain(KnownWords::embedded().plain());
        let commands: BTreeSet<&str> = shots.filter(|word| word.len() >= MIN_LETTERS).filter(is_english).collect();
        let commands = commands.into_iter().collect();
        Ok(Self { english, commands })
    }

    /// The word that a misspelled word of command means.
    pub(super) fn mended(&self, word: &str) -> Option<&'static str> {
        let letters = word.len();
        if letters < MIN_LETTERS || !word.bytes().all(|byte| byte.is_ascii_lowercase()) || self.is_known(word) {
            return None;
        }
        let most = if letters >= LONG_LETTERS { 2 } else { 1 };
        nearest(word, self.commands.iter().copied(), most)
    }

    /// The known word that a word with a letter three times in a row means, which no English word has: `sloooow`, `tellly`.
    pub(super) fn shortened(&self, word: &str) -> Option<String> {
        let letters: Vec<char> = word.chars().collect();
        let is_run = |at: usize| at > 1 && letters[at] == letters[at - 1] && letters[at] == letters[at - 2];
        if !word.bytes().all(|byte| byte.is_ascii_lowercase()) || !(0..letters.len()).any(is_run) {
            return None;
        }
        // Each run with as many letters as a word may have, two or one.
        let with = |most: usize| -> String {
            let runs = letters.chunk_by(|a, b| a == b);
            runs.flat_map(|run| run.iter().take(if run.len() > 2 { most } else { run.len() })).collect()
        };
        [2, 1].into_iter().map(with).find(|word| word.len() >= MIN_LETTERS && self.is_known(word))
    }

    /// The word of a name that a misspelled word means: one that is no English word, and near to one of `names` only.
    pub(super) fn mended_name<'a>(&self, word: &str, names: &'a BTreeSet<String>) -> Option<&'a str> {
        let letters = word.len();
        if letters <= MIN_LETTERS + 1 || !word.bytes().all(|byte| byte.is_ascii_lowercase()) || self.is_known(word) {
            return None;
        }
        let most = if letters >= LONG_LETTERS - 1 { 2 } else { 1 };
        let long = names.iter().map(String::as_str).filter(|name| name.is_ascii() && name.len() > MIN_LETTERS);
        nearest(word, long, most)
    }

    /// Whether a word is an English one, or of the language of shots.
    pub(super) fn is_known(&self, word: &str) -> bool {
        self.english.binary_search(&word).is_ok()
            || KnownWords::embedded().contains(word)
            || Things::embedded().roles(word) != 0
            || Lexicon::embedded()
                .is_ok_and(|lexicon| lexicon.is_shot_language(word) || lexicon.noun_heads.contains(word))
    }
}

/// The word at most `most` edits from `word`, if no other is as near. Nobody slips at the first letter, unless two
/// change places.
fn nearest<'a>(word: &str, known: impl Iterator<Item = &'a str>, most: usize) -> Option<&'a str> {
    let letters = word.len();
    let is_like = |known: &&str| {
        known.len().abs_diff(letters) <= most
            && (known.as_bytes()[0] == word.as_bytes()[0] || is_swap(word, known))
            && (letters > MIN_LETTERS || known.len() > letters || is_swap(word, known))
    };
    let ranked = known.filter(is_like).map(|known| ((edit_distance(word, known), !is_swap(word, known)), known));
    let mut found: Vec<_> = ranked.filter(|((distance, _), _)| *distance <= most).collect();
    found.sort_unstable();
    match found[..] {
        [] => None,
        // `degres` is as near to `degree` as to `degrees`: one word in two forms.
        [(first, known), ..] => {
            let mut as_near = found.iter().take_while(|(rank, _)| *rank == first);
            as_near.all(|(_, other)| stem(other) == stem(known)).then_some(known)
        }
    }
}

/// Whether the words have the same letters.
fn is_swap(word: &str, command: &str) -> bool {
    let sorted = |word: &str| {
        let mut bytes = word.as_bytes().to_vec();
        bytes.sort_unstable();
        bytes
    };
    word.len() == command.len() && sorted(word) == sorted(command)
}

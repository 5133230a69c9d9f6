//! Misspelled words of command: `utnil`, `pnn`, `crain`.
//!
//! Only a word that is no English word is mended, only into a word of the language of shots, and only if one such word is
//! nearest: one edit, or two in words of eight letters and more.

use std::collections::BTreeSet;
use std::sync::OnceLock;

use crate::edit_distance::edit_distance;
use crate::error::LanguageError;
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
        // Nobody slips at the first letter, unless two change places.
        let is_like = |command: &&&str| {
            command.len().abs_diff(letters) <= most
                && (command.as_bytes()[0] == word.as_bytes()[0] || is_swap(word, command))
                && (letters > MIN_LETTERS || command.len() > letters || is_swap(word, command))
        };
        let ranked = self.commands.iter().filter(is_like).map(|command| {
            let rank = (edit_distance(word, command), !is_swap(word, command));
            (rank, *command)
        });
        let mut found: Vec<_> = ranked.filter(|((distance, _), _)| *distance <= most).collect();
        found.sort_unstable();
        match found[..] {
            [] => None,
            [(first, command), (second, _), ..] => (first < second).then_some(command),
            [(_, command)] => Some(command),
        }
    }

    fn is_known(&self, word: &str) -> bool {
        self.english.binary_search(&word).is_ok()
            || KnownWords::embedded().contains(word)
            || Things::embedded().roles(word) != 0
            || Lexicon::embedded()
                .is_ok_and(|lexicon| lexicon.is_shot_language(word) || lexicon.noun_heads.contains(word))
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

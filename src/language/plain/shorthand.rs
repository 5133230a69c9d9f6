//! The shorthand file: what people write for what they mean. `prompts/shorthand.txt` describes its own format.

use std::collections::BTreeMap;
use std::sync::OnceLock;

use crate::error::LanguageError;
use crate::list_lines::list_lines;
use crate::tokenizer::{Word, tokenize};

const FILE: &str = "prompts/shorthand.txt";
static TEXT: &str = include_str!("../../../prompts/shorthand.txt");

/// The entries of the file.
#[derive(Debug, Default)]
pub(super) struct Shorthand {
    /// By the first word: entries, longest first.
    entries: BTreeMap<String, Vec<Entry>>,
}

#[derive(Debug)]
struct Entry {
    /// Each word, and whether it must be in capitals.
    written: Vec<(String, bool)>,
    meaning: Vec<String>,
}

impl Shorthand {
    /// The list that the program ships, read once.
    pub(super) fn embedded() -> Result<&'static Self, LanguageError> {
        static SHORTHAND: OnceLock<Result<Shorthand, LanguageError>> = OnceLock::new();
        SHORTHAND.get_or_init(|| Self::parse(TEXT)).as_ref().map_err(Clone::clone)
    }

    fn parse(text: &str) -> Result<Self, LanguageError> {
        let mut shorthand = Self::default();
        for (number, line) in list_lines(text) {
            let bad = || LanguageError::BadData {
                file: FILE,
                line: number,
                what: "expected \"written | meaning\", found no word".to_owned(),
            };
            let (written, meaning) = line.split_once('|').unwrap_or((line, line));
            let written: Vec<(String, bool)> =
                tokenize(written).into_iter().map(|word| (word.text, is_capital(written, word.span))).collect();
            let meaning = tokenize(meaning).into_iter().map(|word| word.text).collect();
            let first = written.first().ok_or_else(bad)?.0.clone();
            shorthand.entries.entry(first).or_default().push(Entry { written, meaning });
        }
        for entries in shorthand.entries.values_mut() {
            entries.sort_by_key(|entry| std::cmp::Reverse(entry.written.len()));
        }
        Ok(shorthand)
    }

    /// The longest entry that the words from word `i` match: its number of words, and its meaning.
    pub(super) fn match_at(&self, prompt: &str, words: &[Word], i: usize) -> Option<(usize, &[String])> {
        let entries = self.entries.get(&words.get(i)?.text)?;
        let is_match = |entry: &&Entry| {
            let inside = words.get(i..i + entry.written.len());
            inside.is_some_and(|inside| {
                let mut pairs = inside.iter().zip(&entry.written);
                pairs.all(|(word, (text, capital))| word.text == *text && (!capital || is_capital(prompt, word.span)))
            })
        };
        entries.iter().find(is_match).map(|entry| (entry.written.len(), entry.meaning.as_slice()))
    }
}

/// Whether all letters of these bytes are capitals, and there is one.
fn is_capital(text: &str, span: [usize; 2]) -> bool {
    let mut letters = text.get(span[0]..span[1]).unwrap_or_default().chars().filter(|c| c.is_alphabetic()).peekable();
    letters.peek().is_some() && letters.all(char::is_uppercase)
}

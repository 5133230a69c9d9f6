//! The list of senses. `prompts/senses.txt` describes its own format.

use std::collections::BTreeMap;
use std::sync::OnceLock;

use super::set::{MAX_SENSES, Senses};
use crate::error::LanguageError;
use crate::inflection::bases;
use crate::list_lines::list_lines;
use crate::tokenizer::tokenize;

const FILE: &str = "prompts/senses.txt";
static TEXT: &str = include_str!("../../../prompts/senses.txt");

/// The senses of the file.
#[derive(Debug, Default)]
pub(super) struct Table {
    names: Vec<String>,
    /// Words and phrases by their first word, longest first.
    entries: BTreeMap<String, Vec<Entry>>,
}

#[derive(Debug)]
struct Entry {
    /// The words after the first.
    rest: Vec<String>,
    senses: Senses,
}

impl Table {
    /// The list that the program ships, read once.
    pub(super) fn embedded() -> Result<&'static Self, LanguageError> {
        static TABLE: OnceLock<Result<Table, LanguageError>> = OnceLock::new();
        TABLE.get_or_init(|| Self::parse(TEXT)).as_ref().map_err(Clone::clone)
    }

    pub(super) fn names(&self) -> &[String] {
        &self.names
    }

    /// Reads a list: `@name meaning` declares a sense, `words: name name` gives words their senses, and
    /// `word:` keeps a word from those of a verb that it looks like a form of (`flower`, `flow`).
    pub(super) fn parse(text: &str) -> Result<Self, LanguageError> {
        let mut table = Self::default();
        for (number, line) in list_lines(text) {
            let bad = |what| LanguageError::BadData { file: FILE, line: number, what };
            table.take_line(line).map_err(bad)?;
        }
        for entries in table.entries.values_mut() {
            entries.sort_by_key(|entry| std::cmp::Reverse(entry.rest.len()));
        }
        Ok(table)
    }

    fn take_line(&mut self, line: &str) -> Result<(), String> {
        if let Some(declared) = line.strip_prefix('@') {
            let name = declared.split(' ').next().unwrap_or_default();
            if self.names.len() == MAX_SENSES {
                return Err(format!("more than {MAX_SENSES} senses"));
            }
            if name.is_empty() || self.names.iter().any(|known| known == name) {
                return Err("a sense has no name, or the name of another".to_owned());
            }
            self.names.push(name.to_owned());
            return Ok(());
        }
        let (words, senses) = line
            .split_once(": ")
            .or_else(|| line.strip_suffix(':').map(|words| (words, "")))
            .ok_or("expected \"words: sense sense\", \"word:\" or \"@sense meaning\"")?;
        let mut words = words_of(words).into_iter();
        let first = words.next().ok_or("senses without a word")?;
        let rest: Vec<String> = words.collect();
        let mut set = Senses::default();
        for name in senses.split_whitespace() {
            let index = self.names.iter().position(|known| known == name);
            set = set.with(index.ok_or_else(|| format!("the sense `{name}` is not declared"))?);
        }
        let entries = self.entries.entry(first).or_default();
        if entries.iter().any(|entry| entry.rest == rest) {
            return Err("these words have senses already".to_owned());
        }
        entries.push(Entry { rest, senses: set });
        Ok(())
    }

    /// The senses of each word.
    pub(super) fn senses(&self, words: &[&str]) -> Vec<Senses> {
        let mut senses = vec![Senses::default(); words.len()];
        let mut at = 0;
        while at < words.len() {
            let found = self.found_at(&words[at..]);
            let length = found.map_or(1, |entry| 1 + entry.rest.len());
            let of_words = found.map(|entry| entry.senses).unwrap_or_default();
            senses[at..at + length].fill(of_words);
            at += length;
        }
        senses
    }

    /// The longest entry with which the words begin. The first word may be inflected; as it stands it comes first.
    fn found_at(&self, words: &[&str]) -> Option<&Entry> {
        let (first, rest) = words.split_first()?;
        let fits = |entry: &&Entry| {
            entry.rest.len() <= rest.len() && entry.rest.iter().zip(rest).all(|(known, word)| known == word)
        };
        let is_plain = |entry: &Entry| entry.rest.is_empty() && entry.senses == Senses::default();
        let is_thing = self.entries.get(*first).is_some_and(|entries| entries.iter().any(is_plain));
        let bases = if is_thing { Vec::new() } else { bases(first) };
        let candidates = std::iter::once((*first).to_owned()).chain(bases);
        let found: Vec<&Entry> = candidates.filter_map(|base| self.entries.get(&base)?.iter().find(fits)).collect();
        let longest = found.iter().map(|entry| entry.rest.len()).max()?;
        found.into_iter().find(|entry| entry.rest.len() == longest)
    }
}

/// The words of an entry. Plain lower-case words, which nearly all are, need no tokenizer.
fn words_of(text: &str) -> Vec<String> {
    if text.bytes().all(|byte| byte.is_ascii_lowercase() || byte == b' ') {
        return text.split_ascii_whitespace().map(str::to_owned).collect();
    }
    tokenize(text).into_iter().map(|word| word.text).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn named(table: &Table, text: &str) -> Vec<String> {
        let words: Vec<&str> = text.split(' ').collect();
        let name = |index: usize| table.names()[index].clone();
        let senses = table.senses(&words).into_iter();
        senses.map(|senses| senses.indices().map(name).collect::<Vec<_>>().join("+")).collect()
    }

    #[test]
    fn phrases_count_before_their_words_and_forms_are_known() {
        let text =
            "@go travels\n@out farther\n@slow slowly\nback away: go out\nglide: go\nhop: go\nback: out\ncarry: slow\n";
        let table = Table::parse(text).unwrap();
        assert_eq!(named(&table, "backing away from <obj-0>"), ["go+out", "go+out", "", ""]);
        assert_eq!(named(&table, "glides hopping carried back"), ["go", "go", "slow", "out"]);
    }

    #[test]
    fn a_word_without_senses_is_no_form_of_another() {
        let table = Table::parse("@go travels\nflow: go\nflow on: go\nflower:\n").unwrap();
        assert_eq!(named(&table, "flows flower on"), ["go", "", ""]);
    }

    #[test]
    fn damage_is_named_by_its_line() {
        for (text, what) in [
            ("@go x\nfly: go fast", "`fast`"),
            ("fly go", "expected"),
            ("@go x\n: go", "without a word"),
            ("@go x\nfly:go", "expected"),
            ("@go x\nfly: go\nfly: go", "already"),
            ("@go x\n@go y", "another"),
        ] {
            let error = Table::parse(text).unwrap_err().to_string();
            let line = format!("line {}", text.lines().count());
            assert!(error.contains(&line) && error.contains(what), "{error}");
        }
    }

    #[test]
    fn the_shipped_list_is_read() {
        let table = Table::embedded().unwrap();
        assert!(table.names().len() > 100);
        assert_eq!(named(table, "<obj-0>"), [""]);
    }
}

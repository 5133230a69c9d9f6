//! The words of the training grammar, which linking never takes for the name of an unknown object.

use std::collections::BTreeSet;
use std::sync::OnceLock;

use super::inflection::{VerbForm, inflect};
use super::tokenizer::tokenize;

/// The text of `prompts/grammar.txt`. Linking knows its words; the sampler of `training` reads its templates.
pub static GRAMMAR_TEXT: &str = include_str!("../../prompts/grammar.txt");

/// Every word of every template of `prompts/grammar.txt`, also inflected as a verb.
#[derive(Debug)]
pub(crate) struct KnownWords {
    words: BTreeSet<String>,
    /// The words as the templates have them.
    plain: BTreeSet<String>,
}

impl KnownWords {
    /// The words of the grammar that the program ships, read once.
    pub(crate) fn embedded() -> &'static Self {
        static KNOWN: OnceLock<KnownWords> = OnceLock::new();
        KNOWN.get_or_init(|| Self::of_grammar(GRAMMAR_TEXT))
    }

    fn of_grammar(text: &str) -> Self {
        let is_template =
            |line: &&str| !line.is_empty() && !["#", "= ", "@ ", "! "].iter().any(|opening| line.starts_with(opening));
        let templates = text.lines().map(str::trim).filter(is_template);
        let plain: BTreeSet<String> = templates.flat_map(words_of_template).collect();
        let forms =
            |word: &String| [inflect(word, VerbForm::ThirdPerson), inflect(word, VerbForm::Gerund), word.clone()];
        Self { words: plain.iter().flat_map(forms).collect(), plain }
    }

    /// Whether the grammar uses `word` in any form.
    pub(crate) fn contains(&self, word: &str) -> bool {
        self.words.contains(word)
    }

    /// The words as the templates have them.
    pub(crate) fn plain(&self) -> impl Iterator<Item = &str> {
        self.plain.iter().map(String::as_str)
    }
}

/// The words of a template without its meaning and its `{lists}`.
fn words_of_template(line: &str) -> impl Iterator<Item = String> {
    let text = line.split("=>").next().unwrap_or_default();
    let without_lists = text.split('{').map(|part| part.split_once('}').map_or(part, |(_, after)| after));
    without_lists.flat_map(tokenize).map(|word| word.text)
}

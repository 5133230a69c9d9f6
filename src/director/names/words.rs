//! The words of a prompt as the tagger reads them.

use cinesplat_language::{Word, numbered_mention_at, stem};

/// Most words of a prompt that the tagger reads; words behind them name nothing.
pub(super) const MAX_WORDS: usize = 400;

/// A word, or a mention by number (`<obj-3>`, `object 3`) in one piece.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NameWord {
    /// The word in lower case; `<obj>` for a mention by number.
    pub text: String,
    /// The word as a singular noun.
    pub stem: String,
    /// Byte range of the prompt.
    pub bytes: [usize; 2],
    /// The number of a mention by number; `None` within for `<obj-N>`.
    pub tag: Option<Option<u32>>,
}

impl NameWord {
    /// A word without a place in a prompt.
    pub fn new(text: &str) -> Self {
        Self { text: text.to_owned(), stem: stem(text), bytes: [0, 0], tag: None }
    }

    /// Whether it begins with a letter and is no mention by number.
    pub fn is_alphabetic(&self) -> bool {
        self.text.starts_with(char::is_alphabetic)
    }
}

/// The words of a prompt as the tagger reads them, at most 400.
pub fn name_words(words: &[Word]) -> Vec<NameWord> {
    let mut out = Vec::new();
    let mut i = 0;
    while i < words.len() && out.len() < MAX_WORDS {
        if let Some(numbered) = numbered_mention_at(words, i) {
            let last = &words[(i + numbered.len).min(words.len()) - 1];
            out.push(NameWord {
                text: "<obj>".to_owned(),
                stem: String::new(),
                bytes: [words[i].span[0], last.span[1]],
                tag: Some(numbered.id),
            });
            i += numbered.len.max(1);
            continue;
        }
        let word = &words[i];
        out.push(NameWord { text: word.text.clone(), stem: word.stem.clone(), bytes: word.span, tag: None });
        i += 1;
    }
    out
}

//! Words for `sbatch` that come in one text.

use crate::cli::failure::Failure;

/// The words of a text, as a shell takes them apart: at white space, with quotes and backslashes.
pub(super) fn split(text: &str) -> Result<Vec<String>, Failure> {
    let (mut words, mut word, mut quote) = (Vec::new(), None::<String>, None);
    let mut letters = text.chars();
    while let Some(letter) = letters.next() {
        match (letter, quote) {
            (_, Some(open)) if letter == open => quote = None,
            ('"' | '\'', None) => {
                quote = Some(letter);
                word.get_or_insert_default();
            }
            ('\\', None | Some('"')) => word.get_or_insert_default().extend(letters.next()),
            (_, None) if letter.is_whitespace() => words.extend(word.take()),
            _ => word.get_or_insert_default().push(letter),
        }
    }
    if let Some(open) = quote {
        let found = format!("--sbatch {text}: a quote {open} without its end");
        return Err(Failure::usage(
            found,
            "quote a value with spaces inside the words: --sbatch '--comment=\"two words\"'",
        ));
    }
    words.extend(word);
    Ok(words)
}

/// Takes the words that state what a job waits for out of `words`; returns what they state.
pub(super) fn take_dependencies(words: &mut Vec<String>) -> Vec<String> {
    let (mut stated, mut left, mut given) = (Vec::new(), Vec::new(), words.drain(..));
    while let Some(word) = given.next() {
        match dependency(&word) {
            Some(Some(value)) => stated.push(value.to_owned()),
            Some(None) => stated.extend(given.next()),
            None => left.push(word),
        }
    }
    drop(given);
    *words = left;
    stated
}

/// Whether a word states what a job waits for, and the value if it is in the same word.
#[expect(clippy::option_option, reason = "no such word, a word without its value, a word with it")]
fn dependency(word: &str) -> Option<Option<&str>> {
    if let Some(value) = word.strip_prefix("-d") {
        return Some(Some(value).filter(|value| !value.is_empty()));
    }
    let (name, value) = word.split_once('=').map_or((word, None), |(name, value)| (name, Some(value)));
    // Names of options may be cut.
    (name.starts_with("--dep") && "--dependency".starts_with(name)).then_some(value)
}

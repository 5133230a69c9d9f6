//! Plain words for what people type: shorthand of the trade written out, slips of dictation and typing mended.
//!
//! Enters: the words of a prompt. Leaves: words that stand for the same bytes. Names of objects stay as they are.

mod shorthand;
mod spelling;

use std::collections::BTreeSet;

use super::error::LanguageError;
use super::inflection::stem;
use super::numbered::numbered_mention_at;
use super::tokenizer::Word;
use shorthand::Shorthand;
use spelling::Spelling;

/// Whether most words are no English ones, names and shorthand aside: `asdf qwer`, `langsam auf die Lampe zu`.
///
/// # Errors
/// [`LanguageError::BadData`] when an embedded list is malformed.
pub fn is_foreign(words: &[&str]) -> Result<bool, LanguageError> {
    let spelling = Spelling::embedded()?;
    let is_word = |word: &&&str| word.len() > 1 && word.chars().all(char::is_alphabetic);
    let (known, unknown): (Vec<&str>, Vec<&str>) =
        words.iter().filter(is_word).partition(|word| spelling.is_known(word) || spelling.is_known(&stem(word)));
    Ok(unknown.len() > known.len())
}

/// `words` of `prompt` in plain words; those that `is_name` marks stay. A word that stands for several gives all of them its
/// bytes.
///
/// # Errors
/// [`LanguageError::BadData`] when an embedded list is malformed.
pub fn plain_words(prompt: &str, words: &[Word], is_name: &dyn Fn(&Word) -> bool) -> Result<Vec<Word>, LanguageError> {
    let (shorthand, spelling) = (Shorthand::embedded()?, Spelling::embedded()?);
    let mut is_name: Vec<bool> = words.iter().map(is_name).collect();
    for i in 0..words.len() {
        if let Some(numbered) = numbered_mention_at(words, i) {
            is_name.iter_mut().skip(i).take(numbered.len).for_each(|is_name| *is_name = true);
        }
    }
    let mut out = Vec::with_capacity(words.len());
    let mut i = 0;
    while i < words.len() {
        if let Some((len, meaning)) =
            shorthand.match_at(prompt, words, i).filter(|(len, _)| !is_name[i..i + len].contains(&true))
        {
            let span = [words[i].span[0], words[i + len - 1].span[1]];
            out.extend(meaning.iter().map(|text| Word {
                text: text.clone(),
                stem: stem(text),
                span,
                after_hyphen: false,
            }));
            i += len;
            continue;
        }
        let mut word = words[i].clone();
        let mended = |word: &str| spelling.shortened(word).or_else(|| spelling.mended(word).map(str::to_owned));
        if let Some(text) = mended(&word.text).filter(|_| !is_name[i]) {
            word.stem = stem(&text);
            word.text = text;
        }
        out.push(word);
        i += 1;
    }
    Ok(out)
}

/// Mends misspelled words of names: `curtin`, `sidebord`. `names` are the words of the scene's names, as stems.
///
/// # Errors
/// [`LanguageError::BadData`] when an embedded list is malformed.
pub fn mend_names(words: &mut [Word], names: &BTreeSet<String>) -> Result<(), LanguageError> {
    let spelling = Spelling::embedded()?;
    for word in words.iter_mut().filter(|word| !names.contains(&word.stem)) {
        if let Some(name) = spelling.mended_name(&word.stem, names) {
            let plural = if word.text != word.stem && word.text.ends_with('s') { "s" } else { "" };
            word.text = format!("{name}{plural}");
            name.clone_into(&mut word.stem);
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tokenizer::tokenize;

    #[test]
    fn letters_said_at_length_are_written_once_or_twice() {
        let plain = |prompt: &str| {
            let words = plain_words(prompt, &tokenize(prompt), &|_| false).unwrap();
            words.iter().map(|word| word.text.as_str()).collect::<Vec<_>>().join(" ")
        };
        assert_eq!(plain("zooom in on the tellly, sloooowly"), "zoom in on the telly , slowly");
        assert_eq!(plain("go up to the doooor, pleeease"), "go up to the door , please");
        assert_eq!(plain("pan to the aaaxx and tilt up"), "pan to the aaaxx and tilt up");
    }
}

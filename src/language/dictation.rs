//! Prompts that were dictated: `start on the window comma go over the bench full stop um end on the pillows full stop`.

use std::borrow::Cow;

use super::tokenizer::{Word, is_listed, tokenize, word_at};

/// What people say for marks.
const MARKS: [(&[&str], u8); 11] = [
    (&["full", "stop"], b'.'),
    (&["new", "paragraph"], b'.'),
    (&["new", "para"], b'.'),
    (&["new", "line"], b'.'),
    (&["new", "sentence"], b'.'),
    (&["period"], b'.'),
    (&["comma"], b','),
    (&["semicolon"], b';'),
    (&["question", "mark"], b'?'),
    (&["exclamation", "mark"], b'!'),
    (&["exclamation", "point"], b'!'),
];
/// Words before them by which they are no marks.
const NAMES: &str = "a an the to complete this that your our my at";
/// Sounds of somebody who thinks.
const FILLERS: [&str; 7] = ["um", "uh", "erm", "er", "hmm", "umm", "uhm"];

/// A prompt with marks in the place of the words for them, at the same bytes, where it says at least the end of a sentence so.
pub fn without_dictation(prompt: &str) -> Cow<'_, str> {
    let words = tokenize(prompt);
    let says =
        |at: usize, phrase: &[&str]| phrase.iter().enumerate().all(|(nth, word)| word_at(&words, at + nth) == *word);
    // `A period piece`, `come to a full stop`.
    let is_noun = |at: usize| at.checked_sub(1).is_some_and(|before| is_listed(NAMES, word_at(&words, before)));
    let ends = |at: usize| MARKS[..5].iter().any(|(phrase, _)| says(at, phrase)) && !is_noun(at);
    let is_dictated = (0..words.len()).any(ends);
    if !is_dictated {
        return Cow::Borrowed(prompt);
    }
    let mut bytes = prompt.as_bytes().to_vec();
    let mut write = |words: &[Word], mark: u8| {
        if let (Some(first), Some(last)) = (words.first(), words.last()) {
            bytes[first.span[0]..last.span[1]].fill(b' ');
            // What is quoted of the prompt ends behind the words.
            bytes[last.span[1] - 1] = mark;
        }
    };
    let mut at = 0;
    while at < words.len() {
        let said = MARKS.iter().find(|(phrase, _)| says(at, phrase));
        if let Some((phrase, mark)) = said.filter(|_| !is_noun(at)) {
            write(&words[at..at + phrase.len()], *mark);
            at += phrase.len();
            continue;
        }
        if FILLERS.contains(&word_at(&words, at)) {
            write(&words[at..=at], b' ');
        }
        at += 1;
    }
    String::from_utf8(bytes).map_or(Cow::Borrowed(prompt), Cow::Owned)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_for_marks_are_marks() {
        let said = "start on the window comma um go over the bench full stop end on the bed full stop";
        let written = without_dictation(said);
        assert_eq!(written.len(), said.len());
        let words: Vec<&str> = written.split_whitespace().collect();
        assert_eq!(words.join(" "), "start on the window , go over the bench . end on the bed .");
        assert_eq!(
            without_dictation("come to a full halt, a comma in the frame"),
            "come to a full halt, a comma in the frame"
        );
        assert_eq!(without_dictation("come to a full stop at the bed"), "come to a full stop at the bed");
    }
}

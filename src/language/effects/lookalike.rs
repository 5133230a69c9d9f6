//! Words that only look like an effect: `the fog lamp`, `wood grain`, `a shaky ladder`.

use super::phrase::Found;
use crate::lexicon::Lexicon;
use crate::things::Things;
use crate::tokenizer::{Word, word_at};

/// Whether a phrase is part of the name of a thing: of an object of the scene (byte ranges), or of any other.
pub(super) fn is_lookalike(words: &[Word], found: &Found<'_>, objects: &[[usize; 2]], lexicon: &Lexicon) -> bool {
    let end = found.start + found.len;
    let inside = &words[found.start..end];
    let overlaps =
        |object: &[usize; 2]| inside.iter().any(|word| object[0] <= word.span[0] && word.span[1] <= object[1]);
    // A phrase of several words may contain an object: `everything but the vase is out of focus`.
    if objects.iter().any(|object| {
        overlaps(object) && inside.iter().all(|word| word.span[0] >= object[0] && word.span[1] <= object[1])
    }) {
        return true;
    }
    if found.len > 1 {
        return false;
    }
    let is_thing = |at: usize| words.get(at).is_some_and(|word| is_thing(word, lexicon) || is_of(word, objects));
    let before = found.start.checked_sub(1).is_some_and(is_thing);
    is_thing(end) || found.is_stuff && (before || word_at(words, end) == "of")
}

/// Whether a word belongs to the name of an object.
fn is_of(word: &Word, objects: &[[usize; 2]]) -> bool {
    objects.iter().any(|object| object[0] <= word.span[0] && word.span[1] <= object[1])
}

/// Whether a word is the name of a kind of thing and no word about pictures.
fn is_thing(word: &Word, lexicon: &Lexicon) -> bool {
    let is_noun = lexicon.noun_heads.contains(&word.stem) || Things::embedded().roles(&word.stem) != 0;
    word.is_alphabetic() && is_noun && !lexicon.is_shot_language(&word.text) && !lexicon.is_shot_language(&word.stem)
}

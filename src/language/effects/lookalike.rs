//! Words that only look like an effect: `the fog lamp`, `wood grain`, `a shaky old ladder`.

use super::phrase::Found;
use crate::lexicon::Lexicon;
use crate::things::Things;
use crate::tokenizer::{Word, word_at};

/// Words between the attribute of a thing and its name: `the grainy old wooden table`.
const MAX_BETWEEN: usize = 2;
/// Words that begin the name of one certain thing.
const POINTS_AT: [&str; 8] = ["the", "that", "this", "my", "our", "your", "his", "her"];
/// What attributes are made of and no picture is.
const MATERIALS: [&str; 12] = [
    "wood", "metal", "stone", "glass", "brick", "concrete", "paper", "leather", "plastic", "marble", "bathroom",
    "kitchen",
];

/// Whether a phrase is part of the name of a thing: of an object of the scene (byte ranges), or of any other.
pub(super) fn is_lookalike(words: &[Word], found: &Found<'_>, objects: &[[usize; 2]], lexicon: &Lexicon) -> bool {
    let end = found.end();
    let inside = &words[found.start..end];
    let overlaps =
        |object: &[usize; 2]| inside.iter().any(|word| object[0] <= word.span[0] && word.span[1] <= object[1]);
    // A phrase of several words may contain an object: `everything but the vase is out of focus`.
    if objects.iter().any(|object| {
        overlaps(object) && inside.iter().all(|word| word.span[0] >= object[0] && word.span[1] <= object[1])
    }) {
        return true;
    }
    let is_thing = |at: usize| words.get(at).is_some_and(|word| is_thing(word, lexicon) || is_of(word, objects));
    let before = |at: usize| at.checked_sub(1).map_or("", |before| word_at(words, before));
    if found.len > 1 {
        // `the radial distortion sensor`.
        return found.len == 2 && found.number.is_none() && POINTS_AT.contains(&before(found.start)) && is_thing(end);
    }
    let is_between = |at: &usize| {
        let word = word_at(words, *at);
        MATERIALS.contains(&word) || lexicon.adjectives.contains(word)
    };
    let is_attribute = inside.iter().any(|word| word.text.ends_with('y'));
    let num_between = if is_attribute { (end..end + MAX_BETWEEN).take_while(is_between).count() } else { 0 };
    let is_described = |word: &Word| is_noun(word, lexicon) && !lexicon.camera.contains(&word.text);
    is_thing(end)
        || num_between > 0 && words.get(end + num_between).is_some_and(is_described)
        || found.is_stuff && (found.start.checked_sub(1).is_some_and(is_thing) || word_at(words, end) == "of")
}

/// Whether a word belongs to the name of an object.
fn is_of(word: &Word, objects: &[[usize; 2]]) -> bool {
    objects.iter().any(|object| object[0] <= word.span[0] && word.span[1] <= object[1])
}

/// Whether a word is the name of a kind of thing and no word about pictures.
fn is_thing(word: &Word, lexicon: &Lexicon) -> bool {
    is_noun(word, lexicon) && !lexicon.is_shot_language(&word.text) && !lexicon.is_shot_language(&word.stem)
}

/// Whether a word is the name of a kind of thing.
fn is_noun(word: &Word, lexicon: &Lexicon) -> bool {
    word.is_alphabetic() && (lexicon.noun_heads.contains(&word.stem) || Things::embedded().roles(&word.stem) != 0)
}

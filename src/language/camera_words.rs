//! Words of the camera and its lens that look like the name of a thing: `let the glass do the work`, `the Jaws trick`,
//! `counter-clockwise`, `let the whole camera sink`.

use super::names::NamedObject;
use super::tokenizer::{Word, is_listed, word_at};

/// Whether the words from one to another one of a mention say something of the camera and name no thing.
pub(super) fn is_of_camera(words: &[Word], [first, end]: [usize; 2], objects: &[NamedObject]) -> bool {
    is_lens(words, [first, end])
        || is_trick(words, [first, end])
        || is_sense(words, [first, end])
        || is_camera(&words[first..end], objects)
}

/// `Let the glass do the work`: the lens.
fn is_lens(words: &[Word], [first, end]: [usize; 2]) -> bool {
    let text = |at: usize| word_at(words, at);
    let is_named = words[first..end].iter().all(|word| is_listed("the glass lens optics zoom", &word.text));
    is_named
        && is_listed("do does", text(end))
        && text(end + 1) == "the"
        && is_listed("work job walking moving", text(end + 2))
}

/// `The Jaws trick on the plates`: a move that has a film for its name.
fn is_trick(words: &[Word], [first, end]: [usize; 2]) -> bool {
    let mut names = words[first..end].iter().map(|word| word.text.as_str()).chain([word_at(words, end)]);
    let is_film = |word: &str| is_listed("jaws vertigo hitchcock spielberg", word);
    names.any(is_film) && names.next().is_some_and(|word| is_listed("trick thing effect shot zoom move moment", word))
}

/// `Let the whole camera sink`: what the camera does, where no thing of the scene is a camera.
fn is_camera(names: &[Word], objects: &[NamedObject]) -> bool {
    let has = |list: &str| names.iter().any(|word| is_listed(list, &word.text));
    let is_label = |object: &NamedObject| object.label.to_lowercase().contains("camera");
    has("camera cam lens viewpoint")
        && has("sink rise drop drift float glide climb fall")
        && !objects.iter().any(is_label)
}

/// `Counter-clockwise`: the sense of a turn, and no counter.
fn is_sense(words: &[Word], [first, end]: [usize; 2]) -> bool {
    let hyphen = usize::from(word_at(words, end) == "-");
    let is_named = words[first..end].last().is_some_and(|word| is_listed("counter anti contra", &word.text));
    is_named && matches!(word_at(words, end + hyphen), "clockwise" | "clock")
}

//! Directions said wrongly first: `tilt down, no wait, up`.

use rand::RngExt;
use rand::seq::IndexedRandom;
use rand_pcg::Pcg64;

use super::sentence::Sentence;
use cinesplat_language::tokenize;

/// Words of which people say one for the other.
const OPPOSITES: [[&str; 2]; 7] = [
    ["left", "right"],
    ["up", "down"],
    ["in", "out"],
    ["clockwise", "counterclockwise"],
    ["closer", "away"],
    ["forward", "back"],
    ["slowly", "quickly"],
];
/// Moves whose direction `in` and `out` tell; elsewhere they are prepositions.
const MOVING: [&str; 8] = ["push", "pull", "zoom", "dolly", "move", "go", "come", "track"];

/// The sentence with the opposite of a direction and a correction before it, or as it is without a direction.
pub(super) fn with_slip(mut sentence: Sentence, corrections: &[String], rng: &mut Pcg64) -> Sentence {
    let words: Vec<String> = sentence.linked.tokens_text.split(' ').map(str::to_owned).collect();
    let slips: Vec<(usize, &str)> =
        words.iter().enumerate().filter_map(|(idx, word)| Some((idx, opposite(&words, idx, word)?))).collect();
    let (Some((at, wrong)), Some(mark)) = (slips.choose(rng).copied(), corrections.choose(rng)) else {
        return sentence;
    };
    let mut added = vec![wrong.to_owned()];
    added.extend(tokenize(mark).into_iter().map(|word| word.text));
    if rng.random_bool(0.3) {
        added.truncate(1);
        added.extend([",", "no", ","].map(str::to_owned));
    }
    let Some([start, _]) = sentence.linked.spans.get(at).copied() else { return sentence };
    let spans = std::iter::repeat_n([start, start], added.len());
    sentence.linked.spans.splice(at..at, spans);
    let mut words = words;
    words.splice(at..at, added);
    sentence.linked.tokens_text = words.join(" ");
    sentence
}

/// The opposite of a direction; `None` for other words.
fn opposite(words: &[String], idx: usize, word: &str) -> Option<&'static str> {
    let before = idx.checked_sub(1).and_then(|before| words.get(before)).map_or("", String::as_str);
    if (word == "in" || word == "out") && !MOVING.contains(&before) {
        return None;
    }
    OPPOSITES.iter().find_map(|[a, b]| match word {
        _ if word == *a => Some(*b),
        _ if word == *b => Some(*a),
        _ => None,
    })
}

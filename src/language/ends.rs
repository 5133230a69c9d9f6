//! Words for the upper or the lower end of a thing, or a side of it: `the headstock`, `its pot`, `the front`.

use super::tokenizer::{is_listed, tokenize};

const UPPER: &str = "headstock tuners tuner pegs head crown canopy leaves foliage fronds frond cranium skullcap forehead brow \
    lid lampshade shade bulb backrest headrest tabletop mouth cork tip peak apex rim petals blossoms blooms eyes sockets \
    spire finial pediment shaft";
const LOWER: &str = "pot planter roots soil base foot feet legs wheels casters castors pedals hem skirt jaw jawbone chin teeth \
    mandible bridge soundhole pedestal plinth stand bottom saucer";
const FRONT: &str = "front headlight headlights headlamp handlebar handlebars forks grille windscreen toe toes toecap toecaps snout nose";
const BACK: &str = "back rear taillight taillights exhaust heel heels tail";
/// Words before such a word that say nothing else.
const BEFORE: &str = "the a its his her their this that very guitar 's whole eye tuning both two skull";

/// The end or side of the thing labelled `label` that a mention with these words names: `top`, `bottom`, `front` or
/// `back`. What the label says itself is the thing.
pub fn end_of(words: &str, label: &str) -> Option<&'static str> {
    let words = tokenize(words);
    let (last, before) = words.split_last()?;
    let label = tokenize(label);
    let is_label = |text: &str| label.iter().any(|word| word.text == text);
    let end = match () {
        () if is_listed(UPPER, &last.text) => "top",
        () if is_listed(LOWER, &last.text) => "bottom",
        () if is_listed(FRONT, &last.text) => "front",
        () if is_listed(BACK, &last.text) => "back",
        () => return None,
    };
    // The pot of `the teapot` is all of it.
    if label.iter().any(|word| word.text.ends_with(&last.text)) {
        return None;
    }
    let says_label = before.iter().all(|word| is_listed(BEFORE, &word.text) || is_label(&word.text));
    says_label.then_some(end)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_end_of_a_thing_is_told_from_the_thing() {
        assert_eq!(end_of("the headstock", "electric guitar"), Some("top"));
        assert_eq!(end_of("the guitar's bridge", "electric guitar"), Some("bottom"));
        assert_eq!(end_of("the front", "armchair"), Some("front"));
        assert_eq!(end_of("its pot", "palm tree"), Some("bottom"));
        assert_eq!(end_of("the lamp shade", "lamp shade"), None);
        assert_eq!(end_of("the stand", "music stand"), None);
        assert_eq!(end_of("the golden head", "statue"), None);
        assert_eq!(end_of("the statue", "statue"), None);
        assert_eq!(end_of("the pot", "red teapot"), None);
    }
}

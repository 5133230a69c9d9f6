//! Places that only say which thing is meant: `the teapot on the shelf`, `the vase in the middle of the table`.

use cinesplat_language::{LanguageError, Mention, NamedObject, Word, is_listed, part_of, tokenize};

use crate::explained::{content, head, is_number, label, said};
use crate::names::FoundMention;
use crate::placed::{Places, hangs_over};

/// Words that say where a thing is, and words that may stand beside them.
const WHERE: [&str; 11] =
    ["on", "in", "at", "under", "below", "beneath", "underneath", "near", "above", "inside", "atop"];
const BESIDE: [&str; 28] = [
    "the",
    "a",
    "an",
    "that",
    "which",
    "is",
    "are",
    "sits",
    "sitting",
    "standing",
    "stands",
    "hanging",
    "lying",
    "up",
    "there",
    "stacked",
    "piled",
    "kept",
    "placed",
    "displayed",
    "hung",
    "resting",
    "sat",
    "over",
    "out",
    "here",
    "all",
    "right",
];

/// Words of how a thing is where it is, besides adverbs and forms in `ing`: `waits quietly on the shelf`.
const STATES: &str = "waits rests hangs lies lives glows gleams sleeps leans perched alone still tucked set left";
/// Words in `ing` that are moves of the camera, whatever is beside them.
const MOVES: &str = "moving drifting going rising gliding sliding flying tilting panning pushing zooming craning orbiting pulling stopping \
    ending finishing starting landing settling looking booming turning coming heading holding arriving hovering";

/// Words that only locate a thing, between it and its place, and words that may stand beside them.
const LOCATES: &str = "on atop beside near next middle center centre end edge";
const BESIDE_PLACES: &str = "at very far other left right the a an my our your this that which is are 's sits sitting stands standing stood lying resting placed right just there top in of to";

/// Whether words between a thing and a place only say where the thing is: `the vase in the middle of the table`.
fn locates(between: &[Word]) -> bool {
    let text = |at: usize| between.get(at).map_or("", |word| word.text.as_str());
    // `On to the table` is a way.
    let leads = (0..between.len()).any(|at| text(at) == "to" && (at == 0 || text(at - 1) != "next"));
    between.iter().any(|word| is_listed(LOCATES, &word.text))
        && between.iter().all(|word| is_listed(LOCATES, &word.text) || is_listed(BESIDE_PLACES, &word.text))
        && !leads
        && between.last().is_some_and(|word| word.text != "next")
}

fn describes(word: &str) -> bool {
    is_listed(STATES, word)
        || word.ends_with("ing") && !is_listed(MOVES, word)
        || word.ends_with("ly") && word.len() > 4
}

/// Makes one mention of a thing and of the place that tells which one it is, where the place is called by no word of
/// the object that it was taken for (`the shelf` on which the teapot stands, in a scene of cabinets) or only locates the thing.
///
/// # Errors
/// [`LanguageError::BadData`] for a damaged list of parts.
pub(crate) fn absorb_places(
    prompt: &str,
    objects: &[NamedObject],
    places: Places<'_>,
    found: &mut Vec<FoundMention>,
) -> Result<(), LanguageError> {
    let mut nth = 1;
    while nth < found.len() {
        let [thing, place] = [&found[nth - 1].mention, &found[nth].mention];
        let between = tokenize(prompt.get(thing.bytes[1]..place.bytes[0]).unwrap_or_default());
        let is_where = |word: &Word| WHERE.contains(&word.text.as_str());
        let is_beside = |word: &Word| BESIDE.contains(&word.text.as_str()) || describes(&word.text);
        let says_where = between.iter().any(is_where) && between.iter().all(|word| is_where(word) || is_beside(word));
        let is_loose = match (&thing.ids[..], &place.ids[..]) {
            ([_, ..], [id]) => {
                let words = said(prompt, place);
                let label = label(objects, *id).map(content);
                let is_other = label.is_some_and(|label| !label.is_empty() && label.is_disjoint(&content(words)));
                is_other && !is_number(words) && thing.ids != place.ids
            }
            _ => false,
        };
        let is_named = |thing: &Mention, place: &Mention| {
            !thing.ids.is_empty() && !place.ids.is_empty() && thing.ids != place.ids && !is_number(said(prompt, place))
        };
        // `The chest of drawers, <obj-8>, ..` names one thing twice.
        let is_again = thing.ids == place.ids
            && !thing.ids.is_empty()
            && is_number(said(prompt, place))
            && between.len() == 1
            && between[0].text == ",";
        if is_again
            || is_one_again(prompt, thing, place, &between)
            || says_where && is_loose
            || locates(&between) && is_named(thing, place)
            || is_over(places, thing, place, &between)
            || has_part(prompt, objects, thing, place, &between)?
        {
            found[nth - 1].mention.bytes[1] = place.bytes[1];
            found.remove(nth);
        } else {
            nth += 1;
        }
    }
    Ok(())
}

/// Whether the first thing hangs over the second one, as the words between them say: `the tool wall over the workbench`.
fn is_over(places: Places<'_>, thing: &Mention, place: &Mention, between: &[Word]) -> bool {
    let over = between.first().is_some_and(|word| is_listed("over above", &word.text))
        && between[1..].iter().all(|word| is_listed("the a an my our your", &word.text));
    let ([thing], [place]) = (&thing.ids[..], &place.ids[..]) else { return false };
    over && hangs_over(places, *thing, *place)
}

/// Whether the second mention is only a part of the first one, and no word for what it was taken for: `the plate with the yellow
/// rim`, in a scene with a yellow mug.
fn has_part(
    prompt: &str,
    objects: &[NamedObject],
    thing: &Mention,
    part: &Mention,
    between: &[Word],
) -> Result<bool, LanguageError> {
    let words = said(prompt, part);
    let Some(own) = head(words).filter(|_| !thing.ids.is_empty() && !is_number(words)) else { return Ok(false) };
    let has = between.iter().any(|word| word.text == "with")
        && between.iter().all(|word| is_listed("with the a an its", &word.text));
    let is_thing = part.ids.iter().filter_map(|id| label(objects, *id)).any(|label| content(label).contains(&own));
    Ok(has && !is_thing && part_of(&own, "")?.is_some())
}

/// Words between a thing and `the big green one`, which is the same thing, and words by which it is another one.
const ON_FLOOR: &str = "on the floor ground in corner over there";
const OTHERS: &str = "other another next last first second third left right middle same";

/// Whether a mention only describes the thing before it once more: `the plant on the floor, the big green one`.
fn is_one_again(prompt: &str, thing: &Mention, place: &Mention, between: &[Word]) -> bool {
    let words = tokenize(said(prompt, place));
    let is_one = words.last().is_some_and(|word| word.text == "one")
        && !words.iter().any(|word| is_listed(OTHERS, &word.text) || word.text == "and");
    let (commas, places): (Vec<&Word>, Vec<&Word>) = between.iter().partition(|word| word.text == ",");
    let is_plain = commas.len() == 1 && places.iter().all(|word| is_listed(ON_FLOOR, &word.text));
    // `The mug, the green one` where another thing is green is still the mug.
    is_one && is_plain && thing.ids.len() == 1 && !place.ids.is_empty()
}

#[cfg(test)]
mod tests {
    use cinesplat_objects::Object;

    use super::*;
    use crate::said::fixture::labelled;

    #[test]
    fn places_only_locate_things() {
        let located = |text: &str| locates(&tokenize(text));
        assert!(located("in the middle of the"));
        assert!(located("standing on the"));
        assert!(located("next to the"));
        assert!(located("that's beside the"));
        assert!(!located("on to the"));
        assert!(!located("and the"));
        assert!(!located(", on the"));
    }

    #[test]
    fn a_part_of_a_thing_belongs_to_it() {
        let objects = labelled(&["black plate", "yellow mug"]);
        let num = |prompt: &str, mentions: [&str; 2]| {
            let mention = |(id, words): (u32, &str)| {
                let start = prompt.find(words).unwrap();
                let mention = Mention { bytes: [start, start + words.len()], ids: vec![id] };
                FoundMention { mention, probability: 1.0, nearest: Vec::new() }
            };
            let mut found: Vec<FoundMention> = (1..).zip(mentions).map(mention).collect();
            absorb_places(prompt, &objects, Places { objects: &[], up: glam::DVec3::Y }, &mut found).unwrap();
            found.len()
        };
        assert_eq!(num("to the plate with the yellow rim", ["the plate", "the yellow rim"]), 1);
        assert_eq!(num("to the plate with the yellow mug", ["the plate", "the yellow mug"]), 2);
        assert_eq!(num("show the plate on the floor, the yellow one", ["the plate", "the yellow one"]), 1);
        assert_eq!(num("show the plate, the other one", ["the plate", "the other one"]), 2);
    }

    #[test]
    fn a_thing_that_hangs_over_a_place_is_one_thing() {
        let at = |id, y: f64| Object::from_box(id, "", glam::DVec3::new(0.0, y, 0.0), glam::DVec3::splat(0.4));
        let hung = |prompt: &str, wall_height: f64| {
            let objects = [at(1, wall_height), at(2, 0.4)];
            let mention = |(id, words): (u32, &str)| {
                let start = prompt.find(words).unwrap();
                let mention = Mention { bytes: [start, start + words.len()], ids: vec![id] };
                FoundMention { mention, probability: 1.0, nearest: Vec::new() }
            };
            let mut found: Vec<FoundMention> = (1..).zip(["the tool wall", "the bench"]).map(mention).collect();
            let places = Places { objects: &objects, up: glam::DVec3::Y };
            absorb_places(prompt, &labelled(&["tool wall", "bench"]), places, &mut found).unwrap();
            found.len()
        };
        assert_eq!(hung("along the tool wall over the bench", 1.7), 1);
        assert_eq!(hung("along the tool wall over the bench", 0.4), 2);
        assert_eq!(hung("along the tool wall , over the bench", 1.7), 2);
    }
}

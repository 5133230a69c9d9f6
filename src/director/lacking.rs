//! Furniture, appliances and pets that a prompt names and the scene lacks: `start by the bed` in a studio.
//!
//! The network of names is careful with what is missing, because a wrong refusal is worse than a noun that it overlooks. Of
//! these nouns nobody means anything but the thing.

use cinesplat_language::{
    Mention, NamedObject, Relation, Things, Word, is_listed, is_no_thing, nearest_names, tokenize,
};

use crate::error::DirectorError;
use crate::explained::{insert_found, is_linked, may_mean};
use crate::names::FoundMention;

/// What stands in rooms and means nothing else to somebody who films.
const FURNISHINGS: &str = "bed sofa couch settee desk piano fridge refrigerator freezer oven stove cooker sink toaster microwave \
    kettle dishwasher wardrobe bookcase bookshelf dresser sideboard nightstand fireplace television tv telly bathtub toilet cot crib \
    cradle hammock aquarium cat dog horse motorbike bicycle chandelier armchair gramophone phonograph jukebox harp cello violin accordion typewriter \
    hallway bathroom bathtub tub staircase";
/// Those of them that nobody calls anything else that stands in a room.
const UNMISTAKABLE: &str = "piano fireplace bathtub toilet cot hammock aquarium dog horse motorbike bicycle gramophone phonograph jukebox \
    harp cello violin accordion typewriter";
/// Kinds of things that are not much alike.
const BROAD: &str = "furniture appliance instrument animal machine device container storage";
/// Words before a thing that is there.
const DETERMINERS: &str = "the my our your his her their";
/// Words before the determiner that make it a likeness.
const LIKE: &str = "like as";
/// Most words between a determiner and its noun.
const MAX_QUALIFIERS: usize = 2;
/// Fewest named objects of a scene that is no scan of one thing.
const FEWEST_OBJECTS: usize = 4;

/// Adds the mentions of furniture that nothing else has found. What one thing of the scene is much like means that thing.
///
/// # Errors
/// [`DirectorError::Language`] when the embedded lists are malformed.
pub(crate) fn name_lacking(
    prompt: &str,
    objects: &[NamedObject],
    found: &mut Vec<FoundMention>,
) -> Result<(), DirectorError> {
    if objects.len() < FEWEST_OBJECTS {
        return Ok(());
    }
    let words = tokenize(prompt);
    for at in 1..words.len() {
        let Some(first) = phrase_start(&words, at) else { continue };
        let bytes = [words[first].span[0], words[at].span[1]];
        if is_listed(UNMISTAKABLE, &words[at].text) {
            mistake_nothing(objects, &words[at], [words[first - 1].span[0], bytes[0]], found)?;
        }
        if is_linked(found, bytes)
            || objects.iter().any(|object| may_mean(&words[at].stem, &object.label))
            || is_no_thing(prompt, &Mention { bytes, ids: Vec::new() }, objects)
        {
            continue;
        }
        let mut alike = objects.iter().filter(|object| is_alike(object, &words[at]));
        let (ids, nearest) = match (alike.next(), alike.next()) {
            (Some(object), None) => (vec![object.id], Vec::new()),
            _ => (Vec::new(), nearest_names(prompt.get(bytes[0]..bytes[1]).unwrap_or_default(), objects)?),
        };
        insert_found(found, FoundMention { mention: Mention { bytes, ids }, probability: 1.0, nearest });
    }
    Ok(())
}

/// Takes the thing from the mention that begins at one of two bytes with such a noun, where it is related to nothing of that name.
fn mistake_nothing(
    objects: &[NamedObject],
    noun: &Word,
    starts: [usize; 2],
    found: &mut [FoundMention],
) -> Result<(), DirectorError> {
    let is_own = |found: &&mut FoundMention| starts.contains(&found.mention.bytes[0]) && !found.mention.ids.is_empty();
    let Some(found) = found.iter_mut().find(is_own) else { return Ok(()) };
    if !objects.iter().any(|object| may_mean(&noun.stem, &object.label)) {
        found.mention.ids.clear();
        found.nearest = nearest_names(&noun.text, objects)?;
    }
    Ok(())
}

/// First word of `the old bed`, behind the determiner, where `at` is the noun.
fn phrase_start(words: &[Word], at: usize) -> Option<usize> {
    let text = |at: usize| words.get(at).map_or("", |word| word.text.as_str());
    // `The dog's eye view`, `the bed frame`.
    let goes_on =
        text(at + 1).starts_with('\'') || words.get(at + 1).is_some_and(|next| next.is_alphabetic() && is_noun(next));
    if !is_listed(FURNISHINGS, text(at)) || goes_on {
        return None;
    }
    let first = (at.saturating_sub(MAX_QUALIFIERS)..=at)
        .rev()
        .find(|first| *first > 0 && is_listed(DETERMINERS, text(first - 1)))?;
    let is_plain = words[first..at].iter().all(Word::is_alphabetic);
    let is_likeness = first > 1 && is_listed(LIKE, text(first - 2));
    (is_plain && !is_likeness).then_some(first)
}

/// Whether a word behind a noun goes on with it.
fn is_noun(word: &Word) -> bool {
    Relation::Same.is_in(Things::embedded().roles(&word.stem))
}

/// Whether an object is a thing beside what a noun means, of one kind that is narrower than furniture: a workbench for a desk.
fn is_alike(object: &NamedObject, noun: &Word) -> bool {
    let things = Things::embedded();
    let closest = |label: &str| -> Vec<&str> {
        let kinds = things.kinds_of(label).into_iter().filter_map(|at| things.kinds().get(at));
        kinds.filter_map(|kind| kind.broader.first()).map(String::as_str).collect()
    };
    let own = closest(&object.label);
    closest(&noun.stem).iter().any(|kind| !is_listed(BROAD, kind) && own.contains(kind))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::said::fixture::labelled;

    #[test]
    fn furniture_that_the_scene_lacks_is_missing() {
        let objects = labelled(&["guitar", "easel", "workbench", "yellow armchair", "floor lamp"]);
        let named = |prompt: &str| {
            let mut found = Vec::new();
            name_lacking(prompt, &objects, &mut found).unwrap();
            found
                .into_iter()
                .map(|found| (prompt[found.mention.bytes[0]..found.mention.bytes[1]].to_owned(), found.mention.ids))
                .collect::<Vec<_>>()
        };
        assert_eq!(
            named("start by the bed, then the old piano"),
            [("bed".to_owned(), vec![]), ("old piano".to_owned(), vec![])]
        );
        assert_eq!(named("creep over to the desk"), [("desk".to_owned(), vec![3])]);
        let prompt = "across to the piano where she used to play";
        let mention = Mention { bytes: [10, prompt.len()], ids: vec![1] };
        let mut found = vec![FoundMention { mention, probability: 0.5, nearest: Vec::new() }];
        name_lacking(prompt, &objects, &mut found).unwrap();
        assert_eq!((found.len(), found[0].mention.ids.len()), (1, 0));
        assert_eq!(named("move like the cat, from the dog's eye level, to the armchair"), []);
        assert_eq!(named("as quiet as a bed"), []);
        assert_eq!(named("i am the cat. low along the floor"), []);
    }
}

//! Parts of the only thing of a scan, which a search may have made objects of their own.

use cinesplat_language::{
    LanguageError, Mention, NamedObject, PartPlace, Word, is_listed, own_part_at, part_of, tokenize,
};
use cinesplat_objects::{Object, is_description, only_whole};

use crate::explained::{POINTS, content, insert_mention, is_linked, is_number, label, said};
use crate::names::FoundMention;
use crate::placed::Places;

/// The part of a person that has parts of its own.
const HEAD: &str = "head";

/// Distance between an end of a thing and that of its part, of the height of the thing, up to which they are the same.
const SAME_END: f64 = 0.1;

/// Takes a part that the scene lacks for one of the only thing that there is, or that the prompt names: `the two sockets`
/// of the skull. Where its parts are objects of their own, a
/// word for an end of it that such a part does not reach is one of all of it: `the stand` is no end of a neck.
///
/// # Errors
/// [`LanguageError::BadData`] for a damaged list of parts.
pub(crate) fn own_parts(
    prompt: &str,
    objects: &[NamedObject],
    places: Places<'_>,
    found: &mut Vec<FoundMention>,
) -> Result<(), LanguageError> {
    point_to_owners(prompt, objects, found)?;
    let whole = only_whole(places.objects);
    if let Some(whole) = whole {
        point_to_ends(prompt, objects, (places, whole), found)?;
        point_to_whole(prompt, objects, (places, whole), found)?;
        link_parts(prompt, objects, (places, whole), found)?;
        link_whole(prompt, (places, whole), found);
    }
    let mut named: Vec<u32> = found.iter().flat_map(|found| found.mention.ids.clone()).collect();
    named.dedup();
    let only = match (&named[..], objects, whole) {
        (_, _, Some(whole)) => whole.id,
        ([id], ..) => *id,
        ([], [object], _) => object.id,
        _ => return Ok(()),
    };
    for part in found.iter_mut().filter(|found| found.mention.ids.is_empty()) {
        let words = said(prompt, &part.mention);
        let own = tokenize(words).into_iter().skip_while(|word| is_listed(POINTS, &word.text)).collect::<Vec<_>>();
        if let Some(head) = whole.map_or(Ok(None), |whole| head_with(&own, objects, (places, whole)))? {
            part.mention.ids = vec![head];
            continue;
        }
        // The frets of a neck are not those of its guitar.
        let mut owner = None;
        for id in named.iter().filter(|id| **id != only) {
            let label = label(objects, *id).unwrap_or_default();
            owner = owner.or(own_part_at(&own, label)?.map(|_| *id));
        }
        let id = owner.unwrap_or(only);
        let Some(label) = label(objects, id) else { continue };
        let is_whole = whole.is_some_and(|whole| whole.id == id);
        if part_of(words, label)?.or(described_part(words, label, is_whole)?).is_some() {
            part.mention.ids = vec![id];
        }
    }
    Ok(())
}

/// The head of the whole thing, where some words name a part of it: `his face`, `the man's helmet`.
fn head_with(
    words: &[Word],
    objects: &[NamedObject],
    (places, whole): (Places<'_>, &Object),
) -> Result<Option<u32>, LanguageError> {
    let is_head = |object: &&Object| object.parent == Some(whole.id) && label(objects, object.id) == Some(HEAD);
    let Some(head) = places.objects.iter().find(is_head) else { return Ok(None) };
    let owned = words.iter().rposition(|word| word.text == "'s").map_or(0, |mark| mark + 1);
    let own: Vec<Word> = words[owned..].iter().take_while(|word| word.text != "of").cloned().collect();
    let has = own_part_at(&own, HEAD)?.is_some_and(|len| len == own.len());
    Ok(has.then_some(head.id))
}

/// The part of the whole thing of a scan that a mention describes: `the carved top`. There is nothing else that it could be.
pub(crate) fn described_part(words: &str, label: &str, is_whole: bool) -> Result<Option<PartPlace>, LanguageError> {
    let (words, label_words) = (tokenize(words), tokenize(label));
    let is_label = |word: &Word| word.is_alphabetic() && label_words.iter().any(|own| own.stem == word.stem);
    match words.last() {
        Some(last) if is_whole && !words.iter().any(is_label) => match last.text.as_str() {
            "top" => Ok(Some(PartPlace { place: "top", is_small: false, heights_percent: None })),
            part => part_of(part, label),
        },
        _ => Ok(None),
    }
}

/// Words of all of a thing, a part of which was named before.
const ALL: [&[&str]; 7] = [
    &["all", "of", "it"],
    &["the", "whole", "of", "it"],
    &["the", "whole", "thing"],
    &["the", "entire", "thing"],
    &["the", "full", "thing"],
    &["the", "complete", "thing"],
    &["the", "lot"],
];

/// Links words of all of it to the whole thing, where a part that is an object of its own was named before: `start close on the body
/// of the guitar, pull back to see all of it`.
fn link_whole(prompt: &str, (places, whole): (Places<'_>, &Object), found: &mut Vec<FoundMention>) {
    let is_part = |id: u32| places.objects.iter().any(|object| object.id == id && object.parent == Some(whole.id));
    let words = tokenize(prompt);
    for at in 0..words.len() {
        let says = |phrase: &&&[&str]| {
            phrase.iter().enumerate().all(|(nth, word)| words.get(at + nth).is_some_and(|own| own.text == *word))
        };
        let Some(phrase) = ALL.iter().find(says) else { continue };
        let bytes = [words[at].span[0], words[at + phrase.len() - 1].span[1]];
        let last = found.iter().rev().find(|found| found.mention.bytes[1] <= bytes[0]);
        let is_of_part = last.is_some_and(|last| matches!(last.mention.ids[..], [id] if is_part(id)));
        if is_of_part {
            // `It` was linked to the part.
            found.retain(|found| !(bytes[0]..bytes[1]).contains(&found.mention.bytes[0]));
            insert_mention(found, Mention { bytes, ids: vec![whole.id] });
        }
    }
}

/// Words that are ends of things and much else.
const ENDS: &str = "top bottom front back rear side left right middle center base head crown top lid point";

/// Links parts of the whole thing that no network has found: `push in on the eye socket`.
fn link_parts(
    prompt: &str,
    objects: &[NamedObject],
    (places, whole): (Places<'_>, &Object),
    found: &mut Vec<FoundMention>,
) -> Result<(), LanguageError> {
    let words = tokenize(prompt);
    let whole_label = label(objects, whole.id).unwrap_or_default();
    for at in 1..words.len() {
        if !is_listed(POINTS, &words[at - 1].text) {
            continue;
        }
        for len in (1..=3).rev().filter(|len| at + len <= words.len()) {
            let bytes = [words[at - 1].span[0], words[at + len - 1].span[1]];
            let is_end = is_listed(ENDS, &words[at + len - 1].text);
            let is_part = part_of(prompt.get(bytes[0]..bytes[1]).unwrap_or_default(), whole_label)?.is_some();
            let owner = head_with(&words[at..at + len], objects, (places, whole))?;
            if (is_part || owner.is_some()) && !is_end && !is_linked(found, bytes) {
                insert_mention(found, Mention { bytes, ids: vec![owner.unwrap_or(whole.id)] });
                break;
            }
        }
    }
    Ok(())
}

/// Points a part at the thing named last before it that has such a part, where it was taken for another thing of another name:
/// `to the bed, and end up on the cushions`, in a room with a bench.
fn point_to_owners(prompt: &str, objects: &[NamedObject], found: &mut [FoundMention]) -> Result<(), LanguageError> {
    for nth in 1..found.len() {
        let (before, rest) = found.split_at_mut(nth);
        let part = &mut rest[0].mention;
        let words = said(prompt, part);
        let [id] = part.ids[..] else { continue };
        let is_called = |id: u32| label(objects, id).is_some_and(|label| !content(label).is_disjoint(&content(words)));
        if is_number(words) || is_called(id) {
            continue;
        }
        let own = tokenize(words).into_iter().skip_while(|word| is_listed(POINTS, &word.text)).collect::<Vec<_>>();
        let Some([owner]) = before.last().map(|found| &found.mention.ids[..]) else { continue };
        let has = own_part_at(&own, label(objects, *owner).unwrap_or_default())?.is_some_and(|len| len == own.len());
        if has {
            part.ids = vec![*owner];
        }
    }
    Ok(())
}

/// Points mentions of parts of the whole thing at it, or at its head, that were taken for it or for a crumb beside it.
fn point_to_whole(
    prompt: &str,
    objects: &[NamedObject],
    (places, whole): (Places<'_>, &Object),
    found: &mut [FoundMention],
) -> Result<(), LanguageError> {
    for part in found.iter_mut() {
        let [id] = part.mention.ids[..] else { continue };
        let words = said(prompt, &part.mention);
        let own_label = label(objects, id).unwrap_or_default();
        let is_crumb = |object: &Object| {
            object.id == id && object.id != whole.id && object.parent.is_none() && is_description(own_label)
        };
        let is_named = !content(words).is_disjoint(&content(own_label));
        let is_crumb = places.objects.iter().any(is_crumb) && !is_named;
        let is_head = own_label == HEAD && !is_named;
        if is_number(words) || id != whole.id && !is_crumb && !is_head {
            continue;
        }
        let own: Vec<Word> = tokenize(words).into_iter().skip_while(|word| is_listed(POINTS, &word.text)).collect();
        let head = head_with(&own, objects, (places, whole))?;
        // The arms of a person are none of his head.
        let place = part_of(words, label(objects, whole.id).unwrap_or_default())?.map(|part| part.place);
        let is_part = is_crumb && place.is_some() || is_head && place.is_some_and(|place| place != "top");
        if head.is_some() || is_part {
            part.mention.ids = vec![head.unwrap_or(whole.id)];
        }
    }
    Ok(())
}

/// Points mentions of ends of the whole thing at it that were taken for a part which does not reach there.
fn point_to_ends(
    prompt: &str,
    objects: &[NamedObject],
    (places, whole): (Places<'_>, &Object),
    found: &mut [FoundMention],
) -> Result<(), LanguageError> {
    let heights = |object: &Object| object.span_along(places.up);
    let [low, high] = heights(whole);
    let near = SAME_END * (high - low);
    for part in found.iter_mut() {
        let [id] = part.mention.ids[..] else { continue };
        let Some(object) = places.objects.iter().find(|object| object.id == id && object.parent == Some(whole.id))
        else {
            continue;
        };
        let words = said(prompt, &part.mention);
        let own_label = label(objects, id).unwrap_or_default();
        if is_number(words) || !content(words).is_disjoint(&content(own_label)) {
            continue;
        }
        let [own_low, own_high] = heights(object);
        let place = part_of(words, label(objects, whole.id).unwrap_or_default())?.map(|part| part.place);
        let is_elsewhere = match place {
            Some("bottom") => own_low - low > near,
            Some("top") => high - own_high > near,
            _ => false,
        };
        if is_elsewhere {
            part.mention.ids = vec![whole.id];
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use cinesplat_language::Mention;
    use glam::DVec3;

    #[test]
    fn a_part_is_one_of_the_thing_before_it() {
        let names: Vec<NamedObject> = [(1, "window"), (2, "navy bed"), (3, "bench")]
            .map(|(id, label)| NamedObject { id, label: label.to_owned() })
            .to_vec();
        let ids = |prompt: &str, mentions: &[(&str, u32)]| -> Vec<Vec<u32>> {
            let mention = |(words, id): &(&str, u32)| {
                let start = prompt.find(words).unwrap();
                let mention = Mention { bytes: [start, start + words.len()], ids: vec![*id] };
                FoundMention { mention, probability: 1.0, nearest: Vec::new() }
            };
            let mut found: Vec<FoundMention> = mentions.iter().map(mention).collect();
            own_parts(prompt, &names, Places { objects: &[], up: DVec3::Y }, &mut found).unwrap();
            found.into_iter().map(|found| found.mention.ids).collect()
        };
        let bed = "to the bed and end on the cushions";
        assert_eq!(ids(bed, &[("the bed", 2), ("the cushions", 3)]), [[2], [2]]);
        assert_eq!(ids("the bed, then the bench", &[("the bed", 2), ("the bench", 3)]), [[2], [3]]);
    }

    #[test]
    fn the_face_of_a_person_is_that_of_his_head() {
        let part = |id, label: &str, y: f64, parent| Object {
            parent,
            ..Object::from_box(id, label, DVec3::Y * y, DVec3::new(0.4, 1.0, 0.4))
        };
        let whole = Object::from_box(1, "tall gray object", DVec3::Y * 2.0, DVec3::new(0.4, 2.0, 0.4));
        let crumb = Object::from_box(4, "small olive object", DVec3::X * 3.0, DVec3::splat(0.1));
        let objects = [whole, part(2, "body", 1.0, Some(1)), part(3, "head", 3.0, Some(1)), crumb];
        let names: Vec<NamedObject> =
            objects.iter().map(|object| NamedObject { id: object.id, label: object.label.clone() }).collect();
        let id = |words: &str, ids: &[u32]| {
            let mention = Mention { bytes: [0, words.len()], ids: ids.to_vec() };
            let mut found = vec![FoundMention { mention, probability: 1.0, nearest: Vec::new() }];
            own_parts(words, &names, Places { objects: &objects, up: DVec3::Y }, &mut found).unwrap();
            found[0].mention.ids.clone()
        };
        assert_eq!(id("his face", &[]), [3]);
        assert_eq!(id("the man's helmet", &[1]), [3]);
        assert_eq!(id("its feet", &[4]), [1]);
        assert_eq!(id("the olive object", &[4]), [4]);
        assert_eq!(id("his shoes", &[]), [1]);
        assert_eq!(id("his left arm", &[3]), [1]);
    }

    #[test]
    fn ends_that_no_part_reaches_are_those_of_the_whole_thing() {
        let part = |id, label: &str, y: f64, parent| Object {
            parent,
            ..Object::from_box(id, label, DVec3::Y * y, DVec3::new(0.4, 1.0, 0.4))
        };
        let whole = Object::from_box(1, "tall brown object", DVec3::Y * 2.0, DVec3::new(0.4, 2.0, 0.4));
        let objects = [whole, part(2, "body", 1.0, Some(1)), part(3, "neck", 3.0, Some(1))];
        let names: Vec<NamedObject> =
            objects.iter().map(|object| NamedObject { id: object.id, label: object.label.clone() }).collect();
        let ids = |prompt: &str, mentions: &[(&str, &[u32])]| -> Vec<Vec<u32>> {
            let mention = |(words, ids): &(&str, &[u32])| {
                let start = prompt.find(words).unwrap();
                let mention = Mention { bytes: [start, start + words.len()], ids: ids.to_vec() };
                FoundMention { mention, probability: 1.0, nearest: Vec::new() }
            };
            let mut found: Vec<FoundMention> = mentions.iter().map(mention).collect();
            own_parts(prompt, &names, Places { objects: &objects, up: DVec3::Y }, &mut found).unwrap();
            found.into_iter().map(|found| found.mention.ids).collect()
        };
        let rise = "rise from the feet of the stand to the pegs";
        assert_eq!(ids(rise, &[("the feet of the stand", &[]), ("the pegs", &[3])]), [[1], [3]]);
        assert_eq!(ids("down to the feet of the stand", &[("the feet of the stand", &[3])]), [[1]]);
        assert_eq!(ids("down to the foot", &[("the foot", &[2])]), [[2]]);
        assert_eq!(ids("in on the eye socket", &[]), [[1]]);
        let all = "close on the body, pull back to see all of it";
        assert_eq!(ids(all, &[("the body", &[2])]), [[2], [1]]);
        // The pegs are a part of necks.
        assert_eq!(ids("the neck and its pegs", &[("the neck", &[3]), ("its pegs", &[])]), [[3], [3]]);
    }
}

//! Names that the words around them make clear: what is in a thing (`the yellow mug until I can see the coffee in it`), what hangs on
//! it (`the tools hanging on the wall`), the picture on an easel, and the cushions of a sofa.

use std::collections::BTreeSet;

use cinesplat_language::{NamedObject, Relation, Things, Word, is_listed, stem, tokenize};

use crate::explained::{content, head, is_number, label, said};
use crate::names::FoundMention;

/// Words behind what is in a thing.
const INSIDE: [&[&str]; 5] = [&["in", "it"], &["inside", "it"], &["inside"], &["in", "there"], &["in", "them"]];
/// Words before it.
const SEEN: &str = "until till til untill see sees show shows so look";
/// What lies on beds and seats, and what it lies on.
const SOFT: &str = "cushion pillow";
const SEATS: &str = "bed sofa couch armchair chair settee cot crib daybed";
/// What hangs on an easel.
const CANVASES: &str = "painting picture canvas drawing portrait artwork";
/// What bears things that its label names first: `tool wall`.
const BEARERS: &str = "wall board rack shelf stand panel";
const COLORS: &str =
    "red orange yellow green blue navy purple pink white black grey gray brown cream teal gold golden silver";
/// Largest number of words between a thing and what bears it.
const MOST_BETWEEN: usize = 6;
/// Words between a thing and what bears it.
const HANGS: &str = "that which are is hang hangs hanging sit sits sitting stand standing hung mounted pinned up there on at against \
    along the a on";

/// Points mentions at what the words around them make clear.
pub(crate) fn point_by_words(prompt: &str, objects: &[NamedObject], found: &mut Vec<FoundMention>) {
    let mut easel: Option<Vec<u32>> = None;
    for nth in 0..found.len() {
        if found[nth].mention.ids.is_empty() {
            if let Some(ids) = borne(prompt, objects, found, nth) {
                found[nth].mention.ids = ids;
            }
            continue;
        }
        if let [id] = found[nth].mention.ids[..]
            && label(objects, id).is_some_and(is_easel)
        {
            easel = Some(vec![id]);
        }
        if is_number(said(prompt, &found[nth].mention)) {
            if let Some(ids) = on_numbered_easel(said(prompt, &found[nth].mention), objects) {
                found[nth].mention.ids = ids;
            }
            continue;
        }
        let ids = held(prompt, objects, found, nth)
            .or_else(|| of_seat(prompt, objects, found, nth))
            .or_else(|| of_cupboard(prompt, objects, found, nth))
            .or_else(|| on_easel(prompt, objects, found, nth).inspect(|ids| easel = Some(ids.clone())))
            .or_else(|| canvases(prompt, objects, found, nth))
            .or_else(|| {
                let hangs = behind(prompt, found[nth].mention.bytes[1]).first().is_some_and(|word| word.text == "on");
                easel.clone().filter(|_| is_only_canvas(said(prompt, &found[nth].mention)) && !hangs)
            });
        if let Some(ids) = ids {
            found[nth].mention.ids = ids;
        } else if let Some((id, to)) = bearing(prompt, objects, found, nth) {
            found[nth].mention.ids = vec![id];
            found[nth].mention.bytes[1] = to;
        }
    }
    // What a longer mention says again.
    let mut nth = 1;
    while nth < found.len() {
        if found[nth].mention.bytes[0] < found[nth - 1].mention.bytes[1] {
            found.remove(nth);
        } else {
            nth += 1;
        }
    }
}

/// The words from a byte on.
fn behind(prompt: &str, from: usize) -> Vec<Word> {
    tokenize(prompt.get(from..).unwrap_or_default())
}

/// The thing named before in which something is that the scene has no thing for: the coffee in it.
fn held(prompt: &str, objects: &[NamedObject], found: &[FoundMention], nth: usize) -> Option<Vec<u32>> {
    let mention = &found[nth].mention;
    let words = behind(prompt, mention.bytes[1]);
    let is_inside = INSIDE
        .iter()
        .any(|phrase| phrase.len() <= words.len() && phrase.iter().zip(&words).all(|(said, word)| word.text == **said));
    let own = head(said(prompt, mention))?;
    let is_named = mention.ids.iter().filter_map(|id| label(objects, *id)).any(|label| content(label).contains(&own));
    let before = found[..nth].last().filter(|before| matches!(before.mention.ids[..], [_]))?;
    let lead = tokenize(prompt.get(before.mention.bytes[1]..mention.bytes[0]).unwrap_or_default());
    let sees = lead.iter().any(|word| is_listed(SEEN, &word.text));
    (is_inside && !is_named && sees).then(|| before.mention.ids.clone())
}

/// The bed or seat named last, for `the cushions` of it.
fn of_seat(prompt: &str, objects: &[NamedObject], found: &[FoundMention], nth: usize) -> Option<Vec<u32>> {
    let mention = &found[nth].mention;
    let own = head(said(prompt, mention)).filter(|own| is_listed(SOFT, own))?;
    let has = |id: &u32, list: &str| {
        label(objects, *id).is_some_and(|label| content(label).iter().any(|word| is_listed(list, word)))
    };
    if mention.ids.iter().any(|id| has(id, &own) || has(id, SEATS)) || content(said(prompt, mention)).len() > 1 {
        return None;
    }
    let seat = found[..nth].iter().rev().find(|before| before.mention.ids.iter().any(|id| has(id, SEATS)))?;
    Some(seat.mention.ids.clone())
}

/// The wardrobe named last that has doors, for `the doors` in a room with one door.
fn of_cupboard(prompt: &str, objects: &[NamedObject], found: &[FoundMention], nth: usize) -> Option<Vec<u32>> {
    let mention = &found[nth].mention;
    let words = tokenize(said(prompt, mention));
    let is_door = |id: &u32| label(objects, *id).and_then(head).as_deref() == Some("door");
    let is_plural = matches!(&words[..], [the, doors] if the.text == "the" && doors.text == "doors");
    if !is_plural || !matches!(&mention.ids[..], [id] if is_door(id)) {
        return None;
    }
    let has_doors = |id: &u32| {
        let has = |label: &str| Things::embedded().is_related(label, "door", &[Relation::Part]);
        label(objects, *id).is_some_and(has) && !is_door(id)
    };
    let before = found[..nth].iter().rev().find(|before| before.mention.ids.len() == 1)?;
    before.mention.ids.iter().all(has_doors).then(|| before.mention.ids.clone())
}

/// The easel of `the painting on the easel`.
fn on_easel(prompt: &str, objects: &[NamedObject], found: &[FoundMention], nth: usize) -> Option<Vec<u32>> {
    let mention = &found[nth].mention;
    let own = tokenize(said(prompt, mention));
    let after = behind(prompt, mention.bytes[1]);
    let words: Vec<&Word> = own.iter().chain(after.iter().take(4)).collect();
    let at = own.iter().position(|word| is_listed(CANVASES, &word.text))?;
    let is_on = words[at + 1..].iter().take(3).map(|word| word.text.as_str()).collect::<Vec<_>>();
    let is_on = matches!(is_on[..], ["on", "the" | "an" | "that", "easel"] | ["on", "easel", ..]);
    let easels = || objects.iter().filter(|object| is_easel(&object.label));
    let has_easel = |ids: &[u32]| ids.iter().any(|id| label(objects, *id).is_some_and(is_easel));
    let named = found.get(nth + 1).map(|next| next.mention.ids.clone()).filter(|ids| has_easel(ids));
    let only = || easels().next().filter(|_| easels().count() == 1).map(|easel| vec![easel.id]);
    if is_on && !has_easel(&mention.ids) { named.or_else(only) } else { None }
}

/// The easel of `the painting on easel 2`.
fn on_numbered_easel(words: &str, objects: &[NamedObject]) -> Option<Vec<u32>> {
    let own = tokenize(words);
    let on = own.iter().position(|word| word.text == "on")?;
    let name = words.get(own.get(on + 1)?.span[0]..)?;
    let is_named = |object: &&NamedObject| is_easel(&object.label) && object.label.eq_ignore_ascii_case(name);
    let easel = objects.iter().find(is_named)?;
    own[..on].iter().any(|word| is_listed(CANVASES, &word.text)).then(|| vec![easel.id])
}

/// Whether some words call an easel by what is on it, wherever that hangs: `the painting on the easel`.
pub(crate) fn is_canvas_on_easel(words: &str, objects: &[NamedObject], ids: &[u32]) -> bool {
    let is_canvas = tokenize(words).iter().take(3).any(|word| is_listed(CANVASES, &word.text));
    is_canvas && matches!(ids, [id] if label(objects, *id).is_some_and(is_easel))
}

fn is_easel(label: &str) -> bool {
    head(label).as_deref() == Some("easel")
}

/// The easels, where `the canvas` was taken for pictures on the wall: those are framed.
fn canvases(prompt: &str, objects: &[NamedObject], found: &[FoundMention], nth: usize) -> Option<Vec<u32>> {
    let mention = &found[nth].mention;
    let words = tokenize(said(prompt, mention));
    let is_plural = words.iter().any(|word| word.text == "canvases");
    let is_canvas = is_plural || words.iter().any(|word| word.text == "canvas");
    let is_easel = |id: &u32| label(objects, *id).is_some_and(is_easel);
    let easels: Vec<u32> = objects.iter().map(|object| object.id).filter(is_easel).collect();
    // `The middle easel, hold on the canvas`.
    let named = found[..nth].iter().rev().map(|before| &before.mention.ids).find(|ids| ids.iter().any(is_easel));
    let named = named.filter(|ids| ids.len() == 1 && !is_plural).cloned();
    (is_canvas && !easels.is_empty() && !mention.ids.iter().any(is_easel)).then(|| named.unwrap_or(easels))
}

/// What bears a thing that the scene has no thing for, and is named for such things: the tool wall of `the hammers on the tool wall`.
fn borne(prompt: &str, objects: &[NamedObject], found: &[FoundMention], nth: usize) -> Option<Vec<u32>> {
    let from = found[nth].mention.bytes[1];
    let bears = |bearer: &&FoundMention| {
        let [id] = bearer.mention.ids[..] else { return false };
        let between = tokenize(prompt.get(from..bearer.mention.bytes[0]).unwrap_or_default());
        let hangs =
            between.len() <= MOST_BETWEEN && between.iter().any(|word| is_listed("on along hanging", &word.text));
        let own = label(objects, id).unwrap_or_default();
        let names_more = content(own).iter().filter(|word| !is_listed(COLORS, word)).count() > 1;
        hangs && names_more && head(own).is_some_and(|head| is_listed(BEARERS, &head))
    };
    found[nth + 1..].iter().take(2).find(bears).map(|bearer| bearer.mention.ids.clone())
}

/// Whether words are only of a painting: `the painting`.
fn is_only_canvas(words: &str) -> bool {
    let content = content(words);
    let is_definite = tokenize(words).first().is_some_and(|word| matches!(word.text.as_str(), "the" | "that" | "this"));
    is_definite && content.len() == 1 && content.iter().all(|word| is_listed(CANVASES, word))
}

/// The one thing whose label says what a mention names and what it hangs on: the tool wall of `the tools hanging on the wall`. Also
/// where the mention and its place end.
fn bearing(prompt: &str, objects: &[NamedObject], found: &[FoundMention], nth: usize) -> Option<(u32, usize)> {
    let mention = &found[nth].mention;
    let [own_id] = mention.ids[..] else { return None };
    let words = said(prompt, mention);
    let own = tokenize(words);
    let after = behind(prompt, mention.bytes[1]);
    let between = after.iter().take_while(|word| is_listed(HANGS, &word.text)).count();
    let place = after.get(between).filter(|word| between > 0 && word.is_alphabetic());
    let mut told: BTreeSet<String> = content(words);
    let mut to = mention.bytes[1];
    let plain = |label: &str| -> BTreeSet<String> {
        content(label).into_iter().filter(|word| !is_listed(COLORS, word)).collect()
    };
    let is_whole = label(objects, own_id).is_some_and(|label| plain(label).is_subset(&told));
    if is_whole {
        return None;
    }
    if let Some(place) = place {
        told.insert(place.stem.clone());
        to = mention.bytes[1] + place.span[1];
    }
    let fits = |object: &&NamedObject| {
        let own = plain(&object.label);
        own.len() > 1 && own.is_subset(&told) && head(&object.label).is_some_and(|head| is_listed(BEARERS, &head))
    };
    let mut all = objects.iter().filter(fits);
    if let (Some(one), None) = (all.next(), all.next()) {
        return Some((one.id, to));
    }
    // `The hanging tools`.
    let last = own.iter().rev().find(|word| word.is_alphabetic()).filter(|last| last.stem != last.text)?;
    let hangs = own.iter().chain(after.iter().take(3)).any(|word| is_listed("hanging hang hung", &word.text));
    let bears = |object: &&NamedObject| {
        let words: Vec<String> = tokenize(&object.label)
            .iter()
            .map(|word| stem(&word.text))
            .filter(|word| !is_listed(COLORS, word))
            .collect();
        matches!(&words[..], [first, .., bearer] if *first == last.stem && is_listed(BEARERS, bearer))
    };
    let mut all = objects.iter().filter(bears);
    match (all.next(), all.next()) {
        (Some(one), None) if hangs => Some((one.id, mention.bytes[1])),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::said::fixture::labelled;
    use cinesplat_language::Mention;

    fn pointed(prompt: &str, mentions: &[(&str, u32)]) -> Vec<u32> {
        let objects = labelled(&[
            "yellow mug",
            "wine glass",
            "tool wall",
            "orange toolbox",
            "navy bed",
            "bench",
            "easel",
            "picture 1",
            "wardrobe",
            "pink door",
        ]);
        let mention = |(words, id): &(&str, u32)| {
            let start = prompt.find(words).unwrap();
            let mention = Mention { bytes: [start, start + words.len()], ids: vec![*id] };
            FoundMention { mention, probability: 1.0, nearest: Vec::new() }
        };
        let mut found: Vec<FoundMention> = mentions.iter().map(mention).collect();
        point_by_words(prompt, &objects, &mut found);
        found.into_iter().flat_map(|found| found.mention.ids).collect()
    }

    #[test]
    fn a_canvas_is_on_an_easel_and_tools_are_on_their_wall() {
        assert_eq!(pointed("push in on the canvas", &[("the canvas", 8)]), [7]);
        assert_eq!(pointed("push in on the picture", &[("the picture", 8)]), [8]);
        let mut found: Vec<FoundMention> = ["the hammers", "the tool wall"]
            .into_iter()
            .zip([vec![], vec![3]])
            .map(|(words, ids)| {
                let start = TOOLS.find(words).unwrap();
                let mention = Mention { bytes: [start, start + words.len()], ids };
                FoundMention { mention, probability: 1.0, nearest: Vec::new() }
            })
            .collect();
        let objects = [NamedObject { id: 3, label: "tool wall".to_owned() }];
        point_by_words(TOOLS, &objects, &mut found);
        assert_eq!(found[0].mention.ids, [3]);
    }
    const TOOLS: &str = "first the hammers and other tools on the tool wall";

    #[test]
    fn what_is_in_a_thing_is_seen_in_it() {
        let go = "go in on the yellow mug until I can see the coffee in it";
        assert_eq!(pointed(go, &[("the yellow mug", 1), ("the coffee", 2)]), [1, 1]);
        assert_eq!(pointed("from the mug to the glass in it", &[("the mug", 1), ("the glass", 2)]), [1, 2]);
    }

    #[test]
    fn what_hangs_on_a_wall_is_the_wall_of_it() {
        let tools = [("the tools", 4)];
        assert_eq!(pointed("tilt up to the tools hanging on the wall", &tools), [3]);
        assert_eq!(pointed("tilt up to the tools on the wall, then pan", &tools), [3]);
        assert_eq!(pointed("pan to the hanging tools", &[("the hanging tools", 4)]), [3]);
        assert_eq!(pointed("pan to the tools", &tools), [4]);
        assert_eq!(pointed("pan to the toolbox on the wall", &[("the toolbox", 4)]), [4]);
    }

    #[test]
    fn cushions_lie_on_what_was_named() {
        let bed = "over to the bed and end up on the cushions";
        assert_eq!(pointed(bed, &[("the bed", 5), ("the cushions", 6)]), [5, 5]);
        assert_eq!(pointed("end up on the cushions", &[("the cushions", 6)]), [6]);
    }

    #[test]
    fn the_painting_on_an_easel_is_the_easel() {
        let ends = "end on the painting on the easel. the painting fills the frame";
        let mut found = pointed(ends, &[("the painting on the easel", 8)]);
        assert_eq!(found, [7]);
        found = pointed("pan to the painting over the easel", &[("the painting", 8)]);
        assert_eq!(found, [8]);
    }

    #[test]
    fn the_doors_behind_a_wardrobe_are_its_own() {
        assert_eq!(
            pointed("creep toward the wardrobe, stop before the doors", &[("wardrobe", 9), ("the doors", 10)]),
            [9, 9]
        );
        assert_eq!(
            pointed("creep toward the wardrobe, stop before the door", &[("wardrobe", 9), ("the door", 10)]),
            [9, 10]
        );
        assert_eq!(pointed("creep toward the bed, stop before the doors", &[("bed", 5), ("the doors", 10)]), [5, 10]);
    }
}

//! Things of one kind that are told by their size: `the big plant`, where a small one stands beside it.

use cinesplat_language::{NamedObject, Word, is_listed, tokenize};
use cinesplat_objects::Object;

use crate::explained::{content, head, is_number, label, said};
use crate::names::FoundMention;
use crate::placed::Places;

/// Words of size.
const BIG: &str = "big bigger biggest large larger largest tall taller tallest huge giant great";
const SMALL: &str = "small smaller smallest little tiny short miniature mini";

fn is_size(word: &Word) -> bool {
    is_listed(BIG, &word.text) || is_listed(SMALL, &word.text)
}

/// Points mentions of one thing that say its size, which its label does not, at the largest or smallest of its kind that fits
/// their other words as well.
pub(crate) fn point_by_size(prompt: &str, objects: &[NamedObject], places: Places<'_>, found: &mut [FoundMention]) {
    for at in 0..found.len() {
        let [id] = found[at].mention.ids[..] else { continue };
        let before = found[..at].iter().rev().find_map(|found| found.mention.ids.first().copied());
        let found = &mut found[at];
        let words = said(prompt, &found.mention);
        let told = tokenize(words);
        let says = |list: &str| told.iter().any(|word| is_listed(list, &word.text));
        let (is_big, is_small) = (says(BIG), says(SMALL));
        let names_none = |word: &Word| is_listed("the one", &word.text) || is_size(word);
        let is_same_kind = told.iter().all(names_none);
        let behind = prompt[found.mention.bytes[1]..].strip_prefix(" one");
        if is_same_kind && behind.is_some_and(|rest| !rest.starts_with(char::is_alphanumeric)) {
            found.mention.bytes[1] += " one".len();
        }
        // `the smaller one` is of the kind that was named before, if there are several of it.
        let of_several = |id: &u32| {
            let kind = label(objects, *id).map(head);
            objects.iter().filter(|object| Some(head(&object.label)) == kind).count() > 1
        };
        let id = before.filter(|id| is_same_kind && of_several(id)).unwrap_or(id);
        let own = label(objects, id).unwrap_or_default();
        let is_one = told.iter().rev().find(|word| word.is_alphabetic()).is_some_and(|word| word.stem == word.text);
        let is_sized = |label: &str| tokenize(label).iter().any(is_size);
        let contradicts = |label: &str| {
            let words = tokenize(label);
            words.iter().any(|word: &Word| is_listed(if is_big { SMALL } else { BIG }, &word.text))
        };
        // A label with a size of its own is chosen by it.
        if is_number(words) || is_big == is_small || !is_one || is_sized(own) && !contradicts(own) {
            continue;
        }
        let kind = head(own);
        let told = content(words);
        let fit = |label: &str| content(label).iter().filter(|word| told.contains(*word)).count();
        let of_kind = objects.iter().filter(|object| head(&object.label) == kind && !contradicts(&object.label));
        let least = if contradicts(own) { 0 } else { fit(own) };
        let radius = |id: u32| places.objects.iter().find(|object| object.id == id).map_or(0.0, Object::radius);
        let sized = of_kind.filter(|object| fit(&object.label) >= least);
        if let Some(best) = of_extreme_size(sized.map(|object| object.id), is_big, radius) {
            found.mention.ids = vec![best];
        }
    }
}

/// Words of the wider and the narrower one of two.
const WIDER: &str = "wider widest broader broadest";
const NARROWER: &str = "narrower narrowest slimmer";
const BIGGER: &str = "bigger biggest larger largest taller tallest";
const SMALLER: &str = "smaller smallest shorter shortest";

/// Points mentions of several things at the one of them that the words before tell by its size: `the narrower of the two windows`.
pub(crate) fn point_by_comparison(prompt: &str, places: Places<'_>, found: &mut [FoundMention]) {
    if places.objects.is_empty() {
        return;
    }
    let words = tokenize(prompt);
    for found in found.iter_mut().filter(|found| found.mention.ids.len() > 1) {
        let Some(first) = words.iter().position(|word| word.span[0] >= found.mention.bytes[0]) else { continue };
        let is_joint = |word: &&Word| is_listed("of the these those both two three", &word.text);
        let joints = words[..first].iter().rev().take_while(is_joint).count();
        let before = words[..first - joints].last();
        let says = |list: &str| before.is_some_and(|word| is_listed(list, &word.text));
        let is_of = words[first - joints..].iter().take(joints + 1).any(|word| word.text == "of");
        let is_width = says(WIDER) || says(NARROWER);
        let is_most = says(WIDER) || says(BIGGER);
        if !is_of || !(is_width || is_most || says(SMALLER)) {
            continue;
        }
        let size = |id: u32| {
            let object = places.objects.iter().find(|object| object.id == id);
            object.map_or(0.0, |object| if is_width { width(object, places) } else { object.radius() })
        };
        let best = of_extreme_size(found.mention.ids.iter().copied(), is_most, size);
        if let (Some(best), Some(before)) = (best, before) {
            found.mention.ids = vec![best];
            found.mention.bytes[0] = before.span[0];
        }
    }
}

/// The object of the largest size, or of the smallest.
fn of_extreme_size(ids: impl Iterator<Item = u32>, is_largest: bool, size: impl Fn(u32) -> f64) -> Option<u32> {
    let by_size = |a: &u32, b: &u32| size(*a).total_cmp(&size(*b));
    if is_largest { ids.max_by(by_size) } else { ids.min_by(by_size) }
}

/// How far an object reaches sideways, scene units.
fn width(object: &Object, places: Places<'_>) -> f64 {
    let [bottom, top] = object.span_along(places.up);
    (object.radius().powi(2) - (0.5 * (top - bottom)).powi(2)).max(0.0).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use cinesplat_language::Mention;
    use glam::DVec3;

    #[test]
    fn the_big_one_of_a_kind_is_not_the_small_one() {
        let labels = [
            (1, "pink small plant", 0.1),
            (2, "white potted plant", 0.4),
            (3, "blue mug 1", 0.1),
            (4, "blue mug 2", 0.2),
        ];
        let objects = labels.map(|(id, label, half)| Object::from_box(id, label, DVec3::ZERO, DVec3::splat(half)));
        let names: Vec<NamedObject> =
            objects.iter().map(|object| NamedObject { id: object.id, label: object.label.clone() }).collect();
        let pointed = |words: &str, id: u32| {
            let mention = Mention { bytes: [0, words.len()], ids: vec![id] };
            let mut found = [FoundMention { mention, probability: 1.0, nearest: Vec::new() }];
            point_by_size(words, &names, Places { objects: &objects, up: DVec3::Y }, &mut found);
            found[0].mention.ids.clone()
        };
        assert_eq!(pointed("the big green plant", 1), [2]);
        assert_eq!(pointed("the small plant", 1), [1]);
        assert_eq!(pointed("the bigger blue mug", 3), [4]);
        assert_eq!(pointed("the blue mug", 3), [3]);
    }

    #[test]
    fn the_smaller_one_is_of_the_kind_named_before() {
        let labels = [(1, "window 1", 1.2), (2, "window 2", 0.6), (3, "sideboard", 0.5)];
        let objects = labels.map(|(id, label, half)| Object::from_box(id, label, DVec3::ZERO, DVec3::splat(half)));
        let names: Vec<NamedObject> =
            objects.iter().map(|object| NamedObject { id: object.id, label: object.label.clone() }).collect();
        let pointed = |prompt: &str, words: [&str; 2], ids: [u32; 2]| {
            let found = |(words, id): (&str, u32)| {
                let start = prompt.find(words).unwrap();
                let mention = Mention { bytes: [start, start + words.len()], ids: vec![id] };
                FoundMention { mention, probability: 1.0, nearest: Vec::new() }
            };
            let mut found = words.into_iter().zip(ids).map(found).collect::<Vec<_>>();
            point_by_size(prompt, &names, Places { objects: &objects, up: DVec3::Y }, &mut found);
            found.into_iter().map(|found| found.mention).collect::<Vec<_>>()
        };
        let pan = "pan from the big window to the smaller one.";
        let mentions = pointed(pan, ["the big window", "the smaller"], [2, 3]);
        assert_eq!([&mentions[0].ids, &mentions[1].ids], [&vec![1], &vec![2]]);
        assert_eq!(&pan[mentions[1].bytes[0]..mentions[1].bytes[1]], "the smaller one");
        // There is one sideboard only.
        let mentions = pointed("from the sideboard to the bigger one", ["the sideboard", "the bigger"], [3, 1]);
        assert_eq!(mentions[1].ids, [1]);
    }

    #[test]
    fn the_narrower_of_two_is_told_by_its_width() {
        let boxes = [(1, "window 1", DVec3::new(2.0, 1.0, 0.1)), (2, "window 2", DVec3::new(1.0, 4.0, 0.1))];
        let objects = boxes.map(|(id, label, half)| Object::from_box(id, label, DVec3::ZERO, half));
        let pointed = |prompt: &str| {
            let start = prompt.find("windows").unwrap();
            let mention = Mention { bytes: [start, start + 7], ids: vec![1, 2] };
            let mut found = [FoundMention { mention, probability: 1.0, nearest: Vec::new() }];
            point_by_comparison(prompt, Places { objects: &objects, up: DVec3::Y }, &mut found);
            found[0].mention.ids.clone()
        };
        assert_eq!(pointed("go to the narrower of the two windows"), [2]);
        assert_eq!(pointed("go to the larger of the windows"), [2]);
        assert_eq!(pointed("go to the wider of both windows"), [1]);
        assert_eq!(pointed("make it narrower, show the two windows"), [1, 2]);
    }
}

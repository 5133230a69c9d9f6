//! Things that the words tell by the side on which they are: `the left lamp`, `the lamp on the right`, `the right-hand one`.

use std::collections::BTreeSet;

use cinesplat_language::{Mention, NamedObject, Word, is_listed, tokenize};
use glam::DVec3;

use super::extent::Places;
use crate::explained::{content, label, said};

/// A side, as somebody sees it who looks from the middle of the place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Flank {
    Left,
    Right,
}

/// What is no side of several things: `the left third`, `the left side of it`.
const SIDES: &str = "third side edge half corner hand end part arm leg earcup ear cup wall";

/// The side by which the words of a mention tell a thing from others: an adjective before a noun, or `on the left` at its end.
pub(crate) fn told_flank(words: &[Word]) -> Option<Flank> {
    let text = |at: usize| words.get(at).map_or("", |word| word.text.as_str());
    let side = |at: usize| match text(at) {
        "left" | "leftmost" => Some(Flank::Left),
        "right" | "rightmost" => Some(Flank::Right),
        _ => None,
    };
    let at = (0..words.len()).find(|at| side(*at).is_some())?;
    // `Left hand` and `left-hand`.
    let dash = usize::from(text(at + 1) == "-");
    let next = at + 1 + if text(at + 1 + dash) == "hand" { 1 + dash } else { 0 };
    let is_adjective = next < words.len()
        && !is_listed(SIDES, text(next))
        && words[next].is_alphabetic()
        && !is_listed("of in on at from", text(next));
    let is_place = at > 1 && is_listed("on to at", text(at - 2)) && text(at - 1) == "the" && next >= words.len();
    (is_adjective || is_place).then(|| side(at)).flatten()
}

/// The outermost of some things on a side, as they are seen from the middle of the place; of two that are called alike before others
/// of the kind, which `labels` tells.
pub(crate) fn outermost(places: Places<'_>, ids: &[u32], flank: Flank) -> Option<u32> {
    let center = |id: u32| places.objects.iter().find(|object| object.id == id).map(|object| object.center);
    let mean = |points: &[DVec3]| points.iter().sum::<DVec3>() / points.len().max(1) as f64;
    let all: Vec<DVec3> = places.objects.iter().map(|object| object.center).collect();
    let own: Vec<(u32, DVec3)> = ids.iter().filter_map(|id| Some((*id, center(*id)?))).collect();
    let low = all.iter().copied().reduce(DVec3::min)?;
    let high = all.iter().copied().reduce(DVec3::max)?;
    let middle = (low + high) / 2.0;
    let ahead = mean(&own.iter().map(|(_, at)| *at).collect::<Vec<_>>()) - middle;
    let right = ahead.cross(places.up).try_normalize()?;
    let by_side = |a: &&(u32, DVec3), b: &&(u32, DVec3)| a.1.dot(right).total_cmp(&b.1.dot(right));
    let one = if flank == Flank::Left { own.iter().min_by(by_side) } else { own.iter().max_by(by_side) };
    one.map(|(id, _)| *id).filter(|_| own.len() > 1)
}

/// The one of several things of a kind that is on the side that the words tell: `the left lamp`.
pub(super) fn flanking(
    prompt: &str,
    objects: &[NamedObject],
    places: Places<'_>,
    mention: &Mention,
    alike: &[u32],
) -> Option<Vec<u32>> {
    let mut words = tokenize(said(prompt, mention));
    let behind = tokenize(prompt.get(mention.bytes[1]..).unwrap_or_default());
    // `The lamp on the left`, and not `on the left third`.
    let side = behind.get(2).is_some_and(|word| is_listed("left right", &word.text));
    let ends =
        behind.get(3).is_none_or(|word| !word.is_alphabetic() || is_listed("and then to so until with", &word.text));
    if side && ends && alike.len() > 1 {
        words.extend(behind.iter().take(3).cloned());
    }
    let flank = told_flank(&words)?;
    let own = mention.ids.first().and_then(|id| label(objects, *id)).map(content)?;
    // Of several kinds the one of which there are several.
    let called = |id: &u32| label(objects, *id).map(content).unwrap_or_default();
    let of = |kind: &BTreeSet<String>| -> Vec<u32> { alike.iter().copied().filter(|id| called(id) == *kind).collect() };
    let twins = || alike.iter().map(|id| of(&called(id))).find(|twins| twins.len() == 2);
    let kind = Some(of(&own)).filter(|kind| kind.len() > 1).or_else(twins).unwrap_or_else(|| alike.to_vec());
    outermost(places, &kind, flank).map(|id| vec![id])
}

/// Words of the largest of several things, and of the smallest.
const LARGE: &str = "big biggest bigger large largest larger huge great main";
const SMALL: &str = "small smallest smaller little tiny";

/// The largest or the smallest of some things where the words of a mention of one of them say so: `the big picture`.
pub(super) fn of_size(places: Places<'_>, words: &str, ids: &[u32]) -> Option<Vec<u32>> {
    let words = tokenize(words);
    let last = words.iter().rev().find(|word| word.is_alphabetic())?;
    let has = |list: &str| words.iter().any(|word| is_listed(list, &word.text));
    let extent = |id: &u32| {
        let corners = places.objects.iter().find(|object| object.id == *id)?.corners();
        let low = corners.iter().copied().reduce(DVec3::min)?;
        let high = corners.iter().copied().reduce(DVec3::max)?;
        Some((low.distance(high), *id))
    };
    let sizes: Vec<(f64, u32)> = ids.iter().filter_map(extent).collect();
    let by_size = |a: &&(f64, u32), b: &&(f64, u32)| a.0.total_cmp(&b.0);
    let one = match (has(LARGE), has(SMALL)) {
        (true, false) => sizes.iter().max_by(by_size),
        (false, true) => sizes.iter().min_by(by_size),
        _ => None,
    };
    one.filter(|_| sizes.len() > 1 && last.stem == last.text).map(|(_, id)| vec![*id])
}

#[cfg(test)]
mod tests {
    use super::*;
    use cinesplat_objects::Object;

    #[test]
    fn a_side_tells_things_apart() {
        let told = |text: &str| told_flank(&tokenize(text));
        assert_eq!(told("the left lamp"), Some(Flank::Left));
        assert_eq!(told("the right-hand one"), Some(Flank::Right));
        assert_eq!(told("the lamp on the right"), Some(Flank::Right));
        for other in ["the left side of the table", "the left third", "the lamp", "the left of the table"] {
            assert_eq!(told(other), None, "{other}");
        }
    }

    #[test]
    fn left_is_that_of_the_middle_of_the_place() {
        let at = |id, x: f64, z: f64| Object::from_box(id, "lamp", DVec3::new(x, 0.0, z), DVec3::splat(0.1));
        let objects = [at(1, -1.0, -2.0), at(2, 1.0, -2.0), at(3, 0.0, 2.0)];
        let places = Places { objects: &objects, up: DVec3::Y };
        assert_eq!(outermost(places, &[1, 2], Flank::Left), Some(1));
        assert_eq!(outermost(places, &[1, 2], Flank::Right), Some(2));
        assert_eq!(outermost(places, &[1], Flank::Left), None);
    }

    #[test]
    fn a_size_tells_one_of_several() {
        let at = |id, half: f64| Object::from_box(id, "picture", DVec3::ZERO, DVec3::splat(half));
        let objects = [at(1, 0.2), at(2, 0.6), at(3, 0.4)];
        let places = Places { objects: &objects, up: DVec3::Y };
        assert_eq!(of_size(places, "the big sunset picture", &[1, 2, 3]), Some(vec![2]));
        assert_eq!(of_size(places, "the little picture", &[1, 2, 3]), Some(vec![1]));
        assert_eq!(of_size(places, "the big pictures", &[1, 2, 3]), None);
        assert_eq!(of_size(places, "the picture", &[1, 2, 3]), None);
    }
}

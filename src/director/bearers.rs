//! What something stands on, by its own name: `pull back till we see the shelf it stands on`, in a scene whose shelf is no object.

use cinesplat_language::{NamedObject, is_listed, tokenize};
use cinesplat_objects::Object;

use crate::explained::{content, label, said};
use crate::names::FoundMention;
use crate::placed::Places;

/// Words behind the name of what bears something.
const THAT: &str = "that which";
const BORNE: &str = "it he she they this";
const STANDS: &str =
    "sit sits sitting stand stands standing rest rests resting lie lies lying is are 's was sat stood hang hangs";
const ON: &str = "on upon from off";
/// Gap between a thing and what bears it, over the height of the thing, up to which it stands on it.
const MOST_GAP: f64 = 0.5;

/// Removes mentions of what bears the thing named before that were taken for a thing of another name which does not bear it.
pub(crate) fn drop_other_bearers(
    prompt: &str,
    objects: &[NamedObject],
    places: Places<'_>,
    found: &mut Vec<FoundMention>,
) {
    let object = |id: u32| places.objects.iter().find(|object| object.id == id);
    let is_other = |nth: usize| {
        let mention = &found[nth].mention;
        let named = mention.ids.first().and_then(|id| Some((object(*id)?, label(objects, *id)?)));
        let Some((bearer, label)) = named.filter(|_| bears(prompt, mention.bytes)) else { return false };
        let is_called = !content(said(prompt, mention)).is_disjoint(&content(label));
        let borne = found[..nth].iter().rev().find_map(|found| object(*found.mention.ids.first()?));
        !is_called && borne.is_some_and(|borne| !stands_on(places, borne, bearer))
    };
    let is_kept: Vec<bool> = (0..found.len()).map(|nth| !is_other(nth)).collect();
    let mut is_kept = is_kept.into_iter();
    found.retain(|_| is_kept.next().unwrap_or(true));
}

/// Whether the words behind a mention say that something stands on what it names; the mention may end with `it`.
fn bears(prompt: &str, [from, to]: [usize; 2]) -> bool {
    let last = tokenize(prompt.get(from..to).unwrap_or_default()).pop();
    let end = last.filter(|word| is_listed(BORNE, &word.text)).map_or(to, |word| from + word.span[0]);
    let words = tokenize(prompt.get(end..).unwrap_or_default());
    let text = |at: usize| words.get(at).map_or("", |word| word.text.as_str());
    let borne = usize::from(is_listed(THAT, text(0)));
    let verbs = (borne + 1..words.len()).take(2).take_while(|at| is_listed(STANDS, text(*at))).count();
    is_listed(BORNE, text(borne)) && verbs > 0 && is_listed(ON, text(borne + 1 + verbs))
}

/// Whether one thing is on or in another.
fn stands_on(places: Places<'_>, borne: &Object, bearer: &Object) -> bool {
    let ([low, high], [foot, top]) = (borne.span_along(places.up), bearer.span_along(places.up));
    let away = borne.center - bearer.center;
    let up = places.up.normalize_or_zero();
    let aside = (away - up * away.dot(up)).length();
    low >= foot && low - top <= MOST_GAP * (high - low) && aside <= borne.radius() + bearer.radius()
}

#[cfg(test)]
mod tests {
    use super::*;
    use cinesplat_language::Mention;
    use glam::DVec3;

    fn kept(prompt: &str, mentions: &[(&str, u32)]) -> usize {
        let at = |id, label: &str, y: f64| Object::from_box(id, label, DVec3::Y * y, DVec3::splat(0.2));
        let objects = [at(1, "red teapot", 2.0), at(2, "base cabinet", 0.4), at(3, "oak chest", 1.6)];
        let names: Vec<NamedObject> =
            objects.iter().map(|object| NamedObject { id: object.id, label: object.label.clone() }).collect();
        let mention = |(words, id): &(&str, u32)| {
            let start = prompt.find(words).unwrap();
            let mention = Mention { bytes: [start, start + words.len()], ids: vec![*id] };
            FoundMention { mention, probability: 1.0, nearest: Vec::new() }
        };
        let mut found: Vec<FoundMention> = mentions.iter().map(mention).collect();
        drop_other_bearers(prompt, &names, Places { objects: &objects, up: DVec3::Y }, &mut found);
        found.len()
    }

    #[test]
    fn what_bears_a_thing_is_below_it() {
        let shelf = "pull back from the teapot till we see the shelf it stands on";
        assert_eq!(kept(shelf, &[("the teapot", 1), ("the shelf", 2)]), 1);
        assert_eq!(kept(shelf, &[("the teapot", 1), ("the shelf it", 2)]), 1);
        assert_eq!(kept(shelf, &[("the teapot", 1), ("the shelf", 3)]), 2);
        let cabinet = "pull back from the teapot till we see the cabinet it stands on";
        assert_eq!(kept(cabinet, &[("the teapot", 1), ("the cabinet", 2)]), 2);
        let other = "from the teapot to the shelf, it stands out";
        assert_eq!(kept(other, &[("the teapot", 1), ("the shelf", 2)]), 2);
    }
}

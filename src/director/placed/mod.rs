//! Names of things that other things place: `the plant under the clock`, `the other guitar`, `the three pictures above it`.
//!
//! Enters: the mentions of a prompt, and where the objects of the scene are. Leaves: of several things of one kind those that
//! the words place. Where the words place nothing, the mentions stay.

mod extent;
mod flanks;
mod placing;
mod relations;

use cinesplat_language::{Mention, NamedObject, Relation as Kinship, Things, Word, is_listed, number_word, tokenize};

pub use extent::Places;
pub(crate) use extent::hangs_over;
use extent::{Relation, boxes, cornermost, fit, lowest};
pub(crate) use flanks::{Flank, outermost, told_flank};
use flanks::{flanking, of_size};
use placing::{placed_behind, placed_later, placed_with, rest_of};
use relations::{inner_place, relation_of, says_corner, says_floor, says_way};

use crate::contained::is_canvas_on_easel;
use crate::explained::{content, head, is_number, label, said};
use crate::hung;
use crate::names::FoundMention;

/// Words of another thing of the kind.
const OTHERS: &str = "other another remaining";
/// Farthest that a thing above or below another one is beside it, share of the other one's width.
const ASIDE: f64 = 0.5;

/// Farthest that things on another one, or right above it, are from it, scene units.
const TOUCHING: f64 = 0.15;

/// Points mentions that fit several things of a kind at the ones that the words place.
pub(crate) fn point_by_places(
    prompt: &str,
    objects: &[NamedObject],
    places: Places<'_>,
    found: &mut Vec<FoundMention>,
) {
    let mut narrowed: Option<(Vec<u32>, u32)> = None;
    // All of the kind by which a thing was placed last.
    let mut last_place = Vec::new();
    let mut nth = 0;
    while let Some(mention) = found.get(nth) {
        nth += 1;
        let mention = &mention.mention;
        let words = said(prompt, mention);
        if mention.ids.is_empty() || is_number(words) || is_canvas_on_easel(words, objects, &mention.ids) {
            continue;
        }
        // `The one by the door` is of the kind of which several were named last.
        let kinds = || found[..nth - 1].iter().rev().map(|before| kind_of(objects, prompt, before));
        let before = kinds().find(|kind| kind.len() > 1).or_else(|| kinds().next());
        let inside = placed_inside(objects, places, mention, (words, &before.unwrap_or_default(), &last_place));
        let inside = inside.map(|(alike, ids, around)| {
            last_place = around;
            (alike, ids)
        });
        if let Some((alike, ids)) = inside.or_else(|| rest_of(words, narrowed.as_ref())) {
            if let [one] = ids[..] {
                narrowed = Some((alike, one));
            }
            found[nth - 1].mention.ids = ids;
            continue;
        }
        let alike = alike(objects, mention, words);
        let chosen = match &narrowed {
            // `Its strings` are those of the guitar that was told from the others.
            Some((all, one)) if mention.ids.len() > 1 && mention.ids == *all && is_part(objects, words, *one) => {
                Some(vec![*one])
            }
            _ => other_one(prompt, found, nth - 1, &alike)
                .or_else(|| placed(prompt, objects, places, (found, nth - 1), &alike))
                // `The guitar`, after one was told from the others.
                .or_else(|| flanking(prompt, objects, places, mention, &alike))
                .or_else(|| (mention.ids.len() > 1).then(|| of_size(places, words, &alike)).flatten())
                .or_else(|| {
                    narrowed.clone().filter(|(all, _)| *all == alike && is_one(words)).map(|(_, one)| vec![one])
                }),
        };
        let Some(ids) = chosen else {
            // Of several of a kind the words mean one, wherever things are.
            if places.objects.is_empty() && alike.len() > 1 {
                absorb_place(prompt, objects, found, nth);
            }
            continue;
        };
        if let [one] = ids[..] {
            narrowed = Some((alike, one));
        }
        found[nth - 1].mention.ids = ids;
        absorb_place(prompt, objects, found, nth);
    }
}

/// What hangs on walls.
const HUNG: &str = "picture painting print poster mirror clock";

/// Makes one mention of a thing and of what it is beside or on, mention `nth`, which is said to tell it from others.
fn absorb_place(prompt: &str, objects: &[NamedObject], found: &mut Vec<FoundMention>, nth: usize) {
    let end = found[nth - 1].mention.bytes[1];
    let Some(place) = found.get(nth).map(|next| next.mention.bytes) else { return };
    let between = tokenize(prompt.get(end..place[0]).unwrap_or_default());
    let hangs = found[nth - 1].mention.ids.iter().filter_map(|id| label(objects, *id).and_then(head));
    let hangs = hangs.into_iter().any(|kind| is_listed(HUNG, &kind));
    let is_place = match relation_of(&between) {
        Some(Relation::Near | Relation::On) => true,
        // No way leads over what a picture hangs above.
        Some(Relation::Above) => hangs,
        _ => false,
    };
    if is_place && !says_way(&between) {
        found[nth - 1].mention.bytes[1] = place[1];
        found.remove(nth);
    }
}

/// Whether words name one thing and neither another one nor any of its kind.
fn is_one(words: &str) -> bool {
    let words = tokenize(words);
    let is_last_singular =
        words.iter().rev().find(|word| word.is_alphabetic()).is_some_and(|word| word.stem == word.text);
    let others =
        |word: &Word| is_listed(OTHERS, &word.text) || matches!(word.text.as_str(), "a" | "an" | "each" | "every");
    is_last_singular && !words.iter().any(others)
}

/// Whether a noun is one of several things. A canvas is one.
fn is_plural(noun: &Word) -> bool {
    noun.stem != noun.text && noun.text != "canvas"
        || is_listed("cacti people children men women mice geese feet", &noun.text)
}

/// All things of the kind of a mention.
pub(crate) fn kind_of(objects: &[NamedObject], prompt: &str, found: &FoundMention) -> Vec<u32> {
    if found.mention.ids.len() > 1 {
        return found.mention.ids.clone();
    }
    alike(objects, &found.mention, said(prompt, &found.mention))
}

/// Whether words name no word of a thing's label.
fn is_part(objects: &[NamedObject], words: &str, id: u32) -> bool {
    label(objects, id).is_some_and(|label| content(label).is_disjoint(&content(words)))
}

/// All things that the words of a mention fit as well as those that it was taken for, ascending.
fn alike(objects: &[NamedObject], mention: &Mention, words: &str) -> Vec<u32> {
    let Some(own) = mention.ids.first().and_then(|id| label(objects, *id)) else { return Vec::new() };
    let (own_words, kind) = (content(own), head(own));
    let told: Vec<&String> = own_words.iter().filter(|word| content(words).contains(*word)).collect();
    let is_kind_said = told.iter().any(|word| Some((*word).clone()) == kind);
    let fits = |object: &&NamedObject| {
        let other = content(&object.label);
        if is_kind_said {
            head(&object.label) == kind && told.iter().all(|word| other.contains(*word))
        } else {
            other == own_words
        }
    };
    objects.iter().filter(fits).map(|object| object.id).collect()
}

/// The only thing of the kind that no earlier mention names, where the words ask for another one.
fn other_one(prompt: &str, found: &[FoundMention], nth: usize, alike: &[u32]) -> Option<Vec<u32>> {
    let words = tokenize(said(prompt, &found[nth].mention));
    let is_other = words.iter().any(|word| is_listed(OTHERS, &word.text));
    let named = |id: &u32| found[..nth].iter().any(|before| before.mention.ids == [*id]);
    let left: Vec<u32> = alike.iter().filter(|id| !named(id)).copied().collect();
    (is_other && left.len() == 1 && alike.len() > 1).then_some(left)
}

/// The things of a kind that other things place.
fn placed(
    prompt: &str,
    objects: &[NamedObject],
    places: Places<'_>,
    (found, nth): (&[FoundMention], usize),
    alike: &[u32],
) -> Option<Vec<u32>> {
    let words = tokenize(said(prompt, &found[nth].mention));
    // `The guitar in the corner` may be one mention.
    let in_corner = words.last().is_some_and(|word| word.text == "corner");
    let words = if in_corner { words[..words.iter().position(|word| word.text == "in")?].to_vec() } else { words };
    let last = words.iter().rev().find(|word| word.is_alphabetic())?;
    let is_plural = is_plural(last);
    let count = words.iter().find_map(|word| {
        let said = (2..=12_u32).find(|count| number_word(*count) == Some(&word.text));
        said.map(|count| count as usize).or_else(|| word.text.parse().ok())
    });
    if alike.len() < 2 || count == Some(alike.len()) {
        return None;
    }
    if !is_plural && says_floor(prompt, &found[nth].mention) {
        return lowest(places, alike).map(|id| vec![id]);
    }
    let behind = placed_behind(prompt, found, nth)
        .or_else(|| {
            placed_later(prompt, found, nth, &|mention| self::alike(objects, mention, said(prompt, mention)).len())
        })
        .or_else(|| placed_with(prompt, found, nth));
    let Some((relation, others)) = behind else {
        let in_corner = !is_plural && says_corner(prompt, &found[nth].mention);
        return in_corner.then(|| cornermost(places, alike)).flatten().map(|id| vec![id]);
    };
    let others = boxes(places, &others);
    let mut fits: Vec<(f64, u32, f64)> = alike
        .iter()
        .filter_map(|id| fit(places, *id, relation, &others).map(|(misfit, width)| (misfit, *id, width)))
        .collect();
    fits.sort_by(|a, b| a.0.total_cmp(&b.0));
    let there: Vec<u32> = fits.iter().filter(|fit| fit.0 < TOUCHING).map(|fit| fit.1).collect();
    if let Some(id) = (!is_plural).then(|| told_by_side(places, &words, &there)).flatten() {
        return Some(vec![id]);
    }
    let mut ids: Vec<u32> = match (is_plural, count) {
        (_, Some(count)) => fits.iter().take(count).map(|fit| fit.1).collect(),
        // Of several pictures over a sofa the large one.
        (false, None) if relation == Relation::Above && is_listed(HUNG, &last.stem) => {
            let over: Vec<u32> =
                fits.iter().filter(|(misfit, _, width)| *misfit < ASIDE * width).map(|fit| fit.1).collect();
            of_size(places, &format!("large {}", last.stem), &over)
                .unwrap_or_else(|| fits.iter().take(1).map(|fit| fit.1).collect())
        }
        (false, None) => fits.iter().take(1).map(|fit| fit.1).collect(),
        (true, None) if matches!(relation, Relation::Under | Relation::Above) => {
            fits.iter().filter(|(misfit, _, width)| *misfit < ASIDE * width).map(|fit| fit.1).collect()
        }
        (true, None) if relation == Relation::On => there,
        (true, None) => return None,
    };
    ids.sort_unstable();
    (!ids.is_empty()).then_some(ids)
}

/// The one thing of a kind that a mention with its place names: `the guitar by the door`. `before` are those of the mention before,
/// of whose kind `the one by the door` is.
fn placed_inside(
    objects: &[NamedObject],
    places: Places<'_>,
    mention: &Mention,
    (words, before, last_place): (&str, &[u32], &[u32]),
) -> Option<(Vec<u32>, Vec<u32>, Vec<u32>)> {
    let words = tokenize(words);
    let (front, relation, behind) = inner_place(&words)?;
    // `The top of the guitar` is a part of what is named.
    let is_owned = words.get(front.len()).is_some_and(|word| word.text == "of");
    let named = |words: &[Word]| -> Vec<u32> {
        let Some(kind) = words.iter().rev().find(|word| word.is_alphabetic()) else { return Vec::new() };
        // `The lamp on the right one` of what was named last.
        if kind.text == "one" {
            return last_place.to_vec();
        }
        let of_kind = |fits: &dyn Fn(&str) -> bool| -> Vec<&NamedObject> {
            objects.iter().filter(|object| head(&object.label).is_some_and(|head| fits(&head))).collect()
        };
        let mut all = of_kind(&|head| head == kind.stem);
        if all.is_empty() && is_listed(hung::PICTURES, &kind.text) {
            all = of_kind(&|head| is_listed(hung::LABELS, head));
        }
        // `The flowers on the table` are those of the vase there.
        if all.is_empty() && !is_owned {
            let is_part =
                |label: &str| Things::embedded().is_related(label, &kind.stem, &[Kinship::Same, Kinship::Part]);
            all = objects.iter().filter(|object| is_part(&object.label)).collect();
        }
        // Of several those with all of the words, as `the blue door`.
        let told = |object: &&&NamedObject| {
            let names = content(&object.label);
            words.iter().filter(|word| names.contains(&word.stem)).count()
        };
        let most = all.iter().map(|object| told(&object)).max().unwrap_or_default();
        all.iter().filter(|object| told(object) == most).map(|object| object.id).collect()
    };
    let last = front.iter().rev().find(|word| word.is_alphabetic())?;
    let alike = if last.text == "one" { before.to_vec() } else { named(front) };
    // `The painting over the sofa` of things called pictures, `the canvas by the window` of easels.
    let of_ids = kind_of_all(objects, &mention.ids);
    let is_place = mention.ids.iter().all(|id| named(behind).contains(id));
    let is_other = !is_place && !of_ids.is_empty() && !of_ids.iter().any(|id| alike.contains(id));
    let alike = if alike.is_empty() || is_other { of_ids } else { alike };
    let is_one = !is_plural(last);
    let mut around = named(behind);
    if around.is_empty() {
        around = mention.ids.iter().filter(|id| !alike.contains(id)).copied().collect();
    }
    let kind_around = around.clone();
    if let Some(id) = told_flank(behind).and_then(|flank| outermost(places, &around, flank)) {
        around = vec![id];
    }
    let is_named = |id: &u32| alike.contains(id) || kind_around.contains(id);
    if alike.is_empty() || around.is_empty() || !mention.ids.iter().all(is_named) {
        return None;
    }
    // Where nobody knows where things are, the words mean one of the kind.
    if places.objects.is_empty() {
        let ids = if is_one { vec![alike[0]] } else { alike.clone() };
        return Some((alike, ids, kind_around));
    }
    let others = boxes(places, &around);
    let fits: Vec<(f64, u32)> =
        alike.iter().filter_map(|id| Some((fit(places, *id, relation, &others)?.0, *id))).collect();
    let there: Vec<u32> = fits.iter().filter(|fit| fit.0 < TOUCHING).map(|fit| fit.1).collect();
    let flanked = || told_by_side(places, front, &there);
    let nearest = || fits.iter().min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, id)| *id);
    let ids = if is_one {
        vec![flanked().or_else(nearest).or_else(|| matches!(alike[..], [_]).then(|| alike[0]))?]
    } else {
        // `The plates on the table` are all that stand there.
        fits.iter().filter(|(misfit, _)| relation != Relation::Near && *misfit < TOUCHING).map(|(_, id)| *id).collect()
    };
    (!ids.is_empty()).then_some((alike, ids, kind_around))
}

/// The one of the things that stand on another one that the words tell by its side: `the left candle on the sideboard`.
fn told_by_side(places: Places<'_>, words: &[Word], there: &[u32]) -> Option<u32> {
    told_flank(words).and_then(|flank| outermost(places, there, flank))
}

/// Several things of one kind; none where they are of several.
fn kind_of_all(objects: &[NamedObject], ids: &[u32]) -> Vec<u32> {
    let mut kinds = ids.iter().map(|id| label(objects, *id).map(content));
    let first = kinds.next().flatten();
    let is_one = ids.len() > 1 && first.is_some() && kinds.all(|kind| kind == first);
    if is_one { ids.to_vec() } else { Vec::new() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use cinesplat_objects::Object;
    use glam::DVec3;

    /// A room with a door and a guitar at each end of one wall, a clock over the second one, a sofa under three of four
    /// pictures, and two plants.
    fn room() -> Vec<Object> {
        let at = |id, label: &str, [x, y, z]: [f64; 3], half: f64| {
            Object::from_box(id, label, DVec3::new(x, y, z), DVec3::splat(half))
        };
        vec![
            at(1, "blue door", [-3.0, 1.0, 0.5], 0.5),
            at(2, "guitar 1", [-2.5, 0.6, -0.7], 0.3),
            at(3, "guitar 2", [2.5, 0.6, -2.5], 0.3),
            at(4, "clock", [2.9, 1.9, 1.0], 0.2),
            at(5, "potted plant 1", [-2.6, 0.6, -1.6], 0.4),
            at(6, "potted plant 2", [2.5, 0.6, 1.2], 0.4),
            at(7, "sofa", [0.0, 0.4, 2.5], 0.9),
            at(8, "picture 1", [-0.7, 1.6, 2.9], 0.2),
            at(9, "picture 2", [0.0, 1.6, 2.9], 0.2),
            at(10, "picture 3", [0.7, 1.6, 2.9], 0.2),
            at(11, "picture 4", [0.0, 1.6, -2.9], 0.2),
        ]
    }

    fn pointed(prompt: &str, mentions: &[(&str, &[u32])]) -> Vec<Vec<u32>> {
        pointed_among(&room(), prompt, mentions)
    }

    fn pointed_among(objects: &[Object], prompt: &str, mentions: &[(&str, &[u32])]) -> Vec<Vec<u32>> {
        let names: Vec<NamedObject> =
            objects.iter().map(|object| NamedObject { id: object.id, label: object.label.clone() }).collect();
        let mut from = 0;
        let mut found: Vec<FoundMention> = Vec::new();
        for (words, ids) in mentions {
            let start = from + prompt[from..].find(words).unwrap();
            from = start + words.len();
            let mention = Mention { bytes: [start, from], ids: ids.to_vec() };
            found.push(FoundMention { mention, probability: 1.0, nearest: Vec::new() });
        }
        point_by_places(prompt, &names, Places { objects, up: DVec3::Y }, &mut found);
        found.into_iter().map(|found| found.mention.ids).collect()
    }

    #[test]
    fn a_thing_on_the_floor_is_the_one_that_stands_there() {
        let objects = [
            Object::from_box(1, "small plant", DVec3::new(0.0, 1.2, 0.0), DVec3::splat(0.2)),
            Object::from_box(2, "potted plant", DVec3::new(1.0, 0.4, 0.0), DVec3::splat(0.4)),
        ];
        let pointed = |prompt: &str| pointed_among(&objects, prompt, &[("the plant", &[1])]).remove(0);
        assert_eq!(pointed("the plant on the floor"), [2]);
        assert_eq!(pointed("the plant on the shelf"), [1]);
    }

    #[test]
    fn of_things_on_another_one_the_words_may_tell_the_side() {
        let at = |id, label: &str, [x, y, z]: [f64; 3], half: f64| {
            Object::from_box(id, label, DVec3::new(x, y, z), DVec3::splat(half))
        };
        // From the middle of the room, where x grows to the left.
        let objects = [
            at(1, "sideboard", [0.0, 0.4, 2.5], 0.4),
            at(2, "candle 1", [0.3, 0.9, 2.5], 0.08),
            at(3, "candle 2", [-0.3, 0.9, 2.5], 0.08),
            at(4, "vase", [0.0, 0.95, 2.5], 0.1),
            at(5, "vase", [0.0, 0.95, -2.5], 0.1),
            at(6, "guitar", [0.0, 0.4, -2.5], 0.4),
        ];
        let pointed = |prompt: &str, words: &str, id: u32| pointed_among(&objects, prompt, &[(words, &[id])]).remove(0);
        let (of, on) = ("the left-hand candle of the sideboard", "the right candle on the sideboard");
        assert_eq!((pointed(of, of, 1), pointed(on, on, 1)), (vec![2], vec![3]));
        assert_eq!(pointed("the flowers on the sideboard", "the flowers on the sideboard", 1), [4]);
        assert_eq!(pointed("the top of the sideboard", "the top of the sideboard", 1), [1]);
        // Without places they are one of the kind.
        let names: Vec<NamedObject> =
            objects.iter().map(|object| NamedObject { id: object.id, label: object.label.clone() }).collect();
        let mention = Mention { bytes: [0, on.len()], ids: vec![1] };
        let mut found = vec![FoundMention { mention, probability: 1.0, nearest: Vec::new() }];
        point_by_places(on, &names, Places { objects: &[], up: DVec3::Y }, &mut found);
        assert_eq!(found[0].mention.ids, [2]);
    }

    #[test]
    fn a_thing_at_the_end_of_another_or_had_by_it_is_on_it() {
        let at = |id, label: &str, [x, y, z]: [f64; 3], half: f64| {
            Object::from_box(id, label, DVec3::new(x, y, z), DVec3::splat(half))
        };
        let objects = [
            at(1, "coffee table", [0.0, 0.2, 0.0], 0.2),
            at(2, "books 1", [0.1, 0.45, 0.0], 0.05),
            at(3, "books 2", [-0.1, 0.45, 0.0], 0.05),
            at(4, "books 3", [2.0, 1.2, 2.0], 0.05),
            at(5, "fireplace", [3.0, 0.5, 0.0], 0.5),
            at(6, "candle 1", [0.0, 0.45, 0.1], 0.05),
            at(7, "candle 2", [3.3, 1.05, 0.0], 0.05),
        ];
        let pointed = |prompt: &str, mentions: &[(&str, &[u32])]| pointed_among(&objects, prompt, mentions);
        let ids =
            pointed("the coffee table with the books on it", &[("the coffee table", &[1]), ("the books", &[2, 3, 4])]);
        assert_eq!(ids, [vec![1], vec![2, 3]]);
        let ids =
            pointed("the candle at the far end of the fireplace", &[("the candle", &[6]), ("the fireplace", &[5])]);
        assert_eq!(ids, [[7]]);
        let ids =
            pointed("the candle at the end , then the fireplace", &[("the candle", &[6]), ("the fireplace", &[5])]);
        assert_eq!(ids, [[6], [5]]);
    }

    #[test]
    fn a_thing_beside_another_is_the_nearest_of_its_kind() {
        let ids = pointed(
            "the guitar by the blue door, down its strings, then the other guitar",
            &[("the guitar", &[2, 3]), ("the blue door", &[1]), ("its strings", &[2, 3]), ("the other guitar", &[2])],
        );
        assert_eq!(ids, [[2], [2], [3]]);
        let ids = pointed("push in on the guitar and the clock", &[("the guitar", &[2, 3]), ("the clock", &[4])]);
        assert_eq!(ids, [vec![2, 3], vec![4]]);
    }

    #[test]
    fn a_thing_that_was_taken_for_its_place_is_the_thing() {
        assert_eq!(pointed("start on the guitar by the blue door", &[("the guitar by the blue door", &[1])]), [[2]]);
        let ids = pointed(
            "the guitar by the door, then the clock, and back to the guitar",
            &[("the guitar by the door", &[1]), ("the clock", &[4]), ("the guitar", &[2])],
        );
        assert_eq!(ids, [[2], [4], [2]]);
        assert_eq!(pointed("push in on the plant under the clock", &[("the plant under the clock", &[5])]), [[6]]);
        let ids = pointed("truck along the pictures over the sofa", &[("the pictures over the sofa", &[7])]);
        assert_eq!(ids, [[8, 9, 10]]);
        let ids: &[(&str, &[u32])] =
            &[("guitars", &[2, 3]), ("the one near the door", &[1]), ("the other one", &[2, 3])];
        assert_eq!(
            pointed("two guitars: show the one near the door, then the other one", ids),
            [vec![2, 3], vec![2], vec![3]]
        );
    }

    #[test]
    fn a_thing_below_another_is_told_by_it_on_either_side() {
        let plant = vec![vec![6], vec![4]];
        let clock: &[(&str, &[u32])] = &[("the plant", &[5]), ("the clock", &[4])];
        assert_eq!(pointed("tilt up from the plant in the corner to the clock on the wall above it", clock), plant);
        assert_eq!(pointed("push in on the plant standing under the clock", clock), plant);
        assert_eq!(pointed("pan from the plant to the clock", clock), [vec![5], vec![4]]);
    }

    #[test]
    fn things_above_another_are_counted() {
        let pictures: &[(&str, &[u32])] = &[("the sofa", &[7]), ("the three pictures", &[8, 9, 10, 11])];
        assert_eq!(pointed("the sofa dead centre, the three pictures above it all in", pictures)[1], [8, 9, 10]);
        let pictures: &[(&str, &[u32])] = &[("the pictures", &[8, 9, 10, 11]), ("the sofa", &[7])];
        assert_eq!(pointed("truck along the pictures over the sofa", pictures)[0], [8, 9, 10]);
        assert_eq!(pointed("the pictures, then the sofa", pictures)[0], [8, 9, 10, 11]);
    }

    #[test]
    fn a_thing_in_the_corner_is_nearest_to_one() {
        assert_eq!(pointed("whip to the guitar in the far corner", &[("the guitar", &[2, 3])]), [[3]]);
        assert_eq!(pointed("tilt up the guitar in the corner", &[("the guitar in the corner", &[2])]), [[3]]);
    }
}

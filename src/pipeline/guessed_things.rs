//! Nouns of a prompt about a scan whose things only have guessed names: `large brown surface`, `flat gray object`.
//!
//! Nobody knows which of its things are teapots. A noun that the scan lacks is taken for what is most probably meant by where
//! such things are (a shelf, a worktop, what stands on the shelves), or is left out where other things are named. In a scene
//! whose things have names, what it lacks stays missing.

use super::few_things;
use super::guessed_names::{Named, color_said, has_word, is_bound, numbered, of_color, taken_for};
use cinesplat_language::{Group, Linked, Relation, Things, Word, is_listed, tokenize};
use cinesplat_objects::{Object, ObjectSet, is_description};
use glam::DVec3;

/// Least share of things with guessed names only, and fewest things of such a scan.
const GUESSED_FRAC: f64 = 0.8;
const FEWEST: usize = 6;
/// Things on shelves from which on a scan is a room and not in pieces.
const FEWEST_SHELVED: usize = 3;
/// Nouns by where such things are.
const FLOORS: &str = "floor tile flooring ground carpet floorboard";
const COUNTERS: &str = "counter countertop worktop worksurface bench benchtop table tabletop desk surface island";
const SHELVES: &str = "shelf shelve shelving rack ledge";
const CUPBOARDS: &str = "cupboard cabinet door drawer unit wardrobe dresser";
/// What stands on shelves and tables, besides all that is said in the plural.
const SMALL: &str = "teapot pot jar bottle mug cup plate bowl vase glass book spoon ladle utensil kettle tin can spice crockery \
    china dish ornament figurine toy candle basket collection tray jug pan";
/// Nouns by what such things look like in a room without shelves, and colors of guessed names for what is dark.
const SCREENS: &str = "television tv telly screen monitor";
const DRAPES: &str = "curtain drape blind";
const SEATS: &str = "armchair chair seat sofa couch settee recliner";
const CHESTS: &str = "cabinet sideboard dresser chest commode cupboard credenza";
const DARK: &str = "black dark navy";
/// Share of the height of the scan under which the middle of a seat is.
const SEAT_FRAC: f64 = 0.5;
/// Share of the height of the scan, from its bottom, under which a top is one to work at, and from which a thing may be on a shelf.
const COUNTER_FRAC: f64 = 0.55;
const SHELF_FRAC: f64 = 0.45;
/// Distance of a thing's foot from the top that it stands on, of the height of the scan.
const STANDS_FRAC: f64 = 0.07;
/// Most alike directions of things along one wall, and the distance of their planes, of the size of the scan.
const SAME_WALL_COS: f64 = 0.9;
const SAME_WALL_FRAC: f64 = 0.12;
/// Words between two nouns.
const APART: &str = "to from and of on in at with past over into , . ; :";
/// Words before a noun that may be its color.
const COLORS_BEFORE: usize = 5;
/// Most things of one picture.
const MOST_THINGS: usize = 8;

/// The objects with the nouns of a prompt for their guessed names, where such things may be; `None` for other scenes and where
/// the prompt has no such noun.
pub(super) fn named(prompt: &str, objects: &ObjectSet, up: DVec3) -> Option<Named> {
    let scan = Scan::new(&objects.objects, up);
    if !scan.is_guessed() {
        return None;
    }
    let words = tokenize(prompt);
    let mut labels: Vec<(u32, String)> = Vec::new();
    let mut nouns: Vec<(String, Vec<u32>)> = Vec::new();
    let mut is_taken = [false; 4];
    let named = |object: &&Object| !is_guess(&object.label);
    let given = objects.objects.iter().filter(named).flat_map(|object| tokenize(&object.label));
    let given: Vec<String> = given.map(|word| word.stem).collect();
    for at in 0..words.len() {
        let noun = &words[at];
        let is = |list: &str| is_listed(list, &noun.stem) || is_listed(list, &noun.text);
        let Some(class) = [COUNTERS, SHELVES, CUPBOARDS, SMALL].iter().position(|list| is(list)) else { continue };
        // What a person has called so is meant by it.
        if given.contains(&noun.stem) {
            continue;
        }
        // `On the table`, and nothing that opens: `the kitchen counter top`.
        if std::mem::replace(&mut is_taken[class], true) {
            continue;
        }
        let before = &words[at.saturating_sub(COLORS_BEFORE)..at];
        // `From the blue cupboards to the teapots`: the color is that of the cupboards.
        let own = before.iter().rev().take_while(|word| !is_listed(APART, &word.text)).count();
        let before = &before[before.len() - own..];
        let things: Vec<&Object> = match class {
            0 => scan.counter().into_iter().collect(),
            1 => scan.shelves(),
            2 => scan.fronts(),
            _ => scan.shelved(),
        };
        let is_free = |object: &&Object| is_guess(&object.label) && !labels.iter().any(|(id, _)| *id == object.id);
        let new: Vec<(u32, String)> = things
            .into_iter()
            .filter(is_free)
            .map(|object| (object.id, format!("{}{}", color_said(&object.label, before), noun.stem)))
            .collect();
        nouns.push((noun.text.clone(), new.iter().map(|(id, _)| *id).collect()));
        labels.extend(new);
    }
    if labels.is_empty() {
        return None;
    }
    Some(Named { objects: numbered(objects, &labels), nouns, prompt: None })
}

/// Takes the nouns that a scan of guessed names lacks for what is most probably meant, or leaves them out where other things are
/// named. Elsewhere they stay missing.
pub(super) fn take_guesses(linked: &mut Linked, objects: &ObjectSet, up: DVec3) {
    let scan = Scan::new(&objects.objects, up);
    let is_few = few_things::is_few(objects);
    if !(is_few || scan.is_guessed()) || linked.missing_groups().next().is_none() {
        return;
    }
    let mut known: Vec<Vec<u32>> = Vec::new();
    for group in linked.groups.iter_mut().filter(|group| group.members.is_empty()) {
        let guess = if is_few { few_things::guess(&group.name, objects) } else { scan.guess(&group.name) };
        let ids = guess.filter(|ids| ids.len() == 1 || is_few || !known.contains(ids));
        let Some(ids) = ids else { continue };
        linked.warnings.push(taken_for(&group.name, &ids));
        known.push(ids.clone());
        group.members = ids;
    }
    let left: Vec<Group> = linked.missing_groups().cloned().collect();
    let names_others = linked.slots.iter().any(|id| linked.missing(*id).is_none());
    if left.is_empty() || !names_others {
        return;
    }
    let is_left = |word: &str| linked.slot_at(word).is_some_and(|id| left.iter().any(|group| group.id == id));
    let bytes: Vec<[usize; 2]> =
        linked.words_in([0, usize::MAX]).filter(|(word, _)| is_left(word)).map(|(_, span)| span).collect();
    let without = linked.without(&bytes, None);
    let (scenery, acts) = (std::mem::take(&mut linked.scenery), std::mem::take(&mut linked.acts));
    let mut warnings = std::mem::take(&mut linked.warnings);
    warnings.extend(
        left.iter().map(|group| format!("\"{}\" is left out: no thing of this scene is called so", group.name)),
    );
    *linked = Linked { scenery, acts, warnings, ..without };
}

/// A scan whose things have guessed names.
struct Scan<'a> {
    objects: &'a [Object],
    up: DVec3,
    /// Lowest and highest point of all things.
    extent: [f64; 2],
}

impl<'a> Scan<'a> {
    fn new(objects: &'a [Object], up: DVec3) -> Self {
        let all = objects.iter().map(|object| object.span_along(up));
        let extent = all.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], [own_low, own_high]| {
            [low.min(own_low), high.max(own_high)]
        });
        Self { objects, up, extent }
    }

    fn is_guessed(&self) -> bool {
        let roots = || self.objects.iter().filter(|object| object.parent.is_none());
        let guessed = roots().filter(|object| is_guess(&object.label)).count();
        let num = roots().count();
        num >= FEWEST && guessed as f64 >= GUESSED_FRAC * num as f64
    }

    /// The things that are probably meant by a name.
    fn guess(&self, name: &str) -> Option<Vec<u32>> {
        let words = tokenize(name);
        // `The owl's eyes`.
        let owner: Vec<Word> = words.iter().take_while(|word| word.text != "'s").cloned().collect();
        if owner.last().is_some_and(is_living) && !self.has_shelves() {
            return Some(self.largest());
        }
        let nouns: Vec<&Word> = words.iter().take_while(|word| word.text != "of" && word.text != "on").collect();
        let head = nouns.iter().rev().find(|word| word.is_alphabetic())?;
        let is_plural = head.stem != head.text;
        let is = |list: &str| is_listed(list, &head.stem) || is_listed(list, &head.text);
        let says = |list: &str| words.iter().any(|word| is_listed(list, &word.text));
        if let Some(id) = self.looks_like(head) {
            return Some(vec![id]);
        }
        let ids = match () {
            () if is(FLOORS) => return None,
            () if is(COUNTERS) => vec![self.counter()?.id],
            () if is(CUPBOARDS) => self.cupboards(&words, is_plural),
            () if is(SHELVES) || is(SMALL) || is_plural => {
                let row = self.shelved();
                let of_color = of_color(&row, &words);
                let row = if of_color.is_empty() { row } else { of_color };
                let by_height = |high: bool| {
                    let mut sorted = row.clone();
                    sorted.sort_by(|a, b| self.middle(b).total_cmp(&self.middle(a)));
                    if !high {
                        sorted.reverse();
                    }
                    sorted.into_iter().take(if is_plural { 3 } else { 1 }).collect::<Vec<_>>()
                };
                match () {
                    () if says("top upper highest") => by_height(true),
                    () if says("bottom lower lowest") => by_height(false),
                    // One thing of many stands nearest to the middle.
                    () if !is_plural && is(SMALL) => row.into_iter().take(1).collect(),
                    () => row,
                }
                .into_iter()
                .map(|object| object.id)
                .collect()
            }
            () => Vec::new(),
        };
        let mut ids = ids;
        ids.truncate(MOST_THINGS);
        ids.sort_unstable();
        (!ids.is_empty()).then_some(ids)
    }

    /// Whether so much stands on shelves that the scan is a room and not in pieces.
    fn has_shelves(&self) -> bool {
        self.shelved().len() >= FEWEST_SHELVED
    }

    /// The thing of a room without shelves that looks most like what a noun means; `None` where none does.
    fn looks_like(&self, noun: &Word) -> Option<u32> {
        if self.has_shelves() {
            return None;
        }
        let is = |list: &str| is_listed(list, &noun.stem) || is_listed(list, &noun.text);
        let has = |object: &Object, list: &str| object.label.split(' ').any(|word| is_listed(list, word));
        let is_like = |object: &Object| match () {
            () if is(SCREENS) => has_word(&object.label, "panel") && has(object, DARK),
            () if is(DRAPES) => has_word(&object.label, "panel") && !has(object, DARK),
            () if is(SEATS) => {
                let is_low = self.height_frac(self.middle(object)) < SEAT_FRAC;
                is_low && has_word(&object.label, "object") && !has(object, "tall flat small")
            }
            () if is(CHESTS) => has_word(&object.label, "box"),
            () if is(SMALL) => has(object, "object box") && !has_word(&object.label, "large"),
            () => false,
        };
        let is_root = |object: &&Object| object.parent.is_none() && !is_bound(&object.label);
        let alike = self.objects.iter().filter(is_root).filter(|object| is_like(object));
        let found = if is(SMALL) {
            alike.min_by(|a, b| a.radius().total_cmp(&b.radius()))
        } else {
            alike.max_by_key(|object| object.num_gaussians)
        };
        found.map(|object| object.id)
    }

    /// The largest things, which are the pieces of what a scan of one thing shows.
    fn largest(&self) -> Vec<u32> {
        let mut things: Vec<&Object> = self.objects.iter().filter(|object| object.parent.is_none()).collect();
        things.sort_by_key(|object| std::cmp::Reverse(object.num_gaussians));
        let mut ids: Vec<u32> = things.into_iter().take(MOST_THINGS).map(|object| object.id).collect();
        ids.sort_unstable();
        ids
    }

    fn middle(&self, object: &Object) -> f64 {
        object.center.dot(self.up)
    }

    /// Height of a point over that of the scan, from its bottom.
    fn height_frac(&self, at: f64) -> f64 {
        let [low, high] = self.extent;
        (at - low) / (high - low).max(1e-9)
    }

    fn tops(&self) -> impl Iterator<Item = &Object> {
        self.objects.iter().filter(|object| has_word(&object.label, "surface"))
    }

    /// The largest top at which people work.
    fn counter(&self) -> Option<&Object> {
        let low = self.tops().filter(|top| (0.1..COUNTER_FRAC).contains(&self.height_frac(self.middle(top))));
        low.max_by(|a, b| a.radius().total_cmp(&b.radius()))
    }

    /// The fronts of cupboards: flat or boxes, below the tops at which people work, the largest first.
    fn fronts(&self) -> Vec<&Object> {
        let is_front = |object: &&Object| {
            let is_panel = has_word(&object.label, "panel") || has_word(&object.label, "box");
            is_panel && self.height_frac(self.middle(object)) < COUNTER_FRAC
        };
        let mut fronts: Vec<&Object> = self.objects.iter().filter(is_front).collect();
        // Where nothing stands on shelves there is no wall of cupboards, and panels are curtains.
        if !self.has_shelves() && fronts.iter().any(|front| has_word(&front.label, "box")) {
            fronts.retain(|front| has_word(&front.label, "box"));
        }
        fronts.sort_by_key(|object| std::cmp::Reverse(object.num_gaussians));
        fronts
    }

    /// Those that words with their colors mean.
    fn cupboards(&self, words: &[Word], is_plural: bool) -> Vec<u32> {
        let fronts = self.fronts();
        let of_color = of_color(&fronts, words);
        let fronts = if of_color.is_empty() { fronts } else { of_color };
        fronts.into_iter().take(if is_plural { 3 } else { 1 }).map(|object| object.id).collect()
    }

    /// Whether a thing stands on a top that is no table.
    fn is_on(&self, object: &Object, top: &Object) -> bool {
        let [low, high] = self.extent;
        let near = STANDS_FRAC * (high - low);
        let [_, edge] = top.span_along(self.up);
        let apart = object.center - top.center;
        let level = top.rotation.conjugate() * (apart - self.up * apart.dot(self.up));
        let is_over = level.abs().cmple(top.half_extents + near).all();
        is_over && (object.span_along(self.up)[0] - edge).abs() < 2.0 * near
    }

    /// The tops on which the things of one wall stand.
    fn shelves(&self) -> Vec<&Object> {
        let things = self.shelved();
        let is_shelf = |top: &&Object| {
            self.height_frac(self.middle(top)) > SHELF_FRAC && things.iter().any(|thing| self.is_on(thing, top))
        };
        self.tops().filter(is_shelf).collect()
    }

    /// What stands on the shelves of one wall, the largest row first.
    fn shelved(&self) -> Vec<&Object> {
        let [low, high] = self.extent;
        let stands = |object: &&Object| {
            let is_thing = !has_word(&object.label, "surface") && !has_word(&object.label, "panel");
            let is_high = self.height_frac(object.span_along(self.up)[0]) > SHELF_FRAC;
            is_thing && is_high && self.tops().any(|top| self.is_on(object, top))
        };
        let mut things: Vec<&Object> = self.objects.iter().filter(stands).collect();
        things.sort_by_key(|object| std::cmp::Reverse(object.num_gaussians));
        let Some(first) = things.first().copied() else { return things };
        let size = (high - low).max((first.center - self.objects[0].center).length());
        let facing = self.facing(first);
        let is_beside = |object: &&Object| {
            let apart = (object.center - first.center).dot(facing).abs();
            self.facing(object).dot(facing).abs() > SAME_WALL_COS && apart < SAME_WALL_FRAC * size
        };
        things.into_iter().filter(is_beside).collect()
    }

    /// The level axis along which a thing is thin.
    fn facing(&self, object: &Object) -> DVec3 {
        let axes = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| (object.rotation * axis, axis.dot(object.half_extents)));
        let level = axes.into_iter().filter(|(axis, _)| axis.dot(self.up).abs() < 0.7);
        level.min_by(|a, b| a.1.total_cmp(&b.1)).map_or(DVec3::X, |(axis, _)| axis)
    }
}

/// Whether a label is a description by a search, and no name that a person gave.
fn is_guess(label: &str) -> bool {
    is_description(label) || is_bound(label)
}

/// Whether a noun is an animal or a person: what a scan is about, and no thing on a shelf.
fn is_living(noun: &Word) -> bool {
    let things = Things::embedded();
    let related = things.related(&things.kinds_of(&noun.stem));
    let is = |kind: &str| {
        let relations = related.get(kind).copied().unwrap_or_default();
        Relation::Broader.is_in(relations) || Relation::Same.is_in(relations)
    };
    is("animal") || is("person")
}

#[cfg(test)]
mod tests {
    use super::*;
    use cinesplat_language::{Mention, link_mentions};

    /// A wall of two shelves over a worktop over two cupboards, and a box on the other side.
    fn kitchen() -> ObjectSet {
        let object = |id, label: &str, [x, y, z]: [f64; 3], [a, b, c]: [f64; 3]| Object {
            num_gaussians: 100 - id as usize,
            ..Object::from_box(id, label, DVec3::new(x, y, z), DVec3::new(a, b, c))
        };
        let objects = vec![
            object(1, "large gray surface", [0.0, 1.0, 0.0], [1.5, 0.04, 0.5]),
            object(2, "turquoise panel", [-0.5, 0.5, 0.5], [0.5, 0.5, 0.05]),
            object(3, "large pink panel", [0.5, 0.5, 0.5], [0.5, 0.5, 0.05]),
            object(4, "large brown surface", [0.0, 1.8, -0.3], [1.5, 0.03, 0.15]),
            object(5, "flat gray object", [-0.6, 1.96, -0.3], [0.5, 0.13, 0.1]),
            object(6, "flat teal object", [0.6, 1.96, -0.3], [0.5, 0.13, 0.1]),
            object(7, "large brown surface 2", [0.0, 2.3, -0.3], [1.5, 0.03, 0.15]),
            object(8, "flat beige object", [0.0, 2.46, -0.3], [0.6, 0.13, 0.1]),
            object(9, "dark gray object", [1.2, 0.3, 2.0], [0.3, 0.3, 0.3]),
        ];
        ObjectSet { objects, labels: Vec::new() }
    }

    fn guessed(prompt: &str, names: &[(&str, &[u32])], set: &ObjectSet) -> (Vec<Vec<u32>>, Vec<String>, String) {
        let mention = |(words, ids): &(&str, &[u32])| {
            let start = prompt.find(words).unwrap();
            Mention { bytes: [start, start + words.len()], ids: ids.to_vec() }
        };
        let mut linked = link_mentions(prompt, &names.iter().map(mention).collect::<Vec<_>>()).unwrap();
        take_guesses(&mut linked, set, DVec3::Y);
        let members = linked.groups.iter().map(|group| group.members.clone()).collect();
        (members, linked.warnings, linked.tokens_text)
    }

    #[test]
    fn things_without_names_are_where_such_things_are() {
        let of = |name: &str| guessed(&format!("push in on {name}"), &[(name, &[])], &kitchen()).0.remove(0);
        assert_eq!(of("the teapots"), [5, 6, 8]);
        assert_eq!(of("the top shelf"), [8]);
        assert_eq!(of("the worktop"), [1]);
        assert_eq!(of("the cupboards"), [2, 3]);
        assert_eq!(of("the blue cupboard"), [2]);
        assert_eq!(of("the giraffe"), Vec::<u32>::new());
    }

    #[test]
    fn names_that_were_given_count_before_guesses() {
        let mut set = kitchen();
        set.objects.push(Object::from_box(10, "red bowl", DVec3::new(1.0, 1.2, 1.0), DVec3::splat(0.1)));
        assert!(named("push in on the red bowl", &set, DVec3::Y).is_none(), "it has that name");
        let teapots = named("push in on the teapots", &set, DVec3::Y).unwrap();
        assert_eq!(teapots.nouns, [("teapots".to_owned(), vec![5, 6, 8])]);
        set.objects[5].label = "bread bin".to_owned();
        let teapots = named("push in on the teapots", &set, DVec3::Y).unwrap();
        assert_eq!(teapots.nouns[0].1, [5, 8], "a thing with a name keeps it");
        assert_eq!(teapots.objects.objects[5].label, "bread bin");
    }

    #[test]
    fn things_of_a_room_without_shelves_are_what_they_look_like() {
        let object = |id, label: &str, height: f64, half: [f64; 3]| Object {
            num_gaussians: 100 - id as usize,
            ..Object::from_box(id, label, DVec3::Y * height, DVec3::from_array(half))
        };
        let objects = vec![
            object(1, "large dark brown box", 0.3, [0.9, 0.3, 0.4]),
            object(2, "large white panel", 1.2, [0.1, 1.2, 0.6]),
            object(3, "large light gray object", 0.4, [0.5, 0.4, 0.5]),
            object(4, "large black panel", 1.3, [0.5, 0.3, 0.02]),
            object(5, "large tall light gray object", 1.1, [0.05, 1.1, 0.05]),
            object(6, "gray object", 0.8, [0.1, 0.15, 0.1]),
        ];
        let set = ObjectSet { objects, labels: Vec::new() };
        let of = |name: &str| guessed(&format!("push in on {name}"), &[(name, &[])], &set).0.remove(0);
        assert_eq!(of("the telly"), [4]);
        assert_eq!(of("the curtains"), [2]);
        assert_eq!(of("the armchair"), [3]);
        assert_eq!(of("the cabinet"), [1]);
        assert_eq!(of("the vase"), [6]);
        assert_eq!(of("the anchor"), Vec::<u32>::new());
    }

    #[test]
    fn things_take_the_nouns_of_the_prompt_for_names() {
        let labels = |prompt: &str| -> Vec<String> {
            let named = named(prompt, &kitchen(), DVec3::Y);
            named
                .map(|named| named.objects.objects.into_iter().map(|object| object.label).collect())
                .unwrap_or_default()
        };
        let named = labels("from the blue cupboards to the teapots on the shelf");
        assert_eq!([&named[1], &named[2]], ["blue cupboard", "pink cupboard"]);
        assert_eq!([&named[3], &named[4], &named[5]], ["brown shelf 1", "gray teapot", "teal teapot"]);
        assert_eq!(labels("orbit the giraffe"), Vec::<String>::new());
    }

    #[test]
    fn what_cannot_be_guessed_is_left_out_beside_other_things() {
        let names: &[(&str, &[u32])] = &[("the pink panel", &[3]), ("the window", &[])];
        let (_, warnings, text) = guessed("push in on the pink panel , then pan to the window", names, &kitchen());
        assert_eq!(warnings.len(), 1, "{warnings:?}");
        assert!(!text.contains("<obj-1>"), "{text}");
        let (groups, warnings, _) = guessed("pan to the window", &[("the window", &[])], &kitchen());
        assert_eq!((groups, warnings.len()), (vec![Vec::new()], 0));
    }

    #[test]
    fn a_scene_with_names_lacks_what_it_lacks() {
        let mut set = kitchen();
        set.objects.iter_mut().for_each(|object| object.label = format!("cabinet {}", object.id));
        let (groups, _, _) = guessed("push in on the teapots", &[("the teapots", &[])], &set);
        assert_eq!(groups, [Vec::<u32>::new()]);
    }
}

//! Nouns of a prompt about a scan of two to five things that nobody has named.
//!
//! Such a scan shows some flowers, two shoes, a jug and a cup. A noun of the prompt becomes the name of the things that may be
//! meant by it: those of the color that is said, flowers that are not green, leaves that are. Where the words tell nothing
//! else it is that of the largest one.

use cinesplat_language::{Things, Word, is_listed, part_of, tokenize};
use cinesplat_objects::{Object, ObjectSet, is_description};

use super::guessed_names::{Named, color_said, is_bound, is_color, numbered, of_color};

/// Number of things of such a scan.
const NUM_THINGS: std::ops::RangeInclusive<usize> = 2..=5;
/// Flowers, which are rarely green, and what is green.
const FLOWERS: &str =
    "flower blossom bloom lotus rose tulip lily orchid daisy peony sunflower bud carnation poppy iris waterlily";
const LEAVES: &str = "leaf leave leaves foliage lilypad pad frond grass fern";
const GREENS: &str = "green olive teal turquoise";
/// What consists of all things of a scan, or says that all are meant.
const ALL: &str =
    "plant bunch bouquet arrangement group scene set cluster collection composition ensemble bush everything";
/// Words before a noun that is one of the scan's things, and words that tell which one.
const DETERMINERS: &str = "the a an this that these those my our your his her both all";
const TELLS: &str = "left right big bigger biggest large larger largest small smaller smallest little tall taller tallest tiny \
    first second third other front back middle near nearer far top upper bottom lower last highest lowest tallest next";
/// Words near a noun that may tell which thing is meant.
const NEAR: usize = 4;
/// Nouns of pictures and cameras, and words of places.
const NO_THINGS: &str = "camera shot frame view lens film video picture scene clip take close-up closeup angle center centre middle side \
    top bottom front back left right end start second seconds circle arc orbit way level eye one ones thing things light \
    background ground floor detail details object objects box panel surface";

/// Whether a scan shows a few things with guessed names only.
pub(super) fn is_few(objects: &ObjectSet) -> bool {
    let things = things(objects);
    NUM_THINGS.contains(&things.len())
        && objects.only_whole().is_none()
        && things.iter().all(|object| is_description(&object.label))
}

/// The objects with the nouns of a prompt for their guessed names; `None` for other scans and where the prompt has no such
/// noun.
pub(super) fn named(prompt: &str, objects: &ObjectSet) -> Option<Named> {
    if !is_few(objects) {
        return None;
    }
    let words = tokenize(prompt);
    let mut labels: Vec<(u32, String)> = Vec::new();
    let mut nouns: Vec<(String, Vec<u32>)> = Vec::new();
    let mut seen: Vec<&str> = Vec::new();
    for at in (0..words.len()).filter(|at| is_noun(&words, *at)) {
        let noun = &words[at];
        if seen.contains(&noun.stem.as_str()) {
            continue;
        }
        seen.push(&noun.stem);
        let is_free = |object: &&Object| !labels.iter().any(|(id, _)| *id == object.id);
        let free: Vec<&Object> = candidates(objects, noun).into_iter().filter(is_free).collect();
        let before = &words[at.saturating_sub(NEAR)..at];
        let chosen = chosen(free, &words, at);
        let odd = odd_one(&chosen, &words);
        let label = |object: &&Object| match odd {
            Some((id, color)) if id == object.id => (id, format!("{color} {}", called(noun))),
            _ => (object.id, format!("{}{}", color_of(&object.label, before), called(noun))),
        };
        let new: Vec<(u32, String)> = chosen.iter().map(label).collect();
        if !new.is_empty() {
            nouns.push((noun.text.clone(), new.iter().map(|(id, _)| *id).collect()));
            labels.extend(new);
        }
    }
    if labels.is_empty() {
        return only_ones(prompt, &words, objects);
    }
    Some(Named { objects: numbered(objects, &labels), nouns, prompt: None })
}

/// What `one` stands for in a prompt without nouns: a word as long, so that the bytes of its words stay.
const ONE: &str = "toy";

/// The names of the things of a prompt that only says which one: `orbit the left one`.
fn only_ones(prompt: &str, words: &[Word], objects: &ObjectSet) -> Option<Named> {
    let is_color = |word: &Word| !of_color(&things(objects), std::slice::from_ref(word)).is_empty();
    let tells = |word: &Word| is_listed(TELLS, &word.text) || is_color(word);
    let is_one = |at: &usize| words[*at].text == "one" && *at > 0 && tells(&words[at - 1]);
    let ones: Vec<[usize; 2]> = (0..words.len()).filter(is_one).map(|at| words[at].span).collect();
    if ones.is_empty() {
        return None;
    }
    let mut said = prompt.to_owned();
    ones.iter().for_each(|[from, to]| said.replace_range(from..to, ONE));
    let label = |object: &&Object| (object.id, format!("{}{ONE}", color_of(&object.label, words)));
    let labels: Vec<(u32, String)> = things(objects).iter().map(label).collect();
    Some(Named { objects: numbered(objects, &labels), nouns: Vec::new(), prompt: Some(said) })
}

/// The things that a name which no thing has may mean: all of them, those of a color, or the largest one. `None` where there are
/// none.
pub(super) fn guess(name: &str, objects: &ObjectSet) -> Option<Vec<u32>> {
    let words = tokenize(name);
    let roots = things(objects);
    let is_all = words.iter().any(|word| is_listed(ALL, &word.stem));
    let Some(head) = words.iter().rev().find(|word| word.is_alphabetic()).filter(|_| !is_all) else {
        return Some(roots.iter().map(|object| object.id).collect());
    };
    let is_kind = candidates(objects, head);
    let colored = of_color(&is_kind, &words);
    let fit = if colored.is_empty() { is_kind } else { colored };
    let is_known = is_listed(FLOWERS, &head.stem) || is_listed(LEAVES, &head.stem) || is_kind_of_thing(head);
    let count = if head.stem != head.text && is_known { fit.len() } else { 1 };
    let ids: Vec<u32> = fit.into_iter().take(count).map(|object| object.id).collect();
    (!ids.is_empty()).then_some(ids)
}

/// The things of a scan, the largest first.
fn things(objects: &ObjectSet) -> Vec<&Object> {
    let is_thing = |object: &&Object| object.parent.is_none() && !is_bound(&object.label);
    let mut things: Vec<&Object> = objects.objects.iter().filter(is_thing).collect();
    things.sort_by_key(|object| std::cmp::Reverse(object.num_gaussians));
    things
}

/// The things that may be called by a noun.
fn candidates<'a>(objects: &'a ObjectSet, noun: &Word) -> Vec<&'a Object> {
    let things = things(objects);
    let is = |list: &str| is_listed(list, &noun.stem) || is_listed(list, &noun.text);
    let is_green = |object: &&Object| object.label.split(' ').any(|word| is_listed(GREENS, word));
    let (green, other): (Vec<&Object>, Vec<&Object>) = things.iter().copied().partition(is_green);
    match () {
        () if is(LEAVES) && !green.is_empty() => green,
        () if is(FLOWERS) && !other.is_empty() => other,
        () => things,
    }
}

/// Those of some things that the words around a noun leave: all where they say which one, and else the largest.
fn chosen<'a>(free: Vec<&'a Object>, words: &[Word], at: usize) -> Vec<&'a Object> {
    let noun = &words[at];
    let before = &words[at.saturating_sub(NEAR)..at];
    let near = &words[at.saturating_sub(NEAR)..words.len().min(at + NEAR + 1)];
    let is = |list: &str| is_listed(list, &noun.stem) || is_listed(list, &noun.text);
    let is_plural = noun.stem != noun.text;
    let is_told = near.iter().any(|word| is_listed(TELLS, &word.text));
    let colored = of_color(&free, before);
    let is_only = !words.iter().enumerate().any(|(other, word)| {
        other != at && (word.stem == noun.stem || is_listed("one ones other others both", &word.text))
    });
    match () {
        // `The pink lotus` is none of a pale pink.
        () if !is_plural && !is_told && is_only && !colored.is_empty() => exact(colored, before),
        () if is(FLOWERS) || is(LEAVES) || is_plural || is_told => free,
        () if !colored.is_empty() => colored,
        () => free.into_iter().take(1).collect(),
    }
}

/// The thing that is left for a color which none of some things has: of a pink and a pale pink one `the cream one`.
fn odd_one<'a>(chosen: &[&Object], words: &'a [Word]) -> Option<(u32, &'a str)> {
    let (known, other): (Vec<&Word>, Vec<&Word>) = (words.iter().filter(|word| is_color(&word.text)))
        .partition(|word| !of_color(chosen, std::slice::from_ref(word)).is_empty());
    let claimed: Vec<u32> = (known.into_iter())
        .flat_map(|word| {
            let said = std::slice::from_ref(word);
            exact(of_color(chosen, said), said)
        })
        .map(|object| object.id)
        .collect();
    let mut left = chosen.iter().filter(|object| !claimed.contains(&object.id));
    match (left.next(), left.next(), &other[..]) {
        (Some(object), None, [color]) if !claimed.is_empty() => Some((object.id, &color.text)),
        _ => None,
    }
}

/// Those of some things of like colors that have exactly the color that is said, where there are such.
fn exact<'a>(colored: Vec<&'a Object>, before: &[Word]) -> Vec<&'a Object> {
    let says = |word: &str| before.iter().any(|said| said.text == word);
    let is_exact = |object: &&&Object| {
        let mut words = object.label.split(' ');
        words.clone().any(says) && words.all(|word| !is_listed("pale light dark", word) || says(word))
    };
    let exact: Vec<&Object> = colored.iter().filter(is_exact).copied().collect();
    if exact.is_empty() { colored } else { exact }
}

/// Whether a word is a noun that names a thing of the scan.
fn is_noun(words: &[Word], at: usize) -> bool {
    let word = &words[at];
    let is = |list: &str| is_listed(list, &word.text) || is_listed(list, &word.stem);
    let is_plant = is(FLOWERS) || is(LEAVES);
    let is_part = || part_of(&word.text, "").is_ok_and(|part| part.is_some());
    let is_determined = words[at.saturating_sub(NEAR)..at].iter().any(|before| is_listed(DETERMINERS, &before.text));
    // `The flower bed`, `the owl's eyes`.
    let is_last = words.get(at + 1).is_none_or(|next| !is_kind_of_thing(next) || is_listed(NO_THINGS, &next.text));
    word.is_alphabetic()
        && is_determined
        && is_last
        && !is(ALL)
        && !is(NO_THINGS)
        && (is_plant || is_kind_of_thing(word) && !is_part())
}

fn is_kind_of_thing(word: &Word) -> bool {
    !Things::embedded().kinds_of(&word.text).is_empty()
}

/// What a noun makes of a thing's name: `leaves` for some of them, because that is how the prompt says it.
fn called(noun: &Word) -> &str {
    if noun.text.ends_with("ves") { &noun.text } else { &noun.stem }
}

/// The color of a guessed name with a space behind it, as the words before a noun call it.
fn color_of(label: &str, before: &[Word]) -> String {
    const OTHER: &str = "large small tall flat long object box panel surface";
    let is_color = |word: &&str| !is_listed(OTHER, word) && word.chars().all(char::is_alphabetic);
    let color: Vec<&str> = label.split(' ').filter(is_color).collect();
    let own = color.last().copied().unwrap_or_default();
    let said = color_said(label, before);
    // `Dark green` stays; `beige` is `white` where the prompt says so.
    if color.is_empty() || !said.is_empty() && said.trim_end() != own { said } else { format!("{} ", color.join(" ")) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    /// Two flowers and two leaves.
    fn pond() -> ObjectSet {
        let object = |(id, label, count): (u32, &str, usize)| Object {
            num_gaussians: count,
            ..Object::from_box(id, label, DVec3::X * f64::from(id), DVec3::splat(0.3))
        };
        let things = [
            (1, "large pink object", 40),
            (2, "large dark green object", 30),
            (3, "large cream object", 35),
            (4, "green object", 20),
        ];
        ObjectSet { objects: things.map(object).to_vec(), labels: Vec::new() }
    }

    fn labels(prompt: &str) -> Vec<String> {
        let named = named(prompt, &pond());
        named.map(|named| named.objects.objects.into_iter().map(|object| object.label).collect()).unwrap_or_default()
    }

    #[test]
    fn flowers_are_not_green_and_leaves_are() {
        let said = labels("float in on the pink lotus, then past the leaves");
        assert_eq!(said, ["pink lotus", "dark green leaves", "large cream object", "green leaves"]);
        assert_eq!(labels("from the white flower to the pink one")[2], "white flower");
        assert_eq!(labels("fly slowly through the scene"), Vec::<String>::new());
    }

    #[test]
    fn a_color_that_no_thing_has_is_the_one_that_is_left() {
        let mut set = pond();
        set.objects[2].label = "large pale pink object".to_owned();
        let named = named("glide from the pink lotus to the cream one", &set).unwrap();
        let labels: Vec<&str> = named.objects.objects.iter().map(|object| object.label.as_str()).collect();
        assert_eq!(labels[..3], ["pink lotus", "large dark green object", "cream lotus"]);
    }

    #[test]
    fn what_nobody_knows_is_the_largest_thing_or_all() {
        assert_eq!(labels("circle the shoe")[..2], ["pink shoe", "large dark green object"]);
        assert_eq!(labels("circle the green shoe")[3], "green shoe");
        assert_eq!(guess("whole plant", &pond()), Some(vec![1, 3, 2, 4]));
        assert_eq!(guess("yellow stamens", &pond()), Some(vec![1]));
        assert_eq!(guess("white blossoms", &pond()), Some(vec![3]));
        assert_eq!(guess("giraffe", &pond()), Some(vec![1]));
    }

    #[test]
    fn one_of_them_is_told_by_its_place() {
        let named = named("orbit the left one", &pond()).unwrap();
        assert_eq!(named.prompt.as_deref(), Some("orbit the left toy"));
        assert_eq!(named.objects.objects[2].label, "cream toy");
        assert!(super::named("hold on to this one shot", &pond()).is_none());
    }

    #[test]
    fn other_scans_have_no_few_things() {
        let mut set = pond();
        set.objects[0].label = "lotus".to_owned();
        assert!(!is_few(&set));
        let mut set = pond();
        set.objects[0].num_gaussians = 1000;
        assert!(!is_few(&set));
    }
}

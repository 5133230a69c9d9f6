//! Objects by the names that people write in files: `<obj-3>`, a label, or words of one.

use cinesplat_files::edits_between;

use super::object::Object;

/// Whether the words of a label fit the words that name it.
type Fits = fn(&[String], &[String]) -> bool;

/// Most objects that a message lists; of more it lists the nearest ones.
const MAX_LISTED: usize = 12;
const NUM_NEAREST: usize = 4;

/// The object that a name means: `<obj-3>` by its id, other names by their label in any case. Of objects with other
/// labels it is the only one whose label ends with the name's words, else the only one whose label holds them: `sofa` is
/// the `green sofa` of a scene with one sofa.
///
/// # Errors
/// What was expected instead: the objects there are (of many the nearest), or those that the name may mean.
pub fn named<'a>(objects: &'a [Object], name: &str) -> Result<&'a Object, String> {
    if let Some(id) = id_in(name) {
        let found = objects.iter().find(|object| object.id == id);
        return found.ok_or_else(|| unknown(objects, name));
    }
    let name_words = words(name);
    // The least words first: equal labels, then labels with words before, then with words around.
    let fits: [Fits; 3] = [
        |label, name| label == name,
        |label, name| label.ends_with(name),
        |label, name| label.windows(name.len()).any(|part| part == name),
    ];
    for fits in fits.into_iter().filter(|_| !name_words.is_empty()) {
        let found: Vec<&Object> = objects.iter().filter(|object| fits(&words(&object.label), &name_words)).collect();
        match found[..] {
            [] => {}
            [object] => return Ok(object),
            _ => return Err(format!("one object: {}", listed(found.iter().take(MAX_LISTED).copied(), found.len()))),
        }
    }
    Err(unknown(objects, name))
}

/// The id in `<obj-3>`.
fn id_in(name: &str) -> Option<u32> {
    name.trim().strip_prefix("<obj-")?.strip_suffix('>')?.parse().ok()
}

/// The words of a name in lower case, without an article.
fn words(name: &str) -> Vec<String> {
    let lower = name.to_lowercase();
    let mut words: Vec<String> = lower.split_whitespace().map(str::to_owned).collect();
    if words.len() > 1 && ["the", "a", "an"].contains(&words[0].as_str()) {
        words.remove(0);
    }
    words
}

/// What is expected in place of a name that no object has.
fn unknown(objects: &[Object], name: &str) -> String {
    if objects.is_empty() {
        return "a point, because the scene has no objects".to_owned();
    }
    if objects.len() <= MAX_LISTED {
        return format!("one of the objects {}", listed(objects.iter(), objects.len()));
    }
    let id = id_in(name);
    let off = |object: &&Object| match id {
        Some(id) => object.id.abs_diff(id) as usize,
        None => edits_between(name, &object.label),
    };
    let mut nearest: Vec<&Object> = objects.iter().collect();
    nearest.sort_by_key(off);
    let nearest = listed(nearest.into_iter().take(NUM_NEAREST), NUM_NEAREST);
    format!("one of {} objects, the nearest are {nearest}", objects.len())
}

/// The first of `num_all` objects.
fn listed<'a>(objects: impl ExactSizeIterator<Item = &'a Object>, num_all: usize) -> String {
    let num_more = num_all.saturating_sub(objects.len());
    let name = |object: &Object| format!("<obj-{}> {}", object.id, object.label).trim_end().to_owned();
    let names: Vec<String> = objects.map(name).collect();
    let more = if num_more > 0 { format!(" and {num_more} more") } else { String::new() };
    names.join(", ") + &more
}

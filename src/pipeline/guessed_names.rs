//! Names that nouns of a prompt give to the things of a scan whose names are guesses, and colors that are said of them.

use cinesplat_language::{Linked, Word, is_listed};
use cinesplat_objects::{Object, ObjectSet};

/// Colors that people call alike.
const ALIKE: [&str; 10] = [
    "blue turquoise teal cyan azure aqua light-blue mint",
    "pink rose magenta salmon peach",
    "white cream beige ivory",
    "brown wooden wood oak tan",
    "gray grey silver metal steel",
    "red orange crimson",
    "green olive lime emerald",
    "yellow gold golden",
    "purple violet lilac lavender",
    "black",
];

/// Objects with nouns of a prompt for names.
pub(super) struct Named {
    /// The objects.
    pub(super) objects: ObjectSet,
    /// The nouns and the objects that have them.
    pub(super) nouns: Vec<(String, Vec<u32>)>,
    /// The prompt with a noun for each word that only stands for one; `None` where it has none.
    pub(super) prompt: Option<String>,
}

impl Named {
    /// Warns of the nouns that the prompt says of these objects.
    pub(super) fn warn(&self, linked: &mut Linked) {
        let said = linked.expanded(&linked.slots);
        let is_said = |ids: &[u32]| ids.iter().any(|id| said.contains(id));
        let warnings: Vec<String> =
            self.nouns.iter().filter(|(_, ids)| is_said(ids)).map(|(noun, ids)| taken_for(noun, ids)).collect();
        linked.warnings.extend(warnings);
    }
}

/// The warning of a noun that is taken for some objects.
pub(super) fn taken_for(noun: &str, ids: &[u32]) -> String {
    let words: Vec<String> = ids.iter().take(3).map(|id| format!("<obj-{id}>")).collect();
    let more = if ids.len() > 3 { " .." } else { "" };
    format!("\"{noun}\" is taken for {}{more}, because nothing in this scene has that name", words.join(" "))
}

/// The objects with new labels, those that are alike with numbers.
pub(super) fn numbered(objects: &ObjectSet, labels: &[(u32, String)]) -> ObjectSet {
    let mut named = objects.clone();
    let alike = |label: &str| labels.iter().filter(|(_, other)| other == label).count() > 1;
    for (nth, (id, label)) in labels.iter().enumerate() {
        let earlier = labels[..nth].iter().filter(|(_, other)| other == label).count() + 1;
        let label = if alike(label) { format!("{label} {earlier}") } else { label.clone() };
        named.objects.iter_mut().filter(|object| object.id == *id).for_each(|object| object.label.clone_from(&label));
    }
    named
}

/// The color of a guessed name with a space behind it, as the words before a noun call it: `blue` for turquoise.
pub(super) fn color_said(label: &str, before: &[Word]) -> String {
    let own = |colors: &&&str| label.split(' ').rev().find(|word| is_listed(colors, word));
    let said = |colors: &&str| before.iter().rev().find(|word| is_listed(colors, &word.text));
    let alike = ALIKE.iter().filter(|colors| own(colors).is_some());
    if let Some(word) = alike.clone().find_map(said) {
        return format!("{} ", word.text);
    }
    alike.clone().find_map(|colors| own(&colors)).map_or_else(String::new, |color| format!("{color} "))
}

/// Whether a word is one of a color.
pub(super) fn is_color(word: &str) -> bool {
    ALIKE.iter().any(|colors| is_listed(colors, word))
}

/// Those of some things whose guessed names have a color that the words say.
pub(super) fn of_color<'a>(things: &[&'a Object], words: &[Word]) -> Vec<&'a Object> {
    let said: Vec<&str> =
        ALIKE.iter().filter(|colors| words.iter().any(|word| is_listed(colors, &word.text))).copied().collect();
    let has = |object: &&&Object| said.iter().any(|colors| object.label.split(' ').any(|word| is_listed(colors, word)));
    things.iter().filter(has).copied().collect()
}

/// Whether a label is that of what bounds a room, which a search names by its place.
pub(super) fn is_bound(label: &str) -> bool {
    label.split(' ').any(|word| matches!(word, "floor" | "ceiling" | "wall"))
}

/// Whether a label has a word.
pub(super) fn has_word(label: &str, word: &str) -> bool {
    label.split(' ').any(|own| own == word)
}

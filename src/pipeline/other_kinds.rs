//! Warnings of what is taken for a thing of another kind: `the fridge` for the microwave of a scene without a fridge.

use cinesplat_language::{Linked, Relation, Things, Word, tokenize};
use cinesplat_objects::{ObjectSet, is_description};

/// Relations of a noun to a name of which nobody has to be told.
const NATURAL: [Relation; 4] = [Relation::Same, Relation::Broader, Relation::Narrower, Relation::Part];

/// Warns where a noun of the prompt names one kind of thing and the thing that it is taken for is of another.
pub(super) fn warn(prompt: &str, linked: &mut Linked, objects: &ObjectSet) {
    let mentions = linked.words_in([0, usize::MAX]).filter_map(|(word, [from, to])| {
        let [id] = linked.expanded(&[linked.slot_at(word)?])[..] else { return None };
        let object = objects.objects.iter().find(|object| object.id == id)?;
        let said = prompt.get(from..to)?;
        is_other_kind(said, &object.label).then(|| {
            format!("\"{said}\" is taken for <obj-{id}> {}, because nothing in this scene has that name", object.label)
        })
    });
    let mut warnings: Vec<String> = mentions.collect();
    warnings.dedup();
    linked.warnings.extend(warnings);
}

/// Whether words name a kind of thing, a label another, and neither is a kind or a part of the other.
fn is_other_kind(said: &str, label: &str) -> bool {
    let things = Things::embedded();
    let stems = |text: &str| -> Vec<String> {
        tokenize(text).into_iter().filter(Word::is_alphabetic).map(|word| word.stem).collect()
    };
    let (said, own) = (stems(said), stems(label));
    let Some(head) = said.last() else { return false };
    let is_named = |noun: &str| Relation::Same.is_in(things.roles(noun));
    let of = |noun: &str, label: &str| things.is_related(label, noun, &NATURAL);
    let (phrase, own_head) = (said.join(" "), own.last().cloned().unwrap_or_default());
    !is_description(label)
        && is_named(head)
        && is_named(&own_head)
        && !said.iter().any(|stem| own.contains(stem))
        && !of(head, label)
        && !of(&phrase, label)
        && !of(&own_head, &phrase)
        && !of(&own.join(" "), &phrase)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn another_kind_is_no_other_name() {
        for (said, label) in [("the fridge", "microwave"), ("the piano", "sideboard"), ("the bed", "armchair")] {
            assert!(is_other_kind(said, label), "{said} for {label}");
        }
        for (said, label) in [
            ("the couch", "sofa"),
            ("the machine", "coffee machine"),
            ("the armchair", "red chair"),
            ("the handle", "kettle"),
            ("the mug", "blue mug"),
            ("the thing", "microwave"),
            ("the fridge", "tall white box"),
            ("it", "microwave"),
        ] {
            assert!(!is_other_kind(said, label), "{said} for {label}");
        }
    }
}

//! A noun that is said again: `orbit the orange armchair, keep the chair centered` is about one chair.

use cinesplat_language::{Mention, NamedObject, is_listed, tokenize};

use crate::explained::{content, head, is_number, label, said};
use crate::names::FoundMention;

/// Words of another thing of the kind, or of any one.
const OTHERS: &str = "other another remaining second third a an each every one both all first last left right";
/// Words behind a thing by which others place it.
const PLACES: &str = "on in at by beside next near under below above over behind between with to from nearest closest";

/// Points a noun of one word at the thing of the kind that was named before, where the network takes it for another one of its kind.
pub(crate) fn point_to_said(prompt: &str, objects: &[NamedObject], found: &mut [FoundMention]) {
    for nth in 1..found.len() {
        let (before, rest) = found.split_at_mut(nth);
        let later = &mut rest[0].mention;
        let words = tokenize(said(prompt, later));
        let Some(last) = words.iter().rev().find(|word| word.is_alphabetic()) else { continue };
        let is_plain = content(said(prompt, later)).len() == 1
            && last.stem == last.text
            && !words.iter().any(|word| is_listed(OTHERS, &word.text))
            && !is_number(said(prompt, later));
        let lead = tokenize(prompt.get(..later.bytes[0]).unwrap_or_default());
        let is_other = lead.last().is_some_and(|word| is_listed(OTHERS, &word.text));
        let behind = tokenize(prompt.get(later.bytes[1]..).unwrap_or_default());
        let is_placed = behind.first().is_some_and(|word| is_listed(PLACES, &word.text));
        let names = |id: u32| label(objects, id).and_then(head);
        let Some(kind) = later.ids.first().and_then(|id| names(*id)) else { continue };
        let is_known = before.iter().any(|found| found.mention.ids == later.ids);
        if !is_plain || is_other || is_placed || is_known {
            continue;
        }
        // Only where its words do not tell it from the one named before.
        let told = content(said(prompt, later));
        let is_alike = |id: u32| {
            let [own, other] = [id, later.ids[0]].map(|id| label(objects, id).map(content).unwrap_or_default());
            names(id).as_ref() == Some(&kind) && (told.is_subset(&own) || other.is_disjoint(&told))
        };
        // `Bookshelf 3` has a number and is called so, too.
        let is_called = |mention: &Mention| !content(said(prompt, mention)).is_disjoint(&told);
        let earlier = before.iter().rev().find_map(|found| match found.mention.ids[..] {
            [id] if is_alike(id) && (!is_number(said(prompt, &found.mention)) || is_called(&found.mention)) => Some(id),
            _ => None,
        });
        if let Some(id) = earlier {
            later.ids = vec![id];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::said::fixture::labelled;

    fn pointed(prompt: &str, mentions: &[(&str, u32)]) -> Vec<u32> {
        let objects = labelled(&["orange armchair", "blue armchair", "table lamp 1", "table lamp 2", "sofa"]);
        let mut from = 0;
        let mut mention = |(words, id): &(&str, u32)| {
            let start = from + prompt[from..].find(words).unwrap();
            from = start + words.len();
            let mention = Mention { bytes: [start, from], ids: vec![*id] };
            FoundMention { mention, probability: 1.0, nearest: Vec::new() }
        };
        let mut found: Vec<FoundMention> = mentions.iter().map(&mut mention).collect();
        point_to_said(prompt, &objects, &mut found);
        found.into_iter().flat_map(|found| found.mention.ids).collect()
    }

    #[test]
    fn a_noun_said_again_is_the_same_thing() {
        let orbit = "orbit the orange armchair, keep the chair centered";
        assert_eq!(pointed(orbit, &[("the orange armchair", 1), ("the chair", 2)]), [1, 1]);
        let bare = "vertigo on the orange armchair, chair stays the same size";
        assert_eq!(pointed(bare, &[("the orange armchair", 1), ("chair", 2)]), [1, 1]);
        let numbered = "rack to table lamp 2, then push in on the lamp";
        assert_eq!(pointed(numbered, &[("table lamp 2", 4), ("the lamp", 3)]), [4, 4]);
    }

    #[test]
    fn another_thing_of_the_kind_stays() {
        let other = "from the orange armchair to the other chair";
        assert_eq!(pointed(other, &[("the orange armchair", 1), ("the other chair", 2)]), [1, 2]);
        let placed = "from the orange armchair to the chair by the door";
        assert_eq!(pointed(placed, &[("the orange armchair", 1), ("the chair", 2)]), [1, 2]);
        let told = "from the orange armchair to the blue armchair";
        assert_eq!(pointed(told, &[("the orange armchair", 1), ("the blue armchair", 2)]), [1, 2]);
        let both = "from the orange armchair to the blue one, hold on the chair";
        assert_eq!(pointed(both, &[("the orange armchair", 1), ("the blue one", 2), ("the chair", 2)]), [1, 2, 2]);
    }
}

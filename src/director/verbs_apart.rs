//! Verbs of the camera that stand behind a name like its last word: `from the left chair truck to the right chair`.

use cinesplat_language::{NamedObject, is_listed, tokenize};

use crate::explained::said;
use crate::names::FoundMention;

/// Verbs that are nouns, too.
const VERBS: &str = "pan truck zoom tilt track dolly crane boom orbit pedestal whip push pull slide swing arc rack drift glide sweep rise";
/// Words of their ways.
const WAYS: &str =
    "to up down left right back in out across past over along around round into onto toward towards slowly";

/// Takes a verb off the end of the names that it was taken for a part of.
pub(crate) fn take_verbs_off(prompt: &str, objects: &[NamedObject], found: &mut [FoundMention]) {
    for found in found {
        let [start, end] = found.mention.bytes;
        let words = tokenize(said(prompt, &found.mention));
        let [.., before, last] = &words[..] else { continue };
        let behind = prompt.get(end..).map(tokenize).unwrap_or_default();
        let leads = behind.first().is_some_and(|word| is_listed(WAYS, &word.text));
        let is_own = |label: &str| tokenize(label).iter().any(|word| word.stem == last.stem);
        let is_named = objects.iter().any(|object| found.mention.ids.contains(&object.id) && is_own(&object.label));
        if leads && is_listed(VERBS, &last.text) && !is_named && !is_listed("the a an", &before.text) {
            found.mention.bytes = [start, start + before.span[1]];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::said::fixture::labelled;
    use cinesplat_language::Mention;

    #[test]
    fn a_verb_behind_a_name_is_no_part_of_it() {
        let objects = labelled(&["left chair", "frying pan"]);
        let named = |prompt: &str, words: &str, id: u32| {
            let from = prompt.find(words).unwrap();
            let mention = Mention { bytes: [from, from + words.len()], ids: vec![id] };
            let mut found = [FoundMention { mention, probability: 1.0, nearest: Vec::new() }];
            take_verbs_off(prompt, &objects, &mut found);
            said(prompt, &found[0].mention).to_owned()
        };
        assert_eq!(named("from the left chair truck to the desk", "left chair truck", 1), "left chair");
        assert_eq!(named("from the left chair pan up", "left chair pan", 1), "left chair");
        assert_eq!(named("from the frying pan to the desk", "frying pan", 2), "frying pan");
        assert_eq!(named("the chair crane is nice", "chair crane", 1), "chair crane");
    }
}

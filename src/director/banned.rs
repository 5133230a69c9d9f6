//! Things that are named only to be kept out: `no foliage anywhere`, `no plants at all`.
//!
//! The network of names leaves out many names without an article.

use cinesplat_language::{Mention, NamedObject, Relation, Things, is_listed, tokenize};

use crate::explained::{is_known, replace_mentions};
use crate::names::FoundMention;

/// Words behind a thing by which it is nowhere.
const NOWHERE: &str = "anywhere whatsoever";

/// Links what is said to be nowhere with the one thing of the scene that has such a name, or is of such a kind.
pub(crate) fn name_banned(prompt: &str, objects: &[NamedObject], found: &mut Vec<FoundMention>) {
    let words = tokenize(prompt);
    let text = |at: usize| words.get(at).map_or("", |word| word.text.as_str());
    let things = Things::embedded();
    for at in (1..words.len()).filter(|at| text(at - 1) == "no" && words[*at].is_alphabetic()) {
        let is_nowhere = is_listed(NOWHERE, text(at + 1)) || text(at + 1) == "at" && text(at + 2) == "all";
        if !is_nowhere || is_known(found, words[at].span) {
            continue;
        }
        let named_by = [Relation::Same, Relation::Broader, Relation::Part];
        let is_meant = |object: &&NamedObject| things.is_related(&object.label, &words[at].stem, &named_by);
        let mut meant = objects.iter().filter(is_meant);
        if let (Some(object), None) = (meant.next(), meant.next()) {
            replace_mentions(found, Mention { bytes: words[at].span, ids: vec![object.id] });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::said::fixture::labelled;

    #[test]
    fn a_thing_that_is_to_be_nowhere_is_named() {
        let objects = labelled(&["electric guitar", "potted palm", "golden skull"]);
        let named = |prompt: &str| {
            let mut found = Vec::new();
            name_banned(prompt, &objects, &mut found);
            found.first().map(|found| found.mention.ids[0])
        };
        assert_eq!(named("show the guitar, and no foliage anywhere"), Some(2));
        assert_eq!(named("no plants at all, please"), Some(2));
        assert_eq!(named("no people anywhere"), None);
        assert_eq!(named("no plant behind it"), None);
    }
}

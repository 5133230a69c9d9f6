//! Names by what a thing looks like: `the white pebble looking sculpture`, `the egg-shaped lamp`.

use cinesplat_language::{Mention, NamedObject, Relation, Things, is_listed, stem, tokenize};

use crate::explained::{content, head, is_number, label, said};
use crate::names::FoundMention;

/// Words between what a thing looks like and the thing.
const LIKE: &str = "looking shaped like style type kind ish";

/// Makes one mention of a thing and of what it looks like, of the things of that kind whose names have most to do with it.
pub(crate) fn join_likenesses(prompt: &str, objects: &[NamedObject], found: &mut Vec<FoundMention>) {
    let mut nth = 1;
    while nth < found.len() {
        let [look, thing] = [&found[nth - 1].mention, &found[nth].mention];
        let between = tokenize(prompt.get(look.bytes[1]..thing.bytes[0]).unwrap_or_default());
        let is_like = between.iter().any(|word| is_listed(LIKE, &word.text))
            && between.iter().all(|word| is_listed(LIKE, &word.text) || word.text == "-");
        let words = format!("{} {}", said(prompt, look), said(prompt, thing));
        match liked(objects, look, thing, &words).filter(|_| is_like && !is_number(&words)) {
            Some(id) => {
                found[nth - 1].mention = Mention { bytes: [look.bytes[0], thing.bytes[1]], ids: vec![id] };
                found.remove(nth);
            }
            None => nth += 1,
        }
    }
}

/// Of the things of the kind of `thing` the one that `look` names, or whose name has most of the words, or of those related
/// to it.
fn liked(objects: &[NamedObject], look: &Mention, thing: &Mention, words: &str) -> Option<u32> {
    let kind = label(objects, *thing.ids.first()?).and_then(head)?;
    let of_kind: Vec<&NamedObject> =
        objects.iter().filter(|object| head(&object.label).as_deref() == Some(&kind)).collect();
    if let Some(named) = of_kind.iter().find(|object| look.ids.contains(&object.id)) {
        return Some(named.id);
    }
    let told = content(words);
    let things = Things::embedded();
    let fit = |object: &&NamedObject| {
        let own = content(&object.label);
        let related = things.related(&things.kinds_of(&object.label));
        let is_related = |word: &&String| {
            let related = related.iter().filter(|(_, set)| Relation::Same.is_in(**set));
            related.flat_map(|(phrase, _)| phrase.split(' ')).any(|other| stem(other) == **word)
        };
        told.iter().filter(|word| own.contains(*word) || is_related(word)).count()
    };
    let best = of_kind.iter().map(fit).max()?;
    of_kind.iter().find(|object| fit(object) == best).map(|object| object.id)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::said::fixture::labelled;

    #[test]
    fn what_a_thing_looks_like_tells_it_from_others() {
        let objects = labelled(&["wooden knot sculpture", "white stacked stone sculpture", "white door"]);
        let joined = |prompt: &str, mentions: [(&str, u32); 2]| {
            let mention = |(words, id): (&str, u32)| {
                let start = prompt.find(words).unwrap();
                let mention = Mention { bytes: [start, start + words.len()], ids: vec![id] };
                FoundMention { mention, probability: 1.0, nearest: Vec::new() }
            };
            let mut found: Vec<FoundMention> = mentions.map(mention).to_vec();
            join_likenesses(prompt, &objects, &mut found);
            found.into_iter().map(|found| found.mention.ids).collect::<Vec<_>>()
        };
        let pebble = "around the white pebble looking sculpture";
        assert_eq!(joined(pebble, [("the white pebble", 3), ("sculpture", 1)]), [[2]]);
        assert_eq!(joined("the knot-shaped sculpture", [("the knot", 1), ("sculpture", 2)]), [[1]]);
        assert_eq!(joined("the knot and the sculpture", [("the knot", 1), ("the sculpture", 2)]), [[1], [2]]);
    }
}

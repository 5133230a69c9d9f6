//! Names whose last word says what the thing is: the `dining lamp` is a lamp, and no dining table.

use cinesplat_language::{NamedObject, Relation, Things, is_listed, tokenize};

use crate::explained::{content, head, is_number, label, may_mean, said};
use crate::names::FoundMention;
use crate::placed::Places;

/// Points a mention whose last word does not fit the thing that it was taken for at the thing of that kind, the nearest of
/// several.
pub(crate) fn point_by_heads(prompt: &str, objects: &[NamedObject], places: Places<'_>, found: &mut [FoundMention]) {
    for found in found {
        let all = said(prompt, &found.mention);
        let words = before_place(all);
        let [id] = found.mention.ids[..] else { continue };
        let (Some(noun), Some(taken)) = (head(words), label(objects, id)) else { continue };
        let is_short = content(words).len() < 2;
        if is_number(words) || is_short && words.len() == all.len() {
            continue;
        }
        if let Some(id) = called_by_two(words, taken, objects) {
            found.mention.ids = vec![id];
            continue;
        }
        // `The bookshelf on the wall` is no wall shelf, where there is a bookshelf.
        let is_own = |label: &str| head(label).as_deref() == Some(&noun);
        let is_other = is_short && !is_own(taken) && objects.iter().any(|object| is_own(&object.label));
        if may_mean(&noun, taken) && !is_other {
            continue;
        }
        let center = |id: u32| places.objects.iter().find(|object| object.id == id).map(|object| object.center);
        let apart = |other: u32| center(other).zip(center(id)).map_or(0.0, |(a, b)| a.distance(b));
        // `The pink drawer unit` are the drawers, where another thing is called a unit as well.
        let names_taken = head(taken).is_some_and(|taken| content(words).contains(&taken));
        let is_called = |object: &&NamedObject| {
            is_own(&object.label)
                || !is_other && !names_taken && Things::embedded().is_related(&object.label, &noun, &[Relation::Same])
        };
        let of_kind = objects.iter().filter(is_called);
        if let Some(object) = of_kind.min_by(|a, b| apart(a.id).total_cmp(&apart(b.id))) {
            found.mention.ids = vec![object.id];
        }
    }
}

/// The one thing that the last two words of a name are another name of, where they name the thing that it was taken for not at all:
/// the `yellow tool board` is the tool wall, and no yellow toolbox.
fn called_by_two(words: &str, taken: &str, objects: &[NamedObject]) -> Option<u32> {
    let stems: Vec<String> = tokenize(words).into_iter().map(|word| word.stem).collect();
    let phrase = stems.get(stems.len().checked_sub(2)?..)?.join(" ");
    let is_called = |label: &str| Things::embedded().is_related(label, &phrase, &[Relation::Same]);
    if is_called(taken) || taken.to_lowercase().contains(&phrase) {
        return None;
    }
    let mut called = objects.iter().filter(|object| is_called(&object.label)).map(|object| object.id);
    called.next().filter(|_| called.next().is_none())
}

/// Words that lead to where a thing is.
const PLACES: &str = "on in under above below by near beside behind atop";

/// The words of a name before those of a place: `the teal plates` of `the teal plates on the shelf`.
pub(crate) fn before_place(words: &str) -> &str {
    let place = tokenize(words).into_iter().skip(1).find(|word| is_listed(PLACES, &word.text));
    place.and_then(|word| words.get(..word.span[0])).unwrap_or(words)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::said::fixture::labelled;
    use cinesplat_language::Mention;
    use glam::DVec3;

    #[test]
    fn two_words_that_are_another_name_outweigh_a_color() {
        let objects = labelled(&["tool wall", "yellow toolbox", "dining table", "workbench"]);
        let called = |words: &str, taken: &str| called_by_two(words, taken, &objects);
        assert_eq!(called("the yellow tool board", "yellow toolbox"), Some(1));
        assert_eq!(called("the peg board", "workbench"), Some(1));
        assert_eq!(called("the tool wall", "tool wall"), None);
        assert_eq!(called("the yellow box", "yellow toolbox"), None);
    }

    #[test]
    fn the_last_word_of_a_name_says_what_the_thing_is() {
        let objects = labelled(&[
            "dining table",
            "yellow pendant lamp",
            "white door",
            "pink drawers",
            "teal cabinet",
            "wall shelf",
            "bookshelf",
        ]);
        let pointed = |words: &str, id: u32| {
            let mention = Mention { bytes: [0, words.len()], ids: vec![id] };
            let mut found = [FoundMention { mention, probability: 1.0, nearest: Vec::new() }];
            point_by_heads(words, &objects, Places { objects: &[], up: DVec3::Y }, &mut found);
            found[0].mention.ids[0]
        };
        assert_eq!(pointed("the dining lamp", 1), 2);
        assert_eq!(pointed("the dining table", 1), 1);
        assert_eq!(pointed("the table leg", 1), 1);
        assert_eq!(pointed("the door frame", 3), 3);
        assert_eq!(pointed("the drawer unit", 4), 4);
        assert_eq!(pointed("the yellow lamp by the white door", 3), 2);
        assert_eq!(pointed("the bookshelf on the brick wall", 6), 7);
        assert_eq!(pointed("the shelf on the brick wall", 6), 6);
        assert_eq!(pointed("the bookshelf", 6), 6);
    }
}

//! Pictures on the wall that the words describe: `the big sunset picture above the sofa`.
//!
//! `Picture` is also what a film shows, so the network of names leaves many of them out.

use cinesplat_language::{Mention, NamedObject, Word, is_listed, tokenize};

use crate::explained::{head, is_known, replace_mentions};
use crate::names::FoundMention;

/// What hangs on walls, and what the scene may call it.
pub(crate) const PICTURES: &str = "picture painting print poster photo photograph artwork canvas";
pub(crate) const LABELS: &str = "picture painting print poster photo photograph artwork";
/// What pictures are of: `the framed landscape`.
const SCENES: &str = "landscape seascape portrait watercolor watercolour sketch drawing map certificate abstract still";
/// Words before such a name, and most of them.
const ARTICLES: &str = "the that this";
const MOST_BEFORE: usize = 5;
/// What a picture is like on a wall, and no frame of a film is.
const LOOKS: &str = "big large huge small little framed abstract sunset landscape mountain seascape floral leaf botanical portrait \
    gold golden wooden black white colorful colourful old biggest largest smallest tall long";
/// Words before it that lead to it.
const GOALS: &str = "at to towards toward onto on from past";
/// Words behind it by which it is on a wall.
const PLACES: &str = "above over beside on by next near between nearest closest";

/// Links a picture that the words describe or place and that names nothing yet with all of the scene, of which its place tells one.
pub(crate) fn name_pictures(prompt: &str, objects: &[NamedObject], found: &mut Vec<FoundMention>) {
    let is_picture = |object: &&NamedObject| head(&object.label).is_some_and(|head| is_listed(LABELS, &head));
    let mut ids: Vec<u32> = objects.iter().filter(is_picture).map(|object| object.id).collect();
    ids.sort_unstable();
    if ids.is_empty() {
        return;
    }
    let words = tokenize(prompt);
    let text = |at: usize| words.get(at).map_or("", |word| word.text.as_str());
    let is_framed = |at: usize| at > 0 && text(at - 1) == "framed" && is_listed(SCENES, text(at));
    for at in (0..words.len()).filter(|at| is_listed(PICTURES, text(*at)) || is_framed(*at)) {
        let article = (at.saturating_sub(MOST_BEFORE)..at).rev().find(|before| is_listed(ARTICLES, text(*before)));
        let Some(article) = article.filter(|article| (article + 1..at).all(|word| words[word].is_alphabetic())) else {
            continue;
        };
        let looks = (article + 1..at).any(|word| is_listed(LOOKS, text(word)));
        let is_placed = is_listed(PLACES, text(at + 1)) && !matches!(text(at + 3), "screen" | "camera" | "end");
        let span = [words[article].span[0], words[at].span[1]];
        // What is taken for something that the scene lacks is none of its things.
        let is_known = is_known(found, words[at].span);
        // `Look up at the picture above it`.
        let is_goal = article > 0 && is_listed(GOALS, text(article - 1)) && is_listed("above over", text(at + 1));
        let is_described = looks && (is_placed || !words.get(at + 1).is_some_and(Word::is_alphabetic));
        if (is_goal && is_placed || is_described) && !is_known {
            replace_mentions(found, Mention { bytes: span, ids: ids.clone() });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::said::fixture::labelled;

    #[test]
    fn a_picture_on_a_wall_is_a_thing() {
        let objects = labelled(&["picture 1", "sofa", "picture 2"]);
        let named = |prompt: &str| {
            let mut found = Vec::new();
            name_pictures(prompt, &objects, &mut found);
            found.into_iter().map(|found| found.mention.ids).collect::<Vec<_>>()
        };
        assert_eq!(named("tilt up to the big sunset picture above the sofa"), [[1, 3]]);
        assert_eq!(named("end on the framed print, then hold"), [[1, 3]]);
        assert_eq!(named("up to the framed landscape over the headboard"), [[1, 3]]);
        assert_eq!(named("look up at the picture above it, and stay"), [[1, 3]]);
        assert_eq!(named("start on the picture above the bed and pull back"), [[1, 3]]);
        for other in ["keep the whole picture on the lamp", "the lamp fills the big picture frame", "a nice picture"] {
            assert_eq!(named(other), Vec::<Vec<u32>>::new(), "{other}");
        }
    }
}

//! Names that other names explain: of things named before (`the pink drawers .. push in on the drawers`), of parts of things, and
//! words of labels that stand alone.

use std::collections::BTreeSet;

use cinesplat_language::{
    LanguageError, Mention, NamedObject, Relation, Things, Word, is_listed, is_no_thing, own_part_at, stem, tokenize,
};

use crate::names::FoundMention;
use crate::said::abbreviated_size;

/// Points mentions of one thing at the thing that an earlier mention named by the same words and more, as `the drawers`
/// after `the pink drawers`, though the scene has a `drawer chest` too. A name that is exactly another thing's stays.
pub(crate) fn point_back(prompt: &str, objects: &[NamedObject], found: &mut [FoundMention]) {
    for nth in 1..found.len() {
        let (before, rest) = found.split_at_mut(nth);
        let later = &mut rest[0].mention;
        let name = said(prompt, later);
        let words = content(name);
        let is_plural = tokenize(name).last().is_some_and(|word| word.stem != word.text);
        if let Some(bearer) = bearer_of(&words, objects, before).filter(|_| is_plural) {
            later.ids = vec![bearer];
            continue;
        }
        let [id] = later.ids[..] else { continue };
        if words.is_empty() || is_number(name) || label(objects, id).is_some_and(|label| content(label) == words) {
            continue;
        }
        let mut earlier = before.iter().rev().filter_map(|found| match found.mention.ids[..] {
            [id] => Some((id, &found.mention)),
            _ => None,
        });
        let names_more = |(earlier_id, mention): &(u32, &Mention)| {
            let is_part = |whole: &str| {
                let all = content(whole);
                words.is_subset(&all) && words != all && head(whole) == head(name)
            };
            is_part(said(prompt, mention)) || label(objects, *earlier_id).is_some_and(is_part)
        };
        if let Some((earlier_id, _)) = earlier.find(names_more) {
            later.ids = vec![earlier_id];
        }
    }
}

/// The thing that an earlier mention named and whose name says that it bears what one word means, where the scene has none of
/// that by itself: `the tools` after `the tool wall` hang there, and are no toolboxes.
fn bearer_of(words: &BTreeSet<String>, objects: &[NamedObject], before: &[FoundMention]) -> Option<u32> {
    let word = words.first().filter(|_| words.len() == 1)?;
    if objects.iter().any(|object| head(&object.label).as_ref() == Some(word)) {
        return None;
    }
    let bears = |id: &u32| label(objects, *id).is_some_and(|label| content(label).contains(word));
    before.iter().rev().filter_map(|found| found.mention.ids.first()).copied().find(bears)
}

/// Points `the green one` at the one thing of that color whose kind the mention before names, as after `three vases`.
pub(crate) fn point_ones(prompt: &str, objects: &[NamedObject], found: &mut [FoundMention]) {
    for nth in 1..found.len() {
        let (before, rest) = found.split_at_mut(nth);
        let later = &mut rest[0].mention;
        let words = tokenize(said(prompt, later));
        let Some((_, told)) = words.split_last().filter(|(last, _)| matches!(last.text.as_str(), "one" | "ones"))
        else {
            continue;
        };
        let told: Vec<&str> = told.iter().map(|word| word.text.as_str()).filter(|word| *word != "the").collect();
        // Places (`the left one`) and numbers are not in labels.
        let fits = |id: &u32| {
            label(objects, *id).is_some_and(|label| {
                let has = |word: &&str| tokenize(label).iter().any(|part| part.text == *word);
                !told.is_empty() && told.iter().all(has)
            })
        };
        let mut kinds = before.iter().rev().flat_map(|found| content(said(prompt, &found.mention)));
        let of_kind = |kind: &String| {
            let is_kind = |object: &&NamedObject| tokenize(&object.label).iter().any(|word| stem(&word.text) == *kind);
            let ids: Vec<u32> = objects.iter().filter(is_kind).map(|object| object.id).filter(fits).collect();
            matches!(ids[..], [_]).then_some(ids)
        };
        if let Some(ids) = kinds.find_map(|kind| of_kind(&kind)) {
            later.ids = ids;
        }
    }
}

/// Takes back mentions inside words that only say where a row of things begins, because they name no thing besides the row:
/// `pan over all three easels, left one first`.
pub(crate) fn drop_first_ones(prompt: &str, found: &mut Vec<FoundMention>) {
    let words = tokenize(prompt);
    let text = |at: usize| words.get(at).map_or("", |word| word.text.as_str());
    for at in 1..words.len() {
        let begins = matches!(text(at), "left" | "right" | "leftmost" | "rightmost") && text(at + 1) == "one";
        let leads = |back: usize| at.checked_sub(back).map_or("", text);
        let article = 1 + usize::from(leads(1) == "the");
        let starts = matches!(leads(article + 1), "starting" | "beginning")
            && matches!(leads(article), "with" | "at" | "from" | "on");
        if !begins || !(starts || text(at + 2) == "first") {
            continue;
        }
        let [from, to] = [words[at].span[0], words[at + 1].span[1]];
        let row = found.iter().any(|found| found.mention.bytes[1] <= from && found.mention.ids.len() > 1);
        found.retain(|found| !row || found.mention.bytes[1] <= from || found.mention.bytes[0] >= to);
    }
}

/// Links words that name nothing yet, where they are a part that things of one kind have: `the left earcup` of headphones.
///
/// # Errors
/// [`LanguageError::BadData`] for a damaged list of parts.
pub(crate) fn name_by_parts(
    prompt: &str,
    objects: &[NamedObject],
    found: &mut Vec<FoundMention>,
) -> Result<(), LanguageError> {
    let words = tokenize(prompt);
    let text = |at: usize| words.get(at).map_or("", |word| word.text.as_str());
    for at in 1..words.len() {
        // `Lift your head` is about nobody's guitar.
        let is_body = is_listed("my our your", text(at - 1)) && is_listed(BODY, text(at));
        let own = Mention { bytes: [words[at - 1].span[0], words[at].span[1]], ids: Vec::new() };
        // `Fills the picture` is about no painting.
        if !is_listed(POINTS, text(at - 1)) || is_body || is_no_thing(prompt, &own, objects) {
            continue;
        }
        let mut owners = Vec::new();
        for object in objects {
            let own = own_part_at(&words[at..words.len().min(at + 3)], &object.label)?;
            owners.extend(own.map(|len| (object.id, at + len)));
        }
        let before = |id: &u32| {
            found.iter().rposition(|found| found.mention.bytes[0] < words[at].span[0] && found.mention.ids == [*id])
        };
        // Of several things with such a part the one named last is meant.
        let owner = match owners[..] {
            [owner] => Some(owner),
            _ => owners.iter().filter(|(id, _)| before(id).is_some()).max_by_key(|(id, _)| before(id)).copied(),
        };
        // `Its foot` is that of something that was named.
        let is_owned = is_listed("its his her their", text(at - 1));
        let Some((id, to)) = owner.filter(|(id, _)| !is_owned || before(id).is_some()) else { continue };
        let is_alone = text(to).chars().all(|letter| !letter.is_alphanumeric())
            || is_listed(BEHIND, text(to))
            || text(to).starts_with("fill");
        if is_alone && !is_linked(found, [words[at].span[0], words[to - 1].span[1]]) {
            insert_mention(found, Mention { bytes: [words[at - 1].span[0], words[to - 1].span[1]], ids: vec![id] });
        }
    }
    Ok(())
}

/// Takes abbreviations of shot sizes, which are no part of a name, off the beginnings of mentions: `EWS ship`.
pub(crate) fn drop_sizes(prompt: &str, objects: &[NamedObject], found: &mut [FoundMention]) {
    for found in found {
        let mention = &mut found.mention;
        let words = tokenize(said(prompt, mention));
        let is_named = |word: &str| {
            let mut labels = mention.ids.iter().filter_map(|id| label(objects, *id));
            labels.any(|label| tokenize(label).iter().any(|part| part.text == word))
        };
        if let [first, second, ..] = &words[..]
            && abbreviated_size(&first.text).is_some()
            && !is_named(&first.text)
        {
            mention.bytes[0] += second.span[0];
        }
    }
}

/// Parts of people.
const BODY: &str = "head heads eye eyes face nose hand hands foot feet neck back shoulder shoulders gaze chin";
/// Words before a thing that is named by a part of its label, and words behind it, besides marks.
pub(crate) const POINTS: &str = "the this that my our your his her its";
const BEHIND: &str =
    "and then to until till on in from with at for while as so but or by before after into again please is stays";
/// What a thing looks like that its label does not say.
const SHAPES: &str = "round square oval low little small big large long wooden glass marble old nice lovely pretty";
/// Words of labels that may mean something else where they stand alone.
const LOOSE: &str = "left right top bottom front back rear side middle center centre big small large tall short high low \
    wall walls floor ceiling room corner end edge camera frame shot picture view scene light lights glass wood wooden metal \
    stone door table window red green blue yellow white black brown gray grey pink orange purple gold golden silver dark \
    bright old new open closed round square first second third other one two three base part half upper lower area space";

/// Links words that name nothing yet, where they are a word of one label alone: `the sushi` for the sushi platter.
pub(crate) fn name_by_label_words(prompt: &str, objects: &[NamedObject], found: &mut Vec<FoundMention>) {
    let words = tokenize(prompt);
    let text = |at: usize| words.get(at).map_or("", |word| word.text.as_str());
    for at in 1..words.len() {
        let word = &words[at];
        let is_alone = text(at + 1).chars().all(|letter| !letter.is_alphanumeric()) || is_listed(BEHIND, text(at + 1));
        let is_name = is_listed(POINTS, text(at - 1)) && is_alone && !word.after_hyphen && word.is_alphabetic();
        // `The round table`, of which there is one.
        let is_shaped = at > 1 && is_listed(SHAPES, text(at - 1)) && is_listed(POINTS, text(at - 2));
        let is_head = |object: &&NamedObject| head(&object.label) == Some(stem(&word.text));
        if is_shaped && is_alone && word.is_alphabetic() && !is_linked(found, word.span) {
            // A side table is none where there is another one.
            let all: Vec<&NamedObject> = objects.iter().filter(is_head).collect();
            let is_main = |object: &&&NamedObject| {
                !is_listed("side bedside end console", object.label.split(' ').next().unwrap_or_default())
            };
            let main: Vec<&NamedObject> = all.iter().filter(is_main).copied().collect();
            let mut named = if main.is_empty() { all } else { main }.into_iter();
            if let (Some(object), None) = (named.next(), named.next()) {
                insert_mention(found, Mention { bytes: [words[at - 2].span[0], word.span[1]], ids: vec![object.id] });
                continue;
            }
        }
        // `An overhead of the whole table`.
        let is_whole =
            at > 1 && is_listed("whole entire full complete", text(at - 1)) && is_listed(POINTS, text(at - 2));
        let is_label = |object: &&NamedObject| content(&object.label) == BTreeSet::from([stem(&word.text)]);
        if is_whole && is_alone && !is_linked(found, word.span) {
            let mut named = objects.iter().filter(is_label);
            if let (Some(object), None) = (named.next(), named.next()) {
                insert_mention(found, Mention { bytes: [words[at - 1].span[0], word.span[1]], ids: vec![object.id] });
            }
            continue;
        }
        if !is_name || is_linked(found, word.span) || word.text.len() < 4 || is_listed(LOOSE, &word.text) {
            continue;
        }
        let has = |object: &&NamedObject| content(&object.label).contains(&stem(&word.text));
        let mut named = objects.iter().filter(has);
        let (Some(object), None) = (named.next(), named.next()) else { continue };
        insert_mention(found, Mention { bytes: [words[at - 1].span[0], word.span[1]], ids: vec![object.id] });
    }
}

/// Puts a mention that the words make sure of in its place among the others.
pub(crate) fn insert_mention(found: &mut Vec<FoundMention>, mention: Mention) {
    insert_found(found, FoundMention { mention, probability: 1.0, nearest: Vec::new() });
}

/// Puts a mention where it stands in the prompt.
pub(crate) fn insert_found(found: &mut Vec<FoundMention>, new: FoundMention) {
    let place = found.partition_point(|found| found.mention.bytes[0] < new.mention.bytes[0]);
    found.insert(place, new);
}

/// Puts a mention that is certain in the place of those that share words with it.
pub(crate) fn replace_mentions(found: &mut Vec<FoundMention>, mention: Mention) {
    drop_mentions(found, mention.bytes);
    insert_mention(found, mention);
}

/// Removes the mentions that have some of these bytes of the prompt.
pub(crate) fn drop_mentions(found: &mut Vec<FoundMention>, bytes: [usize; 2]) {
    found.retain(|found| !shares_bytes(found, bytes));
}

/// Whether a mention of things of the scene has some of these bytes of the prompt.
pub(crate) fn is_known(found: &[FoundMention], bytes: [usize; 2]) -> bool {
    found.iter().any(|found| shares_bytes(found, bytes) && !found.mention.ids.is_empty())
}

fn shares_bytes(found: &FoundMention, [from, to]: [usize; 2]) -> bool {
    found.mention.bytes[0] < to && from < found.mention.bytes[1]
}

/// Whether a mention has some of these bytes of the prompt.
pub(crate) fn is_linked(found: &[FoundMention], bytes: [usize; 2]) -> bool {
    found.iter().any(|found| shares_bytes(found, bytes))
}

/// The words of a mention.
pub(crate) fn said<'a>(prompt: &'a str, mention: &Mention) -> &'a str {
    prompt.get(mention.bytes[0]..mention.bytes[1]).unwrap_or_default()
}

/// The label of an object.
pub(crate) fn label(objects: &[NamedObject], id: u32) -> Option<&str> {
    objects.iter().find(|object| object.id == id).map(|object| object.label.as_str())
}

/// The stem of the thing that a name names: its last word.
pub(crate) fn head(name: &str) -> Option<String> {
    tokenize(name).into_iter().rev().find(Word::is_alphabetic).map(|word| stem(&word.text))
}

/// Whether a noun (a stem) may mean what has a label: a word of it, its kind, or a part of it.
pub(crate) fn may_mean(noun: &str, label: &str) -> bool {
    let named_by = [Relation::Same, Relation::Broader, Relation::Narrower, Relation::Part];
    content(label).contains(noun) || Things::embedded().is_related(label, noun, &named_by)
}

/// Whether a mention is a number: `<obj-3>`, `object 3`.
pub(crate) fn is_number(words: &str) -> bool {
    words.contains(|letter: char| letter.is_ascii_digit())
}

/// The stems of the words of a name but articles and pointing words.
pub(crate) fn content(name: &str) -> BTreeSet<String> {
    let points =
        |word: &str| matches!(word, "the" | "a" | "an" | "this" | "that" | "these" | "those" | "same" | "said");
    let words = tokenize(name).into_iter().filter(|word| word.is_alphabetic() && !points(&word.text));
    words.map(|word| stem(&word.text)).collect()
}

//! Two of a kind that the words tell by each other: `show the two chairs, one then the other`, `open on the one at the front, travel
//! over to the second one, then lift so both are seen`, `pan from the left nightstand to the right one`.
//!
//! Enters: a prompt and its mentions of objects. Leaves: the mentions with those of `one`, `the other`, `both` and `the gap between
//! them`, and the bytes of the mention of both that only leads to them.

use cinesplat_language::{Mention, NamedObject, Word, is_listed, tokenize};

use crate::explained::{head, is_number, label, replace_mentions, said};
use crate::names::FoundMention;
use crate::placed::{Flank, Places, kind_of, outermost, told_flank};

/// Words by which one of two is told, and words behind `the one` that say where it is.
const SECONDS: &str = "other second remaining";
const FIRSTS: &str = "first";
const NEAR: &str = "front near nearer nearest closer closest foreground";
const FAR: &str = "back far farther further farthest rear background";
const AT: &str = "at in on by to";
const WHERE: &str = "front back left right near far rear foreground background side end";
const OF: &str = "of the table frame room picture scene shot image desk shelf hand side end";
/// Words of both.
const BOTH: &[&[&str]] = &[
    &["both", "of", "them"],
    &["the", "two", "of", "them"],
    &["them", "both"],
    &["both"],
    &["the", "pair"],
    &["the", "two"],
];
/// What is between two things.
const GAPS: &str = "gap space distance area emptiness void room air stretch";
/// What follows `both` and is no pair: `both sides`.
const NO_PAIRS: &str = "side sides end ends hand hands times way ways directions";
/// Words between `one` and `the other`.
const LEADS: &str =
    ", . and then the first afterwards next to - over look at on go show see pan move turn drift travel glide hold";
/// How far apart two things are.
const APART: &[&[&str]] = &[
    &["how", "far", "apart", "they"],
    &["what", "is", "between", "them"],
    &["what", "'s", "between", "them"],
    &["what", "stands", "between", "them"],
    &["what", "lies", "between", "them"],
    &["what", "sits", "between", "them"],
];
/// Most words between the mention of both and `one`.
const MOST_BETWEEN: usize = 6;

/// One phrase that stands for one of two, or for both.
#[derive(Debug, PartialEq)]
enum Phrase {
    /// `One`, before `the other`.
    One,
    /// `The other`, `the second one`.
    Other,
    /// `The one at the front`, `the first one`.
    First,
    /// `The right one`.
    Side(Flank),
    /// `Both`, `the gap between them`.
    Both,
}

/// The pair that the words are about, and the one of it that was named last.
struct Pair {
    ids: Vec<u32>,
    last: Option<u32>,
    /// The bytes of the mention of both.
    group: Option<[usize; 2]>,
    /// Whether one of it was told from the other.
    is_told: bool,
}

/// Makes mentions of words that stand for one of two things and for both. The bytes left are those of a mention of both that only
/// leads to the two.
pub(crate) fn name_pairs(
    prompt: &str,
    objects: &[NamedObject],
    places: Places<'_>,
    found: &mut Vec<FoundMention>,
) -> Vec<[usize; 2]> {
    let words = tokenize(prompt);
    let mut blanks = Vec::new();
    let mut pair: Option<Pair> = None;
    let mut at = 0;
    while at < words.len() {
        let Some((len, phrase)) = phrase_at(&words, at) else {
            at += 1;
            continue;
        };
        let bytes = [words[at].span[0], words[at + len - 1].span[1]];
        at += 1;
        let is_one = matches!(phrase, Phrase::Other | Phrase::Side(_));
        pair = pair_before(prompt, objects, found, bytes[0], pair)
            .or_else(|| told_apart(objects, found, bytes[0]).filter(|_| is_one));
        // `The table between the two` is the table.
        if phrase == Phrase::Both && at > 1 && words[at - 2].text == "between" {
            let gap = words[at - 2].span[0];
            let is_near = |found: &&mut FoundMention| {
                let [from, to] = found.mention.bytes;
                let between = prompt.get(to..gap).unwrap_or_default();
                from < gap && to <= gap && !found.mention.ids.is_empty() && tokenize(between).len() < 3
            };
            if let Some(thing) = found.iter_mut().rev().find(is_near).filter(|_| pair.is_some()) {
                thing.mention.bytes[1] = bytes[1];
                let end = bytes;
                found.retain(|found| found.mention.bytes[0] < end[0] || found.mention.bytes[0] >= end[1]);
                continue;
            }
        }
        let Some(own) = pair.as_mut().filter(|own| own.ids.len() == 2) else { continue };
        let others = |last: u32| own.ids.iter().copied().find(|id| *id != last);
        let ids = match phrase {
            Phrase::One => vec![own.ids[0]],
            Phrase::First => vec![own.last.filter(|_| own.is_told).and_then(others).unwrap_or(own.ids[0])],
            Phrase::Other => vec![own.last.and_then(others).unwrap_or(own.ids[1])],
            Phrase::Side(flank) => match outermost(places, &own.ids, flank) {
                Some(id) => vec![id],
                None => own.last.and_then(others).into_iter().collect(),
            },
            Phrase::Both if own.is_told || is_gap(&words[at - 1..]) => own.ids.clone(),
            Phrase::Both => continue,
        };
        // A longer mention says more than the phrase, as `the other armchair`.
        let is_longer = |found: &FoundMention| {
            let [from, to] = found.mention.bytes;
            from <= bytes[0] && to > bytes[1] && phrase != Phrase::Both
        };
        if ids.is_empty() || found.iter().any(is_longer) {
            continue;
        }
        if phrase == Phrase::One {
            let Some(group) = own.group else { continue };
            blanks.extend(leads(prompt, found, group, bytes[0]).then_some([group[0], bytes[0]]));
        }
        let mut ids = ids;
        if let (Phrase::Other, Some(first)) = (&phrase, own.last)
            && let Some(one) = led_from(prompt, places, found, first, &own.ids)
        {
            let named = found.iter_mut().filter(|found| found.mention.ids == [first]);
            named.for_each(|found| found.mention.ids = vec![one]);
            ids = own.ids.iter().copied().filter(|id| *id != one).collect();
        }
        if let [id] = ids[..] {
            (own.last, own.is_told) = (Some(id), true);
        }
        let mut members = ids;
        members.sort_unstable();
        replace_mentions(found, Mention { bytes, ids: members });
        at += len - 1;
    }
    let is_blank = |at: usize| blanks.iter().any(|[from, to]| (*from..*to).contains(&at));
    found.retain(|found| !is_blank(found.mention.bytes[0]));
    blanks
}

/// The one of two from which a slide or a pan to a side leads, where the words say `one` of it: `truck right from one cactus to the
/// other` begins at the left one.
fn led_from(prompt: &str, places: Places<'_>, found: &[FoundMention], first: u32, ids: &[u32]) -> Option<u32> {
    let mention = found.iter().find(|found| found.mention.ids == [first])?;
    let is_open = tokenize(said(prompt, &mention.mention)).first().is_some_and(|word| word.text == "one");
    let before = tokenize(prompt.get(..mention.mention.bytes[0])?);
    let side = before.iter().rev().take(9).find(|word| is_listed("left right", &word.text)).filter(|_| is_open)?;
    outermost(places, ids, if side.text == "right" { Flank::Left } else { Flank::Right })
}

/// Whether words are those of the gap between two things, or of two that something goes between.
fn is_gap(words: &[Word]) -> bool {
    let text = |at: usize| words.get(at).map_or("", |word| word.text.as_str());
    is_listed(GAPS, text(1)) || is_listed("how what", text(0))
}

/// The pair that is named last before a byte: by one mention, or by a mention of one of it.
fn pair_before(
    prompt: &str,
    objects: &[NamedObject],
    found: &[FoundMention],
    from: usize,
    known: Option<Pair>,
) -> Option<Pair> {
    let before = found.iter().rev().filter(|found| found.mention.bytes[1] <= from && !found.mention.ids.is_empty());
    for mention in before {
        let ids = &mention.mention.ids;
        if let Some(known) = known.as_ref().filter(|known| ids.iter().all(|id| known.ids.contains(id))) {
            let last = if let [id] = ids[..] { Some(id) } else { known.last };
            return Some(Pair { last, ids: known.ids.clone(), ..*known });
        }
        if is_number(said(prompt, &mention.mention)) {
            continue;
        }
        match ids[..] {
            [_, _] => {
                return Some(Pair { ids: ids.clone(), last: None, group: Some(mention.mention.bytes), is_told: false });
            }
            [id] => {
                let kind = kind_of(objects, prompt, mention);
                if kind.len() == 2 {
                    return Some(Pair { ids: kind, last: Some(id), group: None, is_told: true });
                }
            }
            _ => {}
        }
    }
    known
}

/// The only two whose labels end with the same noun, one of which is named last before a byte: `the floor lamp, the other one`.
fn told_apart(objects: &[NamedObject], found: &[FoundMention], from: usize) -> Option<Pair> {
    let last = found.iter().rev().find(|found| found.mention.bytes[1] <= from && !found.mention.ids.is_empty())?;
    let [id] = last.mention.ids[..] else { return None };
    let noun = head(label(objects, id)?)?;
    let ids: Vec<u32> =
        objects.iter().filter(|object| head(&object.label).as_ref() == Some(&noun)).map(|object| object.id).collect();
    (ids.len() == 2).then_some(Pair { ids, last: Some(id), group: None, is_told: true })
}

/// Whether the words between the mention of both and `one` only lead on to them.
fn leads(prompt: &str, found: &[FoundMention], group: [usize; 2], one: usize) -> bool {
    let between = tokenize(prompt.get(group[1]..one).unwrap_or_default());
    let is_mark = |word: &Word| matches!(word.text.as_str(), "." | "!" | "?" | ";");
    between.len() <= MOST_BETWEEN
        && !between.iter().any(is_mark)
        && !found.iter().any(|found| found.mention.bytes[0] >= group[1] && found.mention.bytes[1] <= one)
}

/// The phrase for one of two, or for both, that begins at a word, and the number of its words.
fn phrase_at(words: &[Word], at: usize) -> Option<(usize, Phrase)> {
    let text = |at: usize| words.get(at).map_or("", |word| word.text.as_str());
    let before = at.checked_sub(1).map_or("", text);
    let says = |phrase: &[&str]| phrase.iter().enumerate().all(|(nth, word)| text(at + nth) == *word);
    let ends = |at: usize| {
        !text(at).starts_with(char::is_alphabetic)
            || is_listed("then and at in on by from with over for so till until", text(at))
    };
    if text(at) == "one"
        && !is_listed("the this that which no any each every other second first left right front back", before)
    {
        let other = (at + 1..words.len().min(at + 6)).find(|next| text(*next) == "other")?;
        let leads = (at + 1..other).all(|next| is_listed(LEADS, text(next)));
        return (leads && ends(at + 1)).then_some((1, Phrase::One));
    }
    if let Some(phrase) = BOTH.iter().find(|phrase| says(phrase)) {
        let end = at + phrase.len();
        let is_pair =
            !is_listed(NO_PAIRS, text(end)) && (phrase.len() > 1 || !matches!(text(end), "the" | "of" | "my"));
        let is_noun = phrase[..] == ["the", "two"] && !ends(end);
        return (is_pair && !is_noun).then_some((phrase.len(), Phrase::Both));
    }
    if let Some(phrase) = APART.iter().find(|phrase| says(phrase)) {
        let verb = usize::from(phrase[0] == "how" && is_listed("are sit stand is lie", text(at + phrase.len())));
        return Some((phrase.len() + verb, Phrase::Both));
    }
    if text(at) != "the" {
        return None;
    }
    // `One after the other` is no second mention.
    if before == "after" && text(at + 1) == "other" {
        return None;
    }
    if is_listed(GAPS, text(at + 1)) && text(at + 2) == "between" {
        let len = if text(at + 3) == "the" { 5 } else { 4 };
        return is_listed("them the two both", text(at + 3)).then_some((len, Phrase::Both));
    }
    let has_one = text(at + 2) == "one";
    let len = 2 + usize::from(has_one);
    // `One on one side, one on the other` is about sides.
    let is_of_sides = is_listed("on at", before)
        && (at.saturating_sub(14)..at).any(|near| text(near) == "one" && is_listed("side end edge", text(near + 1)));
    if is_of_sides {
        return None;
    }
    if is_listed(SECONDS, text(at + 1)) && (has_one || text(at + 1) == "other" && ends(at + 2)) {
        return Some((len + place_len(words, at + len), Phrase::Other)).filter(|_| !is_side(words, at + len));
    }
    if has_one && (is_listed(FIRSTS, text(at + 1)) || is_listed(NEAR, text(at + 1))) {
        return Some((len, Phrase::First));
    }
    if has_one && is_listed(FAR, text(at + 1)) {
        return Some((len, Phrase::Other));
    }
    let hand = usize::from(text(at + 2) == "hand");
    if let Some(flank) = told_flank(words.get(at..at + 3 + hand)?).filter(|_| text(at + 2 + hand) == "one") {
        return Some((3 + hand, Phrase::Side(flank)));
    }
    // `The one at the back of the table`.
    let place = place_len(words, at + 2);
    if text(at + 1) == "one" && place > 0 {
        let inside = &words[at + 2..at + 2 + place];
        let says = |list: &str| inside.iter().any(|word| is_listed(list, &word.text));
        let phrase = match () {
            () if says("left") => Phrase::Side(Flank::Left),
            () if says("right") => Phrase::Side(Flank::Right),
            () if says(FAR) => Phrase::Other,
            () => Phrase::First,
        };
        return Some((2 + place, phrase));
    }
    None
}

/// Whether the words from one on are about a side of the frame: `the candles on the other side`.
fn is_side(words: &[Word], at: usize) -> bool {
    words.get(at).is_some_and(|word| is_listed("side end hand edge half third", &word.text))
}

/// The number of the words from one on that say where one of two is: `at the front of the table`.
fn place_len(words: &[Word], at: usize) -> usize {
    let text = |at: usize| words.get(at).map_or("", |word| word.text.as_str());
    if !(is_listed(AT, text(at)) && text(at + 1) == "the" && is_listed(WHERE, text(at + 2))) {
        return 0;
    }
    let rest =
        if text(at + 3) == "of" { (at + 3..words.len()).take_while(|at| is_listed(OF, text(*at))).count() } else { 0 };
    3 + rest
}

#[cfg(test)]
mod tests {
    use super::*;
    use cinesplat_objects::Object;
    use glam::DVec3;

    fn named(prompt: &str, mentions: &[(&str, &[u32])]) -> (Vec<Vec<u32>>, usize) {
        let at = |id, label: &str, x: f64| Object::from_box(id, label, DVec3::new(x, 0.0, -2.0), DVec3::splat(0.1));
        let objects = [
            at(1, "red teapot 1", -1.0),
            at(2, "red teapot 2", 1.0),
            at(3, "sofa", 0.0),
            at(4, "lamp 1", -1.5),
            at(5, "lamp 2", 0.0),
            at(6, "lamp 3", 2.0),
        ];
        let names: Vec<NamedObject> =
            objects.iter().map(|object| NamedObject { id: object.id, label: object.label.clone() }).collect();
        let mention = |(words, ids): &(&str, &[u32])| {
            let start = prompt.find(words).unwrap();
            let mention = Mention { bytes: [start, start + words.len()], ids: ids.to_vec() };
            FoundMention { mention, probability: 1.0, nearest: Vec::new() }
        };
        let mut found: Vec<FoundMention> = mentions.iter().map(mention).collect();
        let blanks = name_pairs(prompt, &names, Places { objects: &objects, up: DVec3::Y }, &mut found);
        (found.into_iter().map(|found| found.mention.ids).collect(), blanks.len())
    }

    #[test]
    fn one_and_the_other_are_two_mentions() {
        let show = "show the two teapots, one then the other, then the sofa";
        assert_eq!(
            named(show, &[("the two teapots", &[1, 2]), ("the sofa", &[3])]),
            (vec![vec![1], vec![2], vec![3]], 1)
        );
        let apart = "two teapots. look at one, look at the other, then show how far apart they sit";
        assert_eq!(named(apart, &[("two teapots", &[1, 2])]).0, [vec![1, 2], vec![1], vec![2], vec![1, 2]]);
        let table = "one teapot, then the other, then the sofa between the two";
        assert_eq!(named(table, &[("one teapot", &[1]), ("the sofa", &[3])]).0, [[1], [2], [3]]);
        let one = "show one teapot, then the other, and then the gap between them";
        assert_eq!(named(one, &[("one teapot", &[1])]).0, [vec![1], vec![2], vec![1, 2]]);
        let back = "the red teapots. open on the one at the front of the table, travel over to the second one at the back, then lift \
                    so both are seen";
        assert_eq!(named(back, &[("the red teapots", &[1, 2])]).0, [vec![1, 2], vec![1], vec![2], vec![1, 2]]);
        assert_eq!(named("pan from the left teapot to the right one", &[("the left teapot", &[1])]).0, [[1], [2]]);
    }

    #[test]
    fn a_slide_from_one_to_the_other_begins_at_the_side_that_it_leaves() {
        let led = |prompt: &str| named(prompt, &[("one teapot", &[1])]).0;
        assert_eq!(led("truck right from one teapot to the other"), [[1], [2]]);
        assert_eq!(led("truck left from one teapot to the other"), [[2], [1]]);
    }

    #[test]
    fn the_other_one_of_two_with_one_noun_is_told_by_it() {
        let objects = [(1, "left armchair"), (2, "right armchair"), (3, "sofa")]
            .map(|(id, label)| NamedObject { id, label: label.to_owned() });
        let prompt = "not the left armchair, the other one";
        let mention = Mention { bytes: [4, 21], ids: vec![1] };
        let mut found = vec![FoundMention { mention, probability: 1.0, nearest: Vec::new() }];
        name_pairs(prompt, &objects, Places { objects: &[], up: DVec3::Y }, &mut found);
        assert_eq!(found[1].mention.ids, [2]);
    }

    #[test]
    fn other_pairs_stay() {
        assert_eq!(named("the teapots on both sides", &[("the teapots", &[1, 2])]).0, [[1, 2]]);
        assert_eq!(named("show the teapots one after the other", &[("the teapots", &[1, 2])]).0, [[1, 2]]);
        assert_eq!(named("pan from the lamp to the other one", &[("the lamp", &[4])]).0, [[4]]);
        assert_eq!(named("from one end of the sofa to the other", &[("the sofa", &[3])]).0, [[3]]);
        assert_eq!(
            named("keep both the sofa and the teapot in view", &[("the sofa", &[3]), ("the teapot", &[1])]).0,
            [[3], [1]]
        );
    }
}

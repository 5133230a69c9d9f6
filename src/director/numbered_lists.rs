//! Several things of one kind that are told by their numbers: `plates 1 through 4`, `chairs 2, 3 and 5`.

use cinesplat_language::{NamedObject, Word, tokenize};

use crate::explained::{drop_mentions, insert_found, label, said};
use crate::names::FoundMention;

/// Words from the first number of a span to the last.
const TO: [&str; 6] = ["through", "thru", "to", "till", "\u{2013}", "-"];
/// Words between the numbers of a list.
const AND: [&str; 3] = [",", "and", "&"];
/// Most things of a list.
const MOST: usize = 12;

/// Extends the mention of the first thing of such a list to all of its things.
pub(crate) fn name_numbered(prompt: &str, objects: &[NamedObject], found: &mut Vec<FoundMention>) {
    let words = tokenize(prompt);
    for nth in (0..found.len()).rev() {
        let Some(listed) = found.get(nth).and_then(|first| list_at(prompt, &words, objects, first)) else { continue };
        drop_mentions(found, listed.mention.bytes);
        insert_found(found, listed);
    }
}

/// The list that begins with a mention of its first thing, as `orange plates 1` of `orange plates 1 through 4`.
fn list_at(prompt: &str, words: &[Word], objects: &[NamedObject], first: &FoundMention) -> Option<FoundMention> {
    let [id] = first.mention.ids[..] else { return None };
    let own = tokenize(said(prompt, &first.mention));
    let [.., noun, number] = &own[..] else { return None };
    let from: u32 = number.text.parse().ok()?;
    let is_plural = noun.is_alphabetic() && noun.text != noun.stem;
    let (kind, _) = label(objects, id)?.rsplit_once(' ').filter(|(_, last)| last.parse() == Ok(from))?;
    let numbered = |number: u32| objects.iter().find(|object| object.label == format!("{kind} {number}"));
    let mut at = words.iter().position(|word| word.span[0] >= first.mention.bytes[1]).filter(|_| is_plural)?;
    let number_at = |at: usize| words.get(at).and_then(|word| word.text.parse::<u32>().ok());
    let text = |at: usize| words.get(at).map_or("", |word| word.text.as_str());
    let (mut numbers, mut end) = (vec![from], None);
    let linked = at + usize::from(TO.contains(&text(at)));
    let is_span = linked > at || words.get(at).is_some_and(|word| word.after_hyphen);
    if let Some(last) = number_at(linked).filter(|last| is_span && *last > from && *last < from + MOST as u32) {
        (numbers, end) = ((from..=last).collect(), Some(linked));
    } else {
        loop {
            let next = at + (at..at + 2).take_while(|at| AND.contains(&text(*at))).count();
            // `Chairs 2, 3 metres away`: no number of a thing.
            let Some(number) = number_at(next).filter(|number| next > at && numbered(*number).is_some()) else { break };
            numbers.push(number);
            (at, end) = (next + 1, Some(next));
        }
    }
    let ids: Option<Vec<u32>> = numbers.into_iter().map(|number| Some(numbered(number)?.id)).collect();
    let mut listed = first.clone();
    (listed.mention.bytes[1], listed.mention.ids) = (words.get(end?)?.span[1], ids?);
    Some(listed)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::said::fixture::labelled;
    use cinesplat_language::Mention;

    #[test]
    fn numbers_of_a_list_name_things_of_one_kind() {
        let labels = ["orange plate 1", "orange plate 2", "orange plate 3", "orange plate 4", "chair 2"];
        let objects = labelled(&labels);
        let named = |prompt: &str, name: &str| {
            let start = prompt.find(name).unwrap();
            let mention = Mention { bytes: [start, start + name.len()], ids: vec![1] };
            let mut found = vec![FoundMention { mention, probability: 1.0, nearest: Vec::new() }];
            name_numbered(prompt, &objects, &mut found);
            let Mention { bytes: [from, to], ids } = &found[0].mention;
            (prompt[*from..*to].to_owned(), ids.clone())
        };
        let first = "orange plates 1";
        let all = ("orange plates 1 through 4".to_owned(), vec![1, 2, 3, 4]);
        assert_eq!(named("inspect orange plates 1 through 4 in sequence", first), all);
        let three = ("orange plates 1, 2 and 4".to_owned(), vec![1, 2, 4]);
        assert_eq!(named("inspect orange plates 1, 2 and 4", first), three);
        assert_eq!(named("show orange plates 1-3", first), ("orange plates 1-3".to_owned(), vec![1, 2, 3]));
        assert_eq!(named("show orange plates 1, 9 metres away", first).1, [1]);
        assert_eq!(named("go from orange plate 1 to 4 metres", "orange plate 1").1, [1]);
    }
}

//! Things that are named by what people do with them: `the thing you brew tea in`, `something to sit on`, `the gadget for
//! heating up food`.

use cinesplat_language::{Mention, NamedObject, Relation, Things, VerbForm, Word, inflect, is_listed, stem, tokenize};

use crate::explained::replace_mentions;
use crate::names::FoundMention;

/// What people do with things, and the kinds of things, the likeliest first.
const USES: [(&str, &str); 46] = [
    ("brew tea", "teapot, kettle"),
    ("make tea", "teapot, kettle"),
    ("pour tea", "teapot"),
    ("serve tea", "teapot"),
    ("brew coffee", "coffee machine, coffee maker"),
    ("make coffee", "coffee machine, coffee maker"),
    ("boil water", "kettle, teapot, pot"),
    ("boil", "kettle, teapot, pot"),
    ("reheat", "microwave, oven"),
    ("heat up", "microwave, oven, stove"),
    ("warm up", "microwave, oven, radiator"),
    ("heat food", "microwave, oven, stove"),
    ("cook", "stove, cooker, oven, hob, pot"),
    ("bake", "oven"),
    ("fry", "frying pan, stove"),
    ("toast bread", "toaster"),
    ("keep food cold", "fridge"),
    ("keep cold", "fridge"),
    ("chop", "knife, cutting board"),
    ("cut", "knife, knife rack, scissors"),
    ("ladle", "ladle"),
    ("scoop", "ladle, spoon"),
    ("drink from", "mug, cup, glass"),
    ("drink out", "mug, cup, glass"),
    ("drink", "mug, cup, glass"),
    ("eat off", "plate"),
    ("eat from", "plate, bowl"),
    ("sit", "armchair, chair, sofa, stool, bench"),
    ("sleep", "bed, sofa"),
    ("lie", "bed, sofa"),
    ("watch", "television"),
    ("strum", "guitar"),
    ("play chords", "guitar, piano"),
    ("play tunes", "guitar, piano"),
    ("see yourself", "mirror"),
    ("look at yourself", "mirror"),
    ("water plants", "watering can"),
    ("put flowers", "vase"),
    ("keep flowers", "vase"),
    ("read the time", "clock"),
    ("tell the time", "clock"),
    ("wash up", "sink"),
    ("wash hands", "sink, washbasin"),
    ("draw shut", "curtain"),
    ("put clothes", "wardrobe, chest of drawers"),
    ("keep clothes", "wardrobe, chest of drawers"),
];
/// What such things are called.
const NOUNS: &str = "thing things thingy thingamajig object gadget machine appliance device contraption furniture something vessel \
    container instrument utensil tool";
const WHICH: &str = "that which where what";
const PEOPLE: &str = "you we i one people they he she everyone everybody folks somebody someone";
/// Words inside the words of a use, and behind them.
const FILLERS: &str = "the a an your my our some his her their usually always can could would might";
const BEHIND: &str = "in on with at from out off of into";
const DETERMINERS: &str = "the that this a an some my our your";

/// Names things by what people do with them, where one kind of thing in the scene is for that.
pub(crate) fn name_by_uses(prompt: &str, objects: &[NamedObject], found: &mut Vec<FoundMention>) {
    let words = tokenize(prompt);
    for noun in (0..words.len()).filter(|at| is_listed(NOUNS, &words[*at].text)) {
        let Some((end, kinds)) = use_behind(&words, noun + 1) else { continue };
        let Some(id) = kinds.split(", ").find_map(|kind| only_of_kind(objects, kind)) else { continue };
        let is_before = |at: &usize| is_listed(DETERMINERS, &words[*at].text);
        let first = noun.checked_sub(1).filter(is_before).unwrap_or(noun);
        let bytes = [words[first].span[0], words[end - 1].span[1]];
        replace_mentions(found, Mention { bytes, ids: vec![id] });
    }
}

/// The use that the words from word `at` on tell: the word behind it, and the kinds of things for it.
fn use_behind(words: &[Word], at: usize) -> Option<(usize, &'static str)> {
    let text = |at: usize| words.get(at).map_or("", |word| word.text.as_str());
    let which = at + usize::from(is_listed(WHICH, text(at)));
    let (start, form) = match text(which) {
        "for" => (which + 1, VerbForm::Gerund),
        "to" => (which + 1, VerbForm::Base),
        "used" if text(which + 1) == "for" => (which + 2, VerbForm::Gerund),
        "used" if text(which + 1) == "to" => (which + 2, VerbForm::Base),
        person if is_listed(PEOPLE, person) => (which + 1, VerbForm::Base),
        _ => return None,
    };
    let mut fitting: Vec<(usize, &str)> =
        USES.iter().filter_map(|(phrase, kinds)| Some((end_of_use(words, start, phrase, form)?, *kinds))).collect();
    // `Keep flowers in` before `keep`.
    fitting.sort_by_key(|(end, _)| std::cmp::Reverse(*end));
    let (end, kinds) = *fitting.first()?;
    let behind = usize::from(is_listed(BEHIND, text(end)));
    let of = usize::from(behind == 1 && text(end + 1) == "of");
    Some((end + behind + of, kinds))
}

/// The word behind a use that begins at word `start`.
fn end_of_use(words: &[Word], start: usize, phrase: &str, form: VerbForm) -> Option<usize> {
    let mut at = start;
    for (nth, said) in phrase.split(' ').enumerate() {
        let is_filler =
            |at: usize| words.get(at).is_some_and(|word| is_listed(FILLERS, &word.text) && word.text != said);
        at += (at..at + 3).take_while(|at| is_filler(*at)).count();
        let word = words.get(at)?;
        let is_said = if nth == 0 { word.text == inflect(said, form) } else { word.stem == stem(said) };
        if !is_said {
            return None;
        }
        at += 1;
    }
    Some(at)
}

/// The one object of a kind.
fn only_of_kind(objects: &[NamedObject], kind: &str) -> Option<u32> {
    let things = Things::embedded();
    let wanted: Vec<String> = tokenize(kind).into_iter().map(|word| word.stem).collect();
    let is_of_kind = |object: &&NamedObject| {
        let stems: Vec<String> = tokenize(&object.label).into_iter().map(|word| word.stem).collect();
        let is_named = stems.windows(wanted.len()).any(|own| own == wanted);
        is_named || things.is_related(&object.label, &wanted.join(" "), &[Relation::Same])
    };
    let mut of_kind = objects.iter().filter(is_of_kind);
    let first = of_kind.next()?;
    of_kind.next().is_none().then_some(first.id)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::said::fixture::labelled;

    #[test]
    fn a_thing_is_named_by_what_people_do_with_it() {
        let objects = labelled(&["red teapot", "white armchair", "knife rack", "microwave", "teal base cabinet"]);
        let named = |prompt: &str| {
            let mut found = Vec::new();
            name_by_uses(prompt, &objects, &mut found);
            found
                .first()
                .map(|found| (prompt[found.mention.bytes[0]..found.mention.bytes[1]].to_owned(), found.mention.ids[0]))
        };
        let is = |words: &str, id: u32| Some((words.to_owned(), id));
        assert_eq!(named("see the thing you brew tea in from far off"), is("the thing you brew tea in", 1));
        assert_eq!(named("the thing that you sit on"), is("the thing that you sit on", 2));
        assert_eq!(named("pan to the gadget for warming up your soup"), is("the gadget for warming up", 4));
        assert_eq!(named("something to sit on, please"), is("something to sit on", 2));
        assert_eq!(named("the thing you see on the left"), None);
    }
}

//! Sentences that tell a story or name the film, beside others that ask for it: `It's my nan's room the way she had it. Could you show
//! the two chairs?`, `Hero film for the red teapots. Open on ..`.
//!
//! The network makes moves of them, and reads the rest worse.

use cinesplat_language::{Linked, is_listed};

use crate::said::directs;

/// Marks that end a sentence.
const MARKS: &str = ". ! ? :";
/// Fewest words of a story.
const FEWEST_WORDS: usize = 7;
/// Time that belongs to a story.
const LEAST_STORY_SECS: f64 = 120.0;
/// Most words of a title.
const MOST_TITLE_WORDS: usize = 12;
/// Words of what is told.
const TELLS: &str = "was were had used always fought loved bought found lost got made turned became is 's are 're think like hate love \
    thinks says said means believe feel feels called named";
/// Whom a story is about.
const PERSONS: &str = "my our we i she he they her his their nan gran grandma mum mom dad mother father wife husband daughter son \
    brother sister aunt uncle friend hand who whom someone everyone client clients they guest guests visitors family kids children people";
/// Words by which a sentence asks for something, or says what is seen when.
const ASKS: &str = "show shows see sees look looking watch could can would should must please want wants need needs give let first \
    then last end ends ending start starts begin begins finish until till wish take takes notice notices make makes frame shot \
    camera";
/// Words between `so` and what is asked for, and verbs in which it is asked.
const PLEAS: &str = "please just maybe , can could would you we i let 's pls";
const COMMANDS: &str = "start begin open push pull pan tilt zoom dolly truck track crane pedestal orbit circle arc go move come rise \
    sink lower raise drop slide glide drift creep fly travel hold stay keep give show frame get take put stand walk lift spin swing turn look";
/// Verbs of who tells how things are, and words of who says what is seen.
const STATES: &str =
    "is 's are 're was were has have need needs want wants love loves like likes care cares means sells";
const SHOWS: &str =
    "show shows see sees look looking watch then until till while start begin end finish first last frame shot camera";
/// Verbs of what somebody did, which ask for nothing.
const DEEDS: &str = "scanned sells sell loves love hates hate bought built painted restored inherited moved rents selling made borrowed";
const PRONOUNS: &str = "it them him her its their they this that there here";
/// What a film is called in its title.
const FILMS: &str = "film video clip reel ad advert advertisement trailer teaser spot short promo opener header campaign commercial catalogue \
    catalog brochure listing";
const ABOUT: &str = "for of about on";

/// The words without the sentences that only tell something, where others ask for the film; `None` where there are none.
pub(crate) fn without_told(linked: &Linked) -> Option<Linked> {
    if linked.timeline.is_some() {
        return None;
    }
    let words: Vec<(&str, [usize; 2])> = linked.words_in([0, usize::MAX]).collect();
    let sentences: Vec<&[(&str, [usize; 2])]> =
        words.split_inclusive(|(word, _)| is_listed(MARKS, word)).flat_map(parts_at_so).collect();
    let is_told = |nth: usize| {
        let words = texts(sentences[nth]);
        let is_reason =
            || sentences.get(nth + 1).map(|next| texts(next)).is_some_and(|next| gives_reason(linked, &words, &next));
        let is_whole = nth + 1 == sentences.len() || words.last().is_some_and(|word| is_listed(MARKS, word));
        let is_told = is_whole && is_story(&words) || nth == 0 && is_title(&words) || is_reason();
        !has_numbers(linked, &words) && is_told
    };
    let told: Vec<usize> = (0..sentences.len()).filter(|nth| is_told(*nth)).collect();
    let left = || (0..sentences.len()).filter(|nth| !told.contains(nth)).map(|nth| texts(sentences[nth]));
    let names = left().any(|words| words.iter().any(|word| linked.slot_at(word).is_some()));
    if told.is_empty() || !names || !left().any(|words| asks(&words)) {
        return None;
    }
    let bytes = told.iter().filter_map(|nth| {
        let (first, last) = (sentences[*nth].first()?, sentences[*nth].last()?);
        Some([first.1[0], last.1[1]])
    });
    Some(linked.without(&bytes.collect::<Vec<_>>(), None))
}

/// A sentence in two, where it says why and then what to do: `it's the handles I need to study, so come down to ..`.
fn parts_at_so<'a>(sentence: &'a [(&'a str, [usize; 2])]) -> impl Iterator<Item = &'a [(&'a str, [usize; 2])]> {
    let words = texts(sentence);
    let asks = |at: usize| {
        let verb = (at + 1..words.len()).find(|at| !is_listed(PLEAS, words[*at])).unwrap_or(words.len());
        words.get(verb).is_some_and(|word| is_listed(COMMANDS, word))
    };
    // `My mate scanned this kitchen and there's a guitar in it, spin round the guitar`.
    let tells = |at: usize| {
        words[at] == ","
            && words[..at].iter().any(|word| is_listed(DEEDS, word))
            && words[..at].iter().any(|word| is_listed(PERSONS, word))
    };
    let so = (1..words.len()).find(|at| (words[*at] == "so" || tells(*at)) && asks(*at)).unwrap_or(0);
    [&sentence[..so], &sentence[so..]].into_iter().filter(|part| !part.is_empty())
}

/// Whether words only say why somebody asks for what the next ones say, which name their things themselves.
fn gives_reason(linked: &Linked, words: &[&str], next: &[&str]) -> bool {
    let is_thing = |word: &&str| linked.slot_at(word).is_some();
    let first = next.iter().position(|word| is_thing(word) || is_listed(PRONOUNS, word));
    let is_named = !words.iter().any(&is_thing) || first.is_some_and(|at| is_thing(&next[at]));
    let has = |list: &str| words.iter().any(|word| is_listed(list, word));
    matches!(next.first(), Some(&("so" | ",")))
        && words.len() >= FEWEST_WORDS
        && is_named
        && has(STATES)
        && !has(SHOWS)
        && !directs(&without_rooms(words))
}

/// The words of a sentence.
fn texts<'a>(sentence: &[(&'a str, [usize; 2])]) -> Vec<&'a str> {
    sentence.iter().map(|(word, _)| *word).collect()
}

/// Whether some words are quantities.
fn has_numbers(linked: &Linked, words: &[&str]) -> bool {
    // `The guests are ten minutes away`: no film takes minutes.
    let is_story = |word: &str| linked.secs_at(word).is_some_and(|secs| secs >= LEAST_STORY_SECS);
    words.iter().any(|word| linked.is_quantity(word) && !is_story(word))
}

/// Whether words ask for something that a camera does.
fn asks(words: &[&str]) -> bool {
    directs(&without_rooms(words)) || words.iter().any(|word| is_listed("show shows look", word))
}

/// The words without those of rooms that are words of pictures, too: `the front room`.
fn without_rooms<'a>(words: &[&'a str]) -> Vec<&'a str> {
    let is_room = |at: usize| is_listed("front back", words[at]) && words.get(at + 1) == Some(&"room");
    let is_aside = |at: usize| is_listed("middle left right away still around", words[at]);
    (0..words.len()).filter(|at| !is_room(*at) && !is_aside(*at)).map(|at| words[at]).collect()
}

/// Whether a sentence only tells something about people.
fn is_story(words: &[&str]) -> bool {
    let has = |list: &str| words.iter().any(|word| is_listed(list, word));
    words.len() >= FEWEST_WORDS && has(TELLS) && has(PERSONS) && !has(ASKS) && !directs(&without_rooms(words))
}

/// Whether a sentence only names the film.
fn is_title(words: &[&str]) -> bool {
    let film = words.iter().position(|word| is_listed(FILMS, word));
    let is_about = |at: usize| words[at + 1..].iter().take(2).any(|word| is_listed(ABOUT, word));
    words.len() <= MOST_TITLE_WORDS && film.is_some_and(is_about) && !directs(&without_rooms(words))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::said::fixture::linked;

    fn left(text: &str) -> Option<String> {
        without_told(&linked(text)).map(|linked| linked.tokens_text)
    }

    #[test]
    fn a_story_beside_a_wish_is_left_out() {
        let story = "it 's my nan 's front room the way she used to have it . could you show <obj-0> and <obj-1> ?";
        assert_eq!(left(story).as_deref(), Some("could you show <obj-0> and <obj-1> ?"));
        let title = "hero film for <obj-0> . open on <obj-1> , then rise .";
        assert_eq!(left(title).as_deref(), Some("open on <obj-0> , then rise ."));
    }

    #[test]
    fn a_reason_before_what_is_asked_is_left_out() {
        let why = "we 're restoring <obj-0> and it 's the handles i need to study , so come down to <obj-0> .";
        assert_eq!(left(why).as_deref(), Some("so come down to <obj-0> ."));
        assert_eq!(left("we 're restoring <obj-0> and it 's the handles i like , so push in on it ."), None);
        assert_eq!(left("we 're behind <obj-0> and it is in front , so it hides <obj-1> . push in on <obj-1>"), None);
    }

    #[test]
    fn what_says_something_of_the_film_stays() {
        assert_eq!(left("we 're behind <obj-0> . push in on <obj-1> ."), None);
        assert_eq!(left("my brother is on <obj-0> and he likes it . it is his own chair ."), None);
        assert_eq!(left("my daughter found <obj-0> and we see it first . push in on <obj-1> ."), None);
    }
}

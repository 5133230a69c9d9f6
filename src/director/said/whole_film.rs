//! What the words say of the whole film, wherever they say it: `don't show the cooler`, `keep it slow`, `the cube, the sphere
//! and the cylinder, each in a close-up`.

use cinesplat_language::Linked;
use cinesplat_operator::{Framing, Program, Speed, Step};
use cinesplat_trajectory::Move;

use super::bans::SENTENCE_ENDS;
use super::directions::says_any;

/// Words that limit a ban to a moment.
const MOMENTS: [&str; 11] =
    ["first", "yet", "until", "till", "start", "beginning", "opening", "end", "last", "then", "before"];
/// Words that make a ban one of the whole film, wherever it stands.
const EVER: [&str; 8] = ["ever", "never", "anywhere", "throughout", "whole", "always", "point", "anytime"];
/// Words of a thing that is seen in part: `the forge must not be cut off`.
const CUT_OFF: [&str; 7] = ["cropped", "crop", "clipped", "truncated", "chopped", "off", "cut"];

/// Keeps in view what the words only rule out to be cut off.
pub(crate) fn keep_uncut(linked: &Linked, steps: &mut [Step]) {
    for step in steps {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let is_uncut = |id: &u32| {
            let Some(at) = words.iter().rposition(|word| linked.names(word, *id)) else { return false };
            let behind = || words[at + 1..].iter().take_while(|word| !SENTENCE_ENDS.contains(word)).take(10);
            behind().any(|word| CUT_OFF.contains(word)) && behind().any(|word| matches!(*word, "not" | "never" | "'t"))
        };
        let (uncut, avoid): (Vec<u32>, Vec<u32>) = step.avoid.iter().partition(|id| is_uncut(id));
        step.avoid = avoid;
        step.keep.extend(uncut);
    }
}

/// Words by which a thing that is not to be lost stays in view.
const LOSSES: [&str; 9] = ["lose", "losing", "loses", "leave", "leaving", "leaves", "out", "drop", "dropping"];

/// Settles what a step both keeps in view and never shows: `never losing the lathe` keeps it.
pub(crate) fn keep_or_avoid(linked: &Linked, steps: &mut [Step]) {
    for step in steps {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let keeps = words.iter().any(|word| LOSSES.contains(word));
        let both: Vec<u32> = step.keep.iter().filter(|id| step.avoid.contains(id)).copied().collect();
        let list = if keeps { &mut step.avoid } else { &mut step.keep };
        list.retain(|id| !both.contains(id));
    }
}

/// Never shows in any step what a sentence of its own rules out.
pub(crate) fn avoid_throughout(linked: &Linked, program: &mut Program) {
    let mut banned: Vec<u32> = program.steps.iter().flat_map(|step| step.avoid.clone()).collect();
    banned.retain(|id| is_banned_throughout(linked, *id));
    banned.extend(linked.expanded(&never_shown(linked)));
    for step in &mut program.steps {
        let passed = step.via.iter().flat_map(|via| &via.objects);
        let shown: Vec<u32> = step.start.subjects.iter().chain(&step.end.subjects).chain(passed).copied().collect();
        for id in &banned {
            if !shown.contains(id) && !step.avoid.contains(id) {
                step.avoid.push(*id);
            }
        }
    }
}

/// The things of `never show the palm`, which the network leaves out behind other clauses.
fn never_shown(linked: &Linked) -> Vec<u32> {
    let words: Vec<&str> = linked.tokens_text.split(' ').collect();
    let named = words.windows(3).filter(|three| three[..2] == ["never", "show"]).map(|three| three[2]);
    let outside = (0..words.len()).filter_map(|at| kept_out_at(&words[at..]));
    named.chain(outside).filter_map(|word| linked.slot_at(word)).filter(|id| linked.missing(*id).is_none()).collect()
}

/// The thing of words that begin with `keep the television out of it`.
fn kept_out_at<'a>(words: &[&'a str]) -> Option<&'a str> {
    let keeps = matches!(words.first(), Some(&("keep" | "leave" | "keeping" | "leaving")));
    let thing = 1 + usize::from(matches!(words.get(1), Some(&("the" | "that"))));
    let out = words.get(thing + 1..thing + 3)? == ["out", "of"];
    let place = words[thing + 3..].iter().find(|word| **word != "the")?;
    (keeps && out && (*place == "it" || VIEWS.contains(place))).then(|| words[thing])
}

/// Words of a sentence that keeps a thing in view, and of what it is kept in.
const HOLDS: [&str; 6] = ["keep", "keeping", "have", "hold", "stays", "stay"];
const VIEWS: [&str; 8] = ["view", "frame", "shot", "sight", "picture", "screen", "visible", "image"];
const DENIED: [&str; 8] = ["out", "not", "never", "no", "'t", "off", "without", "away"];

/// Keeps in view, in every step that does not show it, what a sentence of its own keeps there throughout: `keep the car in view
/// all the time`.
pub(crate) fn keep_throughout(linked: &Linked, program: &mut Program) {
    let words: Vec<&str> = linked.tokens_text.split(' ').collect();
    for sentence in words.split(|word| SENTENCE_ENDS.contains(word)) {
        let has = |list: &[&str]| sentence.iter().any(|word| list.contains(word));
        let always = has(&EVER)
            || sentence
                .windows(3)
                .any(|three| matches!(three, ["all", "the", "time" | "way"] | ["at", "all", "times"]));
        let named: Vec<u32> = sentence.iter().filter_map(|word| linked.slot_at(word)).collect();
        let opens = sentence.iter().take(3).any(|word| HOLDS.contains(word) || linked.slot_at(word).is_some());
        if !(opens && has(&HOLDS) && has(&VIEWS) && always && !has(&DENIED)) || named.len() != 1 {
            continue;
        }
        for id in linked.expanded(&named) {
            for step in
                program.steps.iter_mut().filter(|step| !step.end.subjects.contains(&id) && !step.avoid.contains(&id))
            {
                if !step.keep.contains(&id) && !step.start.subjects.contains(&id) {
                    step.keep.push(id);
                }
            }
        }
    }
}

/// Keeps in view what the words say never to lose: `don't lose the stones before the end`.
pub(crate) fn never_lose(linked: &Linked, program: &mut Program) {
    let words: Vec<&str> = linked.tokens_text.split(' ').collect();
    for id in (0..words.len()).filter_map(|at| linked.slot_at(never_lost_at(&words, at)?)) {
        for id in linked.expanded(&[id]) {
            for step in &mut program.steps {
                let is_shown = step.end.subjects.contains(&id) || step.keep.contains(&id) || step.avoid.contains(&id);
                if !is_shown && linked.missing(id).is_none() {
                    step.keep.push(id);
                }
            }
        }
    }
}

/// The thing of `don't lose sight of the stones` where `lose` is word `at` and begins no sentence.
fn never_lost_at<'a>(words: &[&'a str], at: usize) -> Option<&'a str> {
    let denied = ["never", "not", "'t", "n't", "dont", "without"];
    let is_lost = matches!(words[at], "lose" | "losing") && at > 0 && denied.contains(&words[at - 1]);
    let thing = words.get(at + 1..)?.iter().find(|word| !matches!(**word, "sight" | "of" | "the"))?;
    is_lost.then_some(*thing)
}

/// Whether a sentence that names nothing before this thing rules it out, or one that says so of the whole film.
fn is_banned_throughout(linked: &Linked, id: u32) -> bool {
    let words: Vec<&str> = linked.tokens_text.split(' ').collect();
    let Some(at) = words.iter().rposition(|word| linked.names(word, id)) else { return false };
    let from = (0..at).rev().find(|at| SENTENCE_ENDS.contains(&words[*at])).map_or(0, |end| end + 1);
    let to = (at..words.len()).find(|at| SENTENCE_ENDS.contains(&words[*at])).unwrap_or(words.len());
    let has = |list: &[&str]| words[from..to].iter().any(|word| list.contains(word));
    let is_first = words[from..at].iter().all(|word| linked.slot_at(word).is_none());
    !has(&MOMENTS) && (is_first || has(&EVER))
}

/// What is kept slow or fast: `keep it slow`, `take everything gently`.
const KEEPS: [&str; 8] = ["keep", "keeping", "make", "take", "do", "move", "all", "everything"];
const KEPT: [&str; 24] = [
    "it",
    "this",
    "that",
    "things",
    "everything",
    "all",
    "them",
    "the",
    "whole",
    "thing",
    "movement",
    "movements",
    "camera",
    "nice",
    "and",
    "really",
    "very",
    "nicely",
    "pretty",
    "moves",
    "pace",
    "move",
    "of",
    "so",
];
const SLOW: [&str; 10] =
    ["slow", "slowly", "gentle", "gently", "calm", "calmly", "unhurried", "leisurely", "relaxed", "sedate"];
const FAST: [&str; 7] = ["fast", "quick", "quickly", "snappy", "brisk", "briskly", "energetic"];

/// Gives all steps without a speed the one that a sentence says of the film.
pub(crate) fn take_pace(linked: &Linked, steps: &mut [Step]) {
    let words: Vec<&str> = linked.tokens_text.split(' ').collect();
    let Some(speed) = pace(&words).or_else(|| crawls(&words).then_some(Speed::Slow)) else { return };
    for step in steps.iter_mut().filter(|step| step.speed == Speed::Normal && step.movement != Move::Static) {
        step.speed = speed;
    }
}

/// Phrases that make all slow, alone in a clause or behind `all of it`, `everything`.
const CRAWLS: [&[&str]; 6] = [
    &["at", "a", "crawl"],
    &["at", "a", "snail", "'s", "pace"],
    &["in", "slow", "motion"],
    &["at", "walking", "pace"],
    &["dead", "slow"],
    &["super", "slow"],
];

/// Whether a sentence says of all that it is slow: `all of it at a crawl`.
fn crawls(words: &[&str]) -> bool {
    words.split(|word| SENTENCE_ENDS.contains(word)).any(|sentence| {
        let is_of_all = matches!(sentence.first(), Some(&("all" | "everything" | "whole")))
            || sentence
                .windows(2)
                .any(|pair| matches!(pair, ["whole", "thing" | "film" | "way" | "time"] | ["all", "of"]));
        is_of_all && says_any(sentence, &CRAWLS)
    })
}

/// The speed that a sentence says of all: it begins with `keep it slow` or `all slow`.
fn pace(words: &[&str]) -> Option<Speed> {
    let begins = |at: &usize| *at == 0 || SENTENCE_ENDS.contains(&words[*at - 1]);
    let speeds = (0..words.len()).filter(|at| begins(at) && KEEPS.contains(&words[*at])).filter_map(|at| {
        let num_links = words[at + 1..].iter().take(6).take_while(|word| KEPT.contains(word)).count();
        // `Make slow circles` is about circles.
        let is_of_all = num_links > 0 || matches!(words[at], "all" | "everything");
        let word = words.get(at + 1 + num_links).filter(|_| is_of_all)?;
        let is_slow = SLOW.contains(word).then_some(Speed::Slow);
        is_slow.or_else(|| FAST.contains(word).then_some(Speed::Fast))
    });
    let speeds: Vec<Speed> = speeds.collect();
    speeds.first().copied().filter(|first| speeds.iter().all(|speed| speed == first))
}

/// Words that say that something holds for each thing of a list.
const EACH: [&str; 4] = ["each", "every", "all", "them"];
/// Words of how large things are in the frame.
const SIZES: [&str; 16] = [
    "close",
    "closeup",
    "close-up",
    "closeups",
    "close-ups",
    "medium",
    "wide",
    "tight",
    "cu",
    "mcu",
    "ms",
    "ws",
    "ecu",
    "mws",
    "framing",
    "framed",
];

/// Shows each thing that is visited as large as the words say of all, where one step alone has the size.
pub(crate) fn size_each(linked: &Linked, steps: &mut [Step]) {
    let words: Vec<&str> = linked.tokens_text.split(' ').collect();
    let goes_on = |word: &&&str| !SENTENCE_ENDS.contains(*word);
    let says = |at: usize| {
        let behind = words[at + 1..].iter().take_while(goes_on).take(6);
        let mut near = behind.chain(words[..at].iter().rev().take_while(goes_on).take(4));
        EACH.contains(&words[at]) && near.any(|word| SIZES.contains(word))
    };
    let shows = |step: &Step| {
        matches!(step.movement, Move::Follow | Move::Static) && !step.end.subjects.is_empty() && !step.returns
    };
    let mut sizes: Vec<_> = steps.iter().filter_map(|step| step.end.size).collect();
    sizes.dedup();
    let num_shown = steps.iter().filter(|step| shows(step)).count();
    let ([size], true) = (&sizes[..], num_shown > 1 && (0..words.len()).any(says)) else { return };
    let take = |framing: &mut Framing| {
        if !framing.subjects.is_empty() {
            framing.size = framing.size.or(Some(*size));
        }
    };
    for step in steps.iter_mut().filter(|step| shows(step)) {
        take(&mut step.start);
        take(&mut step.end);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sentences_keep_things_in_and_out() {
        let out = |text: &str| kept_out_at(&text.split(' ').collect::<Vec<_>>()).map(str::to_owned);
        assert_eq!(out("keep the <obj-0> out of it , please").as_deref(), Some("<obj-0>"));
        assert_eq!(out("keep <obj-0> out of the shot").as_deref(), Some("<obj-0>"));
        assert_eq!(out("keep <obj-0> out of the box"), None);
        let lost = |text: &str, at| never_lost_at(&text.split(' ').collect::<Vec<_>>(), at).map(str::to_owned);
        assert_eq!(lost("don 't lose the <obj-0> before the end", 2).as_deref(), Some("<obj-0>"));
        assert_eq!(lost("we lose <obj-0>", 1), None);
    }

    #[test]
    fn a_sentence_says_the_pace_of_the_film() {
        let said = |text: &str| pace(&text.split(' ').collect::<Vec<_>>());
        assert_eq!(said("down to <obj-0> . keep it slow so that i can read it"), Some(Speed::Slow));
        assert_eq!(said("all of it slow . push in"), Some(Speed::Slow));
        assert_eq!(said("keep everything quick . push in , then keep it slow"), Some(Speed::Fast));
        assert_eq!(said("push in , keep it slow"), None);
        assert_eq!(said("make slow circles around <obj-0>"), None);
        assert_eq!(said("keep it steady"), None);
    }
}

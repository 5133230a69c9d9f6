//! Things that the words put into one picture: `the chair, the lamp and the door`, `both of them in frame`.
//!
//! The network sometimes keeps one thing of several. Where the words join a thing that no step uses to one that a
//! framing shows, the framing shows both. What is to be seen all the time stays in view.

use std::collections::BTreeSet;

use cinesplat_language::{Linked, add_ids};
use cinesplat_operator::{Framing, Program, Step};

/// Words that join things, besides commas.
const JOINTS: [&str; 5] = ["and", "&", "+", "plus", "n"];
/// Words that may stand between things that are joined.
const BETWEEN: [&str; 7] = ["the", "a", "an", "also", "both", "that", "my"];
/// Words after `both` that are parts or ways, not things: `both sides`.
const PARTS: [&str; 14] = [
    "side",
    "sides",
    "end",
    "ends",
    "hand",
    "hands",
    "way",
    "ways",
    "edge",
    "edges",
    "times",
    "directions",
    "axes",
    "cases",
];
/// Words near `both` that say where both are to be seen.
const SEEN: [&str; 10] = ["frame", "shot", "view", "picture", "visible", "screen", "seen", "fully", "image", "shown"];

/// Words that say that things are seen, and words that say that they always are.
const VISIBLE: [&str; 9] = ["visible", "frame", "shot", "view", "seen", "screen", "picture", "image", "sight"];
const ALWAYS: [&str; 7] = ["whole", "entire", "throughout", "always", "all", "every", "constantly"];
const WHILES: [&str; 8] = ["time", "times", "way", "throughout", "always", "while", "move", "film"];
/// Words that turn it around: `never visible`, `out of view`.
const DENIALS: [&str; 9] = ["no", "not", "never", "'t", "longer", "out", "gone", "without", "lose"];
/// Words that deny, and words that turn the sight of something around.
const NEGATIONS: [&str; 6] = ["no", "not", "never", "'t", "without", "nor"];
const LEAVINGS: [&str; 12] =
    ["leave", "leaves", "leaving", "drop", "drops", "exit", "exits", "lose", "loses", "out", "gone", "longer"];
/// What ends the words about joined things.
const CLAUSE_ENDS: [&str; 3] = [".", ";", "!"];
/// Words after joined things that may say so.
const NUM_AFTER: usize = 12;

/// Keeps things in view that the words join and that are to be seen all the time: `the chair, the tv and the vase must
/// all be visible the whole time while you rise`.
pub(crate) fn keep_always(linked: &Linked, steps: &mut [Step]) {
    for things in joined_things(linked) {
        let Some((first, last)) = things.first().zip(things.last()) else { continue };
        let words = linked.words_in([last.1[1], usize::MAX]).map(|(word, _)| word);
        let after: Vec<&str> = words.take_while(|word| !CLAUSE_ENDS.contains(word)).take(NUM_AFTER).collect();
        let has = |list: &[&str]| after.iter().any(|word| list.contains(word));
        // `Never visible` and `out of view` deny it, `never leave the frame` does not.
        let says =
            |list: &[&str]| after.iter().take_while(|word| !VISIBLE.contains(word)).any(|word| list.contains(word));
        let is_denied = says(&NEGATIONS) != says(&LEAVINGS);
        if is_denied || !(has(&VISIBLE) && has(&ALWAYS) && has(&WHILES)) {
            continue;
        }
        let ids: Vec<u32> = things.iter().map(|(id, _)| *id).collect();
        let about = |step: &&mut Step| step.words.is_some_and(|[from, to]| (from..to).contains(&first.1[0]));
        for step in steps.iter_mut().filter(about) {
            for framing in [&mut step.start, &mut step.end] {
                if framing.subjects.iter().any(|id| ids.contains(id)) {
                    framing.subjects.clone_from(&ids);
                    framing.whole = true;
                }
            }
            add_ids(&mut step.keep, &ids);
        }
    }
}

/// Adds things that no step uses to the framings that show what the words join them to.
pub(crate) fn complete_lists(linked: &Linked, program: &mut Program) {
    let used: BTreeSet<u32> = linked.expanded(&program.object_ids()).into_iter().collect();
    let is_lost = |id: u32| linked.missing(id).is_none() && linked.expanded(&[id]).iter().all(|id| !used.contains(id));
    for things in joined_things(linked) {
        let lost: Vec<u32> = things.iter().map(|(id, _)| *id).filter(|id| is_lost(*id)).collect();
        let Some((first, last)) = things.first().zip(things.last()).filter(|_| !lost.is_empty()) else { continue };
        let bytes = [first.1[0], last.1[1]];
        let about = |step: &&mut Step| step.words.is_some_and(|words| words[0] <= bytes[0] && bytes[1] <= words[1]);
        let mut steps = program.steps.iter_mut().filter(about);
        // Which of several steps is meant is not said.
        let (Some(step), None) = (steps.next(), steps.next()) else { continue };
        if let Some(ids) = list_with(step, &things) {
            add_ids(ids, &lost);
        }
    }
    complete_shown(linked, &mut program.steps);
}

/// Sizes and words of a picture that shows all of a list behind them: `end on a wide shot of the television, the vase and the sideboard`.
const PICTURES: [&str; 6] = ["shot", "view", "picture", "wide", "frame", "together"];

/// Adds to a picture of most of a list what earlier steps show, too.
fn complete_shown(linked: &Linked, steps: &mut [Step]) {
    let words: Vec<(&str, [usize; 2])> = linked.words_in([0, usize::MAX]).collect();
    for things in joined_things(linked).into_iter().filter(|things| things.len() > 2) {
        let Some(first) = words.iter().position(|(_, span)| *span == things[0].1) else { continue };
        let is_picture = words[first.saturating_sub(3)..first].iter().any(|(word, _)| PICTURES.contains(word));
        let ids: Vec<u32> = linked.expanded(&things.iter().map(|(id, _)| *id).collect::<Vec<_>>());
        let holds = |step: &&mut Step| step.words.is_some_and(|[from, to]| (from..to).contains(&things[0].1[0]));
        for step in steps.iter_mut().filter(holds).filter(|_| is_picture) {
            for framing in [&mut step.start, &mut step.end] {
                if framing.subjects.len() > 1 && framing.subjects.iter().all(|id| ids.contains(id)) {
                    add_ids(&mut framing.subjects, &ids);
                }
            }
        }
    }
}

/// The list of a step's ids that has one of the things: of its end, its start, or what stays in view.
fn list_with<'a>(step: &'a mut Step, things: &[(u32, [usize; 2])]) -> Option<&'a mut Vec<u32>> {
    let has = |ids: &Vec<u32>| things.iter().any(|(id, _)| ids.contains(id));
    [&mut step.end.subjects, &mut step.start.subjects, &mut step.keep].into_iter().find(|ids| has(ids))
}

/// Runs of things that the words join, each thing with its bytes of the prompt: two or more, with an `and` among them.
fn joined_things(linked: &Linked) -> Vec<Vec<(u32, [usize; 2])>> {
    let mut runs = Vec::new();
    let (mut run, mut is_joined, mut links) = (Vec::new(), false, true);
    for (word, span) in linked.words_in([0, usize::MAX]) {
        if let Some(id) = linked.slot_at(word) {
            if !links {
                runs.push((std::mem::take(&mut run), is_joined));
                is_joined = false;
            }
            run.push((id, span));
            links = false;
        } else if word == "," || JOINTS.contains(&word) {
            links = true;
            is_joined |= word != "," && !run.is_empty();
        } else if !BETWEEN.contains(&word) {
            runs.push((std::mem::take(&mut run), is_joined));
            (is_joined, links) = (false, true);
        }
    }
    runs.push((run, is_joined));
    runs.into_iter().filter(|(run, is_joined)| *is_joined && run.len() > 1).map(|(run, _)| run).collect()
}

/// Makes framings show both things where the words say so after two things were named: `pull back with both in frame`.
pub(crate) fn show_both(linked: &Linked, steps: &mut [Step]) {
    let words: Vec<(&str, [usize; 2])> = linked.words_in([0, usize::MAX]).collect();
    for (at, (_, span)) in words.iter().enumerate().filter(|(_, (word, _))| *word == "both") {
        let near = &words[at + 1..words.len().min(at + 7)];
        let ends = |(word, _): &(&str, [usize; 2])| matches!(*word, "." | ";" | "!");
        let near = near.split(ends).next().unwrap_or_default();
        let next = near.first().map_or("", |(word, _)| word);
        let has = |list: &[&str]| near.iter().any(|(word, _)| list.contains(word));
        // `End wide with both + the sideboard`.
        let before = &words[at.saturating_sub(2)..at];
        let is_wide = before.iter().any(|(word, _)| *word == "wide" || *word == "with")
            && words[at.saturating_sub(4)..at].iter().any(|(word, _)| *word == "wide");
        // `So that we see both of them and the stool`.
        let is_joint = |at: usize| near.get(at).is_some_and(|(word, _)| JOINTS.contains(word));
        let and_more = (next == "of" && is_joint(2) || is_joint(0))
            && before.iter().any(|(word, _)| matches!(*word, "see" | "show" | "seeing" | "showing"))
            && near.iter().any(|(word, _)| linked.slot_at(word).is_some());
        let is_seen = (has(&SEEN) || is_wide || and_more) && !has(&DENIALS);
        if PARTS.contains(&next) || linked.slot_at(next).is_some() || next == "the" || !is_seen {
            continue;
        }
        let named = named_before(linked, &words[..at]);
        let holds = |step: &&mut Step| step.words.is_some_and(|[from, to]| (from..to).contains(&span[0]));
        let [.., first, second] = named[..] else { continue };
        for step in steps.iter_mut().filter(holds) {
            let framing = if step.end.subjects.is_empty() { &mut step.start } else { &mut step.end };
            show_pair(framing, [first, second]);
            let pair = linked.expanded(&[first, second]);
            let others = is_wide && JOINTS.contains(&next) && framing.subjects.iter().all(|id| !pair.contains(id));
            if framing.whole && (others || and_more) {
                add_ids(&mut framing.subjects, &pair);
            }
        }
    }
}

/// Words of a pair that is seen, behind its second thing.
const ALL_SEEN: [&str; 3] = ["both", "together", "all"];

/// Shows the two things of which the words say right behind them that both are seen, in the step that shows one of them with something
/// else: `and finish with the vase and the television both in view`.
pub(crate) fn show_named_pair(linked: &Linked, steps: &mut [Step]) {
    let words: Vec<(&str, [usize; 2])> = linked.words_in([0, usize::MAX]).collect();
    for at in 0..words.len() {
        let Some([(first, _), (and, _), (second, span), (both, _), rest @ ..]) = words.get(at..) else { continue };
        let is_pair = JOINTS.contains(and) && ALL_SEEN.contains(both);
        let is_seen = rest.iter().take(4).any(|(word, _)| SEEN.contains(word))
            && !rest.iter().take(5).any(|(word, _)| DENIALS.contains(word));
        let (Some(first), Some(second)) = (linked.slot_at(first), linked.slot_at(second)) else { continue };
        let pair = linked.expanded(&[first, second]);
        let holds = |step: &&mut Step| step.words.is_some_and(|[from, to]| (from..to).contains(&span[0]));
        let shows_other = |step: &&mut Step| {
            let shown = linked.expanded(&step.end.subjects);
            shown.len() > 1 && pair.iter().any(|id| shown.contains(id)) && !pair.iter().all(|id| shown.contains(id))
        };
        for step in steps.iter_mut().filter(holds).filter(shows_other).filter(|_| is_pair && is_seen && pair.len() == 2)
        {
            step.end.subjects.clone_from(&pair);
            step.end.whole = true;
        }
    }
}

/// Single things that the words name, each once, the last named last.
fn named_before(linked: &Linked, words: &[(&str, [usize; 2])]) -> Vec<u32> {
    let mut named: Vec<u32> = Vec::new();
    for id in words.iter().filter_map(|(word, _)| linked.slot_at(word)).filter(|id| linked.expanded(&[*id]).len() == 1)
    {
        named.retain(|other| *other != id);
        named.push(id);
    }
    named
}

fn show_pair(framing: &mut Framing, pair: [u32; 2]) {
    if matches!(framing.subjects[..], [only] if pair.contains(&only)) {
        framing.subjects = pair.to_vec();
        framing.whole = true;
    }
}

#[cfg(test)]
mod tests {
    use super::super::fixture::{about, linked};
    use super::*;
    use cinesplat_trajectory::Move;

    #[test]
    fn both_of_them_and_something_are_three() {
        let text = "from <obj-0> to <obj-1> , then pull out so that we see both of them and <obj-2>";
        let linked = Linked { slots: vec![5, 7, 9], ..linked(text) };
        let mut step = about(Move::PullOut, &[7, 9], [26, text.len()]);
        step.end.whole = true;
        let mut steps = [step];
        show_both(&linked, &mut steps);
        assert_eq!(steps[0].end.subjects, [7, 9, 5]);
    }

    fn shown(text: &str, ids: &[u32]) -> Vec<u32> {
        let linked = Linked { slots: vec![5, 7, 9], ..linked(text) };
        let mut steps = [about(Move::Follow, ids, [0, text.len()])];
        show_named_pair(&linked, &mut steps);
        steps[0].end.subjects.clone()
    }

    #[test]
    fn a_picture_of_a_list_shows_all_of_it() {
        let text = "from <obj-0> to <obj-1> , end on a wide shot of <obj-0> , <obj-1> and <obj-2>";
        let linked = Linked { slots: vec![5, 7, 9], ..linked(text) };
        let from = text.find("end").unwrap();
        let mut steps = [about(Move::Follow, &[7], [0, from]), about(Move::Follow, &[5, 9], [from, text.len()])];
        complete_shown(&linked, &mut steps);
        assert_eq!(steps[1].end.subjects, [5, 9, 7]);
        assert_eq!(steps[0].end.subjects, [7]);
    }

    #[test]
    fn both_and_another_thing_are_three() {
        let text = "<obj-0> first , <obj-1> second , end wide with both and <obj-2> . no cuts";
        let linked = Linked { slots: vec![5, 7, 9], ..linked(text) };
        let mut steps = [Step {
            end: Framing { whole: true, ..about(Move::Follow, &[9], [0, 1]).end },
            ..about(Move::Follow, &[9], [17, text.len()])
        }];
        show_both(&linked, &mut steps);
        assert_eq!(steps[0].end.subjects, [9, 5, 7]);
    }

    #[test]
    fn both_of_a_pair_are_those_that_are_named() {
        let text = "from <obj-2> to <obj-0> , and finish with <obj-0> and <obj-1> both in view";
        assert_eq!(shown(text, &[9, 7]), [5, 7]);
        assert_eq!(shown(text, &[7]), [7]);
        assert_eq!(shown("<obj-0> and <obj-1> together in frame at last", &[7, 9]), [5, 7]);
        assert_eq!(shown("<obj-0> and <obj-1> both out of view", &[7, 9]), [7, 9]);
        assert_eq!(shown("past <obj-0> and <obj-1> to <obj-2>", &[7, 9]), [7, 9]);
    }
}

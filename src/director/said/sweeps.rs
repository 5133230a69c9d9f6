//! Ways that lead from one thing past others to a last one, in several parts of a sentence: `slide along the mantel, from the plant,
//! past the cactus, over to the radio`.
//!
//! The network takes each part for a move of its own. Where only the first part has a verb, all of them are one way.

use cinesplat_language::{Linked, is_listed};
use cinesplat_operator::{Framing, Pass, Step, Via};
use cinesplat_trajectory::Move;

use super::briefs::is_camera_verb;
use super::directions::is_form;
use crate::direction::Direction;

/// Words by which a part of a sentence goes on with a way.
const LEADS: &str = "past over across along through via to onto into up down under from ending finishing landing starting beginning \
    stopping stop stops end ends finish land";
/// Words that may stand before them.
const OPENERS: &str = ", and then on right straight all the way slowly gently low close";
/// Words before what a way leads to, and before what it leaves, behind `ending` and `starting`.
const AT: &str = "at on with by in from";
/// Words of an arrival.
const ARRIVES: &str = "ending finishing landing land lands end ends finish finishes settle settles stop stops stopping";
/// Words between a word of a way and the thing.
const BETWEEN: &str = "the a an both top bottom of front back very edge side end over on";
/// Marks that end a sentence.
const MARKS: &str = ". ; ! ? :";

/// Where words lead.
#[derive(Debug, Default, PartialEq)]
struct Way {
    source: Option<Vec<u32>>,
    passed: Vec<(Pass, Vec<u32>)>,
    goal: Option<Vec<u32>>,
}

/// Makes one step of a way whose parts were read as steps, and passes on a way what its words say.
pub(crate) fn join_sweeps(linked: &Linked, direction: &mut Direction) {
    direction.join_pairs(|before, after| swept(linked, before, after));
    for step in &mut direction.program.steps {
        pass_as_said(linked, step);
    }
}

/// Whether a move leads from one thing to another.
fn leads(movement: Move) -> bool {
    movement.looks_elsewhere()
        || matches!(
            movement,
            Move::TruckLeft
                | Move::TruckRight
                | Move::FlyThrough
                | Move::Follow
                | Move::PedestalUp
                | Move::PedestalDown
                | Move::CraneUp
                | Move::CraneDown
        )
}

/// One step of a way and of its next part.
fn swept(linked: &Linked, first: &Step, second: &Step) -> Option<Step> {
    let goes_on = leads(first.movement) && !second.cut && !second.returns && second.duration_secs.is_none();
    let ([from, _], [start, to]) = (first.words?, second.words?);
    let own = linked.texts_in([start.max(from), to]);
    let opening = own.iter().position(|word| !is_listed(OPENERS, word))?;
    let is_part = is_listed(LEADS, own[opening])
        && !own[..opening].iter().any(|word| matches!(*word, "then" | "and"))
        && !(0..own.len()).any(|at| is_camera_verb(&own, at) && !is_listed(LEADS, own[at]));
    let names = |words: &[&str]| words.iter().any(|word| linked.slot_at(word).is_some());
    if goes_on && first.words == second.words {
        return read_twice(linked, first, second);
    }
    if !goes_on || !is_part || start <= from || !names(&own) {
        return None;
    }
    let before = linked.texts_in([from, start]);
    let all = linked.texts_in([from, to]);
    let num = all.iter().rposition(|word| linked.slot_at(word).is_some())?;
    let way_from = way_begins(linked, &all[..num]);
    let is_one_sentence = !all[way_from..num].iter().any(|word| is_listed(MARKS, word));
    let (left, way) = (way_of(linked, &before)?, way_of(linked, &all)?);
    let is_open = left.goal.is_none() && (left.source.is_some() || !left.passed.is_empty());
    if is_one_sentence && way.goal.is_some() && left.goal == way.goal && first.via.is_none() && !way.passed.is_empty() {
        // `From behind the chair over to the sofa, across the table`.
        let ends = linked.expanded(&first.end.subjects);
        let is_read = way.goal.as_ref() == Some(&ends) && second.end.subjects.is_empty();
        let one = Step { via: via(&way, first.movement), words: first.joint_words(second), ..first.clone() };
        return is_read.then_some(one);
    }
    if !is_one_sentence || !is_open {
        return None;
    }
    let framed = |ids: &Option<Vec<u32>>, known: [&Framing; 2]| match ids {
        Some(ids) => known
            .into_iter()
            .find(|framing| framing.subjects == *ids)
            .cloned()
            .unwrap_or_else(|| Framing { subjects: ids.clone(), ..Framing::default() }),
        None => Framing::default(),
    };
    Some(Step {
        start: if way.source.is_some() {
            framed(&way.source, [&first.start, &second.start])
        } else {
            first.start.clone()
        },
        end: framed(&way.goal, [&second.end, &first.end]),
        via: via(&way, first.movement),
        words: first.joint_words(second),
        ..first.clone()
    })
}

/// Words of a sentence that only says where the film begins.
const BEGINS: &str =
    "begin begins beginning start starts starting open opens opening we on at with in the a film shot camera";

/// The first word of the way that some words say: behind a sentence that only begins the film, and behind the colon of what heads a list
/// of things, as in `Begin on the wall. Pan right: past the curtain, past the chair`.
fn way_begins(linked: &Linked, words: &[&str]) -> usize {
    let is_beginning = |words: &[&str]| {
        words.first().is_some_and(|word| is_listed(BEGINS, word))
            && words.iter().all(|word| is_listed(BEGINS, word) || linked.slot_at(word).is_some())
    };
    let mark = words.iter().position(|word| is_listed(MARKS, word));
    let begun = mark.filter(|mark| words[*mark] != ":" && is_beginning(&words[..*mark])).map_or(0, |mark| mark + 1);
    let heads = |colon: &usize| {
        let before = &words[begun..*colon];
        words[*colon] == ":" && before.len() < 5 && (0..before.len()).any(|at| is_camera_verb(before, at))
    };
    (begun..words.len()).find(|at| is_listed(MARKS, words[*at])).filter(heads).map_or(begun, |colon| colon + 1)
}

/// One step of two of the same words, the first of which ends at what the words pass on their way to the end of the second.
fn read_twice(linked: &Linked, first: &Step, second: &Step) -> Option<Step> {
    let way = way_of(linked, &linked.texts_in(first.words?))?;
    let [start, middle, end] =
        [&first.start, &first.end, &second.end].map(|framing| linked.expanded(&framing.subjects));
    let passes = way.passed.iter().any(|(_, ids)| *ids == middle);
    let is_way = way.source.as_ref() == Some(&start) && way.goal.as_ref() == Some(&end) && passes;
    is_way.then(|| Step { end: second.end.clone(), via: via(&way, first.movement), ..first.clone() })
}

/// Passes what the words pass, on a way of one step that begins and ends as they say.
fn pass_as_said(linked: &Linked, step: &mut Step) {
    let words = linked.texts_in(step.words.unwrap_or_default());
    let Some(way) = way_of(linked, &words).filter(|_| leads(step.movement)) else { return };
    let is_read = way.source.as_ref() == Some(&linked.expanded(&step.start.subjects))
        && way.goal.as_ref() == Some(&linked.expanded(&step.end.subjects));
    if is_read && !way.passed.is_empty() && step.look.is_none() {
        step.via = via(&way, step.movement);
    }
    // What goes over a thing to another one does not keep to its line.
    let is_over = step.via.as_ref().is_some_and(|via| via.how == Pass::Over) && way.source.is_some();
    let slides = matches!(step.movement, Move::TruckLeft | Move::TruckRight) && step.either_way;
    if slides && is_over && way.goal.is_some() {
        (step.movement, step.either_way) = (Move::FlyThrough, false);
    }
}

/// What a move passes on a way: what it goes along, or else all that it passes.
fn via(way: &Way, movement: Move) -> Option<Via> {
    let along = way.passed.iter().find(|(how, _)| *how == Pass::Along);
    if let Some((how, objects)) = along {
        return Some(Via { how: *how, objects: objects.clone() });
    }
    let (first, _) = way.passed.first()?;
    let turns = movement.looks_elsewhere();
    let is_same = way.passed.iter().all(|(how, _)| how == first);
    let how = if turns || !is_same { Pass::Past } else { *first };
    Some(Via { how, objects: way.passed.iter().flat_map(|(_, ids)| ids.clone()).collect() })
}

/// The way that words say; `None` where they lead to several things, or from several.
fn way_of(linked: &Linked, words: &[&str]) -> Option<Way> {
    let mut way = Way::default();
    let mut last: Option<Pass> = None;
    let text = |at: usize| words.get(at).copied().unwrap_or_default();
    let mut at = 0;
    while at < words.len() {
        let word = text(at);
        let leads_on = is_listed("to onto into", text(at + 1));
        let (ends, begins) = (
            is_listed(ARRIVES, word),
            is_listed("starting beginning start starts begin begins open opens opening", word),
        );
        let how = match word {
            "past" | "via" => Some(Pass::Past),
            "over" | "across" | "above" if !leads_on => Some(Pass::Over),
            "along" => Some(Pass::Along),
            "through" => Some(Pass::Through),
            "under" => Some(Pass::Under),
            _ => None,
        };
        let is_at = (ends || begins) && is_listed(AT, text(at + 1));
        let next = at + 1 + usize::from(is_at);
        let thing = (next..words.len()).find(|at| !is_listed(BETWEEN, text(*at)));
        let named = thing.and_then(|thing| Some((thing, linked.expanded(&[linked.slot_at(text(thing))?]))));
        let Some((thing, ids)) = named else {
            // `Past the mug and the teapot`.
            if !is_listed("and , the", word) {
                last = None;
            }
            at += 1;
            continue;
        };
        let goes_to = is_listed("to onto into", word) || ends && is_at;
        let full = match (how, goes_to, word == "from" || begins && is_at) {
            (Some(how), _, _) => {
                way.passed.push((how, ids));
                last = Some(how);
                false
            }
            (_, true, _) => way.goal.replace(ids).is_some(),
            (_, _, true) => way.source.replace(ids).is_some(),
            _ if is_listed("and ,", word) && next == thing => {
                if let Some(how) = last {
                    way.passed.push((how, ids));
                }
                false
            }
            _ => {
                at += 1;
                continue;
            }
        };
        if full {
            return None;
        }
        at = thing + 1;
    }
    Some(way)
}

/// Words of a picture at which a turn arrives.
const LANDS: [&str; 4] = ["land", "settle", "rest", "come"];

const ENDS: [&str; 4] = ["end", "finish", "settle", "land"];

/// Ends a turn on what its words land on, and not on what that stands on: `snap round to the table and land on the lamp`.
pub(crate) fn land_on(linked: &Linked, direction: &mut Direction) {
    for nth in (1..direction.program.steps.len()).rev() {
        let [turn, land] = &direction.program.steps[nth - 1..=nth] else { continue };
        let start = turn.words.unwrap_or_default()[1];
        let words = linked.texts_in([start, land.words.unwrap_or_default()[1]]);
        let plain = Framing { subjects: land.end.subjects.clone(), size: land.end.size, ..Framing::default() };
        let turns = turn.movement == Move::WhipPan || turn.movement.looks_elsewhere();
        let is_plain = matches!(land.movement, Move::Follow | Move::Static) && land.end == plain && land.via.is_none();
        let lands = lands_at(&words).is_some_and(|at| words[..at].iter().all(|word| matches!(*word, "and" | ",")));
        let is_own = !land.cut && land.duration_secs.is_none() && land.start.subjects.is_empty();
        // `.. to the sofa and finish on the cushions` has arrived.
        let ends = words.iter().take(3).any(|word| ENDS.iter().any(|verb| is_form(word, verb)));
        let is_there =
            land.movement == Move::Follow && turn.end.subjects == plain.subjects && turn.movement != Move::Static;
        if is_plain && is_own && ends && is_there && !plain.subjects.is_empty() && turn.end.part == land.end.part {
            let size = turn.end.size.or(plain.size);
            let end = Framing { size, ..turn.end.clone() };
            let one = Step { end, words: turn.joint_words(land), ..turn.clone() };
            direction.join_steps(nth, one);
            continue;
        }
        if turns && is_plain && is_own && lands && !plain.subjects.is_empty() && turn.duration_secs.is_none() {
            let one = Step { end: plain, words: turn.joint_words(land), ..turn.clone() };
            direction.join_steps(nth, one);
        }
    }
    for step in &mut direction.program.steps {
        let turns = step.movement == Move::WhipPan || step.movement.looks_elsewhere();
        let words = linked.texts_in(step.words.unwrap_or_default());
        let Some(at) = lands_at(&words).filter(|_| turns) else { continue };
        let named = words[at..].iter().take(5).find_map(|word| linked.slot_at(word)).map(|id| linked.expanded(&[id]));
        let Some(ids) = named.filter(|ids| *ids != linked.expanded(&step.end.subjects)) else { continue };
        if step.start.subjects.is_empty() || linked.expanded(&step.start.subjects) != ids {
            step.end = Framing { subjects: ids, ..Framing::default() };
        }
    }
}

/// The word of words that land on something.
fn lands_at(words: &[&str]) -> Option<usize> {
    let lands = |at: &usize| {
        let word = words[*at];
        let on = words.get(at + 1).copied().unwrap_or_default();
        let rests = is_form(word, "come") && words[at + 1..].starts_with(&["to", "rest", "on"]);
        LANDS[..3].iter().any(|verb| is_form(word, verb)) && matches!(on, "on" | "upon" | "onto") || rests
    };
    (0..words.len()).find(lands)
}

#[cfg(test)]
mod tests {
    use super::super::fixture::{direction, linked};
    use super::*;

    fn joined(texts: [&str; 2], steps: [Step; 2]) -> Vec<Step> {
        let text = texts.join(" ");
        let linked = Linked { slots: vec![5, 7, 9, 11], ..linked(&text) };
        let [first, second] = steps;
        let middle = texts[0].len() + 1;
        let mut direction = direction(vec![
            Step { words: Some([0, middle]), ..first },
            Step { words: Some([middle, text.len()]), ..second },
        ]);
        join_sweeps(&linked, &mut direction);
        land_on(&linked, &mut direction);
        direction.program.steps
    }

    fn about(movement: Move, id: u32) -> Step {
        Step { end: Framing { subjects: vec![id], ..Framing::default() }, ..Step::of(movement) }
    }

    #[test]
    fn parts_without_a_verb_are_one_way() {
        let truck = || about(Move::TruckRight, 7);
        let follow = || about(Move::Follow, 11);
        let steps =
            joined(["slide along <obj-0> , from <obj-1> ,", "past <obj-2> , over to <obj-3>"], [truck(), follow()]);
        let ids = |framing: &Framing| framing.subjects.clone();
        assert_eq!((steps.len(), ids(&steps[0].start), ids(&steps[0].end)), (1, vec![7], vec![11]));
        assert_eq!(steps[0].via, Some(Via { how: Pass::Along, objects: vec![5] }));
        let steps = joined(["tilt up from <obj-0> ,", "past <obj-1> , to <obj-3>"], [about(Move::TiltUp, 7), follow()]);
        assert_eq!(steps[0].via, Some(Via { how: Pass::Past, objects: vec![7] }));
        // A verb, another sentence, and a way that has arrived.
        for [first, second] in [
            ["slide from <obj-0> ,", "then push in to <obj-3>"],
            ["slide from <obj-0> .", "past <obj-1> to <obj-3>"],
            ["slide from <obj-0> to <obj-1> ,", "over to <obj-3>"],
        ] {
            assert_eq!(joined([first, second], [truck(), follow()]).len(), 2, "{first} {second}");
        }
    }

    #[test]
    fn a_list_behind_a_beginning_is_one_way() {
        let pan = || about(Move::PanRight, 5);
        let follow = || about(Move::Follow, 11);
        for [first, second] in [
            ["begin on <obj-0> . pan right : past <obj-1> ,", "stop on <obj-3>"],
            ["start on <obj-0> . pan right past <obj-1> ,", "stopping at <obj-3>"],
            ["open on <obj-0> . pan right past <obj-1> ,", "finish on <obj-3>"],
            ["start at <obj-0> . tilt up : past <obj-1> ,", "on to <obj-3>"],
        ] {
            let steps = joined([first, second], [pan(), follow()]);
            assert_eq!((steps.len(), &steps[0].start.subjects[..]), (1, &[5][..]), "{first} {second}");
            assert_eq!(steps[0].end.subjects, [11], "{first} {second}");
        }
        // A move of its own in the first sentence, and a stop that lasts.
        assert_eq!(
            joined(["push in on <obj-0> . pan right past <obj-1> ,", "stop on <obj-3>"], [pan(), follow()]).len(),
            2
        );
        let held = Step { duration_secs: Some(2.0), ..follow() };
        assert_eq!(joined(["start on <obj-0> . pan right past <obj-1> ,", "stop on <obj-3>"], [pan(), held]).len(), 2);
    }

    #[test]
    fn a_turn_ends_on_what_it_lands_on() {
        let whip = || about(Move::WhipPan, 5);
        let steps = joined(["snap round to <obj-0>", "and land on <obj-3>"], [whip(), about(Move::Follow, 11)]);
        assert_eq!((steps.len(), steps[0].end.subjects.clone()), (1, vec![11]));
        let steps = joined(["snap round to <obj-0>", "then land on <obj-3>"], [whip(), about(Move::Follow, 11)]);
        assert_eq!(steps.len(), 2);
    }
}

//! What the words say of the last picture of a move: `until the table is in, including the lantern`, `up high so we see the
//! whole camp`, `then zoom out again`.

use cinesplat_language::{Linked, QuantityKind, add_ids};
use cinesplat_operator::{Amount, Framing, Motion, Step};
use cinesplat_trajectory::{Move, ShotSize};

use super::bans::asks_for;
use super::briefs::directs;
use super::directions::is_form;
use super::openings::{OPENS, abbreviated_size};
use crate::direction::Direction;

/// Words that add a thing to what is seen.
const INCLUDES: [&str; 5] = ["incl", "including", "include", "includes", "plus"];
/// Words between them and the thing.
const BETWEEN: [&str; 6] = ["the", "a", "an", ".", "of", "also"];

/// Widens a picture that ends on what the words include to what they include it in: `pull back from the sushi until the whole
/// table is visible, incl. the lantern`.
pub(crate) fn include_named(linked: &Linked, steps: &mut [Step]) {
    for nth in 0..steps.len() {
        let (before, rest) = steps.split_at_mut(nth);
        let Some(step) = rest.first_mut() else { continue };
        let words = linked.texts_in(step.words.unwrap_or_default());
        let included = words.iter().enumerate().filter(|(_, word)| INCLUDES.contains(word)).find_map(|(at, _)| {
            let id =
                words[at + 1..].iter().find(|word| !BETWEEN.contains(word)).and_then(|word| linked.slot_at(word))?;
            Some((at, linked.expanded(&[id])))
        });
        let Some((at, ids)) = included.filter(|(_, ids)| *ids == step.end.subjects && widens(step)) else { continue };
        let named: Vec<u32> = words[..at].iter().filter_map(|word| linked.slot_at(word)).collect();
        let shown = before.last().map(|step| &step.end.subjects);
        let first = [&named, &step.start.subjects].into_iter().chain(shown).find(|ids| !ids.is_empty());
        let mut subjects = linked.expanded(first.map(Vec::as_slice).unwrap_or_default());
        subjects.retain(|id| !ids.contains(id));
        if step.start.subjects.is_empty() {
            step.start.subjects.clone_from(&subjects);
        }
        subjects.extend(ids);
        step.end.whole |= step.end.size.is_none() || subjects.len() > 1;
        step.end.subjects = subjects;
    }
}

/// Ends wide on the room where the words end on a wide view, of which the network makes a way in: `.. and end on a wide view that makes you
/// want to move in`.
pub(crate) fn end_on_wide(linked: &Linked, steps: &mut [Step]) {
    let num = steps.len();
    let Some(step) = steps.last_mut().filter(|_| num > 1) else { return };
    let words = linked.texts_in(step.words.unwrap_or_default());
    let is_wide = matches!(step.end.size, Some(ShotSize::Long | ShotSize::ExtremeLong));
    let says = words.windows(2).any(|pair| matches!(pair, ["wide", "view" | "shot" | "picture" | "frame"]));
    let plain = Framing { size: step.end.size, ..Framing::default() };
    let is_way_in = matches!(step.movement, Move::PushIn | Move::Follow) && step.start == Framing::default();
    if is_wide && says && is_way_in && step.end == plain && step.via.is_none() && step.amount.is_none() {
        (step.movement, step.end) = (Move::PullOut, Framing::default());
    }
}

/// Shows what a step that widens leaves together with what is seen then, too: `back away from the armchair until I can see also the
/// curtain and the sideboard`.
pub(crate) fn show_also(linked: &Linked, steps: &mut [Step]) {
    for step in steps.iter_mut().filter(|step| widens(step) && step.end.whole) {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let Some(at) = words.iter().position(|word| *word == "also") else { continue };
        let named = |words: &[&str]| linked.named_by(words);
        let (before, after) = (named(&words[..at]), named(&words[at..]));
        if !before.is_empty() && step.end.subjects.iter().all(|id| after.contains(id)) {
            step.end.subjects = before;
            add_ids(&mut step.end.subjects, &after);
        }
    }
}

/// Joins to a step that widens until things are in the picture what the words list behind them: `pull back until both lamps, the bench
/// and the picture are in`, of which the network makes a step of its own.
pub(crate) fn join_listed(linked: &Linked, direction: &mut Direction) {
    direction.join_pairs(|first, second| listed(linked, first, second));
}

fn listed(linked: &Linked, first: &Step, second: &Step) -> Option<Step> {
    let widens = matches!(first.movement, Move::PullOut | Move::ZoomOut);
    let takes_in = widens && first.end.whole && !first.end.subjects.is_empty();
    let is_bare = second.via.is_none()
        && second.with.is_empty()
        && second.start.subjects.is_empty()
        && second.duration_secs.is_none()
        && !second.cut
        && !second.returns
        && !second.end.subjects.is_empty();
    // The second step may begin with the last word of the first one's list, or behind its comma.
    let ([from, to], [_, end]) = (first.words?, second.words?);
    let words = linked.texts_in([to, end]);
    let is_joint = |word: Option<&&str>| word.is_some_and(|word| matches!(*word, "," | "and"));
    let goes_on = is_joint(words.first()) || !words.is_empty() && is_joint(linked.texts_in([from, to]).last());
    (takes_in && is_bare && goes_on && !directs(&words)).then(|| {
        let mut end = first.end.clone();
        add_ids(&mut end.subjects, &second.end.subjects);
        Step { end, words: first.joint_words(second), ..first.clone() }
    })
}

/// Ends a way to its subject on a close picture that the network begins it with, where no words open on it: `get in really
/// close to the anvil`.
pub(crate) fn near_to_size(linked: &Linked, steps: &mut [Step]) {
    for step in steps.iter_mut().filter(|step| matches!(step.movement, Move::PushIn | Move::ZoomIn)) {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let is_close = matches!(step.start.size, Some(ShotSize::CloseUp | ShotSize::ExtremeCloseUp));
        let plain = Framing { subjects: step.end.subjects.clone(), ..Framing::default() };
        let is_open = step.end == plain && step.start.subjects == step.end.subjects;
        if is_close && is_open && !words.iter().any(|word| *word == "from" || OPENS.contains(word)) {
            step.end = std::mem::take(&mut step.start);
        }
    }
}

/// Ends a way in close on what its words lead onto: `track in over the chair onto the laptop`.
pub(crate) fn close_onto(linked: &Linked, steps: &mut [Step]) {
    for step in steps.iter_mut().filter(|step| step.movement == Move::PushIn) {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let leads = |at: usize| {
            let onto = words[at] == "onto" || words[at] == "on" && words.get(at + 1) == Some(&"to");
            let goal = || words[at + 1..].iter().take(3).filter_map(|word| linked.slot_at(word));
            onto && goal().any(|id| linked.expanded(&[id]) == step.end.subjects)
        };
        let plain = Framing { subjects: step.end.subjects.clone(), ..Framing::default() };
        if step.end == plain && step.amount.is_none() && (0..words.len()).any(leads) {
            step.end.size = Some(ShotSize::CloseUp);
        }
    }
}

/// Shows all of what the words call whole, where they say no other size: `show the whole cabinet from the front`.
pub(crate) fn show_whole(linked: &Linked, steps: &mut [Step]) {
    for step in steps {
        let shows = matches!(step.movement, Move::Static | Move::PushIn | Move::ZoomIn | Move::Reveal) || widens(step);
        let subjects = linked.expanded(&step.end.subjects);
        let [from, to] = step.words.filter(|_| shows).unwrap_or_default();
        // Whether the words call some things whole.
        let are_whole = |ids: &[u32]| {
            linked.words_in([from, to]).any(|(word, span)| {
                let id = linked.slot_at(word).filter(|_| linked.wholes.contains(&span));
                id.is_some_and(|id| linked.expanded(&[id]) == ids)
            })
        };
        // A way in begins with the whole of its subject.
        let nears = matches!(step.movement, Move::PushIn | Move::ZoomIn) && step.start.subjects == step.end.subjects;
        let framing = if nears { &mut step.start } else { &mut step.end };
        let is_open = framing.size.is_none() && framing.height_frac.is_none() && !framing.hidden;
        if is_open && are_whole(&subjects) {
            framing.whole = true;
        }
        // `Start with the full sideboard in view, then move in on the vase`.
        let first = linked.expanded(&step.start.subjects);
        // What is far and complete is both: `start far with the complete plant`.
        let is_far = step.start.size.is_none_or(|size| size >= ShotSize::Long);
        let is_open = is_far && step.start.height_frac.is_none() && !step.start.hidden;
        if is_open && !first.is_empty() && first != subjects && are_whole(&first) {
            step.start.whole = true;
        }
    }
}

/// Rooms and all that is around.
const AROUND: [&str; 12] = [
    "room",
    "world",
    "place",
    "house",
    "kitchen",
    "workshop",
    "studio",
    "lounge",
    "bedroom",
    "hall",
    "flat",
    "apartment",
];

/// Leads out to the place of which the words notice all, where the network has only read a look up: `you lift your head and notice
/// there's a whole room around you`.
pub(crate) fn notice_place(linked: &Linked, steps: &mut [Step]) {
    for step in steps.iter_mut().skip(1).filter(|step| step.movement == Move::TiltUp) {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let is_all = words.windows(2).any(|two| ALL.contains(&two[0]) && AROUND.contains(&two[1]));
        if is_all && step.end == Framing::default() && step.amount.is_none() && step.with.is_empty() {
            step.movement = Move::PullOut;
            step.end.size = Some(ShotSize::Long);
        }
    }
}

/// Whether a step leads away from what it shows.
fn widens(step: &Step) -> bool {
    std::iter::once(&step.movement)
        .chain(&step.with)
        .any(|movement| matches!(movement, Move::PullOut | Move::ZoomOut | Move::CraneUp | Move::PedestalUp))
}

/// Words of seeing, and words of all that there is to see.
const SEES: [&str; 8] = ["see", "show", "view", "reveal", "overlook", "survey", "take", "get"];
const ALL: [&str; 3] = ["whole", "entire", "complete"];
/// Words behind `whole` that make it something else than a place.
const NO_PLACES: [&str; 16] = [
    "thing", "time", "way", "film", "shot", "move", "length", "height", "body", "object", "circle", "picture", "frame",
    "of", "story", "process",
];

/// Ends a rise or a way out wide on the place where the words go on until all of it is seen: `fly up high so we see the whole
/// camp`.
pub(crate) fn end_on_place(linked: &Linked, steps: &mut [Step]) {
    for step in steps.iter_mut().filter(|step| widens(step)) {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let sees = |at: usize| words[..at].iter().rev().take(5).any(|word| SEES.iter().any(|verb| is_form(word, verb)));
        let is_place = |at: usize| {
            let next = words.get(at + 1).copied().unwrap_or_default();
            let is_word = next.starts_with(char::is_alphabetic) && !NO_PLACES.contains(&next);
            let ends =
                words.get(at + 2).is_none_or(|word| matches!(*word, "." | "," | ";" | "!" | "from" | "at" | "in"));
            ALL.contains(&words[at]) && is_word && ends && sees(at)
        };
        let is_open = step.end.size.is_none() && step.end.height_frac.is_none() && !step.end.whole && !step.returns;
        let opens =
            words.iter().any(|word| matches!(*word, "start" | "starting" | "begin" | "beginning" | "open" | "opening"));
        if is_open && !opens && (0..words.len()).any(is_place) {
            if step.start.subjects.is_empty() {
                step.start.subjects.clone_from(&step.end.subjects);
            }
            step.end = Framing { size: Some(ShotSize::Long), subjects: Vec::new(), ..step.end.clone() };
        }
    }
}

/// Goes back to the size of the film's first picture where the words of a way back state none: `start wide on the castle, go
/// close, then zoom out again`.
pub(crate) fn widen_again(linked: &Linked, steps: &mut [Step]) {
    let Some(first) = steps.first() else { return };
    let opening = if first.movement == Move::Static { first.end.clone() } else { first.start.clone() };
    let Some(size) = opening.size else { return };
    for nth in 1..steps.len() {
        let has_come = steps[..nth].iter().any(|step| matches!(step.movement, Move::PushIn | Move::ZoomIn));
        let step = &mut steps[nth];
        let words = linked.texts_in(step.words.unwrap_or_default());
        let is_again =
            words.contains(&"again") || words.windows(2).any(|pair| matches!(pair, ["back", "out" | "away"]));
        let leaves = matches!(step.movement, Move::PullOut | Move::ZoomOut) && !step.cut && !step.returns;
        let shown = Framing { subjects: opening.subjects.clone(), ..Framing::default() };
        let is_open = step.amount.is_none() && (step.end == shown || step.end == Framing::default());
        if has_come && is_again && leaves && is_open && !shown.subjects.is_empty() {
            step.end = Framing { size: Some(size), ..shown };
        }
    }
}

/// Travels up or down at a distance that the words state for the whole way, which no turn on the spot keeps: `follow the crack
/// top to bottom, 30 cm away the whole time`.
pub(crate) fn travel_at_distance(steps: &mut [Step]) {
    for step in steps {
        let is_held = step.start.distance.is_some() && step.start.distance == step.end.distance;
        if is_held && asks_for(step, Motion::Tilt) && step.with.is_empty() {
            step.movement = if step.movement == Move::TiltUp { Move::PedestalUp } else { Move::PedestalDown };
        }
    }
}

/// Words of a way back or forward, and verbs of a camera that goes it.
const BACKWARD: [&str; 4] = ["backward", "backwards", "away", "rearward"];
const FORWARD: [&str; 6] = ["forward", "forwards", "toward", "towards", "closer", "nearer"];
const GLIDES: [&str; 12] =
    ["glide", "move", "drift", "float", "ease", "slide", "roll", "travel", "go", "creep", "fly", "walk"];

/// Moves a camera that the network holds although it glides: `let it hover at a child's height and glide backwards away from
/// the fountain`.
pub(crate) fn glide_in_and_out(linked: &Linked, steps: &mut [Step]) {
    for step in steps.iter_mut().filter(|step| step.movement == Move::Static && step.with.is_empty()) {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let is_glide = |word: &&str| GLIDES.iter().any(|verb| is_form(word, verb));
        let glides = |list: &[&str]| {
            let leads = |at: usize| list.contains(&words[at]) && words[..at].iter().rev().take(3).any(is_glide);
            (0..words.len()).any(leads)
        };
        let is_denied = words.iter().any(|word| matches!(*word, "no" | "not" | "'t" | "never" | "without" | "dont"));
        let (back, forth) = (glides(&BACKWARD), glides(&FORWARD));
        if back != forth && !is_denied && !step.end.subjects.is_empty() && step.duration_secs.is_none() {
            step.movement = if back { Move::PullOut } else { Move::PushIn };
        }
    }
}

/// Words that lead to where a way ends, and words of a distance behind its length.
const STOPS: [&str; 9] = ["stop", "stops", "stopping", "end", "ending", "halt", "to", "within", "until"];
const AWAYS: [&str; 4] = ["away", "short", "off", "from"];

/// Ends a way in as far from its subject as the words say: `approach it, stopping half a meter away`.
pub(crate) fn stop_short(linked: &Linked, steps: &mut [Step]) {
    for step in steps.iter_mut().filter(|step| matches!(step.movement, Move::PushIn | Move::Follow)) {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let lengths = words.iter().enumerate().filter_map(|(at, word)| {
            let length = linked.quantity_at(word).filter(|quantity| quantity.kind == QuantityKind::Units)?;
            let stops = words[..at].iter().rev().take(4).any(|word| STOPS.contains(word));
            let is_away = words.get(at + 1).is_some_and(|word| AWAYS.contains(word))
                && words.get(at + 2).is_none_or(|word| !matches!(*word, "the" | "floor" | "ground"));
            (stops && is_away).then_some(length.value)
        });
        let lengths: Vec<f64> = lengths.collect();
        let ([length], None, false) = (&lengths[..], step.end.distance, step.end.subjects.is_empty()) else { continue };
        step.end.distance = Some(*length);
        step.amount =
            step.amount.filter(|amount| !matches!(amount, Amount::Units(units) if (units - length).abs() < 1e-9));
    }
}

/// Words of what is not one thing.
const ROOMS: [&str; 12] =
    ["room", "everything", "all", "whole", "scene", "place", "space", "set", "full", "entire", "general", "wide"];

/// Shows what the step before shows where a zoom or a way in or out states a size of nothing: `tilt up the statue, then pull
/// out to WS`.
pub(crate) fn keep_shown(linked: &Linked, steps: &mut [Step]) {
    for nth in 1..steps.len() {
        let shown = steps[nth - 1].end.subjects.clone();
        let step = &mut steps[nth];
        let words = linked.texts_in(step.words.unwrap_or_default());
        let leads = matches!(step.movement, Move::PushIn | Move::PullOut | Move::ZoomIn | Move::ZoomOut);
        let is_open = step.end.subjects.is_empty() && step.end.size.is_some() && step.start.subjects.is_empty();
        let is_plain = words.iter().any(|word| abbreviated_size(word).is_some())
            && !words.iter().any(|word| ROOMS.contains(word) || linked.slot_at(word).is_some());
        if leads && is_open && is_plain && !step.cut && step.via.is_none() {
            step.end.subjects = shown;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::fixture::linked;
    use super::*;

    #[test]
    fn a_film_that_ends_on_a_wide_view_goes_back() {
        let last = |text: &str, size: ShotSize| {
            let at = text.find(" ,").unwrap();
            let end = Framing { size: Some(size), ..Framing::default() };
            let words = Some([at + 1, text.len()]);
            let mut steps = vec![Step::of(Move::Follow), Step { end, words, ..Step::of(Move::PushIn) }];
            end_on_wide(&linked(text), &mut steps);
            steps[1].movement
        };
        assert_eq!(last("show <obj-0> , and end on a wide view of it all", ShotSize::Long), Move::PullOut);
        assert_eq!(last("show <obj-0> , and go in on a wide lens", ShotSize::Long), Move::PushIn);
        assert_eq!(last("show <obj-0> , and end on a wide shot", ShotSize::CloseUp), Move::PushIn);
    }

    #[test]
    fn who_notices_a_whole_room_looks_out_on_it() {
        let noticed = |text: &str| {
            let words = Some([0, text.len()]);
            let mut steps = vec![Step::of(Move::Static), Step { words, ..Step::of(Move::TiltUp) }];
            notice_place(&linked(text), &mut steps);
            (steps[1].movement, steps[1].end.size)
        };
        let out = (Move::PullOut, Some(ShotSize::Long));
        assert_eq!(noticed("then you lift your head and notice there 's a whole room around you"), out);
        assert_eq!(noticed("then look up to the whole ceiling"), (Move::TiltUp, None));
    }

    #[test]
    fn a_pull_out_takes_in_all_that_the_words_list() {
        let text = "pull back until i see <obj-0> , <obj-1> and the bench";
        let whole = |ids: &[u32]| Framing { subjects: ids.to_vec(), whole: true, ..Framing::default() };
        let first = Step { end: whole(&[5]), words: Some([0, 29]), ..Step::of(Move::PullOut) };
        let second = Step { end: whole(&[7]), words: Some([30, text.len()]), ..Step::of(Move::Follow) };
        let one = listed(&linked(text), &first, &second).map(|step| step.end.subjects);
        assert_eq!(one, Some(vec![5, 7]));
        let then = "pull back until i see <obj-0> , then pan to <obj-1>";
        let second = Step { words: Some([30, then.len()]), ..second };
        assert_eq!(listed(&linked(then), &first, &second), None);
    }
}

//! Moves and directions that the words say beside the verb: `truck left`, `tilt slowly up`, `orbit to the right`.
//!
//! The network sometimes turns a direction around that is said plainly. Where the verb of a step's move is followed by a
//! direction, the step takes it.

use cinesplat_language::{Linked, QuantityKind, is_listed};
use cinesplat_operator::{Framing, Motion, Step, SubjectPart};
use cinesplat_trajectory::Move;

/// Words that may stand between a verb and its direction.
const BETWEEN: [&str; 24] = [
    "slowly",
    "gently",
    "smoothly",
    "softly",
    "steadily",
    "gradually",
    "slightly",
    "quickly",
    "fast",
    "hard",
    "straight",
    "just",
    "a",
    "bit",
    "little",
    "touch",
    "to",
    "toward",
    "towards",
    "the",
    "camera",
    "it",
    "cam",
    "shot",
];
/// Words after `left` and `right` that make them a place: `left of the door`.
pub(super) const PLACES: [&str; 16] = [
    "of", "side", "half", "third", "edge", "hand", "corner", "end", "wall", "one", "part", "here", "there", "behind",
    "above", "after",
];
/// Words of somebody who corrects himself or rules something out.
pub(super) const CORRECTIONS: [&str; 15] = [
    "no", "not", "don", "dont", "never", "wait", "sorry", "actually", "mean", "instead", "rather", "scratch",
    "without", "oops", "or",
];

/// Words behind a step that may correct it.
const NUM_BEHIND: usize = 3;

/// Verbs of a slide to one side.
const SLIDES: [&str; 7] = ["truck", "track", "slide", "crab", "dolly", "move", "drift"];

/// Gives a reveal the way that its words say: `truck right to reveal the sword`.
pub(crate) fn reveal_sideways(linked: &Linked, steps: &mut [Step]) {
    for step in steps.iter_mut().filter(|step| step.movement == Move::Reveal && step.with.is_empty()) {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let ways = words.iter().enumerate().filter(|(_, word)| SLIDES.iter().any(|verb| is_form(word, verb)));
        let mut ways = ways.filter_map(|(at, _)| {
            let way = words[at + 1..].iter().find(|word| !BETWEEN.contains(word))?;
            match *way {
                "left" => Some(Move::TruckLeft),
                "right" => Some(Move::TruckRight),
                _ => None,
            }
        });
        step.with.extend(ways.next());
    }
}

/// Gives the moves of steps the directions that their words say. Words that several steps share, and words that name both
/// directions of an axis, say nothing about one step.
pub(crate) fn take_said_directions(linked: &Linked, steps: &mut [Step]) {
    for nth in 0..steps.len() {
        if let Some(span) = own_words(steps, nth) {
            take_said_direction(linked, &mut steps[nth], span);
        }
    }
}

/// The words of a step that no other step shares, bytes of the prompt.
pub(super) fn own_words(steps: &[Step], nth: usize) -> Option<[usize; 2]> {
    let span = steps[nth].words;
    let is_shared = steps.iter().enumerate().any(|(other, step)| other != nth && step.words == span);
    span.filter(|_| !is_shared)
}

fn take_said_direction(linked: &Linked, step: &mut Step, words: [usize; 2]) {
    let behind = linked.words_in([words[1], usize::MAX]).take(NUM_BEHIND);
    if linked.words_in(words).chain(behind).any(|(word, _)| CORRECTIONS.contains(&word)) {
        return;
    }
    let words = linked.texts_in(words);
    for (movement, opposite) in (0..words.len()).filter_map(|at| said_at(&words, at)) {
        if words.contains(&opposite) {
            continue;
        }
        let is_opposite = |other: &Move| other.opposite() == Some(movement);
        // A pedestal that is called so is no crane.
        let is_upright = matches!(
            (movement, step.movement),
            (Move::PedestalUp, Move::CraneUp) | (Move::PedestalDown, Move::CraneDown)
        );
        if step.movement == movement || is_opposite(&step.movement) || is_upright {
            step.movement = movement;
            step.either_way = false;
        }
        step.with.iter_mut().filter(|other| is_opposite(other)).for_each(|other| *other = movement);
        // A second move that is the first one again is what the words say beside it: `push in while tilting down`.
        let (main, twice) = (step.movement, step.with.iter().position(|other| *other == step.movement));
        if let Some(twice) = twice.filter(|_| movement != main && movement.opposite() != Some(main)) {
            step.with[twice] = movement;
        }
        add_lost_move(step, movement);
    }
}

/// Ways beside a move, by their words; the second of a pair is the other way.
const WAYS: [(&[&str], Move); 4] = [
    (&["back", "backward", "backwards", "out", "away", "pullback", "off"], Move::PullOut),
    (&["in", "closer", "nearer", "forward", "forwards", "toward", "towards"], Move::PushIn),
    (&["up", "rise", "rising", "higher", "climb", "climbing", "ascend"], Move::CraneUp),
    (&["down", "lower", "lowering", "sink", "sinking", "descend", "descending"], Move::CraneDown),
];

/// Puts another way that the words name in the place of a second move that is the first one again: `pull back up and out`,
/// read as a rise while rising. Without one the second move goes.
pub(crate) fn part_twins(linked: &Linked, steps: &mut [Step]) {
    for step in steps.iter_mut().filter(|step| step.with.contains(&step.movement)) {
        let main = step.movement;
        let words = linked.texts_in(step.words.unwrap_or_default());
        let motion = |movement: Move| Motion::of(movement).filter(|motion| *motion != Motion::Travel);
        let is_other = |movement: Move| {
            movement != main
                && movement.opposite() != Some(main)
                && (motion(movement).is_none() || motion(movement) != motion(main))
        };
        let mut said = WAYS
            .iter()
            .filter(|(names, movement)| is_other(*movement) && words.iter().any(|word| names.contains(word)));
        let other = said.next().map(|(_, movement)| *movement).filter(|_| said.next().is_none());
        step.with.retain(|with| *with != main);
        step.with.extend(other.filter(|other| !step.with.contains(other)));
    }
}

/// Leads from one end of a thing to the other where the words say so: `boom down, from the top of the lamp to the bottom of the lamp`.
pub(crate) fn lead_between_ends(linked: &Linked, steps: &mut [Step]) {
    let end_of = |word: &str| match word {
        "top" => Some(SubjectPart::Top),
        "bottom" => Some(SubjectPart::Bottom),
        _ => None,
    };
    let goes = |step: &&mut Step| {
        step.movement.looks_elsewhere() || matches!(Motion::of(step.movement), Some(Motion::Rise | Motion::Tilt))
    };
    for step in steps.iter_mut().filter(goes) {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let ends = words.windows(10).find_map(|ten| {
            let [from, the, first, of, thing, to, the_other, last, of_other, other] = *ten else { return None };
            let is_way = [from, the, of, to, the_other, of_other] == ["from", "the", "of", "to", "the", "of"];
            (is_way && thing == other).then_some((linked.slot_at(thing)?, end_of(first)?, end_of(last)?))
        });
        if let Some((id, first, last)) = ends.filter(|(_, first, last)| first != last) {
            let subjects = linked.expanded(&[id]);
            step.start = Framing { subjects: subjects.clone(), part: first, ..step.start.clone() };
            step.end = Framing { subjects, part: last, ..step.end.clone() };
        }
    }
}

/// Adds a move that the words say to a step that stands still but for a roll or shake: `dutch angle on the lamp, zoom in`.
fn add_lost_move(step: &mut Step, said: Move) {
    let moves = || std::iter::once(&step.movement).chain(&step.with);
    let stands = |movement: &Move| matches!(movement, Move::Static | Move::RollCw | Move::RollCcw | Move::Handheld);
    let travels = !said.looks_elsewhere() && !matches!(said, Move::TruckLeft | Move::TruckRight);
    if step.with.len() < 2 && travels && moves().all(stands) {
        let before = std::mem::replace(&mut step.movement, said);
        step.either_way = false;
        step.with.extend(Some(before).filter(|before| *before != Move::Static));
    }
}

/// The move that a verb at word `at` and the direction after it say, and the word for the other direction.
fn said_at(words: &[&str], at: usize) -> Option<(Move, &'static str)> {
    let between = words[at + 1..].iter().take_while(|word| BETWEEN.contains(word)).count();
    let direction = at + 1 + between;
    let after = words.get(direction + 1).copied().unwrap_or_default();
    let said = *words.get(direction)?;
    if between > 4 || PLACES.contains(&after) && matches!(said, "left" | "right") {
        return None;
    }
    let family = FAMILIES.iter().find(|(verbs, _)| verbs.iter().any(|verb| is_form(words[at], verb)))?.1;
    let nth = family.iter().position(|(name, _)| *name == said)?;
    Some((family[nth].1, family[1 - nth].0))
}

/// Verbs of a camera that rises or sinks, which `go up to` and `walk up to` are not.
const RISES: [&str; 6] = ["drift", "float", "rise", "climb", "ascend", "lift"];
/// Words of a way toward a thing.
const NEARS: [&str; 8] = ["in", "into", "closer", "toward", "towards", "forward", "push", "close"];

/// Makes a rise of a way that goes up to a thing: `drift up to the ladles`.
pub(crate) fn rise_to_things(linked: &Linked, steps: &mut [Step]) {
    for step in steps.iter_mut().filter(|step| step.with.is_empty() && step.via.is_none() && !step.returns) {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let rises = words.windows(3).any(|three| {
            RISES.iter().any(|verb| is_form(three[0], verb))
                && three[1] == "up"
                && matches!(three[2], "to" | "toward" | "onto" | "until")
        });
        let is_way = matches!(step.movement, Move::PushIn | Move::Follow) && step.end.size.is_none();
        if is_way && rises && !words.iter().any(|word| NEARS.contains(word)) {
            (step.movement, step.either_way) = (Move::CraneUp, false);
        }
    }
}

/// Words of a turn to one side.
const PANS: [&str; 7] = ["pan", "sweep", "swing", "turn", "whip", "swivel", "rotate"];

/// Tilts where the words say so, and nothing of the turn to a side that the network reads: `start on the vase right, then just
/// tilt up to the tv`.
pub(crate) fn tilt_as_said(linked: &Linked, steps: &mut [Step]) {
    let pans = |step: &&mut Step| matches!(step.movement, Move::PanLeft | Move::PanRight) && step.with.is_empty();
    for step in steps.iter_mut().filter(pans) {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let said = (0..words.len()).filter_map(|at| said_at(&words, at));
        let mut tilts = said.map(|(movement, _)| movement).filter(|said| matches!(said, Move::TiltUp | Move::TiltDown));
        let is_pan = words.iter().any(|word| PANS.iter().any(|verb| is_form(word, verb)));
        if let (Some(tilt), None, false) = (tilts.next(), tilts.next(), is_pan) {
            (step.movement, step.either_way) = (tilt, false);
        }
    }
}

/// Words between a turn and the side to which it leads: `a quarter turn to camera left`.
const SIDEWARD: [&str; 8] = ["camera", "cam", "the", "screen", "frame", "your", "our", "my"];
/// Words of a way round.
const ROUNDS: [&str; 10] = ["turn", "circle", "lap", "spiral", "around", "round", "it", "orbit", "arc", "loop"];

/// Gives circles the way to which their words turn, where they name one alone.
pub(crate) fn turn_to_sides(linked: &Linked, steps: &mut [Step]) {
    for nth in 0..steps.len() {
        let Some(span) = own_words(steps, nth).filter(|_| steps[nth].movement.is_circular()) else { continue };
        let words = linked.texts_in(span);
        let is_angle = |word: &str| linked.quantity_at(word).is_some_and(|q| q.kind == QuantityKind::Degrees);
        let ways: Vec<bool> = (0..words.len()).filter_map(|at| side_of_turn(&words, at, &is_angle)).collect();
        let is_left = |movement: Move| matches!(movement, Move::OrbitLeft | Move::ArcLeft);
        let ([to_left], false) = (&ways[..], words.iter().any(|word| CORRECTIONS.contains(word))) else { continue };
        let step = &mut steps[nth];
        if is_left(step.movement) != *to_left {
            step.movement = step.movement.opposite().unwrap_or(step.movement);
        }
        step.either_way = false;
    }
}

/// Whether the side at word `at`, to which a turn leads, is the left one; `None` where no turn leads to it.
fn side_of_turn(words: &[&str], at: usize, is_angle: &dyn Fn(&str) -> bool) -> Option<bool> {
    let is_left = matches!(words[at], "left" | "right").then(|| words[at] == "left")?;
    let next = words.get(at + 1).copied().unwrap_or_default();
    let links = words[..at].iter().rev().take_while(|word| SIDEWARD.contains(word)).count();
    let to = (at - links).checked_sub(1).filter(|to| matches!(words[*to], "to" | "toward" | "towards"))?;
    let turns = words[..to].iter().next_back().is_some_and(|word| ROUNDS.contains(word) || is_angle(word));
    (turns && !PLACES.contains(&next)).then_some(is_left)
}

/// Whether a word is a form of a verb: `pan`, `pans`, `panning`.
pub(crate) fn is_form(word: &str, verb: &str) -> bool {
    let stem = verb.strip_suffix('e').unwrap_or(verb);
    let ending = word.strip_prefix(stem);
    let doubled = ending.and_then(|ending| ending.strip_prefix(&stem[stem.len() - 1..]));
    [ending, doubled].into_iter().flatten().any(|ending| matches!(ending, "" | "e" | "s" | "es" | "ing"))
        && !word.ends_with("ss")
}

/// The word behind a verb at word `at`, of up to three words between them.
pub(super) fn place_behind(words: &[&str], at: usize, between: &[&str]) -> usize {
    at + 1 + words[at + 1..].iter().take(3).take_while(|word| between.contains(word)).count()
}

/// Whether some words in a row are one of the phrases.
pub(super) fn says_any(words: &[&str], phrases: &[&[&str]]) -> bool {
    (0..words.len()).any(|at| phrases.iter().any(|phrase| words[at..].starts_with(phrase)))
}

/// Verbs of a family of moves, and its moves by direction.
type Family = (&'static [&'static str], [(&'static str, Move); 2]);

const FAMILIES: [Family; 10] = [
    (&["push", "dolly"], [("in", Move::PushIn), ("out", Move::PullOut)]),
    (&["pull"], [("back", Move::PullOut), ("in", Move::PushIn)]),
    (&["pan"], [("left", Move::PanLeft), ("right", Move::PanRight)]),
    (&["tilt"], [("up", Move::TiltUp), ("down", Move::TiltDown)]),
    (&["truck", "crab"], [("left", Move::TruckLeft), ("right", Move::TruckRight)]),
    (&["pedestal"], [("up", Move::PedestalUp), ("down", Move::PedestalDown)]),
    (&["crane", "jib"], [("up", Move::CraneUp), ("down", Move::CraneDown)]),
    (&["orbit"], [("left", Move::OrbitLeft), ("right", Move::OrbitRight)]),
    (&["arc"], [("left", Move::ArcLeft), ("right", Move::ArcRight)]),
    (&["zoom"], [("in", Move::ZoomIn), ("out", Move::ZoomOut)]),
];

/// Verbs of a rise and of a descent, and words of one that stand alone.
const RISING: [&str; 7] = ["rise", "ascend", "climb", "lift", "soar", "raise", "crane"];
const SINKING: [&str; 5] = ["sink", "descend", "lower", "drop", "dip"];
const UP: &str = "up upward upwards higher";
const DOWN: &str = "down downward downwards";

/// Turns a rise beside another move into the descent that the words say, and the other way round: `circle the chair while sinking,
/// faster and faster`.
pub(crate) fn rise_or_sink(linked: &Linked, steps: &mut [Step]) {
    for step in steps {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let is_one = |verbs: &[&str], list: &str| {
            words.iter().any(|word| verbs.iter().any(|verb| is_form(word, verb)) || is_listed(list, word))
        };
        let said = match (is_one(&RISING, UP), is_one(&SINKING, DOWN)) {
            (true, false) => [Move::CraneUp, Move::PedestalUp],
            (false, true) => [Move::CraneDown, Move::PedestalDown],
            _ => continue,
        };
        let back = |second: &Move| second.opposite().filter(|opposite| said.contains(opposite));
        step.with = step.with.iter().map(|second| back(second).unwrap_or(*second)).collect();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_turn_leads_to_a_side() {
        let side = |text: &str| {
            let words: Vec<&str> = text.split(' ').collect();
            (0..words.len()).find_map(|at| side_of_turn(&words, at, &|word| word == "<qty-0>"))
        };
        assert_eq!(side("spiral up around it , about <qty-0> to camera left , ending high"), Some(true));
        assert_eq!(side("go around it to the right"), Some(false));
        assert_eq!(side("a quarter turn to the left side of <obj-0>"), None);
        assert_eq!(side("around it with <obj-1> to the left"), None);
        assert_eq!(side("the chair on the left"), None);
    }

    #[test]
    fn a_descent_leads_from_one_end_to_the_other() {
        let text = "boom down , from the top of <obj-0> to the bottom of <obj-0> , plant just in";
        let end = Framing { subjects: vec![7], ..Framing::default() };
        let mut steps = [Step { end, words: Some([0, text.len()]), ..Step::of(Move::PedestalDown) }];
        lead_between_ends(&super::super::fixture::linked(text), &mut steps);
        let [start, end] = [&steps[0].start, &steps[0].end];
        assert_eq!((&start.subjects[..], start.part), (&[5][..], SubjectPart::Top));
        assert_eq!((&end.subjects[..], end.part), (&[5][..], SubjectPart::Bottom));
    }

    #[test]
    fn what_sinks_beside_a_circle_does_not_rise() {
        let second = |text: &str, second: Move| {
            let linked = crate::said::fixture::linked(text);
            let mut steps = [Step { with: vec![second], words: Some([0, text.len()]), ..Step::of(Move::OrbitRight) }];
            rise_or_sink(&linked, &mut steps);
            steps[0].with[0]
        };
        assert_eq!(second("circle <obj-0> while sinking , faster and faster", Move::CraneUp), Move::CraneDown);
        assert_eq!(second("rise as you circle <obj-0>", Move::PedestalDown), Move::PedestalUp);
        assert_eq!(second("sink , then rise around <obj-0>", Move::CraneUp), Move::CraneUp);
        assert_eq!(second("circle <obj-0> while sinking", Move::PushIn), Move::PushIn);
    }
}

//! Ways round a subject, from one side of it to another: `in profile, drift round to the front`.

use cinesplat_language::{Linked, is_listed};
use cinesplat_operator::{Amount, Step, SubjectSide};
use cinesplat_trajectory::Move;

use super::directions::is_form;
use super::facing::are_face_to_face;

/// Words that lead around.
const AROUND: [&str; 5] = ["round", "around", "over", "across", "about"];
/// Words between them and the side.
const BETWEEN: [&str; 6] = ["to", "the", "its", "his", "her", "their"];
/// Sides by their words.
const SIDES: [(&[&str], SubjectSide); 3] = [
    (&["front", "face"], SubjectSide::FromFront),
    (&["back", "rear"], SubjectSide::FromBack),
    (&["profile"], SubjectSide::FromSide),
];

/// Ends a way round its subject at the side that the words lead to, and goes round where a picture that rests would be seen
/// from two sides.
pub(crate) fn go_round_to_sides(linked: &Linked, steps: &mut [Step]) {
    for step in steps {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let is_own = |word: &str| linked.stands_for(word, &step.end.subjects);
        let circles = step.movement.is_circular();
        if let Some(side) = side_of_end(&words, &is_own).filter(|_| circles && step.amount.is_none()) {
            step.end.side = Some(side);
            if let Some(first) = side_of_start(&words) {
                step.start.side = Some(first);
            }
        }
        // A three-quarter view is half way between two sides.
        let is_quarter = words.windows(2).any(|two| matches!(two, ["three", "quarter" | "quarters"]));
        if circles && is_quarter && step.amount.is_none() {
            (step.amount, step.end.side) = (Some(Amount::Degrees(45.0)), None);
        }
        let meets = meets_us(&words) && (circles || step.movement == Move::Static && step.start.side.is_some());
        // The side that it is seen from before is no end.
        let is_open =
            step.end.side.is_none() || !words.iter().any(|word| is_listed("side sides profile back rear", word));
        if meets && is_open && !matches!(step.amount, Some(Amount::Degrees(_))) {
            step.end.side = Some(SubjectSide::FromFront);
            // `We find it from behind. Come round until it grins at us.`
            let until = words.iter().position(|word| UNTIL.contains(word)).unwrap_or(0);
            if step.start.side.is_none() && is_from_behind(&words[..until]) {
                step.start.side = Some(SubjectSide::FromBack);
            }
        }
        let from_to = from_side_to_side(&words, &is_own).filter(|_| circles);
        if let Some([first, last]) = profiles(&words).or(from_to) {
            (step.start.side, step.end.side) = (Some(first), Some(last));
        }
        let is_turned = step.start.side.is_some() && step.end.side.is_some() && step.start.side != step.end.side;
        if step.movement == Move::Static && step.with.is_empty() && is_turned {
            (step.movement, step.either_way) = (Move::OrbitRight, true);
        }
        if step.movement != Move::Static && step.start.side.is_some() && step.start.subjects.is_empty() {
            step.start.subjects.clone_from(&step.end.subjects);
        }
    }
}

/// Sees a subject from between two sides where the words say so: `a three-quarter view` reads `from the front quarterwise`.
pub(crate) fn see_obliquely(linked: &Linked, steps: &mut [Step]) {
    for step in steps.iter_mut().filter(|step| linked.texts_in(step.words.unwrap_or_default()).contains(&"quarterwise"))
    {
        for framing in [&mut step.start, &mut step.end] {
            framing.side = framing.side.map(|side| match side {
                SubjectSide::FromFront => SubjectSide::FromFrontQuarter,
                SubjectSide::FromBack => SubjectSide::FromBackQuarter,
                other => other,
            });
        }
        // A straight way in from another thing ends on no other side than it comes from.
        let is_other = !step.start.subjects.is_empty() && step.start.subjects != step.end.subjects;
        if step.movement == Move::PushIn && is_other && step.end.side.is_some() {
            step.movement = Move::Follow;
        }
        let is_open = [&step.start, &step.end].iter().all(|framing| framing.side.is_none());
        if is_open && !step.movement.is_circular() {
            let is_first = step.end.subjects.is_empty() && !step.start.subjects.is_empty();
            let framing = if is_first { &mut step.start } else { &mut step.end };
            framing.side = Some(SubjectSide::FromFrontQuarter);
        }
    }
}

/// Whether words are about a view from the back.
fn is_from_behind(words: &[&str]) -> bool {
    let behind = |at: usize| words[at] == "behind" || matches!(words[at], "back" | "rear") && words[at - 1] == "the";
    (1..words.len()).any(|at| behind(at) && words[at.saturating_sub(2)..at].contains(&"from"))
}

/// Words until when one goes round, words of looking at somebody, and who is looked at.
const UNTIL: [&str; 7] = ["until", "till", "til", "'til", "untill", "so", "where"];
const LOOKS: [&str; 23] = [
    "stare", "stares", "staring", "look", "looks", "looking", "face", "faces", "facing", "point", "points", "meet",
    "meets", "gaze", "gazes", "glares", "glaring", "grin", "grins", "grinning", "smile", "smiles", "smiling",
];
const US: [&str; 8] = ["us", "camera", "me", "you", "lens", "viewer", "ours", "viewers"];

/// Whether words go on until the subject and the camera look at each other: `till it's staring straight at us`, `until we're
/// facing it`.
fn meets_us(words: &[&str]) -> bool {
    (0..words.len()).filter(|at| UNTIL.contains(&words[*at])).any(|at| {
        let behind = &words[at + 1..words.len().min(at + 9)];
        // `Until we are face to face`.
        if are_face_to_face(behind) {
            return true;
        }
        let looks = behind.iter().position(|word| LOOKS.contains(word));
        let Some(looks) = looks.filter(|looks| *looks < 5) else { return false };
        let by_us = behind[..looks].iter().any(|word| matches!(*word, "we" | "you" | "i"));
        let at_us = behind[looks + 1..].iter().take(4).any(|word| US.contains(word));
        let face = behind[looks] == "face" || behind[looks] == "facing";
        // `Until we look at the door` is another picture.
        by_us && face && behind[looks + 1..].iter().take(2).any(|word| matches!(*word, "it" | "him" | "her" | "them"))
            || !by_us && at_us
    })
}

/// The first and the last of several profiles: `profile from left, then front, then profile from right`. `None` where they
/// are one side.
fn profiles(words: &[&str]) -> Option<[SubjectSide; 2]> {
    let side_of = |word: &&str| match *word {
        "left" => Some(SubjectSide::FromLeft),
        "right" => Some(SubjectSide::FromRight),
        _ => None,
    };
    let side_at = |at: usize| {
        let before = at.checked_sub(1).and_then(|before| side_of(&words[before]));
        let mut after = words[at + 1..].iter().take(3).skip_while(|word| ["from", "the"].contains(word));
        before.or_else(|| after.next().and_then(side_of))
    };
    let mut sides = (0..words.len()).filter(|at| words[*at] == "profile").filter_map(side_at);
    let first = sides.next()?;
    sides.next_back().filter(|last| *last != first).map(|last| [first, last])
}

/// The sides of a way round from one to the other: `from the front to the rear`. `is_own` tells the subject.
fn from_side_to_side(words: &[&str], is_own: &dyn Fn(&str) -> bool) -> Option<[SubjectSide; 2]> {
    let is_link =
        |word: &&&str| BETWEEN.contains(*word) || matches!(**word, "of" | "all" | "way" | "right") || is_own(word);
    // The side that the words after word `at` lead to, and its place.
    let side_behind = |at: usize| {
        let num_links = words[at + 1..].iter().take(8).take_while(is_link).count();
        let place = at + 1 + num_links;
        let name = words.get(place)?;
        let is_end = words.get(place + 1).is_none_or(|word| {
            matches!(*word, "to" | "side" | "of" | "," | "." | ";" | "all" | "and" | "then" | "in" | "while" | "with")
        });
        let named = SIDES.iter().find(|(names, _)| names.contains(name)).map(|(_, side)| *side);
        let side = named.or(match *name {
            "left" => Some(SubjectSide::FromLeft),
            "side" => Some(SubjectSide::FromSide),
            _ => None,
        });
        // `To the right side`: `right` may only strengthen what follows.
        let is_right = *name == "side" && words[place - 1] == "right";
        let side = if is_right { Some(SubjectSide::FromRight) } else { side };
        Some((place + usize::from(words.get(place + 1) == Some(&"side")), side.filter(|_| is_end)?))
    };
    let mut pairs = (0..words.len()).filter(|at| words[*at] == "from").filter_map(|from| {
        let (first_at, first) = side_behind(from)?;
        let num_links = words[first_at + 1..].iter().take(8).take_while(is_link).count();
        let leads = words[first_at + 1..first_at + 1 + num_links].contains(&"to");
        let (_, last) = side_behind(first_at).filter(|_| leads)?;
        (first != last).then_some([first, last])
    });
    pairs.next().filter(|_| pairs.next().is_none())
}

/// The side that the words go round to; `None` where they name none or several. `is_own` tells the subject.
fn side_of_end(words: &[&str], is_own: &dyn Fn(&str) -> bool) -> Option<SubjectSide> {
    let leads_round = |at: &usize| AROUND.contains(&words[*at]) || is_circle(words[*at]);
    let mut sides = (0..words.len()).filter(leads_round).filter_map(|at| {
        let links = words[at + 1..].iter().take(3).take_while(|word| BETWEEN.contains(word)).count();
        let leads = words[at + 1..at + 1 + links].contains(&"to");
        let name = words.get(at + 1 + links)?;
        // `To the front of the room` is a place.
        let of = words.get(at + 2 + links).is_some_and(|word| *word == "of");
        let is_place = of && !words[at + 3 + links..].iter().take(2).any(|word| is_own(word));
        let side = SIDES.iter().find(|(names, _)| names.contains(name)).map(|(_, side)| *side)?;
        (leads && !is_place).then_some(side)
    });
    sides.next().filter(|_| sides.next().is_none())
}

/// Verbs of a way round its subject.
const CIRCLES: [&str; 8] = ["arc", "orbit", "circle", "swing", "come", "sweep", "swivel", "revolve"];

fn is_circle(word: &str) -> bool {
    CIRCLES.iter().any(|verb| is_form(word, verb))
}

/// The side that the words name before the way round begins: `start on its profile, arc to the front`. `None` where they name
/// none or several.
fn side_of_start(words: &[&str]) -> Option<SubjectSide> {
    let circle = words.iter().position(|word| is_circle(word) || AROUND.contains(word))?;
    let named = |word: &&str| match *word {
        "profile" | "side" => Some(SubjectSide::FromSide),
        "back" | "rear" | "behind" => Some(SubjectSide::FromBack),
        "front" | "frontal" => Some(SubjectSide::FromFront),
        _ => None,
    };
    let mut sides = words[..circle].iter().filter_map(named);
    sides.next().filter(|_| sides.next().is_none())
}

#[cfg(test)]
mod tests {
    use super::super::fixture::{about, linked};
    use super::*;

    #[test]
    fn a_three_quarter_view_is_between_two_sides() {
        let side = |text: &str, movement: Move, said: Option<SubjectSide>| {
            let mut step = about(movement, &[5], [0, text.len()]);
            step.end.side = said;
            let mut steps = [step];
            see_obliquely(&linked(text), &mut steps);
            (steps[0].end.side, steps[0].movement)
        };
        let text = "<obj-0> from the front quarterwise";
        assert_eq!(side(text, Move::PushIn, None), (Some(SubjectSide::FromFrontQuarter), Move::PushIn));
        let back = (Some(SubjectSide::FromBackQuarter), Move::Static);
        assert_eq!(side(text, Move::Static, Some(SubjectSide::FromBack)), back);
        assert_eq!(side("<obj-0> from the front", Move::PushIn, None), (None, Move::PushIn));
    }

    #[test]
    fn a_way_round_ends_at_the_side_that_is_named() {
        let side = |text: &str| side_of_end(&text.split(' ').collect::<Vec<_>>(), &|word| word == "<obj-0>");
        assert_eq!(side("drift round to the front over <qty-0>"), Some(SubjectSide::FromFront));
        assert_eq!(side("circle around to its back"), Some(SubjectSide::FromBack));
        assert_eq!(side("round to the front of <obj-0>"), Some(SubjectSide::FromFront));
        assert_eq!(side("arc to the front until we are face to face"), Some(SubjectSide::FromFront));
        assert_eq!(side("go round the front"), None);
        assert_eq!(side("go around to the front of <obj-1>"), None);
        assert_eq!(side("round to the front then round to the back"), None);
    }

    #[test]
    fn a_way_round_leads_from_the_first_side_to_the_second() {
        let sides = |text: &str| from_side_to_side(&text.split(' ').collect::<Vec<_>>(), &|word| word == "<obj-0>");
        let rear = Some([SubjectSide::FromFront, SubjectSide::FromBack]);
        assert_eq!(sides("orbit <obj-0> from the front to the rear ,"), rear);
        assert_eq!(sides("from the front of <obj-0> all the way to its back"), rear);
        assert_eq!(sides("from the left side to the back"), Some([SubjectSide::FromLeft, SubjectSide::FromBack]));
        assert_eq!(sides("from the front of <obj-1> to the rear"), None);
        assert_eq!(sides("from the front"), None);
        assert_eq!(sides("from left to <obj-0>"), None);
    }

    #[test]
    fn a_way_round_ends_where_both_look_at_each_other() {
        let meets = |text: &str| meets_us(&text.split(' ').collect::<Vec<_>>());
        assert!(meets("orbit round till it 's staring straight at us"));
        assert!(meets("come round until it is grinning straight at us"));
        let behind = |text: &str| is_from_behind(&text.split(' ').collect::<Vec<_>>());
        assert!(behind("we find it from behind .") && behind("seen from the back") && !behind("come back from there"));
        assert!(meets("circle until <obj-0> is facing the camera"));
        assert!(meets("go round until we 're facing it"));
        assert!(meets("arc round until it looks right at you"));
        assert!(meets("come round till we are face to face"));
        assert!(meets("swing to the front so its eye holes meet the lens"));
        assert!(!meets("orbit until we look at <obj-1>"));
        assert!(!meets("orbit <obj-0> facing it"));
    }

    #[test]
    fn a_way_round_begins_at_the_side_that_is_named_before_it() {
        let side = |text: &str| side_of_start(&text.split(' ').collect::<Vec<_>>());
        assert_eq!(side("start on its profile , arc to the front"), Some(SubjectSide::FromSide));
        assert_eq!(side("arc to the front"), None);
        assert_eq!(side("from the front or the side , arc to the back"), None);
    }

    #[test]
    fn profiles_are_seen_from_the_sides_that_are_named() {
        let sides = |text: &str| profiles(&text.split(' ').collect::<Vec<_>>());
        let both = Some([SubjectSide::FromLeft, SubjectSide::FromRight]);
        assert_eq!(sides("profile from left , then front , then profile from the right"), both);
        assert_eq!(sides("left profile then right profile"), both);
        assert_eq!(sides("profile from left"), None);
        assert_eq!(sides("left profile , then profile from left"), None);
    }
}

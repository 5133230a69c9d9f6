//! Where the camera stands and how it sees its subject when the film begins: `start at the window looking in`, `low, front of
//! the car`.

use cinesplat_language::{Linked, is_listed};
use cinesplat_operator::{Framing, Pass, Step, SubjectSide, Via};
use cinesplat_trajectory::{Move, ShotAngle, ShotSize};

use super::openings::OPENS;

/// Words of a place, before what stands there.
const AT: [&str; 8] = ["at", "in", "by", "beside", "inside", "near", "from", "on"];
/// Words that look away from it.
const INWARD: [&str; 7] = ["in", "inside", "inward", "inwards", "out", "back", "into"];

/// Stands at the thing from which the words look at something else.
pub(crate) fn stand_at_opening(linked: &Linked, steps: &mut [Step]) {
    let Some(step) = steps.first_mut() else { return };
    let words = linked.texts_in(step.words.unwrap_or_default());
    let place_at = |at: usize| {
        let id = linked.slot_at(words[at])?;
        let opens = words[..at].iter().rev().take(4).any(|word| OPENS.contains(word) || *word == "standing");
        let is_at = words[..at].iter().rev().find(|word| **word != "the").is_some_and(|word| AT.contains(word));
        let looks = words.get(at + 1).is_some_and(|word| matches!(*word, "looking" | "facing" | "peering" | "gazing"));
        let way = words.get(at + 2).copied().unwrap_or_default();
        let mut behind = words[at + 1..].iter().skip(1).take(3);
        let sees =
            if INWARD.contains(&way) { Some(None) } else { behind.find_map(|word| linked.slot_at(word)).map(Some) };
        (opens && is_at && looks).then_some(()).and(sees).map(|seen| (id, seen))
    };
    let Some((id, seen)) = (0..words.len()).find_map(place_at) else { return };
    let place = linked.expanded(&[id]);
    if step.end.subjects == place && step.movement != Move::Static {
        return;
    }
    if step.start.subjects == place {
        step.start = Framing::default();
    }
    if step.end.subjects == place {
        step.end = Framing::default();
    }
    let seen = seen.map(|seen| linked.expanded(&[seen])).unwrap_or_default();
    let framing = if step.movement == Move::Static { &mut step.end } else { &mut step.start };
    if framing.subjects.is_empty() && step.movement != Move::PushIn {
        framing.subjects = seen;
    }
    step.via = Some(Via { how: Pass::From, objects: place });
}

/// Words of a picture of a place as a whole, and the place.
const WIDES: &str = "wide establishing establish establisher establishment master overview panorama long";
const ROOMS: &str = "room bedroom kitchen studio office place space whole entire scene flat apartment house living sitting dining shot view \
    picture of the a an our my";

/// Stands at the thing from which the film opens on the room: `a wide shot of the bedroom from the door`.
pub(crate) fn stand_where_wide(linked: &Linked, steps: &mut [Step]) {
    let Some(step) = steps.first_mut() else { return };
    let words = linked.texts_in(step.words.unwrap_or_default());
    let place_at = |at: usize| {
        let named = words[at + 1..].iter().take(3).find(|word| !is_listed("the our my a that", word))?;
        let id = linked.slot_at(named)?;
        let mut before = words[..at].iter().rev().skip_while(|word| is_listed(ROOMS, word));
        (words[at] == "from" && before.next().is_some_and(|word| is_listed(WIDES, word))).then_some(id)
    };
    let Some(id) = (0..words.len()).find_map(place_at) else { return };
    let place = linked.expanded(&[id]);
    let is_only = |framing: &Framing| framing.subjects.is_empty() || framing.subjects == place;
    if !is_only(&step.start) || !is_only(&step.end) {
        return;
    }
    let size = step.start.size.or(step.end.size).or(Some(ShotSize::ExtremeLong));
    *step = Step { words: step.words, duration_secs: step.duration_secs, speed: step.speed, ..Step::of(Move::Static) };
    step.end.size = size;
    step.via = Some(Via { how: Pass::From, objects: place });
}

/// Stands at the thing from whose side a picture at rest is seen: `a wide of the room from the tv side`.
pub(crate) fn stand_at_side(linked: &Linked, steps: &mut [Step]) {
    for step in steps.iter_mut().filter(|step| step.movement == Move::Static) {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let Some(via) = step.via.as_mut().filter(|via| via.how == Pass::Past) else { continue };
        let place = linked.expanded(&via.objects);
        let leads_from = |at: usize| {
            let next = at + 1 + usize::from(words.get(at + 1) == Some(&"the"));
            words[at] == "from" && words.get(next).is_some_and(|word| linked.stands_for(word, &place))
        };
        if (0..words.len()).any(leads_from) {
            via.how = Pass::From;
        }
    }
}

/// Begins a way in a picture from the side of the room where a thing stands: `start wide from the fireplace side of the room, glide to the
/// bottle` begins with no picture of the fireplace.
pub(crate) fn begin_at_side(linked: &Linked, steps: &mut [Step]) {
    for step in steps.iter_mut().filter(|step| step.movement != Move::Static) {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let side_at = |at: usize| match words.get(at..at + 4)? {
            ["from", "the", thing, "side" | "end"] => Some(linked.expanded(&[linked.slot_at(thing)?])),
            _ => None,
        };
        let Some(place) = (0..words.len()).find_map(side_at) else { continue };
        let shows = step.start.subjects == place && step.end.subjects != place;
        if shows && step.via.as_ref().is_none_or(|via| via.how == Pass::Past) {
            step.start = Framing::default();
            step.via = Some(Via { how: Pass::From, objects: place });
        }
    }
}

/// Sees a thing from the side of it at which the words stand: `a wide shot of the bed from the foot end` reads `.. from the front of
/// the bed`.
pub(crate) fn see_from_own_end(linked: &Linked, steps: &mut [Step]) {
    for step in steps.iter_mut().filter(|step| step.movement == Move::Static) {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let end_at = |at: usize| {
            let ["from", "the", end, "of", thing] = words.get(at..at + 5)? else { return None };
            let side = SIDES.iter().find(|(names, _)| names.contains(end)).map(|(_, side)| *side)?;
            Some((side, linked.expanded(&[linked.slot_at(thing)?])))
        };
        let Some((side, of)) = (0..words.len()).find_map(end_at) else { continue };
        let named_first = words.iter().find_map(|word| linked.slot_at(word)).map(|id| linked.expanded(&[id]));
        if step.end.subjects != of || named_first != Some(of.clone()) || step.end.side.is_some() {
            continue;
        }
        step.end.side = Some(side);
        if step.start.subjects == of {
            step.start = Framing::default();
        }
        step.via = step.via.take().filter(|via| via.objects != of);
    }
}

/// Sides by their words.
const SIDES: [(&[&str], SubjectSide); 3] = [
    (&["front", "nose", "face"], SubjectSide::FromFront),
    (&["back", "rear", "tail"], SubjectSide::FromBack),
    (&["side", "profile"], SubjectSide::FromSide),
];
const ANGLES: [(&str, ShotAngle); 3] =
    [("low", ShotAngle::Low), ("high", ShotAngle::High), ("overhead", ShotAngle::Overhead)];
/// Words that may stand before a side that opens a picture.
const BEFORE: [&str; 12] =
    [",", "low", "high", "the", "wide", "close", "tight", "medium", ":", "start", "begin", "open"];

/// Opens on a side of the subject that the words name before any move: `low, front of the car, creeping in`.
pub(crate) fn open_on_sides(linked: &Linked, steps: &mut [Step]) {
    for step in steps {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let Some((side, id, at)) = side_of(linked, &words) else { continue };
        let ids = linked.expanded(&[id]);
        let angle = ANGLES.iter().find(|(name, _)| words[..at].contains(name)).map(|(_, angle)| *angle);
        let rests = step.movement == Move::Static;
        let mut framing = if rests { step.end.clone() } else { step.start.clone() };
        let shows = framing.subjects == ids || framing.subjects.is_empty() && step.end.subjects == ids;
        if !shows {
            continue;
        }
        framing.subjects.clone_from(&ids);
        framing.side = Some(side);
        framing.angle = framing.angle.or(angle.filter(|_| step.end.angle.is_none() || !rests));
        if rests {
            step.end = framing;
        } else {
            // Of a way round, the side of its end is another one.
            step.start = framing;
        }
    }
}

/// The side that the words begin with, whose it is, and where they say it.
fn side_of(linked: &Linked, words: &[&str]) -> Option<(SubjectSide, u32, usize)> {
    let said = (0..words.len()).take(8).find_map(|at| {
        let side = SIDES.iter().find(|(names, _)| names.contains(&words[at])).map(|(_, side)| *side)?;
        let of = words.get(at + 1).is_some_and(|word| *word == "of");
        let id = words[at + 1..].iter().skip(1).take(2).find_map(|word| linked.slot_at(word))?;
        of.then_some((side, id, at))
    });
    let from = words.iter().enumerate().take(14).find_map(|(at, word)| {
        let id = linked.slot_at(word)?;
        let name = words.get(at + 1..at + 4).filter(|next| next[..2] == ["from", "the"])?[2];
        let side = SIDES[..2].iter().find(|(names, _)| names.contains(&name)).map(|(_, side)| *side)?;
        let is_shot = at > 1 && words[at - 1] == "of" && words[at - 2] == "shot";
        let ends = words.get(at + 4).is_none_or(|word| matches!(*word, "," | "." | ";" | "then" | "and"));
        (is_shot && ends).then_some((side, id, at))
    });
    said.filter(|(_, _, at)| words[..*at].iter().all(|word| BEFORE.contains(word))).or(from)
}

#[cfg(test)]
mod tests {
    use super::super::fixture::{about, linked};
    use super::*;

    #[test]
    fn a_way_from_a_side_of_the_room_shows_nothing_of_it() {
        let first = |text: &str| {
            let mut step = about(Move::PushIn, &[7], [0, text.len()]);
            step.start.subjects = vec![5];
            begin_at_side(&linked(text), std::slice::from_mut(&mut step));
            (step.start.subjects, step.via)
        };
        let from = Some(Via { how: Pass::From, objects: vec![5] });
        assert_eq!(first("start wide from the <obj-0> side of the room , glide on to <obj-1>"), (Vec::new(), from));
        assert_eq!(first("start on <obj-0> , glide on to <obj-1>"), (vec![5], None));
    }

    #[test]
    fn a_wide_shot_of_the_room_from_a_door_stands_there() {
        let first = |text: &str| {
            let mut step = about(Move::PushIn, &[], [0, text.len()]);
            step.start.subjects = vec![5];
            stand_where_wide(&linked(text), std::slice::from_mut(&mut step));
            step
        };
        for text in ["begin with a wide shot of the bedroom from <obj-0>", "establishing from the <obj-0>"] {
            let step = first(text);
            assert_eq!(step.via, Some(Via { how: Pass::From, objects: vec![5] }), "{text}");
            assert_eq!((step.movement, &step.end.subjects[..]), (Move::Static, &[][..]), "{text}");
        }
        assert_eq!(first("a wide shot , then go from <obj-0> to the window").via, None);
        assert_eq!(first("pull back from <obj-0> to a wide shot").via, None);
    }

    #[test]
    fn an_end_of_a_thing_is_the_side_from_which_it_is_seen() {
        let text = "wide shot of <obj-0> from the front of <obj-0>";
        let mut step = about(Move::Static, &[5], [0, text.len()]);
        step.via = Some(Via { how: Pass::From, objects: vec![5] });
        see_from_own_end(&linked(text), std::slice::from_mut(&mut step));
        assert_eq!((step.end.side, step.via), (Some(SubjectSide::FromFront), None));
    }
}

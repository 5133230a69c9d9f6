//! The sides and parts of the one thing of a scan that a message wants seen: `the face first, then teeth and jaw, round the
//! side, and down on the top of it`.

use cinesplat_language::{Linked, is_listed, part_of};
use cinesplat_objects::Object;
use cinesplat_operator::{Amount, Framing, Speed, Step, SubjectPart, SubjectSide};
use cinesplat_trajectory::{Move, ShotAngle, ShotSize};

use super::text::{Text, is_object};
use super::things::Things;

/// A view of the thing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum View {
    Front,
    Side,
    /// Both sides, and with them all of it.
    Sides,
    Back,
    Top,
    /// Down on its top.
    Overhead,
    Middle,
    Bottom,
    Whole,
    /// All of it from its front.
    WholeFront,
    /// A part that is an object of its own.
    Part(u32),
}

/// Words of some views, which no list of parts has for every thing.
const FACES: &str = "face faces";
const STEMS: &str = "trunk stem stalk";
const OF_ALL: &str = "whole full entire complete";
const WHOLES: &str = "thing plant guitar skull robot figure object piece palm one";
/// Share of the height of the frame of the thing from its front.
const FRONT_SHARE: f64 = 0.85;

/// Words of a film that goes on for ever.
const LOOPS: &str = "loop loops looped looping loopable seamless seamlessly endless endlessly";
/// Words of the two ends of a film, and of what they are.
const FIRSTS: &str = "first opening start starts started begin begins began beginning";
const LASTS: &str = "last closing final end ends ending finish finishes finishing";
const SAME: &str = "same matches match matching identical equals";

/// Whether a word is one of a film that goes on for ever.
pub(super) fn is_of_loop(word: &str) -> bool {
    is_listed(LOOPS, word)
}

/// Whether words end the film as it began: `loops so the last frame matches the first`.
pub(super) fn loops(text: &Text<'_>) -> bool {
    let words = &text.words;
    let has = |range: std::ops::Range<usize>, list: &str| text.has(range, list);
    let joins = |at: usize| {
        let sentence = text.sentence(at);
        let is_back = words[at] == "where" && has(sentence.start..at, LASTS) && has(at..sentence.end, FIRSTS);
        let are_same = is_listed(SAME, words[at])
            && has(sentence.clone(), "first opening beginning start")
            && has(sentence, "last closing final");
        is_back || are_same
    };
    (0..words.len()).any(|at| is_listed(LOOPS, words[at]) && !text.is_denied(at) || joins(at))
}

/// The film of a thing that goes on for ever: all round it, with all of it in the picture.
pub(super) fn loop_steps(thing: &Object, speed: Speed) -> Vec<Step> {
    let end = Framing { subjects: vec![thing.id], whole: true, ..Framing::default() };
    let round = Step::of(Move::OrbitRight);
    vec![Step { end, amount: Some(Amount::Degrees(360.0)), either_way: true, speed, ..round }]
}

/// The views of the thing that the words want, in order.
pub(super) fn views(text: &Text<'_>, linked: &Linked, thing: &Object, things: &Things<'_>) -> Vec<View> {
    let mut views: Vec<View> = Vec::new();
    // `The strings side, not the back.`
    for at in (0..text.words.len()).filter(|at| !text.is_likeness(*at) && !text.is_denied(*at)) {
        let Some(view) = view_at(text, linked, thing, things, at) else { continue };
        // `The carving at the very top` says where the carving is.
        let place = text.words[at.saturating_sub(3)..at].iter().any(|word| is_listed("at on near", word));
        let is_place = place
            && matches!(views.last(), Some(View::Part(_)))
            && matches!(view, View::Top | View::Middle | View::Bottom);
        let is_known = is_place || views.last() == Some(&view) || view != View::Whole && views.contains(&view);
        if !is_known {
            views.push(view);
        }
    }
    // `The whole thing from the front first`.
    if matches!(views[..], [View::Whole, View::Front, ..]) {
        views.remove(0);
    }
    views
}

fn view_at(text: &Text<'_>, linked: &Linked, thing: &Object, things: &Things<'_>, at: usize) -> Option<View> {
    let words = &text.words;
    let before = |n: usize| at.checked_sub(n).map_or("", |at| words[at]);
    if is_object(words[at]) {
        let span = linked.spans.get(at)?;
        let behind = text.slice(text.behind(at));
        let faces = behind.windows(2).any(|two| matches!(two, ["facing", "us"] | ["the", "front"] | ["head", "on"]));
        let is_whole = linked.wholes.contains(span) || before(1) == "whole" || before(1) == "full";
        if is_whole {
            return Some(if faces { View::WholeFront } else { View::Whole });
        }
        if before(1) == "of" && is_listed("side sides", before(2)) {
            return None;
        }
        if before(1) == "of"
            && let Some(view) = of_place(before(2), &words[..at])
        {
            return Some(view);
        }
        let id = linked.slot_at(words[at])?;
        return things.get(id).filter(|object| object.parent == Some(thing.id)).map(|object| View::Part(object.id));
    }
    let is_named =
        is_listed("the its his her both that those these and long lovely your", before(1)) || before(2) == "the";
    if is_listed(FACES, words[at]) && is_named {
        return Some(things.part(thing.id, "head").map_or(View::Front, View::Part));
    }
    if is_listed(STEMS, words[at]) {
        return Some(View::Middle);
    }
    if is_listed("side sides", words[at]) && is_named {
        let are_both = words[at] == "sides" || before(1) == "both" || before(1) == "each";
        return Some(if are_both { View::Sides } else { View::Side });
    }
    if is_listed(WHOLES, words[at]) && is_listed(OF_ALL, before(1)) {
        return Some(View::Whole);
    }
    // Behind it stands the thing itself.
    if words.get(at + 1) == Some(&"of") && words.get(at + 2).is_some_and(|word| is_object(word)) {
        return None;
    }
    if words[at] == "top" && is_named {
        return of_place("top", &words[..at]);
    }
    let place = part_of(words[at], &thing.label).ok().flatten()?;
    of_place(place.place, &words[..at]).filter(|_| is_named)
}

/// The view of a place of the thing, with the words before it.
fn of_place(place: &str, before: &[&str]) -> Option<View> {
    let is_down =
        before.windows(2).rev().take(5).any(|two| matches!(two, ["down", "on" | "onto" | "at"] | ["from", "above"]));
    Some(match place {
        "front" => View::Front,
        "back" => View::Back,
        "left" | "right" => View::Side,
        "top" if is_down => View::Overhead,
        "top" => View::Top,
        "bottom" => View::Bottom,
        "middle" => View::Middle,
        _ => return None,
    })
}

/// The film of some views.
pub(super) fn steps(views: &[View], thing: &Object, things: &Things<'_>, speed: Speed) -> Vec<Step> {
    let step = |(nth, view): (usize, &View)| {
        let before = nth.checked_sub(1).map(|before| views[before]);
        Step { speed, ..step_to(*view, before, thing, things) }
    };
    views.iter().enumerate().map(step).collect()
}

/// The step that leads to a view.
fn step_to(view: View, before: Option<View>, thing: &Object, things: &Things<'_>) -> Step {
    let whole = Framing { subjects: vec![thing.id], whole: true, ..Framing::default() };
    let close = |id: u32, part: SubjectPart| Framing {
        subjects: vec![id],
        part,
        size: Some(ShotSize::CloseUp),
        ..Framing::default()
    };
    let of = |movement: Move, end: Framing| Step { end, ..Step::of(movement) };
    let around = |side: SubjectSide| Step {
        either_way: true,
        ..of(Move::ArcRight, Framing { side: Some(side), ..whole.clone() })
    };
    let nears = match before {
        Some(View::Top) => Move::PedestalDown,
        // From one close picture to another.
        Some(View::Part(_)) => Move::Follow,
        _ => Move::PushIn,
    };
    match view {
        View::Front if before.is_none() => Step {
            start: Framing { side: Some(SubjectSide::FromFront), ..whole.clone() },
            end: Framing {
                side: Some(SubjectSide::FromFront),
                whole: false,
                height_frac: Some(FRONT_SHARE),
                ..whole.clone()
            },
            ..Step::of(Move::PushIn)
        },
        View::Front => around(SubjectSide::FromFront),
        View::Back => around(SubjectSide::FromBack),
        View::Side => around(SubjectSide::FromSide),
        View::Sides => Step { amount: Some(Amount::Degrees(360.0)), either_way: true, ..of(Move::OrbitRight, whole) },
        View::Overhead => of(Move::CraneUp, Framing { angle: Some(ShotAngle::Overhead), ..whole }),
        View::Top => match (things.part(thing.id, "crown leaves"), things.part(thing.id, "neck head top")) {
            (Some(crown), _) => of(Move::PushIn, close(crown, SubjectPart::Middle)),
            (_, Some(neck)) => of(Move::PushIn, close(neck, SubjectPart::Top)),
            _ => of(Move::PushIn, close(thing.id, SubjectPart::Top)),
        },
        View::Middle => match things.part(thing.id, "crown leaves") {
            Some(crown) => of(nears, close(crown, SubjectPart::Bottom)),
            None => of(nears, close(thing.id, SubjectPart::Middle)),
        },
        View::Bottom => of(nears, close(thing.id, SubjectPart::Bottom)),
        View::Part(id) => of(nears, close(id, SubjectPart::Middle)),
        View::WholeFront => of(Move::PullOut, Framing { side: Some(SubjectSide::FromFront), ..whole }),
        View::Whole if before.is_none() => of(Move::PushIn, whole),
        View::Whole => of(Move::PullOut, whole),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    fn found(text: &str, label: &str) -> Vec<View> {
        let thing = Object::from_box(1, label, DVec3::ZERO, DVec3::ONE);
        let objects = vec![thing.clone()];
        let linked = Linked {
            tokens_text: text.to_owned(),
            slots: vec![1],
            spans: text.split(' ').enumerate().map(|(at, _)| [at, at]).collect(),
            ..Linked::default()
        };
        views(&Text::of(&linked), &linked, &thing, &Things::new(&objects))
    }

    #[test]
    fn a_lecture_visits_the_views_of_a_skull() {
        let text = "they should meet the face first , then the bottom of <obj-0> and the bottom of <obj-0> , then round the \
                    side by <obj-0> , and we ought to be looking down on the top of it";
        assert_eq!(found(text, "skull"), [View::Front, View::Bottom, View::Side, View::Overhead]);
    }

    #[test]
    fn a_shop_shows_the_leaves_and_the_whole_plant() {
        let text =
            "so get in amongst those long leaves , but also that lovely knobbly trunk . leave them with the full plant";
        assert_eq!(found(text, "palm"), [View::Top, View::Middle, View::Whole]);
    }

    #[test]
    fn what_is_denied_is_no_view_and_the_whole_from_the_front_is_one() {
        assert_eq!(found("the top of <obj-0> , then the full plant , not the back", "palm"), [View::Top, View::Whole]);
        let text = "give them the whole thing from the front first , then the back";
        assert_eq!(found(text, "armchair"), [View::Front, View::Back]);
    }

    #[test]
    fn a_loop_ends_as_it_began() {
        let is_loop = |text: &str| loops(&Text::new(text.split(' ').collect()));
        assert!(is_loop("ideally it loops so the last frame matches the first"));
        assert!(is_loop("the last image must be the same as the first one"));
        assert!(is_loop("make it end where it starts"));
        assert!(!is_loop("no loops please , but the same plant"));
        assert!(!is_loop("begin with the pot and end with the same pot"));
    }

    #[test]
    fn a_buyer_sees_both_sides() {
        let text = "wants the front , both sides of <obj-0> and the headstock , no fancy angles";
        assert_eq!(found(text, "guitar"), [View::Front, View::Sides, View::Top]);
    }
}

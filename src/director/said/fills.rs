//! Pictures that a thing fills: `until only the trophy is in frame`, `until nothing else is in frame`, and parts of things,
//! which are small: `the badge of the car`.

use cinesplat_language::{Linked, PartPlace};
use cinesplat_operator::{Framing, Step, SubjectPart, SubjectSide};
use cinesplat_trajectory::{Move, ShotSize};

use super::openings::OPENS;

/// Words that say that a thing alone is in the frame.
const ALONE: [&[&str]; 2] = [&["nothing", "else", "is", "in", "frame"], &["is", "in", "frame"]];

/// Ends on an extreme close-up where nothing but the subject is left in the frame.
pub(crate) fn fill_with_only(linked: &Linked, steps: &mut [Step]) {
    for step in steps.iter_mut().filter(|step| nears(step.movement)) {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let is_only = |at: usize| {
            let is_thing = words[at] == "only" && words.get(at + 1).is_some_and(|word| linked.slot_at(word).is_some());
            words[at..].starts_with(ALONE[0]) || is_thing && words[at + 2..].starts_with(ALONE[1])
        };
        let is_open = step.end.height_frac.is_none() && !step.end.whole && step.end.subjects.len() < 2;
        if is_open && (0..words.len()).any(is_only) {
            step.end.size = Some(ShotSize::ExtremeCloseUp);
        }
    }
}

/// Phrases of a thing that just fits into the frame.
const FITS: [[&str; 3]; 4] =
    [["top", "to", "bottom"], ["head", "to", "toe"], ["edge", "to", "edge"], ["bottom", "to", "top"]];
/// Height of what fills the frame from top to bottom, over the frame's.
const TOP_TO_BOTTOM: f64 = 0.95;

/// Ends with all of the subject where the words fill the frame with it from top to bottom, in place of a close-up that cuts it.
pub(crate) fn fill_to_edges(linked: &Linked, steps: &mut [Step]) {
    for step in steps.iter_mut().filter(|step| nears(step.movement)) {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let fits = |at: usize| FITS.iter().any(|phrase| words[at..].starts_with(phrase));
        let fills = |at: usize| {
            words[..at].iter().rev().take(5).any(|word| matches!(*word, "fill" | "fills" | "filling" | "filled"))
        };
        let is_close = step.end.size.is_none_or(|size| matches!(size, ShotSize::CloseUp | ShotSize::ExtremeCloseUp));
        let is_open = step.end.height_frac.is_none_or(|frac| frac >= 1.0) && step.end.subjects.len() == 1;
        if is_close && is_open && (0..words.len()).any(|at| fits(at) && fills(at)) {
            (step.end.size, step.end.height_frac) = (None, Some(TOP_TO_BOTTOM));
        }
    }
}

/// Words by which a picture shows hardly anything else, behind `the only thing`.
const SEES: [&str; 8] = ["see", "look", "notice", "sees", "visible", "seen", "watch", "there"];

/// Comes so close that the words see nothing else: `arc round the knot, near enough that it's the only thing you really look at`.
pub(crate) fn close_on_only(linked: &Linked, steps: &mut [Step]) {
    for step in steps {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let is_only = |at: usize| {
            let thing = matches!(words[at..], ["only", "thing" | "one", ..])
                || matches!(words[at..], ["all", "you" | "we", ..]);
            thing && words[at + 2..].iter().take(5).any(|word| SEES.contains(word))
        };
        let is_near = words
            .iter()
            .any(|word| matches!(*word, "near" | "close" | "closer" | "nearer" | "tight" | "till" | "until"));
        let is_open = step.end.size.is_none() && step.end.height_frac.is_none() && !step.end.whole;
        let fits = nears(step.movement) || step.movement.is_circular();
        if is_near && is_open && fits && step.end.subjects.len() == 1 && (0..words.len()).any(is_only) {
            step.end.size = Some(ShotSize::CloseUp);
        }
    }
}

/// Shows the part of a thing that the words name, close where it is small, and closer where it fills the frame: `push in until
/// the sole fills the frame`.
pub(crate) fn close_on_parts(linked: &Linked, steps: &mut [Step]) {
    for step in steps {
        let words: Vec<(&str, [usize; 2])> = linked.words_in(step.words.unwrap_or_default()).collect();
        let part_at = |at: usize| {
            let (word, span) = words[at];
            let (_, part) = linked.parts.iter().find(|(bytes, _)| bytes[0] <= span[0] && span[1] <= bytes[1])?;
            Some((at, linked.slot_at(word)?, *part))
        };
        let parts: Vec<(usize, u32, PartPlace)> = (0..words.len()).filter_map(part_at).collect();
        let [(at, id, part)] = parts[..] else { continue };
        // `The top of` stands for the part.
        let opens = words[..at].iter().rev().take(8).any(|(word, _)| *word == "from" || OPENS.contains(word));
        let says = |wanted: &[&str]| words.iter().any(|(word, _)| wanted.contains(word));
        let fills = says(&["fills", "fill", "filling"]) && says(&["frame", "screen", "picture"]);
        let ids = linked.expanded(&[id]);
        if opens && step.movement != Move::Static {
            if step.start.subjects == ids {
                show_part(&mut step.start, part, false);
            }
            continue;
        }
        // The words name nothing else.
        let names_other = words.iter().filter_map(|(word, _)| linked.slot_at(word)).any(|other| other != id);
        if step.end.subjects.is_empty() && nears(step.movement) && !names_other && step.end.size.is_none() {
            step.end.subjects.clone_from(&ids);
        }
        if step.end.subjects == ids && nears(step.movement) {
            show_part(&mut step.end, part, fills);
            // A rest shows the side that the move before it arrives at.
            let side = match part.place {
                "front" => Some(SubjectSide::FromFront),
                "back" => Some(SubjectSide::FromBack),
                _ => None,
            };
            step.end.side = step.end.side.or(side.filter(|_| step.movement != Move::Static));
        }
    }
}

/// Words that lead from a part and to one.
const FROM: [&str; 2] = ["from", "off"];
const TO: [&str; 7] = ["to", "until", "till", "onto", "reach", "reaches", "at"];

/// Begins and ends a tilt, a rise or a descent at the parts of its subject from which and to which the words lead: `tilt down over
/// the strings to the body`.
pub(crate) fn end_on_parts(linked: &Linked, steps: &mut [Step]) {
    for step in steps.iter_mut().filter(|step| is_upright(step.movement)) {
        let words: Vec<(&str, [usize; 2])> = linked.words_in(step.words.unwrap_or_default()).collect();
        let part_led = |leads: &[&str], ids: &[u32]| {
            words.iter().enumerate().rev().find_map(|(at, (word, span))| {
                let (_, part) = linked.parts.iter().find(|(bytes, _)| bytes[0] <= span[0] && span[1] <= bytes[1])?;
                let id = linked.slot_at(word).filter(|id| linked.expanded(&[*id]) == ids)?;
                let own: Vec<&str> =
                    words[..at].iter().rev().map(|(word, _)| *word).take_while(|word| !word.starts_with('<')).collect();
                let led = own.iter().take(5).any(|word| leads.contains(word))
                    || leads == TO && is_level_with(&own, words.get(at + 1).map_or("", |(word, _)| word));
                led.then_some((id, subject_part(part.place)))
            })
        };
        let (start, end) = (linked.expanded(&step.start.subjects), linked.expanded(&step.end.subjects));
        for (framing, ids, leads) in [(&mut step.start, start, &FROM[..]), (&mut step.end, end, &TO[..])] {
            let is_open = framing.part == SubjectPart::Middle && ids.len() == 1;
            let end_said = || Some((*ids.first()?, end_level_with(&words).filter(|_| leads == TO)?));
            if let Some((_, part)) = part_led(leads, &ids).or_else(end_said).filter(|_| is_open) {
                framing.part = part;
            }
        }
    }
}

/// Whether the words before a part, the last one first, rise or sink to its height: `until the lens is as high as its headstock`, `level
/// with its top`. `next` stands behind the part.
fn is_level_with(before: &[&str], next: &str) -> bool {
    let compares =
        |two: [&str; 2]| before.iter().take(4).collect::<Vec<_>>().windows(2).any(|pair| pair == [&two[1], &two[0]]);
    let is_level =
        [["high", "as"], ["low", "as"], ["level", "with"], ["height", "of"], ["height", "as"], ["flush", "with"]];
    let leads = before.iter().take(12).any(|word| TO.contains(word) || matches!(*word, "til" | "'til" | "so"));
    leads && (is_level.into_iter().any(compares) || matches!(next, "height" | "level"))
}

/// The end of its subject to whose height the words lead: `until we are level with its top`.
fn end_level_with(words: &[(&str, [usize; 2])]) -> Option<SubjectPart> {
    let texts: Vec<&str> = words.iter().map(|(word, _)| *word).collect();
    (1..texts.len()).find_map(|at| {
        let part = match texts[at] {
            "top" | "tip" | "crown" => SubjectPart::Top,
            "bottom" | "foot" | "base" => SubjectPart::Bottom,
            _ => return None,
        };
        let own = texts[..at]
            .iter()
            .rev()
            .take_while(|word| matches!(**word, "very" | "the" | "its" | "their" | "his" | "her"));
        let before: Vec<&str> = texts[..at - own.count()].iter().rev().copied().collect();
        let is_of_other =
            texts.get(at + 1) == Some(&"of") && texts.get(at + 2).is_none_or(|word| !word.starts_with('<'));
        (!is_of_other && is_level_with(&before, "")).then_some(part)
    })
}

fn is_upright(movement: Move) -> bool {
    matches!(
        movement,
        Move::TiltUp | Move::TiltDown | Move::PedestalUp | Move::PedestalDown | Move::CraneUp | Move::CraneDown
    )
}

fn subject_part(place: &str) -> SubjectPart {
    match place {
        "top" => SubjectPart::Top,
        "bottom" => SubjectPart::Bottom,
        "left" => SubjectPart::Left,
        "right" => SubjectPart::Right,
        _ => SubjectPart::Middle,
    }
}

/// Whether a move leads to its subject, or rests on it.
fn nears(movement: Move) -> bool {
    matches!(movement, Move::PushIn | Move::ZoomIn | Move::Static | Move::Follow | Move::DollyZoomIn)
}

fn show_part(framing: &mut Framing, part: PartPlace, fills: bool) {
    let end = subject_part(part.place);
    // The words of ends say themselves where to look.
    if framing.part == SubjectPart::Middle && (part.is_small || matches!(part.place, "left" | "right")) {
        framing.part = end;
    }
    let is_free = framing.size.is_none() && framing.height_frac.is_none() && !framing.whole;
    let is_open = framing.height_frac.is_none() && framing.size.is_none_or(|size| size == ShotSize::CloseUp);
    match part.heights_percent {
        Some([low, high]) if fills && is_open && !part.is_small => {
            // The part is a share of the thing, whose height the size is of.
            let share = f64::from(high.saturating_sub(low).max(1)) / 100.0;
            (framing.part, framing.size) = (end, None);
            framing.height_frac = Some((FILLED / share).min(MOST_FILLED));
        }
        _ if fills && part.is_small && framing.size.is_none_or(|size| size == ShotSize::CloseUp) => {
            framing.size = Some(ShotSize::ExtremeCloseUp);
        }
        _ if is_free && part.is_small => framing.size = Some(ShotSize::CloseUp),
        _ => {}
    }
}

/// Height of a part that fills the frame, over that of the frame, whose middle it misses; and the largest height of its thing for that.
const FILLED: f64 = 0.75;
const MOST_FILLED: f64 = 2.2;

/// Words of a thing that is seen completely, and of what it is seen in.
const COMPLETELY: [&str; 6] = ["completely", "fully", "entirely", "wholly", "totally", "all"];
const SEEN: [&str; 8] = ["visible", "in", "seen", "shown", "revealed", "exposed", "displayed", "there"];

/// Ends on all of what the words show completely: `pan left until the shelf is completely visible`.
pub(crate) fn show_completely(linked: &Linked, steps: &mut [Step]) {
    for step in steps {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let is_shown = |at: usize| {
            let behind = words.get(at + 1..at + 4);
            let is_complete = behind.is_some_and(|behind| {
                matches!(behind[0], "is" | "are" | "'s" | "becomes")
                    && COMPLETELY.contains(&behind[1])
                    && SEEN.contains(&behind[2])
            });
            let shown = linked.slot_at(words[at]).map(|id| linked.expanded(&[id]));
            is_complete && shown.is_some_and(|shown| shown == step.end.subjects)
        };
        let is_open = step.end.size.is_none() && step.end.height_frac.is_none() && !step.end.hidden;
        if is_open && (0..words.len()).any(is_shown) {
            step.end.whole = true;
        }
    }
}

/// Drops the size of a picture that is a thing's own height: `climb to 100 % of its height`.
pub(crate) fn rise_by_own_height(linked: &Linked, steps: &mut [Step]) {
    for step in steps {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let is_own = words.windows(4).any(|four| {
            linked.is_quantity(four[0]) && matches!(four[1..], ["of", "its" | "his" | "her" | "their", "height"])
        });
        if is_own {
            step.end.height_frac = None;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::fixture::{about, linked};
    use super::*;

    #[test]
    fn what_fills_the_frame_from_top_to_bottom_is_not_cut() {
        let frac = |text: &str| {
            let mut step = about(Move::PushIn, &[5], [0, text.len()]);
            step.end.size = Some(ShotSize::CloseUp);
            let mut steps = [step];
            fill_to_edges(&linked(text), &mut steps);
            (steps[0].end.size, steps[0].end.height_frac)
        };
        assert_eq!(frac("push in until <obj-0> fills the frame top to bottom"), (None, Some(TOP_TO_BOTTOM)));
        assert_eq!(frac("push in until <obj-0> fills the frame"), (Some(ShotSize::CloseUp), None));
    }

    #[test]
    fn what_is_completely_visible_is_whole() {
        let is_whole = |text: &str| {
            let mut steps = vec![about(Move::PanLeft, &[5], [0, text.len()])];
            show_completely(&linked(text), &mut steps);
            steps[0].end.whole
        };
        assert!(is_whole("pan left until <obj-0> is completely visible"));
        assert!(!is_whole("pan left until <obj-0> is visible"));
    }

    fn end_part(text: &str) -> SubjectPart {
        let top = PartPlace { place: "top", is_small: false, heights_percent: None };
        let last =
            linked(text).words_in([0, usize::MAX]).filter(|(word, _)| *word == "<obj-0>").last().map(|(_, span)| span);
        // The last mention stands for a part, as in `its headstock`.
        let parts = last.filter(|_| text.contains("guitar")).map(|span| (span, top)).into_iter().collect();
        let linked = Linked { parts, ..linked(text) };
        let mut steps = [about(Move::CraneUp, &[5], [0, text.len()])];
        end_on_parts(&linked, &mut steps);
        steps[0].end.part
    }

    #[test]
    fn a_rise_ends_at_the_height_of_the_part_that_is_told() {
        assert_eq!(end_part("<obj-0> the guitar , boom up until the lens is as high as <obj-0>"), SubjectPart::Top);
        assert_eq!(end_part("rise so that we are level with <obj-0> of the guitar"), SubjectPart::Top);
        assert_eq!(end_part("boom up until we are level with its very top"), SubjectPart::Top);
        assert_eq!(end_part("sink until the lens is at the height of its base"), SubjectPart::Bottom);
        assert_eq!(end_part("boom up until we are level with <obj-0>"), SubjectPart::Middle);
        assert_eq!(end_part("boom up from the top of <obj-0>"), SubjectPart::Middle);
    }
}

//! Whose the side of the frame is: `float in on the guitar, plant always frame right` puts the plant there, and the guitar on the
//! other side.

use cinesplat_language::{Linked, add_ids, is_listed};
use cinesplat_operator::{FramePlace, Framing, Step};
use cinesplat_trajectory::Move;

/// Words between a thing and the side of the frame that it is on.
const BETWEEN: &str = "always is are stays stay kept keeps at on in to the camera frame screen picture always constantly throughout , \
    over off";
/// Words that make `left` and `right` sides of the frame, before them and behind them.
const FRAME: &str = "frame camera screen picture";
const SIDE: &str = "side third half edge of";
const ALWAYS: &str = "always throughout constantly whole time";

/// Moves a subject to the side of the frame that another thing leaves, where its step gives it the place of that thing.
pub(crate) fn leave_sides_to_owners(linked: &Linked, steps: &mut [Step]) {
    for step in steps {
        let words = linked.texts_in(step.words.unwrap_or_default());
        if share_frame(linked, &words, step) {
            continue;
        }
        let Some(&[subject]) = step.end.subjects.first_chunk::<1>().filter(|_| step.end.subjects.len() == 1) else {
            continue;
        };
        let owners: Vec<(u32, FramePlace)> = (0..words.len()).filter_map(|at| side_of(linked, &words, at)).collect();
        let [(owner, side)] = owners[..] else { continue };
        let is_kept = linked.expanded(&[owner]).iter().all(|id| step.keep.contains(id));
        if linked.expanded(&[owner]).contains(&subject) || owner == subject || !is_kept && !step.keep.contains(&owner) {
            continue;
        }
        if step.end.place.is_none_or(|place| place == side) {
            step.end.place = Some(opposite(side));
            if words.iter().any(|word| is_listed(ALWAYS, word)) && step.start == Framing::default() {
                step.start = Framing { subjects: vec![subject], place: step.end.place, ..Framing::default() };
            }
        }
    }
}

/// Puts the first of two things at its side of the frame and keeps the other one, where the words give each a side: `the guitar in the
/// left half of the picture and the palm in the right half`.
fn share_frame(linked: &Linked, words: &[&str], step: &mut Step) -> bool {
    let owners: Vec<(u32, FramePlace)> = (0..words.len()).filter_map(|at| shared_side_of(linked, words, at)).collect();
    let [(first, side), (second, other)] = owners[..] else { return false };
    let rests = matches!(step.movement, Move::Static | Move::PushIn | Move::PullOut | Move::ZoomIn | Move::ZoomOut);
    let of_frame = words.iter().any(|word| is_listed(FRAME, word));
    let (firsts, seconds) = (linked.expanded(&[first]), linked.expanded(&[second]));
    if !rests || !of_frame || side == other || firsts.len() != 1 || firsts == seconds {
        return false;
    }
    step.keep.retain(|id| !firsts.contains(id));
    add_ids(&mut step.keep, &seconds);
    let framing = Framing { subjects: firsts, place: Some(side), ..Framing::default() };
    if step.movement != Move::Static {
        step.start = Framing { size: step.start.size, angle: step.start.angle, ..framing.clone() };
    }
    step.end = Framing { size: step.end.size, angle: step.end.angle, height_frac: step.end.height_frac, ..framing };
    true
}

/// The thing at word `at`, with the side that the words behind it put it on, and where they say that.
fn placed_side(linked: &Linked, words: &[&str], at: usize) -> Option<(u32, FramePlace, usize)> {
    let id = linked.slot_at(words[at])?;
    let num_between = words[at + 1..].iter().take(5).take_while(|word| is_listed(BETWEEN, word)).count();
    let place = at + 1 + num_between;
    let next = words.get(place + 1).copied().unwrap_or_default();
    match (*words.get(place)?, next) {
        ("upper" | "top", "left") => Some((id, FramePlace::AtUpperLeft, place + 1)),
        ("upper" | "top", "right") => Some((id, FramePlace::AtUpperRight, place + 1)),
        ("lower" | "bottom", "left") => Some((id, FramePlace::AtLowerLeft, place + 1)),
        ("lower" | "bottom", "right") => Some((id, FramePlace::AtLowerRight, place + 1)),
        ("left", _) => Some((id, FramePlace::AtLeft, place)),
        ("right", _) => Some((id, FramePlace::AtRight, place)),
        _ => None,
    }
}

/// The thing at word `at`, with its side, where the words of another thing may say what that is a side of.
fn shared_side_of(linked: &Linked, words: &[&str], at: usize) -> Option<(u32, FramePlace)> {
    let (id, side, place) = placed_side(linked, words, at)?;
    let is_side =
        words.get(place + 1).is_none_or(|word| is_listed(SIDE, word) || is_listed("and , . ; then with", word));
    is_side.then_some((id, side))
}

/// The thing at word `at`, with the side of the frame that the words behind it put it on.
fn side_of(linked: &Linked, words: &[&str], at: usize) -> Option<(u32, FramePlace)> {
    let (id, side, place) = placed_side(linked, words, at)
        .filter(|(_, side, _)| matches!(side, FramePlace::AtLeft | FramePlace::AtRight))?;
    let is_of_frame = is_listed(FRAME, words[place - 1])
        || words.get(place + 1).is_some_and(|word| is_listed(SIDE, word))
            && words[place..].iter().take(5).any(|word| is_listed(FRAME, word));
    is_of_frame.then_some((id, side))
}

fn opposite(side: FramePlace) -> FramePlace {
    if side == FramePlace::AtLeft { FramePlace::AtRight } else { FramePlace::AtLeft }
}

#[cfg(test)]
mod tests {
    use super::super::fixture::{about, linked};
    use super::*;

    fn placed(text: &str) -> (Option<FramePlace>, Vec<u32>) {
        let mut step = about(Move::PushIn, &[5], [0, text.len()]);
        step.end.place = Some(FramePlace::AtRight);
        step.keep = vec![7];
        leave_sides_to_owners(&linked(text), std::slice::from_mut(&mut step));
        (step.end.place, step.start.subjects)
    }

    #[test]
    fn a_side_of_the_frame_is_that_of_the_thing_before_it() {
        let left = Some(FramePlace::AtLeft);
        assert_eq!(placed("float in towards <obj-0> , <obj-1> always frame right"), (left, vec![5]));
        assert_eq!(placed("push in on <obj-0> , <obj-1> on the right of the frame"), (left, vec![]));
        let mut step = about(Move::PushIn, &[5], [0, 41]);
        step.keep = vec![7];
        leave_sides_to_owners(&linked("push in on <obj-0> , <obj-1> frame left .."), std::slice::from_mut(&mut step));
        assert_eq!(step.end.place, Some(FramePlace::AtRight));
        let right = Some(FramePlace::AtRight);
        assert_eq!(placed("push in on <obj-0> frame right , <obj-1> in view"), (right, vec![]));
        assert_eq!(placed("push in on <obj-0> , past <obj-1> to the right"), (right, vec![]));
    }

    #[test]
    fn two_things_share_the_frame() {
        let shared = |text: &str| {
            let mut step = about(Move::PullOut, &[7], [0, text.len()]);
            leave_sides_to_owners(&linked(text), std::slice::from_mut(&mut step));
            (step.end.subjects, step.end.place, step.keep)
        };
        let both = (vec![5], Some(FramePlace::AtLeft), vec![7]);
        assert_eq!(shared("<obj-0> in the left half of the picture and <obj-1> in the right half , pull back"), both);
        assert_eq!(shared("<obj-0> on the left and <obj-1> on the right of the frame , pull back"), both);
        assert_eq!(shared("pull back from <obj-0> on the left past <obj-1> on the right").1, None);
    }
}

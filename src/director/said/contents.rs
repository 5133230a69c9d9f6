//! Ways in that go on until one sees into a thing: `go in on the mug until I can see the coffee in it`.

use cinesplat_language::{Linked, is_listed};
use cinesplat_operator::Step;
use cinesplat_trajectory::{Move, ShotAngle, ShotSize};

use super::directions::says_any;

/// Words before what a way in goes on to show.
const UNTIL: &str = "until till til so untill";
/// Words of seeing.
const SEES: &str = "see look peer peek sees looks shows show visible looking";
/// How one sees what is in a thing.
const INSIDE: [&[&str]; 6] =
    [&["into", "it"], &["in", "it"], &["inside"], &["inside", "it"], &["into", "them"], &["down", "into"]];

/// Ends a way in close and from above where its words go on until one sees what is in its subject.
pub(crate) fn look_into(linked: &Linked, steps: &mut [Step]) {
    for step in steps.iter_mut().filter(|step| matches!(step.movement, Move::PushIn | Move::ZoomIn | Move::Follow)) {
        let words = linked.texts_in(step.words.unwrap_or_default());
        let Some(until) = words.iter().position(|word| is_listed(UNTIL, word)) else { continue };
        let behind = &words[until..];
        let sees = behind.iter().take(6).any(|word| is_listed(SEES, word));
        let is_inside = says_any(behind, &INSIDE);
        let is_open = step.end.angle.is_none() && step.end.elevation_deg.is_none() && !step.end.subjects.is_empty();
        if !(sees && is_inside && is_open) {
            continue;
        }
        step.end.angle = Some(ShotAngle::High);
        if step.end.size.is_none() && step.end.height_frac.is_none() {
            step.end.size = Some(ShotSize::CloseUp);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::fixture::linked;
    use super::*;
    use cinesplat_operator::Framing;

    #[test]
    fn who_sees_into_a_thing_sees_it_from_above() {
        let angle = |text: &str| {
            let end = Framing { subjects: vec![5], ..Framing::default() };
            let mut steps = [Step { end, words: Some([0, text.len()]), ..Step::of(Move::PushIn) }];
            look_into(&linked(text), &mut steps);
            steps[0].end.angle
        };
        assert_eq!(angle("go in on <obj-0> until i can see <obj-0> in it"), Some(ShotAngle::High));
        assert_eq!(angle("creep up to <obj-0> till you can look into it"), Some(ShotAngle::High));
        assert_eq!(angle("push in on <obj-0> until we see what is inside"), Some(ShotAngle::High));
        assert_eq!(angle("push in on <obj-0> until it fills the frame"), None);
        assert_eq!(angle("push in on <obj-0> and see it"), None);
    }
}

//! Beds that are seen from their foot: `push in on the bed from the foot end`, `start at mattress height at the foot of the bed`.

use cinesplat_language::Linked;
use cinesplat_objects::Object;
use cinesplat_operator::{Framing, Step, SubjectSide};

/// Sees a bed from its foot, where its front is.
pub(crate) fn see_from_foot(linked: &Linked, objects: &[Object], steps: &mut [Step]) {
    let is_bed = |id: &u32| {
        let object = objects.iter().find(|object| object.id == *id);
        object.is_some_and(|object| object.label.split(' ').any(|word| word.eq_ignore_ascii_case("bed")))
    };
    for step in steps.iter_mut().filter(|step| !step.movement.is_circular()) {
        if !names_foot(&linked.texts_in(step.words.unwrap_or_default())) {
            continue;
        }
        let sees_bed = |framing: &Framing| framing.subjects.iter().any(is_bed) && framing.side.is_none();
        let side = Some(SubjectSide::FromFront);
        match (sees_bed(&step.start), sees_bed(&step.end)) {
            (true, _) => step.start.side = side,
            (false, true) => step.end.side = side,
            (false, false) => {}
        }
    }
}

/// Whether words place a camera at the foot of something.
fn names_foot(words: &[&str]) -> bool {
    let is_foot = |at: usize| {
        let next = words.get(at + 1).copied().unwrap_or_default();
        let is_end = matches!(next, "end" | "side");
        let is_of = next == "of" && words.get(at + 2).is_some_and(|word| *word == "it" || word.starts_with('<'));
        let is_place = words[..at].iter().rev().take(2).any(|word| matches!(*word, "at" | "from"));
        // An idiom makes `the front of it` of the foot end.
        is_place && (words[at] == "foot" && (is_end || is_of) || words[at] == "front" && is_of)
    };
    (0..words.len()).any(is_foot)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::said::fixture::{about, linked};
    use cinesplat_trajectory::Move;
    use glam::DVec3;

    #[test]
    fn a_bed_is_seen_from_its_foot() {
        let side = |text: &str, label: &str| {
            let objects = [Object::from_box(5, label, DVec3::ZERO, DVec3::ONE)];
            let mut steps = [about(Move::PushIn, &[5], [0, text.len()])];
            see_from_foot(&linked(text), &objects, &mut steps);
            steps[0].end.side
        };
        assert_eq!(side("push in on <obj-0> from the foot end", "green bed"), Some(SubjectSide::FromFront));
        assert_eq!(side("push in from the foot of <obj-0>", "green bed"), Some(SubjectSide::FromFront));
        assert_eq!(side("push in on <obj-0> from the foot end", "bedside lamp"), None);
        assert_eq!(side("start at the front of <obj-0> and rise", "green bed"), Some(SubjectSide::FromFront));
        assert_eq!(side("push in on <obj-0> , one foot nearer", "green bed"), None);
    }
}

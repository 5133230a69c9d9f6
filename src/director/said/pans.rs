//! Pans over several things: `pan over both windows, left to right`.

use cinesplat_geometry::LevelFrame;
use cinesplat_objects::Object;
use cinesplat_operator::{Framing, Program, Step};
use cinesplat_trajectory::Move;
use glam::DVec3;

/// Begins a pan over several things at the first of them and ends it at the last, as somebody sees them who stands in the middle of
/// what there is.
pub(crate) fn pan_from_first_to_last((objects, up): (&[Object], DVec3), program: &mut Program) {
    let Ok(frame) = LevelFrame::new(up) else { return };
    let middle = objects.iter().map(|object| object.center).sum::<DVec3>() / objects.len().max(1) as f64;
    // Grows to the right.
    let azimuth = |id: &u32| {
        let object = objects.iter().find(|object| object.id == *id)?;
        Some(frame.azimuth(object.center - middle))
    };
    for step in program.steps.iter_mut().filter(|step| is_over_several(step)) {
        let mut seen: Vec<(f64, u32)> =
            step.end.subjects.iter().filter_map(|id| azimuth(id).map(|angle| (angle, *id))).collect();
        if seen.len() < step.end.subjects.len() {
            continue;
        }
        seen.sort_by(|a, b| a.0.total_cmp(&b.0));
        // The widest gap is where no pan leads.
        let gap = |at: usize| (seen[(at + 1) % seen.len()].0 - seen[at].0).rem_euclid(std::f64::consts::TAU);
        let Some(rightmost) = (0..seen.len()).max_by(|a, b| gap(*a).total_cmp(&gap(*b))) else { continue };
        let mut ends = [seen[(rightmost + 1) % seen.len()].1, seen[rightmost].1];
        if step.movement == Move::PanLeft {
            ends.reverse();
        }
        let [first, last] = ends.map(|id| Framing { subjects: vec![id], ..Framing::default() });
        (step.start, step.end) = (first, last);
    }
}

/// Whether a pan begins and ends at the same several things.
fn is_over_several(step: &Step) -> bool {
    let is_plain = |framing: &Framing| {
        *framing == Framing { subjects: framing.subjects.clone(), part: framing.part, ..Framing::default() }
    };
    matches!(step.movement, Move::PanLeft | Move::PanRight)
        && step.end.subjects.len() > 1
        && step.start.subjects == step.end.subjects
        && is_plain(&step.start)
        && is_plain(&step.end)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pan_over_two_windows_leads_from_one_to_the_other() {
        let at = |id, x: f64, z: f64| Object::from_box(id, "window", DVec3::new(x, 1.5, z), DVec3::splat(0.5));
        // Seen from the middle toward -z, 1 is left of 2.
        let objects = [at(1, -1.0, -3.0), at(2, 1.0, -3.0), at(3, 0.0, 6.0)];
        let both = Framing { subjects: vec![1, 2], ..Framing::default() };
        for (movement, ends) in [(Move::PanRight, [1, 2]), (Move::PanLeft, [2, 1])] {
            let step = Step { start: both.clone(), end: both.clone(), ..Step::of(movement) };
            let mut program = Program { steps: vec![step], ..Program::default() };
            pan_from_first_to_last((&objects, DVec3::Y), &mut program);
            let step = &program.steps[0];
            assert_eq!([&step.start.subjects[..], &step.end.subjects[..]], [&ends[..1], &ends[1..]]);
        }
        let step = Step { end: both, ..Step::of(Move::PanRight) };
        let mut program = Program { steps: vec![step.clone()], ..Program::default() };
        pan_from_first_to_last((&objects, DVec3::Y), &mut program);
        assert_eq!(program.steps, [step]);
    }
}

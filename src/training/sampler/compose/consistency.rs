//! Consistency of steps: which combinations a prompt can mean, and the move between two framings.
//!
//! A function that returns `Option<()>` returns `None` to reject the draw.

use cinesplat_operator::{Amount, Framing, Program, Step};
use cinesplat_trajectory::{Move, ShotAngle, ShotSize};

/// Makes an opening framing (`start close on A`) the start of the first step. Rejects a step with a start of its own, and
/// moves that do not start at a framing. A static step has to be a hold of the same subjects: the framing becomes its end.
pub(super) fn apply_opening(step: &mut Step, start: &Framing) -> Option<()> {
    if step.cut || step.returns || step.start != Framing::default() {
        return None;
    }
    if step.movement == Move::Static {
        let holds = step.duration_secs.is_some() && step.end.subjects == start.subjects && step.end.size.is_none();
        step.end = start.clone();
        return holds.then_some(());
    }
    if matches!(step.movement, Move::Handheld | Move::RackFocus | Move::Reveal) {
        return None;
    }
    step.start = start.clone();
    Some(())
}

/// Whether a step only repeats the one before: the same move with the same subjects at its end, or a hold after a hold.
pub(super) fn is_redundant(before: &Step, now: &Step) -> bool {
    let is_same_move = before.movement == now.movement && before.end.subjects == now.end.subjects && !now.cut;
    is_same_move || (before.movement == Move::Static && now.movement == Move::Static && !now.cut)
}

/// Whether the parts of a step agree. For example a push-in ends closer than it starts, and a tilt is at most 90 degrees.
pub(super) fn is_consistent(step: &Step) -> bool {
    let has_repeats = |ids: &[u32]| ids.iter().enumerate().any(|(i, id)| ids.iter().take(i).any(|other| other == id));
    if has_repeats(&step.start.subjects) || has_repeats(&step.end.subjects) {
        return false;
    }
    let sizes = step.start.size.zip(step.end.size);
    let gets_closer = sizes.is_none_or(|(start, end)| end < start);
    let gets_wider = sizes.is_none_or(|(start, end)| end > start);
    let same_subject = step.start.subjects == step.end.subjects;
    let goes_in = matches!(step.movement, Move::PushIn | Move::ZoomIn);
    let goes_out = matches!(step.movement, Move::PullOut | Move::ZoomOut);
    if same_subject && (goes_in && !gets_closer || goes_out && !gets_wider) {
        return false;
    }
    if goes_in && step.start.size.is_some_and(|size| size <= ShotSize::ExtremeCloseUp) && same_subject {
        return false;
    }
    if goes_in && step.end.subjects.is_empty() && step.end.size.is_some_and(|size| size < ShotSize::Long) {
        return false;
    }
    let angles = step.start.angle.zip(step.end.angle);
    let rises = angles.is_none_or(|(a, b)| b < a);
    let sinks = angles.is_none_or(|(a, b)| b > a);
    let is_possible = match step.movement {
        Move::CraneUp => rises && step.start.angle != Some(ShotAngle::Overhead),
        Move::CraneDown => sinks && step.start.angle != Some(ShotAngle::Worm),
        Move::TiltUp | Move::TiltDown | Move::RollCw | Move::RollCcw => {
            !matches!(step.amount, Some(Amount::Degrees(d)) if d > 90.0)
        }
        Move::PanLeft | Move::PanRight => !matches!(step.amount, Some(Amount::Degrees(d)) if d > 360.0),
        Move::ArcLeft | Move::ArcRight => !matches!(step.amount, Some(Amount::Degrees(d)) if d > 400.0),
        _ => true,
    };
    is_possible && !step.with.contains(&step.movement)
}

/// The move from one framing of a subject to another; `None` where they do not differ in size or angle.
pub(super) fn move_between(start: &Framing, end: &Framing) -> Option<Move> {
    // Sizes are ordered from close to wide, angles from high to low.
    match (start.size.zip(end.size), start.angle.zip(end.angle)) {
        (Some((a, b)), _) if b < a => Some(Move::PushIn),
        (Some((a, b)), _) if b > a => Some(Move::PullOut),
        (None, Some((a, b))) if b < a => Some(Move::CraneUp),
        (None, Some((a, b))) if b > a => Some(Move::CraneDown),
        _ => None,
    }
}

/// Makes the duration of an only step the film's. Rejects a film length that the durations of the steps already determine
/// or exceed.
pub(super) fn normalize_durations(program: &mut Program) -> Option<()> {
    let sum: f64 = program.steps.iter().filter_map(|step| step.duration_secs).sum();
    let open = program.steps.iter().filter(|step| step.duration_secs.is_none()).count();
    if let [only] = program.steps.as_mut_slice() {
        if program.duration_secs.is_some() && only.duration_secs.is_some() {
            return None;
        }
        program.duration_secs = program.duration_secs.or(only.duration_secs.take());
        return Some(());
    }
    let total = program.duration_secs.unwrap_or(f64::INFINITY);
    (sum < total && (open > 0 || program.duration_secs.is_none())).then_some(())
}

//! Whether steps make sense, and what follows from framings alone.

use cinesplat_operator::{Amount, Framing, Program, Step};
use cinesplat_trajectory::{Move, ShotAngle, ShotSize};

/// `Start close on A`, then this step: its start, unless it has its own or is a hold of the opening itself.
pub(super) fn open_with(step: &mut Step, start: &Framing) -> Option<()> {
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

/// Whether a step says nothing new after another: the same move of the same thing, or a hold after a hold.
pub(super) fn is_idle(before: &Step, now: &Step) -> bool {
    let opposite = before.movement == now.movement && before.end.subjects == now.end.subjects && !now.cut;
    opposite || (before.movement == Move::Static && now.movement == Move::Static && !now.cut)
}

/// Whether the parts of a step agree: pushing in ends closer than it began, a tilt stays below a quarter turn ..
pub(super) fn is_sensible(step: &Step) -> bool {
    let repeats = |ids: &[u32]| ids.iter().enumerate().any(|(i, id)| ids.iter().take(i).any(|other| other == id));
    if repeats(&step.start.subjects) || repeats(&step.end.subjects) {
        return false;
    }
    let sizes = (step.start.size, step.end.size);
    let nearer = |(a, b): (Option<ShotSize>, Option<ShotSize>)| a.zip(b).is_none_or(|(a, b)| b < a);
    let farther = |(a, b): (Option<ShotSize>, Option<ShotSize>)| a.zip(b).is_none_or(|(a, b)| b > a);
    let same_subject = step.start.subjects == step.end.subjects;
    let goes_in = matches!(step.movement, Move::PushIn | Move::ZoomIn);
    let goes_out = matches!(step.movement, Move::PullOut | Move::ZoomOut);
    if same_subject && (goes_in && !nearer(sizes) || goes_out && !farther(sizes)) {
        return false;
    }
    if goes_in && step.start.size.is_some_and(|size| size <= ShotSize::ExtremeCloseUp) && same_subject {
        return false;
    }
    if goes_in && step.end.subjects.is_empty() && step.end.size.is_some_and(|size| size < ShotSize::Long) {
        return false;
    }
    let height = |angle: Option<ShotAngle>| angle.map(|angle| angle as u8);
    let angles = height(step.start.angle).zip(height(step.end.angle));
    let rises = angles.is_none_or(|(a, b)| b < a);
    let sinks = angles.is_none_or(|(a, b)| b > a);
    let upright = match step.movement {
        Move::CraneUp => rises && step.start.angle != Some(ShotAngle::Overhead),
        Move::CraneDown => sinks && step.start.angle != Some(ShotAngle::Worm),
        Move::TiltUp | Move::TiltDown | Move::RollCw | Move::RollCcw => {
            !matches!(step.amount, Some(Amount::Degrees(d)) if d > 90.0)
        }
        Move::PanLeft | Move::PanRight => !matches!(step.amount, Some(Amount::Degrees(d)) if d > 360.0),
        Move::ArcLeft | Move::ArcRight => !matches!(step.amount, Some(Amount::Degrees(d)) if d > 400.0),
        _ => true,
    };
    upright && step.with != Some(step.movement)
}

/// The move that leads from one framing of a thing to another.
pub(super) fn move_between(start: &Framing, end: &Framing) -> Option<Move> {
    let height = |framing: &Framing| framing.angle.map(|angle| angle as u8);
    match (start.size.zip(end.size), height(start).zip(height(end))) {
        (Some((a, b)), _) if b < a => Some(Move::PushIn),
        (Some((a, b)), _) if b > a => Some(Move::PullOut),
        (None, Some((a, b))) if b < a => Some(Move::CraneUp),
        (None, Some((a, b))) if b > a => Some(Move::CraneDown),
        _ => None,
    }
}

/// A time said of the only step is the film's; steps may not take longer than the film.
pub(super) fn settle_durations(program: &mut Program) -> Option<()> {
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

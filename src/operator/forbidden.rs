//! Report lines of the motions that a prompt forbids: the finished path is measured against each.

use super::motion::MotionSegment;
use super::program::{Motion, Program, Step};
use super::steadiness::excess;
use super::takes::{Sample, takes};
use super::world::World;
use cinesplat_trajectory::{CameraState, Keyframe, Move, ReportLine};

/// Samples per interval between two keyframes.
const SAMPLES_PER_INTERVAL: usize = 12;

/// One line per forbidden motion: the amount of it in the worst take of the film (the stretch between two cuts). Shake
/// and cuts are counted: the steps that request a handheld camera, and the cuts.
pub(super) fn lines(
    world: &World,
    program: &Program,
    segments: &[MotionSegment],
    keys: &[Keyframe],
) -> Vec<ReportLine> {
    if program.forbidden.is_empty() {
        return Vec::new();
    }
    let cameras = |take: Vec<Sample>| take.into_iter().map(|(_, state)| state).collect();
    let takes: Vec<_> = takes(world, keys, SAMPLES_PER_INTERVAL).into_iter().map(cameras).collect();
    program.forbidden.iter().map(|&motion| line(world, (program, motion), segments, (keys, &takes))).collect()
}

fn line(
    world: &World,
    (program, motion): (&Program, Motion),
    segments: &[MotionSegment],
    (keys, takes): (&[Keyframe], &[Vec<CameraState>]),
) -> ReportLine {
    let of_takes = || {
        let measured = takes.iter().map(|take| excess(world, motion, take));
        measured.fold((0.0, 0.0), |(worst, _), (value, most, _)| (value.max(worst), most))
    };
    let (got, most) = match motion {
        Motion::Shake => (program.steps.iter().filter(|step| is_shaken(step)).count() as f64, 0.0),
        Motion::Cut => (keys.iter().filter(|key| key.cut).count() as f64, 0.0),
        _ => of_takes(),
    };
    let met = got <= most;
    let note = if met { String::new() } else { note(world, program, motion, segments) };
    ReportLine { clause: format!("no {motion}"), wanted: wanted(motion, most), got, met, note }
}

fn is_shaken(step: &Step) -> bool {
    step.movement == Move::Handheld || step.with.contains(&Move::Handheld)
}

fn wanted(motion: Motion, most: f64) -> String {
    match motion {
        Motion::Zoom => format!("lens constant: its largest change, over itself, at most {most:.3}"),
        Motion::Pan => format!("yaw constant within {most:.1} degrees"),
        Motion::Tilt => format!("pitch constant within {most:.1} degrees"),
        Motion::Roll => format!("roll constant within {most:.1} degrees"),
        Motion::Turn => format!("yaw, pitch and roll constant within {most:.1} degrees"),
        Motion::Travel => format!("position constant within {most:.4} scene units"),
        Motion::Rise => format!("height constant within {most:.4} scene units"),
        Motion::Shake => "number of handheld steps 0".to_owned(),
        Motion::Cut => "number of cuts 0".to_owned(),
    }
}

/// Names the moves that contain the motion.
fn note(world: &World, program: &Program, motion: Motion, segments: &[MotionSegment]) -> String {
    let contains = |segment: &&MotionSegment| match motion {
        Motion::Shake => program.steps.get(segment.step).is_some_and(is_shaken),
        Motion::Cut => segment.cut,
        _ => {
            let (value, most, _) = excess(world, motion, &segment.states);
            value > most
        }
    };
    let name = |segment: &MotionSegment| {
        if segment.is_join { "the turn to the next step" } else { segment.movement.into() }
    };
    let mut names: Vec<&str> = segments.iter().filter(contains).map(name).collect();
    names.dedup();
    format!("the film contains it in: {}", names.join(", "))
}

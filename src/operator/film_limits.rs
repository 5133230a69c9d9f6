//! Whether a film keeps the limits that a prompt sets: the report's lines, and the time that its speeds need.
//!
//! Enters: a program's limits, segments and keyframes. Leaves: longer segments where a speed is limited, and a line per limit with
//! its worst value over the finished film. Everything but speeds is kept by the search.

use super::cost::{path_of, sampled};
use super::limit::measured;
use super::motion::MotionSegment;
use super::program::{Level, Limit, Program};
use super::takes::{Sample, takes};
use super::world::World;
use cinesplat_trajectory::{Keyframe, ReportLine};

/// What a limit may be missed by: heights and distances over the scene size, speeds over themselves.
const TOLERANCE_FRAC: f64 = 0.002;
const SPEED_TOLERANCE: f64 = 0.02;
/// Samples of a segment whose speed is measured, and of each interval between two keyframes of a film.
const NUM_SAMPLES: usize = 41;
const SAMPLES_PER_INTERVAL: usize = 16;
/// Time that a segment takes over what its speed allows: what blends add.
const SLACK: f64 = 1.01;

/// One line per limit: its worst value over the finished film.
pub(super) fn lines(world: &World, program: &Program, keys: &[Keyframe]) -> Vec<ReportLine> {
    if program.limits.is_empty() {
        return Vec::new();
    }
    let takes = takes(world, keys, SAMPLES_PER_INTERVAL);
    program.limits.iter().map(|limit| line(world, limit, &takes)).collect()
}

fn line(world: &World, limit: &Limit, takes: &[Vec<Sample>]) -> ReportLine {
    let clause = limit_words(world, limit);
    if let Limit::Speed(most) | Limit::TurnSpeed(most) = *limit {
        let [speed, turn] = fastest(takes);
        let (got, unit) = if matches!(limit, Limit::Speed(_)) { (speed, "scene units") } else { (turn, "degrees") };
        let met = got <= most * (1.0 + SPEED_TOLERANCE);
        let note = if met { String::new() } else { "the length that the words state leaves no time for it".to_owned() };
        return ReportLine { clause, wanted: format!("at most {most:.2} {unit} a second"), got, met, note };
    }
    let tolerance = TOLERANCE_FRAC * world.bounds.size();
    let values = takes.iter().flatten().map(|(_, state)| measured(world, limit, state));
    let worst = values.max_by(|(a, band), (b, _)| {
        let off = |value: f64| (band.0 - value).max(value - band.1);
        off(*a).total_cmp(&off(*b))
    });
    let (got, (least, most)) = worst.unwrap_or((f64::NAN, (0.0, 0.0)));
    let met = got >= least - tolerance && got <= most + tolerance;
    let note = if met { String::new() } else { "no camera was found that keeps it and does the rest".to_owned() };
    let wanted = if least.is_finite() && most.is_infinite() {
        format!("at least {least:.2} scene units")
    } else {
        format!("at most {most:.2} scene units")
    };
    ReportLine { clause, wanted, got, met, note }
}

/// A limit in words.
fn limit_words(world: &World, limit: &Limit) -> String {
    let name = |id: u32| world.subject(id).map_or_else(|| format!("<obj-{id}>"), |subject| subject.label.clone());
    let end = |level: Level| match level {
        Level::Units(_) => String::new(),
        Level::Object(id) => format!(" ({})", name(id)),
    };
    match *limit {
        Limit::Above(level) => format!("least height of the camera{}", end(level)),
        Limit::Below(level) => format!("largest height of the camera{}", end(level)),
        Limit::Clear(None, _) => "least distance to anything".to_owned(),
        Limit::Clear(Some(id), _) => format!("least distance to {}", name(id)),
        Limit::Within(id, _) => format!("largest distance to {}", name(id)),
        Limit::Speed(_) => "largest speed".to_owned(),
        Limit::TurnSpeed(_) => "fastest turn".to_owned(),
    }
}

/// Largest speed of a film, scene units a second, and its fastest turn, degrees a second. Cuts do not count.
fn fastest(takes: &[Vec<Sample>]) -> [f64; 2] {
    let mut fastest = [0.0_f64; 2];
    for pair in takes.iter().flat_map(|take| take.windows(2)) {
        let [(from, first), (to, last)] = [pair[0], pair[1]];
        let secs = to - from;
        if secs > 0.0 {
            let way = first.pose.position.distance(last.pose.position);
            let turn = first.pose.rotation.angle_between(last.pose.rotation).to_degrees();
            fastest = [fastest[0].max(way / secs), fastest[1].max(turn / secs)];
        }
    }
    fastest
}

/// What a film exceeds the program's speeds by: 1 where it keeps them.
pub(super) fn haste(world: &World, program: &Program, keys: &[Keyframe]) -> f64 {
    if !has_speeds(program) {
        return 1.0;
    }
    over(program, fastest(&takes(world, keys, SAMPLES_PER_INTERVAL)))
}

/// Whether a program limits speeds.
pub(super) fn has_speeds(program: &Program) -> bool {
    program.limits.iter().any(Limit::is_speed)
}

/// The largest of the speeds over their limits, at least 1.
fn over(program: &Program, [speed, turn]: [f64; 2]) -> f64 {
    let of = |limit: &Limit| match *limit {
        Limit::Speed(most) => speed / most,
        Limit::TurnSpeed(most) => turn / most,
        _ => 1.0,
    };
    program.limits.iter().map(of).fold(1.0, f64::max)
}

/// Makes every segment of free length so long that it keeps the program's speeds.
pub(super) fn within_speeds(world: &World, program: &Program, segments: &mut [MotionSegment]) {
    if !has_speeds(program) {
        return;
    }
    for segment in segments.iter_mut().filter(|segment| !segment.secs_bind) {
        let states = sampled(&path_of(world, segment), segment, NUM_SAMPLES);
        let secs = segment.secs / (NUM_SAMPLES - 1) as f64;
        let take = states.into_iter().enumerate().map(|(i, state)| (secs * i as f64, state)).collect();
        let over = over(program, fastest(&[take]));
        segment.secs *= if over > 1.0 { SLACK * over } else { 1.0 };
    }
}

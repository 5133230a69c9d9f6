//! Whether a film keeps the limits that a prompt sets: the report's lines, and the time that its speeds need.
//!
//! Enters: a program's limits, segments and keyframes. Leaves: longer segments where a speed is limited, and a line per limit with
//! its worst value over the finished film. Everything but speeds is kept by the search.

use super::cost::{path_of, sampled};
use super::limit::measured;
use super::motion::MotionSegment;
use super::program::{Level, Limit, Program};
use super::world::World;
use cinesplat_trajectory::{CameraPath, CameraState, Keyframe, ReportLine};

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
    let path = CameraPath::fine(keys.to_vec(), world.frame);
    program.limits.iter().map(|limit| line(world, limit, &path, keys)).collect()
}

fn line(world: &World, limit: &Limit, path: &CameraPath, keys: &[Keyframe]) -> ReportLine {
    let clause = limit_words(world, limit);
    if let Limit::Speed(most) | Limit::TurnSpeed(most) = *limit {
        let fastest = fastest(keys, path);
        let (got, unit) = match limit {
            Limit::Speed(_) => (fastest[0], "scene units"),
            _ => (fastest[1], "degrees"),
        };
        let met = got <= most * (1.0 + SPEED_TOLERANCE);
        let note = if met { String::new() } else { "the length that the words state leaves no time for it".to_owned() };
        return ReportLine { clause, wanted: format!("at most {most:.2} {unit} a second"), got, met, note };
    }
    let tolerance = TOLERANCE_FRAC * world.bounds.size();
    let states = times(keys).into_iter().map(|time| path.sample(time));
    let worst = states.map(|state| measured(world, limit, &state)).max_by(|(a, band), (b, _)| {
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

/// Times of a film at which limits are measured.
fn times(keys: &[Keyframe]) -> Vec<f64> {
    let between = |pair: &[Keyframe]| {
        let (from, to) = (pair[0].time_secs, pair[1].time_secs);
        let num = if pair[1].cut { 1 } else { SAMPLES_PER_INTERVAL };
        (0..num).map(|i| from + (to - from) * i as f64 / num as f64).collect::<Vec<_>>()
    };
    let last = keys.last().map(|key| key.time_secs);
    keys.windows(2).flat_map(between).chain(last).collect()
}

/// Largest speed of a film, scene units a second, and its fastest turn, degrees a second. Cuts do not count.
fn fastest(keys: &[Keyframe], path: &CameraPath) -> [f64; 2] {
    let mut fastest = [0.0_f64; 2];
    for pair in keys.windows(2).filter(|pair| !pair[1].cut) {
        let (from, to) = (pair[0].time_secs, pair[1].time_secs);
        let at = |i: usize| path.sample(from + (to - from) * i as f64 / SAMPLES_PER_INTERVAL as f64);
        let states: Vec<CameraState> = (0..=SAMPLES_PER_INTERVAL).map(at).collect();
        let speeds = speeds(&states, (to - from) / SAMPLES_PER_INTERVAL as f64);
        fastest = [fastest[0].max(speeds[0]), fastest[1].max(speeds[1])];
    }
    fastest
}

/// Largest speed and fastest turn between samples that are `secs` apart.
fn speeds(states: &[CameraState], secs: f64) -> [f64; 2] {
    let mut fastest = [0.0_f64; 2];
    for pair in states.windows(2).filter(|_| secs > 0.0) {
        let way = pair[0].pose.position.distance(pair[1].pose.position);
        let turn = pair[0].pose.rotation.angle_between(pair[1].pose.rotation).to_degrees();
        fastest = [fastest[0].max(way / secs), fastest[1].max(turn / secs)];
    }
    fastest
}

/// What a film exceeds the program's speeds by: 1 where it keeps them.
pub(super) fn haste(world: &World, program: &Program, keys: &[Keyframe]) -> f64 {
    if !has_speeds(program) {
        return 1.0;
    }
    let fastest = fastest(keys, &CameraPath::fine(keys.to_vec(), world.frame));
    over(program, fastest)
}

/// Whether a program limits speeds.
pub(super) fn has_speeds(program: &Program) -> bool {
    program.limits.iter().any(|limit| matches!(limit, Limit::Speed(_) | Limit::TurnSpeed(_)))
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
        let over = over(program, speeds(&states, segment.secs / (NUM_SAMPLES - 1) as f64));
        segment.secs *= if over > 1.0 { SLACK * over } else { 1.0 };
    }
}

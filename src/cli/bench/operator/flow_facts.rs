//! Stops, turns and speed on the screen of a finished shot, measured on its path alone.

use std::fmt::Write as _;

use glam::{DVec2, DVec3};

use super::statistics::Summary;
use cinesplat::geometry::rotation;
use cinesplat::objects::ObjectSet;
use cinesplat::trajectory::{CameraPath, CameraState, Easing, Keyframe, Move, Shot, TrajectoryError};

/// Header of the lines of [`FlowFacts::csv_line`].
pub(super) const CSV_HEADER: &str = "film,clauses,duration_secs,rest_before_secs,rest_inside_secs,rest_after_secs,\
                                     join_speed_frac,join_turn_deg_s,peak_turn_deg_s,screen_speed,moves\n";

/// Time between two samples.
const STEP_SECS: f64 = 0.02;
/// Speed of the picture below which the camera rests, over the median speed of the film.
const REST_FRAC: f64 = 0.1;
/// Time on both sides of the end of a step in which its join lies.
const JOIN_SECS: f64 = 1.0;
/// Points of the picture whose way is measured, as fractions of the frame from its middle.
const GRID: [f64; 5] = [-0.4, -0.2, 0.0, 0.2, 0.4];

/// What a shot does between its moves.
#[derive(Debug, Clone)]
pub(super) struct FlowFacts {
    /// Steps with words of their own.
    clauses: usize,
    duration_secs: f64,
    /// Rest before the first motion, between the first and the last one, and after it. Steps that hold do not count as
    /// rest between.
    rest_secs: [f64; 3],
    /// Least speed of the picture near the end of a step that another one follows without a cut, hold or whip, over the
    /// median speed; `None` without such a join.
    join_speed_frac: Option<f64>,
    /// Fastest turn there, degrees per second.
    join_turn_deg_s: Option<f64>,
    peak_turn_deg_s: f64,
    /// Median speed of the picture in motion, frame widths per second.
    screen_speed: f64,
    /// Move and duration of each stretch.
    moves: Vec<(Move, f64)>,
}

impl FlowFacts {
    /// Measures a shot. `objects` give the distance of the picture's subject.
    pub(super) fn of(shot: &Shot, objects: &ObjectSet) -> Result<Self, TrajectoryError> {
        let path = CameraPath::new(shot)?;
        let count = (shot.duration_secs / STEP_SECS).ceil().max(1.0) as usize;
        let states: Vec<CameraState> = (0..=count).map(|i| path.sample(i as f64 * STEP_SECS)).collect();
        let keys = &shot.keyframes;
        let key_at = |i: usize| &keys[keys.partition_point(|k| k.time_secs <= i as f64 * STEP_SECS).max(1) - 1];
        let speeds: Vec<f64> =
            (0..count).map(|i| screen_speed(&states[i..i + 2], depth(key_at(i), &states[i], objects))).collect();
        let turns: Vec<f64> = states.windows(2).map(turn_deg_s).collect();
        let mut moving: Vec<f64> = speeds.iter().copied().filter(|speed| *speed > 1e-4).collect();
        moving.sort_by(f64::total_cmp);
        let median = moving.get(moving.len() / 2).copied().unwrap_or(0.0);
        let rests = |i: usize| speeds[i] < REST_FRAC * median || median <= 0.0;
        let first = (0..count).find(|&i| !rests(i)).unwrap_or(count);
        let last = (0..count).rev().find(|&i| !rests(i)).unwrap_or(0);
        let asked = |i: usize| key_at(i).intent.as_ref().is_some_and(|intent| is_still(intent.movement));
        let inside = (first..last).filter(|&i| rests(i) && !asked(i)).count();
        let near = |secs: f64| {
            let index = |secs: f64| ((secs / STEP_SECS).max(0.0) as usize).min(count);
            index(secs - JOIN_SECS)..index(secs + JOIN_SECS)
        };
        let joins = joins(keys);
        let over = |values: &[f64], pick: fn(f64, f64) -> f64| {
            joins.iter().filter_map(|&secs| values[near(secs)].iter().copied().reduce(pick)).reduce(pick)
        };
        Ok(Self {
            clauses: clauses(keys),
            duration_secs: shot.duration_secs,
            rest_secs: [first, inside, count.saturating_sub(last + 1)].map(|n| n as f64 * STEP_SECS),
            join_speed_frac: over(&speeds, f64::min).map(|speed| speed / median.max(1e-9)),
            join_turn_deg_s: over(&turns, f64::max),
            peak_turn_deg_s: turns.iter().copied().fold(0.0, f64::max),
            screen_speed: median,
            moves: stretches(keys),
        })
    }

    /// One line of the table.
    pub(super) fn csv_line(&self, film: &str) -> String {
        let number = |value: Option<f64>| value.map_or_else(String::new, |value| format!("{value:.2}"));
        let moves: Vec<String> = self.moves.iter().map(|(name, secs)| format!("{}:{secs:.1}", name.as_ref())).collect();
        let [before, inside, after] = self.rest_secs;
        let mut text = format!("{film},{},{:.2},{before:.2},{inside:.2},{after:.2},", self.clauses, self.duration_secs);
        let (speed, turn) = (number(self.join_speed_frac), number(self.join_turn_deg_s));
        let _ = write!(text, "{speed},{turn},{:.1},{:.3},", self.peak_turn_deg_s, self.screen_speed);
        text + &moves.join("|") + "\n"
    }
}

/// Stops and turns at the joins of all films, and the median duration of every move.
pub(super) fn summary(films: &[FlowFacts]) -> String {
    let joined: Vec<&FlowFacts> = films.iter().filter(|film| film.join_speed_frac.is_some()).collect();
    let stops = joined.iter().filter(|film| film.join_speed_frac.is_some_and(|speed| speed < REST_FRAC)).count();
    let turns: Vec<f64> = joined.iter().filter_map(|film| film.join_turn_deg_s).collect();
    let durations: Vec<f64> = films.iter().map(|film| film.duration_secs).collect();
    let Summary { median, largest, .. } = Summary::of(&durations);
    let mut text = format!("{} films, {median:.1} s in the median, {largest:.1} s at most; ", films.len());
    let Summary { median, largest, .. } = Summary::of(&turns);
    let _ = write!(
        text,
        "{stops} of {} with joins stop in one; fastest turn at a join {median:.0} degrees per second in the median, \
         {largest:.0} at most",
        joined.len()
    );
    let mut all: Vec<(Move, f64)> = films.iter().flat_map(|film| film.moves.iter().copied()).collect();
    all.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
    for group in all.chunk_by(|a, b| a.0 == b.0) {
        let (low, middle, high) = (group[0].1, group[group.len() / 2].1, group[group.len() - 1].1);
        let _ = write!(text, "\n{}: {middle:.1} s, {low:.1} to {high:.1} ({})", group[0].0.as_ref(), group.len());
    }
    text
}

fn movement(key: &Keyframe) -> Option<Move> {
    key.intent.as_ref().and_then(|intent| intent.movement)
}

fn is_still(movement: Option<Move>) -> bool {
    matches!(movement, Some(Move::Static | Move::Handheld | Move::WhipPan | Move::RackFocus))
}

fn words(key: &Keyframe) -> Option<[usize; 2]> {
    key.intent.as_ref().and_then(|intent| intent.words)
}

fn clauses(keys: &[Keyframe]) -> usize {
    let mut all: Vec<_> = keys.iter().map(words).collect();
    all.dedup();
    all.len()
}

/// Times at which a step gives way to another one in motion.
fn joins(keys: &[Keyframe]) -> Vec<f64> {
    let joins = |pair: &&[Keyframe]| {
        let still = is_still(movement(&pair[0])) || is_still(movement(&pair[1]));
        words(&pair[0]) != words(&pair[1]) && !pair[1].cut && !still
    };
    keys.windows(2).filter(joins).map(|pair| pair[1].time_secs).collect()
}

/// The moves of a film with their durations, half of each blend given to either side, without the rests at the ends.
fn stretches(keys: &[Keyframe]) -> Vec<(Move, f64)> {
    let mut out: Vec<(Move, f64)> = Vec::new();
    let mut half = 0.0;
    for pair in keys.windows(2) {
        let secs = pair[1].time_secs - pair[0].time_secs;
        let rests = pair[0].pose == pair[1].pose && (pair[0].fov_y_rad - pair[1].fov_y_rad).abs() < 1e-12;
        let Some(name) = movement(&pair[0]).filter(|name| !pair[1].cut && (!rests || is_still(Some(*name)))) else {
            continue;
        };
        match out.last_mut() {
            Some(last) if pair[0].easing == Easing::Blend => {
                last.1 += secs / 2.0;
                half = secs / 2.0;
            }
            Some(last) if last.0 == name && half <= 0.0 => last.1 += secs,
            _ => {
                out.push((name, secs + half));
                half = 0.0;
            }
        }
    }
    out
}

fn turn_deg_s(pair: &[CameraState]) -> f64 {
    rotation::angle_between(pair[0].pose.rotation, pair[1].pose.rotation).to_degrees() / STEP_SECS
}

/// Distance of the subject along the view axis; 1 where none is known, which leaves turns and zooms as they are.
fn depth(key: &Keyframe, state: &CameraState, objects: &ObjectSet) -> f64 {
    let subject = key.intent.as_ref().and_then(|intent| intent.subjects.first().copied());
    let center = subject.and_then(|id| objects.objects.iter().find(|object| object.id == id)).map(|o| o.center);
    center.map(|center| state.pose.to_camera(center).z).filter(|depth| *depth > 0.05).unwrap_or(1.0)
}

/// Median speed of the picture between two samples, of the subject's distance or twice that, whichever is faster; frame
/// widths per second.
fn screen_speed(pair: &[CameraState], depth: f64) -> f64 {
    let (tan, next_tan) = ((pair[0].fov_y_rad / 2.0).tan(), (pair[1].fov_y_rad / 2.0).tan());
    let way = |at: DVec2, depth: f64| {
        let point = pair[0].pose.position + pair[0].pose.rotation * (DVec3::new(at.x * tan, at.y * tan, 1.0) * depth);
        let seen = pair[1].pose.to_camera(point);
        (DVec2::new(seen.x, seen.y) / (seen.z.max(1e-9) * next_tan) - at).length()
    };
    let at_depth = |depth: f64| {
        let points = GRID.iter().flat_map(|&x| GRID.iter().map(move |&y| DVec2::new(x * 32.0 / 9.0, 2.0 * y)));
        let mut ways: Vec<f64> = points.map(|at| way(at, depth)).collect();
        ways.sort_by(f64::total_cmp);
        ways[ways.len() / 2]
    };
    // A frame is 32 / 9 half heights wide.
    at_depth(depth).max(at_depth(2.0 * depth)) / (32.0 / 9.0) / STEP_SECS
}

//! The camera path as samples, in runs between cuts.

use cinesplat_trajectory::{CameraPath, CameraState, Keyframe, Shot, TrajectoryError};
use glam::DVec3;

/// Samples per second of film.
const RATE_HZ: f64 = 60.0;
/// Least and most samples of a run.
const NUM_SAMPLES: (f64, f64) = (24.0, 2400.0);
/// Rounding of positions, over their largest coordinate.
const ROUNDING: f64 = 1e-9;
/// Time before a cut at which the run before it ends, seconds.
const BEFORE_CUT_SECS: f64 = 1e-6;

/// The camera at one moment.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Sample {
    pub(crate) time_secs: f64,
    pub(crate) state: CameraState,
    /// Speed of travel, scene units per second.
    pub(crate) speed: f64,
}

/// The whole path of a shot.
#[derive(Debug)]
pub(crate) struct Route {
    path: CameraPath,
    /// Samples between two cuts, in order of time; each run has at least two.
    pub(crate) runs: Vec<Vec<Sample>>,
    /// Keys within the film.
    pub(crate) keys: Vec<Keyframe>,
    pub(crate) duration_secs: f64,
}

impl Route {
    pub(crate) fn new(shot: &Shot) -> Result<Self, TrajectoryError> {
        let path = CameraPath::new(shot)?;
        let end = shot.duration_secs;
        let keys: Vec<Keyframe> = shot.keyframes.iter().filter(|key| key.time_secs <= end + 1e-6).cloned().collect();
        let keys = if keys.is_empty() { shot.keyframes[..1].to_vec() } else { keys };
        let cuts = keys.iter().skip(1).filter(|key| key.cut && key.time_secs < end).map(|key| key.time_secs);
        let starts: Vec<f64> = std::iter::once(0.0).chain(cuts).collect();
        let ends = starts.iter().skip(1).map(|cut| cut - BEFORE_CUT_SECS).chain([end]);
        let mut runs: Vec<Vec<Sample>> = starts.iter().zip(ends).map(|(start, end)| run(&path, *start, end)).collect();
        let places = || runs.iter().flatten().map(|sample| sample.state.pose.position);
        let rounding = ROUNDING * places().map(|place| place.abs().max_element()).fold(0.0, f64::max);
        if places().all(|place| place.distance(runs[0][0].state.pose.position) <= rounding) {
            // What is left of the motion of a camera that stays in place is rounding.
            runs.iter_mut().flatten().for_each(|sample| sample.speed = 0.0);
        }
        Ok(Self { path, runs, keys, duration_secs: end })
    }

    pub(crate) fn samples(&self) -> impl Iterator<Item = &Sample> {
        self.runs.iter().flatten()
    }

    pub(crate) fn at(&self, time_secs: f64) -> CameraState {
        self.path.sample(time_secs)
    }

    pub(crate) fn first(&self) -> CameraState {
        self.at(0.0)
    }

    pub(crate) fn last(&self) -> CameraState {
        self.at(self.duration_secs)
    }

    /// Least and greatest speed, scene units per second.
    pub(crate) fn speeds(&self) -> (f64, f64) {
        let speeds = self.samples().map(|sample| sample.speed);
        speeds.fold((f64::INFINITY, 0.0), |(low, high), speed| (low.min(speed), high.max(speed)))
    }

    /// Length of the path without its cuts, scene units.
    pub(crate) fn length(&self) -> f64 {
        let steps = |run: &Vec<Sample>| -> f64 { run.windows(2).map(|pair| step(&pair[0], &pair[1]).length()).sum() };
        if self.speeds().1 > 0.0 { self.runs.iter().map(steps).sum() } else { 0.0 }
    }
}

fn step(from: &Sample, to: &Sample) -> DVec3 {
    to.state.pose.position - from.state.pose.position
}

fn run(path: &CameraPath, start: f64, end: f64) -> Vec<Sample> {
    let num = ((end - start).max(0.0) * RATE_HZ).ceil().clamp(NUM_SAMPLES.0, NUM_SAMPLES.1) as usize;
    let time = |i: usize| start + (end - start).max(0.0) * i as f64 / num as f64;
    let mut samples: Vec<Sample> =
        (0..=num).map(|i| Sample { time_secs: time(i), state: path.sample(time(i)), speed: 0.0 }).collect();
    for i in 0..samples.len() {
        let (before, after) = (samples[i.saturating_sub(1)], samples[(i + 1).min(num)]);
        let secs = after.time_secs - before.time_secs;
        samples[i].speed = if secs > 0.0 { step(&before, &after).length() / secs } else { 0.0 };
    }
    samples
}

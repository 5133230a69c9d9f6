//! Measurements of a continuous path from dense samples.

use glam::{DQuat, DVec3};

use cinesplat::geometry::{LevelFrame, rotation};
use cinesplat::trajectory::{CameraPath, CameraState, Shot};

/// Number of samples of a path.
const NUM_SAMPLES: usize = 20_001;
/// Time step of a velocity by finite differences.
const INSTANT_SECS: f64 = 1e-5;

/// A shot's path with samples at uniform times.
pub(super) struct Sampled<'a> {
    shot: &'a Shot,
    path: CameraPath,
    pub(super) states: Vec<CameraState>,
}

impl<'a> Sampled<'a> {
    pub(super) fn new(shot: &'a Shot) -> Result<Self, cinesplat::trajectory::TrajectoryError> {
        let path = CameraPath::new(shot)?;
        let at = |i: usize| path.sample(shot.duration_secs * i as f64 / (NUM_SAMPLES - 1) as f64);
        let states = (0..NUM_SAMPLES).map(at).collect();
        Ok(Self { shot, path, states })
    }

    /// Largest relative deviation of the horizontal distance to the upright axis through `pivot` from its first value.
    pub(super) fn radius_error(&self, frame: &LevelFrame, pivot: DVec3) -> f64 {
        let radius = |state: &CameraState| frame.horizontal(state.pose.position - pivot).length();
        let first = radius(&self.states[0]);
        self.states.iter().map(|state| (radius(state) / first - 1.0).abs()).fold(0.0, f64::max)
    }

    /// Standard deviation of the speed over its mean, between two times given as fractions 0..=1 of the duration.
    pub(super) fn speed_variation(&self, [from, to]: [f64; 2]) -> f64 {
        let index = |share: f64| (share * (NUM_SAMPLES - 1) as f64) as usize;
        let part = &self.states[index(from)..=index(to)];
        let steps: Vec<f64> = part.windows(2).map(|p| p[0].pose.position.distance(p[1].pose.position)).collect();
        let mean = steps.iter().sum::<f64>() / steps.len() as f64;
        let variance = steps.iter().map(|step| (step - mean).powi(2)).sum::<f64>() / steps.len() as f64;
        variance.sqrt() / mean
    }

    /// Number of steps at more than 90 degrees from the previous step.
    pub(super) fn num_reversals(&self) -> usize {
        let step = |pair: &[CameraState]| pair[1].pose.position - pair[0].pose.position;
        let steps: Vec<DVec3> = self.states.windows(2).map(step).collect();
        steps.windows(2).filter(|pair| pair[0].dot(pair[1]) < 0.0).count()
    }

    /// Largest jump of velocity and of angular velocity at an inner key without a cut, each relative to its peak.
    pub(super) fn velocity_jumps(&self) -> (f64, f64) {
        let (mut jump, mut turn_jump) = (0.0_f64, 0.0_f64);
        let (mut peak, mut turn_peak) = (f64::MIN_POSITIVE, f64::MIN_POSITIVE);
        let cut_after = |i: usize| self.shot.keyframes.get(i + 1).is_some_and(|key| key.cut);
        for (i, key) in self.shot.keyframes.iter().enumerate().skip(1) {
            let last = i + 1 == self.shot.keyframes.len();
            if last || key.cut || cut_after(i) {
                continue;
            }
            let (before, after) = (self.velocity(key.time_secs - 2.0 * INSTANT_SECS), self.velocity(key.time_secs));
            jump = jump.max((before.0 - after.0).length());
            turn_jump = turn_jump.max((before.1 - after.1).length());
        }
        for i in 0..1000 {
            let (speed, turn) = self.velocity(self.shot.duration_secs * f64::from(i) / 1000.0);
            peak = peak.max(speed.length());
            turn_peak = turn_peak.max(turn.length());
        }
        (jump / peak, if turn_peak > 1e-9 { turn_jump / turn_peak } else { 0.0 })
    }

    /// Velocity and angular velocity (world axes, rad per second) just after a time.
    fn velocity(&self, time_secs: f64) -> (DVec3, DVec3) {
        let (a, b) = (self.path.sample(time_secs), self.path.sample(time_secs + INSTANT_SECS));
        let turn: DQuat = b.pose.rotation * a.pose.rotation.conjugate();
        ((b.pose.position - a.pose.position) / INSTANT_SECS, rotation::log(turn) / INSTANT_SECS)
    }

    /// Largest over smallest value, minus 1, of a positive quantity of the camera.
    pub(super) fn drift(&self, quantity: impl Fn(&CameraState) -> f64) -> f64 {
        let values = self.states.iter().map(quantity);
        let (low, high) = values.fold((f64::INFINITY, 0.0_f64), |(low, high), v| (low.min(v), high.max(v)));
        high / low - 1.0
    }
}

/// Projected height of points over the height of the picture.
pub(super) fn height_frac(state: &CameraState, points: &[DVec3]) -> f64 {
    let row = |point: &DVec3| {
        let p = state.pose.to_camera(*point);
        p.y / (2.0 * p.z * (state.fov_y_rad / 2.0).tan())
    };
    let rows = points.iter().map(row);
    let (low, high) = rows.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
    high - low
}

//! How smoothly a path moves and turns.
//!
//! Position and rotation are measured apart, since scene units and radians do not add. Reference: S. Balasubramanian et
//! al., "On the analysis of movement smoothness", Journal of Neuroengineering and Rehabilitation 12:112, 2015 (spectral
//! arc length, log dimensionless jerk).

use glam::{DQuat, DVec3};

use super::Trajectory;
use super::fourier::magnitudes;
use cinesplat_geometry::rotation;

/// Frequencies above do not count in the spectral arc length, Hz.
const MAX_FREQUENCY_HZ: f64 = 10.0;
/// Amplitudes below this share of the largest do not count either, above the last frequency that reaches it.
const MIN_AMPLITUDE: f64 = 0.05;
/// Zero padding: the transform is this power of two longer than the signal.
const PAD_LEVEL: u32 = 4;
/// Share of the high speed (the 90th percentile) at which the cruise starts and ends.
const CRUISE_SHARE: f64 = 0.8;
/// Speeds below this share of the highest are standing still, and say nothing about smoothness.
const STILL_SHARE: f64 = 1e-9;

/// Smoothness of a path. Fields of position are in scene units, those of rotation in rad; `None` where nothing moves or
/// there are too few frames.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Smoothness {
    /// Root mean square of the third derivative of the position, units / s^3.
    pub jerk_rms: Option<f64>,
    /// Its largest magnitude.
    pub jerk_max: Option<f64>,
    /// The same for the rotation, rad / s^3.
    pub angular_jerk_rms: Option<f64>,
    /// Its largest magnitude.
    pub angular_jerk_max: Option<f64>,
    /// Spectral arc length of the speed: below 0, nearer to 0 is smoother.
    pub spectral_arc_length: Option<f64>,
    /// The same for the speed of turning.
    pub angular_spectral_arc_length: Option<f64>,
    /// Log dimensionless jerk, -ln(T^3 / peak^2 * integral of the squared second derivative of velocity): higher is
    /// smoother.
    pub log_dimensionless_jerk: Option<f64>,
    /// The same for turning.
    pub angular_log_dimensionless_jerk: Option<f64>,
    /// Speed ripple: standard deviation over mean of the speed while cruising, that is from the first to the last step
    /// that reaches 80 % of the 90th percentile speed.
    pub speed_ripple: Option<f64>,
    /// The same for turning.
    pub angular_speed_ripple: Option<f64>,
    /// Steps that go back against the step before.
    pub num_reversals: usize,
}

/// Smoothness of poses at even times; `None` where a path has no times or they do not increase.
///
/// Steps are taken at the mean frame time: a path with gaps should be resampled first.
pub fn smoothness(path: &Trajectory) -> Option<Smoothness> {
    let times = path.times_secs.as_ref()?;
    let span = times.last()? - times.first()?;
    let step_secs = span / (times.len() as f64 - 1.0);
    if !(step_secs > 0.0) {
        return None;
    }
    let velocity: Vec<DVec3> = path.positions.windows(2).map(|pair| (pair[1] - pair[0]) / step_secs).collect();
    let turns: Vec<DQuat> = path.rotations.iter().map(|matrix| DQuat::from_mat3(matrix).normalize()).collect();
    // World axes, so that the rates of neighboring steps may be subtracted.
    let rate = |pair: &[DQuat]| rotation::log(pair[1] * pair[0].conjugate()) / step_secs;
    let turning: Vec<DVec3> = turns.windows(2).map(rate).collect();
    let extent = path.positions.iter().map(|p| p.length()).fold(0.0, f64::max);
    let moving = Motion::new(&velocity, step_secs, extent * STILL_SHARE / step_secs);
    let turning = Motion::new(&turning, step_secs, STILL_SHARE / step_secs);
    let back = |pair: &&[DVec3]| pair[0].dot(pair[1]) < 0.0;
    Some(Smoothness {
        jerk_rms: moving.jerk_rms(),
        jerk_max: moving.jerk_max(),
        angular_jerk_rms: turning.jerk_rms(),
        angular_jerk_max: turning.jerk_max(),
        spectral_arc_length: moving.spectral_arc_length(),
        angular_spectral_arc_length: turning.spectral_arc_length(),
        log_dimensionless_jerk: moving.log_dimensionless_jerk(),
        angular_log_dimensionless_jerk: turning.log_dimensionless_jerk(),
        speed_ripple: moving.ripple(),
        angular_speed_ripple: turning.ripple(),
        num_reversals: velocity.windows(2).filter(back).count(),
    })
}

/// A velocity over time, once it is known to move at all.
struct Motion {
    speed: Vec<f64>,
    /// Magnitudes of the second derivative of the velocity.
    jerk: Vec<f64>,
    step_secs: f64,
    moves: bool,
}

impl Motion {
    fn new(velocity: &[DVec3], step_secs: f64, still_speed: f64) -> Self {
        let second = |v: &[DVec3]| (v[0] - 2.0 * v[1] + v[2]).length() / (step_secs * step_secs);
        let speed: Vec<f64> = velocity.iter().map(|v| v.length()).collect();
        let moves = speed.iter().any(|speed| *speed > still_speed);
        Self { jerk: velocity.windows(3).map(second).collect(), speed, step_secs, moves }
    }

    fn peak(&self) -> f64 {
        self.speed.iter().copied().fold(0.0, f64::max)
    }

    fn mean_square_jerk(&self) -> Option<f64> {
        let count = self.jerk.len() as f64;
        (self.moves && count > 0.0).then(|| self.jerk.iter().map(|jerk| jerk * jerk).sum::<f64>() / count)
    }

    fn jerk_rms(&self) -> Option<f64> {
        self.mean_square_jerk().map(f64::sqrt)
    }

    fn jerk_max(&self) -> Option<f64> {
        self.mean_square_jerk().map(|_| self.jerk.iter().copied().fold(0.0, f64::max))
    }

    fn log_dimensionless_jerk(&self) -> Option<f64> {
        let duration = self.step_secs * self.speed.len() as f64;
        let squared = self.jerk.iter().map(|jerk| jerk * jerk).sum::<f64>() * self.step_secs;
        let jerk = duration.powi(3) / self.peak().powi(2) * squared;
        // An even speed has no jerk but rounding: its logarithm says nothing.
        self.mean_square_jerk().filter(|_| jerk > 1e-12).map(|_| -jerk.ln())
    }

    fn spectral_arc_length(&self) -> Option<f64> {
        if !self.moves || self.speed.len() < 3 {
            return None;
        }
        let len = self.speed.len().next_power_of_two() << PAD_LEVEL;
        let spectrum = magnitudes(&self.speed, len);
        let largest = spectrum.iter().copied().fold(0.0, f64::max);
        let hz_a_bin = 1.0 / (self.step_secs * len as f64);
        let in_band = spectrum.iter().enumerate().take_while(|(bin, _)| *bin as f64 * hz_a_bin <= MAX_FREQUENCY_HZ);
        let normalized: Vec<f64> = in_band.map(|(_, amplitude)| amplitude / largest).collect();
        let first = normalized.iter().position(|amplitude| *amplitude >= MIN_AMPLITUDE)?;
        let last = normalized.iter().rposition(|amplitude| *amplitude >= MIN_AMPLITUDE)?;
        let width = (last - first) as f64;
        let arc = |pair: &[f64]| (pair[1] - pair[0]).hypot(1.0 / width);
        (last > first).then(|| -normalized[first..=last].windows(2).map(arc).sum::<f64>())
    }

    fn ripple(&self) -> Option<f64> {
        let mut sorted = self.speed.clone();
        sorted.sort_by(f64::total_cmp);
        let high = *sorted.get(sorted.len().saturating_sub(1) * 9 / 10).filter(|_| self.moves)?;
        let fast = |speed: &f64| *speed >= CRUISE_SHARE * high;
        let (first, last) = (self.speed.iter().position(fast)?, self.speed.iter().rposition(fast)?);
        let cruise = &self.speed[first..=last];
        let mean = cruise.iter().sum::<f64>() / cruise.len() as f64;
        let variance = cruise.iter().map(|speed| (speed - mean).powi(2)).sum::<f64>() / cruise.len() as f64;
        (mean > 0.0).then(|| variance.sqrt() / mean)
    }
}

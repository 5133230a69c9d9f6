//! Smoothness of a path's translation and rotation.
//!
//! Both are measured separately, because scene units and radians do not add. Reference: S. Balasubramanian et al., "On
//! the analysis of movement smoothness", Journal of Neuroengineering and Rehabilitation 12:112, 2015 (spectral arc
//! length, log dimensionless jerk).

use glam::{DQuat, DVec3};

use super::Trajectory;
use super::fourier::magnitudes;
use cinesplat_geometry::rotation;

/// Highest frequency in the spectral arc length, Hz.
const MAX_FREQUENCY_HZ: f64 = 10.0;
/// The spectral arc length runs from the first to the last frequency whose amplitude is at least this fraction of the
/// largest.
const MIN_AMPLITUDE: f64 = 0.05;
/// Zero padding: log2 of the length of the transform over that of the signal.
const PAD_LEVEL: u32 = 4;
/// Speed at which the cruise starts and ends, as a fraction of the 90th percentile of the speed.
const CRUISE_FRAC: f64 = 0.8;
/// A path whose steps are all below this fraction of its distance from the origin (or below this angle, rad) is
/// stationary.
const STILL_FRAC: f64 = 1e-9;

/// Smoothness of a path. Values of the translation are in scene units, those of the rotation (`angular_`) in rad. A
/// value is `None` if the path does not move or has too few frames.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Smoothness {
    /// Root mean square of the third derivative of the position, scene units / s^3.
    pub jerk_rms: Option<f64>,
    /// Largest magnitude of the third derivative of the position, scene units / s^3.
    pub jerk_max: Option<f64>,
    /// Root mean square of the second derivative of the angular velocity, rad / s^3.
    pub angular_jerk_rms: Option<f64>,
    /// Largest magnitude of the second derivative of the angular velocity, rad / s^3.
    pub angular_jerk_max: Option<f64>,
    /// Spectral arc length of the speed, below 0. Values nearer to 0 are smoother.
    pub spectral_arc_length: Option<f64>,
    /// Spectral arc length of the angular speed.
    pub angular_spectral_arc_length: Option<f64>,
    /// Log dimensionless jerk: -ln(T^3 / peak^2 * integral of the squared second derivative of the velocity). Higher
    /// values are smoother.
    pub log_dimensionless_jerk: Option<f64>,
    /// Log dimensionless jerk of the rotation.
    pub angular_log_dimensionless_jerk: Option<f64>,
    /// Standard deviation over mean of the speed during the cruise: from the first to the last step with at least 80 %
    /// of the 90th percentile of the speed.
    pub speed_ripple: Option<f64>,
    /// The same for the angular speed.
    pub angular_speed_ripple: Option<f64>,
    /// Number of steps at more than 90 degrees from the previous step.
    pub num_reversals: usize,
}

/// Smoothness of poses at uniform times; `None` if the path has no times or they do not increase.
///
/// Derivatives use the mean frame time, so resample a path with gaps first.
pub fn smoothness(path: &Trajectory) -> Option<Smoothness> {
    let times = path.times_secs.as_ref()?;
    let span = times.last()? - times.first()?;
    let step_secs = span / (times.len() as f64 - 1.0);
    if !(step_secs > 0.0) {
        return None;
    }
    let velocity: Vec<DVec3> = path.positions.windows(2).map(|pair| (pair[1] - pair[0]) / step_secs).collect();
    let turns: Vec<DQuat> = path.rotations.iter().map(|matrix| DQuat::from_mat3(matrix).normalize()).collect();
    // In world axes, so that the rates of neighboring steps can be subtracted.
    let rate = |pair: &[DQuat]| rotation::log(pair[1] * pair[0].conjugate()) / step_secs;
    let turning: Vec<DVec3> = turns.windows(2).map(rate).collect();
    let extent = path.positions.iter().map(|p| p.length()).fold(0.0, f64::max);
    let moving = VelocitySeries::new(&velocity, step_secs, extent * STILL_FRAC / step_secs);
    let turning = VelocitySeries::new(&turning, step_secs, STILL_FRAC / step_secs);
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

/// A velocity over time.
struct VelocitySeries {
    /// Magnitudes of the velocity.
    speed: Vec<f64>,
    /// Magnitudes of the second derivative of the velocity.
    jerk: Vec<f64>,
    step_secs: f64,
    /// Whether any step is above the speed that counts as still.
    moves: bool,
}

impl VelocitySeries {
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
        // The jerk at constant speed is rounding error, whose logarithm is meaningless.
        self.mean_square_jerk().filter(|_| jerk > 1e-12).map(|_| -jerk.ln())
    }

    fn spectral_arc_length(&self) -> Option<f64> {
        if !self.moves || self.speed.len() < 3 {
            return None;
        }
        let len = self.speed.len().next_power_of_two() << PAD_LEVEL;
        let spectrum = magnitudes(&self.speed, len);
        let largest = spectrum.iter().copied().fold(0.0, f64::max);
        let hz_per_bin = 1.0 / (self.step_secs * len as f64);
        let in_band = spectrum.iter().enumerate().take_while(|(bin, _)| *bin as f64 * hz_per_bin <= MAX_FREQUENCY_HZ);
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
        let fast = |speed: &f64| *speed >= CRUISE_FRAC * high;
        let (first, last) = (self.speed.iter().position(fast)?, self.speed.iter().rposition(fast)?);
        let cruise = &self.speed[first..=last];
        let mean = cruise.iter().sum::<f64>() / cruise.len() as f64;
        let variance = cruise.iter().map(|speed| (speed - mean).powi(2)).sum::<f64>() / cruise.len() as f64;
        (mean > 0.0).then(|| variance.sqrt() / mean)
    }
}

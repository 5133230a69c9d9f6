//! Speed over the time of one segment: a ramp, then a cruise at constant speed or the curve of an easing, then a ramp.

use super::Easing;
use super::easing::Curve;

/// Longest ramp from rest to cruise. A longer one makes short moves sluggish, a shorter one jolts at 24 frames per
/// second.
const RAMP_SECS: f64 = 1.2;
/// Largest fraction of a segment's time for one ramp; leaves time for a cruise between two.
const RAMP_FRAC: f64 = 0.35;
/// Fraction of a segment's time in which the curve of an easing blends into the speed of a neighbor. It is short so
/// that the curve keeps its shape, and so that two blends at twice the steepest slope of any curve do not use up the
/// length.
const CURVE_RAMP_FRAC: f64 = 0.12;
/// Number of equal time steps in the table of a blended curve.
const NUM_STEPS: usize = 128;

/// Duration of a ramp to or from rest in a segment of a given duration.
pub fn ramp_secs(duration_secs: f64) -> f64 {
    RAMP_SECS.min(RAMP_FRAC * duration_secs)
}

/// Speeds `(start, end)` that an easing gives a segment of mean speed `mean`. An easing without a curve has the speed
/// `cruise` at both ends.
pub(super) fn natural_speeds(easing: Easing, mean: f64, cruise: f64) -> (f64, f64) {
    easing.curve().map_or((cruise, cruise), |curve| (curve.at(0.0).1 * mean, curve.at(1.0).1 * mean))
}

/// Length covered over the time of one segment. Speed is continuous: within one ramp it changes from the speed required
/// at an end to that of the easing.
#[derive(Debug, Clone)]
pub(super) struct SpeedProfile {
    duration_secs: f64,
    length: f64,
    shape: ProfileShape,
}

#[derive(Debug, Clone)]
enum ProfileShape {
    /// A cruise at constant speed between two ramps.
    Cruise { start_speed: f64, end_speed: f64, cruise_speed: f64, ramp_secs: f64 },
    /// The curve of an easing from end to end.
    Curve(Curve),
    /// A curve that blends into another speed at an end: length and speed at uniform times.
    Table(Vec<(f64, f64)>),
}

impl SpeedProfile {
    /// A profile that covers `length` in `duration_secs` (above 0). `ends` are the required speeds at start and end; an
    /// end of `None` keeps the speed of the easing.
    pub(super) fn new(easing: Easing, duration_secs: f64, length: f64, ends: [Option<f64>; 2]) -> Self {
        let Some(curve) = easing.curve() else {
            return Self { duration_secs, length, shape: ProfileShape::cruise(duration_secs, length, ends) };
        };
        let mean = length / duration_secs;
        let natural = [curve.at(0.0).1 * mean, curve.at(1.0).1 * mean];
        let required = |i: usize| ends[i].filter(|speed| (speed - natural[i]).abs() > 1e-9 * mean);
        let shape = match [required(0), required(1)] {
            [None, None] => ProfileShape::Curve(curve),
            ends => ProfileShape::Table(blended_table(curve, duration_secs, length, ends)),
        };
        Self { duration_secs, length, shape }
    }

    /// Time at which the camera has covered a length: 48 bisections of the duration.
    pub(super) fn secs_at(&self, length: f64) -> f64 {
        let (mut low, mut high) = (0.0_f64, self.duration_secs);
        for _ in 0..48 {
            let middle = low.midpoint(high);
            if self.length_at(middle) < length {
                low = middle;
            } else {
                high = middle;
            }
        }
        low.midpoint(high)
    }

    /// Length covered after `secs`, 0..=length, monotone.
    pub(super) fn length_at(&self, secs: f64) -> f64 {
        let left = self.duration_secs - secs;
        if secs <= 0.0 {
            return 0.0;
        }
        if left <= 0.0 {
            return self.length;
        }
        match &self.shape {
            ProfileShape::Curve(curve) => (curve.at(secs / self.duration_secs).0 * self.length).clamp(0.0, self.length),
            ProfileShape::Table(table) => table_length(table, secs, self.duration_secs).clamp(0.0, self.length),
            ProfileShape::Cruise { start_speed, end_speed, cruise_speed, ramp_secs } => {
                let ramped = |secs: f64, speed: f64| ramp_length(secs / ramp_secs, *ramp_secs, (speed, *cruise_speed));
                if left < *ramp_secs {
                    (self.length - ramped(left, *end_speed)).max(0.0)
                } else {
                    let in_ramp = secs.min(*ramp_secs);
                    (ramped(in_ramp, *start_speed) + cruise_speed * (secs - in_ramp)).min(self.length)
                }
            }
        }
    }
}

impl ProfileShape {
    fn cruise(duration_secs: f64, length: f64, ends: [Option<f64>; 2]) -> Self {
        let ramp_secs = ramp_secs(duration_secs);
        // length = cruise (T - r) + (start + end) r / 2: each ramp averages its two speeds. An end without a required
        // speed has the cruise speed.
        let ramped: f64 = ends.iter().flatten().map(|speed| speed * ramp_secs / 2.0).sum();
        let num_ramps = ends.iter().flatten().count() as f64;
        let cruise_speed = ((length - ramped) / (duration_secs - num_ramps * ramp_secs / 2.0)).max(0.0);
        let [start_speed, end_speed] = ends.map(|speed| speed.unwrap_or(cruise_speed));
        Self::Cruise { start_speed, end_speed, cruise_speed, ramp_secs }
    }
}

/// Length covered in the first fraction `x` of a ramp from one speed to another by [`smoothstep`].
fn ramp_length(x: f64, ramp_secs: f64, (from, to): (f64, f64)) -> f64 {
    ramp_secs * (from * x + (to - from) * (x * x * x - x * x * x * x / 2.0))
}

/// Weight of the new speed at a fraction of a ramp: 3 x^2 - 2 x^3.
fn smoothstep(x: f64) -> f64 {
    let x = x.clamp(0.0, 1.0);
    x * x * (3.0 - 2.0 * x)
}

/// Length and speed at uniform times of a curve that blends into the required speeds at its ends.
///
/// The whole curve is scaled so that the length stays the same. The speed is never below 0.
fn blended_table(curve: Curve, duration_secs: f64, length: f64, ends: [Option<f64>; 2]) -> Vec<(f64, f64)> {
    let weight = |end: Option<f64>, x: f64| end.map_or(1.0, |_| smoothstep(x / CURVE_RAMP_FRAC));
    // Speed over mean speed = required end speeds + factor * the curve's own speed.
    let required = |x: f64| {
        let at_end = |end: Option<f64>, x: f64| end.unwrap_or(0.0) * (1.0 - weight(end, x)) * duration_secs / length;
        at_end(ends[0], x) + at_end(ends[1], 1.0 - x)
    };
    let own = |x: f64| curve.at(x).1 * weight(ends[0], x) * weight(ends[1], 1.0 - x);
    let factor = ((1.0 - integral(required)) / integral(own)).max(0.0);
    let speed = |x: f64| required(x) + factor * own(x);
    let total = integral(speed);
    let mut covered = 0.0;
    let mut table = vec![(0.0, speed(0.0) * length / duration_secs)];
    for step in 0..NUM_STEPS {
        covered += step_integral(speed, step) / total;
        let x = (step + 1) as f64 / NUM_STEPS as f64;
        table.push((covered * length, speed(x) * length / duration_secs));
    }
    table
}

/// Integral over 0..1.
fn integral(f: impl Fn(f64) -> f64) -> f64 {
    (0..NUM_STEPS).map(|step| step_integral(&f, step)).sum()
}

/// Integral over one of the equal steps of 0..1, by Simpson's rule.
fn step_integral(f: impl Fn(f64) -> f64, step: usize) -> f64 {
    let at = |i: f64| f((step as f64 + i) / NUM_STEPS as f64);
    (at(0.0) + 4.0 * at(0.5) + at(1.0)) / (6.0 * NUM_STEPS as f64)
}

/// Length between two entries of a table, by the cubic with their lengths and speeds.
fn table_length(table: &[(f64, f64)], secs: f64, duration_secs: f64) -> f64 {
    let step_secs = duration_secs / NUM_STEPS as f64;
    let step = ((secs / step_secs) as usize).min(NUM_STEPS - 1);
    let ((from, from_speed), (to, to_speed)) = (table[step], table[step + 1]);
    let x = secs / step_secs - step as f64;
    let (x2, x3) = (x * x, x * x * x);
    let ends = from * (1.0 - 3.0 * x2 + 2.0 * x3) + to * (3.0 * x2 - 2.0 * x3);
    ends + step_secs * (from_speed * (x - 2.0 * x2 + x3) + to_speed * (x3 - x2))
}

//! Speed over the time of one segment: ramp, even cruise or the curve of an easing, ramp.

use super::Easing;
use super::easing::Curve;

/// Longest ramp from rest to cruise. Longer ones make short moves feel sluggish, shorter ones jolt at 24 frames a second.
const RAMP_SECS: f64 = 1.2;
/// Longest share of a segment that one ramp takes, so that a cruise is left between two.
const RAMP_FRAC: f64 = 0.35;
/// The same where an easing's curve goes over into the speed of a neighbor: short, so that the curve stays what it is, and
/// so that twice the highest slope of any curve still leaves way to cover.
const CURVE_RAMP_FRAC: f64 = 0.12;
/// Even parts of a segment's time for which the way along a curve with ramps is tabulated.
const NUM_PARTS: usize = 128;

/// Time that a ramp to or from rest takes in a segment of a given duration.
pub(super) fn ramp_secs(duration_secs: f64) -> f64 {
    RAMP_SECS.min(RAMP_FRAC * duration_secs)
}

/// Speed that a segment has at its ends when nothing is asked of them, over its mean speed: `(start, end)`; `cruise` is
/// that of the even part of an easing without a curve.
pub(super) fn natural_speeds(easing: Easing, mean: f64, cruise: f64) -> (f64, f64) {
    easing.curve().map_or((cruise, cruise), |curve| (curve.at(0.0).1 * mean, curve.at(1.0).1 * mean))
}

/// Progress along one segment over its time. Velocity is continuous: where a speed is asked for at an end it changes to
/// that of the easing within one ramp.
#[derive(Debug, Clone)]
pub(super) struct SpeedProfile {
    duration_secs: f64,
    length: f64,
    way: Way,
}

#[derive(Debug, Clone)]
enum Way {
    /// An even cruise between two ramps.
    Cruise { start_speed: f64, end_speed: f64, cruise_speed: f64, ramp_secs: f64 },
    /// A curve from end to end.
    Curve(Curve),
    /// A curve that is bent at an end: length and speed at even times.
    Table(Vec<(f64, f64)>),
}

impl SpeedProfile {
    /// A profile that covers `length` in `duration_secs` (above 0); an end without a speed asked for keeps the easing's.
    pub(super) fn new(easing: Easing, duration_secs: f64, length: f64, ends: [Option<f64>; 2]) -> Self {
        let Some(curve) = easing.curve() else {
            return Self { duration_secs, length, way: Way::cruise(duration_secs, length, ends) };
        };
        let mean = length / duration_secs;
        let natural = [curve.at(0.0).1 * mean, curve.at(1.0).1 * mean];
        let asked = |i: usize| ends[i].filter(|speed| (speed - natural[i]).abs() > 1e-9 * mean);
        let way = match [asked(0), asked(1)] {
            [None, None] => Way::Curve(curve),
            ends => Way::Table(bent(curve, duration_secs, length, ends)),
        };
        Self { duration_secs, length, way }
    }

    /// Length covered after `secs` of the segment, 0..=length; monotone.
    pub(super) fn length_at(&self, secs: f64) -> f64 {
        let left = self.duration_secs - secs;
        if secs <= 0.0 {
            return 0.0;
        }
        if left <= 0.0 {
            return self.length;
        }
        match &self.way {
            Way::Curve(curve) => (curve.at(secs / self.duration_secs).0 * self.length).clamp(0.0, self.length),
            Way::Table(table) => from_table(table, secs, self.duration_secs).clamp(0.0, self.length),
            Way::Cruise { start_speed, end_speed, cruise_speed, ramp_secs } => {
                let ramped = |secs: f64, speed: f64| ramped(secs / ramp_secs, *ramp_secs, (speed, *cruise_speed));
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

impl Way {
    fn cruise(duration_secs: f64, length: f64, ends: [Option<f64>; 2]) -> Self {
        let ramp_secs = ramp_secs(duration_secs);
        // length = cruise (T - r) + (start + end) r / 2: each ramp averages its two speeds. Where no speed is asked for, it
        // is the cruise's own.
        let ramped: f64 = ends.iter().flatten().map(|speed| speed * ramp_secs / 2.0).sum();
        let num_ramps = ends.iter().flatten().count() as f64;
        let cruise_speed = ((length - ramped) / (duration_secs - num_ramps * ramp_secs / 2.0)).max(0.0);
        let [start_speed, end_speed] = ends.map(|speed| speed.unwrap_or(cruise_speed));
        Self::Cruise { start_speed, end_speed, cruise_speed, ramp_secs }
    }
}

/// Length covered in the first share `x` of a ramp from one speed to another, by [`blend`].
fn ramped(x: f64, ramp_secs: f64, (from, to): (f64, f64)) -> f64 {
    ramp_secs * (from * x + (to - from) * (x * x * x - x * x * x * x / 2.0))
}

/// Share of the new speed at a share of a ramp: 3 x^2 - 2 x^3.
fn blend(x: f64) -> f64 {
    let x = x.clamp(0.0, 1.0);
    x * x * (3.0 - 2.0 * x)
}

/// Length and speed at even times of a curve that goes over into other speeds at its ends. The curve is slowed or sped
/// up as a whole so that the length stays; the speed is never below 0.
fn bent(curve: Curve, duration_secs: f64, length: f64, ends: [Option<f64>; 2]) -> Vec<(f64, f64)> {
    let share = |end: Option<f64>, x: f64| end.map_or(1.0, |_| blend(x / CURVE_RAMP_FRAC));
    // Speed over the mean = what the ends ask for + factor * the curve's own.
    let asked = |x: f64| {
        let at_end = |end: Option<f64>, x: f64| end.unwrap_or(0.0) * (1.0 - share(end, x)) * duration_secs / length;
        at_end(ends[0], x) + at_end(ends[1], 1.0 - x)
    };
    let own = |x: f64| curve.at(x).1 * share(ends[0], x) * share(ends[1], 1.0 - x);
    let factor = ((1.0 - integral(asked)) / integral(own)).max(0.0);
    let speed = |x: f64| asked(x) + factor * own(x);
    let total = integral(speed);
    let mut way = 0.0;
    let mut table = vec![(0.0, speed(0.0) * length / duration_secs)];
    for part in 0..NUM_PARTS {
        way += part_integral(speed, part) / total;
        let x = (part + 1) as f64 / NUM_PARTS as f64;
        table.push((way * length, speed(x) * length / duration_secs));
    }
    table
}

fn integral(f: impl Fn(f64) -> f64) -> f64 {
    (0..NUM_PARTS).map(|part| part_integral(&f, part)).sum()
}

/// Integral over one even part of 0..1, by Simpson's rule.
fn part_integral(f: impl Fn(f64) -> f64, part: usize) -> f64 {
    let at = |i: f64| f((part as f64 + i) / NUM_PARTS as f64);
    (at(0.0) + 4.0 * at(0.5) + at(1.0)) / (6.0 * NUM_PARTS as f64)
}

/// Length between two entries of a table, by the cubic that has their lengths and speeds.
fn from_table(table: &[(f64, f64)], secs: f64, duration_secs: f64) -> f64 {
    let step_secs = duration_secs / NUM_PARTS as f64;
    let part = ((secs / step_secs) as usize).min(NUM_PARTS - 1);
    let ((from, from_speed), (to, to_speed)) = (table[part], table[part + 1]);
    let x = secs / step_secs - part as f64;
    let (x2, x3) = (x * x, x * x * x);
    let ends = from * (1.0 - 3.0 * x2 + 2.0 * x3) + to * (3.0 * x2 - 2.0 * x3);
    ends + step_secs * (from_speed * (x - 2.0 * x2 + x3) + to_speed * (x3 - x2))
}

//! Speed over the time of one segment: ramp, even cruise, ramp.

/// Longest ramp from rest to cruise. Longer ones make short moves feel sluggish, shorter ones jolt at 24 frames a second.
const RAMP_SECS: f64 = 1.2;
/// Longest share of a segment that one ramp takes, so that a cruise is left between two.
const RAMP_FRAC: f64 = 0.35;

/// Time that a ramp to or from rest takes in a segment of a given duration.
pub(super) fn ramp_secs(duration_secs: f64) -> f64 {
    RAMP_SECS.min(RAMP_FRAC * duration_secs)
}

/// Progress along one segment over its time. Velocity is continuous: it starts at `start_speed`, changes to the cruise
/// speed within one ramp, and ends at `end_speed` after another.
#[derive(Debug, Clone, Copy)]
pub(super) struct SpeedProfile {
    duration_secs: f64,
    length: f64,
    start_speed: f64,
    end_speed: f64,
    cruise_speed: f64,
    ramp_secs: f64,
}

impl SpeedProfile {
    /// A profile that covers `length` in `duration_secs` (above 0) with given speeds at its ends.
    pub(super) fn new(duration_secs: f64, length: f64, start_speed: f64, end_speed: f64) -> Self {
        let ramp_secs = ramp_secs(duration_secs);
        // length = cruise (T - r) + (start + end) r / 2: each ramp averages its two speeds.
        let ramped = (start_speed + end_speed) * ramp_secs / 2.0;
        let cruise_speed = ((length - ramped) / (duration_secs - ramp_secs)).max(0.0);
        Self { duration_secs, length, start_speed, end_speed, cruise_speed, ramp_secs }
    }

    /// Length covered after `secs` of the segment, 0..=length; monotone.
    pub(super) fn length_at(&self, secs: f64) -> f64 {
        let left = self.duration_secs - secs;
        if secs <= 0.0 {
            0.0
        } else if left <= 0.0 {
            self.length
        } else if left < self.ramp_secs {
            (self.length - self.ramped(left, self.end_speed)).max(0.0)
        } else {
            let in_ramp = secs.min(self.ramp_secs);
            (self.ramped(in_ramp, self.start_speed) + self.cruise_speed * (secs - in_ramp)).min(self.length)
        }
    }

    /// Length covered in the first `secs` of a ramp from `speed` to the cruise, whose speed follows 3 x^2 - 2 x^3.
    fn ramped(&self, secs: f64, speed: f64) -> f64 {
        let x = secs / self.ramp_secs;
        speed * secs + (self.cruise_speed - speed) * self.ramp_secs * (x * x * x - x * x * x * x / 2.0)
    }
}

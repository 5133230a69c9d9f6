//! Balls that contain every position of an interval of a path, independent of timing.
//!
//! The bounds come from the curves' control values, never from samples: a polynomial lies in the convex hull of its Bezier
//! points, and the azimuth, radius and height of an arc each lie between their own Bezier values.

use glam::DVec3;

use super::path::CameraPath;

/// An interval of the curve that leaves a key, in fractions 0..=1 of the curve's parameter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PathInterval {
    /// Index of the key that the curve leaves. The last key has no curve: its interval is a point.
    pub key_idx: usize,
    /// Lower end.
    pub from: f64,
    /// Upper end, above `from`.
    pub to: f64,
}

impl PathInterval {
    /// The interval's two halves.
    pub fn halves(self) -> [Self; 2] {
        let middle = self.middle();
        [Self { to: middle, ..self }, Self { from: middle, ..self }]
    }

    /// The fraction in the middle.
    pub fn middle(self) -> f64 {
        self.from.midpoint(self.to)
    }
}

/// A ball in the world that contains an interval of a path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BoundingBall {
    /// The path's position in the middle of the interval.
    pub center: DVec3,
    /// Radius, scene units.
    pub radius: f64,
}

/// Rounding error of the curves' arithmetic, relative to the size of the coordinates.
const ROUNDING: f64 = 1e-13;

impl CameraPath {
    /// Intervals that together cover all positions of the path, one per key, in order of time.
    pub fn intervals(&self) -> Vec<PathInterval> {
        (0..self.keyframes().len()).map(|key_idx| PathInterval { key_idx, from: 0.0, to: 1.0 }).collect()
    }

    /// A ball that contains every position of an interval.
    pub fn bounding_ball(&self, interval: PathInterval) -> BoundingBall {
        let Some(curve) = self.curve_after(interval.key_idx) else {
            return BoundingBall { center: self.keyframes()[interval.key_idx].pose.position, radius: 0.0 };
        };
        let center = curve.position_at(interval.middle());
        let radius = curve.max_deviation((interval.from, interval.to), center);
        BoundingBall { center, radius: radius + ROUNDING * center.abs().max_element() }
    }

    /// Time at which the camera reaches a fraction of the curve that leaves a key; the first such time where it rests.
    pub fn time_at(&self, key_idx: usize, fraction: f64) -> f64 {
        let keys = self.keyframes();
        let (Some(next), true) = (keys.get(key_idx + 1), self.curve_after(key_idx).is_some()) else {
            return keys[key_idx].time_secs;
        };
        let (mut before, mut after) = (keys[key_idx].time_secs, next.time_secs);
        if fraction <= 0.0 || fraction >= 1.0 {
            return if fraction <= 0.0 { before } else { after };
        }
        for _ in 0..48 {
            let middle = before.midpoint(after);
            if self.fraction_at(key_idx, middle) < fraction { before = middle } else { after = middle }
        }
        after
    }
}

//! Where a path goes, whatever its timing: balls that hold every position of a part of it.
//!
//! Positions are bounded by the curves' own control values, never by samples: a cubic lies in the convex hull of its
//! Bezier points, and a circle's azimuth, radius and height each lie between theirs.

use glam::DVec3;

use super::path::CameraPath;

/// A part of the curve that leaves a key, by fractions of its parameter; the whole is `0.0..=1.0`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PathPart {
    /// Index of the key that the curve leaves. The last key, where nothing follows, is a point.
    pub key_idx: usize,
    /// Where it begins.
    pub from: f64,
    /// Where it ends, above `from`.
    pub to: f64,
}

impl PathPart {
    /// The part's two halves.
    pub fn halves(self) -> [Self; 2] {
        let middle = self.middle();
        [Self { to: middle, ..self }, Self { from: middle, ..self }]
    }

    /// The fraction half way.
    pub fn middle(self) -> f64 {
        self.from.midpoint(self.to)
    }
}

/// A ball in the world.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ball {
    /// Its center: for a part of a path the position half way.
    pub center: DVec3,
    /// Its radius, scene units.
    pub radius: f64,
}

/// Rounding of the curves' arithmetic over the size of its numbers.
const ROUNDING: f64 = 1e-13;

impl CameraPath {
    /// Parts that together are all positions of the path, in order of time.
    pub fn parts(&self) -> Vec<PathPart> {
        (0..self.keyframes().len()).map(|key_idx| PathPart { key_idx, from: 0.0, to: 1.0 }).collect()
    }

    /// A ball about the middle of a part that holds all of the part, at any time and any speed.
    pub fn ball(&self, part: PathPart) -> Ball {
        let Some((leg, segment)) = self.place(part.key_idx) else {
            return Ball { center: self.keyframes()[part.key_idx].pose.position, radius: 0.0 };
        };
        let center = leg.position_at(segment, part.middle());
        let radius = leg.stray(segment, (part.from, part.to), center);
        Ball { center, radius: radius + ROUNDING * center.abs().max_element() }
    }

    /// When the camera is at a fraction of the curve that leaves a key; where it rests there, the first such time.
    pub fn time_at(&self, key_idx: usize, fraction: f64) -> f64 {
        let keys = self.keyframes();
        let (Some(next), true) = (keys.get(key_idx + 1), self.place(key_idx).is_some()) else {
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

/// Values of the cubic with Bezier values `c` on the sub-interval `(from, to)` of 0..1: its own Bezier values there
/// (the blossom; Ramshaw 1989).
pub(super) fn sub_bezier<V>(c: [V; 4], (from, to): (f64, f64)) -> [V; 4]
where
    V: Copy + std::ops::Add<Output = V> + std::ops::Mul<f64, Output = V>,
{
    let mix = |a: V, b: V, t: f64| a * (1.0 - t) + b * t;
    let blossom = |u: f64, v: f64, w: f64| {
        let (a, b, d) = (mix(c[0], c[1], u), mix(c[1], c[2], u), mix(c[2], c[3], u));
        mix(mix(a, b, v), mix(b, d, v), w)
    };
    [blossom(from, from, from), blossom(from, from, to), blossom(from, to, to), blossom(to, to, to)]
}

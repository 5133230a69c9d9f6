//! The curve of nerfstudio's viewer through keyframes: Catmull-Rom splines over the numbers of the keys (Kochanek-Bartels
//! with tension 0) with natural ends, of rotations by de Casteljau's algorithm; a monotone cubic curve (Fritsch-Carlson,
//! as PCHIP of the package `scipy`) takes seconds to the numbers of the keys.
//!
//! Reference: `viewer/render_panel.py` of nerfstudio 1.1.5, and the package `splines` 0.3.0 that it calls.

use glam::{DQuat, DVec3, DVec4};

use super::hermite::hermite_weights;
use super::track::{PoseFrame, fov_y_or_default};
use cinesplat_geometry::rotation;

/// The curve through some keys.
#[derive(Debug)]
pub(super) struct ViewerCurve {
    times: Vec<f64>,
    /// Keys per second at each key.
    rates: Vec<f64>,
    /// Position and vertical field of view in rad.
    points: Vec<DVec4>,
    turns: Vec<DQuat>,
}

impl ViewerCurve {
    /// The curve through keys at increasing times; `None` for fewer than two.
    pub(super) fn new(keys: &[PoseFrame]) -> Option<Self> {
        if keys.len() < 2 || keys.windows(2).any(|pair| !(pair[0].time_secs < pair[1].time_secs)) {
            return None;
        }
        let times: Vec<f64> = keys.iter().map(|key| key.time_secs).collect();
        let points = keys.iter().map(|key| key.pose.position.extend(fov_y_or_default(key))).collect();
        let turns = rotation::aligned(&keys.iter().map(|key| key.pose.rotation).collect::<Vec<_>>());
        Some(Self { rates: rates(&times), times, points, turns })
    }

    /// Position, rotation and vertical field of view in rad at a time.
    pub(super) fn at(&self, time_secs: f64) -> (DVec3, DQuat, f64) {
        let last = self.times.len() - 1;
        let number = self.key_number(time_secs);
        let from = (number as usize).min(last - 1);
        let t = number - from as f64;
        let slopes = [self.tangent(from), self.tangent(from + 1)];
        let point = cubic(self.points[from], slopes[0], self.points[from + 1], slopes[1], t);
        (point.truncate(), self.turn(from, t), point.w)
    }

    /// The number of the key that is passed at a time, with a fraction between keys.
    fn key_number(&self, time_secs: f64) -> f64 {
        let last = self.times.len() - 1;
        let from = self.times.partition_point(|time| *time <= time_secs).clamp(1, last) - 1;
        let span = self.times[from + 1] - self.times[from];
        let t = ((time_secs - self.times[from]) / span).clamp(0.0, 1.0);
        let (t2, t3) = (t * t, t * t * t);
        let eased =
            3.0 * t2 - 2.0 * t3 + span * (self.rates[from] * (t - 2.0 * t2 + t3) + self.rates[from + 1] * (t3 - t2));
        (from as f64 + eased).clamp(0.0, last as f64)
    }

    /// The change of position and field of view per key at a key.
    fn tangent(&self, key: usize) -> DVec4 {
        let (points, last) = (&self.points, self.points.len() - 1);
        if last == 1 {
            return points[1] - points[0];
        }
        match key {
            0 => (points[1] - points[0]) * 1.5 - self.tangent(1) / 2.0,
            _ if key == last => (points[last] - points[last - 1]) * 1.5 - self.tangent(last - 1) / 2.0,
            _ => (points[key + 1] - points[key - 1]) / 2.0,
        }
    }

    /// The rotation at a fraction of the way from a key to the next.
    fn turn(&self, from: usize, t: f64) -> DQuat {
        let (a, b, last) = (self.turns[from], self.turns[from + 1], self.turns.len() - 1);
        if last == 1 {
            return rotation::slerp(a, b, t);
        }
        // At the ends the package takes the rotation halfway to the other key.
        let halfway = rotation::slerp(a, b, 0.5);
        let after = if from > 0 { self.beside(from, 1.0) } else { halfway };
        let before = if from + 1 < last { self.beside(from + 1, -1.0) } else { halfway };
        let mut controls = vec![a, after, before, b];
        while controls.len() > 1 {
            controls = controls.windows(2).map(|pair| rotation::slerp(pair[0], pair[1], t)).collect();
        }
        controls[0]
    }

    /// The control rotation beside an inner key: a third of the mean turn per key after it (`side` 1) or before it (-1).
    fn beside(&self, key: usize, side: f64) -> DQuat {
        let turns = &self.turns;
        let step = |a: DQuat, b: DQuat| rotation::log(b * a.conjugate());
        let mean = (step(turns[key - 1], turns[key]) + step(turns[key], turns[key + 1])) / 2.0;
        rotation::exp(mean * (side / 3.0)) * turns[key]
    }
}

/// Keys per second at keys of increasing times: harmonic means of those on both sides, weighted by the other side's share.
fn rates(times: &[f64]) -> Vec<f64> {
    let spans: Vec<f64> = times.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let last = spans.len();
    if last == 1 {
        return vec![1.0 / spans[0]; 2];
    }
    let inner = |idx: usize| {
        let (before, after) = (spans[idx - 1], spans[idx]);
        let (w1, w2) = (2.0 * after + before, after + 2.0 * before);
        (w1 + w2) / (w1 * before + w2 * after)
    };
    // Of the parabola through three keys, not backward.
    let end = |near: f64, far: f64| (((2.0 * near + far) / near - near / far) / (near + far)).max(0.0);
    let rate = |idx: usize| match idx {
        0 => end(spans[0], spans[1]),
        _ if idx == last => end(spans[last - 1], spans[last - 2]),
        _ => inner(idx),
    };
    (0..=last).map(rate).collect()
}

/// The cubic curve between two points with slopes at both.
fn cubic(a: DVec4, slope_a: DVec4, b: DVec4, slope_b: DVec4, t: f64) -> DVec4 {
    let [of_a, of_slope_a, of_b, of_slope_b] = hermite_weights(t);
    a * of_a + slope_a * of_slope_a + b * of_b + slope_b * of_slope_b
}

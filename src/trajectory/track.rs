//! A C1 curve of one value that passes through its keys.

use std::ops::{Add, Div, Mul, Sub};

use glam::DVec3;
use splines::{Interpolate, Interpolation, Key, Spline};

/// A C1 piecewise cubic through values at increasing knots; constant beyond its ends.
#[derive(Debug, Clone)]
pub(super) struct Track<V> {
    spline: Spline<f64, V>,
    first: V,
}

impl<V> Track<V>
where
    V: Interpolate<f64> + Copy + Add<Output = V> + Sub<Output = V> + Mul<f64, Output = V>,
{
    /// The cubic with the given tangents (value per unit of the knots). All slices have the same length, at least 1.
    fn hermite(knots: &[f64], values: &[V], tangents: &[V]) -> Self {
        let key = |i: usize| {
            // Bezier handles lie a third of the neighboring interval along the tangent.
            let before = if i > 0 { knots[i] - knots[i - 1] } else { 0.0 };
            let after = if i + 1 < knots.len() { knots[i + 1] - knots[i] } else { 0.0 };
            let handles = (values[i] - tangents[i] * (before / 3.0), values[i] + tangents[i] * (after / 3.0));
            Key::new(knots[i], values[i], Interpolation::StrokeBezier(handles.0, handles.1))
        };
        Self { spline: Spline::from_vec((0..knots.len()).map(key).collect()), first: values[0] }
    }

    /// The value at a knot.
    pub(super) fn at(&self, knot: f64) -> V {
        self.spline.clamped_sample(knot).unwrap_or(self.first)
    }
}

impl<V: Copy> Track<V> {
    /// Bezier values of the cubic between keys `segment` and `segment + 1`.
    pub(super) fn bezier(&self, segment: usize) -> [V; 4] {
        let keys = self.spline.keys();
        let key = |i: usize| {
            keys.get(i).map_or((self.first, self.first, self.first), |key| match key.interpolation {
                Interpolation::StrokeBezier(before, after) => (before, key.value, after),
                _ => (key.value, key.value, key.value),
            })
        };
        let ((_, start, out), (into, end, _)) = (key(segment), key(segment + 1));
        [start, out, into, end]
    }
}

impl Track<f64> {
    /// A monotone curve: between two keys it stays within their range (Fritsch and Butland 1984).
    pub(super) fn monotone(knots: &[f64], values: &[f64]) -> Self {
        let slopes = slopes(knots, values);
        let tangent = |i: usize| match (i.checked_sub(1).and_then(|j| slopes.get(j)), slopes.get(i)) {
            (Some(&a), Some(&b)) => harmonic_mean(a, b),
            (Some(&only), None) | (None, Some(&only)) => only,
            (None, None) => 0.0,
        };
        let tangents: Vec<f64> = (0..values.len()).map(tangent).collect();
        Self::hermite(knots, values, &tangents)
    }
}

impl Track<DVec3> {
    /// Catmull-Rom over the given knots (Barry and Goldman 1988), with the tangent of the end parabola at both ends.
    pub(super) fn catmull_rom(knots: &[f64], points: &[DVec3]) -> Self {
        let slopes = slopes(knots, points);
        let step = |i: usize| knots[i + 1] - knots[i];
        let inner = |i: usize| (slopes[i - 1] * step(i) + slopes[i] * step(i - 1)) / (step(i - 1) + step(i));
        let last = points.len() - 1;
        let tangent = |i: usize| match i {
            _ if last == 0 => DVec3::ZERO,
            _ if last == 1 => slopes[0],
            0 => slopes[0] * 2.0 - inner(1),
            i if i == last => slopes[last - 1] * 2.0 - inner(last - 1),
            i => inner(i),
        };
        let tangents: Vec<DVec3> = (0..points.len()).map(tangent).collect();
        Self::hermite(knots, points, &tangents)
    }
}

/// Mean slope of each interval.
fn slopes<V>(knots: &[f64], values: &[V]) -> Vec<V>
where
    V: Copy + Sub<Output = V> + Div<f64, Output = V>,
{
    let slope = |i: usize| (values[i + 1] - values[i]) / (knots[i + 1] - knots[i]);
    (0..values.len().saturating_sub(1)).map(slope).collect()
}

/// Harmonic mean of two rates; 0 where their signs differ, so that no curve overshoots.
pub(super) fn harmonic_mean(a: f64, b: f64) -> f64 {
    if a * b > 0.0 { 2.0 * a * b / (a + b) } else { 0.0 }
}

/// Bezier values, on the sub-interval `(from, to)` of 0..1, of the cubic with Bezier values `c` (its blossom; Ramshaw
/// 1989).
pub(super) fn sub_bezier<V>(c: [V; 4], (from, to): (f64, f64)) -> [V; 4]
where
    V: Copy + Add<Output = V> + Mul<f64, Output = V>,
{
    let mix = |a: V, b: V, t: f64| a * (1.0 - t) + b * t;
    let blossom = |u: f64, v: f64, w: f64| {
        let (a, b, d) = (mix(c[0], c[1], u), mix(c[1], c[2], u), mix(c[2], c[3], u));
        mix(mix(a, b, v), mix(b, d, v), w)
    };
    [blossom(from, from, from), blossom(from, from, to), blossom(from, to, to), blossom(to, to, to)]
}

//! The keys of animated properties: steps, lines and cubic splines.

use glam::{DQuat, DVec4};

use super::super::ExportError;
use super::super::hermite::hermite_weights;
use super::super::json_read::Node;
use super::accessor::{size, values};
use super::constants::CUT_SECS;

/// Rates of films on whose frames keys are looked for, frames per second. The first is that of keys on none.
const FILM_FPS: [f64; 6] = [30.0, 24.0, 25.0, 60.0, 120.0, 30_000.0 / 1001.0];
/// Largest distance of a key from a frame, s.
const ON_FRAME_SECS: f64 = 1e-4;
/// Most frames that are read of splines: an hour.
const MAX_FRAMES: f64 = 1e5;

/// The keys of an animated property.
pub(super) struct Channel {
    times: Vec<f64>,
    values: Vec<Vec<f64>>,
    /// Change per second before and after each key of a cubic spline; empty for lines and steps.
    tangents: Vec<[Vec<f64>; 2]>,
    /// Whether each value holds until the next key.
    step: bool,
}

pub(super) fn read_sampler(root: &Node, buffers: &[Vec<u8>], sampler: &Node) -> Result<Channel, ExportError> {
    let times: Vec<f64> = values(root, buffers, size(sampler, "input", None)?)?.into_iter().flatten().collect();
    let mut values = values(root, buffers, size(sampler, "output", None)?)?;
    let interpolation = sampler.optional("interpolation").map_or(Ok("LINEAR"), |name| name.text())?;
    let mut tangents = Vec::new();
    if interpolation == "CUBICSPLINE" && values.len() == 3 * times.len() {
        // Each key has an in-tangent, a value and an out-tangent.
        tangents = values.chunks_exact(3).map(|key| [key[0].clone(), key[2].clone()]).collect();
        values = values.into_iter().skip(1).step_by(3).collect();
    }
    if values.len() != times.len() {
        return Err(sampler.error("as many values as times"));
    }
    Ok(Channel { times, values, tangents, step: interpolation == "STEP" })
}

impl Channel {
    /// The times of the keys.
    pub(super) fn times(&self) -> impl Iterator<Item = f64> {
        self.times.iter().copied()
    }

    /// Whether a cubic spline joins the keys.
    pub(super) fn is_spline(&self) -> bool {
        !self.tangents.is_empty()
    }

    /// Checks that every value is usable for the property that `path` names: finite, of the right width, and a rotation
    /// not 0; and that tangents are finite.
    pub(super) fn check(&self, path: &str, sampler: &Node) -> Result<(), ExportError> {
        let (width, expected) = match path {
            "rotation" => (4, "4 finite numbers, not all 0"),
            "translation" | "scale" => (3, "3 finite numbers"),
            _ => (1, "a finite number"),
        };
        let is_null = |value: &[f64]| path == "rotation" && !(DVec4::from_slice(value).length() > 1e-6);
        let is_wrong = |value: &[f64]| value.len() != width || value.iter().any(|v| !v.is_finite());
        let has_wrong_tangent =
            |idx: usize| self.tangents.get(idx).is_some_and(|sides| sides.iter().any(|v| is_wrong(v)));
        let is_bad =
            |idx: &usize| is_wrong(&self.values[*idx]) || is_null(&self.values[*idx]) || has_wrong_tangent(*idx);
        let Some(idx) = (0..self.values.len()).find(is_bad) else { return Ok(()) };
        Err(ExportError::BadField {
            place: format!("{}.output, {path} of key {idx}", sampler.place()),
            found: format!("{:?}", self.values[idx]),
            expected: expected.to_owned(),
        })
    }

    /// The value at a time: on the spline, or interpolated by `between`.
    pub(super) fn at(&self, time: f64, between: impl Fn(&[f64], &[f64], f64) -> Vec<f64>) -> Option<Vec<f64>> {
        let after = self.times.partition_point(|key| *key <= time);
        let (before, next) = (after.saturating_sub(1), after.min(self.times.len().checked_sub(1)?));
        let span = self.times[next] - self.times[before];
        if self.step || span <= 0.0 || time <= self.times[before] {
            return self.values.get(before).cloned();
        }
        let t = (time - self.times[before]) / span;
        if let (Some([_, leaving]), Some([arriving, _])) = (self.tangents.get(before), self.tangents.get(next)) {
            let ends = [self.values[before].as_slice(), self.values[next].as_slice()];
            return Some(spline(ends, [leaving, arriving], span, t));
        }
        Some(between(&self.values[before], &self.values[next], t))
    }
}

/// The cubic between two values with tangents per second, at a fraction of the time between them: section "Cubic spline
/// interpolation" of the specification of glTF 2.0.
fn spline([a, b]: [&[f64]; 2], [leaving, arriving]: [&[f64]; 2], secs: f64, t: f64) -> Vec<f64> {
    let [of_a, of_leaving, of_b, of_arriving] = hermite_weights(t);
    let part = |k: usize| a[k] * of_a + secs * leaving[k] * of_leaving + b[k] * of_b + secs * arriving[k] * of_arriving;
    (0..a.len()).map(part).collect()
}

pub(super) fn blend(a: &[f64], b: &[f64], t: f64) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a + (b - a) * t).collect()
}

/// The rotation of a value; none where a spline passes through 0.
pub(super) fn turn(values: &[f64]) -> DQuat {
    let components = DVec4::from_slice(values);
    components.try_normalize().map_or(DQuat::IDENTITY, DQuat::from_vec4)
}

/// The usual rate of films on whose frames all keys are.
pub(super) fn spline_fps(times: impl Iterator<Item = f64>) -> f64 {
    let times: Vec<f64> = times.collect();
    let first = times.iter().copied().fold(f64::INFINITY, f64::min);
    let is_on_frames = |fps: &f64| {
        times.iter().all(|time| ((time - first) - ((time - first) * fps).round() / fps).abs() <= ON_FRAME_SECS)
    };
    FILM_FPS.into_iter().find(is_on_frames).unwrap_or(FILM_FPS[0])
}

/// Sorted times of keys and those of the frames between them, counted from the first key. Of too many frames there are
/// none.
pub(super) fn with_times_between(keys: &[f64], fps: f64) -> Vec<f64> {
    let (Some(first), Some(last)) = (keys.first(), keys.last()) else { return Vec::new() };
    let count = (last - first) * fps;
    if !(count <= MAX_FRAMES) {
        return keys.to_vec();
    }
    let mut times = keys.to_vec();
    let is_apart = |time: &f64| {
        let after = keys.partition_point(|key| key < time);
        let around = [after.checked_sub(1), Some(after)].into_iter().flatten().filter_map(|idx| keys.get(idx));
        around.into_iter().all(|key| (key - time).abs() > CUT_SECS.max(ON_FRAME_SECS))
    };
    times.extend((1..=count as usize).map(|frame| first + frame as f64 / fps).filter(is_apart));
    times.sort_by(f64::total_cmp);
    times
}

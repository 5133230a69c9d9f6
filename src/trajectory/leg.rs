//! A leg: all segments between two moments of rest, joined by one smooth curve whose length is measured.

use glam::DVec3;

use super::curve::{PositionCurve, RotationCurve};
use super::track::Track;
use super::{CameraState, Keyframe};
use cinesplat_geometry::{LevelFrame, Pose, rotation};

/// Number of chords that measure the length of a segment. The error falls with its square (4e-7 of a 45 degree arc).
pub(super) const FINE_CHORDS: usize = 128;
/// The same for paths that a solver only scores, by the hundred (error 2e-4 of a 45 degree arc).
pub(super) const COARSE_CHORDS: usize = 6;

/// The kind of change along a segment. All segments of a leg are of one kind.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum LegKind {
    /// The camera's position changes.
    Travel,
    /// The position changes along a circle about an upright axis through this point.
    Arc(DVec3),
    /// Only the rotation changes.
    Turn,
    /// Only the lens changes.
    Lens,
    /// Nothing changes.
    Hold,
}

impl LegKind {
    /// The kind of change from key `a` to key `b`; `least` is the distance up to which two positions are one.
    pub(super) fn between(a: &Keyframe, b: &Keyframe, has_up: bool, least: f64) -> Self {
        if a.pose.position.distance(b.pose.position) > least {
            return match a.intent.as_ref().and_then(|intent| Some((intent.movement?, intent.pivot?))) {
                Some((movement, pivot)) if has_up && movement.is_circular() => Self::Arc(pivot),
                _ => Self::Travel,
            };
        }
        if rotation::angle_between(a.pose.rotation, b.pose.rotation) > 1e-7 {
            Self::Turn
        } else if (a.fov_y_rad - b.fov_y_rad).abs() > 1e-9 || a.focus_distance != b.focus_distance {
            Self::Lens
        } else {
            Self::Hold
        }
    }
}

/// A smooth curve through the keys of a leg, with a table of its length.
#[derive(Debug, Clone)]
pub(super) struct Leg {
    knots: Vec<f64>,
    position: PositionCurve,
    rotation: RotationCurve,
    /// Focal length over half the frame's height, or its logarithm.
    focal: Track<f64>,
    focal_is_log: bool,
    /// Focus distance at each key.
    focus: Vec<Option<f64>>,
    /// Per segment the cumulative length at uniform fractions of its parameter, `num_chords + 1` values.
    lengths: Vec<Vec<f64>>,
    num_chords: usize,
}

impl Leg {
    /// The curve through `keys` (at least two), whose segments are all of `kind`, measured with `num_chords` chords per
    /// segment.
    pub(super) fn new(keys: &[Keyframe], kind: LegKind, frame: Option<LevelFrame>, num_chords: usize) -> Self {
        let knots = knots(keys, kind);
        let points: Vec<DVec3> = keys.iter().map(|key| key.pose.position).collect();
        let position = match (kind, frame) {
            (LegKind::Arc(pivot), Some(frame)) => PositionCurve::arc(frame, pivot, keys, &knots),
            _ => PositionCurve::Spline(Track::catmull_rom(&knots, &points)),
        };
        let rotation = RotationCurve::new(frame, common_pivot(keys), keys, &knots);
        let focal_is_log = kind == LegKind::Lens;
        let focal = |key: &Keyframe| {
            let focal = 1.0 / (key.fov_y_rad / 2.0).tan();
            if focal_is_log { focal.ln() } else { focal }
        };
        let focal = Track::monotone(&knots, &keys.iter().map(focal).collect::<Vec<_>>());
        let focus = keys.iter().map(|key| key.focus_distance).collect();
        let mut leg = Self { knots, position, rotation, focal, focal_is_log, focus, lengths: Vec::new(), num_chords };
        leg.lengths = (0..keys.len() - 1).map(|segment| leg.cumulative_lengths(segment, kind)).collect();
        leg
    }

    /// Length of one segment: scene units for travel and arcs, rad for turns, 1 for lens changes and holds.
    pub(super) fn length(&self, segment: usize) -> f64 {
        self.lengths[segment][self.num_chords]
    }

    /// The camera after `length` of a segment.
    pub(super) fn at_length(&self, segment: usize, length: f64) -> CameraState {
        self.at_fraction(segment, self.fraction_at_length(segment, length))
    }

    /// Fraction 0..=1 of a segment's parameter after `length` of it.
    pub(super) fn fraction_at_length(&self, segment: usize, length: f64) -> f64 {
        let table = &self.lengths[segment];
        let total = table[self.num_chords];
        if !(total > 0.0) {
            return 0.0;
        }
        let above = table.partition_point(|&l| l < length).clamp(1, self.num_chords);
        let (low, high) = (table[above - 1], table[above]);
        let within = if high > low { ((length - low) / (high - low)).clamp(0.0, 1.0) } else { 0.0 };
        ((above - 1) as f64 + within) / self.num_chords as f64
    }

    /// Position at a fraction of a segment's parameter, world.
    pub(super) fn position_at(&self, segment: usize, fraction: f64) -> DVec3 {
        self.position.at(self.knot(segment, fraction))
    }

    /// Upper bound of the distance from `center`, the position in the middle of `range`, to any position on `range` of
    /// a segment, scene units.
    pub(super) fn max_deviation(&self, segment: usize, range: (f64, f64), center: DVec3) -> f64 {
        self.position.max_deviation(segment, range, center)
    }

    fn knot(&self, segment: usize, fraction: f64) -> f64 {
        self.knots[segment] + (self.knots[segment + 1] - self.knots[segment]) * fraction
    }

    /// The camera at a fraction of a segment's parameter.
    fn at_fraction(&self, segment: usize, fraction: f64) -> CameraState {
        let knot = self.knot(segment, fraction);
        let position = self.position.at(knot);
        let pose = Pose { position, rotation: self.rotation.at(segment, knot, position) };
        let focal = self.focal.at(knot);
        let focal = if self.focal_is_log { focal.exp() } else { focal };
        let focus_distance = match (self.focus[segment], self.focus[segment + 1]) {
            (Some(a), Some(b)) => Some(a + (b - a) * fraction),
            (a, b) => a.or(b),
        };
        CameraState { pose, fov_y_rad: 2.0 * (1.0 / focal).atan(), focus_distance }
    }

    /// Cumulative length of a segment at uniform fractions of its parameter.
    fn cumulative_lengths(&self, segment: usize, kind: LegKind) -> Vec<f64> {
        let mut total = 0.0;
        let mut last = self.at_fraction(segment, 0.0);
        let mut table = vec![0.0];
        for chord in 1..=self.num_chords {
            let next = self.at_fraction(segment, chord as f64 / self.num_chords as f64);
            total += match kind {
                LegKind::Travel | LegKind::Arc(_) => last.pose.position.distance(next.pose.position),
                LegKind::Turn => rotation::angle_between(last.pose.rotation, next.pose.rotation),
                // The log focal length or the focus distance is linear in the parameter.
                LegKind::Lens | LegKind::Hold => 1.0 / self.num_chords as f64,
            };
            table.push(total);
            last = next;
        }
        table
    }
}

/// The point that all segments of a leg aim at; `None` where their intents differ or name none.
fn common_pivot(keys: &[Keyframe]) -> Option<DVec3> {
    let pivot = |key: &Keyframe| key.intent.as_ref().and_then(|intent| intent.pivot);
    let first = pivot(&keys[0])?;
    keys[..keys.len() - 1].iter().all(|key| pivot(key) == Some(first)).then_some(first)
}

/// Knots of a leg's keys: centripetal for travel (no cusps or overshoot, Yuksel et al. 2011), chord length for arcs,
/// angle for turns, uniform for the rest.
fn knots(keys: &[Keyframe], kind: LegKind) -> Vec<f64> {
    let mut knots = vec![0.0];
    for pair in keys.windows(2) {
        let (a, b) = (&pair[0], &pair[1]);
        let step = match kind {
            LegKind::Travel => a.pose.position.distance(b.pose.position).sqrt(),
            LegKind::Arc(_) => a.pose.position.distance(b.pose.position),
            LegKind::Turn => rotation::angle_between(a.pose.rotation, b.pose.rotation),
            LegKind::Lens | LegKind::Hold => 1.0,
        };
        knots.push(knots[knots.len() - 1] + step.max(f64::MIN_POSITIVE));
    }
    knots
}

//! A leg: the stretch between two moments of rest, one smooth curve with a length.

use glam::DVec3;

use super::curve::{PositionCurve, TurnCurve};
use super::path::CameraState;
use super::track::Track;
use super::{Keyframe, Move};
use cinesplat_geometry::{LevelFrame, Pose, rotation};

/// Chords that measure the length of one segment of a film; the error falls with their square (4e-7 of a 45 degree arc).
pub(super) const FINE_CHORDS: usize = 128;
/// Chords for a path that is only judged, not filmed: a solver tries hundreds (2e-4 of a 45 degree arc).
pub(super) const COARSE_CHORDS: usize = 6;

/// What changes along a segment; a leg is all of one kind.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Kind {
    /// The camera travels, freely.
    Travel,
    /// The camera travels on a circle about an upright axis through this point.
    Arc(DVec3),
    /// The camera only turns.
    Turn,
    /// Only the lens changes.
    Lens,
    /// Nothing changes.
    Hold,
}

impl Kind {
    /// What changes from key `a` to key `b`; `reach` is the extent of the whole path.
    pub(super) fn between(a: &Keyframe, b: &Keyframe, has_up: bool, reach: f64) -> Self {
        if a.pose.position.distance(b.pose.position) > 1e-7 * reach {
            return match a.intent.as_ref().and_then(|intent| Some((intent.movement?, intent.pivot?))) {
                Some((movement, pivot)) if has_up && is_circular(movement) => Self::Arc(pivot),
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

fn is_circular(movement: Move) -> bool {
    matches!(movement, Move::OrbitLeft | Move::OrbitRight | Move::ArcLeft | Move::ArcRight)
}

/// A smooth curve through the keys of a leg, measured by length.
#[derive(Debug, Clone)]
pub(super) struct Leg {
    knots: Vec<f64>,
    position: PositionCurve,
    turn: TurnCurve,
    focal: Track<f64>,
    focal_is_log: bool,
    focus: Vec<Option<f64>>,
    /// Cumulative length at even fractions of each segment's knots, `num_chords + 1` values.
    lengths: Vec<Vec<f64>>,
    num_chords: usize,
}

impl Leg {
    /// The curve through `keys` (at least two), whose segments are all of `kind`, measured by `num_chords` a segment.
    pub(super) fn new(keys: &[Keyframe], kind: Kind, frame: Option<LevelFrame>, num_chords: usize) -> Self {
        let knots = knots(keys, kind);
        let points: Vec<DVec3> = keys.iter().map(|key| key.pose.position).collect();
        let position = match (kind, frame) {
            (Kind::Arc(pivot), Some(frame)) => PositionCurve::arc(frame, pivot, keys, &knots),
            _ => PositionCurve::Spline(Track::catmull_rom(&knots, &points)),
        };
        let turn = TurnCurve::new(frame, common_pivot(keys), keys, &knots);
        let focal_is_log = kind == Kind::Lens;
        let focal = |key: &Keyframe| {
            let focal = 1.0 / (key.fov_y_rad / 2.0).tan();
            if focal_is_log { focal.ln() } else { focal }
        };
        let focal = Track::monotone(&knots, &keys.iter().map(focal).collect::<Vec<_>>());
        let focus = keys.iter().map(|key| key.focus_distance).collect();
        let mut leg = Self { knots, position, turn, focal, focal_is_log, focus, lengths: Vec::new(), num_chords };
        leg.lengths = (0..keys.len() - 1).map(|segment| leg.measured(segment, kind)).collect();
        leg
    }

    /// Length of one segment: of its path, or in rad where it only turns, or of log focal length.
    pub(super) fn length(&self, segment: usize) -> f64 {
        self.lengths[segment][self.num_chords]
    }

    /// The camera where `length` of a segment is covered.
    pub(super) fn at_length(&self, segment: usize, length: f64) -> CameraState {
        self.at_fraction(segment, self.fraction_at_length(segment, length))
    }

    /// Fraction of a segment's knots at which `length` of it is covered, 0..=1.
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

    /// Where the camera is at a fraction of a segment's knots.
    pub(super) fn position_at(&self, segment: usize, fraction: f64) -> DVec3 {
        self.position.at(self.knot(segment, fraction))
    }

    /// Bound of the distance between `center`, the position half way, and any position on `range` of a segment.
    pub(super) fn stray(&self, segment: usize, range: (f64, f64), center: DVec3) -> f64 {
        self.position.stray(segment, range, center)
    }

    fn knot(&self, segment: usize, fraction: f64) -> f64 {
        self.knots[segment] + (self.knots[segment + 1] - self.knots[segment]) * fraction
    }

    /// The camera at a fraction of a segment's knots.
    fn at_fraction(&self, segment: usize, fraction: f64) -> CameraState {
        let knot = self.knot(segment, fraction);
        let position = self.position.at(knot);
        let pose = Pose { position, rotation: self.turn.at(segment, knot, position) };
        let focal = self.focal.at(knot);
        let focal = if self.focal_is_log { focal.exp() } else { focal };
        let focus_distance = match (self.focus[segment], self.focus[segment + 1]) {
            (Some(a), Some(b)) => Some(a + (b - a) * fraction),
            (a, b) => a.or(b),
        };
        CameraState { pose, fov_y_rad: 2.0 * (1.0 / focal).atan(), focus_distance }
    }

    /// Cumulative length of a segment at even fractions of its knots.
    fn measured(&self, segment: usize, kind: Kind) -> Vec<f64> {
        let mut total = 0.0;
        let mut last = self.at_fraction(segment, 0.0);
        let mut table = vec![0.0];
        for chord in 1..=self.num_chords {
            let next = self.at_fraction(segment, chord as f64 / self.num_chords as f64);
            total += match kind {
                Kind::Travel | Kind::Arc(_) => last.pose.position.distance(next.pose.position),
                Kind::Turn => rotation::angle_between(last.pose.rotation, next.pose.rotation),
                // Even fractions: the log focal length or the focus distance is linear in the knots.
                Kind::Lens | Kind::Hold => 1.0 / self.num_chords as f64,
            };
            table.push(total);
            last = next;
        }
        table
    }
}

/// The point that all segments of a leg aim at, where their intents name one and the same.
fn common_pivot(keys: &[Keyframe]) -> Option<DVec3> {
    let pivot = |key: &Keyframe| key.intent.as_ref().and_then(|intent| intent.pivot);
    let first = pivot(&keys[0])?;
    keys[..keys.len() - 1].iter().all(|key| pivot(key) == Some(first)).then_some(first)
}

/// Knots of a leg's keys: centripetal for travel (no cusps or overshoot, Yuksel et al. 2011), angle for turns and arcs.
fn knots(keys: &[Keyframe], kind: Kind) -> Vec<f64> {
    let mut knots = vec![0.0];
    for pair in keys.windows(2) {
        let (a, b) = (&pair[0], &pair[1]);
        let step = match kind {
            Kind::Travel => a.pose.position.distance(b.pose.position).sqrt(),
            Kind::Arc(_) => a.pose.position.distance(b.pose.position),
            Kind::Turn => rotation::angle_between(a.pose.rotation, b.pose.rotation),
            Kind::Lens | Kind::Hold => 1.0,
        };
        knots.push(knots[knots.len() - 1] + step.max(f64::MIN_POSITIVE));
    }
    knots
}

//! The camera at any time of a shot.

use super::blend::{Blend, EndMotion};
use super::leg::{COARSE_CHORDS, FINE_CHORDS, Leg};
use super::pace::{Pace, paces};
use super::segments::{is_blend, split_into_legs};
use super::{CameraState, Keyframe, Shot, TrajectoryError};
use cinesplat_geometry::LevelFrame;
use glam::DVec3;

/// A continuous path through a shot's keyframes.
///
/// At a key's time the camera is at that key. Velocity and angular velocity are continuous except at cuts. The camera
/// rests where an easing says so and where the kind of motion changes (travel, arc about another point, turn alone,
/// lens alone, hold), unless a blend lies between. Between two rests the path is one smooth curve: a straight move stays straight, a pan stays in
/// place, and an orbit or arc with a `pivot` is a true circle from any number of keys.
#[derive(Debug, Clone)]
pub struct CameraPath {
    keys: Vec<Keyframe>,
    legs: Vec<Leg>,
    segments: Vec<TimedSegment>,
}

/// The segment between two neighboring keys.
#[derive(Debug, Clone)]
struct TimedSegment {
    curve: SegmentCurve,
    /// Whether the camera is at rest at the start and at the end.
    rests: [bool; 2],
    duration_secs: f64,
    pace: Pace,
}

/// What the camera follows between two neighboring keys.
#[derive(Debug, Clone)]
enum SegmentCurve {
    /// It stays at the first key: until a cut, or until an equal key.
    Stay,
    /// A segment of a leg: their indices.
    Leg(usize, usize),
    /// A blend of its neighbors.
    Blend(Box<Blend>),
}

/// The curve that leaves a key, in fractions 0..=1 of its parameter.
pub(super) enum LeavingCurve<'a> {
    Leg(&'a Leg, usize),
    Blend(&'a Blend),
}

impl LeavingCurve<'_> {
    /// Position at a fraction, world.
    pub(super) fn position_at(&self, fraction: f64) -> DVec3 {
        match self {
            Self::Leg(leg, segment) => leg.position_at(*segment, fraction),
            Self::Blend(blend) => blend.position_at(fraction),
        }
    }

    /// Upper bound of the distance from `center`, the position in the middle of `range`, to any position on `range`.
    pub(super) fn max_deviation(&self, range: (f64, f64), center: DVec3) -> f64 {
        match self {
            Self::Leg(leg, segment) => leg.max_deviation(*segment, range, center),
            Self::Blend(blend) => blend.max_deviation(range, center),
        }
    }
}

impl CameraPath {
    /// The path of a shot; checks the shot first.
    ///
    /// # Errors
    /// [`TrajectoryError`] naming the keyframe and the field at fault.
    pub fn new(shot: &Shot) -> Result<Self, TrajectoryError> {
        let shot = shot.clone().validated()?;
        let frame = shot.scene.up.and_then(|up| LevelFrame::new(up).ok());
        Ok(Self::through(shot.keyframes, frame, FINE_CHORDS))
    }

    /// The path through keys that are already validated.
    pub fn fine(keys: Vec<Keyframe>, frame: LevelFrame) -> Self {
        Self::through(keys, Some(frame), FINE_CHORDS)
    }

    /// As [`Self::fine`], built faster: lengths, and therefore positions over time, have a relative error of 2e-4.
    pub fn coarse(keys: Vec<Keyframe>, frame: LevelFrame) -> Self {
        Self::through(keys, Some(frame), COARSE_CHORDS)
    }

    fn through(keys: Vec<Keyframe>, frame: Option<LevelFrame>, num_chords: usize) -> Self {
        let (legs, measured) = split_into_legs(&keys, frame, num_chords);
        let mut segments = Vec::with_capacity(measured.len());
        for (i, (segment, pace)) in measured.iter().zip(paces(&measured)).enumerate() {
            let stays = CameraState::from(&keys[i]) == CameraState::from(&keys[i + 1]);
            let curve = match segment.leg.filter(|_| !stays) {
                Some((leg, segment)) => SegmentCurve::Leg(leg, segment),
                None => SegmentCurve::Stay,
            };
            let rests = [segment.rests_at_start, segment.rests_at_end];
            segments.push(TimedSegment { curve, rests, duration_secs: segment.duration_secs, pace });
        }
        let mut path = Self { keys, legs, segments };
        for index in (0..path.segments.len()).filter(|&index| is_blend(&path.keys, index)).collect::<Vec<_>>() {
            let blend = path.blend(index, frame);
            path.segments[index].curve = SegmentCurve::Blend(Box::new(blend));
        }
        path
    }

    /// The blend at a segment, from the motion of its neighbors.
    fn blend(&self, index: usize, frame: Option<LevelFrame>) -> Blend {
        let moves_at = |i: usize, end: usize| match self.segments.get(i) {
            Some(TimedSegment { curve: SegmentCurve::Leg(..), rests, .. }) => !rests[end],
            _ => false,
        };
        let before = index.checked_sub(1).filter(|&i| moves_at(i, 1)).map(|i| {
            let secs = self.segments[i].duration_secs;
            EndMotion::of(secs, |back| self.in_segment(i, secs - back))
        });
        let after = Some(index + 1)
            .filter(|&i| moves_at(i, 0))
            .map(|i| EndMotion::of(self.segments[i].duration_secs, |ahead| self.in_segment(i, ahead)));
        let from = before.unwrap_or_else(|| EndMotion::rest(CameraState::from(&self.keys[index])));
        let to = after.unwrap_or_else(|| EndMotion::rest(CameraState::from(&self.keys[index + 1])));
        Blend::new(frame, self.segments[index].duration_secs, &from, &to)
    }

    /// The camera at a time; at the first key before its time, at the last key after its time.
    pub fn sample(&self, time_secs: f64) -> CameraState {
        let after = self.keys.partition_point(|key| key.time_secs <= time_secs);
        let Some(index) = after.checked_sub(1) else { return CameraState::from(&self.keys[0]) };
        let secs = time_secs - self.keys[index].time_secs;
        if secs <= 0.0 { CameraState::from(&self.keys[index]) } else { self.in_segment(index, secs) }
    }

    /// The camera some time after a key and before the next.
    fn in_segment(&self, index: usize, secs: f64) -> CameraState {
        match self.segments.get(index) {
            Some(TimedSegment { curve: SegmentCurve::Leg(leg, segment), pace, .. }) => {
                self.legs[*leg].at_length(*segment, pace.length_at(secs))
            }
            Some(TimedSegment { curve: SegmentCurve::Blend(blend), duration_secs, .. }) => {
                blend.at((secs / duration_secs).clamp(0.0, 1.0))
            }
            _ => CameraState::from(&self.keys[index]),
        }
    }

    /// The curve that leaves a key; `None` where the camera stays at the key.
    pub(super) fn curve_after(&self, key_idx: usize) -> Option<LeavingCurve<'_>> {
        match &self.segments.get(key_idx)?.curve {
            SegmentCurve::Stay => None,
            SegmentCurve::Leg(leg, segment) => Some(LeavingCurve::Leg(&self.legs[*leg], *segment)),
            SegmentCurve::Blend(blend) => Some(LeavingCurve::Blend(blend)),
        }
    }

    /// Fraction, covered by the camera at a time, of the curve that leaves a key; 0 where the camera stays.
    pub(super) fn fraction_at(&self, key_idx: usize, time_secs: f64) -> f64 {
        let (Some(curve), Some(timed)) = (self.curve_after(key_idx), self.segments.get(key_idx)) else { return 0.0 };
        let secs = time_secs - self.keys[key_idx].time_secs;
        match curve {
            LeavingCurve::Leg(leg, segment) => leg.fraction_at_length(segment, timed.pace.length_at(secs)),
            LeavingCurve::Blend(_) => (secs / timed.duration_secs).clamp(0.0, 1.0),
        }
    }

    /// The keys of the path, in order of time.
    pub fn keyframes(&self) -> &[Keyframe] {
        &self.keys
    }
}

//! The camera at any time of a shot.

use super::leg::{COARSE_CHORDS, FINE_CHORDS, Kind, Leg};
use super::profile::{SpeedProfile, natural_speeds, ramp_secs};
use super::track::harmonic_mean;
use super::{Easing, Keyframe, Shot, TrajectoryError};
use cinesplat_geometry::{LevelFrame, Pose};

/// Pose and lens at one moment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CameraState {
    /// Where, `world_from_camera`.
    pub pose: Pose,
    /// Vertical field of view.
    pub fov_y_rad: f64,
    /// Distance of sharpest focus, scene units.
    pub focus_distance: Option<f64>,
}

impl From<&Keyframe> for CameraState {
    fn from(key: &Keyframe) -> Self {
        Self { pose: key.pose, fov_y_rad: key.fov_y_rad, focus_distance: key.focus_distance }
    }
}

/// A continuous path through a shot's keyframes.
///
/// At a key's time the camera is at that key. Between keys velocity and angular velocity are continuous except at cuts.
/// The camera rests where an easing says so and where the kind of motion changes (travel, arc about another point, turn
/// alone, lens alone, hold); between such rests the path is one smooth curve, so that a straight move stays straight
/// and a pan stays in place. Orbits and arcs with a `pivot` are true circles from any number of keys.
#[derive(Debug, Clone)]
pub struct CameraPath {
    keys: Vec<Keyframe>,
    legs: Vec<Leg>,
    segments: Vec<Segment>,
}

/// The stretch from one key to the next.
#[derive(Debug, Clone)]
struct Segment {
    /// Leg and segment within it; `None` where the path holds the key until a cut.
    place: Option<(usize, usize)>,
    profile: SpeedProfile,
}

/// One segment before speeds are known.
pub(super) struct Stretch {
    pub(super) leg: Option<(usize, usize)>,
    pub(super) length: f64,
    pub(super) duration_secs: f64,
    pub(super) easing: Easing,
    pub(super) rests_at_start: bool,
    pub(super) rests_at_end: bool,
}

impl Stretch {
    /// Speed between the ramps if the other end has that speed too.
    fn cruise_speed(&self) -> f64 {
        let ramps = f64::from(u8::from(self.rests_at_start)) + f64::from(u8::from(self.rests_at_end));
        self.length / (self.duration_secs - ramps * ramp_secs(self.duration_secs) / 2.0)
    }

    /// Speeds at both ends when nothing else is asked of them.
    fn natural_speeds(&self) -> (f64, f64) {
        natural_speeds(self.easing, self.length / self.duration_secs, self.cruise_speed())
    }
}

impl CameraPath {
    /// The path of a shot, after the shot's own checks.
    ///
    /// # Errors
    /// [`TrajectoryError`] naming the keyframe and field at fault.
    pub fn new(shot: &Shot) -> Result<Self, TrajectoryError> {
        let shot = shot.clone().validated()?;
        let frame = shot.scene.up.and_then(|up| LevelFrame::new(up).ok());
        Ok(Self::through(shot.keyframes, frame, FINE_CHORDS))
    }

    /// The path through keys that are known to be valid.
    pub fn fine(keys: Vec<Keyframe>, frame: LevelFrame) -> Self {
        Self::through(keys, Some(frame), FINE_CHORDS)
    }

    /// As [`Self::fine`], for judging it: lengths are good to 2e-4.
    pub fn coarse(keys: Vec<Keyframe>, frame: LevelFrame) -> Self {
        Self::through(keys, Some(frame), COARSE_CHORDS)
    }

    fn through(keys: Vec<Keyframe>, frame: Option<LevelFrame>, num_chords: usize) -> Self {
        let (legs, stretches) = stretches(&keys, frame, num_chords);
        let mut segments = Vec::with_capacity(stretches.len());
        for (i, stretch) in stretches.iter().enumerate() {
            let before = i.checked_sub(1).and_then(|j| stretches.get(j)).filter(|s| s.leg.is_some());
            let after = stretches.get(i + 1).filter(|s| s.leg.is_some());
            // What two neighbors would have by themselves decides the speed at the key between them.
            let between = |a: &Stretch, b: &Stretch| harmonic_mean(a.natural_speeds().1, b.natural_speeds().0);
            let start_speed =
                if stretch.rests_at_start { Some(0.0) } else { before.map(|before| between(before, stretch)) };
            let end_speed = if stretch.rests_at_end { Some(0.0) } else { after.map(|after| between(stretch, after)) };
            let ends = [start_speed, end_speed];
            let profile = SpeedProfile::new(stretch.easing, stretch.duration_secs, stretch.length, ends);
            segments.push(Segment { place: stretch.leg, profile });
        }
        Self { keys, legs, segments }
    }

    /// The camera at a time; before the first key it is at the first, after the last at the last.
    pub fn sample(&self, time_secs: f64) -> CameraState {
        let after = self.keys.partition_point(|key| key.time_secs <= time_secs);
        let Some(index) = after.checked_sub(1) else { return CameraState::from(&self.keys[0]) };
        let key = &self.keys[index];
        let Some(Segment { place: Some((leg, segment)), profile }) = self.segments.get(index) else {
            return CameraState::from(key);
        };
        if time_secs <= key.time_secs {
            return CameraState::from(key);
        }
        self.legs[*leg].at_length(*segment, profile.length_at(time_secs - key.time_secs))
    }

    /// The curve that leaves a key; `None` where the camera stays at the key.
    pub(super) fn place(&self, key_idx: usize) -> Option<(&Leg, usize)> {
        let (leg, segment) = self.segments.get(key_idx)?.place?;
        Some((&self.legs[leg], segment))
    }

    /// Fraction of the curve that leaves a key which is covered at a time; 0 where the camera stays.
    pub(super) fn fraction_at(&self, key_idx: usize, time_secs: f64) -> f64 {
        let (Some((leg, segment)), Some(part)) = (self.place(key_idx), self.segments.get(key_idx)) else { return 0.0 };
        leg.fraction_at_length(segment, part.profile.length_at(time_secs - self.keys[key_idx].time_secs))
    }

    /// The keys that the path goes through.
    pub fn keyframes(&self) -> &[Keyframe] {
        &self.keys
    }
}

/// Legs of a list of keys, and for every pair of neighbors which part of which leg it is.
pub(super) fn stretches(keys: &[Keyframe], frame: Option<LevelFrame>, num_chords: usize) -> (Vec<Leg>, Vec<Stretch>) {
    let reach = keys.iter().map(|key| key.pose.position.distance(keys[0].pose.position)).fold(0.0, f64::max);
    let kind = |i: usize| (!keys[i + 1].cut).then(|| Kind::between(&keys[i], &keys[i + 1], frame.is_some(), reach));
    let num_segments = keys.len() - 1;
    let kinds: Vec<Option<Kind>> = (0..num_segments).map(kind).collect();
    // Whether the camera rests at key i, as the end of one segment and the start of another.
    let rests = |i: usize| {
        let (Some(before), Some(after)) = (kinds[i - 1], kinds[i]) else { return true };
        before != after || keys[i - 1].easing.rests_at_end() || keys[i].easing.rests_at_start()
    };
    // Whether two segments meet at key i without a cut.
    let joins = |i: usize| i > 0 && i < num_segments && kinds[i - 1].is_some() && kinds[i].is_some();
    let mut legs = Vec::new();
    let mut out: Vec<Stretch> = Vec::with_capacity(num_segments);
    let mut first = 0;
    while first < num_segments {
        let mut end = first + 1;
        while end < num_segments && !rests(end) {
            end += 1;
        }
        let leg = kinds[first].map(|kind| Leg::new(&keys[first..=end], kind, frame, num_chords));
        for i in first..end {
            out.push(Stretch {
                leg: leg.as_ref().map(|_| (legs.len(), i - first)),
                length: leg.as_ref().map_or(0.0, |leg| leg.length(i - first)),
                duration_secs: keys[i + 1].time_secs - keys[i].time_secs,
                easing: keys[i].easing,
                rests_at_start: i == first && (joins(i) || keys[i].easing.rests_at_start()),
                rests_at_end: i + 1 == end && (joins(end) || keys[i].easing.rests_at_end()),
            });
        }
        legs.extend(leg);
        first = end;
    }
    (legs, out)
}

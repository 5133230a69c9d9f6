//! The camera at any time of a shot.

use super::leg::{COARSE_CHORDS, FINE_CHORDS, Leg};
use super::profile::SpeedProfile;
use super::segments::{MeasuredSegment, split_into_legs};
use super::track::harmonic_mean;
use super::{CameraState, Keyframe, Shot, TrajectoryError};
use cinesplat_geometry::LevelFrame;

/// A continuous path through a shot's keyframes.
///
/// At a key's time the camera is at that key. Velocity and angular velocity are continuous except at cuts. The camera
/// rests where an easing says so and where the kind of motion changes (travel, arc about another point, turn alone,
/// lens alone, hold). Between two rests the path is one smooth curve: a straight move stays straight, a pan stays in
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
    /// Index of the leg and of the segment within it; `None` where the camera holds the first key until a cut.
    leg: Option<(usize, usize)>,
    profile: SpeedProfile,
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
        for (i, segment) in measured.iter().enumerate() {
            let before = i.checked_sub(1).and_then(|j| measured.get(j)).filter(|s| s.leg.is_some());
            let after = measured.get(i + 1).filter(|s| s.leg.is_some());
            // The natural speeds of two neighbors decide the speed at the key between them.
            let between =
                |a: &MeasuredSegment, b: &MeasuredSegment| harmonic_mean(a.natural_speeds().1, b.natural_speeds().0);
            let start_speed =
                if segment.rests_at_start { Some(0.0) } else { before.map(|before| between(before, segment)) };
            let end_speed = if segment.rests_at_end { Some(0.0) } else { after.map(|after| between(segment, after)) };
            let ends = [start_speed, end_speed];
            let profile = SpeedProfile::new(segment.easing, segment.duration_secs, segment.length, ends);
            segments.push(TimedSegment { leg: segment.leg, profile });
        }
        Self { keys, legs, segments }
    }

    /// The camera at a time; at the first key before its time, at the last key after its time.
    pub fn sample(&self, time_secs: f64) -> CameraState {
        let after = self.keys.partition_point(|key| key.time_secs <= time_secs);
        let Some(index) = after.checked_sub(1) else { return CameraState::from(&self.keys[0]) };
        let key = &self.keys[index];
        let Some(TimedSegment { leg: Some((leg, segment)), profile }) = self.segments.get(index) else {
            return CameraState::from(key);
        };
        if time_secs <= key.time_secs {
            return CameraState::from(key);
        }
        self.legs[*leg].at_length(*segment, profile.length_at(time_secs - key.time_secs))
    }

    /// The leg that leaves a key and the segment within it; `None` where the camera stays at the key.
    pub(super) fn leg_after(&self, key_idx: usize) -> Option<(&Leg, usize)> {
        let (leg, segment) = self.segments.get(key_idx)?.leg?;
        Some((&self.legs[leg], segment))
    }

    /// Fraction, covered by the camera at a time, of the curve that leaves a key; 0 where the camera stays.
    pub(super) fn fraction_at(&self, key_idx: usize, time_secs: f64) -> f64 {
        let (Some((leg, segment)), Some(timed)) = (self.leg_after(key_idx), self.segments.get(key_idx)) else {
            return 0.0;
        };
        leg.fraction_at_length(segment, timed.profile.length_at(time_secs - self.keys[key_idx].time_secs))
    }

    /// The keys of the path, in order of time.
    pub fn keyframes(&self) -> &[Keyframe] {
        &self.keys
    }
}

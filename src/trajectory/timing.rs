//! Constant speed: times of inner keys chosen so that the camera cruises at one speed.

use super::leg::FINE_CHORDS;
use super::pace::{leg_profile, num_in_leg};
use super::segments::{MeasuredSegment, split_into_legs};
use super::{Keyframe, Shot};
use cinesplat_geometry::LevelFrame;

/// The shot with the inner keys of every leg moved in time so that the speed along the path is constant.
///
/// First and last keys, cuts, moments of rest, and legs with an easing that follows a curve keep their times. The
/// clearance proof is dropped.
pub fn retimed(shot: &Shot) -> Shot {
    let frame = shot.scene.up.and_then(|up| LevelFrame::new(up).ok());
    let mut out = shot.clone();
    retime(&mut out.keyframes, frame);
    out.clearance = None;
    out
}

/// As [`retimed`], for keys without a shot.
pub fn retime(keys: &mut [Keyframe], frame: Option<LevelFrame>) {
    if keys.len() < 3 {
        return;
    }
    let (_, segments) = split_into_legs(keys, frame, FINE_CHORDS);
    let mut first = 0;
    while first < segments.len() {
        let count = num_in_leg(&segments[first..]);
        retime_leg(&mut keys[first..=first + count], &segments[first..first + count]);
        first += count;
    }
}

/// Gives the inner keys of a leg the times at which one profile over the whole leg reaches them: all segments cruise at
/// one speed, between two ramps that may be longer than the segments at the ends. The speed along a curve is not constant:
/// such a leg stays.
fn retime_leg(keys: &mut [Keyframe], segments: &[MeasuredSegment]) {
    let Some(profile) = leg_profile(segments) else { return };
    let start_secs = keys[0].time_secs;
    let inner = keys.len() - 1;
    let mut length = 0.0;
    for (key, segment) in keys[1..inner].iter_mut().zip(segments) {
        length += segment.length;
        key.time_secs = start_secs + profile.secs_at(length);
    }
}

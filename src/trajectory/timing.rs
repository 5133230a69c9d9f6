//! Constant speed: times of inner keys chosen so that the camera cruises at one speed.

use super::leg::FINE_CHORDS;
use super::profile::ramp_secs;
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
        let leg = segments[first].leg.map(|(leg, _)| leg);
        let count = segments[first..].iter().take_while(|s| leg.is_some() && s.leg.map(|(l, _)| l) == leg).count();
        // The speed along a curve is not constant.
        let even = segments[first..first + count].iter().all(|segment| segment.easing.curve().is_none());
        if count > 1 && even {
            retime_leg(&mut keys[first..=first + count], &segments[first..first + count]);
        }
        first += count.max(1);
    }
}

/// Distributes the time of one leg over its segments so that all cruise at one speed `c`.
///
/// `T_i = L_i / c + r_i / 2` for a segment of length `L_i` whose ramps from or to rest last `r_i` in total. The ramps depend
/// on the times, so the equation is iterated.
fn retime_leg(keys: &mut [Keyframe], segments: &[MeasuredSegment]) {
    let total_secs = keys[keys.len() - 1].time_secs - keys[0].time_secs;
    let total_length: f64 = segments.iter().map(|s| s.length).sum();
    if !(total_length > 0.0) {
        return;
    }
    let mut durations: Vec<f64> = segments.iter().map(|s| total_secs * s.length / total_length).collect();
    for _ in 0..60 {
        let ramp = |(segment, &secs): (&MeasuredSegment, &f64)| {
            let ramps = f64::from(u8::from(segment.rests_at_start)) + f64::from(u8::from(segment.rests_at_end));
            ramps * ramp_secs(secs) / 2.0
        };
        let ramps: Vec<f64> = segments.iter().zip(&durations).map(ramp).collect();
        let speed = total_length / (total_secs - ramps.iter().sum::<f64>());
        durations = segments.iter().zip(&ramps).map(|(s, ramp)| s.length / speed + ramp).collect();
    }
    let mut time_secs = keys[0].time_secs;
    for (key, duration) in keys[1..].iter_mut().zip(&durations[..durations.len() - 1]) {
        time_secs += duration;
        key.time_secs = time_secs;
    }
}

//! Even speed: inner keys moved in time so that the camera cruises.

use super::leg::FINE_CHORDS;
use super::path::{Stretch, stretches};
use super::profile::ramp_secs;
use super::{Keyframe, Shot};
use cinesplat_geometry::LevelFrame;

/// The shot with the inner keys of every leg moved to times of even speed along the path. First and last keys, cuts and
/// moments of rest keep their times, and so do legs with an easing that follows a curve.
pub fn retimed(shot: &Shot) -> Shot {
    let frame = shot.scene.up.and_then(|up| LevelFrame::new(up).ok());
    let mut out = shot.clone();
    retime(&mut out.keyframes, frame);
    out.clearance = None;
    out
}

/// As [`retimed`], of bare keys.
pub fn retime(keys: &mut [Keyframe], frame: Option<LevelFrame>) {
    if keys.len() < 3 {
        return;
    }
    let (_, stretches) = stretches(keys, frame, FINE_CHORDS);
    let mut first = 0;
    while first < stretches.len() {
        let leg = stretches[first].leg.map(|(leg, _)| leg);
        let count = stretches[first..].iter().take_while(|s| leg.is_some() && s.leg.map(|(l, _)| l) == leg).count();
        // A segment with a curve of its own is not meant to be even.
        let even = stretches[first..first + count].iter().all(|stretch| stretch.easing.curve().is_none());
        if count > 1 && even {
            retime_leg(&mut keys[first..=first + count], &stretches[first..first + count]);
        }
        first += count.max(1);
    }
}

/// Spreads the time of one leg over its segments so that all cruise at one speed: `T_i = L_i / c + r_i / 2` with a ramp
/// of `r_i` where the leg starts from or comes to rest. Ramps depend on the times, hence a few rounds.
fn retime_leg(keys: &mut [Keyframe], stretches: &[Stretch]) {
    let total_secs = keys[keys.len() - 1].time_secs - keys[0].time_secs;
    let total_length: f64 = stretches.iter().map(|s| s.length).sum();
    if !(total_length > 0.0) {
        return;
    }
    let mut durations: Vec<f64> = stretches.iter().map(|s| total_secs * s.length / total_length).collect();
    for _ in 0..60 {
        let ramp = |(stretch, &secs): (&Stretch, &f64)| {
            let ramps = f64::from(u8::from(stretch.rests_at_start)) + f64::from(u8::from(stretch.rests_at_end));
            ramps * ramp_secs(secs) / 2.0
        };
        let ramps: Vec<f64> = stretches.iter().zip(&durations).map(ramp).collect();
        let speed = total_length / (total_secs - ramps.iter().sum::<f64>());
        durations = stretches.iter().zip(&ramps).map(|(s, ramp)| s.length / speed + ramp).collect();
    }
    let mut time_secs = keys[0].time_secs;
    for (key, duration) in keys[1..].iter_mut().zip(&durations[..durations.len() - 1]) {
        time_secs += duration;
        key.time_secs = time_secs;
    }
}

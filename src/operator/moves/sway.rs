//! The sway of a handheld camera.

use glam::DVec3;

use cinesplat_geometry::{Pose, rotation};
use cinesplat_trajectory::CameraState;

/// Time between two keyframes of the sway, seconds.
const KEY_SECS: f64 = 0.45;

/// Number of intervals between the keyframes of a sway of some length.
pub(super) fn num_sways(secs: f64) -> usize {
    ((secs / KEY_SECS).ceil() as usize).max(3)
}

/// The states with a sway of 0.3 % of the `distance` to the subject and 0.35 degrees added; the first and the last one stay.
/// `phase` chooses the sway.
pub(super) fn swayed(states: &[CameraState], distance: f64, phase: f64) -> Vec<CameraState> {
    let count = states.len() - 1;
    let sway = |i: usize, channel: f64| {
        // Incommensurate sines: smooth, without repetition within a shot, and deterministic for a seed.
        let t = i as f64 * KEY_SECS;
        ((t * 2.1 + channel * 1.7 + phase).sin() + 0.6 * (t * 3.7 + channel * 2.9 + phase * 1.3).sin()) / 1.6
    };
    let fade = |i: usize| if i == 0 || i == count { 0.0 } else { 1.0 };
    let wobbled = |(i, base): (usize, &CameraState)| {
        let offset = DVec3::new(sway(i, 1.0), sway(i, 2.0), 0.5 * sway(i, 3.0)) * (0.003 * distance * fade(i));
        let twist = DVec3::new(sway(i, 4.0), sway(i, 5.0), 0.4 * sway(i, 6.0)) * (0.35_f64.to_radians() * fade(i));
        let turn = base.pose.rotation;
        CameraState { pose: Pose::new(base.pose.position + turn * offset, turn * rotation::exp(twist)), ..*base }
    };
    states.iter().enumerate().map(wobbled).collect()
}

//! How hard a path starts and stops.

use cinesplat::geometry::{LevelAngles, LevelFrame, Pose};
use cinesplat::trajectory::{CameraPath, Easing, Keyframe, retimed};
use glam::DVec3;

use super::{key, shot};

/// Frames per second: so few that the table of lengths, which divides a segment into 128 chords, does not show.
const FPS: f64 = 20.0;

/// Speeds of a path from frame to frame.
fn speeds(keys: &[Keyframe]) -> Vec<f64> {
    let path = CameraPath::new(&shot(keys.to_vec())).unwrap();
    let num = (keys[keys.len() - 1].time_secs * FPS).round() as usize;
    let at = |i: usize| path.sample(i as f64 / FPS).pose.position;
    (0..num).map(|i| at(i).distance(at(i + 1)) * FPS).collect()
}

/// Nine units, a gate, and one unit more, in eight seconds from rest to rest.
fn through_a_gate() -> Vec<Keyframe> {
    let eased = |key: Keyframe, easing: Easing| Keyframe { easing, ..key };
    vec![
        eased(key(0.0, DVec3::ZERO), Easing::EaseIn),
        eased(key(7.0, DVec3::X * 9.0), Easing::EaseOut),
        key(8.0, DVec3::X * 10.0),
    ]
}

#[test]
fn a_fly_through_whose_last_leg_is_short_does_not_stop_hard() {
    let keys = retimed(&shot(through_a_gate())).keyframes;
    let speeds = speeds(&keys);
    // A ramp of 1.2 s by 3 x^2 - 2 x^3 brakes with at most 1.5 of the cruise speed over its time.
    let cruise = 10.0 / (8.0 - 1.2);
    let hardest = speeds.windows(2).map(|pair| (pair[1] - pair[0]).abs() * FPS).fold(0.0, f64::max);
    assert!(hardest < 1.1 * 1.5 * cruise / 1.2, "{hardest} units per second squared");
    let top = speeds.iter().copied().fold(0.0, f64::max);
    assert!((top - cruise).abs() < 5e-3 * cruise, "cruises at {top} instead of {cruise}");
    // The key is where the camera passes the gate.
    let path = CameraPath::new(&shot(keys.clone())).unwrap();
    for shift in [-1e-6, 0.0, 1e-6] {
        let at = path.sample(keys[1].time_secs + shift).pose.position;
        assert!(at.distance(keys[1].pose.position) < 1e-5, "{at} at the time of the gate");
    }
}

#[test]
fn keys_with_times_of_their_own_are_met_at_those_times() {
    let keys = through_a_gate();
    let path = CameraPath::new(&shot(keys.clone())).unwrap();
    for (key, shift) in keys.iter().flat_map(|key| [-1e-6, 1e-6].map(|shift| (key, shift))) {
        let at = path.sample(key.time_secs + shift).pose.position;
        assert!(at.distance(key.pose.position) < 1e-4, "{at} instead of {}", key.pose.position);
    }
}

#[test]
fn a_tilt_there_and_back_does_not_follow_rounding_errors() {
    // The position wanders by the last digit of a number, as it does after a blend.
    let frame = LevelFrame::new(DVec3::Y).unwrap();
    let place = DVec3::new(-0.371_617_720_622_902, 1.278_574_844_044_67, -1.384_827_959_697_492);
    let pitched = |time_secs: f64, degrees: f64, off: f64, easing: Easing| {
        let angles = LevelAngles { pitch_rad: f64::to_radians(degrees), ..LevelAngles::default() };
        let pose = Pose { position: place + DVec3::splat(off), rotation: frame.rotation(angles) };
        Keyframe { pose, easing, ..key(time_secs, place) }
    };
    let keys = vec![
        pitched(0.0, -20.0, 0.0, Easing::EaseIn),
        pitched(1.6, 8.0, 1e-16, Easing::Blend),
        pitched(2.7, 7.0, 2e-16, Easing::EaseOut),
        pitched(4.0, -20.0, -1e-16, Easing::EaseOut),
    ];
    let path = CameraPath::new(&shot(keys)).unwrap();
    let pitch = |i: i32| frame.angles(path.sample(f64::from(i) / 10.0).pose.rotation).pitch_rad.to_degrees();
    let steps: Vec<f64> = (0..40).map(|i| pitch(i + 1) - pitch(i)).collect();
    let fastest = steps.iter().fold(0.0_f64, |most, step| most.max(step.abs()));
    let change = steps.windows(2).map(|pair| (pair[1] - pair[0]).abs()).fold(0.0, f64::max);
    assert!(
        change < 0.5 * fastest,
        "the turn changes by {change} of {fastest} degrees from a tenth of a second to the next"
    );
}

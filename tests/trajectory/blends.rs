//! Moves that flow into each other.

use cinesplat::geometry::{LevelAngles, LevelFrame, rotation};
use cinesplat::trajectory::{CameraPath, CameraState, Easing, Keyframe};
use glam::DVec3;

use super::{key, shot};

fn yawed(key: Keyframe, yaw_rad: f64) -> Keyframe {
    let frame = LevelFrame::new(DVec3::Y).unwrap();
    let rotation = frame.rotation(LevelAngles { yaw_rad, ..LevelAngles::default() });
    Keyframe { pose: cinesplat::geometry::Pose { rotation, ..key.pose }, ..key }
}

/// One unit per second along x, a blend of two seconds, one unit per second along z.
fn corner() -> Vec<Keyframe> {
    let blend = Keyframe { easing: Easing::Blend, ..key(1.0, DVec3::X) };
    vec![key(0.0, DVec3::ZERO), blend, key(3.0, DVec3::new(2.0, 0.0, 1.0)), key(4.0, DVec3::new(2.0, 0.0, 2.0))]
}

/// From rest along x to a turn in place and on to rest along z, with a blend at either end of the turn.
fn with_a_turn() -> Vec<Keyframe> {
    let eased = |key: Keyframe, easing: Easing| Keyframe { easing, ..key };
    vec![
        eased(key(0.0, DVec3::ZERO), Easing::EaseIn),
        eased(key(3.0, DVec3::X * 2.0), Easing::Blend),
        eased(yawed(key(4.0, DVec3::X * 2.4), 0.2), Easing::Linear),
        eased(yawed(key(5.0, DVec3::X * 2.4), 0.6), Easing::Blend),
        eased(yawed(key(6.0, DVec3::new(2.4, 0.0, -0.4)), 0.8), Easing::EaseOut),
        yawed(key(9.0, DVec3::new(2.4, 0.0, -2.4)), 0.8),
    ]
}

#[test]
fn a_blend_of_straight_lines_changes_the_velocity_by_a_smoothstep() {
    let path = CameraPath::new(&shot(corner())).unwrap();
    for i in 0..=100 {
        let x = f64::from(i) / 100.0;
        // Integral of 2 (1 - s, 0, s) with s = 3 x^2 - 2 x^3.
        let new = 2.0 * (x.powi(3) - x.powi(4) / 2.0);
        let expected = DVec3::new(1.0 + 2.0 * x - new, 0.0, new);
        let found = path.sample(1.0 + 2.0 * x).pose.position;
        assert!(found.distance(expected) < 1e-6, "{found} instead of {expected} at {x}");
    }
}

#[test]
fn velocity_and_acceleration_of_position_and_turn_are_continuous_through_blends() {
    let path = CameraPath::new(&shot(with_a_turn())).unwrap();
    let turn = |a: &CameraState, b: &CameraState| rotation::log(b.pose.rotation * a.pose.rotation.conjugate());
    let step = 1e-3;
    let rates = |time: f64| {
        let (a, b) = (path.sample(time), path.sample(time + step));
        ((b.pose.position - a.pose.position) / step, turn(&a, &b) / step)
    };
    let (mut jump, mut kink) = (0.0_f64, 0.0_f64);
    for i in 0..8990 {
        let time = f64::from(i) * step;
        let [a, b, c] = [0.0, 1.0, 2.0].map(|k| rates(time + k * step));
        jump = jump.max((b.0 - a.0).length()).max((b.1 - a.1).length());
        kink = kink.max(((c.0 - b.0) - (b.0 - a.0)).length()).max(((c.1 - b.1) - (b.1 - a.1)).length());
    }
    // Accelerations are below 2, and jerks below 30, per second.
    assert!(jump < 2.0 * step, "velocity jumps by {jump}");
    assert!(kink < 30.0 * step * step, "acceleration jumps by {}", kink / step);
}

#[test]
fn a_blend_keeps_the_horizon_level_and_passes_its_keys() {
    let keys = with_a_turn();
    let path = CameraPath::new(&shot(keys.clone())).unwrap();
    let frame = LevelFrame::new(DVec3::Y).unwrap();
    assert!((0..900).all(|i| frame.roll_rad(&path.sample(f64::from(i) * 0.01).pose).abs() < 1e-9));
    for key in &keys {
        assert!(path.sample(key.time_secs + 1e-9).pose.position.distance(key.pose.position) < 1e-6);
    }
}

#[test]
fn the_camera_moves_all_the_time_between_two_blended_moves() {
    let path = CameraPath::new(&shot(with_a_turn())).unwrap();
    for i in 0..550 {
        let (a, b) = (path.sample(2.0 + f64::from(i) * 0.01), path.sample(2.01 + f64::from(i) * 0.01));
        let travel = a.pose.position.distance(b.pose.position);
        let turn = rotation::angle_between(a.pose.rotation, b.pose.rotation);
        assert!(travel + turn > 0.002, "stands still at {} s", 2.0 + f64::from(i) * 0.01);
    }
}

#[test]
fn a_blend_without_neighbors_goes_from_rest_to_rest() {
    let mut keys = vec![Keyframe { easing: Easing::Blend, ..key(0.0, DVec3::ZERO) }, key(1.0, DVec3::X)];
    keys.push(Keyframe { cut: true, ..key(2.0, DVec3::Y) });
    let path = CameraPath::new(&shot(keys)).unwrap();
    let x = |time: f64| path.sample(time).pose.position.x;
    assert!((x(0.5) - 0.5).abs() < 1e-9 && x(0.01) < 1e-4 && x(0.99) > 1.0 - 1e-4);
}

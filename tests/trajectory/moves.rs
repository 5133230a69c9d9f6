//! Paths of keys with intents: circles, dolly zooms, pans, cuts.

use cinesplat::geometry::{Pose, rotation};
use cinesplat::trajectory::{CameraPath, Intent, Keyframe, Move};
use glam::DVec3;

use super::{key, positions, shot};

/// Keys of an orbit to the right about `pivot` (counter-clockwise from above), evenly spaced over `degrees`.
fn orbit(pivot: DVec3, radius: f64, degrees: f64, count: usize) -> Vec<Keyframe> {
    let at = |i: usize| {
        let angle = (degrees * i as f64 / (count - 1) as f64).to_radians();
        // Counter-clockwise seen from above maps +z to +x.
        let position = pivot + DVec3::new(angle.sin(), 0.35, angle.cos()) * radius;
        let pose = Pose::look_at(position, pivot, DVec3::Y, None).unwrap();
        let intent = Intent { movement: Some(Move::OrbitRight), pivot: Some(pivot), ..Intent::default() };
        Keyframe { pose, intent: Some(intent), ..key(i as f64, position) }
    };
    (0..count).map(at).collect()
}

#[test]
fn orbits_are_circles_from_any_number_of_keys() {
    let pivot = DVec3::new(3.0, -1.0, 0.5);
    for count in 3..=12 {
        let shot = shot(orbit(pivot, 2.0, 300.0, count));
        for p in positions(&shot, 500) {
            let radius = (p - pivot).with_y(0.0).length();
            assert!((radius / 2.0 - 1.0).abs() < 1e-3, "{count} keys: radius {radius}");
        }
    }
}

#[test]
fn orbits_keep_their_aim_between_keys() {
    let pivot = DVec3::new(3.0, -1.0, 0.5);
    let path = CameraPath::new(&shot(orbit(pivot, 2.0, 200.0, 3))).unwrap();
    for i in 0..=100 {
        let pose = path.sample(f64::from(i) * 0.02).pose;
        assert!(pose.forward().angle_between(pivot - pose.position) < 1e-6);
    }
}

#[test]
fn half_turns_go_the_way_the_move_says() {
    let pivot = DVec3::ZERO;
    let path = CameraPath::new(&shot(orbit(pivot, 2.0, 180.0, 2))).unwrap();
    // From +z to the camera's right, which is +x when it looks along -z.
    assert!(path.sample(0.5).pose.position.x > 1.9);
}

#[test]
fn a_dolly_zoom_keeps_its_subject_the_same_size() {
    let mut keys = vec![key(0.0, DVec3::Z * 4.0), key(3.0, DVec3::Z * 2.0)];
    for (key, distance) in keys.iter_mut().zip([4.0_f64, 2.0]) {
        key.pose = Pose::look_at(key.pose.position, DVec3::ZERO, DVec3::Y, None).unwrap();
        key.fov_y_rad = 2.0 * (1.0 / distance).atan();
    }
    let path = CameraPath::new(&shot(keys)).unwrap();
    for i in 0..=60 {
        let state = path.sample(f64::from(i) * 0.05);
        let size = 1.0 / (state.pose.position.length() * (state.fov_y_rad / 2.0).tan());
        assert!((size - 1.0).abs() < 0.01, "size {size}");
    }
}

#[test]
fn a_cut_jumps_and_nothing_else_does() {
    let mut keys =
        vec![key(0.0, DVec3::ZERO), key(1.0, DVec3::X), key(2.0, DVec3::X * 50.0), key(3.0, DVec3::X * 51.0)];
    keys[2].cut = true;
    let path = CameraPath::new(&shot(keys)).unwrap();
    assert_eq!(path.sample(1.999).pose.position, DVec3::X, "the key before the cut is held");
    assert_eq!(path.sample(2.0).pose.position, DVec3::X * 50.0);
}

#[test]
fn a_turn_in_place_does_not_move_the_camera() {
    let mut keys = vec![key(0.0, DVec3::ONE), key(1.0, DVec3::ONE), key(2.0, DVec3::ONE)];
    for (i, key) in keys.iter_mut().enumerate() {
        key.pose.rotation *= rotation::exp(DVec3::Y * 0.4 * i as f64);
    }
    assert!(positions(&shot(keys), 100).iter().all(|p| p.distance(DVec3::ONE) < 1e-12));
}

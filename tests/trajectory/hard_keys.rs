//! Keys that are hard for splines: uneven, close, single, equal, half turns, the zenith.

use cinesplat::geometry::{LevelAngles, LevelFrame, Pose, rotation};
use cinesplat::trajectory::{CameraPath, Easing, TrajectoryError, retimed};
use glam::{DQuat, DVec3};
use strum::VariantArray;

use super::{key, positions, shot};

/// Keys 1, 0.2 and 3.8 units apart at even times, for which a uniform spline runs backward.
fn uneven() -> cinesplat::trajectory::Shot {
    shot([0.0, 1.0, 1.2, 5.0].iter().enumerate().map(|(i, &x)| key(i as f64, DVec3::X * x)).collect())
}

#[test]
fn uneven_keys_never_run_backward() {
    let xs: Vec<f64> = positions(&uneven(), 3001).iter().map(|p| p.x).collect();
    assert!(xs.windows(2).all(|pair| pair[1] >= pair[0] - 1e-12));
}

#[test]
fn every_key_is_met_at_its_time() {
    let shot = uneven();
    let path = CameraPath::new(&shot).unwrap();
    for key in &shot.keyframes {
        assert!(path.sample(key.time_secs).pose.position.distance(key.pose.position) < 1e-9);
    }
}

#[test]
fn bound_uneven_times_keep_velocity_continuous() {
    let shot = uneven();
    let path = CameraPath::new(&shot).unwrap();
    let speed = |t: f64| (path.sample(t + 1e-5).pose.position - path.sample(t).pose.position).length() / 1e-5;
    for t in [1.0, 2.0] {
        assert!((speed(t - 2e-5) - speed(t + 1e-5)).abs() < 0.02, "speed jumps at {t}");
    }
}

#[test]
fn retimed_keys_cruise_evenly() {
    let shot = retimed(&uneven());
    let points = positions(&shot, 1001);
    let speeds: Vec<f64> = points.windows(2).map(|pair| pair[0].distance(pair[1])).collect();
    let mean = speeds.iter().sum::<f64>() / speeds.len() as f64;
    let variance = speeds.iter().map(|s| (s - mean).powi(2)).sum::<f64>() / speeds.len() as f64;
    assert!(variance.sqrt() / mean < 0.01, "speed varies by {}", variance.sqrt() / mean);
    assert!(shot.keyframes[0].time_secs.abs() < 1e-12);
    assert!((shot.keyframes[3].time_secs - 3.0).abs() < 1e-12);
}

#[test]
fn close_keys_make_no_loop() {
    let points = [DVec3::ZERO, DVec3::X * 10.0, DVec3::new(10.0, 0.2, 0.0), DVec3::new(0.0, 0.2, 0.0)];
    let shot = shot(points.iter().enumerate().map(|(i, &p)| key(i as f64, p)).collect());
    let path = CameraPath::new(&shot).unwrap();
    let inner: Vec<DVec3> = (0..=200).map(|i| path.sample(1.0 + f64::from(i) / 200.0).pose.position).collect();
    let length: f64 = inner.windows(2).map(|p| p[0].distance(p[1])).sum();
    assert!(length < 0.3, "0.2 units between two keys took a way of {length}");
}

#[test]
fn one_key_is_held_and_two_make_a_straight_line() {
    let held = shot(vec![key(0.0, DVec3::ONE)]);
    assert_eq!(CameraPath::new(&held).unwrap().sample(5.0).pose.position, DVec3::ONE);
    let line = shot(vec![key(0.0, DVec3::ZERO), key(2.0, DVec3::new(1.0, 2.0, 3.0))]);
    for p in positions(&line, 50) {
        assert!(p.cross(DVec3::new(1.0, 2.0, 3.0)).length() < 1e-9);
    }
}

#[test]
fn equal_keys_hold_and_give_no_nan() {
    let same = shot(vec![key(0.0, DVec3::ONE), key(1.0, DVec3::ONE), key(2.0, DVec3::ONE), key(3.0, DVec3::ZERO)]);
    assert!(positions(&same, 400).iter().all(|p| p.is_finite()));
    assert!(positions(&same, 400)[..260].iter().all(|p| p.distance(DVec3::ONE) < 1e-12));
}

#[test]
fn a_half_turn_and_the_zenith_stay_finite_and_unflipped() {
    let frame = LevelFrame::new(DVec3::Y).unwrap();
    let mut keys = vec![key(0.0, DVec3::ZERO), key(2.0, DVec3::ZERO), key(4.0, DVec3::ZERO)];
    keys[1].pose.rotation = keys[0].pose.rotation * DQuat::from_rotation_y(std::f64::consts::PI);
    keys[2].pose = Pose::facing(DVec3::ZERO, DVec3::NEG_Y, DVec3::Y, Some(DVec3::X));
    let path = CameraPath::new(&shot(keys)).unwrap();
    let mut last = path.sample(0.0).pose.rotation;
    for i in 1..=400 {
        let here = path.sample(f64::from(i) * 0.01).pose.rotation;
        let step = rotation::angle_between(last, here).to_degrees();
        assert!(step < 4.0, "turned {step} degrees within 10 ms at {i}");
        last = here;
    }
    assert!(frame.angles(last).pitch_rad < -1.5);
}

#[test]
fn level_keys_give_level_frames() {
    let frame = LevelFrame::new(DVec3::Y).unwrap();
    let mut keys = vec![key(0.0, DVec3::ZERO), key(1.0, DVec3::ZERO)];
    keys[1].pose.rotation = frame.rotation(LevelAngles { yaw_rad: 1.2, pitch_rad: 0.9, roll_rad: 0.0 });
    let path = CameraPath::new(&shot(keys)).unwrap();
    for i in 0..=50 {
        let roll = frame.roll_rad(&path.sample(f64::from(i) / 50.0).pose);
        assert!(roll.abs() < 1e-9, "roll {roll}");
    }
}

#[test]
fn smooth_easing_rests_at_both_ends_and_cruises_between() {
    let mut keys = vec![key(0.0, DVec3::ZERO), key(4.0, DVec3::X)];
    keys[0].easing = Easing::Smooth;
    let path = CameraPath::new(&shot(keys)).unwrap();
    let speed = |t: f64| (path.sample(t + 1e-4).pose.position.x - path.sample(t).pose.position.x) / 1e-4;
    assert!(speed(0.0) < 1e-3 && speed(4.0 - 2e-4) < 1e-3);
    assert!((speed(1.6) - speed(2.4)).abs() < 1e-6, "the middle is a cruise");
}

#[test]
fn times_must_increase_and_numbers_be_finite() {
    let twice = shot(vec![key(0.0, DVec3::ZERO), key(0.0, DVec3::X)]);
    assert!(matches!(CameraPath::new(&twice), Err(TrajectoryError::TimesNotIncreasing { index: 1, .. })));
    let nan = shot(vec![key(0.0, DVec3::NAN)]);
    assert!(matches!(CameraPath::new(&nan), Err(TrajectoryError::BadValue { index: 0, field: "position", .. })));
    assert!(matches!(CameraPath::new(&shot(vec![])), Err(TrajectoryError::NoKeyframes)));
}

/// Shots of seven keys with random positions, rotations, fields of view and times; some keys equal the previous one.
fn random_shots() -> impl Iterator<Item = cinesplat::trajectory::Shot> {
    use rand::{RngExt, SeedableRng};
    let mut rng = rand_pcg::Pcg64::seed_from_u64(4);
    (0..60).map(move |_| {
        let mut keys: Vec<cinesplat::trajectory::Keyframe> = Vec::new();
        let mut time_secs = 0.0;
        for i in 0..7 {
            let mut unit = || rng.random::<f64>() * 2.0 - 1.0;
            let place = DVec3::new(unit(), unit(), unit()) * 3.0;
            let turn = rotation::exp(DVec3::new(unit(), unit(), unit()) * 1.5);
            let stays = i > 0 && unit() > 0.6;
            let fov_y_rad = 0.9 + 0.4 * unit();
            let easing = Easing::VARIANTS[((unit() + 1.0) * 0.499 * Easing::VARIANTS.len() as f64) as usize];
            let mut next = cinesplat::trajectory::Keyframe { fov_y_rad, easing, ..key(time_secs, place) };
            next.pose.rotation *= turn;
            if stays {
                next.pose = keys[i - 1].pose;
            }
            keys.push(next);
            time_secs += 0.2 + 1.5 * (unit() + 1.0);
        }
        shot(keys)
    })
}

#[test]
fn velocity_and_angular_velocity_are_continuous_at_every_key() {
    for (number, shot) in random_shots().enumerate() {
        let path = CameraPath::new(&shot).unwrap();
        let rates = |t: f64| {
            let (a, b) = (path.sample(t).pose, path.sample(t + 1e-6).pose);
            ((b.position - a.position) / 1e-6, rotation::log(b.rotation * a.rotation.conjugate()) / 1e-6)
        };
        let even = (0..500).map(|i| rates(shot.duration_secs * f64::from(i) / 500.0));
        let (peak, turn_peak) = even.fold((0.0_f64, 0.0_f64), |(v, w), r| (v.max(r.0.length()), w.max(r.1.length())));
        for key in &shot.keyframes[1..6] {
            let (before, after) = (rates(key.time_secs - 2e-6), rates(key.time_secs));
            let jump = (before.0 - after.0).length() / peak;
            let turn_jump = (before.1 - after.1).length() / turn_peak;
            assert!(jump < 0.02 && turn_jump < 0.02, "shot {number} at {} s: {jump}, {turn_jump}", key.time_secs);
        }
    }
}

#[test]
fn every_key_of_any_shot_is_met_exactly() {
    for shot in random_shots() {
        let path = CameraPath::new(&shot).unwrap();
        for key in &shot.keyframes {
            let state = path.sample(key.time_secs);
            assert!(state.pose.position.distance(key.pose.position) < 1e-9);
            assert!(rotation::angle_between(state.pose.rotation, key.pose.rotation) < 1e-7);
            assert!((state.fov_y_rad - key.fov_y_rad).abs() < 1e-9);
        }
    }
}

#[test]
fn straight_ways_never_overshoot_a_key() {
    let places = [0.0, 0.001, 4.0, 4.002, 4.9, 5.0];
    let keys = places.iter().enumerate().map(|(i, &x)| key([0.0, 0.9, 1.0, 2.5, 2.6, 6.0][i], DVec3::X * x)).collect();
    let shot = shot(keys);
    let path = CameraPath::new(&shot).unwrap();
    for (pair, at) in places.windows(2).zip(shot.keyframes.windows(2)) {
        for i in 0..=100 {
            let t = at[0].time_secs + (at[1].time_secs - at[0].time_secs) * f64::from(i) / 100.0;
            let p = path.sample(t).pose.position;
            assert!(p.x >= pair[0] - 1e-9 && p.x <= pair[1] + 1e-9 && p.with_x(0.0).length() < 1e-12, "{p} at {t}");
        }
    }
}

#[test]
fn a_way_through_the_zenith_turns_evenly() {
    // Tilting up and over: 80, 90 and 100 degrees of pitch, the last of which is 80 degrees facing back.
    let mut keys = vec![key(0.0, DVec3::ZERO), key(1.0, DVec3::ZERO), key(2.0, DVec3::ZERO)];
    for (key, degrees) in keys.iter_mut().zip([80.0, 90.0, 100.0]) {
        key.pose.rotation *= DQuat::from_rotation_x(f64::to_radians(degrees));
    }
    let path = CameraPath::new(&shot(keys)).unwrap();
    let turn = |t: f64| rotation::angle_between(path.sample(t).pose.rotation, path.sample(t + 0.01).pose.rotation);
    for i in 0..199 {
        let rate = turn(f64::from(i) * 0.01).to_degrees() / 0.01;
        assert!((rate - 10.0).abs() < 0.2, "{rate} degrees a second at {i}");
    }
}

#[test]
fn a_dwell_holds_and_the_moves_around_it_rest() {
    let places = [DVec3::ZERO, DVec3::X, DVec3::X, DVec3::X * 2.0];
    let shot = shot(places.iter().enumerate().map(|(i, &p)| key(i as f64, p)).collect());
    let path = CameraPath::new(&shot).unwrap();
    for i in 0..=50 {
        assert!(path.sample(1.0 + f64::from(i) / 50.0).pose.position.distance(DVec3::X) < 1e-12);
    }
    let speed = |t: f64| (path.sample(t + 1e-5).pose.position - path.sample(t).pose.position).length() / 1e-5;
    assert!(speed(1.0 - 2e-5) < 1e-2 && speed(2.0) < 1e-2);
}

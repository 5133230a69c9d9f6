//! The bounding ball of an interval of a path contains every position of the interval.

use cinesplat::trajectory::{CameraPath, Easing, Intent, Keyframe, Move, PathInterval};
use glam::DVec3;

use super::{key, shot};

fn check(keys: Vec<Keyframe>) {
    let path = CameraPath::new(&shot(keys)).unwrap();
    let mut intervals = path.intervals();
    for _ in 0..6 {
        for &interval in &intervals {
            let ball = path.bounding_ball(interval);
            let (from, to) =
                (path.time_at(interval.key_idx, interval.from), path.time_at(interval.key_idx, interval.to));
            for i in 0..=40 {
                // The interval ends just before the next key.
                let time = from + (to - from) * f64::from(i) / 40.0 * (1.0 - 1e-12);
                let off = path.sample(time).pose.position.distance(ball.center);
                assert!(off <= ball.radius + 1e-7, "{off} off a ball of {} at {time} s", ball.radius);
            }
        }
        let before = intervals.iter().map(|&interval| path.bounding_ball(interval).radius).fold(0.0, f64::max);
        intervals = intervals.into_iter().flat_map(PathInterval::halves).collect();
        let after = intervals.iter().map(|&interval| path.bounding_ball(interval).radius).fold(0.0, f64::max);
        assert!(after <= 0.75 * before + 1e-12, "halves of {before} are {after}");
    }
}

#[test]
fn of_splines() {
    check(vec![
        key(0.0, DVec3::new(0.0, 0.0, 0.0)),
        key(1.0, DVec3::new(1.0, 0.5, 0.0)),
        key(1.5, DVec3::new(1.1, 2.0, 0.3)),
        key(5.0, DVec3::new(-3.0, 2.0, 4.0)),
    ]);
}

#[test]
fn of_circles_and_spirals() {
    let around = |time: f64, degrees: f64, radius: f64, height: f64| {
        let (sin, cos) = f64::to_radians(degrees).sin_cos();
        let intent = Intent { movement: Some(Move::OrbitLeft), pivot: Some(DVec3::ZERO), ..Intent::default() };
        Keyframe { intent: Some(intent), ..key(time, DVec3::new(radius * sin, height, radius * cos)) }
    };
    check(vec![around(0.0, 10.0, 2.0, 1.0), around(3.0, -160.0, 2.0, 1.0)]);
    check(vec![around(0.0, 10.0, 2.0, 1.0), around(1.0, -80.0, 3.0, 0.2), around(4.0, -170.0, 1.0, 2.0)]);
}

#[test]
fn of_blends() {
    let blend = |time: f64, at: DVec3| Keyframe { easing: Easing::Blend, ..key(time, at) };
    check(vec![
        key(0.0, DVec3::ZERO),
        blend(2.0, DVec3::new(2.0, 0.5, 0.0)),
        key(3.0, DVec3::new(2.4, 0.7, 0.4)),
        key(5.0, DVec3::new(2.5, 1.0, 3.0)),
    ]);
}

//! Easings against their published formulas, and their speeds where segments meet.

use std::f64::consts::FRAC_PI_2;
use strum::VariantArray;

use cinesplat::trajectory::{CameraPath, Easing, Keyframe};
use glam::DVec3;

use super::{key, shot};

/// Fraction of the length at `count + 1` even times of a straight segment.
fn progress(easing: Easing, count: usize) -> Vec<f64> {
    let keys = vec![Keyframe { easing, ..key(0.0, DVec3::ZERO) }, key(2.0, DVec3::X)];
    let path = CameraPath::new(&shot(keys)).unwrap();
    (0..=count).map(|i| path.sample(2.0 * i as f64 / count as f64).pose.position.x).collect()
}

fn named(name: &str) -> Easing {
    name.parse().unwrap()
}

#[test]
fn every_easing_goes_from_start_to_end_and_never_back() {
    assert!(Easing::VARIANTS.len() >= 20);
    for &easing in Easing::VARIANTS {
        let way = progress(easing, 1000);
        assert_eq!((way[0], way[1000]), (0.0, 1.0), "{}", easing.as_ref());
        assert!(way.windows(2).all(|p| p[1] >= p[0]), "{} runs backward", easing.as_ref());
    }
}

/// Name of an easing and its curve.
type Formula = (&'static str, fn(f64) -> f64);

#[test]
fn curves_are_those_of_their_formulas() {
    let expected: [Formula; 7] = [
        ("sine-in", |t| 1.0 - (t * FRAC_PI_2).cos()),
        ("quad-in", |t| t * t),
        ("cubic-in", |t| t * t * t),
        ("quart-in", |t| t * t * t * t),
        ("quint-in", |t| t * t * t * t * t),
        ("cubic-in-out", |t| if t < 0.5 { 4.0 * t * t * t } else { 1.0 - (2.0 - 2.0 * t).powi(3) / 2.0 }),
        ("sine-in-out", |t| 0.5 - (2.0 * t * FRAC_PI_2).cos() / 2.0),
    ];
    for (name, formula) in expected {
        for (i, way) in progress(named(name), 40).into_iter().enumerate() {
            assert!((way - formula(i as f64 / 40.0)).abs() < 1e-9, "{name} at {i}/40: {way}");
        }
    }
    // The published curve starts at 2^-10 instead of 0; this one starts at 0 and ends at 1.
    let expo = progress(named("expo-in"), 10);
    assert!((expo[5] - 0.5_f64.powi(5)).abs() < 2e-3, "{}", expo[5]);
}

#[test]
fn in_and_out_mirror_each_other_and_in_out_mirrors_itself() {
    for family in ["ease", "sine", "quad", "cubic", "quart", "quint", "expo"] {
        let (rise, fall) =
            (progress(named(&format!("{family}-in")), 100), progress(named(&format!("{family}-out")), 100));
        for i in 0..=100 {
            assert!((rise[i] - (1.0 - fall[100 - i])).abs() < 1e-9, "{family} at {i}");
        }
        let Some(both) = format!("{family}-in-out").parse::<Easing>().ok() else { continue };
        let both = progress(both, 100);
        assert!((0..=100).all(|i| (both[i] + both[100 - i] - 1.0).abs() < 1e-9), "{family}-in-out");
    }
}

/// Every easing with a speed profile of its own; a blend takes that of its neighbors.
fn profiles() -> impl Iterator<Item = Easing> {
    Easing::VARIANTS.iter().copied().filter(|easing| *easing != Easing::Blend)
}

#[test]
fn rests_are_where_the_names_say() {
    for easing in profiles() {
        let way = progress(easing, 20_000);
        let (start, end) = ((way[1] - way[0]) * 20_000.0, (way[20_000] - way[19_999]) * 20_000.0);
        assert_eq!(start < 0.02, easing.rests_at_start(), "{} starts with speed {start}", easing.as_ref());
        assert_eq!(end < 0.02, easing.rests_at_end(), "{} ends with speed {end}", easing.as_ref());
    }
}

#[test]
fn any_two_easings_meet_at_one_speed() {
    for first in profiles() {
        for second in profiles() {
            let mut keys = vec![key(0.0, DVec3::ZERO), key(1.5, DVec3::X), key(2.0, DVec3::X * 3.0)];
            (keys[0].easing, keys[1].easing) = (first, second);
            let path = CameraPath::new(&shot(keys)).unwrap();
            let x = |t: f64| path.sample(t).pose.position.x;
            let speed = |t: f64| (x(t + 1e-6) - x(t)) / 1e-6;
            let (before, after) = (speed(1.5 - 1e-6), speed(1.5));
            let peak = (0..200).map(|i| speed(f64::from(i) * 0.01)).fold(0.0, f64::max);
            let names = (first.as_ref(), second.as_ref());
            assert!((before - after).abs() < 0.01 * peak, "{names:?}: {before} then {after}, peak {peak}");
            assert!(
                (0..400).all(|i| x(f64::from(i + 1) * 0.005) >= x(f64::from(i) * 0.005)),
                "{names:?} runs backward"
            );
        }
    }
}

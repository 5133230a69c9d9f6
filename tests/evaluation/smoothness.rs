//! Smoothness against numpy's results for the published definitions (the reference implementation's defaults: padding
//! 4, 10 Hz, 0.05) on the same samples.

use cinesplat::evaluation::{Smoothness, smoothness};
use cinesplat::geometry::Pose;
use glam::{DQuat, DVec3};

use super::paths::{at_30_fps, through};

/// 8 s at 30 frames per second along x, as a function of the fraction of the time.
fn moved(x: impl Fn(f64) -> f64) -> Smoothness {
    smoothness(&through((0..=240).map(|k| DVec3::X * x(f64::from(k) / 240.0)), DQuat::IDENTITY)).unwrap()
}

fn close(got: Option<f64>, wanted: f64, what: &str) {
    let got = got.unwrap();
    assert!((got / wanted - 1.0).abs() < 1e-7, "{what}: got {got}, wanted {wanted}");
}

#[test]
fn a_minimum_jerk_move() {
    let got = moved(|s| 10.0 * s.powi(3) - 15.0 * s.powi(4) + 6.0 * s.powi(5));
    close(got.spectral_arc_length, -1.400_410_528_897_111, "sparc");
    close(got.jerk_rms, 0.051_544_880_384_520_715, "rms jerk");
    close(got.jerk_max, 0.112_823_486_328_125_14, "largest jerk");
    close(got.log_dimensionless_jerk, -5.280_551_500_291_772, "ldlj");
    assert_eq!(got.num_reversals, 0);
    assert_eq!((got.angular_jerk_rms, got.angular_spectral_arc_length), (None, None));
}

#[test]
fn a_wobble_is_less_smooth_by_every_measure() {
    let wobble = moved(|s| s + 0.02 * (std::f64::consts::TAU * 2.0 * 8.0 * s).sin());
    close(wobble.spectral_arc_length, -5.948_660_008_085_747_5, "sparc");
    close(wobble.log_dimensionless_jerk, -16.920_404_228_077_54, "ldlj");
    assert!(wobble.num_reversals > 10);
}

#[test]
fn a_constant_speed_has_no_ripple_and_a_ramp_is_no_cruise() {
    let even = moved(|s| s);
    assert!(even.speed_ripple.unwrap() < 1e-12 && even.jerk_rms.unwrap() < 1e-9);
    assert_eq!(even.log_dimensionless_jerk, None);
    // A fifth of the time to accelerate, three fifths at constant speed, a fifth to slow down.
    let ramped = moved(|s| {
        if s < 0.2 {
            s * s / 0.4
        } else if s < 0.8 {
            s - 0.1
        } else {
            0.7 - (1.0 - s) * (1.0 - s) / 0.4 + 0.1
        }
    });
    assert!(ramped.speed_ripple.unwrap() < 0.05, "{:?}", ramped.speed_ripple);
}

#[test]
fn turning_is_measured_apart_from_travelling() {
    let pan: Vec<Pose> = (0..=90)
        .map(|k| f64::from(k) / 90.0)
        .map(|s| Pose::new(DVec3::ONE, DQuat::from_rotation_y(10.0 * s.powi(3) - 15.0 * s.powi(4) + 6.0 * s.powi(5))))
        .collect();
    let got = smoothness(&at_30_fps(&pan)).unwrap();
    assert_eq!(got.jerk_rms, None);
    close(got.angular_spectral_arc_length, -1.396_369_019_705_450_1, "angular sparc");
    close(got.angular_jerk_rms, 0.951_063_262_744_202, "rms angular jerk");
}

#[test]
fn too_little_to_measure_is_none() {
    assert_eq!(smoothness(&through(std::iter::once(DVec3::ONE), DQuat::IDENTITY)), None);
    let still = smoothness(&through(std::iter::repeat_n(DVec3::ONE, 30), DQuat::IDENTITY)).unwrap();
    assert_eq!(still, Smoothness::default());
}

//! Shots as data: vocabulary and frame counts.

use cinesplat::trajectory::{Easing, Move, ShotAngle, ShotSize};
use glam::DVec3;

use super::{key, shot};

#[test]
fn names_round_trip() {
    assert!(Move::ALL.iter().all(|&m| Move::from_name(m.name()) == Some(m)));
    assert!(ShotSize::ALL.iter().all(|&s| ShotSize::from_name(s.name()) == Some(s)));
    assert!(ShotAngle::ALL.iter().all(|&a| ShotAngle::from_name(a.name()) == Some(a)));
    assert!(Easing::ALL.iter().all(|&e| Easing::from_name(e.name()) == Some(e)));
    assert_eq!(Move::from_name("teleport"), None);
}

#[test]
fn sizes_tile_the_heights() {
    assert_eq!(ShotSize::of_height_frac(2.0), ShotSize::ExtremeCloseUp);
    assert_eq!(ShotSize::of_height_frac(1.0), ShotSize::CloseUp);
    assert_eq!(ShotSize::of_height_frac(0.7), ShotSize::Medium);
    assert_eq!(ShotSize::of_height_frac(0.01), ShotSize::ExtremeLong);
}

#[test]
fn a_film_has_duration_times_rate_frames() {
    let mut shot = shot(vec![key(0.0, DVec3::ZERO), key(8.0, DVec3::X)]);
    assert_eq!(shot.num_frames(), 240);
    shot.duration_secs = 0.0;
    assert_eq!(shot.num_frames(), 1);
}

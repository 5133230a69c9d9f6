//! Shots as data: vocabulary and frame counts.

use cinesplat::trajectory::{Easing, Move, ShotAngle, ShotSize};
use glam::DVec3;
use strum::VariantArray;

use super::{key, shot};

#[test]
fn names_round_trip() {
    assert!(Move::VARIANTS.iter().all(|&m| m.as_ref().parse() == Ok(m)));
    assert!(ShotSize::VARIANTS.iter().all(|&s| s.as_ref().parse() == Ok(s)));
    assert!(ShotAngle::VARIANTS.iter().all(|&a| a.as_ref().parse() == Ok(a)));
    assert!(Easing::VARIANTS.iter().all(|&e| e.as_ref().parse() == Ok(e)));
    assert_eq!("teleport".parse::<Move>().ok(), None);
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

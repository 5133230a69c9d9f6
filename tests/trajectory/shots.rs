//! Shots as data: vocabulary and frame counts.

use cinesplat::trajectory::{Easing, MAX_KEYFRAMES, Move, ShotAngle, ShotSize};
use glam::DVec3;
use strum::{VariantArray, VariantNames};

use super::{key, shot};

#[test]
fn names_are_those_of_the_file_format() {
    insta::assert_snapshot!(<Move as VariantNames>::VARIANTS.join(" "), @"static pan-left pan-right tilt-up tilt-down roll-cw roll-ccw push-in pull-out truck-left truck-right pedestal-up pedestal-down crane-up crane-down orbit-left orbit-right arc-left arc-right zoom-in zoom-out dolly-zoom-in dolly-zoom-out follow fly-through reveal whip-pan rack-focus handheld");
    insta::assert_snapshot!(<ShotSize as VariantNames>::VARIANTS.join(" "), @"extreme-close-up close-up medium-close-up medium medium-long long extreme-long");
    insta::assert_snapshot!(<ShotAngle as VariantNames>::VARIANTS.join(" "), @"overhead high eye-level low worm");
    insta::assert_snapshot!(Easing::VOCABULARY.iter().map(AsRef::as_ref).collect::<Vec<_>>().join(" "), @"smooth linear ease-in ease-out");
}

#[test]
fn sizes_cover_every_height_once() {
    for pair in <ShotSize as VariantArray>::VARIANTS.windows(2) {
        let (larger, smaller) = (pair[0].height_band_frac(), pair[1].height_band_frac());
        assert!(smaller.0 < smaller.1 && smaller.1.total_cmp(&larger.0).is_eq(), "{} {}", pair[0], pair[1]);
    }
}

#[test]
fn a_film_has_duration_times_rate_frames() {
    let mut shot = shot(vec![key(0.0, DVec3::ZERO), key(8.0, DVec3::X)]);
    assert_eq!(shot.num_frames(), 240);
    shot.duration_secs = 0.0;
    assert_eq!(shot.num_frames(), 1);
}

/// A million keys used to take a minute and gigabytes of memory.
#[test]
fn a_shot_with_too_many_keys_is_refused() {
    let keys = |num: usize| (0..num).map(|i| key(i as f64 * 0.01, DVec3::ZERO)).collect();
    let checked = |num: usize| shot(keys(num)).validated().map(|_| ()).map_err(|error| error.to_string());
    assert_eq!(checked(MAX_KEYFRAMES), Ok(()));
    assert_eq!(checked(MAX_KEYFRAMES + 1).unwrap_err(), "a shot has 100001 keyframes, expected at most 100000");
}

/// Such keys used to be dropped without a word.
#[test]
fn keys_after_the_end_of_the_film_are_a_warning() {
    let mut shot = shot(vec![key(0.0, DVec3::ZERO), key(4.0, DVec3::X), key(8.0, DVec3::Y)]);
    assert!(shot.warnings().is_empty());
    shot.duration_secs = 4.0 - 1e-9;
    insta::assert_snapshot!(shot.warnings().join("\n"), @"1 of 3 keyframes lie after the end of the film and are not shown: the last is at 8 s, duration_secs is 3.999999999");
    shot.duration_secs = 0.0;
    insta::assert_snapshot!(shot.warnings().join("\n"), @r"
    2 of 3 keyframes lie after the end of the film and are not shown: the last is at 8 s, duration_secs is 0
    duration_secs is 0, less than half a frame at 30 frames per second: the film has one frame
    ");
}

/// The error said `focus_distance is Some(-1.0)`.
#[test]
fn a_focus_behind_the_camera_is_shown_in_the_notation_of_the_program() {
    let at = |focus_distance: f64| {
        let mut shot = shot(vec![key(0.0, DVec3::ZERO), key(1.0, DVec3::X)]);
        shot.keyframes[1].focus_distance = Some(focus_distance);
        shot.validated().unwrap_err().to_string()
    };
    insta::assert_snapshot!(at(-1.0), @"keyframe 1: focus_distance is -1, expected above 0, or null");
    assert!(at(f64::NAN).contains("focus_distance is NaN"), "{}", at(f64::NAN));
}

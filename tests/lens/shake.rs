use cinesplat::lens::{EffectChoice, EffectPlan};

use super::stand::{call, called, camera, effect};

const SIZE: [u32; 2] = [64, 36];

#[test]
fn a_hand_without_amplitude_leaves_the_path_as_it_is() {
    let still = called(&[call("handheld", &[("turn_deg", 0.0), ("shift", 0.0)])], &EffectChoice::Auto);
    assert!(still.effects.is_empty());
    assert_eq!(EffectPlan::moved(&still.effects, camera(SIZE), 1.3), camera(SIZE));
}

#[test]
fn a_hand_stays_within_its_reach_and_never_jumps() {
    let hand = effect("handheld", &[("turn_deg", 1.0), ("shift", 0.1), ("seed", 3.0)]);
    let reach = hand[0].effect.reach();
    let at = |millis: u32| EffectPlan::moved(&hand, camera(SIZE), f64::from(millis) / 1000.0).pose;
    let mut farthest: f64 = 0.0;
    for millis in 0..60_000 {
        let (now, next) = (at(millis), at(millis + 1));
        let distance = now.position.distance(camera(SIZE).pose.position);
        farthest = farthest.max(distance);
        assert!(now.position.distance(next.position) < 0.01 * reach, "a jump at {millis} ms");
        assert!(now.rotation.angle_between(next.rotation) < 2e-3);
    }
    assert!(farthest <= reach && farthest > 0.3 * reach, "{farthest} of {reach}");
}

#[test]
fn a_hand_is_a_function_of_seed_and_time() {
    let at = |seed: f64, secs: f64| EffectPlan::moved(&effect("handheld", &[("seed", seed)]), camera(SIZE), secs);
    assert_eq!(at(1.0, 4.2), at(1.0, 4.2));
    assert_ne!(at(1.0, 4.2), at(2.0, 4.2));
    assert_ne!(at(1.0, 4.2), at(1.0, 4.3));
}

/// Low frequencies carry most of the motion: a hand sways more than it trembles.
#[test]
fn the_motion_of_a_hand_falls_off_with_frequency() {
    let hand = effect("handheld", &[("turn_deg", 0.0), ("shift", 1.0), ("seed", 5.0)]);
    let samples: Vec<f64> =
        (0..4096).map(|i| EffectPlan::moved(&hand, camera(SIZE), f64::from(i) / 64.0).pose.position.x).collect();
    let power = |from_hz: f64, to_hz: f64| -> f64 {
        let bins = (from_hz * 64.0) as usize..(to_hz * 64.0) as usize;
        bins.map(|bin| {
            let step = std::f64::consts::TAU * bin as f64 / 4096.0;
            let (mut re, mut im) = (0.0, 0.0);
            for (i, x) in samples.iter().enumerate() {
                re += x * (step * i as f64).cos();
                im += x * (step * i as f64).sin();
            }
            re * re + im * im
        })
        .sum()
    };
    let (slow, middle, fast) = (power(0.05, 1.0), power(1.0, 4.0), power(4.0, 16.0));
    assert!(slow > 5.0 * middle && middle > 5.0 * fast, "{slow} {middle} {fast}");
}

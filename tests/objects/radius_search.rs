//! Oracles: a scan over every radius by brute force, and step functions with a known minimum.

use cinesplat::objects::radius_search::{Coverage, RadiusOptimizer, SearchStatus};

use super::Dice;

/// Pixels with random radii; those of a small radius are more often inside the mask. Radii repeat.
fn random_coverage(seed: u64) -> (Coverage, Vec<f32>) {
    let mut dice = Dice::new(seed);
    let radii: Vec<f32> = (0..600).map(|_| (dice.unit() * 80.0).round() as f32 / 4.0 + 0.25).collect();
    let mask: Vec<bool> = radii.iter().map(|r| dice.unit() * 20.0 > f64::from(*r)).collect();
    let mut coverage = Coverage::default();
    coverage.add(&radii[..300], &mask[..300]);
    coverage.add(&radii[300..], &mask[300..]);
    (coverage, radii)
}

#[test]
fn the_exact_sweep_finds_the_least_mismatch_of_all_radii() {
    for seed in 0..40 {
        let (coverage, radii) = random_coverage(seed);
        let least = radii.iter().map(|r| coverage.mismatch(f64::from(*r))).chain([coverage.mismatch(0.0)]).min();
        let found = coverage.minimize(RadiusOptimizer::ExactSweep);
        assert_eq!(Some(found.mismatch), least);
        assert_eq!(coverage.mismatch(found.radius_px), found.mismatch, "the radius gives the mismatch");
        assert_eq!(found.status, SearchStatus::Exact);
    }
}

#[test]
fn zeroth_order_is_never_better_keeps_its_budget_and_repeats_itself() {
    for seed in 0..40 {
        let (coverage, _) = random_coverage(seed);
        let exact = coverage.minimize(RadiusOptimizer::ExactSweep);
        for budget in [0, 1, 2, 3, 17, 96] {
            let optimizer = RadiusOptimizer::ZerothOrder { budget, seed };
            let found = coverage.minimize(optimizer);
            assert!(found.num_evaluations <= budget);
            assert!(found.mismatch >= exact.mismatch && found.mismatch <= coverage.mismatch(0.0));
            assert_eq!(found.mismatch, coverage.mismatch(found.radius_px));
            assert_eq!(found, coverage.minimize(optimizer));
        }
    }
}

#[test]
fn a_mask_that_no_shape_covers_has_the_empty_shape() {
    let mut coverage = Coverage::default();
    coverage.add(&[f32::INFINITY; 9], &[true; 9]);
    for optimizer in [RadiusOptimizer::ExactSweep, RadiusOptimizer::ZEROTH_ORDER] {
        let found = coverage.minimize(optimizer);
        assert_eq!((found.radius_px.to_bits(), found.mismatch), (0, 9));
    }
    assert_eq!(coverage.minimize(RadiusOptimizer::ZEROTH_ORDER).status, SearchStatus::Flat);
}

#[test]
fn an_empty_mask_wants_the_empty_shape() {
    let mut coverage = Coverage::default();
    coverage.add(&[1.0, 2.0, 3.0], &[false; 3]);
    assert_eq!(coverage.minimize(RadiusOptimizer::ExactSweep).mismatch, 0);
    assert_eq!(coverage.minimize(RadiusOptimizer::ZEROTH_ORDER).mismatch, 0);
    assert_eq!(Coverage::default().minimize(RadiusOptimizer::ExactSweep).mismatch, 0);
}

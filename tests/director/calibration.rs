//! Calibrated probabilities.

use cinesplat::director::Calibration;

#[test]
fn a_fit_recovers_the_frequencies_of_its_examples() {
    // Overconfident: 0.99 is right 80 % of the time, 0.6 is right 40 %.
    let mut examples = Vec::new();
    for nth in 0..1000 {
        examples.push((0.99, nth % 10 < 8));
        examples.push((0.6, nth % 10 < 4));
    }
    let fitted = Calibration::fit(&examples);
    assert!((fitted.apply(0.99) - 0.8).abs() < 1e-6);
    assert!((fitted.apply(0.6) - 0.4).abs() < 1e-6);
}

#[test]
fn one_sided_examples_and_extreme_probabilities_stay_finite() {
    assert_eq!(Calibration::fit(&[(0.5, true)]), Calibration::default());
    let fitted = Calibration::fit(&[(0.0, false), (1.0, true), (f64::NAN, false)]);
    for probability in [0.0, 1e-300, 0.5, 1.0, f64::NAN] {
        assert!((0.0..=1.0).contains(&fitted.apply(probability)), "{probability}");
    }
}

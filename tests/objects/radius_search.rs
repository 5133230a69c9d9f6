use std::cell::Cell;

use cinesplat::objects::radius_search::maximize;

#[test]
fn a_smooth_peak_is_found() {
    let found = maximize(0.5, 200.0, 40, |r| -(r.ln() - 7.0_f64.ln()).powi(2));
    assert!((found.radius - 7.0).abs() < 0.05, "{found:?}");
}

#[test]
fn the_budget_is_never_exceeded() {
    for budget in 0..30 {
        let asked = Cell::new(0);
        let found = maximize(1.0, 10.0, budget, |r| {
            asked.set(asked.get() + 1);
            r.sin()
        });
        assert!(asked.get() <= budget && found.num_evaluations == asked.get(), "budget {budget}: {}", asked.get());
    }
}

#[test]
fn plateaus_give_their_smallest_radius_and_nan_loses() {
    assert_eq!(maximize(1.0, 64.0, 20, |_| 0.25).radius.to_bits(), 1.0_f64.to_bits());
    let found = maximize(1.0, 64.0, 30, |r| if r < 8.0 { f64::NAN } else { -r });
    assert!(found.radius >= 8.0 && found.radius < 10.0, "{found:?}");
    assert!(maximize(1.0, 64.0, 9, |_| f64::NAN).value.is_infinite());
}

#[test]
fn the_plateau_of_a_step_function_is_found() {
    let found = maximize(1.0, 100.0, 60, |r| if (20.0..30.0).contains(&r) { 1.0 } else { 0.0 });
    assert!((20.0..30.0).contains(&found.radius), "{found:?}");
}

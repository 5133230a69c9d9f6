//! The opacity of a splat that blur spreads over a larger area.
//!
//! Enters: opacity, and the area before the blur divided by that after it. Leaves: the opacity at which the splat has
//! the same optical depth, summed over the pixels where it is above the alpha cut.
//!
//! A splat of opacity o has the optical depth -ln(1 - o exp(-t)) at q / 2 = t. Its integral over the pixels above the
//! cut c is 2 pi sqrt(det) (Li2(o) - Li2(c)), with the dilogarithm Li2(x) = x + x^2/4 + x^3/9 + ... Optical depths of
//! layers add up, so a wall of many splats stays as opaque as it was. Opacity times area does not: the background would
//! shine through. As the cut is part of the integral, a wide splat does not vanish below it either.

use super::logarithm::log2;
use super::spec;

/// Opacity at most, as in blending.
const MAX: f32 = spec::ALPHA_MAX as f32;

/// Spreads opacities over a larger area.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Spread {
    /// Li2 of the alpha cut.
    cut: f32,
}

impl Spread {
    /// For pictures with this alpha cut.
    pub(super) fn above(alpha_cut: f64) -> Self {
        Self { cut: dilogarithm_f32(alpha_cut as f32) }
    }

    /// The opacity of a splat whose area has grown by 1 / `area_frac`; relative error up to 5e-5. Vectorizes.
    #[inline(always)]
    pub(super) fn opacity(self, opacity: f32, area_frac: f32) -> f32 {
        let depth = dilogarithm_f32(opacity.min(MAX));
        inverse_f32(self.cut + (depth - self.cut) * area_frac)
    }
}

/// As [`Spread::opacity`], in `f64`.
pub(super) fn opacity(opacity: f64, area_frac: f64, alpha_cut: f64) -> f64 {
    let cut = dilogarithm(alpha_cut);
    let wanted = cut + (dilogarithm(opacity.min(spec::ALPHA_MAX)) - cut) * area_frac;
    // Li2 is convex: Newton's method falls from above onto the solution.
    let mut found = spec::ALPHA_MAX;
    for _ in 0..60 {
        let slope = -(-found).ln_1p() / found;
        let step = (dilogarithm(found) - wanted) / slope;
        found = (found - step).max(1e-12);
        if step.abs() < 1e-14 {
            break;
        }
    }
    found
}

/// Li2 at 0..1.
fn dilogarithm(x: f64) -> f64 {
    let series = |x: f64| {
        let (mut power, mut sum) = (1.0, 0.0);
        for k in 1..60 {
            power *= x;
            sum += power / f64::from(k * k);
        }
        sum
    };
    if x <= 0.5 {
        series(x)
    } else {
        // Euler's reflection formula.
        std::f64::consts::PI.powi(2) / 6.0 - x.ln() * (-x).ln_1p() - series(1.0 - x)
    }
}

/// Li2 at 0..=0.99 with a relative error below 2e-6: u times a polynomial in u = -ln(1 - x), fitted for the smallest
/// maximal error.
#[inline(always)]
fn dilogarithm_f32(x: f32) -> f32 {
    const TERMS: [f32; 7] =
        [-1.170_904_9e-6, 3.879_041e-5, -3.916_691_3e-4, 1.693_954_4e-4, 2.765_763_7e-2, -0.249_967_96, 0.999_998_6];
    let u = log2(1.0 - x) * -std::f32::consts::LN_2;
    TERMS.iter().fold(0.0, |sum, term| sum * u + term) * u
}

/// The inverse of Li2 at 0..=Li2(0.99) with a relative error below 4e-5: y times a polynomial in y.
#[inline(always)]
fn inverse_f32(y: f32) -> f32 {
    const TERMS: [f32; 7] =
        [-8.235_919e-3, 3.328_520_8e-2, -5.264_852e-2, 3.631_372_7e-2, 1.311_746_8e-3, -0.248_476_04, 0.999_970_1];
    TERMS.iter().fold(0.0, |sum, term| sum * y + term) * y
}

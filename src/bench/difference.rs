use rayon::prelude::*;

use cinesplat_render::Frame;

/// Half the width of the SSIM window of 11 x 11 pixels.
const REACH: usize = 5;
/// Standard deviation of the SSIM window, pixels.
const SIGMA: f64 = 1.5;
/// (0.01 L)^2 and (0.03 L)^2 with the range of color L = 1.
const STABILIZERS: [f64; 2] = [1e-4, 9e-4];

/// Difference between two pictures of the same size, both clamped to 0..=1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Difference {
    /// PSNR in dB with peak 1; infinite for equal pictures.
    pub psnr_db: f64,
    /// SSIM, at most 1; NaN for pictures smaller than 11 x 11 pixels.
    pub ssim: f64,
    /// Largest absolute difference of a channel of a pixel, 0..=1.
    pub worst: f64,
}

impl Difference {
    /// The difference of pictures that cannot be compared: all NaN.
    pub(super) const UNKNOWN: Self = Self { psnr_db: f64::NAN, ssim: f64::NAN, worst: f64::NAN };
}

/// The difference of two pictures; all NaN for different sizes.
pub fn difference(picture: &Frame, spec: &Frame) -> Difference {
    if (picture.width, picture.height) != (spec.width, spec.height) {
        return Difference::UNKNOWN;
    }
    let apart = picture.rgb.iter().zip(&spec.rgb).map(|(a, b)| (a.clamp(0.0, 1.0) - b.clamp(0.0, 1.0)).abs());
    let worst = f64::from(apart.fold(0.0, f32::max));
    Difference { psnr_db: picture.psnr_db(spec), ssim: ssim(picture, spec), worst }
}

/// Mean SSIM over all channels and all positions where the window is inside the picture.
///
/// Wang, Bovik, Sheikh and Simoncelli, Image Quality Assessment: From Error Visibility to Structural Similarity, 2004:
/// Gaussian window of 11 x 11 pixels with a standard deviation of 1.5, K1 = 0.01, K2 = 0.03. Each color channel is
/// treated as a picture of its own.
fn ssim(a: &Frame, b: &Frame) -> f64 {
    let (width, height) = (a.width as usize, a.height as usize);
    if width <= 2 * REACH || height <= 2 * REACH {
        return f64::NAN;
    }
    let window = window();
    let rows = REACH..height - REACH;
    let sums: Vec<f64> = rows.into_par_iter().map(|row| row_sum(a, b, row, &window)).collect();
    sums.iter().sum::<f64>() / (3 * (width - 2 * REACH) * (height - 2 * REACH)) as f64
}

/// Sum of the SSIM over one row of window centers and all channels.
fn row_sum(a: &Frame, b: &Frame, row: usize, window: &[f64]) -> f64 {
    let stride = a.width as usize * 3;
    // Vertical weighted means of a, b, a^2, b^2 and ab: `[column * 3 + channel]`.
    let mut columns = vec![[0.0; 5]; stride];
    for (weight, y) in window.iter().zip(row - REACH..) {
        let values = a.rgb[y * stride..][..stride].iter().zip(&b.rgb[y * stride..][..stride]);
        for (sums, (a, b)) in columns.iter_mut().zip(values) {
            let (a, b) = (f64::from(a.clamp(0.0, 1.0)), f64::from(b.clamp(0.0, 1.0)));
            for (sum, value) in sums.iter_mut().zip([a, b, a * a, b * b, a * b]) {
                *sum += weight * value;
            }
        }
    }
    let at = |first: usize| {
        let mut moments = [0.0; 5];
        for (weight, column) in window.iter().zip(columns[first..].iter().step_by(3)) {
            moments.iter_mut().zip(column).for_each(|(sum, value)| *sum += weight * value);
        }
        similarity(moments)
    };
    (0..stride - 2 * REACH * 3).map(at).sum()
}

/// SSIM of two windows from their weighted means of a, b, a^2, b^2 and ab.
fn similarity([a, b, aa, bb, ab]: [f64; 5]) -> f64 {
    let [c1, c2] = STABILIZERS;
    let (variance_a, variance_b, covariance) = (aa - a * a, bb - b * b, ab - a * b);
    (2.0 * a * b + c1) * (2.0 * covariance + c2) / ((a * a + b * b + c1) * (variance_a + variance_b + c2))
}

/// The window along one axis; its weights sum to 1.
fn window() -> [f64; 2 * REACH + 1] {
    let mut window = [0.0; 2 * REACH + 1];
    for (position, weight) in window.iter_mut().enumerate() {
        let offset = position as f64 - REACH as f64;
        *weight = (-offset * offset / (2.0 * SIGMA * SIGMA)).exp();
    }
    let sum: f64 = window.iter().sum();
    window.map(|weight| weight / sum)
}

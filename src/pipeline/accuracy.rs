//! PSNR of pictures against the spec image, from their difference to `final` and the accuracy of `final` itself.

use cinesplat_render::{Frame, Quality, RenderSettings};

/// PSNR in dB against `reference` of pictures whose mean square differences to `final` are `mean_squares`. The error of
/// `final` itself is added, so the result is at most `final_db`.
pub(super) fn psnr_db(mean_squares: impl Iterator<Item = f64>, final_db: f64) -> f64 {
    let (sum, num) = mean_squares.fold((0.0, 0), |(sum, num), square| (sum + square, num + 1));
    -10.0 * (sum / f64::from(num.max(1)) + 10_f64.powf(-final_db / 10.0)).log10()
}

/// Mean square difference of colors clamped to 0..=1; 0 for equal pictures.
pub(super) fn mean_square(a: &Frame, b: &Frame) -> f64 {
    10_f64.powf(-a.psnr_db(b) / 10.0)
}

/// The settings with the preset of another quality.
pub(super) fn at(settings: &RenderSettings, quality: Quality) -> RenderSettings {
    RenderSettings { quality, accuracy: None, ..*settings }
}

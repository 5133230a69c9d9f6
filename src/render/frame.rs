use rayon::prelude::*;

use super::RenderStats;

/// A rendered picture in `f32`. Rows count from the top, columns from the left.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Frame {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// Color: `[(row * width + column) * 3 + channel]` with channels r, g, b; 0 or more, not clamped from above.
    pub rgb: Vec<f32>,
    /// Final transmittance, the weight of the background, 0..=1: `[row * width + column]`.
    pub transmittance: Vec<f32>,
    /// Time and work of this picture.
    pub stats: RenderStats,
}

impl Frame {
    /// Resizes to a picture of this size and keeps the memory; the values are unspecified.
    pub(super) fn resize(&mut self, width: u32, height: u32) {
        let num_pixels = width as usize * height as usize;
        (self.width, self.height) = (width, height);
        self.rgb.resize(num_pixels * 3, 0.0);
        self.transmittance.resize(num_pixels, 1.0);
    }

    /// Color in 8 bits, `[(row * width + column) * 3 + channel]`: clamped to 0..=1, rounded to the nearest of 256
    /// levels.
    pub fn to_rgb8(&self) -> Vec<u8> {
        self.rgb.iter().map(|&value| level(value)).collect()
    }

    /// As [`Frame::to_rgb8`], into `rgb8`, which is resized and overwritten.
    pub(super) fn write_rgb8(&self, rgb8: &mut Vec<u8>) {
        const VALUES_PER_JOB: usize = 1 << 16;
        rgb8.resize(self.rgb.len(), 0);
        rgb8.par_chunks_mut(VALUES_PER_JOB).zip(self.rgb.par_chunks(VALUES_PER_JOB)).for_each(|(levels, values)| {
            levels.iter_mut().zip(values).for_each(|(to, &value)| *to = level(value));
        });
    }

    /// PSNR in dB against another picture of the same size, both clamped to 0..=1, peak 1. Infinite for equal pictures,
    /// NaN for pictures of different sizes.
    pub fn psnr_db(&self, other: &Self) -> f64 {
        if self.rgb.len() != other.rgb.len() || self.width != other.width {
            return f64::NAN;
        }
        let difference = |(&a, &b): (&f32, &f32)| f64::from(a.clamp(0.0, 1.0)) - f64::from(b.clamp(0.0, 1.0));
        let sum: f64 = self.rgb.iter().zip(&other.rgb).map(|pair| difference(pair).powi(2)).sum();
        -10.0 * (sum / self.rgb.len() as f64).log10()
    }
}

/// A rendered picture in 8 bits, for films. Rows count from the top, columns from the left.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Rgb8Frame {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// Color: `[(row * width + column) * 3 + channel]` with channels r, g, b, as [`Frame::to_rgb8`].
    pub rgb8: Vec<u8>,
    /// Time and work of this picture.
    pub stats: RenderStats,
}

/// A value clamped to 0..=1, as the nearest of 256 levels. The addition moves the integer part into the lowest bits of
/// the mantissa; a cast does not vectorize.
#[inline(always)]
pub(super) fn level(value: f32) -> u8 {
    const SHIFT: f32 = 8_388_608.0;
    (value.clamp(0.0, 1.0) * 255.0 + SHIFT).to_bits() as u8
}

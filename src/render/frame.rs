use rayon::prelude::*;

use super::RenderStats;

/// A rendered picture. Rows from the top, pixels from the left.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Frame {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// Red, green, blue of each pixel: `[(row * width + column) * 3 + channel]`, as trained, 0 and up.
    pub rgb: Vec<f32>,
    /// What is left of the background in each pixel, 0..=1: `[row * width + column]`.
    pub transmittance: Vec<f32>,
    /// How much work it was and where the time went.
    pub stats: RenderStats,
}

impl Frame {
    /// Makes room for a picture of this size; what was in it is lost, its memory is kept.
    pub(super) fn resize(&mut self, width: u32, height: u32) {
        let num_pixels = width as usize * height as usize;
        (self.width, self.height) = (width, height);
        self.rgb.resize(num_pixels * 3, 0.0);
        self.transmittance.resize(num_pixels, 1.0);
    }

    /// Eight-bit color, values clamped to 0..=1 and rounded to the nearest level.
    pub fn to_rgb8(&self) -> Vec<u8> {
        self.rgb.iter().map(|&value| level(value)).collect()
    }

    /// Writes eight-bit color over `rgb8`, which is made to fit.
    pub(super) fn write_rgb8(&self, rgb8: &mut Vec<u8>) {
        const VALUES_AT_ONCE: usize = 1 << 16;
        rgb8.resize(self.rgb.len(), 0);
        rgb8.par_chunks_mut(VALUES_AT_ONCE).zip(self.rgb.par_chunks(VALUES_AT_ONCE)).for_each(|(levels, values)| {
            levels.iter_mut().zip(values).for_each(|(to, &value)| *to = level(value));
        });
    }

    /// Peak signal-to-noise ratio in dB against another picture of the same size, both clamped to 0..=1, peak 1.
    /// Infinite for equal pictures, NaN for different sizes.
    pub fn psnr_db(&self, other: &Self) -> f64 {
        if self.rgb.len() != other.rgb.len() || self.width != other.width {
            return f64::NAN;
        }
        let difference = |(&a, &b): (&f32, &f32)| f64::from(a.clamp(0.0, 1.0)) - f64::from(b.clamp(0.0, 1.0));
        let sum: f64 = self.rgb.iter().zip(&other.rgb).map(|pair| difference(pair).powi(2)).sum();
        -10.0 * (sum / self.rgb.len() as f64).log10()
    }
}

/// A rendered picture in eight bits, as films take it. Rows from the top, pixels from the left.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Rgb8Frame {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// Red, green, blue of each pixel: `[(row * width + column) * 3 + channel]`, those of [`Frame::to_rgb8`].
    pub rgb8: Vec<u8>,
    /// How much work it was and where the time went.
    pub stats: RenderStats,
}

/// A value clamped to 0..=1 as the nearest of 256 levels. The sum has its whole part in the lowest bits; a cast would
/// not vectorize.
#[inline(always)]
pub(super) fn level(value: f32) -> u8 {
    const SHIFT: f32 = 8_388_608.0;
    (value.clamp(0.0, 1.0) * 255.0 + SHIFT).to_bits() as u8
}

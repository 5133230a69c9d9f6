//! Noise of film stock.

use cinesplat_render::{Frame, RenderError};
use rayon::prelude::*;

use super::budget::{Budget, Loss};
use super::calls::{Call, Calls};
use super::effect::{Effect, EffectKind, Next};
use super::light::{Picture, mixed};
use super::moment::Moment;
use super::seen::FrameFacts;

/// Height in pixels at which a grain is as large as `size_px` says; it grows with the frame's height.
const HEIGHT_PX: f64 = 720.0;
/// Share of the noise that the channels have in common: film grain is mostly a matter of brightness.
const COMMON: f32 = 0.8;

/// Noise of film stock: strongest in the middle tones, none in black and white, a new pattern per frame.
///
/// The noise is a hash of frame and pixel, smoothed to the size of a grain: the same for any first frame and any number
/// of threads.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FilmGrain {
    /// Standard deviation in the middle tones, of the display's 0..=1.
    pub strength: f64,
    /// Standard deviation of a grain's profile, pixels at 720 rows.
    pub size_px: f64,
}

impl EffectKind for FilmGrain {
    const NAME: &'static str = "film-grain";
    const SETTINGS: &'static [&'static str] = &["strength", "size_px"];

    fn called_for(call: &Call, _: &Calls<'_>) -> Option<Self> {
        let strength = call.setting_or("strength", [0.012, 0.022, 0.05]).min(0.5);
        let size_px = call.setting_or("size_px", [0.7, 0.8, 1.1]).clamp(0.0, 8.0);
        (strength > 0.0).then_some(Self { strength, size_px })
    }
}

impl Effect for FilmGrain {
    fn settings(&self) -> Vec<(&'static str, f64)> {
        vec![("strength", self.strength), ("size_px", self.size_px)]
    }

    fn measure(&self) -> (&'static str, &'static str) {
        ("deviation of the middle tones", "of 1")
    }

    fn error_if_skipped(&self, _: &FrameFacts<'_>, budget: &Budget) -> Result<Loss, RenderError> {
        Ok(Loss::of_one_sample(self.strength, budget.color))
    }

    fn apply(&self, moment: &Moment<'_>, _: u32, next: Next<'_>) -> Result<Picture, RenderError> {
        let mut picture = next(moment)?;
        let frame = picture.display();
        let key = mixed(moment.take.seed, moment.frame_idx as u64);
        let kernel = kernel(self.size_px * f64::from(frame.height) / HEIGHT_PX);
        let pattern: Vec<Vec<f32>> = (0..4).map(|channel| noise(mixed(key, channel), frame, &kernel)).collect();
        let strength = self.strength as f32;
        let (common, own) = (COMMON.sqrt() * strength, (1.0 - COMMON).sqrt() * strength);
        frame.rgb.par_chunks_mut(3 * 4096).enumerate().for_each(|(job, values)| {
            for (pixel, rgb) in (job * 4096..).zip(values.chunks_exact_mut(3)) {
                for (channel, value) in rgb.iter_mut().enumerate() {
                    let grain = common * pattern[3][pixel] + own * pattern[channel][pixel];
                    let tone = value.clamp(0.0, 1.0);
                    // 1 in the middle tones, 0 at both ends, as the granularity of a print.
                    *value = tone + grain * 2.0 * (tone * (1.0 - tone)).sqrt();
                }
            }
        });
        Ok(picture)
    }
}

/// Weights of a Gaussian of this standard deviation in pixels, of unit power, from its middle outward.
fn kernel(deviation_px: f64) -> Vec<f32> {
    let reach = (3.0 * deviation_px).ceil() as usize;
    let weight = |at: usize| if at == 0 { 1.0 } else { (-0.5 * (at as f64 / deviation_px).powi(2)).exp() };
    let weights: Vec<f64> = (0..=reach).map(weight).collect();
    let power: f64 = weights.iter().enumerate().map(|(at, w)| w * w * if at == 0 { 1.0 } else { 2.0 }).sum();
    weights.into_iter().map(|weight| (weight / power.sqrt()) as f32).collect()
}

/// Gaussian noise of variance 1 per pixel, smoothed by a kernel in both directions.
fn noise(key: u64, frame: &Frame, kernel: &[f32]) -> Vec<f32> {
    let (width, height) = (frame.width as usize, frame.height as usize);
    let reach = kernel.len() - 1;
    // One margin of the kernel on every side: the noise goes on beyond the picture.
    let across = width + 2 * reach;
    let mut smooth = vec![0.0; width * (height + 2 * reach)];
    smooth.par_chunks_mut(width).enumerate().for_each_init(
        || vec![0.0; across],
        |raw, (row, to)| {
            let first = (row * across) as u64;
            raw.iter_mut().zip(first..).for_each(|(value, counter)| *value = normal(key, counter));
            for (column, value) in to.iter_mut().enumerate() {
                *value =
                    smoothed(kernel, |at| raw[column + reach - at] + raw[column + reach + at], raw[column + reach]);
            }
        },
    );
    let mut out = vec![0.0; width * height];
    out.par_chunks_mut(width).enumerate().for_each(|(row, to)| {
        for (column, value) in to.iter_mut().enumerate() {
            let at_row = |row: usize| smooth[row * width + column];
            *value = smoothed(kernel, |at| at_row(row + reach - at) + at_row(row + reach + at), at_row(row + reach));
        }
    });
    out
}

fn smoothed(kernel: &[f32], pair: impl Fn(usize) -> f32, middle: f32) -> f32 {
    let sides: f32 = kernel.iter().enumerate().skip(1).map(|(at, weight)| weight * pair(at)).sum();
    kernel[0] * middle + sides
}

/// A number of mean 0 and variance 1, nearly normal: the sum of four uniform ones.
fn normal(key: u64, counter: u64) -> f32 {
    let bits = mixed(key, counter);
    let sum: u32 = (0..4).map(|part| (bits >> (16 * part)) as u32 & 0xffff).sum();
    // Four uniform numbers of 0..1 have the variance 1/3.
    (sum as f32 / 65535.0 - 2.0) * 3.0_f32.sqrt()
}

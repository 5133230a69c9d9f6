//! Pictures on their way through effects.

use cinesplat_render::{Frame, Rgb8Frame, srgb};
use rayon::prelude::*;

/// Values per job of the threads.
const VALUES_PER_JOB: usize = 1 << 14;

/// What the numbers of a picture are proportional to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Light {
    /// The signal of a display: the colors as the scene was trained.
    Display,
    /// Light, by the curve of sRGB: what lenses and shutters average.
    Linear,
}

/// A picture and the meaning of its numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct Picture {
    frame: Frame,
    light: Light,
    /// Amplitude of the dither on conversion to 8 bits, levels; 0 = none.
    dither: Option<u64>,
}

impl Picture {
    /// A picture as the renderer makes it.
    pub fn of_display(frame: Frame) -> Self {
        Self { frame, light: Light::Display, dither: None }
    }

    /// The picture as signals of a display, to be changed.
    pub fn display(&mut self) -> &mut Frame {
        if self.light == Light::Linear {
            each_value(&mut self.frame.rgb, srgb::to_signal);
            self.light = Light::Display;
        }
        &mut self.frame
    }

    /// The picture as light, to be changed.
    pub fn linear(&mut self) -> &mut Frame {
        if self.light == Light::Display {
            each_value(&mut self.frame.rgb, srgb::to_light);
            self.light = Light::Linear;
        }
        &mut self.frame
    }

    /// Its size and numbers, whatever they mean.
    pub fn frame(&self) -> &Frame {
        &self.frame
    }

    /// Makes the picture opaque: what is behind the scene is part of it.
    pub(super) fn cover(&mut self) {
        self.frame.transmittance.fill(0.0);
    }

    /// Asks for dither on conversion to 8 bits: an effect with smooth gradients would show bands without it. `key` keeps
    /// the dither of two frames apart.
    pub fn ask_for_dither(&mut self, key: u64) {
        self.dither = Some(key);
    }

    /// The picture in 8 bits with opacity, `[pixel * 4 + channel]`, otherwise as [`Picture::to_rgba`].
    pub fn to_rgba8(&self) -> Vec<u8> {
        let level = |value: f32| (value.clamp(0.0, 1.0) * 255.0 + 0.5) as u8;
        self.to_rgba().into_iter().flat_map(|rgba| rgba.map(level)).collect()
    }

    /// Colors and opacity per pixel: colors as if each pixel were covered wholly. Where nothing is, black.
    pub fn to_rgba(&self) -> Vec<[f32; 4]> {
        let mut copy = self.clone();
        let frame = copy.display();
        let pixels = frame.rgb.chunks_exact(3).zip(&frame.transmittance);
        let of = |(rgb, rest): (&[f32], &f32)| {
            let alpha = 1.0 - rest;
            // Below half a level of opacity the color is noise.
            let scale = if alpha > 0.5 / 255.0 { 1.0 / alpha } else { 0.0 };
            [rgb[0] * scale, rgb[1] * scale, rgb[2] * scale, alpha]
        };
        pixels.map(of).collect()
    }

    /// The picture as light: red, green, blue and opacity per pixel. If it is transparent, the colors are those of wholly
    /// covered pixels, as light, times the opacity.
    pub fn to_light(&self, is_transparent: bool) -> [Vec<f32>; 4] {
        let mut copy = self.clone();
        let alpha: Vec<f32> = self.frame.transmittance.iter().map(|rest| 1.0 - rest).collect();
        if is_transparent {
            let frame = copy.display();
            for (rgb, alpha) in frame.rgb.chunks_exact_mut(3).zip(&alpha) {
                let scale = if *alpha > 0.0 { 1.0 / alpha } else { 0.0 };
                rgb.iter_mut().for_each(|value| *value = srgb::to_light(*value * scale) * alpha);
            }
        }
        let rgb = if is_transparent { &copy.frame.rgb } else { &copy.linear().rgb };
        let channel = |first: usize| rgb.iter().skip(first).step_by(3).copied().collect();
        [channel(0), channel(1), channel(2), alpha]
    }

    /// The picture in 8 bits.
    pub fn into_rgb8(mut self, into: &mut Rgb8Frame) {
        let dither = self.dither;
        let frame = self.display();
        (into.width, into.height, into.stats) = (frame.width, frame.height, frame.stats);
        into.rgb8.resize(frame.rgb.len(), 0);
        let jobs = into.rgb8.par_chunks_mut(VALUES_PER_JOB).zip(frame.rgb.par_chunks(VALUES_PER_JOB)).enumerate();
        jobs.for_each(|(job, (levels, values))| {
            for (idx, (to, &value)) in levels.iter_mut().zip(values).enumerate() {
                let exact = value.clamp(0.0, 1.0) * 255.0;
                // Toward black and white the noise ends, without a bias: both stay as they are.
                let room = exact.min(255.0 - exact).min(1.0);
                let noise = dither.map_or(0.0, |key| room * triangle(key, (job * VALUES_PER_JOB + idx) as u64));
                *to = (exact + noise + 0.5) as u8;
            }
        });
    }
}

/// Changes every value on all threads; the order does not matter, so the bits do not depend on the threads.
pub(super) fn each_value(values: &mut [f32], change: impl Fn(f32) -> f32 + Sync) {
    values
        .par_chunks_mut(VALUES_PER_JOB)
        .for_each(|values| values.iter_mut().for_each(|value| *value = change(*value)));
}

/// 64 well-mixed bits of a counter under a key (the finalizer of `SplitMix64`).
pub(super) fn mixed(key: u64, counter: u64) -> u64 {
    let mut z = key.wrapping_add(counter.wrapping_mul(0x9e37_79b9_7f4a_7c15)).wrapping_add(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// Triangular noise in -1..1 levels: the error of rounding then does not depend on the signal.
fn triangle(key: u64, counter: u64) -> f32 {
    let bits = mixed(key, counter);
    let part = |shift: u32| ((bits >> shift) & 0x00ff_ffff) as f32 / (1_u64 << 24) as f32;
    part(0) + part(32) - 1.0
}

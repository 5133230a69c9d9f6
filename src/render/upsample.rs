use std::ops::{Add, Mul, Sub};

use glam::Vec4;
use pulp::{Simd, WithSimd};
use rayon::prelude::*;

use super::canvas::Canvas;
use super::frame::level;
use super::{Frame, InstructionSet};

/// Source pixels per target pixel along one axis.
const NUM_TAPS: usize = 4;
/// Copies of a border pixel on either side, for the taps of the first and last pixels.
const PADDING: usize = 2;

/// Enlarges a picture onto a canvas by cubic convolution between pixel centers (Keys, Cubic Convolution Interpolation
/// for Digital Image Processing, 1981, a = -1/2) with repeated borders. Clamps overshoot: color to 0 or more,
/// transmittance to 0..=1. On pictures of splats the PSNR is one or two decibels above that of bilinear interpolation,
/// at little cost.
pub(super) fn upsample(from: &Frame, canvas: Canvas<'_>, [width, height]: [u32; 2], instructions: InstructionSet) {
    let (columns, rows) = (taps(from.width, width), taps(from.height, height));
    let rows_and_targets = rows.par_iter().zip(canvas.into_parts(width as usize));
    rows_and_targets.for_each_init(
        || MixedRow::of_width(from.width as usize),
        |mixed, (row, target)| {
            instructions.dispatch(EnlargedRow { from, row, columns: &columns, mixed, target });
        },
    );
}

/// Computes one row of the large picture; compiled for every instruction set.
struct EnlargedRow<'a> {
    from: &'a Frame,
    row: &'a Taps,
    columns: &'a [Taps],
    mixed: &'a mut MixedRow,
    /// The row to write.
    target: Canvas<'a>,
}

/// One row of the small picture, interpolated vertically.
struct MixedRow {
    /// `[column * 3 + channel]`.
    rgb: Vec<f32>,
    transmittance: Vec<f32>,
    /// Color and transmittance, with padding.
    pixels: Vec<Vec4>,
}

impl WithSimd for EnlargedRow<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { from, row, columns, mixed, target } = self;
        mixed.fill(from, row);
        let pixels = columns.iter().map(|column| column.mix(&mixed.pixels[column.first..][..NUM_TAPS]));
        match target {
            Canvas::Linear { rgb, transmittance } => {
                for ((pixel, rgb), rest) in pixels.zip(rgb.as_chunks_mut::<3>().0).zip(transmittance) {
                    let [r, g, b, t] = pixel.max(Vec4::ZERO).to_array();
                    *rgb = [r, g, b];
                    *rest = t.min(1.0);
                }
            }
            Canvas::Rgb8(rgb8) => {
                for (pixel, rgb) in pixels.zip(rgb8.as_chunks_mut::<3>().0) {
                    let [r, g, b, _] = pixel.to_array().map(level);
                    *rgb = [r, g, b];
                }
            }
            Canvas::Light(mut sums) => {
                for (place, pixel) in pixels.enumerate() {
                    let [r, g, b, t] = pixel.max(Vec4::ZERO).to_array();
                    sums.add(place, &[r, g, b], &[t.min(1.0)]);
                }
            }
        }
    }
}

impl MixedRow {
    fn of_width(width: usize) -> Self {
        let (rgb, transmittance) = (vec![0.0; width * 3], vec![0.0; width]);
        Self { rgb, transmittance, pixels: vec![Vec4::ZERO; width + 2 * PADDING] }
    }

    /// Interpolates rows of the small picture and repeats the first and last pixel into the padding.
    #[inline(always)]
    fn fill(&mut self, from: &Frame, row: &Taps) {
        row.mix_rows(&from.rgb, &mut self.rgb, from.height);
        row.mix_rows(&from.transmittance, &mut self.transmittance, from.height);
        let colors = self.rgb.as_chunks::<3>().0.iter().zip(&self.transmittance);
        for (pixel, (&[r, g, b], &rest)) in self.pixels[PADDING..].iter_mut().zip(colors) {
            *pixel = Vec4::new(r, g, b, rest);
        }
        let end = self.pixels.len() - PADDING;
        let (first, last) = (self.pixels[PADDING], self.pixels[end - 1]);
        self.pixels[..PADDING].fill(first);
        self.pixels[end..].fill(last);
    }
}

/// The four source pixels of a target pixel along one axis, and their weights.
#[derive(Debug, Clone, Copy)]
struct Taps {
    /// Index of the first source pixel, including [`PADDING`].
    first: usize,
    weights: [f32; NUM_TAPS],
}

impl Taps {
    /// Interpolates four neighbors.
    #[inline(always)]
    fn mix(&self, neighbors: &[Vec4]) -> Vec4 {
        neighbors.first_chunk().map_or(Vec4::ZERO, |neighbors| weighted(*neighbors, self.weights))
    }

    /// Interpolates four rows of a picture, value by value.
    #[inline(always)]
    fn mix_rows(&self, picture: &[f32], mixed: &mut [f32], height: u32) {
        let (last_row, len) = ((height as usize).saturating_sub(1), mixed.len());
        let row = |tap: usize| {
            let place = (self.first + tap).saturating_sub(PADDING).min(last_row);
            picture[place * len..][..len].iter()
        };
        let rows = row(0).zip(row(1)).zip(row(2)).zip(row(3));
        for (mixed, (((before, base), after), last)) in mixed.iter_mut().zip(rows) {
            *mixed = weighted([*before, *base, *after, *last], self.weights);
        }
    }
}

/// Weighted sum of four neighbors, computed as the second one plus weighted differences from it, so that a constant
/// picture keeps its bits.
#[inline(always)]
fn weighted<T>([before, base, after, last]: [T; NUM_TAPS], [w0, _, w2, w3]: [f32; NUM_TAPS]) -> T
where
    T: Copy + Add<Output = T> + Sub<Output = T> + Mul<f32, Output = T>,
{
    base + (before - base) * w0 + (after - base) * w2 + (last - base) * w3
}

fn taps(from: u32, to: u32) -> Vec<Taps> {
    let scale = f64::from(from) / f64::from(to);
    let at = |position: u32| {
        let center = (f64::from(position) + 0.5) * scale - 0.5;
        let before = center.floor();
        let weight = |tap: f64| kernel(center - before - (tap - 1.0)) as f32;
        // `before` is -1 or more, because pictures are only enlarged.
        let first = (before as i64 - 1 + PADDING as i64).max(0) as usize;
        Taps { first, weights: [0.0, 1.0, 2.0, 3.0].map(weight) }
    };
    (0..to).map(at).collect()
}

/// Keys' kernel with a = -1/2; its values at positions one apart sum to 1.
fn kernel(distance: f64) -> f64 {
    let x = distance.abs();
    if x < 1.0 {
        (1.5 * x - 2.5) * x * x + 1.0
    } else if x < 2.0 {
        ((-0.5 * x + 2.5) * x - 4.0) * x + 2.0
    } else {
        0.0
    }
}

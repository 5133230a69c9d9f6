//! Wide blurs of small copies of a picture, for glows.

use cinesplat_render::Frame;
use rayon::prelude::*;

/// Pixels of the picture per side of a pixel of the copy.
const FACTOR: usize = 4;
/// Passes of a box that make a bell curve.
const PASSES: usize = 3;

/// A copy of a picture at a quarter of its size.
#[derive(Debug, Clone)]
pub(super) struct Small {
    width: usize,
    height: usize,
    rgb: Vec<[f32; 3]>,
}

impl Small {
    /// The means of `part` of the values of a picture.
    pub(super) fn of(frame: &Frame, part: impl Fn(f32) -> f32 + Sync) -> Self {
        let (across, down) = (frame.width as usize, frame.height as usize);
        let (width, height) = (across.div_ceil(FACTOR), down.div_ceil(FACTOR));
        let mut rgb = vec![[0.0; 3]; width * height];
        rgb.par_chunks_mut(width).enumerate().for_each(|(row, to)| {
            let rows = row * FACTOR..((row + 1) * FACTOR).min(down);
            for (column, to) in to.iter_mut().enumerate() {
                let columns = column * FACTOR..((column + 1) * FACTOR).min(across);
                let num = (rows.len() * columns.len()) as f32;
                for (y, x) in rows.clone().flat_map(|y| columns.clone().map(move |x| (y, x))) {
                    let rgb = &frame.rgb[(y * across + x) * 3..][..3];
                    to.iter_mut().zip(rgb).for_each(|(sum, &value)| *sum += part(value) / num);
                }
            }
        });
        Self { width, height, rgb }
    }

    /// The copy blurred by a bell curve of these standard deviations, across and down, pixels of the picture. Beyond the
    /// borders it is dark.
    pub(super) fn blurred(&self, deviation_px: [f64; 2]) -> Self {
        let [across, down] = deviation_px.map(|deviation| radius(deviation / FACTOR as f64));
        let mut out = self.clone();
        for _ in 0..PASSES {
            out.rgb.par_chunks_mut(self.width).for_each(|row| box_filter(row, across));
        }
        let mut columns = vec![[0.0; 3]; out.rgb.len()];
        let turned = |from: &[[f32; 3]], to: &mut [[f32; 3]], (width, height): (usize, usize)| {
            to.par_chunks_mut(height).enumerate().for_each(|(column, to)| {
                to.iter_mut().enumerate().for_each(|(row, value)| *value = from[row * width + column]);
            });
        };
        turned(&out.rgb, &mut columns, (self.width, self.height));
        for _ in 0..PASSES {
            columns.par_chunks_mut(self.height).for_each(|column| box_filter(column, down));
        }
        turned(&columns, &mut out.rgb, (self.height, self.width));
        out
    }

    /// The copy scaled about its middle; a scale below 0 turns it upside down. The light per pixel stays that of the
    /// source, and fades toward the border, where a reflection leaves the lens. Beyond the borders it is dark.
    pub(super) fn about_the_middle(&self, scale: f64) -> Self {
        let (width, height) = (self.width, self.height);
        let middle = [width, height].map(|len| len as f64 / 2.0);
        let mut out = self.clone();
        out.rgb.par_chunks_mut(width).enumerate().for_each(|(row, to)| {
            for (column, to) in to.iter_mut().enumerate() {
                let off = [column as f64 + 0.5 - middle[0], row as f64 + 0.5 - middle[1]];
                let from = [middle[0] + off[0] / scale, middle[1] + off[1] / scale];
                let is_inside = from[0] >= 0.0 && from[0] < width as f64 && from[1] >= 0.0 && from[1] < height as f64;
                let out_frac = (off[0] / middle[0]).powi(2).max((off[1] / middle[1]).powi(2));
                let fade = (1.0 - out_frac).max(0.0) as f32;
                let source = if is_inside { self.rgb[from[1] as usize * width + from[0] as usize] } else { [0.0; 3] };
                *to = source.map(|light| light * fade);
            }
        });
        out
    }

    /// The copy with its channels multiplied.
    pub(super) fn tinted(mut self, tint: [f32; 3]) -> Self {
        self.rgb.iter_mut().for_each(|rgb| (0..3).for_each(|channel| rgb[channel] *= tint[channel]));
        self
    }

    /// Adds the copy to a picture, enlarged without steps.
    pub(super) fn add_to(&self, frame: &mut Frame, share: f32) {
        let width = frame.width as usize;
        frame.rgb.par_chunks_mut(3 * width).enumerate().for_each(|(row, values)| {
            let (top, down) = place(row, self.height);
            for (column, rgb) in values.chunks_exact_mut(3).enumerate() {
                let (left, right) = place(column, self.width);
                let at = |y: usize, x: usize| self.rgb[y.min(self.height - 1) * self.width + x.min(self.width - 1)];
                let corners = [at(top, left), at(top, left + 1), at(top + 1, left), at(top + 1, left + 1)];
                for (channel, value) in rgb.iter_mut().enumerate() {
                    let [a, b, c, d] = corners.map(|corner| corner[channel]);
                    let (upper, lower) = (a + (b - a) * right, c + (d - c) * right);
                    *value += share * (upper + (lower - upper) * down);
                }
            }
        });
    }
}

/// The pixel of the copy before a pixel of the picture, and the part of the way to the next one.
fn place(pixel: usize, len: usize) -> (usize, f32) {
    let at = ((pixel as f32 + 0.5) / FACTOR as f32 - 0.5).max(0.0);
    ((at as usize).min(len - 1), at.fract())
}

/// Radius of a box that gives this standard deviation after all passes.
fn radius(deviation: f64) -> usize {
    (((12.0 * deviation * deviation / PASSES as f64 + 1.0).sqrt() - 1.0) / 2.0).round().max(0.0) as usize
}

/// Mean over `2 radius + 1` values; beyond the ends there is 0.
fn box_filter(line: &mut [[f32; 3]], radius: usize) {
    if radius == 0 {
        return;
    }
    let scale = 1.0 / (2 * radius + 1) as f32;
    let source = line.to_vec();
    let at = |idx: usize| source.get(idx).copied().unwrap_or_default();
    // Sums in `f64`: the rounding of a running sum would depend on the way there.
    let mut sum = [0.0_f64; 3];
    for idx in 0..radius {
        (0..3).for_each(|channel| sum[channel] += f64::from(at(idx)[channel]));
    }
    for (idx, to) in line.iter_mut().enumerate() {
        for channel in 0..3 {
            sum[channel] += f64::from(at(idx + radius)[channel]);
            if idx > radius {
                sum[channel] -= f64::from(at(idx - radius - 1)[channel]);
            }
            to[channel] = sum[channel] as f32 * scale;
        }
    }
}

//! Target of a picture: `f32` color and transmittance, 8-bit color only, for films, or a sum of light, for exposures.

use std::sync::{Mutex, PoisonError};

use pulp::{Simd, WithSimd};

use super::light::light;
use super::pixels::TilePixels;
use super::tiles::TILE_PX;
use super::{Frame, Rgb8Frame};

/// Rows of a picture to write.
#[derive(Debug)]
pub(super) enum Canvas<'a> {
    /// Color and transmittance.
    Linear { rgb: &'a mut [f32], transmittance: &'a mut [f32] },
    /// Color in 8 bits.
    Rgb8(&'a mut [u8]),
    /// Sums over pictures.
    Light(LightSums<'a>),
}

/// Sums over the pictures of an exposure, each times its weight.
#[derive(Debug)]
pub(super) struct LightSums<'a> {
    /// Light of the colors.
    pub(super) light: &'a mut [f32],
    /// Transmittance.
    pub(super) transmittance: &'a mut [f32],
    /// Weight of this picture.
    pub(super) weight: f32,
    /// Whether this is the first picture, which overwrites the sums.
    pub(super) is_first: bool,
}

impl LightSums<'_> {
    /// Adds colors and transmittances, from position `first` (in pixels) on.
    #[inline(always)]
    pub(super) fn add(&mut self, first: usize, rgb: &[f32], rest: &[f32]) {
        let weight = self.weight;
        let sums = self.light[first * 3..].iter_mut().zip(rgb);
        let rests = self.transmittance[first..].iter_mut().zip(rest);
        if self.is_first {
            // Not multiplied by 0: the old values may be NaN.
            sums.for_each(|(sum, &value)| *sum = weight * light(value));
            rests.for_each(|(sum, &value)| *sum = weight * value);
        } else {
            sums.for_each(|(sum, &value)| *sum += weight * light(value));
            rests.for_each(|(sum, &value)| *sum += weight * value);
        }
    }
}

impl<'a> From<&'a mut Frame> for Canvas<'a> {
    fn from(frame: &'a mut Frame) -> Self {
        Self::Linear { rgb: &mut frame.rgb, transmittance: &mut frame.transmittance }
    }
}

impl<'a> From<&'a mut Rgb8Frame> for Canvas<'a> {
    fn from(frame: &'a mut Rgb8Frame) -> Self {
        Self::Rgb8(&mut frame.rgb8)
    }
}

/// The rows of a picture that one row of tiles writes to.
pub(super) type Band<'a> = Mutex<Canvas<'a>>;

impl<'a> Canvas<'a> {
    /// The picture as bands of one row of tiles each.
    pub(super) fn into_bands(self, width: usize) -> Vec<Band<'a>> {
        self.into_parts(width * TILE_PX).into_iter().map(Mutex::new).collect()
    }

    /// The picture in parts of `num_pixels` each; the last part may be shorter.
    pub(super) fn into_parts(self, num_pixels: usize) -> Vec<Self> {
        match self {
            Self::Linear { rgb, transmittance } => {
                let parts = rgb.chunks_mut(3 * num_pixels).zip(transmittance.chunks_mut(num_pixels));
                parts.map(|(rgb, transmittance)| Self::Linear { rgb, transmittance }).collect()
            }
            Self::Rgb8(rgb8) => rgb8.chunks_mut(3 * num_pixels).map(Self::Rgb8).collect(),
            Self::Light(LightSums { light, transmittance, weight, is_first }) => {
                let parts = light.chunks_mut(3 * num_pixels).zip(transmittance.chunks_mut(num_pixels));
                let sums = |(light, transmittance)| LightSums { light, transmittance, weight, is_first };
                parts.map(|part| Self::Light(sums(part))).collect()
            }
        }
    }
}

/// Copies a finished tile into the picture; compiled for every instruction set.
pub(super) struct FinishedTile<'a, 'frame> {
    pub(super) pixels: &'a TilePixels,
    pub(super) band: &'a Band<'frame>,
    /// Column of the tile in the band.
    pub(super) column: usize,
    /// Width of the picture.
    pub(super) width: usize,
    /// Background color, weighted with the transmittance.
    pub(super) background: [f32; 3],
    /// Weight in a sum of light, and whether it is the first of the tile; `None` = those of the canvas.
    pub(super) share: Option<(f32, bool)>,
}

impl WithSimd for FinishedTile<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { pixels, band, column, width, background, share } = self;
        let (left, right) = (column * TILE_PX, ((column + 1) * TILE_PX).min(width));
        match &mut *band.lock().unwrap_or_else(PoisonError::into_inner) {
            Canvas::Linear { rgb, transmittance } => {
                let rows = rgb.chunks_mut(width * 3).zip(transmittance.chunks_mut(width)).enumerate();
                for (row, (rgb, transmittance)) in rows {
                    let (rgb, transmittance) = (&mut rgb[left * 3..right * 3], &mut transmittance[left..right]);
                    pixels.row(row, background).write_linear(rgb, transmittance);
                }
            }
            Canvas::Rgb8(rgb8) => {
                for (row, rgb8) in rgb8.chunks_mut(width * 3).enumerate() {
                    pixels.row(row, background).write_rgb8(&mut rgb8[left * 3..right * 3]);
                }
            }
            Canvas::Light(sums) => {
                (sums.weight, sums.is_first) = share.unwrap_or((sums.weight, sums.is_first));
                let (mut rgb, mut rest) = ([0.0; 3 * TILE_PX], [0.0; TILE_PX]);
                let (rgb, rest) = (&mut rgb[..(right - left) * 3], &mut rest[..right - left]);
                for row in 0..sums.transmittance.len() / width {
                    pixels.row(row, background).write_linear(rgb, rest);
                    sums.add(row * width + left, rgb, rest);
                }
            }
        }
    }
}

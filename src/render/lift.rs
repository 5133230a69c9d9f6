use super::memory::SharedBudget;
use super::payload::{Payload, Sink, TileArea};
use super::record::Record;
use super::tiles::TILE_LEN;

/// Pixel values summed per Gaussian, over one or several pictures.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct LiftedValues {
    /// Sum over all pixels of the Gaussian's blending weight times the pixel's value: `[gaussian * num_channels +
    /// channel]`.
    pub sums: Vec<f64>,
    /// Sum over all pixels of the Gaussian's blending weight: `[gaussian]`.
    pub weights: Vec<f64>,
    /// Values per pixel.
    pub num_channels: usize,
}

impl LiftedValues {
    /// Sums of zero for a number of Gaussians and channels.
    pub fn new(num_gaussians: usize, num_channels: usize) -> Self {
        Self { sums: vec![0.0; num_gaussians * num_channels], weights: vec![0.0; num_gaussians], num_channels }
    }

    /// Weighted mean of the pixel values of a Gaussian in one channel; `None` if it was visible in no pixel.
    pub fn mean(&self, gaussian_idx: usize, channel: usize) -> Option<f64> {
        let weight = self.weights[gaussian_idx];
        (weight > 0.0).then(|| self.sums[gaussian_idx * self.num_channels + channel] / weight)
    }

    /// Adds the sums of the tiles in order, so that the result does not depend on the number of threads.
    pub(super) fn add(&mut self, tiles: Vec<LiftTile>) {
        let num_channels = self.num_channels;
        for tile in tiles {
            for (entry, &gaussian_idx) in tile.gaussians.iter().enumerate() {
                let idx = gaussian_idx as usize;
                let [sums @ .., weight] = &tile.sums[entry * (num_channels + 1)..][..=num_channels] else { continue };
                self.weights[idx] += f64::from(*weight);
                for (total, sum) in self.sums[idx * num_channels..].iter_mut().zip(sums) {
                    *total += f64::from(*sum);
                }
            }
        }
    }
}

/// The payload of [`LiftedValues`].
pub(super) struct LiftPayload<'a> {
    /// `num_channels` values per pixel, row-major.
    pub(super) values: &'a [f32],
    pub(super) num_channels: usize,
    /// Memory for the rows of all tiles.
    pub(super) budget: SharedBudget,
}

/// Sums of one tile: one row per splat, with the sum of the weights as its last column.
#[derive(Default)]
pub(super) struct LiftTile {
    gaussians: Vec<u32>,
    sums: Vec<f32>,
}

/// Running sums of one tile.
pub(super) struct LiftSink<'a> {
    budget: &'a SharedBudget,
    is_full: bool,
    /// Values of the tile's pixels, and 1 as the last of each pixel: `[pixel * (num_channels + 1) + channel]`.
    values: Vec<f32>,
    stride: usize,
    tile: LiftTile,
    /// Row of the first splat of the current chunk.
    first: usize,
}

impl<'a> Payload for &'a LiftPayload<'_> {
    type Sink = LiftSink<'a>;
    type TileOutput = LiftTile;

    fn set_limit(&self, max_bytes: u64) {
        // Half, because vectors grow by doubling.
        self.budget.set_limit(max_bytes / 2);
    }

    fn sink(&self, area: TileArea) -> LiftSink<'a> {
        let stride = self.num_channels + 1;
        let mut values = vec![0.0; TILE_LEN * stride];
        for (pixel, row) in values.chunks_exact_mut(stride).enumerate() {
            if let Some(idx) = area.picture_idx(pixel) {
                row[..self.num_channels].copy_from_slice(&self.values[idx * self.num_channels..][..self.num_channels]);
                row[self.num_channels] = 1.0;
            }
        }
        let budget = &self.budget;
        LiftSink { budget, is_full: false, values, stride, tile: LiftTile::default(), first: 0 }
    }

    fn finish(&self, sink: LiftSink<'a>, _: TileArea) -> LiftTile {
        sink.tile
    }
}

impl Sink for LiftSink<'_> {
    const IS_ACTIVE: bool = true;

    fn begin_chunk(&mut self, records: &[Record]) {
        let row_bytes = size_of::<u32>() + self.stride * size_of::<f32>();
        self.is_full |= !self.budget.take((records.len() * row_bytes) as u64);
        if self.is_full {
            return;
        }
        self.first = self.tile.gaussians.len();
        self.tile.gaussians.extend(records.iter().map(|record| record.gaussian_idx));
        self.tile.sums.resize(self.tile.gaussians.len() * self.stride, 0.0);
    }

    #[inline(always)]
    fn add(&mut self, position: usize, first_pixel: usize, weights: &[f32]) {
        if self.is_full {
            return;
        }
        let sums = &mut self.tile.sums[(self.first + position) * self.stride..][..self.stride];
        let values = self.values[first_pixel * self.stride..].chunks_exact(self.stride);
        for (values, &weight) in values.zip(weights).filter(|(_, weight)| **weight > 0.0) {
            for (sum, value) in sums.iter_mut().zip(values) {
                *sum += weight * value;
            }
        }
    }
}

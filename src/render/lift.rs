use pulp::Simd;

use super::memory::SharedBudget;
use super::payload::{Payload, Sink, TileArea};
use super::pixels::{BlockValues, HALF_LEN, load, store};
use super::record::Record;
use super::tiles::NUM_BLOCKS;

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
    payload: &'a LiftPayload<'a>,
    is_full: bool,
    /// Values of the tile's pixels, and 1 as the last of each pixel, 0 outside the picture: `[block * stride + channel]`.
    values: Vec<BlockValues>,
    stride: usize,
    /// Sums over the blocks for the splats of the current chunk, one per place in half a block: `[position * stride +
    /// channel]`.
    sums: Vec<[f32; HALF_LEN]>,
    /// Gaussians of the current chunk.
    gaussians: Vec<u32>,
    tile: LiftTile,
}

impl<'a> Payload for &'a LiftPayload<'a> {
    type Sink = LiftSink<'a>;
    type TileOutput = LiftTile;

    fn set_limit(&self, max_bytes: u64) {
        // Half, because vectors grow by doubling.
        self.budget.set_limit(max_bytes / 2);
    }

    fn sink(&self, area: TileArea) -> LiftSink<'a> {
        let stride = self.num_channels + 1;
        let mut values = vec![BlockValues::ZERO; NUM_BLOCKS * stride];
        for (block, values) in values.chunks_exact_mut(stride).enumerate() {
            for (pixel, idx) in area.picture_idxs(block).into_iter().enumerate() {
                let (Some(idx), half, lane) = (idx, pixel / HALF_LEN, pixel % HALF_LEN) else { continue };
                let of_pixel = self.values[idx * self.num_channels..][..self.num_channels].iter().chain(&[1.0]);
                values.iter_mut().zip(of_pixel).for_each(|(to, value)| to.0[half][lane] = *value);
            }
        }
        let (sums, gaussians, tile) = (Vec::new(), Vec::new(), LiftTile::default());
        LiftSink { payload: self, is_full: false, values, stride, sums, gaussians, tile }
    }

    fn finish(&self, sink: LiftSink<'a>, _: TileArea) -> LiftTile {
        sink.tile
    }
}

impl Sink for LiftSink<'_> {
    const TAKES_WEIGHTS: bool = true;

    #[inline(always)]
    fn begin_chunk(&mut self, records: &[Record]) {
        let row_bytes = size_of::<u32>() + self.stride * size_of::<f32>();
        self.is_full |= !self.payload.budget.take((records.len() * row_bytes) as u64);
        self.gaussians.clear();
        self.gaussians.extend(records.iter().map(|record| record.gaussian_idx));
        self.sums.clear();
        self.sums.resize(records.len() * self.stride, [0.0; HALF_LEN]);
    }

    #[inline(always)]
    fn add_block<S: Simd>(&mut self, simd: S, block: usize, list: &[u8], weights: &[BlockValues]) {
        let (values, zero) = (&self.values[block * self.stride..][..self.stride], simd.splat_f32s(0.0));
        for (&position, weights) in list.iter().zip(weights) {
            let sums = &mut self.sums[usize::from(position) * self.stride..][..self.stride];
            for first_lane in (0..HALF_LEN).step_by(S::F32_LANES) {
                let weights = weights.load(simd, first_lane);
                // A value may be NaN: it must not reach splats that are not in the pixel.
                let counts = weights.map(|weight| simd.greater_than_f32s(weight, zero));
                for (sum, values) in sums.iter_mut().zip(values) {
                    let (mut total, values) = (load(simd, sum, first_lane), values.load(simd, first_lane));
                    for half in 0..2 {
                        let more = simd.mul_add_f32s(weights[half], values[half], total);
                        total = simd.select_f32s(counts[half], more, total);
                    }
                    store(simd, sum, first_lane, total);
                }
            }
        }
    }

    #[inline(always)]
    fn end_chunk(&mut self) {
        if !self.is_full {
            self.tile.gaussians.extend_from_slice(&self.gaussians);
            self.tile.sums.extend(self.sums.iter().map(total));
        }
    }
}

/// Sum of all numbers, always in the same order: halves are added, then halves of the result.
#[inline(always)]
fn total(numbers: &[f32; HALF_LEN]) -> f32 {
    let mut sums = *numbers;
    for half in [8, 4, 2, 1] {
        for lane in 0..half {
            sums[lane] += sums[lane + half];
        }
    }
    sums[0]
}

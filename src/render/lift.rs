use super::blend::TILE_LEN;
use super::kernel::Record;
use super::memory::Allowance;
use super::payload::{Payload, Sink, TileArea};

/// What the pixels of a picture say about each Gaussian.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Lifted {
    /// Sum over all pixels of the Gaussian's weight times the pixel's value: `[gaussian * num_channels + channel]`.
    pub sums: Vec<f64>,
    /// Sum over all pixels of the Gaussian's weight: `[gaussian]`.
    pub weights: Vec<f64>,
    /// Values a pixel.
    pub num_channels: usize,
}

impl Lifted {
    /// Nothing seen of this many Gaussians.
    pub fn new(num_gaussians: usize, num_channels: usize) -> Self {
        Self { sums: vec![0.0; num_gaussians * num_channels], weights: vec![0.0; num_gaussians], num_channels }
    }

    /// Mean value of a Gaussian in one channel, each pixel with its weight; `None` where it was not seen.
    pub fn mean(&self, gaussian_idx: usize, channel: usize) -> Option<f64> {
        let weight = self.weights[gaussian_idx];
        (weight > 0.0).then(|| self.sums[gaussian_idx * self.num_channels + channel] / weight)
    }

    /// Adds the sums of the tiles in their order, so that the result does not depend on threads.
    pub(super) fn add(&mut self, parts: Vec<LiftPart>) {
        let num_channels = self.num_channels;
        for part in parts {
            for (entry, &gaussian_idx) in part.gaussians.iter().enumerate() {
                let idx = gaussian_idx as usize;
                let [sums @ .., weight] = &part.sums[entry * (num_channels + 1)..][..=num_channels] else { continue };
                self.weights[idx] += f64::from(*weight);
                for (total, sum) in self.sums[idx * num_channels..].iter_mut().zip(sums) {
                    *total += f64::from(*sum);
                }
            }
        }
    }
}

/// The payload of [`Lifted`].
pub(super) struct LiftPayload<'a> {
    /// `num_channels` values a pixel, row-major.
    pub(super) values: &'a [f32],
    pub(super) num_channels: usize,
    /// Bytes that the rows may take.
    pub(super) allowance: Allowance,
}

/// What one tile says: a row of sums for each splat it looked at, the last of them the weight alone.
#[derive(Default)]
pub(super) struct LiftPart {
    gaussians: Vec<u32>,
    sums: Vec<f32>,
}

/// Sums of one tile.
pub(super) struct LiftSink<'a> {
    allowance: &'a Allowance,
    is_full: bool,
    /// Values of the tile's pixels, the last of each 1: `[pixel * (num_channels + 1) + channel]`.
    values: Vec<f32>,
    stride: usize,
    part: LiftPart,
    /// First row of the present records.
    first: usize,
}

impl<'a> Payload for &'a LiftPayload<'_> {
    type Sink = LiftSink<'a>;
    type Part = LiftPart;

    fn allow(&self, max_bytes: u64) {
        // Lists grow by doubling.
        self.allowance.allow(max_bytes / 2);
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
        let allowance = &self.allowance;
        LiftSink { allowance, is_full: false, values, stride, part: LiftPart::default(), first: 0 }
    }

    fn part(&self, sink: LiftSink<'a>, _: TileArea) -> LiftPart {
        sink.part
    }
}

impl Sink for LiftSink<'_> {
    const IS_ACTIVE: bool = true;

    fn begin(&mut self, records: &[Record]) {
        let row_bytes = size_of::<u32>() + self.stride * size_of::<f32>();
        self.is_full |= !self.allowance.take((records.len() * row_bytes) as u64);
        if self.is_full {
            return;
        }
        self.first = self.part.gaussians.len();
        self.part.gaussians.extend(records.iter().map(|record| record.gaussian_idx));
        self.part.sums.resize(self.part.gaussians.len() * self.stride, 0.0);
    }

    #[inline(always)]
    fn take(&mut self, position: usize, first_pixel: usize, weights: &[f32]) {
        if self.is_full {
            return;
        }
        let sums = &mut self.part.sums[(self.first + position) * self.stride..][..self.stride];
        let values = self.values[first_pixel * self.stride..].chunks_exact(self.stride);
        for (values, &weight) in values.zip(weights).filter(|(_, weight)| **weight > 0.0) {
            for (sum, value) in sums.iter_mut().zip(values) {
                *sum += weight * value;
            }
        }
    }
}

use std::sync::{Mutex, PoisonError};

use bytemuck::Zeroable;
use pulp::Simd;

use super::memory::SharedBudget;
use super::payload::{BLOCK_LEN, Payload, Sink, TileArea};
use super::pixels::{BlockValues, HALF_LEN};
use super::record::{RECORDS_LEN, Record};

/// The weight of one splat in one pixel.
#[derive(Debug, Clone, Copy, PartialEq, Zeroable)]
#[repr(C)]
pub struct PixelWeight {
    /// Index of the pixel: row * width + column.
    pub pixel_idx: u32,
    /// Index of the Gaussian.
    pub gaussian_idx: u32,
    /// Opacity times transmittance, above 0.
    pub weight: f32,
}

/// The payload that counts the weights of each tile. The list of all tiles can then be allocated at once: it is so long
/// that a list that grows would spend most of its time on moves.
#[derive(Default)]
pub(super) struct WeightCounts {
    /// Memory for the list.
    pub(super) budget: SharedBudget,
}

/// Number of weights of one tile.
pub(super) struct CountSink {
    area: TileArea,
    num: usize,
}

impl Payload for WeightCounts {
    type Sink = CountSink;
    type TileOutput = usize;

    fn set_limit(&self, max_bytes: u64) {
        self.budget.set_limit(max_bytes);
    }

    fn sink(&self, area: TileArea) -> CountSink {
        CountSink { area, num: 0 }
    }

    fn finish(&self, sink: CountSink, _: TileArea) -> usize {
        self.budget.take((sink.num * size_of::<PixelWeight>()) as u64);
        sink.num
    }
}

impl Sink for CountSink {
    const TAKES_WEIGHTS: bool = true;

    #[inline(always)]
    fn begin_chunk(&mut self, _: &[Record]) {}

    #[inline(always)]
    fn add_block<S: Simd>(&mut self, simd: S, block: usize, list: &[u8], weights: &[BlockValues]) {
        let (mut counts, zero) = (BlockValues::ZERO, simd.splat_f32s(0.0));
        for first_lane in (0..HALF_LEN).step_by(S::F32_LANES) {
            let mut sums = [zero; 2];
            for weights in &weights[..list.len()] {
                let weights = weights.load(simd, first_lane);
                for half in 0..2 {
                    let one = simd.select_f32s(simd.greater_than_f32s(weights[half], zero), simd.splat_f32s(1.0), zero);
                    sums[half] = simd.add_f32s(sums[half], one);
                }
            }
            counts.store(simd, first_lane, sums);
        }
        let is_inside = self.area.picture_idxs(block).map(|idx| idx.is_some());
        let inside = counts.0.as_flattened().iter().zip(is_inside).filter(|(_, is_inside)| *is_inside);
        self.num += inside.map(|(count, _)| *count as usize).sum::<usize>();
    }
}

/// The payload that lists every weight.
pub(super) struct WeightPayload<'a> {
    /// The parts of the list that the tiles fill.
    parts: Vec<Mutex<&'a mut [PixelWeight]>>,
}

/// The part of the list of one tile.
pub(super) struct WeightSink<'a> {
    area: TileArea,
    /// Gaussian of each record.
    gaussians: [u32; RECORDS_LEN],
    part: &'a mut [PixelWeight],
    /// Number of weights so far.
    num: usize,
}

impl<'a> WeightPayload<'a> {
    /// The payload that fills a list with as many weights as each tile has.
    pub(super) fn new(mut list: &'a mut [PixelWeight], nums: &[usize]) -> Self {
        let part = |num: &usize| Mutex::new(list.split_off_mut(..*num).unwrap_or_default());
        Self { parts: nums.iter().map(part).collect() }
    }
}

impl<'a> Payload for WeightPayload<'a> {
    type Sink = WeightSink<'a>;
    type TileOutput = ();

    fn sink(&self, area: TileArea) -> WeightSink<'a> {
        let part = std::mem::take(&mut *self.parts[area.tile_idx()].lock().unwrap_or_else(PoisonError::into_inner));
        WeightSink { area, gaussians: [0; RECORDS_LEN], part, num: 0 }
    }

    fn finish(&self, _: WeightSink<'a>, _: TileArea) {}
}

impl Sink for WeightSink<'_> {
    const TAKES_WEIGHTS: bool = true;

    #[inline(always)]
    fn begin_chunk(&mut self, records: &[Record]) {
        self.gaussians.iter_mut().zip(records).for_each(|(gaussian, record)| *gaussian = record.gaussian_idx);
    }

    #[inline(always)]
    fn add_block<S: Simd>(&mut self, _: S, block: usize, list: &[u8], weights: &[BlockValues]) {
        let idxs = self.area.picture_idxs(block);
        let (pixel_idxs, is_inside) = (idxs.map(|idx| idx.unwrap_or(0) as u32), idxs.map(|idx| idx.is_some()));
        for (&position, weights) in list.iter().zip(weights) {
            let gaussian_idx = self.gaussians[usize::from(position)];
            for lane in 0..BLOCK_LEN {
                // Written even if it is 0: then the next weight overwrites it. A branch would be unpredictable.
                let weight = weights.0.as_flattened()[lane];
                if let Some(to) = self.part.get_mut(self.num) {
                    *to = PixelWeight { pixel_idx: pixel_idxs[lane], gaussian_idx, weight };
                }
                self.num += usize::from(weight > 0.0) & usize::from(is_inside[lane]);
            }
        }
    }
}

use super::memory::SharedBudget;
use super::payload::{Payload, Sink, TileArea};
use super::record::Record;

/// The weight of one splat in one pixel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PixelWeight {
    /// Index of the pixel: row * width + column.
    pub pixel_idx: u32,
    /// Index of the Gaussian.
    pub gaussian_idx: u32,
    /// Opacity times transmittance, above 0.
    pub weight: f32,
}

/// The payload that lists every weight.
#[derive(Default)]
pub(super) struct WeightPayload {
    /// Memory for the lists of all tiles.
    pub(super) budget: SharedBudget,
}

/// Entries that a tile reserves at a time.
const RESERVE_LEN: usize = 1024;

/// The weights of one tile.
pub(super) struct WeightSink<'a> {
    budget: &'a SharedBudget,
    /// Entries that are reserved and not used yet.
    num_reserved: usize,
    area: TileArea,
    gaussians: Vec<u32>,
    list: Vec<PixelWeight>,
}

impl<'a> Payload for &'a WeightPayload {
    type Sink = WeightSink<'a>;
    type TileOutput = Vec<PixelWeight>;

    fn set_limit(&self, max_bytes: u64) {
        // A third, because vectors grow by doubling and are concatenated in the end.
        self.budget.set_limit(max_bytes / 3);
    }

    fn sink(&self, area: TileArea) -> WeightSink<'a> {
        WeightSink { budget: &self.budget, num_reserved: 0, area, gaussians: Vec::new(), list: Vec::new() }
    }

    fn finish(&self, sink: WeightSink<'a>, _: TileArea) -> Vec<PixelWeight> {
        sink.list
    }
}

impl Sink for WeightSink<'_> {
    const IS_ACTIVE: bool = true;

    fn begin_chunk(&mut self, records: &[Record]) {
        self.gaussians.clear();
        self.gaussians.extend(records.iter().map(|record| record.gaussian_idx));
    }

    #[inline(always)]
    fn add(&mut self, position: usize, first_pixel: usize, weights: &[f32]) {
        let gaussian_idx = self.gaussians[position];
        let num_new = weights.iter().filter(|&&weight| weight > 0.0).count();
        if num_new == 0 || !self.has_room(num_new) {
            return;
        }
        for (pixel, &weight) in (first_pixel..).zip(weights).filter(|(_, weight)| **weight > 0.0) {
            if let Some(idx) = self.area.picture_idx(pixel) {
                self.list.push(PixelWeight { pixel_idx: idx as u32, gaussian_idx, weight });
            }
        }
    }
}

impl WeightSink<'_> {
    /// Whether `num_new` more entries are within the budget; reserves more if needed.
    fn has_room(&mut self, num_new: usize) -> bool {
        if self.num_reserved < num_new {
            let num_more = num_new.max(RESERVE_LEN);
            if !self.budget.take((num_more * size_of::<PixelWeight>()) as u64) {
                return false;
            }
            self.num_reserved += num_more;
        }
        self.num_reserved -= num_new;
        true
    }
}

use super::kernel::Record;
use super::memory::Allowance;
use super::payload::{Payload, Sink, TileArea};

/// One splat's part in one pixel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Weight {
    /// The pixel: row * width + column.
    pub pixel_idx: u32,
    /// The Gaussian.
    pub gaussian_idx: u32,
    /// Opacity times transmittance, above 0.
    pub weight: f32,
}

/// The payload that lists every weight.
#[derive(Default)]
pub(super) struct WeightPayload {
    /// Bytes that the lists may take.
    pub(super) allowance: Allowance,
}

/// Entries that a tile asks memory for at once.
const NUM_AT_ONCE: usize = 1024;

/// The weights of one tile.
pub(super) struct WeightSink<'a> {
    allowance: &'a Allowance,
    /// Entries that there is memory for beyond those listed.
    num_allowed: usize,
    area: TileArea,
    gaussians: Vec<u32>,
    list: Vec<Weight>,
}

impl<'a> Payload for &'a WeightPayload {
    type Sink = WeightSink<'a>;
    type Part = Vec<Weight>;

    fn allow(&self, max_bytes: u64) {
        // Lists grow by doubling and are joined to one in the end.
        self.allowance.allow(max_bytes / 3);
    }

    fn sink(&self, area: TileArea) -> WeightSink<'a> {
        WeightSink { allowance: &self.allowance, num_allowed: 0, area, gaussians: Vec::new(), list: Vec::new() }
    }

    fn part(&self, sink: WeightSink<'a>, _: TileArea) -> Vec<Weight> {
        sink.list
    }
}

impl Sink for WeightSink<'_> {
    const IS_ACTIVE: bool = true;

    fn begin(&mut self, records: &[Record]) {
        self.gaussians.clear();
        self.gaussians.extend(records.iter().map(|record| record.gaussian_idx));
    }

    #[inline(always)]
    fn take(&mut self, position: usize, first_pixel: usize, weights: &[f32]) {
        let gaussian_idx = self.gaussians[position];
        let num_new = weights.iter().filter(|&&weight| weight > 0.0).count();
        if num_new == 0 || !self.has_room(num_new) {
            return;
        }
        for (pixel, &weight) in (first_pixel..).zip(weights).filter(|(_, weight)| **weight > 0.0) {
            if let Some(idx) = self.area.picture_idx(pixel) {
                self.list.push(Weight { pixel_idx: idx as u32, gaussian_idx, weight });
            }
        }
    }
}

impl WeightSink<'_> {
    /// Whether there is memory for so many more entries; asks for more of it where there is not.
    fn has_room(&mut self, num_new: usize) -> bool {
        if self.num_allowed < num_new {
            let num_more = num_new.max(NUM_AT_ONCE);
            if !self.allowance.take((num_more * size_of::<Weight>()) as u64) {
                return false;
            }
            self.num_allowed += num_more;
        }
        self.num_allowed -= num_new;
        true
    }
}

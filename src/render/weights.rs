use super::kernel::Record;
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
pub(super) struct WeightPayload;

/// The weights of one tile.
pub(super) struct WeightSink {
    area: TileArea,
    gaussians: Vec<u32>,
    list: Vec<Weight>,
}

impl Payload for WeightPayload {
    type Sink = WeightSink;
    type Part = Vec<Weight>;

    fn sink(&self, area: TileArea) -> WeightSink {
        WeightSink { area, gaussians: Vec::new(), list: Vec::new() }
    }

    fn part(&self, sink: WeightSink, _: TileArea) -> Vec<Weight> {
        sink.list
    }
}

impl Sink for WeightSink {
    const IS_ACTIVE: bool = true;

    fn begin(&mut self, records: &[Record]) {
        self.gaussians.clear();
        self.gaussians.extend(records.iter().map(|record| record.gaussian_idx));
    }

    fn take(&mut self, position: usize, first_pixel: usize, weights: &[f32]) {
        let gaussian_idx = self.gaussians[position];
        for (pixel, &weight) in (first_pixel..).zip(weights).filter(|(_, weight)| **weight > 0.0) {
            if let Some(idx) = self.area.picture_idx(pixel) {
                self.list.push(Weight { pixel_idx: idx as u32, gaussian_idx, weight });
            }
        }
    }
}

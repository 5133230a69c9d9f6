use super::payload::{Payload, Sink, TileArea, TileRows};
use super::record::Record;
use super::tiles::TILE_LEN;

/// Depth of each pixel along the view axis, scene units: `[row * width + column]`, NaN where no splat is.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct DepthMap {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// Mean of the depths of the splats, weighted with their blending weights.
    pub expected: Vec<f32>,
    /// Depth of the splat at which the sum of the weights reaches 0.5; NaN where it stays below.
    pub median: Vec<f32>,
}

/// The payload of a [`DepthMap`].
pub(super) struct DepthPayload;

/// Running sums of one tile.
pub(super) struct DepthSink {
    depths: Vec<f32>,
    weight: Vec<f32>,
    weighted: Vec<f32>,
    median: Vec<f32>,
}

/// Expected and median depth of a tile.
pub(super) type DepthTile = [TileRows<f32>; 2];

impl Payload for DepthPayload {
    type Sink = DepthSink;
    type TileOutput = DepthTile;

    fn sink(&self, _: TileArea) -> DepthSink {
        let zeros = vec![0.0; TILE_LEN];
        DepthSink { depths: Vec::new(), weight: zeros.clone(), weighted: zeros, median: vec![f32::NAN; TILE_LEN] }
    }

    fn finish(&self, mut sink: DepthSink, area: TileArea) -> DepthTile {
        sink.weighted.iter_mut().zip(&sink.weight).for_each(|(sum, weight)| *sum /= weight);
        [area.in_rows(&sink.weighted, 1), area.in_rows(&sink.median, 1)]
    }
}

impl Sink for DepthSink {
    const IS_ACTIVE: bool = true;

    fn begin_chunk(&mut self, records: &[Record]) {
        self.depths.clear();
        self.depths.extend(records.iter().map(|record| record.depth));
    }

    #[inline(always)]
    fn add(&mut self, position: usize, first_pixel: usize, weights: &[f32]) {
        let (depth, num) = (self.depths[position], weights.len());
        let sums = self.weight[first_pixel..][..num].iter_mut().zip(&mut self.weighted[first_pixel..][..num]);
        for (((sum, weighted), median), &weight) in sums.zip(&mut self.median[first_pixel..][..num]).zip(weights) {
            *weighted += weight * depth;
            let before = *sum;
            *sum = before + weight;
            *median = if before < 0.5 && *sum >= 0.5 { depth } else { *median };
        }
    }
}

impl DepthMap {
    /// Assembles the map from its tiles.
    pub(super) fn assemble(width: u32, height: u32, tiles: Vec<DepthTile>) -> Self {
        let num_pixels = width as usize * height as usize;
        let mut map = Self { width, height, expected: vec![f32::NAN; num_pixels], median: vec![f32::NAN; num_pixels] };
        for [expected, median] in tiles {
            expected.write(&mut map.expected, 1, 0);
            median.write(&mut map.median, 1, 0);
        }
        map
    }
}

use super::blend::TILE_LEN;
use super::kernel::Record;
use super::payload::{Payload, Sink, TileArea};

/// Depth along the view axis in each pixel, scene units: `[row * width + column]`, NaN where nothing is.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct DepthMap {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// Mean of the splats' depths, each with its weight.
    pub expected: Vec<f32>,
    /// Depth of the splat with which half of the light is gone; NaN where less than half goes.
    pub median: Vec<f32>,
}

/// The payload of a [`DepthMap`].
pub(super) struct DepthPayload;

/// Sums of one tile.
pub(super) struct DepthSink {
    depths: Vec<f32>,
    weight: Vec<f32>,
    weighted: Vec<f32>,
    median: Vec<f32>,
}

/// One pixel of a tile: index in the picture, expected and median depth.
pub(super) type DepthPixel = (usize, f32, f32);

impl Payload for DepthPayload {
    type Sink = DepthSink;
    type Part = Vec<DepthPixel>;

    fn sink(&self, _: TileArea) -> DepthSink {
        let zeros = vec![0.0; TILE_LEN];
        DepthSink { depths: Vec::new(), weight: zeros.clone(), weighted: zeros, median: vec![f32::NAN; TILE_LEN] }
    }

    fn part(&self, sink: DepthSink, area: TileArea) -> Vec<DepthPixel> {
        let expected = |pixel: usize| sink.weighted[pixel] / sink.weight[pixel];
        let inside = (0..TILE_LEN).filter_map(|pixel| Some((area.picture_idx(pixel)?, pixel)));
        inside.map(|(idx, pixel)| (idx, expected(pixel), sink.median[pixel])).collect()
    }
}

impl Sink for DepthSink {
    const IS_ACTIVE: bool = true;

    fn begin(&mut self, records: &[Record]) {
        self.depths.clear();
        self.depths.extend(records.iter().map(|record| record.depth));
    }

    fn take(&mut self, position: usize, first_pixel: usize, weights: &[f32]) {
        let depth = self.depths[position];
        for (pixel, &weight) in (first_pixel..).zip(weights) {
            self.weighted[pixel] += weight * depth;
            let before = self.weight[pixel];
            self.weight[pixel] = before + weight;
            if before < 0.5 && before + weight >= 0.5 {
                self.median[pixel] = depth;
            }
        }
    }
}

impl DepthMap {
    /// Puts the tiles together.
    pub(super) fn assemble(width: u32, height: u32, parts: Vec<Vec<DepthPixel>>) -> Self {
        let num_pixels = width as usize * height as usize;
        let mut map = Self { width, height, expected: vec![f32::NAN; num_pixels], median: vec![f32::NAN; num_pixels] };
        for (idx, expected, median) in parts.into_iter().flatten() {
            map.expected[idx] = expected;
            map.median[idx] = median;
        }
        map
    }
}

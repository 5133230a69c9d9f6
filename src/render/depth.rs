use pulp::Simd;

use super::payload::{Payload, Sink, TileArea, TileRows};
use super::pixels::{BlockValues, HALF_LEN};
use super::record::{RECORDS_LEN, Record};
use super::tiles::NUM_BLOCKS;

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
    /// Depth of each record.
    depths: [f32; RECORDS_LEN],
    /// Sums per block.
    sums: Vec<DepthSums>,
}

/// Running sums of one block.
#[derive(Debug, Clone, Copy)]
struct DepthSums {
    /// Sums of weights.
    weight: BlockValues,
    /// Sums of weights times depths.
    weighted: BlockValues,
    median: BlockValues,
}

/// Expected and median depth of a tile.
pub(super) type DepthTile = [TileRows<f32>; 2];

impl Payload for DepthPayload {
    type Sink = DepthSink;
    type TileOutput = DepthTile;

    fn sink(&self, _: TileArea) -> DepthSink {
        let (zero, nan) = (BlockValues::ZERO, BlockValues::splat(f32::NAN));
        DepthSink {
            depths: [0.0; RECORDS_LEN],
            sums: vec![DepthSums { weight: zero, weighted: zero, median: nan }; NUM_BLOCKS],
        }
    }

    fn finish(&self, sink: DepthSink, area: TileArea) -> DepthTile {
        let expected = |sums: &DepthSums| {
            let (weights, weighted) = (sums.weight.0.as_flattened(), sums.weighted.0.as_flattened());
            weighted.iter().zip(weights).map(|(sum, weight)| sum / weight).collect::<Vec<f32>>()
        };
        let expected: Vec<f32> = sink.sums.iter().flat_map(expected).collect();
        let median: Vec<f32> = sink.sums.iter().flat_map(|sums| sums.median.0).flatten().collect();
        [area.in_rows(&expected, 1), area.in_rows(&median, 1)]
    }
}

impl Sink for DepthSink {
    const TAKES_WEIGHTS: bool = true;

    #[inline(always)]
    fn begin_chunk(&mut self, records: &[Record]) {
        self.depths.iter_mut().zip(records).for_each(|(depth, record)| *depth = record.depth);
    }

    #[inline(always)]
    fn add_block<S: Simd>(&mut self, simd: S, block: usize, list: &[u8], weights: &[BlockValues]) {
        let (sums, half) = (&mut self.sums[block], simd.splat_f32s(0.5));
        for first_lane in (0..HALF_LEN).step_by(S::F32_LANES) {
            let mut weight_sums = sums.weight.load(simd, first_lane);
            let mut weighted = sums.weighted.load(simd, first_lane);
            let mut median = sums.median.load(simd, first_lane);
            for (&position, weights) in list.iter().zip(weights) {
                let depth = simd.splat_f32s(self.depths[usize::from(position)]);
                let weights = weights.load(simd, first_lane);
                for side in 0..2 {
                    let before = weight_sums[side];
                    let after = simd.add_f32s(before, weights[side]);
                    weighted[side] = simd.add_f32s(weighted[side], simd.mul_f32s(weights[side], depth));
                    // The median is at this splat where the sum passes a half: not before it, but behind it.
                    let behind = simd.select_f32s(simd.greater_than_or_equal_f32s(after, half), depth, median[side]);
                    median[side] = simd.select_f32s(simd.less_than_f32s(before, half), behind, median[side]);
                    weight_sums[side] = after;
                }
            }
            sums.weight.store(simd, first_lane, weight_sums);
            sums.weighted.store(simd, first_lane, weighted);
            sums.median.store(simd, first_lane, median);
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

use std::sync::{Mutex, PoisonError};

use pulp::Simd;

use super::error::check_len;
use super::memory::Budget;
use super::payload::{Payload, Sink, TileArea};
use super::pixels::{BlockValues, HALF_LEN};
use super::pool::Pool;
use super::record::{RECORDS_LEN, Record};
use super::tiles::{NUM_BLOCKS, TILE_PX};
use super::{RenderError, RenderSettings, Renderer, View};
use cinesplat_geometry::Camera;

/// Channels per pass of the blending loop.
const CHANNELS_PER_PASS: usize = 16;

/// Blended features of each pixel.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct FeatureMap {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// Values per pixel.
    pub num_channels: usize,
    /// Sum of the features of the splats, weighted with their blending weights; 0 where no splat is.
    /// `[(row * width + column) * num_channels + channel]`.
    pub values: Vec<f32>,
}

/// The payload of some channels of a [`FeatureMap`].
struct FeaturePayload<'a> {
    /// One row of `stride` values per Gaussian.
    features: &'a [f32],
    stride: usize,
    /// First channel of this pass, and the number of channels.
    first: usize,
    num_channels: usize,
    /// The map, one band per row of tiles.
    bands: Vec<Mutex<&'a mut [f32]>>,
    sinks: Pool<FeatureSums>,
}

/// Channels whose sums are in registers together, for both halves of a block.
const GROUP_LEN: usize = 8;

/// The features of the splats of a chunk and the sums of one tile. The channels are in groups; those behind the last are
/// 0.
#[derive(Debug, Default)]
struct FeatureSums {
    /// `[group][position][channel in group]`.
    rows: Vec<[[f32; GROUP_LEN]; RECORDS_LEN]>,
    /// `[block * num_groups + group][channel in group]`.
    sums: Vec<[BlockValues; GROUP_LEN]>,
}

/// Running sums of one tile.
struct FeatureSink<'a> {
    payload: &'a FeaturePayload<'a>,
    num_groups: usize,
    sums: FeatureSums,
}

impl FeaturePayload<'_> {
    /// Bytes that a thread takes while it blends a tile.
    fn bytes_per_thread(num_channels: usize) -> u64 {
        let group_bytes = NUM_BLOCKS * size_of::<[BlockValues; GROUP_LEN]>() + RECORDS_LEN * GROUP_LEN * 4;
        (num_channels.div_ceil(GROUP_LEN) * group_bytes) as u64
    }
}

impl<'a> Payload for &'a FeaturePayload<'a> {
    type Sink = FeatureSink<'a>;
    type TileOutput = ();

    fn sink(&self, _: TileArea) -> FeatureSink<'a> {
        let num_groups = self.num_channels.div_ceil(GROUP_LEN);
        let mut sums = self.sinks.take();
        sums.rows.resize(num_groups, [[0.0; GROUP_LEN]; RECORDS_LEN]);
        sums.sums.clear();
        sums.sums.resize(NUM_BLOCKS * num_groups, [BlockValues::ZERO; GROUP_LEN]);
        FeatureSink { payload: self, num_groups, sums }
    }

    /// Writes the tile into the map.
    fn finish(&self, sink: FeatureSink<'a>, area: TileArea) {
        {
            let mut band = self.bands[area.origin_px[1] / TILE_PX].lock().unwrap_or_else(PoisonError::into_inner);
            for (block, groups) in sink.sums.sums.chunks_exact(sink.num_groups).enumerate() {
                for (pixel, idx) in area.picture_idxs(block).into_iter().enumerate() {
                    let Some(idx) = idx else { continue };
                    let in_band = idx - area.origin_px[1] * area.width;
                    let to = &mut band[in_band * self.stride + self.first..][..self.num_channels];
                    let (half, lane) = (pixel / HALF_LEN, pixel % HALF_LEN);
                    let channels = groups.as_flattened().iter().map(|channel| channel.0[half][lane]);
                    to.iter_mut().zip(channels).for_each(|(to, sum)| *to = sum);
                }
            }
        }
        self.sinks.give_back(sink.sums);
    }
}

impl Sink for FeatureSink<'_> {
    const TAKES_WEIGHTS: bool = true;

    #[inline(always)]
    fn begin_chunk(&mut self, records: &[Record]) {
        let FeaturePayload { features, stride, first, num_channels, .. } = *self.payload;
        for (position, record) in records.iter().enumerate().take(RECORDS_LEN) {
            let row = &features[record.gaussian_idx as usize * stride + first..][..num_channels];
            for (rows, some) in self.sums.rows.iter_mut().zip(row.chunks(GROUP_LEN)) {
                rows[position][..some.len()].copy_from_slice(some);
            }
        }
    }

    #[inline(always)]
    fn add_block<S: Simd>(&mut self, simd: S, block: usize, list: &[u8], weights: &[BlockValues]) {
        let sums = &mut self.sums.sums[block * self.num_groups..][..self.num_groups];
        for (rows, sums) in self.sums.rows.iter().zip(sums) {
            for first_lane in (0..HALF_LEN).step_by(S::F32_LANES) {
                add_group(simd, first_lane, (rows, sums), list.iter().zip(weights));
            }
        }
    }
}

/// Adds the features of one group of channels of splats to the sums of a block.
#[inline(always)]
fn add_group<'a, S: Simd>(
    simd: S,
    first_lane: usize,
    (rows, sums): (&[[f32; GROUP_LEN]; RECORDS_LEN], &mut [BlockValues; GROUP_LEN]),
    splats: impl Iterator<Item = (&'a u8, &'a BlockValues)>,
) {
    let zero = simd.splat_f32s(0.0);
    let mut totals = [[zero; 2]; GROUP_LEN];
    for channel in 0..GROUP_LEN {
        totals[channel] = sums[channel].load(simd, first_lane);
    }
    for (&position, weights) in splats {
        let row = &rows[usize::from(position)];
        let weights = weights.load(simd, first_lane);
        // A feature may be NaN: it must not reach pixels where the splat is not.
        let counts = weights.map(|weight| simd.greater_than_f32s(weight, zero));
        for channel in 0..GROUP_LEN {
            let feature = simd.splat_f32s(row[channel]);
            for half in 0..2 {
                let total = totals[channel][half];
                let more = simd.mul_add_f32s(weights[half], feature, total);
                totals[channel][half] = simd.select_f32s(counts[half], more, total);
            }
        }
    }
    for channel in 0..GROUP_LEN {
        sums[channel].store(simd, first_lane, totals[channel]);
    }
}

impl Renderer<'_> {
    /// Blends features (`[gaussian * num_channels + channel]`) as colors are blended, at full resolution. Memory beyond
    /// the map does not grow with the number of channels.
    ///
    /// # Errors
    /// Those of [`Renderer::render`]; [`RenderError::Length`] unless there is one row per Gaussian and at least one
    /// channel; [`RenderError::Memory`] if the map exceeds [`super::Limits::max_memory_bytes`].
    pub fn features(
        &self,
        camera: &Camera,
        settings: &RenderSettings,
        features: &[f32],
        num_channels: usize,
    ) -> Result<FeatureMap, RenderError> {
        check_len("features", features.len(), self.num_gaussians() * num_channels)?;
        check_len("channels of a feature", num_channels.min(1), 1)?;
        let view = View::new(camera, glam::DVec3::ZERO, settings)?;
        let num_pixels = view.width as usize * view.height as usize;
        let num_values = num_pixels * num_channels;
        let mut budget = Budget::of_picture(&view, &settings.limits)?;
        budget.take("the feature map", (num_values * size_of::<f32>()) as u64)?;
        let thread_bytes = FeaturePayload::bytes_per_thread(num_channels.min(CHANNELS_PER_PASS));
        budget.take("the features of the threads", rayon::current_num_threads() as u64 * thread_bytes)?;
        let limits = super::Limits { max_memory_bytes: budget.left_bytes(), ..settings.limits };
        let settings = RenderSettings { limits, ..*settings };

        let mut map =
            FeatureMap { width: view.width, height: view.height, num_channels, values: vec![0.0; num_values] };
        for first in (0..num_channels).step_by(CHANNELS_PER_PASS) {
            let num_some = CHANNELS_PER_PASS.min(num_channels - first);
            let bands = map.values.chunks_mut(view.width as usize * num_channels * TILE_PX).map(Mutex::new).collect();
            let sinks = Pool::default();
            let payload =
                FeaturePayload { features, stride: num_channels, first, num_channels: num_some, bands, sinks };
            self.tiles_of_payload(camera, &settings, &&payload)?;
        }
        Ok(map)
    }
}

use super::error::check_len;
use super::memory::Budget;
use super::payload::{Payload, Sink, TileArea, TileRows};
use super::record::Record;
use super::tiles::{TILE_LEN, TILE_PX};
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
}

/// Sums of one tile: `[pixel * num_channels + channel]`.
struct FeatureSink<'a> {
    payload: &'a FeaturePayload<'a>,
    rows: Vec<&'a [f32]>,
    sums: Vec<f32>,
}

impl<'a> Payload for &'a FeaturePayload<'a> {
    type Sink = FeatureSink<'a>;
    type TileOutput = TileRows<f32>;

    fn sink(&self, _: TileArea) -> FeatureSink<'a> {
        FeatureSink { payload: self, rows: Vec::new(), sums: vec![0.0; TILE_LEN * self.num_channels] }
    }

    fn finish(&self, sink: FeatureSink<'a>, area: TileArea) -> TileRows<f32> {
        area.in_rows(&sink.sums, self.num_channels)
    }
}

impl Sink for FeatureSink<'_> {
    const IS_ACTIVE: bool = true;

    fn begin_chunk(&mut self, records: &[Record]) {
        let FeaturePayload { features, stride, first, num_channels } = *self.payload;
        let row = |record: &Record| &features[record.gaussian_idx as usize * stride + first..][..num_channels];
        self.rows.clear();
        self.rows.extend(records.iter().map(row));
    }

    #[inline(always)]
    fn add(&mut self, position: usize, first_pixel: usize, weights: &[f32]) {
        let (row, num_channels) = (self.rows[position], self.payload.num_channels);
        let sums = &mut self.sums[first_pixel * num_channels..][..weights.len() * num_channels];
        if let Ok(row) = <&[f32; CHANNELS_PER_PASS]>::try_from(row) {
            // With a constant number of channels, a row stays in one or two registers.
            for (sums, &weight) in sums.as_chunks_mut::<CHANNELS_PER_PASS>().0.iter_mut().zip(weights) {
                sums.iter_mut().zip(row).for_each(|(sum, feature)| *sum += weight * feature);
            }
            return;
        }
        let pixels = sums.chunks_exact_mut(num_channels);
        for (sums, &weight) in pixels.zip(weights).filter(|(_, weight)| **weight > 0.0) {
            sums.iter_mut().zip(row).for_each(|(sum, feature)| *sum += weight * feature);
        }
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
        let num_tile_pixels = (view.width as usize + TILE_PX) * (view.height as usize + TILE_PX);
        let num_values = num_pixels * num_channels + num_tile_pixels * num_channels.min(CHANNELS_PER_PASS);
        let mut budget = Budget::of_picture(&view, &settings.limits)?;
        budget.take("the feature map", (num_values * size_of::<f32>()) as u64)?;
        let limits = super::Limits { max_memory_bytes: budget.left_bytes(), ..settings.limits };
        let settings = RenderSettings { limits, ..*settings };

        let mut map = FeatureMap {
            width: view.width,
            height: view.height,
            num_channels,
            values: vec![0.0; num_pixels * num_channels],
        };
        for first in (0..num_channels).step_by(CHANNELS_PER_PASS) {
            let num_some = CHANNELS_PER_PASS.min(num_channels - first);
            let payload = FeaturePayload { features, stride: num_channels, first, num_channels: num_some };
            let (_, tiles) = self.render_with_payload(camera, &settings, &&payload)?;
            tiles.iter().for_each(|tile| tile.write(&mut map.values, num_channels, first));
        }
        Ok(map)
    }
}

use std::time::Instant;

use cinesplat_geometry::Camera;
use cinesplat_render::{Frame, LiftedValues, RenderError, RenderSettings, RenderStats, Renderer, Rgb8Frame};

/// Channels of the blended features.
const NUM_CHANNELS: usize = 16;
/// Number of objects; each gets an equal share of the Gaussians.
const NUM_OBJECTS: usize = 64;

/// Outputs of the renderer. Outputs other than color are computed in the blending loop of a picture, instead of its colors.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[derive(strum::AsRefStr, strum::Display, strum::EnumString, strum::IntoStaticStr)]
#[derive(strum::VariantArray, strum::VariantNames)]
#[strum(serialize_all = "kebab-case")]
pub enum RenderOutput {
    /// Color in `f32`.
    #[strum(serialize = "color f32")]
    Color,
    /// Color in 8 bits, as films use it.
    #[strum(serialize = "color 8 bit")]
    Rgb8,
    /// Depth, expected and median.
    Depth,
    /// The object in each pixel; 64 objects.
    Ids,
    /// 16 blended features.
    #[strum(serialize = "16 features")]
    Features,
    /// The weight of every splat in every pixel.
    Weights,
    /// A mask lifted to the Gaussians.
    Lift,
}

/// Inputs and buffers of the outputs, kept from run to run.
pub(super) struct OutputBuffers {
    labels: Vec<u16>,
    features: Vec<f32>,
    mask: Vec<f32>,
    lifted: LiftedValues,
    pub(super) frame: Frame,
    rgb8_frame: Rgb8Frame,
}

impl OutputBuffers {
    pub(super) fn new(num_gaussians: usize) -> Self {
        let object = |idx: usize| (1 + idx * NUM_OBJECTS / num_gaussians.max(1)) as u16;
        Self {
            labels: (0..num_gaussians).map(object).collect(),
            features: (0..num_gaussians * NUM_CHANNELS).map(|idx| (idx % 251) as f32 / 250.0).collect(),
            mask: Vec::new(),
            lifted: LiftedValues::new(num_gaussians, 1),
            frame: Frame::default(),
            rgb8_frame: Rgb8Frame::default(),
        }
    }

    /// Renders an output once. Returns its wall time in seconds, and its statistics or zeros if the output has none.
    pub(super) fn time(
        &mut self,
        renderer: &Renderer<'_>,
        camera: &Camera,
        settings: &RenderSettings,
        output: RenderOutput,
    ) -> Result<(f64, RenderStats), RenderError> {
        // A striped mask, filled before the clock starts.
        let num_pixels = camera.intrinsics.width as usize * camera.intrinsics.height as usize;
        self.mask.resize(num_pixels, 0.0);
        self.mask.iter_mut().enumerate().for_each(|(idx, value)| *value = (idx / 64 % 2) as f32);
        let start = Instant::now();
        let stats = self.render(renderer, camera, settings, output)?;
        Ok((start.elapsed().as_secs_f64(), stats))
    }

    fn render(
        &mut self,
        renderer: &Renderer<'_>,
        camera: &Camera,
        settings: &RenderSettings,
        output: RenderOutput,
    ) -> Result<RenderStats, RenderError> {
        let no_stats = |()| RenderStats::default();
        match output {
            RenderOutput::Color => {
                renderer.render_into(camera, settings, &mut self.frame)?;
                return Ok(self.frame.stats);
            }
            RenderOutput::Rgb8 => {
                renderer.render_rgb8_into(camera, settings, &mut self.rgb8_frame)?;
                return Ok(self.rgb8_frame.stats);
            }
            RenderOutput::Depth => renderer.depth(camera, settings).map(drop),
            RenderOutput::Ids => renderer.object_ids(camera, settings, &self.labels).map(drop),
            RenderOutput::Features => renderer.features(camera, settings, &self.features, NUM_CHANNELS).map(drop),
            RenderOutput::Weights => renderer.weights(camera, settings).map(drop),
            RenderOutput::Lift => renderer.lift(camera, settings, &self.mask, &mut self.lifted),
        }
        .map(no_stats)
    }
}

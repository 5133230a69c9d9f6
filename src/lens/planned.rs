//! How the renderer takes an exposure of lens and shutter: with how many samples, and which of them share a projection.

use super::budget::Budget;
use super::optics::LensAndShutter;
use super::samples::{Between, weighted_ring};
use cinesplat_geometry::Camera;
use cinesplat_render::{
    BlurExtent, Frame, Quality, RenderError, RenderSettings, Renderer, Rgb8Frame, SplatBlur, SubFrame, Sweep,
    SweepPattern,
};
use glam::DVec2;

/// Numbers of samples of a circle of confusion, in parts of a picture that need fewer than the whole.
const LENS_PATTERNS: [usize; 8] = [4, 5, 7, 9, 12, 16, 25, 36];
/// As [`LENS_PATTERNS`], of motion. An odd number has one in the middle, which every part of the picture takes in any case.
const MOTION_PATTERNS: [usize; 7] = [3, 5, 7, 9, 13, 17, 33];

impl LensAndShutter<'_> {
    /// How the renderer takes the exposure with `num_samples` samples; `moves` says whether the camera moves meanwhile.
    pub fn sampling(&self, num_samples: usize, (between, moves): (Between, bool), budget: &Budget) -> Sampling {
        if num_samples < 2 || between == Between::Blurred && moves {
            return Sampling::SubFrames(self.subframes(num_samples, between));
        }
        if between == Between::Blurred {
            let mut sweep = self.sweep_of(num_samples, moves, between);
            sweep.blur = self.subframes(num_samples, between)[0].blur;
            return Sampling::Sweep(Box::new(sweep));
        }
        let fewer: &[usize] = if self.lens.is_some() { &LENS_PATTERNS } else { &MOTION_PATTERNS };
        let fewer = fewer.iter().copied().filter(|num| *num < num_samples);
        let alone = SweepPattern { up_to_px: budget.blur_px, center_weight: 1.0, around: Vec::new() };
        let patterns = fewer.chain([num_samples]).map(|num| self.pattern(num, (between, moves), budget));
        let patterns = std::iter::once(alone).chain(patterns).collect();
        Sampling::Sweep(Box::new(Sweep { patterns, ..self.even_sweep(num_samples, moves) }))
    }

    /// An exposure of `num` sharp samples, at least 2, in every part of the picture.
    pub fn even_sweep(&self, num: usize, moves: bool) -> Sweep {
        self.sweep_of(num, moves, Between::Sharp)
    }

    fn sweep_of(&self, num: usize, moves: bool, between: Between) -> Sweep {
        let patterns = vec![self.pattern(num, (between, moves), &Budget::of(Quality::Standard))];
        Sweep { center: self.camera(), blur: SplatBlur::default(), ends: self.ends(moves), patterns }
    }

    /// The cameras at the ends of the exposure: its first and last moment, at the rim of the lens.
    fn ends(&self, moves: bool) -> Vec<Camera> {
        let moments: &[f64] = if moves { &[0.0, 1.0] } else { &[0.5] };
        let rim = |camera: Camera| match self.lens {
            None => vec![camera],
            Some(lens) => [DVec2::X, DVec2::NEG_X, DVec2::Y, DVec2::NEG_Y].map(|at| lens.pinhole(&camera, at)).to_vec(),
        };
        moments.iter().flat_map(|&moment| rim((self.camera_at)(moment))).collect()
    }

    /// `num` samples of the exposure, at least 2, and the blur that they are enough for.
    fn pattern(&self, num: usize, (between, moves): (Between, bool), budget: &Budget) -> SweepPattern {
        let for_motion = if moves { budget.motion_reach_px(num) } else { f64::INFINITY };
        let for_lens = if self.lens.is_some() { budget.circle_reach_px(num) } else { f64::INFINITY };
        let center = self.camera();
        let samples: Vec<(Camera, f64)> = match self.lens {
            Some(lens) if between == Between::Sharp && !moves && (4..=7).contains(&num) => {
                weighted_ring(num).into_iter().map(|(point, weight)| (lens.pinhole(&center, point), weight)).collect()
            }
            _ => {
                let subframes = self.subframes(num, between).into_iter();
                subframes.map(|subframe| (subframe.camera, 1.0 / num as f64)).collect()
            }
        };
        let mut around = samples;
        let middle = around.iter().position(|(camera, _)| *camera == center).map(|idx| around.remove(idx));
        let center_weight = middle.map_or(0.0, |(_, weight)| weight);
        SweepPattern { up_to_px: for_motion.min(for_lens), center_weight, around }
    }
}

/// How the renderer takes a frame.
#[derive(Debug, Clone, PartialEq)]
pub enum Sampling {
    /// The mean of pictures; a single one without blur is the plain picture.
    SubFrames(Vec<SubFrame>),
    /// Sharp pictures that share one projection.
    Sweep(Box<Sweep>),
}

impl Sampling {
    /// Number of samples of the frame; parts of it may have fewer.
    pub fn num_samples(&self) -> usize {
        match self {
            Self::SubFrames(subframes) => subframes.len(),
            Self::Sweep(sweep) => sweep.num_samples(),
        }
    }

    /// Takes the frame.
    ///
    /// # Errors
    /// Those of [`Renderer::expose_into`].
    pub fn take(
        &self,
        renderer: &Renderer<'_>,
        settings: &RenderSettings,
        frame: &mut Frame,
    ) -> Result<(), RenderError> {
        match self {
            Self::SubFrames(subframes) => renderer.expose_into(subframes, settings, frame),
            Self::Sweep(sweep) => renderer.sweep_into(sweep, settings, frame),
        }
    }

    /// Takes the frame in 8 bits.
    ///
    /// # Errors
    /// Those of [`Renderer::expose_into`].
    pub fn take_rgb8(
        &self,
        renderer: &Renderer<'_>,
        settings: &RenderSettings,
        frame: &mut Rgb8Frame,
    ) -> Result<(), RenderError> {
        match self {
            Self::SubFrames(subframes) => renderer.expose_rgb8_into(subframes, settings, frame),
            Self::Sweep(sweep) => renderer.sweep_rgb8_into(sweep, settings, frame),
        }
    }
}

/// What a frame needs.
#[derive(Debug, Clone, PartialEq)]
pub struct PlannedExposure {
    /// How it is taken.
    pub sampling: Sampling,
    /// How much blur is in the picture.
    pub extent: BlurExtent,
    /// Whether the motion is blurred, and whether what is out of focus is.
    pub blurs: [bool; 2],
}

impl LensAndShutter<'_> {
    /// What the frame needs at the settings' quality: blur below the budget leaves the plain picture.
    ///
    /// # Errors
    /// Those of [`Renderer::blur_extent`].
    pub fn plan(&self, renderer: &Renderer<'_>, settings: &RenderSettings) -> Result<PlannedExposure, RenderError> {
        let budget = Budget::of(settings.quality);
        let camera = self.camera();
        let extent = renderer.blur_extent(&camera, &self.blur(), settings)?;
        let blurs = [extent.motion_px, extent.circle_px].map(|blur| blur > budget.blur_px);
        let [moves, is_out_of_focus] = blurs;
        let still = |_| camera;
        let camera_at = if moves { self.camera_at } else { &still };
        let lens = self.lens.filter(|_| is_out_of_focus);
        let for_motion = if moves { budget.motion_samples(extent.motion_px) } else { 1 };
        let for_lens = if is_out_of_focus { budget.lens_samples(extent.circle_px) } else { 1 };
        let has_gaps = moves && budget.between_motion(for_motion) == Between::Blurred
            || is_out_of_focus && budget.between_lens(for_lens) == Between::Blurred;
        let between = if has_gaps { Between::Blurred } else { Between::Sharp };
        let sampling = match blurs {
            [false, false] => Sampling::SubFrames(vec![SubFrame::from(camera)]),
            _ => LensAndShutter { camera_at, lens }.sampling(
                for_motion.max(for_lens) as usize,
                (between, moves),
                &budget,
            ),
        };
        Ok(PlannedExposure { sampling, extent, blurs })
    }
}

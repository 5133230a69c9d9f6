//! Blur of lens and shutter: accuracy against time, over samples, methods and presets.
//!
//! Enters: a renderer and a camera. Leaves: [`LensRow`]s. The reference is the mean light of 256 sharp pictures at
//! `final`. Times are those of 8-bit pictures, as ratios to the plain picture of the same quality, measured alternately.

use std::time::Instant;

use glam::DQuat;

use cinesplat_geometry::{Camera, Intrinsics};
use cinesplat_lens::{Between, LensAndShutter, Sampling};
use cinesplat_render::{
    Frame, Quality, RenderError, RenderSettings, RenderStats, Renderer, Rgb8Frame, SubFrame, ThinLens,
};

/// Samples of the reference.
const REFERENCE_SAMPLES: usize = 256;
/// Samples of the methods.
const NUM_SAMPLES: [usize; 8] = [1, 2, 3, 4, 5, 7, 9, 16];

/// What blurs the picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[derive(strum::AsRefStr, strum::Display, strum::EnumString, strum::IntoStaticStr)]
#[derive(strum::VariantArray, strum::VariantNames)]
#[strum(serialize_all = "kebab-case")]
pub enum BlurSource {
    /// The camera moves to the right.
    Truck,
    /// The camera turns to the right.
    Pan,
    /// The camera turns about its view axis.
    Roll,
    /// The focal length grows.
    Zoom,
    /// An open aperture, focused on the nearer part of the picture.
    Focus,
}

/// A picture to blur: its source, and the 99th percentile of the blur of its splats.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LensCase {
    /// What blurs it.
    pub source: BlurSource,
    /// Length of the motion or diameter of the circle of confusion, pixels.
    pub blur_px: f64,
}

/// The cases of the bench.
pub const LENS_CASES: [LensCase; 8] = [
    LensCase { source: BlurSource::Truck, blur_px: 4.0 },
    LensCase { source: BlurSource::Pan, blur_px: 4.0 },
    LensCase { source: BlurSource::Roll, blur_px: 4.0 },
    LensCase { source: BlurSource::Zoom, blur_px: 4.0 },
    LensCase { source: BlurSource::Truck, blur_px: 16.0 },
    LensCase { source: BlurSource::Focus, blur_px: 4.0 },
    LensCase { source: BlurSource::Focus, blur_px: 8.0 },
    LensCase { source: BlurSource::Focus, blur_px: 24.0 },
];

/// How the blur is rendered.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[derive(strum::AsRefStr, strum::Display, strum::EnumString, strum::IntoStaticStr)]
#[derive(strum::VariantArray, strum::VariantNames)]
#[strum(serialize_all = "kebab-case")]
pub enum LensMethod {
    /// Not at all: the plain picture.
    Plain,
    /// Sharp pictures, each rendered by itself.
    Sharp,
    /// Sharp pictures that share one projection and one depth order.
    Shared,
    /// Pictures whose splats are blurred.
    Blurred,
    /// As the preset chooses.
    Preset,
}

/// One measurement.
#[derive(Debug, Clone, PartialEq)]
pub struct LensRow {
    /// The scene.
    pub scene: String,
    /// The camera.
    pub camera: String,
    /// The blur.
    pub case: LensCase,
    /// The preset.
    pub quality: Quality,
    /// The method.
    pub method: LensMethod,
    /// Pictures that were rendered.
    pub num_samples: usize,
    /// PSNR against the reference, dB.
    pub psnr_db: f64,
    /// Median of the ratio to the time of the plain picture.
    pub times_plain: f64,
    /// Median time of the plain picture, ms.
    pub plain_ms: f64,
    /// Blended pairs of a splat and a block, as a ratio to those of the plain picture.
    pub blends_ratio: f64,
}

/// A renderer with the settings that all rows share.
pub struct LensBench<'a> {
    /// The renderer.
    pub renderer: &'a Renderer<'a>,
    /// Settings; the quality is that of the row.
    pub settings: RenderSettings,
    /// Timed runs per row, after one run that is compared with the reference.
    pub num_repeats: usize,
}

impl LensCase {
    /// The camera at a fraction of the exposure, for a strength that is proportional to the blur.
    fn camera_at(&self, camera: &Camera, strength: f64, fraction: f64) -> Camera {
        let amount = strength * (fraction - 0.5);
        let Camera { mut pose, mut intrinsics } = *camera;
        match self.source {
            BlurSource::Truck => pose.position += pose.right() * amount,
            BlurSource::Pan => pose.rotation *= DQuat::from_rotation_y(amount),
            BlurSource::Roll => pose.rotation *= DQuat::from_rotation_z(amount),
            BlurSource::Zoom => {
                let Intrinsics { fx_px, fy_px, .. } = &mut intrinsics;
                [fx_px, fy_px].into_iter().for_each(|focal| *focal *= amount.exp());
            }
            BlurSource::Focus => {}
        }
        Camera { pose, intrinsics }
    }

    fn lens(&self, strength: f64, focus_distance: f64) -> Option<ThinLens> {
        (self.source == BlurSource::Focus).then_some(ThinLens {
            aperture_diameter: strength,
            focus_distance,
            squeeze: 1.0,
        })
    }
}

/// What is measured of every case: a quality, a method and a number of samples, which the presets choose themselves.
fn variants() -> Vec<(Quality, LensMethod, Option<usize>)> {
    let standard = Quality::Standard;
    let presets = [Quality::Draft, standard, Quality::Final].map(|quality| (quality, LensMethod::Preset, None));
    let plain = (standard, LensMethod::Plain, Some(1));
    let of = |method: LensMethod| NUM_SAMPLES.map(|num| (standard, method, Some(num)));
    // One sharp sample is the plain picture.
    let is_own = |(_, method, num): &(_, LensMethod, Option<usize>)| *method == LensMethod::Blurred || *num != Some(1);
    let methods = [LensMethod::Blurred, LensMethod::Sharp, LensMethod::Shared].into_iter().flat_map(of).filter(is_own);
    presets.into_iter().chain([plain]).chain(methods).collect()
}

impl LensBench<'_> {
    /// Measures a case with a camera: calls `on_row` with every row that is not known yet, by its quality, its method and its
    /// number of samples (`None` for the presets, which choose it). No rows for a picture without splats.
    ///
    /// # Errors
    /// [`RenderError`] of the first picture that cannot be rendered.
    pub fn measure(
        &self,
        (camera, case): (&Camera, LensCase),
        is_known: &dyn Fn(Quality, LensMethod, Option<usize>) -> bool,
        on_row: &mut dyn FnMut(LensRow),
    ) -> Result<(), RenderError> {
        let wanted: Vec<_> = variants().into_iter().filter(|&(a, b, c)| !is_known(a, b, c)).collect();
        let Some(focus) = self.focus_distance(camera)?.filter(|_| !wanted.is_empty()) else { return Ok(()) };
        let strength = self.strength(camera, case, focus)?;
        let camera_at = |fraction: f64| case.camera_at(camera, strength, fraction);
        let exposure = LensAndShutter { camera_at: &camera_at, lens: case.lens(strength, focus) };
        let mut reference = Frame::default();
        let samples = exposure.subframes(REFERENCE_SAMPLES, Between::Sharp);
        self.renderer.expose_into(&samples, &self.with(Quality::Final), &mut reference)?;
        for (quality, method, num_samples) in wanted {
            let num = num_samples.unwrap_or(1);
            let sampling = match method {
                LensMethod::Preset => exposure.plan(self.renderer, &self.with(quality))?.sampling,
                LensMethod::Plain => Sampling::SubFrames(vec![SubFrame::from(*camera)]),
                LensMethod::Blurred => Sampling::SubFrames(exposure.subframes(num, Between::Blurred)),
                LensMethod::Sharp => Sampling::SubFrames(exposure.subframes(num, Between::Sharp)),
                LensMethod::Shared => {
                    let moves = case.source != BlurSource::Focus;
                    Sampling::Sweep(Box::new(exposure.even_sweep(num, moves)))
                }
            };
            on_row(self.row((case, quality, method), (camera, &sampling), &reference)?);
        }
        Ok(())
    }

    fn with(&self, quality: Quality) -> RenderSettings {
        RenderSettings { quality, accuracy: None, ..self.settings }
    }

    /// A quarter of the picture is nearer than this; `None` without splats.
    ///
    /// # Errors
    /// Those of the renderer.
    pub fn focus_distance(&self, camera: &Camera) -> Result<Option<f64>, RenderError> {
        let mut depths = self.renderer.depth(camera, &self.with(Quality::Standard))?.median;
        depths.retain(|depth| depth.is_finite());
        depths.sort_unstable_by(f32::total_cmp);
        Ok(depths.get(depths.len() / 4).map(|&depth| f64::from(depth)))
    }

    /// The strength at which the 99th percentile of the blur is that of the case.
    fn strength(&self, camera: &Camera, case: LensCase, focus: f64) -> Result<f64, RenderError> {
        let mut strength = 1e-3;
        for _ in 0..5 {
            let camera_at = |fraction: f64| case.camera_at(camera, strength, fraction);
            let exposure = LensAndShutter { camera_at: &camera_at, lens: case.lens(strength, focus) };
            let extent = self.renderer.blur_extent(camera, &exposure.blur(), &self.with(Quality::Standard))?;
            strength *= case.blur_px / extent.circle_px.max(extent.motion_px).max(1e-9);
        }
        Ok(strength)
    }

    /// Without the names of scene and camera.
    fn row(
        &self,
        (case, quality, method): (LensCase, Quality, LensMethod),
        (camera, sampling): (&Camera, &Sampling),
        reference: &Frame,
    ) -> Result<LensRow, RenderError> {
        let settings = self.with(quality);
        let mut frame = Frame::default();
        sampling.take(self.renderer, &settings, &mut frame)?;
        let mut timed = Vec::new();
        let mut blends = [0; 2];
        for _ in 0..self.num_repeats.max(1) {
            let (plain_secs, plain) = self.time(&Sampling::SubFrames(vec![SubFrame::from(*camera)]), &settings)?;
            let (secs, stats) = self.time(sampling, &settings)?;
            timed.push((secs / plain_secs, plain_secs));
            blends = [plain, stats].map(|stats| stats.counts.num_block_blends);
        }
        timed.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (times_plain, plain_secs) = timed[timed.len() / 2];
        Ok(LensRow {
            scene: String::new(),
            camera: String::new(),
            case,
            quality,
            method,
            num_samples: sampling.num_samples(),
            psnr_db: frame.psnr_db(reference),
            times_plain,
            plain_ms: plain_secs * 1e3,
            blends_ratio: blends[1] as f64 / blends[0].max(1) as f64,
        })
    }

    fn time(&self, sampling: &Sampling, settings: &RenderSettings) -> Result<(f64, RenderStats), RenderError> {
        let mut frame = Rgb8Frame::default();
        let start = Instant::now();
        sampling.take_rgb8(self.renderer, settings, &mut frame)?;
        Ok((start.elapsed().as_secs_f64(), frame.stats))
    }
}

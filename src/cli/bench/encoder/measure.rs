use std::fs;

use crate::cli::bench::temporary_film::TemporaryFilm;
use crate::cli::failure::Failure;
use cinesplat::files::Existing;
use cinesplat::pipeline::{self, TimeCost};
use cinesplat::render::{Frame, RenderSettings, Renderer, Rgb8Frame};
use cinesplat::scene::Scene;
use cinesplat::trajectory::{CameraPath, Shot};
use cinesplat::video::{Planes420, VideoSettings, VideoWriter, X264Preset, planes_from_rgb8, read_film};
use cinesplat_bench::difference;

/// Every this many pictures one is compared.
const COMPARED_STEP: usize = 10;

/// One measurement.
#[derive(Debug, Clone)]
pub(super) struct EncoderRow {
    pub(super) scene: String,
    pub(super) size_px: [u32; 2],
    pub(super) num_frames: usize,
    pub(super) step: Step,
    pub(super) spent: TimeCost,
}

/// What was measured.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Step {
    /// Rendering, at `standard` unless stated.
    Render,
    /// Conversion to the planes that encoders take.
    Convert,
    /// Encoding.
    Encode {
        preset: X264Preset,
        crf: u8,
        /// Bits per second in thousands.
        rate_kbps: f64,
        /// Mean SSIM of luma.
        ssim: f64,
    },
}

/// A film that is encoded again and again.
pub(super) struct EncoderCase<'a> {
    name: String,
    shot: &'a Shot,
    pictures: Vec<Planes420>,
}

impl<'a> EncoderCase<'a> {
    /// Renders the pictures and converts them.
    pub(super) fn film(
        name: &str,
        (scene, settings): (&Scene, &RenderSettings),
        shot: &'a Shot,
        report: &mut dyn FnMut(EncoderRow),
    ) -> Result<Self, Failure> {
        let (renderer, path) = (Renderer::new(&scene.gaussians), CameraPath::new(shot)?);
        let mut case = Self { name: name.to_owned(), shot, pictures: Vec::new() };
        let (mut frame, mut rendering, mut converting) =
            (Rgb8Frame::default(), TimeCost::default(), TimeCost::default());
        for idx in 0..shot.num_frames() {
            let camera = pipeline::camera_at(&path, shot, idx);
            let (rendered, spent) = TimeCost::measure(|| renderer.render_rgb8_into(&camera, settings, &mut frame));
            rendered?;
            rendering = rendering.plus(spent);
            let (width, height) = (frame.width as usize, frame.height as usize);
            let (planes, spent) = TimeCost::measure(|| planes_from_rgb8(&frame.rgb8, width, height));
            converting = converting.plus(spent);
            case.pictures.push(planes);
        }
        report(case.row(Step::Render, rendering));
        report(case.row(Step::Convert, converting));
        Ok(case)
    }

    /// Encodes the film, decodes it and compares the pictures.
    pub(super) fn encode(&self, preset: X264Preset, crf: u8) -> Result<EncoderRow, Failure> {
        let output = TemporaryFilm::new();
        let existing = Existing::Replace;
        let video = VideoSettings { preset: Some(preset), crf, existing, ..VideoSettings::default() };
        let video = pipeline::video_of(self.shot, &(0..self.pictures.len()), &video);
        let (written, spent) = TimeCost::measure(|| {
            let mut writer = VideoWriter::create(&output.0, &video)?;
            self.pictures.iter().try_for_each(|planes| writer.write_planes(planes))?;
            writer.finish()
        });
        written?;
        let num_bytes = fs::metadata(&output.0).map_err(|error| Failure::io("the film", &error))?.len();
        let ssim = self.ssim(&output.0)?;
        let secs = self.pictures.len() as f64 / self.shot.fps;
        let rate_kbps = num_bytes as f64 * 8e-3 / secs;
        Ok(self.row(Step::Encode { preset, crf, rate_kbps, ssim }, spent))
    }

    /// Mean SSIM between some pictures and those of the film.
    fn ssim(&self, film: &std::path::Path) -> Result<f64, Failure> {
        let (mut idx, mut sum, mut num) = (0_usize, 0.0, 0_u32);
        read_film(film, &mut |decoded| {
            if idx % COMPARED_STEP == COMPARED_STEP / 2 && idx < self.pictures.len() {
                sum += difference(&luma(&decoded), &luma(&self.pictures[idx])).ssim;
                num += 1;
            }
            idx += 1;
        })?;
        Ok(sum / f64::from(num))
    }

    fn row(&self, step: Step, spent: TimeCost) -> EncoderRow {
        EncoderRow {
            scene: self.name.clone(),
            size_px: [self.shot.width, self.shot.height],
            num_frames: self.pictures.len(),
            step,
            spent,
        }
    }
}

/// The luma of a picture as a gray one.
fn luma(planes: &Planes420) -> Frame {
    let gray = planes.y.iter().flat_map(|code| [(f32::from(*code) - 16.0) / 219.0; 3]);
    Frame { width: planes.width as u32, height: planes.height as u32, rgb: gray.collect(), ..Frame::default() }
}

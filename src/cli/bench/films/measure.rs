use std::ops::ControlFlow;
use std::path::Path;
use std::time::Instant;

use crate::cli::bench::temporary_film::TemporaryFilm;
use crate::cli::failure::Failure;
use cinesplat::files::Existing;
use cinesplat::geometry::Camera;
use cinesplat::pipeline::{self, FilmSettings, JobSettings, TimeCost};
use cinesplat::render::{RenderError, RenderSettings, Renderer, Rgb8Frame};
use cinesplat::scene::Scene;
use cinesplat::trajectory::{CameraPath, Shot};
use cinesplat::video::{VideoError, VideoSettings, VideoWriter};

/// Films with and without a job folder; an odd number has a median.
const NUM_PAIRS: usize = 5;

/// A shot on a scene.
#[derive(Debug, Clone, Copy)]
pub(super) struct FilmCase<'a> {
    pub(super) scene: &'a Scene,
    pub(super) name: &'a str,
    pub(super) shot: &'a Shot,
}

/// One measurement.
#[derive(Debug, Clone)]
pub(super) struct FilmRow {
    pub(super) scene: String,
    pub(super) size_px: [u32; 2],
    pub(super) num_frames: usize,
    pub(super) quality: &'static str,
    pub(super) measure: &'static str,
    pub(super) secs: f64,
    /// CPU time, where it is known.
    pub(super) cpu_secs: Option<f64>,
    /// Baseline of the comparison, and the difference from it in percent.
    pub(super) against: Option<(&'static str, f64)>,
}

impl FilmCase<'_> {
    /// Compares one renderer that reuses its depth order with one that sorts every picture anew, and with a new renderer
    /// per picture.
    pub(super) fn stills(&self, settings: &FilmSettings, report: &mut dyn FnMut(FilmRow)) -> Result<(), Failure> {
        let cameras = self.cameras()?;
        let quality = settings.render.quality.into();
        let renderer = Renderer::new(&self.scene.gaussians);
        let (_, kept) = render(&renderer, &cameras, &settings.render, false)?;
        report(self.row((quality, "pictures in a row"), kept, None));

        let anew = RenderSettings { reuses_order: false, ..settings.render };
        let (_, unordered) = render(&renderer, &cameras, &anew, false)?;
        let more = |secs: f64| ("pictures in a row", (secs / kept.wall_secs - 1.0) * 100.0);
        report(self.row((quality, "order found anew"), unordered, Some(more(unordered.wall_secs))));

        let (rendered, alone) = TimeCost::measure(|| {
            cameras.iter().try_for_each(|camera| {
                let renderer = Renderer::new(&self.scene.gaussians);
                renderer.render_rgb8_into(camera, &settings.render, &mut Rgb8Frame::default())
            })
        });
        rendered?;
        report(self.row((quality, "stills by a renderer each"), alone, Some(more(alone.wall_secs))));
        Ok(())
    }

    /// Compares the film with rendering and encoding alone, and with its forecast.
    pub(super) fn film(&self, settings: &FilmSettings, report: &mut dyn FnMut(FilmRow)) -> Result<(), Failure> {
        let quality = settings.render.quality;
        let output = TemporaryFilm::new();
        let renderer = Renderer::new(&self.scene.gaussians);
        let start = Instant::now();
        let forecasts = pipeline::forecast(&renderer, self.shot, &output.0, settings, &[quality])?;
        let forecast_secs = start.elapsed().as_secs_f64();
        let predicted = forecasts.first().map_or(f64::NAN, |forecast| forecast.film_time.as_secs_f64());

        let (filmed, film) = TimeCost::measure(|| {
            pipeline::film(&renderer, self.shot, &output.0, settings, &mut |_| ControlFlow::Continue(()))
        });
        filmed?;
        let (pictures, rendered) = render(&renderer, &self.cameras()?, &settings.render, true)?;
        let preset = settings.video.preset.or(Some(pipeline::suited_preset(quality)));
        let encoded = self.encode(&output.0, &VideoSettings { preset, ..settings.video.clone() }, &pictures)?;
        let slower = rendered.wall_secs.max(encoded.wall_secs);
        let busy = rendered.plus(encoded).cpu_secs;
        let all_busy = TimeCost { wall_secs: busy / pipeline::num_cores() as f64, cpu_secs: busy };
        let percent = |secs: f64, of: f64| (secs / of - 1.0) * 100.0;
        let only = |wall_secs: f64| TimeCost { wall_secs, cpu_secs: f64::NAN };

        let of = |measure: &'static str| (quality.into(), measure);
        report(self.row(of("rendered alone"), rendered, None));
        report(self.row(of("encoded alone"), encoded, None));
        report(self.row(of("both with every core busy"), all_busy, None));
        report(self.row(of("film"), film, Some(("the slower alone", percent(film.wall_secs, slower)))));
        let over_busy = percent(film.wall_secs, all_busy.wall_secs);
        report(self.row(of("film"), film, Some(("every core busy", over_busy))));
        report(self.row(of("predicted"), only(predicted), Some(("film", percent(predicted, film.wall_secs)))));
        report(self.row(of("time to predict"), only(forecast_secs), None));
        let pairs = self.film_pairs(&renderer, &output.0, settings)?;
        let (plain, kept) = median(&pairs, |spent| spent.wall_secs);
        report(self.row(of("film without kept frames"), plain, None));
        let more = percent(kept.wall_secs, plain.wall_secs);
        report(self.row(of("film with kept frames"), kept, Some(("film without kept frames", more))));
        let (plain, kept) = median(&pairs, |spent| spent.cpu_secs);
        let more = percent(kept.cpu_secs, plain.cpu_secs);
        report(self.row(of("film with kept frames"), kept, Some(("CPU time without kept frames", more))));
        Ok(())
    }

    /// Films without and with a job folder, alternating.
    fn film_pairs(
        &self,
        renderer: &Renderer<'_>,
        output: &Path,
        settings: &FilmSettings,
    ) -> Result<Vec<(TimeCost, TimeCost)>, Failure> {
        let video = VideoSettings { existing: Existing::Replace, ..settings.video.clone() };
        let plain = FilmSettings { video, ..settings.clone() };
        let kept = FilmSettings { job: Some(JobSettings::default()), ..plain.clone() };
        let film = |settings: &FilmSettings| -> Result<TimeCost, Failure> {
            let (filmed, spent) = TimeCost::measure(|| {
                pipeline::film(renderer, self.shot, output, settings, &mut |_| ControlFlow::Continue(()))
            });
            filmed?;
            Ok(spent)
        };
        (0..NUM_PAIRS).map(|_| Ok((film(&plain)?, film(&kept)?))).collect()
    }

    fn encode(&self, output: &Path, video: &VideoSettings, pictures: &[Rgb8Frame]) -> Result<TimeCost, VideoError> {
        let video = pipeline::video_of(self.shot, &(0..pictures.len()), video);
        let video = VideoSettings { existing: Existing::Replace, ..video };
        let (written, spent) = TimeCost::measure(|| {
            let mut writer = VideoWriter::create(output, &video)?;
            pictures.iter().try_for_each(|picture| writer.write_frame(&picture.rgb8))?;
            writer.finish()
        });
        written.map(|_path| spent)
    }

    fn cameras(&self) -> Result<Vec<Camera>, Failure> {
        let path = CameraPath::new(self.shot)?;
        Ok((0..self.shot.num_frames()).map(|idx| pipeline::camera_at(&path, self.shot, idx)).collect())
    }

    fn row(
        &self,
        (quality, measure): (&'static str, &'static str),
        spent: TimeCost,
        against: Option<(&'static str, f64)>,
    ) -> FilmRow {
        FilmRow {
            scene: self.name.to_owned(),
            size_px: [self.shot.width, self.shot.height],
            num_frames: self.shot.num_frames(),
            quality,
            measure,
            secs: spent.wall_secs,
            cpu_secs: Some(spent.cpu_secs).filter(|secs| secs.is_finite()),
            against,
        }
    }
}

/// The pair with the median ratio of a time.
fn median(pairs: &[(TimeCost, TimeCost)], time: fn(&TimeCost) -> f64) -> (TimeCost, TimeCost) {
    let mut sorted = pairs.to_vec();
    sorted.sort_by(|a, b| (time(&a.1) / time(&a.0)).total_cmp(&(time(&b.1) / time(&b.0))));
    sorted[sorted.len() / 2]
}

/// Renders all pictures in order and measures the time. Returns the pictures only if `keeps`.
fn render(
    renderer: &Renderer<'_>,
    cameras: &[Camera],
    settings: &RenderSettings,
    keeps: bool,
) -> Result<(Vec<Rgb8Frame>, TimeCost), RenderError> {
    let (mut frame, mut pictures, mut sum) = (Rgb8Frame::default(), Vec::new(), TimeCost::default());
    for camera in cameras {
        let (rendered, spent) = TimeCost::measure(|| renderer.render_rgb8_into(camera, settings, &mut frame));
        rendered?;
        sum = sum.plus(spent);
        if keeps {
            pictures.push(frame.clone());
        }
    }
    Ok((pictures, sum))
}

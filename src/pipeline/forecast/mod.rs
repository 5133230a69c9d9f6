//! What a film will cost at each quality and how good it will be, found on this machine before it is rendered.
//!
//! Enters: a renderer, a shot, how it is filmed. Leaves: a [`Forecast`] a quality. Time: a few frames in a row are
//! rendered and encoded as the film will be, which gives seconds by stage and unit of work; small pictures along the
//! whole path tell how much work it is; [`FilmCost`] puts renderer and encoder side by side. Accuracy: the same frames
//! against `final`, and `final` against `reference` on a small cut-out.

mod accuracy;
mod cost;
mod sample;

use std::path::Path;
use std::time::{Duration, Instant};
use strum::VariantArray;

pub use cost::{FilmCost, TimeCost, num_cores};

use super::error::PipelineError;
use super::film::{self, FilmSettings, camera_at};
use accuracy::{ReferenceSample, mean_square, psnr_db};
use cinesplat_geometry::Camera;
use cinesplat_render::{Quality, RenderError, RenderSettings, Renderer};
use cinesplat_trajectory::{CameraPath, Shot};
use cinesplat_video::{VideoFormat, VideoSettings, encoder_delay_frames};
use sample::{Sampler, Samples, TimeLimit};

/// After this long nothing further is looked at.
const TIME_LIMIT_SECS: f64 = 0.9;
/// Where frames are looked at once those of the middle are, while time is left: places in the film, 0..1.
const FURTHER_FRACS: [f64; 2] = [1.0 / 6.0, 5.0 / 6.0];
/// Frames in a row that are rendered to time the last of them.
const TIMED_RUN: usize = 3;
/// Frames looked at after a film, away from those of the forecast.
const CHECKED_FRACS: [f64; 2] = [0.35, 0.65];
/// Share of frames of a camera that stands still from which on their encoding is looked at.
const STILL_FRAC: f64 = 0.05;
/// `reference` takes at least so many times as long as `final`.
const REFERENCE_FACTOR: f64 = 10.0;
/// Bytes a pixel of a frame that an encoder holds: 4:2:0, a half-size copy, vectors and costs of its blocks.
const HELD_BYTES: usize = 3;
/// Frames that an encoder holds beside those it looks ahead at: references, and one a thread.
const HELD_FRAMES: usize = 12;

/// What one quality will cost and give.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Forecast {
    /// The quality.
    pub quality: Quality,
    /// Time to render all frames, with nothing beside it.
    pub render_time: Duration,
    /// Time to encode all frames, with nothing beside it.
    pub encode_time: Duration,
    /// Time for the film: both together.
    pub film_time: Duration,
    /// PSNR of the frames looked at against the spec image, dB, all together; infinite for `reference`.
    pub psnr_db: f64,
    /// The same of the worst frame looked at.
    pub worst_psnr_db: f64,
    /// Memory for renderer, encoder and the frames between them, beyond the loaded scene.
    pub memory_bytes: u64,
}

/// What a film must hold.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Requirements {
    /// Longest time for the film.
    pub budget: Option<Duration>,
    /// Least PSNR of the worst frame, dB.
    pub min_psnr_db: Option<f64>,
}

/// Forecasts of some qualities for a film, fastest first; takes about a second, or as long as a few frames do.
///
/// # Errors
/// [`PipelineError::Trajectory`] for a shot without a path, [`PipelineError::NoSuchFrames`] for frames it does not have,
/// [`PipelineError::Render`] for a camera that cannot be, [`PipelineError::Video`] where the output cannot be encoded.
pub fn forecast(
    renderer: &Renderer<'_>,
    shot: &Shot,
    output: &Path,
    settings: &FilmSettings,
    qualities: &[Quality],
) -> Result<Vec<Forecast>, PipelineError> {
    let limit = TimeLimit::new(TIME_LIMIT_SECS);
    let frames = settings.frames.of_film(shot.num_frames())?;
    let cameras = film::moving_cameras(&CameraPath::new(shot)?, shot, frames.clone());
    let sampler = Sampler { renderer, cameras: &cameras, settings: &settings.render };
    let timed = timed_qualities(qualities);
    let mut samples = vec![Samples::default(); timed.len()];

    let run = sampler.run(0.5, sampler.num_encoded());
    let filmed = timed.iter().position(|quality| *quality == Quality::Standard).unwrap_or(0);
    let pictures = sampler.render_run(run, timed[filmed], &mut samples[filmed])?;
    let video = film::video_of(shot, &frames, &settings.video);
    let num_still = frames.len() - cameras.len();
    let counts_still = num_still as f64 > STILL_FRAC * frames.len() as f64;
    let [first_encode, encode, still_encode] = sample::encode_cost(output, &video, &pictures, counts_still)?;
    drop(pictures);
    for (_, (samples, &quality)) in samples.iter_mut().zip(&timed).enumerate().filter(|(idx, _)| *idx != filmed) {
        sampler.render_run(sampler.run(0.5, TIMED_RUN), quality, samples)?;
    }
    let middle = &run[run.len() / 2];
    let exact = ReferenceSample::of(renderer, middle, &settings.render)?;
    let mean_work = sampler.mean_work()?;
    sample_further(&sampler, &timed, &mut samples, &limit)?;

    let num_ahead = encoder_delay_frames(&VideoFormat::from_path(output)?, &video);
    let cost = FilmCost {
        num_frames: frames.len(),
        num_rendered: cameras.len(),
        render: TimeCost::default(),
        first_encode,
        encode,
        still_encode,
        num_ahead,
        num_cores: num_cores(),
    };
    let memory_bytes = renderer.memory_bytes() + held_bytes(&video, num_ahead);
    let of_fast = |(&quality, samples): (&Quality, &Samples)| {
        let cost = FilmCost { render: samples.frame(mean_work), ..cost };
        let worst = samples.mean_squares.iter().copied().fold(0.0, f64::max);
        let psnr_db = [
            psnr_db(samples.mean_squares.iter().copied(), exact.final_db),
            psnr_db(std::iter::once(worst), exact.final_db),
        ];
        Forecast::new(quality, &cost, psnr_db, memory_bytes)
    };
    let is_wanted = |(quality, _): &(&Quality, &Samples)| qualities.contains(quality);
    let mut forecasts: Vec<Forecast> = timed.iter().zip(&samples).filter(is_wanted).map(of_fast).collect();
    if qualities.contains(&Quality::Reference) {
        let more = mean_work[3] / sampler.work_at(middle)?[3].max(1.0);
        let wall_secs = exact.reference_secs(renderer, middle, &settings.render)? * more;
        let cpu_secs = wall_secs * rayon::current_num_threads().min(num_cores()) as f64;
        let cost = FilmCost { render: TimeCost { wall_secs, cpu_secs }, ..cost };
        forecasts.push(Forecast::new(Quality::Reference, &cost, [f64::INFINITY; 2], memory_bytes));
    }
    Ok(forecasts)
}

/// PSNR against the spec image, dB, of a few frames away from those that a forecast looks at, all together.
///
/// # Errors
/// As [`forecast`].
pub fn checked_psnr_db(renderer: &Renderer<'_>, shot: &Shot, settings: &FilmSettings) -> Result<f64, PipelineError> {
    let render = &settings.render;
    let path = CameraPath::new(shot)?;
    let frames = settings.frames.of_film(shot.num_frames())?;
    if render.quality == Quality::Reference {
        return Ok(f64::INFINITY);
    }
    let mut mean_squares = Vec::new();
    let mut final_db = f64::INFINITY;
    for frac in CHECKED_FRACS {
        let frame_idx = frames.start + ((frames.len() - 1) as f64 * frac).round() as usize;
        let camera = camera_at(&path, shot, frame_idx);
        let best = renderer.render(&camera, &RenderSettings { quality: Quality::Final, ..*render })?;
        mean_squares.push(mean_square(&renderer.render(&camera, render)?, &best));
        final_db = final_db.min(ReferenceSample::of(renderer, &camera, render)?.final_db);
    }
    Ok(psnr_db(mean_squares.into_iter(), final_db))
}

/// The quality that holds a requirements: with a least PSNR the fastest that has it, else the most accurate in time.
///
/// # Errors
/// [`PipelineError::Unreachable`] where none does, with what each would give.
pub fn choose(forecasts: &[Forecast], requirements: Requirements) -> Result<Quality, PipelineError> {
    let is_in_time = |forecast: &&Forecast| requirements.budget.is_none_or(|budget| forecast.film_time <= budget);
    let is_good = |forecast: &&Forecast| requirements.min_psnr_db.is_none_or(|least| forecast.worst_psnr_db >= least);
    let mut fitting = forecasts.iter().filter(is_in_time).filter(is_good);
    let chosen = if requirements.min_psnr_db.is_some() {
        fitting.min_by_key(|forecast| forecast.film_time)
    } else {
        // Ascending accuracy, as `Quality::VARIANTS`.
        fitting.next_back()
    };
    chosen.map(|forecast| forecast.quality).ok_or_else(|| PipelineError::Unreachable {
        wanted: requirements.sentence(),
        reachable: forecasts.iter().map(Forecast::sentence).collect::<Vec<_>>().join("; "),
    })
}

impl Forecast {
    fn new(quality: Quality, cost: &FilmCost, [psnr_db, worst_psnr_db]: [f64; 2], memory_bytes: u64) -> Self {
        Self {
            quality,
            render_time: Duration::from_secs_f64(cost.render_all().wall_secs),
            encode_time: Duration::from_secs_f64(cost.encode_all().wall_secs),
            film_time: Duration::from_secs_f64(cost.film_secs()),
            psnr_db,
            worst_psnr_db,
            memory_bytes,
        }
    }

    /// Such as `standard 23.1 s, 55.2 dB (worst 54.8), 0.31 GB`.
    pub fn sentence(&self) -> String {
        let (secs, name) = (self.film_time.as_secs_f64(), self.quality.as_ref());
        let gigabytes = self.memory_bytes as f64 / 1e9;
        if self.psnr_db == f64::INFINITY {
            return format!("{name} {secs:.1} s, exact, {gigabytes:.2} GB");
        }
        format!("{name} {secs:.1} s, {:.1} dB (worst {:.1}), {gigabytes:.2} GB", self.psnr_db, self.worst_psnr_db)
    }
}

impl Requirements {
    /// Whether `reference` may be what is wished for, given forecasts of all other qualities: where none of them is good
    /// enough, or so much time is allowed that it may do.
    pub fn may_need_reference(&self, others: &[Forecast]) -> bool {
        let best = others.last().map_or(Duration::ZERO, |forecast| forecast.film_time);
        let is_affordable = |budget: Duration| budget >= best.mul_f64(REFERENCE_FACTOR);
        match self.min_psnr_db {
            Some(least) if others.iter().any(|forecast| forecast.worst_psnr_db >= least) => false,
            Some(_) => self.budget.is_none_or(is_affordable),
            None => self.budget.is_some_and(is_affordable),
        }
    }

    fn sentence(&self) -> String {
        let budget = self.budget.map(|budget| format!("at most {:.1} s", budget.as_secs_f64()));
        let accuracy = self.min_psnr_db.map(|least| format!("at least {least:.1} dB in the worst frame"));
        budget.into_iter().chain(accuracy).collect::<Vec<_>>().join(" and ")
    }
}

/// The qualities whose frames are timed whole: those wanted but `reference`; `standard` where that alone is.
fn timed_qualities(wanted: &[Quality]) -> Vec<Quality> {
    let is_timed = |quality: &Quality| *quality != Quality::Reference && wanted.contains(quality);
    let timed: Vec<Quality> = Quality::VARIANTS.iter().copied().filter(is_timed).collect();
    if timed.is_empty() { vec![Quality::Standard] } else { timed }
}

/// Holds the middle frame against `final`, then frames elsewhere, timed as well, while there is time.
fn sample_further(
    sampler: &Sampler<'_>,
    qualities: &[Quality],
    samples: &mut [Samples],
    limit: &TimeLimit,
) -> Result<(), RenderError> {
    let start = Instant::now();
    sampler.compare(&sampler.run(0.5, 1)[0], qualities, samples)?;
    let rendered: f64 = samples.iter().map(|samples| samples.mean_secs() * TIMED_RUN as f64).sum();
    let round_secs = start.elapsed().as_secs_f64() + rendered;
    for frac in FURTHER_FRACS {
        let run: &[Camera] = sampler.run(frac, TIMED_RUN);
        if !limit.allows(round_secs) || run.len() == sampler.cameras.len() {
            break;
        }
        for (samples, &quality) in samples.iter_mut().zip(qualities) {
            sampler.render_run(run, quality, samples)?;
        }
        sampler.compare(&run[run.len() - 1], qualities, samples)?;
    }
    Ok(())
}

/// Memory of the frames between renderer and encoder, and of those in the encoder.
fn held_bytes(video: &VideoSettings, num_ahead: usize) -> u64 {
    // One is rendered, one encoded, the others wait.
    let between = video.frame_bytes() * (film::QUEUE_FRAMES + 2);
    let inside = video.frame_bytes() / 3 * HELD_BYTES * (num_ahead + HELD_FRAMES);
    (between + inside) as u64
}

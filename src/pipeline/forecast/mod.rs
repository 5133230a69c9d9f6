//! Forecasts time and accuracy of a film per quality, from measurements on this machine.
//!
//! Enters: a renderer, a shot, film settings. Leaves: one [`Forecast`] per quality. Time: a few consecutive frames are
//! rendered and encoded like the film, which gives seconds per stage and unit of work. Small pictures along the whole path
//! count the work. [`FilmCost`] combines renderer and encoder, which run in parallel. Accuracy: the same frames, with their
//! effects, are compared with `final` and the samples of `reference`, and `final` with `reference` on a small crop.

mod accuracy;
mod cost;
mod promised;
mod sample;
mod worst;

use std::path::Path;
use std::time::{Duration, Instant};
use strum::VariantArray;

pub use cost::{FilmCost, TimeCost, num_cores};
pub use promised::{Promised, promised};

use super::accuracy::{at, psnr_db};
use super::error::PipelineError;
use super::film::{self, Compared, FilmSettings, Filmed, Found};
use super::promise::{Pace, PathProfile, margin_db};
use accuracy::ReferenceSample;
use cinesplat_geometry::Camera;
use cinesplat_render::{Quality, RenderError, RenderSettings, Renderer};
use cinesplat_trajectory::Shot;
use cinesplat_video::{VideoFormat, VideoSettings, encoder_delay_frames};
use sample::{Sampler, Samples, TimeLimit};

/// Time after which no further frames are sampled.
const TIME_LIMIT_SECS: f64 = 0.9;
/// Positions in the film, 0..1, of further samples after those in the middle, while time is left.
const FURTHER_FRACS: [f64; 2] = [1.0 / 6.0, 5.0 / 6.0];
/// Consecutive frames that are rendered to time the last of them.
const TIMED_RUN: usize = 3;
/// Positions of the frames that are checked after a film, away from those of the forecast.
const CHECKED_FRACS: [f64; 2] = [0.35, 0.65];
/// Share of frames of a resting camera above which their encoding is measured too.
const STILL_FRAC: f64 = 0.05;
/// Time that a forecast must leave free: a factor, and what opening and closing a film may take. Films of 2 s on a
/// machine with other work ended 0.2 s late with a tenth of a second.
const TIME_MARGIN: f64 = 1.2;
const TIME_RESERVE: Duration = Duration::from_millis(250);
/// Largest share of a budget that goes to further samples.
const SAMPLED_BUDGET_FRAC: f64 = 0.05;
/// Least ratio of the times of `reference` and `final`.
const REFERENCE_FACTOR: f64 = 10.0;
/// Bytes per pixel of a frame inside an encoder: 4:2:0, a half-size copy, vectors and costs of its blocks.
const HELD_BYTES: usize = 3;
/// Frames that an encoder holds besides those it looks ahead at: references, and one per thread.
const HELD_FRAMES: usize = 12;

/// Predicted cost and accuracy of one quality.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Forecast {
    /// The quality.
    pub quality: Quality,
    /// Time to render all frames, with nothing running in parallel.
    pub render_time: Duration,
    /// Time to encode all frames, with nothing running in parallel.
    pub encode_time: Duration,
    /// Wall time of the film: both in parallel.
    pub film_time: Duration,
    /// PSNR against [`Quality::Reference`] over all sampled frames, dB; infinite for `reference` itself.
    pub psnr_db: f64,
    /// PSNR of the worst sampled frame, dB.
    pub worst_psnr_db: f64,
    /// Memory of renderer, encoder and the frames between them, without the loaded scene.
    pub memory_bytes: u64,
    /// Whether all sampled frames show the background alone.
    pub is_empty: bool,
    /// Time per frame, for a film that is watched.
    pub pace: Pace,
}

/// Requirements of a film.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Requirements {
    /// Longest wall time of the film.
    pub budget: Option<Duration>,
    /// Least PSNR of the worst frame, dB.
    pub min_psnr_db: Option<f64>,
}

/// Forecasts a film at some qualities, fastest first. Takes about a second, or longer if a few frames take longer.
///
/// # Errors
/// [`PipelineError::Trajectory`] for keyframes that make no path, [`PipelineError::NoSuchFrames`], [`PipelineError::Render`]
/// for an invalid camera, [`PipelineError::Video`] when the output cannot be encoded.
pub fn forecast(
    renderer: &Renderer<'_>,
    shot: &Shot,
    output: &Path,
    settings: &FilmSettings,
    qualities: &[Quality],
) -> Result<Vec<Forecast>, PipelineError> {
    forecast_within((renderer, shot), output, settings, qualities, TIME_LIMIT_SECS)
}

/// As [`forecast`], with a time after which no further frames are sampled.
fn forecast_within(
    (renderer, shot): (&Renderer<'_>, &Shot),
    output: &Path,
    settings: &FilmSettings,
    qualities: &[Quality],
    limit_secs: f64,
) -> Result<Vec<Forecast>, PipelineError> {
    let limit = TimeLimit::new(limit_secs);
    let frames = settings.frames.of_film(shot.num_frames())?;
    let with_effects = Filmed::new(shot, &settings.effects, &settings.render)?;
    let moving = with_effects.moving_frames(frames.clone());
    let sampler = Sampler { renderer, moving: &moving, settings: &settings.render };
    let compared = Compared { renderer, filmed: &with_effects, settings: &settings.render };
    let timed = timed_qualities(qualities);
    let mut samples = vec![Samples::default(); timed.len()];

    let run = sampler.run(0.5, sampler.num_encoded());
    let filmed = timed.iter().position(|quality| *quality == Quality::Standard).unwrap_or(0);
    let pictures = sampler.render_run(run, timed[filmed], &mut samples[filmed])?;
    let num_still = frames.len() - moving.cameras.len();
    let counts_still = num_still as f64 > STILL_FRAC * frames.len() as f64;
    let mut encodings: Vec<Encoding> = Vec::new();
    for &quality in qualities {
        let render = RenderSettings { quality, ..settings.render };
        let video = FilmSettings { render, ..settings.clone() }.video_for(shot, &frames);
        let known = encodings.iter().find(|known| known.video == video);
        let costs = match known {
            Some(known) => known.costs,
            None => sample::encode_cost(output, &video, &pictures, counts_still)?,
        };
        let num_ahead = encoder_delay_frames(&VideoFormat::from_path(output)?, &video);
        encodings.push(Encoding { quality, video, num_ahead, costs });
    }
    drop(pictures);
    for (_, (samples, &quality)) in samples.iter_mut().zip(&timed).enumerate().filter(|(idx, _)| *idx != filmed) {
        sampler.render_run(sampler.run(0.5, TIMED_RUN), quality, samples)?;
    }
    let middle = &run[run.len() / 2];
    let exact = ReferenceSample::of(renderer, middle, &settings.render)?;
    let path_work = sampler.path_work()?;
    let mean_work = sample::mean_work(&path_work);
    // Nothing was blended into any picture along the path.
    let is_empty = mean_work[3] <= 0.0;
    sample_further((&sampler, &compared), &timed, &mut samples, &limit)?;

    // Each quality takes samples of its own.
    let factor_at = |quality: Quality| with_effects.cost_factor(&frames, (renderer, &at(&settings.render, quality)));
    let factors: Vec<f64> = timed.iter().map(|&quality| factor_at(quality)).collect::<Result<_, _>>()?;
    let with_encoder = |quality: Quality, render: TimeCost| {
        let encoding = encodings.iter().find(|encoding| encoding.quality == quality);
        let (num_ahead, [first_encode, encode, still_encode]) =
            encoding.map_or_else(Default::default, |encoding| (encoding.num_ahead, encoding.costs));
        let held_bytes = encoding.map_or(0, Encoding::held_bytes);
        let (num_frames, num_rendered, num_cores) = (frames.len(), moving.cameras.len(), num_cores());
        let cost =
            FilmCost { num_frames, num_rendered, render, first_encode, encode, still_encode, num_ahead, num_cores };
        (cost, renderer.memory_bytes() + held_bytes)
    };
    let of_fast = |((&quality, samples), &factor): ((&Quality, &Samples), &f64)| {
        let (cost, memory_bytes) = with_encoder(quality, samples.frame(mean_work).times(factor));
        let profile = samples.profile(&path_work);
        let worst = samples.mean_squares.iter().copied().fold(0.0, f64::max);
        let psnr_db = [
            psnr_db(samples.mean_squares.iter().copied(), exact.final_db),
            psnr_db(std::iter::once(worst), exact.final_db),
        ];
        Forecast { is_empty, ..Forecast::new(quality, (&cost, profile), psnr_db, memory_bytes) }
    };
    let is_wanted = |((quality, _), _): &((&Quality, &Samples), &f64)| qualities.contains(quality);
    let mut forecasts: Vec<Forecast> =
        timed.iter().zip(&samples).zip(&factors).filter(is_wanted).map(of_fast).collect();
    if qualities.contains(&Quality::Reference) {
        let factor = factor_at(Quality::Reference)?;
        let more = mean_work[3] / sampler.work_at(middle)?[3].max(1.0);
        let wall_secs = exact.reference_secs(renderer, middle, &settings.render)? * more;
        let cpu_secs = wall_secs * rayon::current_num_threads().min(num_cores()) as f64;
        let (cost, memory_bytes) = with_encoder(Quality::Reference, TimeCost { wall_secs, cpu_secs }.times(factor));
        let profile = samples[0].profile(&path_work);
        let exact = Forecast::new(Quality::Reference, (&cost, profile), [f64::INFINITY; 2], memory_bytes);
        forecasts.push(Forecast { is_empty, ..exact });
    }
    Ok(forecasts)
}

/// PSNR in dB against [`Quality::Reference`], with effects, over a few frames that a forecast does not sample. `is_finest` says
/// whether the effects took the samples of `reference` ([`super::FilmReport::num_finest`]).
///
/// # Errors
/// As [`forecast`].
pub fn checked_psnr_db(
    renderer: &Renderer<'_>,
    shot: &Shot,
    (settings, is_finest): (&FilmSettings, bool),
) -> Result<f64, PipelineError> {
    let render = &settings.render;
    let filmed = Filmed::new(shot, &settings.effects, render)?;
    let compared = Compared { renderer, filmed: &filmed, settings: render };
    let frames = settings.frames.of_film(shot.num_frames())?;
    if render.quality == Quality::Reference {
        return Ok(f64::INFINITY);
    }
    let mut mean_squares = Vec::new();
    let mut final_db = f64::INFINITY;
    for frac in CHECKED_FRACS {
        let frame_idx = frames.start + ((frames.len() - 1) as f64 * frac).round() as usize;
        if is_finest {
            mean_squares.push(compared.floor(frame_idx)?);
        } else {
            mean_squares.extend(compared.found(frame_idx, &[render.quality])?.iter().map(Found::mean));
        }
        final_db = final_db.min(ReferenceSample::of(renderer, &filmed.camera(frame_idx), render)?.final_db);
    }
    Ok(psnr_db(mean_squares.into_iter(), final_db))
}

/// The quality that meets the requirements: with a least PSNR the least accurate one that has it, otherwise the most
/// accurate one in time.
///
/// Forecasts must meet them with a margin, because a film is noisier than its samples. If none does, the fastest one that
/// is in time without a margin is chosen.
///
/// # Errors
/// [`PipelineError::Unreachable`] with all forecasts if no quality meets them.
pub fn choose(forecasts: &[Forecast], requirements: Requirements) -> Result<Quality, PipelineError> {
    let is_in_time = |forecast: &Forecast, margin: f64, reserve: Duration| {
        requirements.budget.is_none_or(|budget| forecast.film_time.mul_f64(margin) + reserve <= budget)
    };
    let is_good = |forecast: &&Forecast| {
        let margin_db = margin_db(forecast.quality);
        requirements.min_psnr_db.is_none_or(|least| forecast.worst_psnr_db >= least + margin_db)
    };
    // In order of accuracy, as `Quality::VARIANTS`: the choice does not depend on the noise of measured times.
    let mut safe = forecasts.iter().filter(is_good).filter(|forecast| is_in_time(forecast, TIME_MARGIN, TIME_RESERVE));
    let chosen = if requirements.min_psnr_db.is_some() { safe.next() } else { safe.next_back() };
    let mut barely = forecasts.iter().filter(is_good).filter(|forecast| is_in_time(forecast, 1.0, Duration::ZERO));
    chosen.or_else(|| barely.next()).map(|forecast| forecast.quality).ok_or_else(|| PipelineError::Unreachable {
        wanted: requirements.sentence(),
        reachable: forecasts.iter().map(|forecast| forecast.reach(requirements)).collect::<Vec<_>>().join("; "),
    })
}

impl Forecast {
    fn new(
        quality: Quality,
        (cost, profile): (&FilmCost, PathProfile),
        [psnr_db, worst_psnr_db]: [f64; 2],
        memory_bytes: u64,
    ) -> Self {
        let num_frames = cost.num_frames.max(1) as f64;
        Self {
            quality,
            render_time: Duration::from_secs_f64(cost.render_all().wall_secs),
            encode_time: Duration::from_secs_f64(cost.encode_all().wall_secs),
            film_time: Duration::from_secs_f64(cost.film_secs()),
            psnr_db,
            worst_psnr_db,
            memory_bytes,
            is_empty: false,
            pace: Pace {
                quality,
                render_secs: cost.render.wall_secs,
                film_secs: cost.film_secs() / num_frames,
                encode_secs: cost.encode_all().wall_secs / num_frames,
                num_ahead: cost.num_ahead,
                profile,
            },
        }
    }

    /// The forecast of a film that takes longer, where it is the renderer that does.
    fn slowed(mut self, more: Duration) -> Self {
        let factor = 1.0 + more.as_secs_f64() / self.film_time.as_secs_f64().max(1e-9);
        self.film_time += more;
        self.render_time += more;
        self.pace.render_secs *= factor;
        self.pace.film_secs *= factor;
        self
    }

    /// One phrase, such as `standard 23.1 s, 55.2 dB (worst 54.8), 0.31 GB`.
    pub fn sentence(&self) -> String {
        let (secs, name) = (self.film_time.as_secs_f64(), self.quality.as_ref());
        let gigabytes = self.memory_bytes as f64 / 1e9;
        if self.psnr_db == f64::INFINITY {
            return format!("{name} {secs:.1} s, exact, {gigabytes:.2} GB");
        }
        format!("{name} {secs:.1} s, {:.1} dB (worst {:.1}), {gigabytes:.2} GB", self.psnr_db, self.worst_psnr_db)
    }
}

impl Forecast {
    /// What the quality reaches, in words, with the decibels that it can promise where some are required.
    fn reach(&self, requirements: Requirements) -> String {
        let promised_db = self.worst_psnr_db - margin_db(self.quality);
        match requirements.min_psnr_db {
            Some(_) if promised_db.is_finite() => format!("{}, {promised_db:.1} dB promised", self.sentence()),
            _ => self.sentence(),
        }
    }
}

impl Requirements {
    /// Whether `reference` may be the right quality, given forecasts of all others: if none of them is accurate enough, or
    /// if the budget allows for it.
    pub fn may_need_reference(&self, others: &[Forecast]) -> bool {
        let best = others.last().map_or(Duration::ZERO, |forecast| forecast.film_time);
        let is_affordable = |budget: Duration| budget >= best.mul_f64(REFERENCE_FACTOR);
        match self.min_psnr_db {
            Some(least)
                if others.iter().any(|forecast| forecast.worst_psnr_db >= least + margin_db(forecast.quality)) =>
            {
                false
            }
            Some(_) => self.budget.is_none_or(is_affordable),
            None => self.budget.is_some_and(is_affordable),
        }
    }

    fn sentence(&self) -> String {
        self.sentence_after(Duration::ZERO)
    }

    /// The requirements in words, with the time of the budget that is gone.
    fn sentence_after(&self, gone: Duration) -> String {
        let of_them = if gone.is_zero() { String::new() } else { format!(" (the forecast took {})", seconds(gone)) };
        let budget = self.budget.map(|budget| format!("at most {}{of_them}", seconds(budget)));
        let accuracy = self.min_psnr_db.map(|least| format!("at least {least:.1} dB in the worst frame"));
        budget.into_iter().chain(accuracy).collect::<Vec<_>>().join(" and ")
    }
}

/// A time with as many digits as tell it from 0.
fn seconds(time: Duration) -> String {
    let secs = time.as_secs_f64();
    match secs {
        _ if secs >= 10.0 => format!("{secs:.1} s"),
        _ if secs >= 0.1 => format!("{secs:.2} s"),
        _ => format!("{:.2} ms", 1e3 * secs),
    }
}

/// The qualities whose frames are timed: those wanted except `reference`, or `standard` if `reference` alone is wanted.
fn timed_qualities(wanted: &[Quality]) -> Vec<Quality> {
    let is_timed = |quality: &Quality| *quality != Quality::Reference && wanted.contains(quality);
    let timed: Vec<Quality> = Quality::VARIANTS.iter().copied().filter(is_timed).collect();
    if timed.is_empty() { vec![Quality::Standard] } else { timed }
}

/// Compares the middle frame with `final`. Then times and compares frames at further positions while time is left.
fn sample_further(
    (sampler, compared): (&Sampler<'_>, &Compared<'_>),
    qualities: &[Quality],
    samples: &mut [Samples],
    limit: &TimeLimit,
) -> Result<(), RenderError> {
    let start = Instant::now();
    sampler.compare(compared, 0.5, qualities, samples)?;
    let rendered: f64 = samples.iter().map(|samples| samples.mean_secs() * TIMED_RUN as f64).sum();
    let round_secs = start.elapsed().as_secs_f64() + rendered;
    for frac in FURTHER_FRACS {
        let run: &[Camera] = sampler.run(frac, TIMED_RUN);
        if !limit.allows(round_secs) || run.len() == sampler.moving.cameras.len() {
            break;
        }
        for (samples, &quality) in samples.iter_mut().zip(qualities) {
            sampler.render_run(run, quality, samples)?;
        }
        sampler.compare(compared, frac, qualities, samples)?;
    }
    Ok(())
}

/// The encoder at one quality.
struct Encoding {
    quality: Quality,
    video: VideoSettings,
    /// Frames that it reads before it writes the first one.
    num_ahead: usize,
    /// Of the first frame, of each further frame, and of a frame that equals the one before.
    costs: [TimeCost; 3],
}

impl Encoding {
    /// Bytes of the frames between renderer and encoder, and inside the encoder.
    fn held_bytes(&self) -> u64 {
        let frame_bytes = self.video.frame_bytes();
        if self.video.has_alpha {
            // Four planes of 16 bits, of the frame that is being kept two copies more; the frame that is being made has
            // four floats per pixel besides.
            let num_pixels = frame_bytes / 3;
            return (num_pixels * (8 * (film::QUEUE_FRAMES + 5 + self.num_ahead + HELD_FRAMES) + 16)) as u64;
        }
        // One frame is being rendered, one encoded, one kept, of which there is a copy; the others wait.
        let between = frame_bytes * (film::QUEUE_FRAMES + 4);
        let inside = frame_bytes / 3 * HELD_BYTES * (self.num_ahead + HELD_FRAMES);
        (between + inside) as u64
    }
}

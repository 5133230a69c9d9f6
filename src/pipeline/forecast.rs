//! What a film will cost at each quality and how good it will be, found on this machine before it is rendered.
//!
//! Enters: a renderer, a shot, its frames. Leaves: a [`Forecast`] a quality. Time: a few frames are rendered whole, which
//! gives seconds by stage and unit of work on this scene and machine; small pictures along the whole path tell how much
//! work every part of it is. Accuracy: the same frames against `final`, and `final` against `reference` on a small cut-out.

use std::ops::Range;
use std::time::{Duration, Instant};

use super::PipelineError;
use super::film::camera_at;
use crate::geometry::{Camera, Intrinsics};
use crate::render::{Frame, Quality, RenderError, RenderSettings, RenderStats, Renderer};
use crate::trajectory::{CameraPath, Shot};

/// Moments of the film whose work is counted on small pictures.
const NUM_POSES: usize = 9;
/// Which of them are rendered whole; the first always, the others while time is left.
const SAMPLED: [usize; 3] = [4, 1, 7];
/// Side of the small pictures over that of the film's.
const SMALL_FRAC: f64 = 0.25;
/// After this long no further frame is rendered whole.
const PATIENCE: Duration = Duration::from_millis(700);
/// Size in pixels of the cut-out that `reference` renders.
const CUTOUT_PX: [u32; 2] = [128, 72];
/// Frames looked at after a film, away from those of the forecast.
const CHECKED_FRACS: [f64; 2] = [0.35, 0.65];

/// What one quality will cost and give.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Forecast {
    /// The quality.
    pub quality: Quality,
    /// Time to render all frames.
    pub render_time: Duration,
    /// PSNR of the frames looked at against the spec image, dB, all together; infinite for `reference`.
    pub psnr_db: f64,
    /// The same of the worst frame looked at.
    pub worst_psnr_db: f64,
}

/// What a film must hold.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Wish {
    /// Longest time to render.
    pub budget: Option<Duration>,
    /// Least PSNR of the worst frame, dB.
    pub min_psnr_db: Option<f64>,
}

/// Frames rendered whole at one quality.
#[derive(Debug, Default)]
struct Samples {
    /// Seconds by stage: project, sort, bin, blend, all else.
    secs: [f64; 5],
    mean_square: Vec<f64>,
    num: usize,
}

/// Forecasts of some qualities for these frames of a shot; takes about a second, or as long as one frame a quality.
///
/// # Errors
/// [`PipelineError::Trajectory`] for a shot without a path, [`PipelineError::Render`] for a camera that cannot be.
pub fn forecast(
    renderer: &Renderer<'_>,
    shot: &Shot,
    frames: &Range<usize>,
    settings: &RenderSettings,
    qualities: &[Quality],
) -> Result<Vec<Forecast>, PipelineError> {
    let path = CameraPath::new(shot)?;
    let pose = |idx: usize| {
        let along = (frames.len() - 1) as f64 * idx as f64 / (NUM_POSES - 1) as f64;
        camera_at(&path, shot, frames.start + along.round() as usize)
    };
    let cameras: Vec<Camera> = (0..NUM_POSES).map(pose).collect();
    // Sampled at the same size twice: what the whole path takes over what the sampled frames take.
    let small = RenderSettings { quality: Quality::Standard, accuracy: None, ..*settings };
    let counted: Result<Vec<[f64; 4]>, RenderError> =
        cameras.iter().map(|camera| Ok(work(&renderer.render(&scaled(camera, SMALL_FRAC), &small)?.stats))).collect();
    let counted = counted?;
    let fast: Vec<Quality> = qualities.iter().copied().filter(|quality| *quality != Quality::Reference).collect();
    let (samples, num_sampled) = sample(renderer, &cameras, settings, &fast)?;
    let exact_db = final_db(renderer, &cameras[SAMPLED[0]], settings)?;

    let num_frames = frames.len() as f64;
    let of_fast = |(&quality, samples): (&Quality, &Samples)| Forecast {
        quality,
        render_time: Duration::from_secs_f64(num_frames * samples.mean_secs(&counted, num_sampled)),
        psnr_db: samples.psnr_db(exact_db, false),
        worst_psnr_db: samples.psnr_db(exact_db, true),
    };
    let mut forecasts: Vec<Forecast> = fast.iter().zip(&samples).map(of_fast).collect();
    if qualities.contains(&Quality::Reference) {
        let secs = reference_secs(renderer, &cameras[SAMPLED[0]], settings)?;
        let render_time = Duration::from_secs_f64(num_frames * secs * relative(&counted, 1, 3));
        let (psnr_db, worst_psnr_db) = (f64::INFINITY, f64::INFINITY);
        forecasts.push(Forecast { quality: Quality::Reference, render_time, psnr_db, worst_psnr_db });
    }
    Ok(forecasts)
}

/// PSNR against the spec image, dB, of a few frames away from those that a forecast looks at, all together.
///
/// # Errors
/// As [`forecast`].
pub fn checked_psnr_db(
    renderer: &Renderer<'_>,
    shot: &Shot,
    frames: &Range<usize>,
    settings: &RenderSettings,
) -> Result<f64, PipelineError> {
    let path = CameraPath::new(shot)?;
    let mut samples = Samples::default();
    let mut exact_db = f64::INFINITY;
    for frac in CHECKED_FRACS {
        let frame_idx = frames.start + ((frames.len() - 1) as f64 * frac).round() as usize;
        let camera = camera_at(&path, shot, frame_idx);
        let best = renderer.render(&camera, &RenderSettings { quality: Quality::Final, ..*settings })?;
        let frame = renderer.render(&camera, settings)?;
        samples.mean_square.push(mean_square(&frame, &best));
        exact_db = exact_db.min(final_db(renderer, &camera, settings)?);
    }
    Ok(if settings.quality == Quality::Reference { f64::INFINITY } else { samples.psnr_db(exact_db, false) })
}

/// The quality that holds a wish: with a least PSNR the fastest that has it, else the most accurate in time.
///
/// # Errors
/// [`PipelineError::Unreachable`] where none does, with what each would give.
pub fn choose(forecasts: &[Forecast], wish: Wish) -> Result<Quality, PipelineError> {
    let is_in_time = |forecast: &&Forecast| wish.budget.is_none_or(|budget| forecast.render_time <= budget);
    let is_good = |forecast: &&Forecast| wish.min_psnr_db.is_none_or(|least| forecast.worst_psnr_db >= least);
    let mut fitting = forecasts.iter().filter(is_in_time).filter(is_good);
    let chosen = if wish.min_psnr_db.is_some() {
        fitting.min_by_key(|forecast| forecast.render_time)
    } else {
        // Ascending accuracy, as `Quality::ALL`.
        fitting.next_back()
    };
    chosen.map(|forecast| forecast.quality).ok_or_else(|| PipelineError::Unreachable {
        wanted: wish.sentence(),
        reachable: forecasts.iter().map(Forecast::sentence).collect::<Vec<_>>().join("; "),
    })
}

impl Forecast {
    /// Such as `standard 23.1 s, 55.2 dB (worst 54.8)`.
    pub fn sentence(&self) -> String {
        let secs = self.render_time.as_secs_f64();
        if self.psnr_db == f64::INFINITY {
            return format!("{} {secs:.1} s, exact", self.quality.name());
        }
        format!("{} {secs:.1} s, {:.1} dB (worst {:.1})", self.quality.name(), self.psnr_db, self.worst_psnr_db)
    }
}

impl Wish {
    fn sentence(&self) -> String {
        let budget = self.budget.map(|budget| format!("at most {:.1} s", budget.as_secs_f64()));
        let accuracy = self.min_psnr_db.map(|least| format!("at least {least:.1} dB in the worst frame"));
        budget.into_iter().chain(accuracy).collect::<Vec<_>>().join(" and ")
    }
}

/// Renders frames whole at every quality and holds them against `final`; returns how many.
fn sample(
    renderer: &Renderer<'_>,
    cameras: &[Camera],
    settings: &RenderSettings,
    qualities: &[Quality],
) -> Result<(Vec<Samples>, usize), RenderError> {
    let start = Instant::now();
    let mut samples: Vec<Samples> = qualities.iter().map(|_| Samples::default()).collect();
    let (mut best, mut frame) = (Frame::default(), Frame::default());
    let mut num_sampled = 0;
    for (round, idx) in SAMPLED.into_iter().enumerate() {
        if round > 0 && start.elapsed().mul_f64(1.0 + 1.0 / round as f64) > PATIENCE {
            break;
        }
        let camera = &cameras[idx];
        let at = |quality| RenderSettings { quality, accuracy: None, ..*settings };
        renderer.render_into(camera, &at(Quality::Final), &mut best)?;
        for (samples, &quality) in samples.iter_mut().zip(qualities) {
            if round == 0 {
                // The first picture at a size makes room for those that follow.
                renderer.render_into(camera, &at(quality), &mut frame)?;
            }
            let begun = Instant::now();
            renderer.render_into(camera, &at(quality), &mut frame)?;
            samples.add(&frame, begun.elapsed(), &best);
        }
        num_sampled += 1;
    }
    Ok((samples, num_sampled))
}

impl Samples {
    fn add(&mut self, frame: &Frame, elapsed: Duration, best: &Frame) {
        let times = frame.stats.times;
        let rest = elapsed.saturating_sub(times.total());
        let stages = [times.project, times.sort, times.bin, times.blend, rest];
        self.secs.iter_mut().zip(stages).for_each(|(sum, stage)| *sum += stage.as_secs_f64());
        self.mean_square.push(mean_square(frame, best));
        self.num += 1;
    }

    /// Seconds of a frame, in the mean over the whole path.
    fn mean_secs(&self, counted: &[[f64; 4]], num_sampled: usize) -> f64 {
        let stages = (0..4).map(|stage| self.secs[stage] * relative(counted, num_sampled, stage));
        (stages.sum::<f64>() + self.secs[4]) / self.num.max(1) as f64
    }

    /// PSNR in dB of all frames together or of the worst, no better than that of `final`.
    fn psnr_db(&self, exact_db: f64, of_worst: bool) -> f64 {
        let sum: f64 = self.mean_square.iter().sum();
        let worst = self.mean_square.iter().copied().fold(0.0, f64::max);
        let apart = if of_worst { worst } else { sum / self.mean_square.len().max(1) as f64 };
        -10.0 * (apart + 10_f64.powf(-exact_db / 10.0)).log10()
    }
}

/// Work of the four stages.
fn work(stats: &RenderStats) -> [f64; 4] {
    let counts = &stats.counts;
    [counts.num_projected, counts.num_splats, counts.num_pairs, counts.num_block_blends].map(|count| count as f64)
}

/// Work of a stage in the mean over the whole path, over that in the mean over the sampled moments.
fn relative(counted: &[[f64; 4]], num_sampled: usize, stage: usize) -> f64 {
    let all = counted.iter().map(|work| work[stage]).sum::<f64>() / counted.len() as f64;
    let sampled = SAMPLED[..num_sampled].iter().map(|&idx| counted[idx][stage]).sum::<f64>() / num_sampled as f64;
    if sampled > 0.0 { all / sampled } else { 1.0 }
}

/// PSNR of `final` against `reference` on a cut-out from the middle of the picture, dB.
fn final_db(renderer: &Renderer<'_>, camera: &Camera, settings: &RenderSettings) -> Result<f64, RenderError> {
    let cutout = middle(camera, CUTOUT_PX);
    let at = |quality| renderer.render(&cutout, &RenderSettings { quality, accuracy: None, ..*settings });
    // Equal to the last bit of eight is as good as exact.
    Ok(at(Quality::Final)?.psnr_db(&at(Quality::Reference)?).min(150.0))
}

/// Seconds that `reference` takes for a frame: those of a cut-out, grown with the work that `final` counts.
fn reference_secs(renderer: &Renderer<'_>, camera: &Camera, settings: &RenderSettings) -> Result<f64, RenderError> {
    let timed = |camera: &Camera| {
        let start = Instant::now();
        renderer.render(camera, &RenderSettings { quality: Quality::Reference, accuracy: None, ..*settings })?;
        Ok::<f64, RenderError>(start.elapsed().as_secs_f64())
    };
    let blends = |camera: &Camera| {
        let counted =
            renderer.render(camera, &RenderSettings { quality: Quality::Final, accuracy: None, ..*settings })?;
        Ok::<f64, RenderError>(counted.stats.counts.num_block_blends as f64)
    };
    let (least, some) = (middle(camera, [8, 8]), middle(camera, CUTOUT_PX.map(|size| size * 2)));
    let (fixed, whole) = (timed(&least)?, timed(&some)?);
    Ok(fixed + (whole - fixed).max(0.0) * blends(camera)? / blends(&some)?.max(1.0))
}

fn scaled(camera: &Camera, factor: f64) -> Camera {
    Camera { pose: camera.pose, intrinsics: camera.intrinsics.scaled(factor) }
}

/// The middle of a picture, at most so many pixels.
fn middle(camera: &Camera, size_px: [u32; 2]) -> Camera {
    let whole = camera.intrinsics;
    let (width, height) = (size_px[0].min(whole.width), size_px[1].min(whole.height));
    let intrinsics = Intrinsics {
        width,
        height,
        cx_px: whole.cx_px - f64::from(whole.width - width) / 2.0,
        cy_px: whole.cy_px - f64::from(whole.height - height) / 2.0,
        ..whole
    };
    Camera { pose: camera.pose, intrinsics }
}

/// Mean square difference of color, clamped to 0..=1; 0 for equal pictures.
fn mean_square(a: &Frame, b: &Frame) -> f64 {
    10_f64.powf(-a.psnr_db(b) / 10.0)
}

//! Samples of a film: a few frames rendered and encoded like the film, and work counts along its whole path.

use std::path::Path;
use std::time::Instant;

use super::cost::TimeCost;
use crate::pipeline::accuracy::at;
use crate::pipeline::film::{Compared, MovingFrames};
use crate::pipeline::promise::{NUM_PLACES, PathProfile};
use cinesplat_geometry::Camera;
use cinesplat_render::{Quality, RenderError, RenderSettings, Renderer, Rgb8Frame, StageTimes, WorkCounts};
use cinesplat_video::{VideoError, VideoSettings, encode_and_discard};

/// Side of the small pictures over that of the film.
const SMALL_FRAC: f64 = 0.25;
/// Warm-up frames of a run, which are not timed: they allocate memory, and the depth order is reused from the third frame
/// on.
const NUM_WARM: usize = 2;
/// Pixels that are encoded to measure the encoder, in whole frames: five at 1280 x 720.
const ENCODED_PX: usize = 5 * 1280 * 720;
/// Smallest and largest number of frames of the encoded run.
const ENCODED_FRAMES: (usize, usize) = (3, 12);

/// Work counts of the four stages: project, sort, bin, blend.
pub(super) type StageWork = [f64; 4];

/// Renders samples of a film.
pub(super) struct Sampler<'a> {
    pub(super) renderer: &'a Renderer<'a>,
    /// The frames that are rendered.
    pub(super) moving: &'a MovingFrames,
    pub(super) settings: &'a RenderSettings,
}

/// Measurements of whole frames at one quality.
#[derive(Debug, Clone, Default)]
pub(super) struct Samples {
    /// Seconds per stage (project, sort, bin, blend, all else) of the median frame of each run, summed over runs.
    secs: [f64; 5],
    /// Work of these frames, counted on small pictures.
    work: StageWork,
    num_runs: usize,
    /// Time of all timed frames.
    spent: TimeCost,
    num_timed: usize,
    /// Mean square differences to `final`, one per position.
    pub(super) mean_squares: Vec<f64>,
}

impl Sampler<'_> {
    /// Number of frames of the encoded run: fewer if they are larger.
    pub(super) fn num_encoded(&self) -> usize {
        let intrinsics = self.moving.cameras[0].intrinsics;
        let num_pixels = intrinsics.width as usize * intrinsics.height as usize;
        (ENCODED_PX / num_pixels.max(1)).clamp(ENCODED_FRAMES.0, ENCODED_FRAMES.1)
    }

    /// Up to `num` consecutive frames around position `frac` of the film.
    pub(super) fn run(&self, frac: f64, num: usize) -> &[Camera] {
        let cameras = &self.moving.cameras;
        let num = num.min(cameras.len());
        let start = self.place(frac).saturating_sub(num / 2).min(cameras.len() - num);
        &cameras[start..start + num]
    }

    /// The frame at position `frac` of the film, of those that are rendered.
    fn place(&self, frac: f64) -> usize {
        ((self.moving.cameras.len() as f64 * frac) as usize).min(self.moving.cameras.len() - 1)
    }

    /// Work per frame at even positions of the film, in order.
    pub(super) fn path_work(&self) -> Result<Vec<StageWork>, RenderError> {
        let cameras = &self.moving.cameras;
        let num = NUM_PLACES.min(cameras.len());
        let place = |idx: usize| (cameras.len() - 1) * idx / (num - 1).max(1);
        (0..num).map(|idx| self.work_at(&cameras[place(idx)])).collect()
    }

    /// Work of one frame.
    pub(super) fn work_at(&self, camera: &Camera) -> Result<StageWork, RenderError> {
        let small = Camera { pose: camera.pose, intrinsics: camera.intrinsics.scaled(SMALL_FRAC) };
        Ok(work(&self.renderer.render(&small, &at(self.settings, Quality::Standard))?.stats.counts))
    }

    /// Renders a run of frames like a film, adds the times of those after the warm-up, and returns the pictures.
    pub(super) fn render_run(
        &self,
        run: &[Camera],
        quality: Quality,
        samples: &mut Samples,
    ) -> Result<Vec<Rgb8Frame>, RenderError> {
        let settings = at(self.settings, quality);
        let mut frames: Vec<Rgb8Frame> = vec![Rgb8Frame::default(); run.len()];
        let num_warm = if run.len() > NUM_WARM { NUM_WARM } else { run.len() };
        for (frame, camera) in frames.iter_mut().zip(&run[..num_warm]) {
            self.renderer.render_rgb8_into(camera, &settings, frame)?;
        }
        // A film reuses the memory of its pictures.
        frames.iter_mut().for_each(|frame| frame.rgb8.resize(frame_bytes(&run[0]), 1));
        // A run that is shorter than the warm-up is rendered twice; the second time is timed.
        let timed = if run.len() > NUM_WARM { num_warm..run.len() } else { 0..run.len() };
        let mut times = Vec::new();
        for (frame, camera) in frames[timed.clone()].iter_mut().zip(&run[timed]) {
            let (rendered, spent) = TimeCost::measure(|| self.renderer.render_rgb8_into(camera, &settings, frame));
            rendered?;
            times.push((spent, frame.stats.times));
        }
        samples.add(times, self.work_at(&run[run.len() / 2])?);
        Ok(frames)
    }

    /// Adds the difference of each quality to the best frame, at position `frac` of the film.
    pub(super) fn compare(
        &self,
        compared: &Compared<'_>,
        frac: f64,
        qualities: &[Quality],
        samples: &mut [Samples],
    ) -> Result<(), RenderError> {
        let frame_idx = self.moving.numbers[self.place(frac)];
        let found = compared.found(frame_idx, qualities)?;
        samples.iter_mut().zip(found).for_each(|(samples, found)| samples.mean_squares.push(found.mean()));
        Ok(())
    }
}

impl Samples {
    /// Adds the times of a run of at least one frame. The median frame represents the run, so that a burst of load from
    /// another process does not count.
    fn add(&mut self, mut times: Vec<(TimeCost, StageTimes)>, work: StageWork) {
        self.spent = times.iter().fold(self.spent, |sum, (spent, _)| sum.plus(*spent));
        self.num_timed += times.len();
        times.sort_by(|(a, _), (b, _)| a.wall_secs.total_cmp(&b.wall_secs));
        let (spent, stages) = times[(times.len() - 1) / 2];
        let rest = spent.wall_secs - stages.total().as_secs_f64();
        let stages = [stages.project, stages.sort, stages.bin, stages.blend].map(|stage| stage.as_secs_f64());
        self.secs.iter_mut().zip(stages).for_each(|(sum, secs)| *sum += secs);
        self.secs[4] += rest.max(0.0);
        add(&mut self.work, work);
        self.num_runs += 1;
    }

    /// Mean wall time of a timed frame in seconds.
    pub(super) fn mean_secs(&self) -> f64 {
        self.spent.wall_secs / self.num_timed.max(1) as f64
    }

    /// Time of frames along the path over that of the mean frame.
    pub(super) fn profile(&self, path: &[StageWork]) -> PathProfile {
        let mean = self.frame(mean_work(path)).wall_secs;
        let share = |work: &StageWork| if mean > 0.0 { self.frame(*work).wall_secs / mean } else { 1.0 };
        PathProfile::new(&path.iter().map(share).collect::<Vec<_>>())
    }

    /// Time of a frame with this work: seconds per unit of work times the work, summed over the stages.
    pub(super) fn frame(&self, work: StageWork) -> TimeCost {
        let share = |stage: usize| if self.work[stage] > 0.0 { work[stage] / self.work[stage] } else { 0.0 };
        let stages: f64 = (0..4).map(|stage| self.secs[stage] * share(stage)).sum();
        let wall_secs = stages + self.secs[4] / self.num_runs.max(1) as f64;
        let num_busy = if self.spent.wall_secs > 0.0 { self.spent.cpu_secs / self.spent.wall_secs } else { 1.0 };
        TimeCost { wall_secs, cpu_secs: wall_secs * num_busy }
    }
}

/// Mean work per frame over the whole film.
pub(super) fn mean_work(path: &[StageWork]) -> StageWork {
    let mut sum = StageWork::default();
    path.iter().for_each(|work| add(&mut sum, *work));
    sum.map(|work| work / path.len().max(1) as f64)
}

/// Encoding time of the first frame, of each further frame, and of a frame that equals the one before.
pub(super) fn encode_cost(
    output: &Path,
    video: &VideoSettings,
    run: &[Rgb8Frame],
    counts_still: bool,
) -> Result<[TimeCost; 3], VideoError> {
    let spent = |frames: &[&[u8]]| {
        let (encoded, spent) = TimeCost::measure(|| encode_and_discard(output, video, frames));
        encoded.map(|()| spent)
    };
    let frames: Vec<&[u8]> = run.iter().map(|frame| frame.rgb8.as_slice()).collect();
    let all = spent(&frames)?;
    let first = if frames.len() > 1 { spent(&frames[..1])? } else { all };
    // The first frame of a run is not predicted from another one; it costs more than those that follow.
    let further = |all: TimeCost| all.beyond(first).times(1.0 / (frames.len().max(2) - 1) as f64);
    let still = if counts_still { further(spent(&vec![frames[0]; frames.len().max(2)])?) } else { TimeCost::default() };
    Ok([first, further(all), still])
}

fn frame_bytes(camera: &Camera) -> usize {
    camera.intrinsics.width as usize * camera.intrinsics.height as usize * 3
}

fn work(counts: &WorkCounts) -> StageWork {
    [counts.num_projected, counts.num_splats, counts.num_pairs, counts.num_block_blends].map(|count| count as f64)
}

fn add(sum: &mut StageWork, work: StageWork) {
    sum.iter_mut().zip(work).for_each(|(sum, work)| *sum += work);
}

/// A limit on the time since its creation.
pub(super) struct TimeLimit {
    start: Instant,
    secs: f64,
}

impl TimeLimit {
    pub(super) fn new(secs: f64) -> Self {
        Self { start: Instant::now(), secs }
    }

    /// Whether work of `secs` seconds still fits.
    pub(super) fn allows(&self, secs: f64) -> bool {
        self.start.elapsed().as_secs_f64() + secs <= self.secs
    }
}

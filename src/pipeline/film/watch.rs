use std::collections::{BTreeMap, VecDeque};
use std::ops::Range;
use std::time::{Duration, Instant};
use strum::VariantArray;

use super::compared::{Compared, Found};
use super::effects::Filmed;
use crate::pipeline::accuracy::psnr_db;
use crate::pipeline::promise::{Level, Pace, Promise, margin_db, rank};
use cinesplat_render::{Quality, RenderError, RenderSettings, Renderer};
use cinesplat_trajectory::Shot;

/// Frames from one check of the accuracy to the next, where no effects change them. The error of samples changes from frame to
/// frame with their number.
const CHECK_STEP: usize = 8;
/// Frames whose time is compared with the forecast.
const NUM_RECENT: usize = 8;
/// Frames that must be timed before the film may step down: the first ones allocate memory.
const NUM_BEFORE: usize = 3;
/// Time that the rest of the film must leave free: a factor, and what closing the file may take at the forecast speed of
/// the machine. A film of 2 s ended 0.2 s late with 0.08 s.
const REST_MARGIN: f64 = 1.12;
const REST_RESERVE_SECS: f64 = 0.15;

/// Keeps the promises of a film while it is made: decides the quality of every frame before it is rendered.
///
/// For a least PSNR, frames at even distances and at cuts are compared ahead of the frames between them with `final` and, if
/// they have effects, with the samples of `reference`; where one falls short, the frames beside it get the next better
/// quality. For a deadline, the time of the last frames tells
/// how much slower than forecast the machine is; the film steps down as soon as the rest would be late, and stays there.
pub(super) struct QualityWatch<'a> {
    compared: Compared<'a>,
    promise: &'a Promise,
    frames: Range<usize>,
    /// Frames that are checked, in order; the first and the last frame among them.
    checks: Vec<usize>,
    /// Mean square difference of checked frames to those of `reference`, by the rank of their level.
    differences: BTreeMap<(usize, (u8, bool)), f64>,
    /// The best quality that time allows.
    allowed: Quality,
    /// Measured and forecast seconds of the last frames: of rendering, and of the film.
    recent: VecDeque<[f64; 4]>,
    last_start: Option<Instant>,
    num_timed: usize,
}

impl<'a> QualityWatch<'a> {
    pub(super) fn new(
        (renderer, filmed): (&'a Renderer<'a>, &'a Filmed<'a>),
        settings: &'a RenderSettings,
        (shot, frames): (&Shot, Range<usize>),
        promise: &'a Promise,
    ) -> Self {
        Self {
            compared: Compared { renderer, filmed, settings },
            promise,
            checks: checked_frames(shot, &frames, if filmed.develops() { 1 } else { CHECK_STEP }),
            frames,
            differences: BTreeMap::new(),
            allowed: settings.quality,
            recent: VecDeque::new(),
            last_start: None,
            num_timed: 0,
        }
    }

    /// The frames from one on.
    pub(super) fn rest_from(&self, frame_idx: usize) -> Range<usize> {
        frame_idx..self.frames.end
    }

    /// How a frame is rendered. Frames are asked for in order.
    pub(super) fn level_of(&mut self, frame_idx: usize) -> Result<Level, RenderError> {
        if let Some(deadline) = self.promise.deadline {
            self.step_down(frame_idx, deadline);
        }
        let allowed = Level::of(self.allowed);
        self.promise.min_psnr_db.map_or(Ok(allowed), |least| self.least_sufficient(frame_idx, least))
    }

    /// Takes account of the time of a frame.
    pub(super) fn rendered(&mut self, frame_idx: usize, quality: Quality, render: Duration) {
        let now = Instant::now();
        let before = self.last_start.replace(now);
        let Some(pace) = self.pace_of(quality) else { return };
        let share = pace.profile.at(self.frac_of(frame_idx));
        let wall_secs = before.map_or(render, |before| now - before).as_secs_f64();
        self.recent.push_back([render.as_secs_f64(), pace.render_secs * share, wall_secs, pace.film_secs * share]);
        if self.recent.len() > NUM_RECENT {
            self.recent.pop_front();
        }
        self.num_timed += 1;
    }

    /// The least accurate level, from the quality that time allows, with which the checks beside a frame have the least PSNR.
    fn least_sufficient(&mut self, frame_idx: usize, least_db: f64) -> Result<Level, RenderError> {
        let after = self.checks.partition_point(|check| *check < frame_idx);
        let beside = [after.saturating_sub(1), after].map(|at| self.checks.get(at).copied());
        // A check that is behind is not asked for again.
        if let Some(from) = beside[0] {
            self.differences.retain(|(check, _), _| *check >= from);
        }
        let allowed = rank(self.allowed);
        let levels = Quality::VARIANTS.iter().copied().map(Level::of);
        let mut levels: Vec<Level> = levels.filter(|level| rank(level.quality) >= allowed).collect();
        // Without effects there are no samples.
        if self.compared.filmed.develops() && self.allowed != Quality::Reference {
            levels.insert(levels.len() - 1, Level::FINEST);
        }
        for level in levels {
            let needed_db = least_db + margin_db(level.quality);
            if level.quality == Quality::Reference {
                return Ok(level);
            }
            if self.promise.final_db < needed_db {
                continue;
            }
            let mut worst_db = f64::INFINITY;
            for check in beside.iter().flatten() {
                let difference = self.difference(*check, level)?;
                worst_db = worst_db.min(psnr_db(std::iter::once(difference), self.promise.final_db));
            }
            // Where every frame is checked, the margin for those between checks is not needed.
            if worst_db >= if self.compared.filmed.develops() { least_db } else { needed_db } {
                return Ok(level);
            }
        }
        Ok(Level::of(Quality::Reference))
    }

    /// Mean square difference of a frame to that of `reference`, apart from that of `final` without effects.
    fn difference(&mut self, frame_idx: usize, level: Level) -> Result<f64, RenderError> {
        let key = |level: Level| (frame_idx, level.rank());
        if let Some(known) = self.differences.get(&key(level)) {
            return Ok(*known);
        }
        if self.compared.filmed.develops() {
            // `draft` is never enough, and nothing is missing from `reference`.
            let qualities = [Quality::Standard, Quality::Final];
            let found = self.compared.found(frame_idx, &qualities)?;
            let bounds = qualities.map(Level::of).into_iter().zip(found.iter().map(Found::bound));
            self.differences.extend(bounds.map(|(level, bound)| (key(level), bound)));
            self.differences.insert(key(Level::FINEST), self.compared.floor(frame_idx)?);
        } else if level.quality == Quality::Final {
            return Ok(0.0);
        } else {
            let found = self.compared.mean_square(frame_idx, level.quality, &self.compared.best(frame_idx)?)?;
            self.differences.insert(key(level), found);
        }
        Ok(self.differences.get(&key(level)).copied().unwrap_or(f64::INFINITY))
    }

    /// Lowers the allowed quality if the rest of the film, from a frame on, would not be whole by the deadline.
    fn step_down(&mut self, frame_idx: usize, deadline: Instant) {
        let left_secs = deadline.saturating_duration_since(Instant::now()).as_secs_f64();
        let reserve_secs = REST_RESERVE_SECS * self.slowdown().max(1.0);
        let is_in_time = |pace: &Pace| self.rest_secs(pace, frame_idx) * REST_MARGIN + reserve_secs <= left_secs;
        if self.num_timed < NUM_BEFORE || self.pace_of(self.allowed).is_none_or(|pace| is_in_time(&pace)) {
            return;
        }
        let faster = || self.promise.paces.iter().filter(|pace| rank(pace.quality) < rank(self.allowed));
        let chosen = faster().rfind(|pace| is_in_time(pace)).or(faster().next());
        self.allowed = chosen.map_or(self.allowed, |pace| pace.quality);
    }

    /// Seconds of the rest of the film at a pace, at the speed of the last frames.
    fn rest_secs(&self, pace: &Pace, frame_idx: usize) -> f64 {
        let num_left = self.frames.end.saturating_sub(frame_idx);
        let waiting = pace.num_ahead.min(frame_idx - self.frames.start) as f64;
        let frames = num_left as f64 * pace.profile.mean_from(self.frac_of(frame_idx));
        self.slowdown() * (frames * pace.film_secs + waiting * pace.encode_secs)
    }

    /// Time of the last frames over their forecast.
    fn slowdown(&self) -> f64 {
        let sums = self.recent.iter().fold([0.0; 4], |sums: [f64; 4], row| std::array::from_fn(|k| sums[k] + row[k]));
        let over = |measured: f64, expected: f64| if expected > 0.0 { measured / expected } else { 1.0 };
        over(sums[0], sums[1]).max(over(sums[2], sums[3]))
    }

    fn pace_of(&self, quality: Quality) -> Option<Pace> {
        self.promise.paces.iter().find(|pace| pace.quality == quality).copied()
    }

    fn frac_of(&self, frame_idx: usize) -> f64 {
        (frame_idx - self.frames.start) as f64 / self.frames.len().max(1) as f64
    }
}

/// Frames `step` apart, the first and the last one, and the two at every cut.
fn checked_frames(shot: &Shot, frames: &Range<usize>, step: usize) -> Vec<usize> {
    let after_cut = |time_secs: f64| (0..shot.num_frames()).find(|idx| shot.frame_time_secs(*idx) >= time_secs - 1e-9);
    let cuts = shot.keyframes.iter().filter(|key| key.cut).filter_map(|key| after_cut(key.time_secs));
    let beside = cuts.flat_map(|idx| [idx.saturating_sub(1), idx]);
    let last = frames.end.saturating_sub(1);
    let mut checks: Vec<usize> =
        frames.clone().step_by(step).chain([last]).chain(beside).filter(|idx| frames.contains(idx)).collect();
    checks.sort_unstable();
    checks.dedup();
    checks
}

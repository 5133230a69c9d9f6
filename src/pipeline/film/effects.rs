use std::ops::Range;
use std::time::Instant;

use crate::pipeline::error::PipelineError;
use crate::pipeline::film::cameras::path_camera;
use cinesplat_geometry::Camera;
use cinesplat_lens::{
    Budget, Call, Called, CalledEffect, Calls, EffectChoice, EffectPlan, Moment, OpticsTrack, Picture, Take,
};
use cinesplat_render::{Quality, RenderError, RenderSettings, Renderer, Rgb8Frame};
use cinesplat_trajectory::{CameraPath, EffectRequest, Shot, TrajectoryError};

/// Size of a scene over its near plane, where the scene itself is not at hand.
const SIZE_OF_NEAR: f64 = 100.0;
/// Frames of a film that are examined for the cost of its effects.
const NUM_COSTED: usize = 12;

/// The effects that a shot calls for by its `effects` and its keyframes.
///
/// `scene_size` is the scale of settings that the shot leaves out.
pub fn called_effects(shot: &Shot, choice: &EffectChoice, scene_size: f64) -> Called {
    let calls: Vec<Call> = shot.effects.iter().map(Call::of_request).collect();
    let keyframes = &shot.keyframes;
    let seed = shot.seed;
    Called::of(choice, &Calls { calls: &calls, forbidden: &[], moves: &[], keyframes, scene_size, seed })
}

/// Frames that a film renders, at least one.
#[derive(Debug, Clone)]
pub(in crate::pipeline) struct MovingFrames {
    /// Their numbers in the shot, ascending.
    pub(in crate::pipeline) numbers: Vec<usize>,
    /// Their cameras.
    pub(in crate::pipeline) cameras: Vec<Camera>,
}

/// How the effects of some frames are planned.
type PlanOf<'a> = fn(&Filmed<'a>, Range<usize>, (&Renderer<'_>, &RenderSettings)) -> Result<EffectPlan, RenderError>;

/// The camera of a shot, frame by frame, with its effects.
pub(in crate::pipeline) struct Filmed<'a> {
    path: CameraPath,
    shot: &'a Shot,
    called: Vec<CalledEffect>,
    optics: OpticsTrack,
}

impl<'a> Filmed<'a> {
    pub(in crate::pipeline) fn new(
        shot: &'a Shot,
        choice: &EffectChoice,
        render: &RenderSettings,
    ) -> Result<Self, TrajectoryError> {
        let path = CameraPath::new(shot)?;
        let called = called_effects(shot, choice, SIZE_OF_NEAR * render.near).effects;
        Ok(Self { path, shot, called, optics: OpticsTrack::new(&shot.keyframes) })
    }

    /// The camera of a frame, with the motion that effects add.
    pub(in crate::pipeline) fn camera(&self, frame_idx: usize) -> Camera {
        self.camera_at(self.shot.frame_time_secs(frame_idx))
    }

    /// The frames that a film renders. Frames with the camera of the frame before, and with effects in the same state, are
    /// not rendered again.
    pub(in crate::pipeline) fn moving_frames(&self, frames: Range<usize>) -> MovingFrames {
        let seen = |frame_idx: usize| {
            self.with_take(|take| {
                let moment = Moment::of_frame(take, frame_idx, &RenderSettings::default());
                let developing = self.called.iter().filter(|called| called.effect.develops());
                let states: Option<Vec<_>> = developing.map(|called| called.effect.state(&moment)).collect();
                (moment.camera, states)
            })
        };
        let mut seen: Vec<_> = frames.map(|frame_idx| (frame_idx, seen(frame_idx))).collect();
        seen.dedup_by(|(_, next), (_, last)| last == next && next.1.is_some());
        let (numbers, cameras) = seen.into_iter().map(|(frame_idx, (camera, _))| (frame_idx, camera)).unzip();
        MovingFrames { numbers, cameras }
    }

    fn camera_at(&self, time_secs: f64) -> Camera {
        EffectPlan::moved(&self.called, path_camera(&self.path, self.shot, time_secs), time_secs)
    }

    /// Whether an effect changes pictures.
    pub(in crate::pipeline) fn develops(&self) -> bool {
        self.called.iter().any(|called| called.effect.develops())
    }

    /// Calls `work` with the source of the shot's cameras.
    fn with_take<T>(&self, work: impl FnOnce(Take<'_>) -> T) -> T {
        let camera_at = |time_secs: f64| self.camera_at(time_secs);
        work(Take {
            camera_at: &camera_at,
            optics: &self.optics,
            up: self.shot.scene.up,
            fps: self.shot.fps,
            seed: self.shot.seed,
        })
    }

    /// The effects of some frames.
    pub(in crate::pipeline) fn plan(
        &self,
        frames: Range<usize>,
        (renderer, render): (&Renderer<'_>, &RenderSettings),
    ) -> Result<EffectPlan, RenderError> {
        self.with_take(|take| EffectPlan::of(&self.called, take, frames, (renderer, render)))
    }

    /// As [`Filmed::plan`], with the samples of `reference` whatever the quality of `render`.
    pub(in crate::pipeline) fn plan_finest(
        &self,
        frames: Range<usize>,
        (renderer, render): (&Renderer<'_>, &RenderSettings),
    ) -> Result<EffectPlan, RenderError> {
        let budget = Budget::of(Quality::Reference);
        self.with_take(|take| EffectPlan::within(budget, &self.called, take, frames, (renderer, render)))
    }

    /// A frame with the effects that run on it.
    pub(in crate::pipeline) fn expose(
        &self,
        plan: &EffectPlan,
        frame_idx: usize,
        (renderer, render): (&Renderer<'_>, &RenderSettings),
    ) -> Result<Picture, RenderError> {
        self.with_take(|take| plan.expose(&Moment::of_frame(take, frame_idx, render), renderer))
    }

    /// A part of a frame, whose camera is given, with those effects that work on parts.
    pub(in crate::pipeline) fn expose_part(
        &self,
        plan: &EffectPlan,
        (frame_idx, part): (usize, Camera),
        (renderer, render): (&Renderer<'_>, &RenderSettings),
    ) -> Result<Picture, RenderError> {
        self.with_take(|take| plan.expose_part(&Moment::of_frame(take, frame_idx, render).with_camera(part), renderer))
    }

    /// A frame in 8 bits. Without effects the plain renderer makes it.
    pub(in crate::pipeline) fn render_rgb8(
        &self,
        plan: &EffectPlan,
        frame_idx: usize,
        (renderer, render): (&Renderer<'_>, &RenderSettings),
        into: &mut Rgb8Frame,
    ) -> Result<(), RenderError> {
        if plan.is_plain(frame_idx) {
            return renderer.render_rgb8_into(&self.camera(frame_idx), render, into);
        }
        self.expose(plan, frame_idx, (renderer, render))?.into_rgb8(into);
        Ok(())
    }

    /// Time of a frame with the effects over that of a plain one, as a mean over the film. Frames are planned at even
    /// positions. Those with the fewest samples, the most, and the middle one are measured; the others lie between
    /// them: samples share work, so that time does not grow in proportion. `reference`, which shares nothing, is not measured.
    pub(in crate::pipeline) fn cost_factor(
        &self,
        frames: &Range<usize>,
        (renderer, render): (&Renderer<'_>, &RenderSettings),
    ) -> Result<f64, RenderError> {
        if !self.develops() {
            return Ok(1.0);
        }
        if render.quality == Quality::Reference {
            let render = RenderSettings { quality: Quality::Final, ..*render };
            let pictures = self.mean_pictures(frames, (renderer, &render))?;
            return Ok(self.cost_factor(frames, (renderer, &render))?.max(pictures));
        }
        self.cost_of(Self::plan, frames, (renderer, render))
    }

    /// As [`Filmed::cost_factor`], with the samples of `reference`.
    pub(in crate::pipeline) fn finest_factor(
        &self,
        frames: &Range<usize>,
        (renderer, render): (&Renderer<'_>, &RenderSettings),
    ) -> Result<f64, RenderError> {
        self.cost_of(Self::plan_finest, frames, (renderer, render))
    }

    fn cost_of(
        &self,
        plan_of: PlanOf<'a>,
        frames: &Range<usize>,
        (renderer, render): (&Renderer<'_>, &RenderSettings),
    ) -> Result<f64, RenderError> {
        let num = costed(frames).len();
        let mut planned = Vec::new();
        for frame_idx in costed(frames) {
            let plan = plan_of(self, frame_idx..frame_idx + 1, (renderer, render))?;
            if !plan.is_plain(frame_idx) {
                planned.push((plan.num_samples(frame_idx), frame_idx, plan));
            }
        }
        planned.sort_by_key(|(samples, frame_idx, _)| (*samples, *frame_idx));
        let Some(last) = planned.len().checked_sub(1) else { return Ok(1.0) };
        let mut places = vec![0, last / 2, last];
        places.dedup();
        let mut measured = Vec::new();
        for place in places {
            let (samples, frame_idx, plan) = &planned[place];
            measured.push((*samples, self.measured_factor(plan, *frame_idx, (renderer, render))?));
        }
        let with_effects: f64 = planned.iter().map(|(samples, ..)| between(&measured, *samples)).sum();
        Ok(((num - planned.len()) as f64 + with_effects) / num as f64)
    }

    /// Pictures that a frame takes with the samples of `reference`, as a mean over the film.
    fn mean_pictures(
        &self,
        frames: &Range<usize>,
        (renderer, render): (&Renderer<'_>, &RenderSettings),
    ) -> Result<f64, RenderError> {
        let num_pictures = |frame_idx: usize| -> Result<f64, RenderError> {
            let plan = self.plan_finest(frame_idx..frame_idx + 1, (renderer, render))?;
            Ok(f64::from(plan.num_samples(frame_idx)))
        };
        let pictures: Vec<f64> = costed(frames).map(num_pictures).collect::<Result<_, _>>()?;
        Ok(pictures.iter().sum::<f64>() / pictures.len() as f64)
    }

    /// Time of a frame with effects over that of the plain frame.
    fn measured_factor(
        &self,
        plan: &EffectPlan,
        frame_idx: usize,
        (renderer, render): (&Renderer<'_>, &RenderSettings),
    ) -> Result<f64, RenderError> {
        let mut frame = Rgb8Frame::default();
        let mut secs = [0.0, 0.0];
        // The first time allocates memory.
        for _ in 0..2 {
            let start = Instant::now();
            renderer.render_rgb8_into(&self.camera(frame_idx), render, &mut frame)?;
            secs[0] = start.elapsed().as_secs_f64();
            let start = Instant::now();
            self.render_rgb8(plan, frame_idx, (renderer, render), &mut frame)?;
            secs[1] = start.elapsed().as_secs_f64();
        }
        Ok(secs[1] / secs[0].max(1e-9))
    }

    /// Entries of the effects without the frames that they run on: what the frames depend on.
    pub(in crate::pipeline) fn requests(called: &Called) -> Vec<EffectRequest> {
        called.effects.iter().map(CalledEffect::request).collect()
    }
}

/// The frames that are examined for the cost of effects, at least one: at even positions.
fn costed(frames: &Range<usize>) -> impl ExactSizeIterator<Item = usize> {
    let (start, len) = (frames.start, frames.len());
    let num = NUM_COSTED.min(len).max(1);
    (0..num).map(move |idx| start + (2 * idx + 1) * len / (2 * num))
}

/// The factor of a frame with this many samples, on a line through measured numbers of samples and factors; factors of
/// one number count as their mean, and beyond the ends the nearest number counts.
fn between(measured: &[(u32, f64)], samples: u32) -> f64 {
    let mean = |number: u32| {
        let own: Vec<f64> = measured.iter().filter(|point| point.0 == number).map(|point| point.1).collect();
        own.iter().sum::<f64>() / own.len().max(1) as f64
    };
    let numbers = || measured.iter().map(|point| point.0);
    match (numbers().filter(|number| *number <= samples).max(), numbers().filter(|number| *number >= samples).min()) {
        (Some(below), Some(above)) if above > below => {
            let share = f64::from(samples - below) / f64::from(above - below);
            mean(below) + (mean(above) - mean(below)) * share
        }
        (Some(number), _) | (None, Some(number)) => mean(number),
        (None, None) => 1.0,
    }
}

/// The plan of effects for the frames of a film.
///
/// # Errors
/// [`PipelineError::Trajectory`] for keyframes that make no path, [`PipelineError::Render`].
pub fn plan_effects(
    (renderer, render): (&Renderer<'_>, &RenderSettings),
    shot: &Shot,
    choice: &EffectChoice,
) -> Result<EffectPlan, PipelineError> {
    let filmed = Filmed::new(shot, choice, render)?;
    Ok(filmed.plan(0..shot.num_frames(), (renderer, render))?)
}

/// Completes the effects of a shot: those that its keyframes call for are added, those that the user excludes are removed,
/// and every setting has a value. Returns the calls.
pub fn complete_effects(shot: &mut Shot, choice: &EffectChoice, scene_size: f64) -> Called {
    let called = called_effects(shot, choice, scene_size);
    let is_kept = |request: &EffectRequest| {
        called.unmet.iter().any(|unmet| unmet.is_missing() && unmet.call.name == request.kind)
    };
    let missing: Vec<EffectRequest> = shot.effects.iter().filter(|request| is_kept(request)).cloned().collect();
    shot.effects = Filmed::requests(&called);
    shot.effects.extend(missing);
    called
}

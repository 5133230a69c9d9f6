//! Which effects run on which frames, as data.

use std::ops::Range;
use std::sync::Arc;

use cinesplat_geometry::Camera;
use cinesplat_render::{Frame, RenderError, RenderSettings, Renderer};
use cinesplat_trajectory::{EffectRequest, EffectRuns, Shot};

use super::budget::{Budget, Loss};
use super::called::CalledEffect;
use super::effect::Effect;
use super::eyes::EyeLayout;
use super::kinds::KINDS;
use super::light::Picture;
use super::moment::{Moment, Take};
use super::seen::FrameFacts;

/// The effects of a film, and the frames that they run on.
#[derive(Debug, Clone, Default)]
pub struct EffectPlan {
    /// The effects that the shot calls for, outermost layer first.
    pub effects: Vec<PlannedEffect>,
    /// First frame that was examined.
    first_frame: usize,
    /// See [`EffectPlan::forced`].
    is_forced: bool,
    /// The errors that its frames may have; `None` for those of the quality that they are rendered at.
    budget: Option<Budget>,
}

/// An effect of a film.
#[derive(Debug, Clone)]
pub struct PlannedEffect {
    /// Its name.
    pub name: &'static str,
    /// What calls for it.
    pub because: String,
    effect: Arc<dyn Effect>,
    /// Whether it sees the camera as an effect outside it shows it ([`Effect::seen_through`]).
    is_inside: bool,
    /// What leaving it out would cost, per frame.
    losses: Vec<Loss>,
    /// See [`Effect::state`], per frame.
    states: Vec<Option<Vec<f64>>>,
}

impl EffectPlan {
    /// Asks every effect on every frame what leaving it out would cost, against the budget of the quality.
    ///
    /// # Errors
    /// Those of the renderer, where the answer depends on what is seen.
    pub fn of(
        called: &[CalledEffect],
        take: Take<'_>,
        frames: Range<usize>,
        (renderer, render): (&Renderer<'_>, &RenderSettings),
    ) -> Result<Self, RenderError> {
        Self::within(Budget::of(render.quality), called, take, frames, (renderer, render))
    }

    /// As [`EffectPlan::of`], against another budget: [`EffectPlan::expose`] takes the samples that it asks for.
    ///
    /// # Errors
    /// Those of [`EffectPlan::of`].
    pub fn within(
        budget: Budget,
        called: &[CalledEffect],
        take: Take<'_>,
        frames: Range<usize>,
        (renderer, render): (&Renderer<'_>, &RenderSettings),
    ) -> Result<Self, RenderError> {
        let mut is_inside = false;
        let camera = (take.camera_at)(0.0);
        let planned = |called: &CalledEffect| {
            let CalledEffect { name, effect, because, .. } = called.clone();
            let losses = Vec::with_capacity(frames.len());
            let states = Vec::with_capacity(frames.len());
            let planned = PlannedEffect { name, because, effect, is_inside, losses, states };
            is_inside |= planned.effect.seen_through(camera, take.up).is_some();
            planned
        };
        let mut effects: Vec<PlannedEffect> = called.iter().map(planned).collect();
        if effects.is_empty() {
            return Ok(Self { effects, first_frame: frames.start, ..Self::default() });
        }
        let inside_at = |time_secs: f64| {
            let camera = (take.camera_at)(time_secs);
            let shown = called.iter().find_map(|called| called.effect.seen_through(camera, take.up));
            shown.unwrap_or(camera)
        };
        let inside = Take { camera_at: &inside_at, ..take };
        let changes = |called: &&CalledEffect| called.effect.develops() && !called.effect.shares_samples();
        let is_changed = called.iter().filter(changes).count() > 1;
        let facts_of = |frame_idx: usize| {
            [take, inside].map(|take| {
                let mut facts =
                    FrameFacts::new(Moment { budget, ..Moment::of_frame(take, frame_idx, render) }, renderer);
                facts.is_changed = is_changed;
                facts
            })
        };
        let first = facts_of(0);
        for planned in &mut effects {
            if let Some(measured) = planned.effect.measured(&first[usize::from(planned.is_inside)])? {
                planned.effect = measured;
                planned.because = because_of(&planned.because, planned.effect());
            }
        }
        for frame_idx in frames.clone() {
            let facts = facts_of(frame_idx);
            for planned in &mut effects {
                let facts = &facts[usize::from(planned.is_inside)];
                planned.losses.push(planned.effect.error_if_skipped(facts, &budget)?);
                planned.states.push(planned.effect.state(&facts.moment));
            }
        }
        Ok(Self { effects, first_frame: frames.start, is_forced: false, budget: Some(budget) })
    }

    /// The plan in which every effect runs on every frame, with the samples of the frame that needs most in every part of it:
    /// what a film costs whose frames are not looked at before.
    #[must_use]
    pub fn forced(mut self) -> Self {
        for planned in &mut self.effects {
            let samples = planned.losses.iter().map(|loss| loss.samples).max().unwrap_or(1);
            planned.losses.iter_mut().for_each(|loss| loss.samples = samples);
        }
        self.everywhere()
    }

    /// The plan in which every effect runs on every frame and in every part of it, with the samples that the frame needs:
    /// what is skipped is the only difference.
    #[must_use]
    pub fn everywhere(mut self) -> Self {
        self.is_forced = true;
        let losses = self.effects.iter_mut().flat_map(|planned| &mut planned.losses);
        losses.for_each(|loss| loss.error = f64::INFINITY);
        self
    }

    /// A camera of the path, as the effects move it.
    pub fn moved(called: &[CalledEffect], camera: Camera, time_secs: f64) -> Camera {
        called.iter().rev().fold(camera, |camera, called| called.effect.moved(camera, time_secs))
    }

    /// The layers of a frame, outermost first, with their samples.
    fn layers(&self, frame_idx: usize) -> Vec<(&dyn Effect, u32)> {
        let layer = |planned: &'_ PlannedEffect| self.layer_samples(planned, frame_idx);
        let layered = |planned| Some((PlannedEffect::effect(planned), layer(planned)?));
        self.effects.iter().filter_map(layered).collect()
    }

    /// Samples of an effect on a frame; `None` where it does not run.
    fn layer_samples(&self, planned: &PlannedEffect, frame_idx: usize) -> Option<u32> {
        let loss = planned.losses.get(frame_idx.checked_sub(self.first_frame)?)?;
        (loss.shows() && planned.effect.develops()).then_some(loss.samples)
    }

    /// Whether the plain renderer makes a frame.
    pub fn is_plain(&self, frame_idx: usize) -> bool {
        self.layers(frame_idx).is_empty()
    }

    /// Whether a frame has the picture of another one with the same camera: the same effects with the same samples, in the
    /// same state.
    pub fn repeats(&self, frame_idx: usize, other_idx: usize) -> bool {
        let state =
            |planned: &PlannedEffect, idx: usize| planned.states.get(idx.checked_sub(self.first_frame)?)?.clone();
        self.effects.iter().all(|planned| {
            let [this, other] =
                [frame_idx, other_idx].map(|idx| (self.layer_samples(planned, idx), state(planned, idx)));
            this.0 == other.0 && (this.0.is_none() || this.1.is_some() && this.1 == other.1)
        })
    }

    /// Whether the film carries how much of each pixel the scene covers.
    pub fn is_transparent(&self) -> bool {
        self.effects.iter().any(|planned| planned.effect.is_transparent())
    }

    /// Whether the film shows all directions.
    pub fn is_panorama(&self) -> bool {
        self.effects.iter().any(|planned| planned.effect.is_panorama())
    }

    /// How the film holds one view per eye; `None` for a single view.
    pub fn eyes(&self) -> Option<EyeLayout> {
        self.effects.iter().find_map(|planned| planned.effect.eyes())
    }

    /// Pictures' worth of work that a frame takes: the product over its effects, of which lens and shutter share their
    /// samples.
    pub fn num_samples(&self, frame_idx: usize) -> u32 {
        let layers = self.layers(frame_idx);
        let (exposing, others): (Vec<_>, Vec<_>) = layers.into_iter().partition(|(effect, _)| effect.shares_samples());
        let pictures = |(effect, samples): &(&dyn Effect, u32)| effect.num_pictures(*samples);
        let shared = exposing.iter().map(pictures).max().unwrap_or(1);
        others.iter().map(pictures).fold(shared, u32::saturating_mul)
    }

    /// Whether lens or shutter take several samples of a frame.
    pub fn is_sampled(&self, frame_idx: usize) -> bool {
        self.layers(frame_idx).iter().any(|(effect, samples)| effect.shares_samples() && *samples > 1)
    }

    /// The picture of a moment with the effects that run on its frame.
    ///
    /// # Errors
    /// Those of the renderer.
    pub fn expose(&self, moment: &Moment<'_>, renderer: &Renderer<'_>) -> Result<Picture, RenderError> {
        expose(&self.layers(moment.frame_idx), &self.allowed(moment), renderer)
    }

    /// As [`EffectPlan::expose`], of a part of the frame: the principal point of the moment's camera is as far outside of it as
    /// the part is off. Effects that need the whole frame are left out ([`Effect::is_local`]).
    ///
    /// # Errors
    /// Those of the renderer.
    pub fn expose_part(&self, moment: &Moment<'_>, renderer: &Renderer<'_>) -> Result<Picture, RenderError> {
        let mut layers = self.layers(moment.frame_idx);
        layers.retain(|(effect, _)| effect.is_local());
        expose(&layers, &self.allowed(moment), renderer)
    }

    /// The moment with the errors that its frame may have.
    fn allowed<'a>(&self, moment: &Moment<'a>) -> Moment<'a> {
        let mut moment = moment.clone();
        moment.exposing.is_even |= self.is_forced;
        moment.budget = self.budget.unwrap_or(moment.budget);
        moment
    }

    /// Writes the plan into a shot: settings, frames, samples, and the number that decided.
    pub fn write_to(&self, shot: &mut Shot) {
        let is_planned = |request: &EffectRequest| self.effects.iter().any(|planned| planned.name == request.kind);
        let planned = self.effects.iter().map(PlannedEffect::request);
        let others = shot.effects.iter().filter(|request| !is_planned(request)).cloned();
        shot.effects = planned.chain(others).collect();
    }

    /// One line per effect that is called for, and one for all others.
    pub fn sentences(&self) -> Vec<String> {
        let is_called = |name: &str| self.effects.iter().any(|planned| planned.name == name);
        let rest: Vec<&str> = KINDS.iter().map(|kind| kind.name).filter(|name| !is_called(name)).collect();
        let mut lines: Vec<String> = self.effects.iter().map(PlannedEffect::sentence).collect();
        if !rest.is_empty() {
            lines.push(format!("not called for: {}", rest.join(", ")));
        }
        lines
    }
}

/// The picture of a moment through layers of effects, the outermost first.
fn expose(layers: &[(&dyn Effect, u32)], moment: &Moment<'_>, renderer: &Renderer<'_>) -> Result<Picture, RenderError> {
    if let Some(((effect, samples), inner)) = layers.split_first() {
        return effect.apply(moment, *samples, &mut |asked| expose(inner, asked, renderer));
    }
    let mut frame = Frame::default();
    moment.sampling().take(renderer, &moment.render, &mut frame)?;
    Ok(Picture::of_display(frame))
}

/// The reason for an effect, with what it chose by itself.
fn because_of(because: &str, effect: &dyn Effect) -> String {
    effect.chose().map_or_else(|| because.to_owned(), |chose| format!("{because}: {chose}"))
}

impl PlannedEffect {
    /// Whether it has a part in a frame. What moves the camera moves it on every frame.
    fn runs_on(&self, loss: &Loss) -> bool {
        loss.shows() || !self.effect.develops()
    }

    /// The effect.
    pub fn effect(&self) -> &dyn Effect {
        self.effect.as_ref()
    }

    /// What leaving the effect out would cost, per frame.
    pub fn losses(&self) -> &[Loss] {
        &self.losses
    }

    /// The settings of the effect.
    pub fn settings(&self) -> Vec<(&'static str, f64)> {
        self.effect.settings()
    }

    /// The frames that the effect runs on, as ranges of indices of `losses`.
    fn runs(&self) -> Vec<Range<usize>> {
        let mut runs: Vec<Range<usize>> = Vec::new();
        for (at, _) in self.losses.iter().enumerate().filter(|(_, loss)| self.runs_on(loss)) {
            match runs.last_mut() {
                Some(run) if run.end == at => run.end = at + 1,
                _ => runs.push(at..at + 1),
            }
        }
        runs
    }

    /// Fewest and most samples of the frames that the effect runs on.
    fn samples(&self) -> [u32; 2] {
        let samples = || self.losses.iter().filter(|loss| self.runs_on(loss)).map(|loss| loss.samples);
        [samples().min().unwrap_or(0), samples().max().unwrap_or(0)]
    }

    /// The loss with the largest error, of the frames that show it or of those that do not.
    fn worst(&self, shows: bool) -> Option<Loss> {
        let losses = self.losses.iter().filter(|loss| self.runs_on(loss) == shows);
        losses.max_by(|a, b| a.error.total_cmp(&b.error)).copied()
    }

    fn request(&self) -> EffectRequest {
        let (measure, unit) = self.effect.measure();
        let worst = self.worst(true).or_else(|| self.worst(false));
        let runs = worst.map(|worst| EffectRuns {
            frames: self.runs().into_iter().map(|run| [run.start, run.end]).collect(),
            samples: self.samples(),
            measure: format!("{measure}, {unit}"),
            error: worst.error,
            allowed: worst.allowed,
        });
        EffectRequest { runs, ..request(self.name, self.effect(), &self.because) }
    }

    /// Frames, samples and the number that decided, such as `depth of field: skipped on 180 of 240 frames, circle of
    /// confusion 0.31 px < 0.50`.
    pub fn sentence(&self) -> String {
        let total = self.losses.len();
        let num_on = self.losses.iter().filter(|loss| self.runs_on(loss)).count();
        let (measure, unit) = self.effect.measure();
        let number =
            |loss: Loss, sign: &str| format!("{measure} {} {unit} {sign} {}", shown(loss.error), shown(loss.allowed));
        let mut parts = Vec::new();
        if let Some(worst) = self.worst(true) {
            let samples = match self.samples() {
                [1, 1] => String::new(),
                [a, b] if a == b => format!(", {a} samples per frame"),
                [a, b] => format!(", {a} to {b} samples per frame"),
            };
            parts.push(format!(
                "on {num_on} of {total} frames, {}{samples}",
                number(worst, if worst.shows() { ">" } else { "<" })
            ));
        }
        if let Some(worst) = self.worst(false) {
            parts.push(format!("skipped on {} of {total} frames, {}", total - num_on, number(worst, "<")));
        }
        format!("{}: {} ('{}')", self.name.replace('-', " "), parts.join("; "), self.because)
    }
}

/// The entry of an effect in a shot.
fn request(name: &str, effect: &dyn Effect, because: &str) -> EffectRequest {
    let settings = effect.settings().into_iter().map(|(name, value)| (name.to_owned(), value)).collect();
    EffectRequest { kind: name.to_owned(), because: because.to_owned(), settings, runs: None }
}

impl CalledEffect {
    /// The effect as an entry of a shot, without the frames that it runs on.
    pub fn request(&self) -> EffectRequest {
        request(self.name, self.effect.as_ref(), &self.because)
    }
}

/// A number with two digits after the point, or three significant ones where it is small.
fn shown(value: f64) -> String {
    if value.abs() >= 0.1 || value.abs() <= 0.0 { format!("{value:.2}") } else { format!("{value:.4}") }
}

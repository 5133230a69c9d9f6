//! The focus puller.

use std::sync::Arc;

use cinesplat_render::RenderError;

use super::budget::{Budget, Loss};
use super::calls::{Call, Calls};
use super::depth_of_field::{DepthOfField, RACK_FOCUS, rack_focus_call};
use super::effect::{Effect, EffectKind, Next};
use super::light::Picture;
use super::moment::Moment;
use super::seen::FrameFacts;

/// Diameter of the circle of confusion of the subject that is not in focus, over the frame's height, for words of each
/// degree: at 3.5 % its edges dissolve and everybody sees where the focus is.
const BLUR_BY_DEGREE: [f64; 3] = [0.015, 0.035, 0.06];

/// The focus moves from one subject to another. The keyframes have the distances
/// ([`super::OpticsTrack::focus_distance`]); the rest is depth of field.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RackFocus(pub DepthOfField);

impl EffectKind for RackFocus {
    const NAME: &'static str = RACK_FOCUS;
    const SETTINGS: &'static [&'static str] = DepthOfField::SETTINGS;

    fn call(calls: &Calls<'_>) -> Option<Call> {
        rack_focus_call(calls)
    }

    fn called_for(call: &Call, calls: &Calls<'_>) -> Option<Self> {
        // Words about the aperture count as well.
        let aperture = calls.named(DepthOfField::NAME);
        let more = aperture.map(|aperture| aperture.settings.clone()).unwrap_or_default();
        let settings = call.settings.iter().cloned().chain(more).collect();
        DepthOfField::of_call(&Call { settings, ..call.clone() }, BLUR_BY_DEGREE).map(Self)
    }
}

impl Effect for RackFocus {
    fn settings(&self) -> Vec<(&'static str, f64)> {
        self.0.settings()
    }

    fn measure(&self) -> (&'static str, &'static str) {
        self.0.measure()
    }

    fn chose(&self) -> Option<String> {
        self.0.chose()
    }

    fn shares_samples(&self) -> bool {
        true
    }

    fn is_local(&self) -> bool {
        true
    }

    fn measured(&self, first: &FrameFacts<'_>) -> Result<Option<Arc<dyn Effect>>, RenderError> {
        Ok(Some(Arc::new(Self(self.0.opened_between(first).settled(first)?))))
    }

    fn error_if_skipped(&self, frame: &FrameFacts<'_>, budget: &Budget) -> Result<Loss, RenderError> {
        self.0.error_if_skipped(frame, budget)
    }

    fn state(&self, moment: &Moment<'_>) -> Option<Vec<f64>> {
        self.0.state(moment)
    }

    fn apply(&self, moment: &Moment<'_>, samples: u32, next: Next<'_>) -> Result<Picture, RenderError> {
        self.0.apply(moment, samples, next)
    }
}

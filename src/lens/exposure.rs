//! More or less light than the scene was trained with.

use cinesplat_render::RenderError;

use super::budget::{Budget, Loss};
use super::calls::{Call, Calls};
use super::effect::{Effect, EffectKind, Next};
use super::light::{Picture, each_value, mixed};
use super::moment::Moment;
use super::seen::FrameFacts;

/// Light above which film begins to saturate, of 0..=1.
const SHOULDER: f32 = 0.7;

/// More or less light on the film. What gets too bright runs smoothly into white instead of being cut off.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Exposure {
    /// Light over that of the scene as trained, as a power of two.
    pub stops: f64,
}

impl EffectKind for Exposure {
    const NAME: &'static str = "exposure";
    const SETTINGS: &'static [&'static str] = &["stops", "sign"];

    fn called_for(call: &Call, _: &Calls<'_>) -> Option<Self> {
        let sign = call.setting("sign").unwrap_or(1.0).signum();
        let stops = call.setting("stops").unwrap_or_else(|| sign * call.degree.of([0.5, 1.0, 2.0]));
        (stops != 0.0).then_some(Self { stops: stops.clamp(-10.0, 10.0) })
    }
}

impl Effect for Exposure {
    fn settings(&self) -> Vec<(&'static str, f64)> {
        vec![("stops", self.stops)]
    }

    fn measure(&self) -> (&'static str, &'static str) {
        ("change of the light", "of 1")
    }

    fn error_if_skipped(&self, _: &FrameFacts<'_>, budget: &Budget) -> Result<Loss, RenderError> {
        Ok(Loss::of_one_sample((self.stops.exp2() - 1.0).abs().min(1.0), budget.color))
    }

    fn changes_with_time(&self) -> bool {
        false
    }

    fn apply(&self, moment: &Moment<'_>, _: u32, next: Next<'_>) -> Result<Picture, RenderError> {
        let mut picture = next(moment)?;
        // A scene of 256 levels that is spread wider shows them.
        picture.ask_for_dither(mixed(moment.take.seed, 0x6578));
        let gain = self.stops.exp2() as f32;
        let is_brighter = self.stops > 0.0;
        each_value(&mut picture.linear().rgb, |light| {
            let more = light * gain;
            if is_brighter && more > SHOULDER { shoulder(more) } else { more }
        });
        Ok(picture)
    }
}

/// Runs into 1 with a continuous slope.
fn shoulder(light: f32) -> f32 {
    SHOULDER + (1.0 - SHOULDER) * (1.0 - (-(light - SHOULDER) / (1.0 - SHOULDER)).exp())
}

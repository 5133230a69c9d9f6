//! Glow around bright areas.

use cinesplat_render::RenderError;

use super::blur::Small;
use super::budget::{Budget, Loss};
use super::calls::{Call, Calls};
use super::effect::{Effect, EffectKind, Next};
use super::light::{Picture, mixed};
use super::moment::Moment;
use super::seen::FrameFacts;

/// Light above which a pixel glows, of 0..=1.
const THRESHOLD: f32 = 0.5;
/// Standard deviations of the glow over the height of the frame, and their shares.
const GLOWS: [(f64, f32); 3] = [(0.008, 0.5), (0.025, 0.3), (0.08, 0.2)];

/// Light that spreads from bright areas into their surroundings, as in a diffusion filter or on film without a backing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bloom {
    /// Share of the bright light that spreads.
    pub strength: f64,
}

impl EffectKind for Bloom {
    const NAME: &'static str = "bloom";
    const SETTINGS: &'static [&'static str] = &["strength"];

    fn called_for(call: &Call, _: &Calls<'_>) -> Option<Self> {
        let strength = call.setting_or("strength", [0.25, 0.5, 1.0]).min(4.0);
        (strength > 0.0).then_some(Self { strength })
    }
}

impl Effect for Bloom {
    fn settings(&self) -> Vec<(&'static str, f64)> {
        vec![("strength", self.strength)]
    }

    fn measure(&self) -> (&'static str, &'static str) {
        ("share of the bright light", "of 1")
    }

    fn error_if_skipped(&self, _: &FrameFacts<'_>, budget: &Budget) -> Result<Loss, RenderError> {
        Ok(Loss::of_one_sample(self.strength, budget.color))
    }

    fn changes_with_time(&self) -> bool {
        false
    }

    fn apply(&self, moment: &Moment<'_>, _: u32, next: Next<'_>) -> Result<Picture, RenderError> {
        let mut picture = next(moment)?;
        picture.ask_for_dither(mixed(moment.take.seed, 0x626c));
        let strength = self.strength as f32;
        let frame = picture.linear();
        let height = f64::from(frame.height);
        let bright = Small::of(frame, |light| (light - THRESHOLD).max(0.0));
        for (deviation, share) in GLOWS {
            bright.blurred([deviation * height; 2]).add_to(frame, strength * share);
        }
        Ok(picture)
    }
}

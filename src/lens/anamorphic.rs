//! Horizontally squeezed optics.

use cinesplat_render::RenderError;

use super::blur::Small;
use super::budget::{Budget, Loss};
use super::calls::{Call, Calls};
use super::effect::{Effect, EffectKind, Next};
use super::light::{Picture, mixed};
use super::moment::{Exposing, Moment};
use super::seen::FrameFacts;

/// Light above which a pixel makes a streak, of 0..=1.
const THRESHOLD: f32 = 0.75;
/// Standard deviation of a streak over the width of the frame, across and down.
const STREAK: [f64; 2] = [0.09, 0.0012];

/// What an anamorphic lens adds to a picture after it is stretched back: horizontal streaks from bright areas, and oval
/// circles of confusion where the shot has a depth of field. The frame's proportions are those of `--size`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Anamorphic {
    /// Height over width of the circles of confusion: the ratio of its two focal lengths.
    pub squeeze: f64,
    /// Share of the bright light that goes into streaks.
    pub streaks: f64,
}

impl EffectKind for Anamorphic {
    const NAME: &'static str = "anamorphic";
    const SETTINGS: &'static [&'static str] = &["squeeze", "streaks"];

    fn called_for(call: &Call, _: &Calls<'_>) -> Option<Self> {
        let squeeze = call.setting("squeeze").unwrap_or(2.0).clamp(1.0, 4.0);
        let streaks = call.setting_or("streaks", [0.3, 0.7, 1.5]).clamp(0.0, 10.0);
        (squeeze > 1.0 || streaks > 0.0).then_some(Self { squeeze, streaks })
    }
}

impl Effect for Anamorphic {
    fn settings(&self) -> Vec<(&'static str, f64)> {
        vec![("squeeze", self.squeeze), ("streaks", self.streaks)]
    }

    fn measure(&self) -> (&'static str, &'static str) {
        ("share of the bright light, or of the width that circles lose", "of 1")
    }

    fn error_if_skipped(&self, _: &FrameFacts<'_>, budget: &Budget) -> Result<Loss, RenderError> {
        Ok(Loss::of_one_sample(self.streaks.max(1.0 - 1.0 / self.squeeze), budget.color))
    }

    fn changes_with_time(&self) -> bool {
        false
    }

    fn apply(&self, moment: &Moment<'_>, _: u32, next: Next<'_>) -> Result<Picture, RenderError> {
        let exposing = Exposing { squeeze: self.squeeze, ..moment.exposing };
        let mut picture = next(&Moment { exposing, ..moment.clone() })?;
        if self.streaks <= 0.0 {
            return Ok(picture);
        }
        picture.ask_for_dither(mixed(moment.take.seed, 0x616e));
        let frame = picture.linear();
        let width = f64::from(frame.width);
        let bright = Small::of(frame, |light| (light - THRESHOLD).max(0.0));
        // Streaks are blue: the coatings of these lenses reflect red and green less.
        bright
            .blurred(STREAK.map(|deviation| deviation * width))
            .tinted([0.55, 0.75, 1.3])
            .add_to(frame, self.streaks as f32);
        Ok(picture)
    }
}

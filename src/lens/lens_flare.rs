//! Light that the glass of a lens reflects.

use cinesplat_render::{Frame, RenderError};

use super::blur::Small;
use super::budget::{Budget, Loss};
use super::calls::{Call, Calls};
use super::effect::{Effect, EffectKind, Next};
use super::light::{Picture, mixed};
use super::moment::Moment;
use super::seen::FrameFacts;

/// Light above which something is bright enough to show in reflections, of 0..=1: a window, a lamp, the sun.
const THRESHOLD: f32 = 0.8;
/// Reflections between two surfaces of the lens: where a source appears, as its place relative to the middle of the
/// picture times this; its share of the light; its blur over the height of the frame; its tint by the coatings.
const GHOSTS: [(f64, f32, f64, [f32; 3]); 5] = [
    (-0.35, 0.30, 0.012, [0.5, 1.0, 0.7]),
    (-0.65, 0.22, 0.030, [1.0, 0.6, 0.3]),
    (-1.10, 0.30, 0.020, [0.4, 0.6, 1.0]),
    (0.45, 0.16, 0.016, [1.0, 0.8, 0.4]),
    (-1.80, 0.35, 0.050, [0.8, 0.5, 1.0]),
];
/// Side of the picture over that of the frame in which bright things are looked for: in a smaller one a lamp of a few
/// pixels would be missed.
const JUDGED_FRAC: f64 = 0.5;
/// Light that is scattered around a source: its share, and its deviation over the height of the frame.
const VEIL: (f32, f64) = (0.35, 0.12);

/// Ghosts of bright things on the line through the middle of the picture, and a veil around them. A frame in which nothing
/// is bright has none.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LensFlare {
    /// Share of the bright light that the lens reflects.
    pub strength: f64,
}

impl LensFlare {
    /// Adds the reflections to a picture in light, whose pixels are `squeeze` times as many across as down.
    fn add_to(self, frame: &mut Frame, squeeze: f64) {
        let height = f64::from(frame.height);
        let strength = self.strength as f32;
        let bright = Small::of(frame, |light| (light - THRESHOLD).max(0.0) / (1.0 - THRESHOLD));
        bright.blurred([VEIL.1 * height * squeeze, VEIL.1 * height]).add_to(frame, strength * VEIL.0);
        for (scale, share, deviation, tint) in GHOSTS {
            bright
                .about_the_middle(scale)
                .blurred([deviation * height * squeeze, deviation * height])
                .tinted(tint)
                .add_to(frame, strength * share);
        }
    }
}

impl EffectKind for LensFlare {
    const NAME: &'static str = "lens-flare";
    const SETTINGS: &'static [&'static str] = &["strength"];

    fn called_for(call: &Call, _: &Calls<'_>) -> Option<Self> {
        let strength = call.setting_or("strength", [0.2, 0.4, 0.8]).min(4.0);
        (strength > 0.0).then_some(Self { strength })
    }
}

impl Effect for LensFlare {
    fn settings(&self) -> Vec<(&'static str, f64)> {
        vec![("strength", self.strength)]
    }

    fn measure(&self) -> (&'static str, &'static str) {
        ("brightest reflection", "of 1")
    }

    fn error_if_skipped(&self, frame: &FrameFacts<'_>, budget: &Budget) -> Result<Loss, RenderError> {
        if frame.is_changed {
            // The flare is that of the finished picture, in which other things may be bright.
            return Ok(Loss::of_one_sample(self.strength, budget.color));
        }
        let mut picture = Picture::of_display(frame.small_picture(JUDGED_FRAC)?);
        let light = picture.linear();
        let plain = light.rgb.clone();
        let own = frame.moment.camera.intrinsics;
        self.add_to(light, own.fx_px / own.fy_px);
        let error = light.rgb.iter().zip(&plain).map(|(with, plain)| f64::from(with - plain)).fold(0.0, f64::max);
        Ok(Loss::of_one_sample(error, budget.color))
    }

    fn changes_with_time(&self) -> bool {
        false
    }

    fn apply(&self, moment: &Moment<'_>, _: u32, next: Next<'_>) -> Result<Picture, RenderError> {
        let mut picture = next(moment)?;
        picture.ask_for_dither(mixed(moment.take.seed, 0x6c66));
        let own = moment.camera.intrinsics;
        self.add_to(picture.linear(), own.fx_px / own.fy_px);
        Ok(picture)
    }
}

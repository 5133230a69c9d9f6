//! Haze that grows with the distance.

use cinesplat_render::{self as render, RenderError, RenderSettings};
use glam::Vec3;

use super::budget::{Budget, Loss};
use super::calls::{Call, Calls};
use super::effect::{Effect, EffectKind, Next};
use super::light::Picture;
use super::moment::Moment;
use super::seen::FrameFacts;

/// Color of fog in daylight, a little blue.
const COLOR: [f64; 3] = [0.74, 0.77, 0.8];

/// Even fog between the camera and the scene; [`cinesplat_render::Fog`] mixes it into every splat by its distance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fog {
    /// Share of the light lost per scene unit, as an exponent.
    pub density: f64,
    /// Color of the fog.
    pub color: [f64; 3],
}

impl EffectKind for Fog {
    const NAME: &'static str = "fog";
    const SETTINGS: &'static [&'static str] = &["density", "red", "green", "blue"];

    fn called_for(call: &Call, calls: &Calls<'_>) -> Option<Self> {
        // Over the size of the scene 20, 50 and 80 percent of the light are lost.
        let per_size = call.degree.of([0.22, 0.7, 1.6]);
        let density = call.setting("density").unwrap_or(per_size / calls.scene_size.max(f64::MIN_POSITIVE));
        let part = |name: &str, default: f64| call.setting(name).unwrap_or(default).clamp(0.0, 1.0);
        let color = [part("red", COLOR[0]), part("green", COLOR[1]), part("blue", COLOR[2])];
        (density > 0.0 && density.is_finite()).then_some(Self { density, color })
    }
}

impl Effect for Fog {
    fn settings(&self) -> Vec<(&'static str, f64)> {
        let [red, green, blue] = self.color;
        vec![("density", self.density), ("red", red), ("green", green), ("blue", blue)]
    }

    fn measure(&self) -> (&'static str, &'static str) {
        ("light lost at the farthest point", "of 1")
    }

    fn error_if_skipped(&self, frame: &FrameFacts<'_>, budget: &Budget) -> Result<Loss, RenderError> {
        let seen = frame.seen()?;
        let farthest = seen.iter().map(|point| point.depth).fold(0.0, f64::max);
        // Where there is nothing, there is fog.
        let error = if frame.sees_background()? { 1.0 } else { 1.0 - (-self.density * farthest).exp() };
        Ok(Loss::of_one_sample(error, budget.color))
    }

    fn changes_with_time(&self) -> bool {
        false
    }

    fn is_local(&self) -> bool {
        true
    }

    fn apply(&self, moment: &Moment<'_>, _: u32, next: Next<'_>) -> Result<Picture, RenderError> {
        let color = Vec3::from(self.color.map(|part| part as f32));
        let fog = Some(render::Fog { color, density: self.density });
        let render = RenderSettings { fog, ..moment.render };
        let mut picture = next(&Moment { render, ..moment.clone() })?;
        // Nothing shines through infinitely much fog.
        picture.cover();
        Ok(picture)
    }
}

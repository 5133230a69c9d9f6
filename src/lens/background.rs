//! What is behind the scene.

use cinesplat_render::{RenderError, RenderSettings};
use glam::Vec3;

use super::budget::{Budget, Loss};
use super::calls::{Call, Calls};
use super::effect::{Effect, EffectKind, Next};
use super::light::Picture;
use super::moment::Moment;
use super::seen::FrameFacts;

/// A color behind the scene in place of black, or nothing: then the film carries how much of each pixel the scene covers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Background {
    /// The color; black behind a transparent film.
    pub color: [f64; 3],
    /// Whether the film is transparent where there is nothing, in formats that hold it.
    pub is_transparent: bool,
}

impl EffectKind for Background {
    const NAME: &'static str = "background";
    const SETTINGS: &'static [&'static str] = &["red", "green", "blue", "alpha"];
    const YIELDS_TO: &'static [(&'static str, &'static str)] =
        &[("fog", "fog hides what is behind the scene, and its film is opaque")];

    fn called_for(call: &Call, _: &Calls<'_>) -> Option<Self> {
        let part = |name: &str| call.setting(name).unwrap_or(0.0).clamp(0.0, 1.0);
        let is_transparent = part("alpha") > 0.0;
        let color = if is_transparent { [0.0; 3] } else { ["red", "green", "blue"].map(part) };
        Some(Self { color, is_transparent })
    }
}

impl Effect for Background {
    fn settings(&self) -> Vec<(&'static str, f64)> {
        let [red, green, blue] = self.color;
        vec![("red", red), ("green", green), ("blue", blue), ("alpha", f64::from(u8::from(self.is_transparent)))]
    }

    fn measure(&self) -> (&'static str, &'static str) {
        ("largest change of the background", "of 1")
    }

    fn error_if_skipped(&self, frame: &FrameFacts<'_>, budget: &Budget) -> Result<Loss, RenderError> {
        if self.is_transparent {
            // Without the effect the film is opaque.
            return Ok(Loss::of_one_sample(1.0, budget.color));
        }
        let plain = frame.moment.render.background.to_array().map(f64::from);
        let change = self.color.iter().zip(plain).map(|(new, old)| (new - old).abs()).fold(0.0, f64::max);
        Ok(Loss::of_one_sample(change, budget.color))
    }

    fn changes_with_time(&self) -> bool {
        false
    }

    fn is_local(&self) -> bool {
        true
    }

    fn is_transparent(&self) -> bool {
        self.is_transparent
    }

    fn apply(&self, moment: &Moment<'_>, _: u32, next: Next<'_>) -> Result<Picture, RenderError> {
        let background = Vec3::from(self.color.map(|part| part as f32));
        let render = RenderSettings { background, ..moment.render };
        next(&Moment { render, ..moment.clone() })
    }
}

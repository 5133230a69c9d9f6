//! Corners darker than the middle.

use cinesplat_geometry::Intrinsics;
use cinesplat_render::RenderError;
use rayon::prelude::*;

use super::budget::{Budget, Loss};
use super::calls::{Call, Calls};
use super::effect::{Effect, EffectKind, Next};
use super::light::{Picture, mixed};
use super::moment::Moment;
use super::seen::FrameFacts;

/// Light lost toward the corners, as through a lens: a falloff with the fourth power of the cosine of an angle, scaled so
/// that the corners lose `stops`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Vignette {
    /// Light lost in the corners, stops.
    pub stops: f64,
}

impl Vignette {
    /// Share of the light that reaches a point, for its squared distance from the middle over that of the corners.
    ///
    /// With (1 + b r^2)^-2, which is cos^4 for an angle of tangent sqrt(b) r, the corners (r = 1) get 2^-stops.
    fn share(self, radius_squared: f64) -> f64 {
        let b = (0.5 * self.stops).exp2() - 1.0;
        (1.0 + b * radius_squared).powi(-2)
    }
}

impl EffectKind for Vignette {
    const NAME: &'static str = "vignette";
    const SETTINGS: &'static [&'static str] = &["stops"];

    fn called_for(call: &Call, _: &Calls<'_>) -> Option<Self> {
        let stops = call.setting_or("stops", [0.5, 1.0, 1.8]);
        (stops > 0.0).then_some(Self { stops: stops.min(8.0) })
    }
}

impl Effect for Vignette {
    fn settings(&self) -> Vec<(&'static str, f64)> {
        vec![("stops", self.stops)]
    }

    fn measure(&self) -> (&'static str, &'static str) {
        ("light lost in the corners", "of 1")
    }

    fn error_if_skipped(&self, _: &FrameFacts<'_>, budget: &Budget) -> Result<Loss, RenderError> {
        Ok(Loss::of_one_sample(1.0 - self.share(1.0), budget.color))
    }

    fn changes_with_time(&self) -> bool {
        false
    }

    fn apply(&self, moment: &Moment<'_>, _: u32, next: Next<'_>) -> Result<Picture, RenderError> {
        let mut picture = next(moment)?;
        // Smooth gradients show bands in 8 bits.
        picture.ask_for_dither(mixed(moment.take.seed, 0x7669));
        let frame = picture.linear();
        let (width, height) = (frame.width as usize, f64::from(frame.height));
        let Intrinsics { cx_px, cy_px, .. } = Intrinsics::from_fov_y(frame.width, frame.height, 1.0);
        let corner = cx_px * cx_px + height * height / 4.0;
        frame.rgb.par_chunks_mut(3 * width).enumerate().for_each(|(row, values)| {
            let y = row as f64 + 0.5 - cy_px;
            for (column, rgb) in values.chunks_exact_mut(3).enumerate() {
                let x = column as f64 + 0.5 - cx_px;
                let share = self.share((x * x + y * y) / corner) as f32;
                rgb.iter_mut().for_each(|value| *value *= share);
            }
        });
        Ok(picture)
    }
}

//! Color fringes toward the corners.

use cinesplat_render::RenderError;
use rayon::prelude::*;

use super::budget::{Budget, Loss};
use super::calls::{Call, Calls};
use super::effect::{Effect, EffectKind, Next};
use super::light::Picture;
use super::moment::Moment;
use super::sampling::sampled;
use super::seen::FrameFacts;

/// Height in pixels at which the shift is as large as `shift_px` says.
const HEIGHT_PX: f64 = 720.0;

/// A lens that magnifies red less and blue more than green.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ChromaticAberration {
    /// Shift of red and of blue against green in the corners, pixels at 720 rows.
    pub shift_px: f64,
}

impl EffectKind for ChromaticAberration {
    const NAME: &'static str = "chromatic-aberration";
    const SETTINGS: &'static [&'static str] = &["shift_px"];

    fn called_for(call: &Call, _: &Calls<'_>) -> Option<Self> {
        let shift_px = call.setting_or("shift_px", [1.2, 2.5, 5.0]).min(50.0);
        (shift_px > 0.0).then_some(Self { shift_px })
    }
}

impl Effect for ChromaticAberration {
    fn settings(&self) -> Vec<(&'static str, f64)> {
        vec![("shift_px", self.shift_px)]
    }

    fn measure(&self) -> (&'static str, &'static str) {
        ("shift in the corners", "px")
    }

    fn error_if_skipped(&self, frame: &FrameFacts<'_>, budget: &Budget) -> Result<Loss, RenderError> {
        let height = f64::from(frame.moment.camera.intrinsics.height);
        Ok(Loss::of_one_sample(self.shift_px * height / HEIGHT_PX, budget.shift_px))
    }

    fn changes_with_time(&self) -> bool {
        false
    }

    fn apply(&self, moment: &Moment<'_>, _: u32, next: Next<'_>) -> Result<Picture, RenderError> {
        let mut picture = next(moment)?;
        let frame = picture.linear();
        let source = frame.clone();
        let middle = [f64::from(frame.width) / 2.0, f64::from(frame.height) / 2.0];
        let corner = middle[0].hypot(middle[1]);
        let shift = self.shift_px * f64::from(frame.height) / HEIGHT_PX / corner;
        let width = frame.width as usize;
        frame.rgb.par_chunks_mut(3 * width).enumerate().for_each(|(row, values)| {
            let y = row as f64 + 0.5 - middle[1];
            for (column, rgb) in values.chunks_exact_mut(3).enumerate() {
                let x = column as f64 + 0.5 - middle[0];
                for (channel, scale) in [(0, 1.0 + shift), (2, 1.0 - shift)] {
                    let place = [middle[0] + x * scale, middle[1] + y * scale];
                    rgb[channel] = sampled(&source, place)[channel];
                }
            }
        });
        Ok(picture)
    }
}

//! When an effect may be left out.

use cinesplat_render::Quality;

/// Errors that a quality allows for the sake of speed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Budget {
    /// Longest blur that may be left out, pixels. On the sharpest splat of a classic scene half a pixel is an error of
    /// 3 % (motion) or 5 % (focus) of its peak.
    pub blur_px: f64,
    /// Largest change of a color that may be left out, of 0..=1. Half a level of 8 bits cannot be seen.
    pub color: f64,
    /// Motion for one sample of a shutter, pixels. The samples grow with the root of the motion: long streaks are smooth.
    pub motion_step_px: f64,
    /// Diameter of the circle of confusion per sample of an aperture, pixels.
    pub circle_step_px: f64,
    /// Largest displacement of a point that may be left out, pixels.
    pub shift_px: f64,
}

/// Samples at most; blur of hundreds of pixels hides what more of them would show.
pub const MAX_SAMPLES: u32 = 64;

impl Budget {
    /// The budget of a quality.
    ///
    /// The steps come from `bench lens` in the kitchen at 1280x720, as PSNR against 256 sharp pictures. One sample with
    /// blurred splats has 45 to 49 dB for a motion of 4 px and 39 dB for 16 px, two have 57 and 46 dB, four have 65 and
    /// 56 dB. Circles of 4, 8 and 16 px have 51, 43 and 38 dB with one sample; four samples gain eight decibels.
    pub fn of(quality: Quality) -> Self {
        let blur_px = match quality {
            Quality::Draft => 1.0,
            Quality::Standard => 0.5,
            Quality::Final => 0.25,
            Quality::Reference => 0.125,
        };
        let (motion_step_px, circle_step_px) = match quality {
            Quality::Draft => (8.0, 48.0),
            Quality::Standard => (1.5, 8.0),
            Quality::Final | Quality::Reference => (0.3, 2.0),
        };
        Self { blur_px, color: 0.5 / 255.0, motion_step_px, circle_step_px, shift_px: blur_px }
    }

    /// Samples of a shutter for a motion, pixels.
    pub fn motion_samples(&self, motion_px: f64) -> u32 {
        ((motion_px / self.motion_step_px).sqrt().ceil() as u32).clamp(1, MAX_SAMPLES)
    }

    /// Samples of an aperture for a circle of confusion, pixels.
    pub fn lens_samples(&self, circle_px: f64) -> u32 {
        match (circle_px / self.circle_step_px).ceil() as u32 {
            0 | 1 => 1,
            // Two points blur along one axis only.
            more => more.clamp(3, MAX_SAMPLES),
        }
    }
}

/// What leaving an effect out of a frame would cost.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Loss {
    /// The largest error, in the unit of [`super::Effect::measure`].
    pub error: f64,
    /// The largest error that the budget allows.
    pub allowed: f64,
    /// Pictures that the frame takes with the effect, at least 1.
    pub samples: u32,
}

impl Loss {
    /// A loss that takes one picture to mend.
    pub fn of_one_sample(error: f64, allowed: f64) -> Self {
        Self { error, allowed, samples: 1 }
    }

    /// Whether the frame needs the effect. An error that is not a number counts as large.
    pub fn shows(&self) -> bool {
        !(self.error <= self.allowed)
    }
}

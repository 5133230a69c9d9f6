//! When an effect may be left out.

use cinesplat_render::Quality;

use super::samples::Between;

/// Errors that a quality allows for the sake of speed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Budget {
    /// Longest blur that may be left out, pixels. On the sharpest splat of a classic scene half a pixel is an error of
    /// 3 % (motion) or 5 % (focus) of its peak.
    pub blur_px: f64,
    /// Largest change of a color that may be left out, of 0..=1. Half a level of 8 bits cannot be seen.
    pub color: f64,
    /// Motion between two samples of a shutter, pixels.
    pub motion_step_px: f64,
    /// Distance between two samples of an aperture on a circle of confusion, pixels: the circle takes the square of its
    /// diameter over this.
    pub circle_step_px: f64,
    /// As `circle_step_px`, for parts of a picture that take fewer samples than the whole: what they lack is the error
    /// of skipping, which has a floor of its own.
    pub part_circle_step_px: f64,
    /// Samples of a shutter at most, and of an aperture.
    pub max_samples: [u32; 2],
    /// Largest displacement of a point that may be left out, pixels. Less than a blur: where edges are moved, the picture
    /// differs more than where they are softened. A skew of 0.25 px costs a film at `final` down to 51 dB.
    pub shift_px: f64,
}

/// Samples of `final` at most; blur of hundreds of pixels hides what more of them would show.
pub const MAX_SAMPLES: u32 = 65;

impl Budget {
    /// The budget of a quality.
    ///
    /// The steps come from `bench lens` on three scenes at 480x270 (`renders/lens/lens.csv`), as PSNR against 256 sharp
    /// pictures that are rendered one by one; the first number is that of the kitchen, which has many layers, the second that
    /// of the robot, which has few.
    ///
    /// - Splats that are blurred in place of more samples are right only where few layers lie behind each other: with one
    ///   sample, motion of 4 px has 34 and 39 dB, a circle of 4 px 34 and 38 dB, no better than no blur at all (35 and 36 dB).
    ///   From two samples on, sharp ones are as good or better. So samples are sharp.
    /// - Samples that share a projection take a third of the time of those that do not (16 of them 5 to 8 times the plain
    ///   frame instead of 16), and cost nothing at `standard`: motion of 4 px has 56 and 55 dB with three, either way. More
    ///   than 60 to 65 dB they do not reach where the camera turns.
    /// - Steps: at `standard`, motion of 4 px takes 3 samples, one of 16 px 9 (52 and 48 dB), a circle of 8 px takes 5 (43 dB,
    ///   and 43; with 4 it has 40). Five in a ring have 1 dB more than five on a spiral, seven have 1.3 to 3.7 dB more.
    /// - A part of the picture that is blurred less than the whole takes as few samples as leave out no more than 50 dB
    ///   (`standard`) and 60 dB (`final`) of the whole: four for a circle of 4 px have 47 dB in the kitchen, seven have
    ///   58.
    /// - Only where the largest number of samples leaves gaps, the splats of each one are blurred over its gap: what is lost
    ///   in decibels is less of an eyesore than ghosts.
    /// - `reference` takes four times as many samples as `final`: those are what other films with effects are compared
    ///   with.
    pub fn of(quality: Quality) -> Self {
        let (blur_px, shift_px) = match quality {
            Quality::Draft => (1.0, 1.0),
            Quality::Standard => (0.5, 0.4),
            Quality::Final => (0.25, 0.08),
            Quality::Reference => (0.125, 0.04),
        };
        let (motion_step_px, circle_step_px, max_samples) = match quality {
            Quality::Draft => (8.0, 16.0, [5, 5]),
            Quality::Standard => (2.0, 3.6, [17, 25]),
            Quality::Final => (1.0, 2.0, [MAX_SAMPLES, 49]),
            Quality::Reference => (0.25, 1.0, [4 * MAX_SAMPLES - 3, 193]),
        };
        let part_circle_step_px = match quality {
            Quality::Draft => circle_step_px,
            Quality::Standard => 2.0,
            Quality::Final => 0.8,
            Quality::Reference => 0.4,
        };
        let color = 0.5 / 255.0;
        Self { blur_px, color, motion_step_px, circle_step_px, part_circle_step_px, max_samples, shift_px }
    }

    /// Samples of a shutter for a motion, pixels.
    pub fn motion_samples(&self, motion_px: f64) -> u32 {
        let steps = (motion_px / self.motion_step_px).ceil().min(f64::from(self.max_samples[0])) as u32;
        // An odd number of samples has one in the middle of the exposure.
        ((steps + 1) | 1).min(self.max_samples[0])
    }

    /// Samples of an aperture for a circle of confusion, pixels.
    pub fn lens_samples(&self, circle_px: f64) -> u32 {
        let steps = (circle_px / self.circle_step_px).powi(2).ceil().min(f64::from(self.max_samples[1])) as u32;
        // Two points blur along one axis only; three and one in the middle blur better.
        steps.max(4).min(self.max_samples[1])
    }

    /// The longest motion that this many samples of a shutter are enough for, pixels.
    pub fn motion_reach_px(&self, samples: usize) -> f64 {
        self.motion_step_px * (samples as f64 - 1.0)
    }

    /// The largest circle of confusion that this many samples of an aperture are enough for in a part of a picture,
    /// pixels.
    pub fn circle_reach_px(&self, samples: usize) -> f64 {
        self.part_circle_step_px * (samples as f64).sqrt()
    }

    /// What becomes of the blur between samples of a shutter: where there are as many as there can be, they may have gaps.
    pub fn between_motion(&self, samples: u32) -> Between {
        if samples < self.max_samples[0] { Between::Sharp } else { Between::Blurred }
    }

    /// As [`Budget::between_motion`], of an aperture.
    pub fn between_lens(&self, samples: u32) -> Between {
        if samples < self.max_samples[1] { Between::Sharp } else { Between::Blurred }
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

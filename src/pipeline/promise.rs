//! What a film promises: a least PSNR of every frame, and a time at which it is whole.

use std::time::Instant;

use cinesplat_render::Quality;

/// Positions of the film at which the work of a frame is counted.
pub(super) const NUM_PLACES: usize = 9;

/// Margin of a checked frame over the least PSNR, for the frames between the checks, dB.
///
/// Along slow moves through five scenes the PSNR of `draft` and `standard` fell at most 0.8 dB below the lower one of
/// two frames that were 20 apart; checks are 8 apart. `draft` cannot be promised from checks: in a film of `bench
/// promises` through synth:tabletop:1 (192x108, a quarter of the scene in a second) one of its frames was over 5 dB
/// below them, and `standard` costs less than a check of every frame.
pub(super) fn margin_db(quality: Quality) -> f64 {
    match quality {
        Quality::Draft => f64::INFINITY,
        Quality::Standard | Quality::Final => 3.0,
        Quality::Reference => 0.0,
    }
}

/// How a frame is rendered.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Level {
    /// The quality.
    pub(super) quality: Quality,
    /// Whether its effects take the samples of `reference`.
    pub(super) is_finest: bool,
}

impl Level {
    /// A quality with its own samples.
    pub(super) fn of(quality: Quality) -> Self {
        Self { quality, is_finest: false }
    }

    /// Between `final` and `reference`: the former with the samples of the latter.
    pub(super) const FINEST: Self = Self { quality: Quality::Final, is_finest: true };

    /// Place in order of accuracy.
    pub(super) fn rank(self) -> (u8, bool) {
        (rank(self.quality), self.is_finest)
    }
}

/// Place of a quality in order of accuracy.
pub(super) fn rank(quality: Quality) -> u8 {
    // The variants are declared in this order.
    quality as u8
}

/// Rounding flips of a picture: at least as many, and per pixel. Frames of 320 x 180 pixels had the error of up to 0.6.
const NUM_FLIPS: f64 = 4.0;
const FLIPS_PER_PIXEL: f64 = 3.5e-5;

/// PSNR that every frame of `final` has, dB, whatever its samples show.
///
/// `final` differs from `reference` by rounding, which is seen where the alpha of a splat falls on the other side of the
/// cut at 1/255: one pixel differs by as much. The samples rarely hold such a pixel.
pub(super) fn final_bound_db(num_pixels: f64) -> f64 {
    let flips = NUM_FLIPS + FLIPS_PER_PIXEL * num_pixels;
    -10.0 * (flips / (255.0 * 255.0 * num_pixels.max(1.0))).log10()
}

/// Requirements that are watched while a film is made.
#[derive(Debug, Clone, PartialEq)]
pub struct Promise {
    /// Least PSNR of every frame against `reference`, dB.
    pub min_psnr_db: Option<f64>,
    /// When the film is whole at the latest.
    pub deadline: Option<Instant>,
    /// PSNR that the frames of `final` have, dB.
    pub final_db: f64,
    /// Forecast time per frame of each quality, fastest first.
    pub paces: Vec<Pace>,
}

/// Forecast time per frame at one quality, seconds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pace {
    /// The quality.
    pub quality: Quality,
    /// To render the mean frame.
    pub render_secs: f64,
    /// Wall time of the film over its number of frames: renderer and encoder together.
    pub film_secs: f64,
    /// To encode the mean frame.
    pub encode_secs: f64,
    /// Frames that the encoder reads before it writes the first one.
    pub num_ahead: usize,
    /// How the time changes along the film.
    pub profile: PathProfile,
}

/// Time of frames along a film, over that of its mean frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PathProfile([f64; NUM_PLACES]);

impl PathProfile {
    /// The profile of values at even positions from the first frame to the last one; all 1 without values.
    pub fn new(values: &[f64]) -> Self {
        let Some(last) = values.len().checked_sub(1) else { return Self([1.0; NUM_PLACES]) };
        let at = |place: usize| {
            let x = last as f64 * place as f64 / (NUM_PLACES - 1) as f64;
            let before = (x as usize).min(last);
            let (a, b) = (values[before], values[(before + 1).min(last)]);
            a + (b - a) * (x - before as f64)
        };
        Self(std::array::from_fn(at))
    }

    /// The value at a position of the film, 0..=1.
    pub fn at(&self, frac: f64) -> f64 {
        let x = frac.clamp(0.0, 1.0) * (NUM_PLACES - 1) as f64;
        let before = (x as usize).min(NUM_PLACES - 2);
        let (a, b) = (self.0[before], self.0[before + 1]);
        a + (b - a) * (x - before as f64)
    }

    /// Mean value from a position to the end of the film.
    pub fn mean_from(&self, frac: f64) -> f64 {
        let steps = 16;
        let at = |step: usize| self.at(frac + (1.0 - frac) * (step as f64 + 0.5) / steps as f64);
        (0..steps).map(at).sum::<f64>() / steps as f64
    }
}

//! A lens whose plane of focus leans.

use cinesplat_render::{Frame, RenderError};
use rayon::prelude::*;

use super::budget::{Budget, Loss};
use super::calls::{Call, Calls};
use super::effect::{Effect, EffectKind, Next};
use super::light::Picture;
use super::moment::Moment;
use super::seen::FrameFacts;

/// Passes of a box that make a bell curve.
const PASSES: usize = 3;

/// A band across the picture that is sharp, with blur that grows toward the upper and the lower border: scenes look like
/// small models, which are always photographed from near.
///
/// The blur depends on the row of the picture alone, as it does for a level ground seen from above.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TiltShift {
    /// Standard deviation of the blur where it is strongest, over the height of the frame.
    pub blur: f64,
    /// Middle of the sharp band, from the top, over the height of the frame.
    pub middle: f64,
    /// Half the height of the sharp band, over the height of the frame.
    pub band: f64,
}

impl TiltShift {
    /// Standard deviation of the blur of a row, pixels.
    fn deviation_px(self, row: usize, height: usize) -> f64 {
        let at = (row as f64 + 0.5) / height as f64;
        let farthest = (self.middle.max(1.0 - self.middle) - self.band).max(1e-6);
        let off = (((at - self.middle).abs() - self.band) / farthest).clamp(0.0, 1.0);
        self.blur * height as f64 * off
    }
}

impl EffectKind for TiltShift {
    const NAME: &'static str = "tilt-shift";
    const SETTINGS: &'static [&'static str] = &["blur", "middle", "band"];
    const YIELDS_TO: &'static [(&'static str, &'static str)] =
        &[("panorama", "a picture of all directions has no upper border")];

    fn called_for(call: &Call, _: &Calls<'_>) -> Option<Self> {
        let blur = call.setting_or("blur", [0.008, 0.015, 0.03]).min(0.2);
        let middle = call.setting("middle").unwrap_or(0.55).clamp(0.0, 1.0);
        let band = call.setting("band").unwrap_or(0.1).clamp(0.0, 0.5);
        (blur > 0.0).then_some(Self { blur, middle, band })
    }
}

impl Effect for TiltShift {
    fn settings(&self) -> Vec<(&'static str, f64)> {
        vec![("blur", self.blur), ("middle", self.middle), ("band", self.band)]
    }

    fn measure(&self) -> (&'static str, &'static str) {
        ("blur at the border", "px")
    }

    fn error_if_skipped(&self, frame: &FrameFacts<'_>, budget: &Budget) -> Result<Loss, RenderError> {
        // A bell curve looks as wide as a disk of four of its deviations.
        let blur_px = 4.0 * self.blur * f64::from(frame.moment.camera.intrinsics.height);
        Ok(Loss::of_one_sample(blur_px, budget.blur_px))
    }

    fn changes_with_time(&self) -> bool {
        false
    }

    fn apply(&self, moment: &Moment<'_>, _: u32, next: Next<'_>) -> Result<Picture, RenderError> {
        let mut picture = next(moment)?;
        let frame = picture.linear();
        let height = frame.height as usize;
        // Half the width of a box whose passes have the variance: a box of a single pixel blurs nothing.
        let reaches: Vec<f64> = (0..height).map(|row| (self.deviation_px(row, height).powi(2) + 0.25).sqrt()).collect();
        // Pixels of a squeezed picture are not square.
        let own = moment.camera.intrinsics;
        let wide = |row: usize| ((self.deviation_px(row, height) * own.fx_px / own.fy_px).powi(2) + 0.25).sqrt();
        across(frame, &(0..height).map(wide).collect::<Vec<f64>>());
        down(frame, &reaches);
        Ok(picture)
    }
}

/// Blurs each row along itself.
fn across(frame: &mut Frame, reaches: &[f64]) {
    let width = frame.width as usize;
    let rows = frame.rgb.par_chunks_mut(3 * width).zip(frame.transmittance.par_chunks_mut(width)).zip(reaches);
    rows.for_each(|((rgb, rest), &reach)| {
        let mut line: Vec<[f64; 4]> = rgb.chunks_exact(3).zip(&*rest).map(|(rgb, rest)| value(rgb, *rest)).collect();
        for _ in 0..PASSES {
            line = boxed(&line, |_| reach);
        }
        for ((rgb, rest), value) in rgb.chunks_exact_mut(3).zip(rest).zip(&line) {
            (0..3).for_each(|channel| rgb[channel] = value[channel] as f32);
            *rest = value[3] as f32;
        }
    });
}

/// Blurs each column along itself, each pixel as far as its row says.
fn down(frame: &mut Frame, reaches: &[f64]) {
    let width = frame.width as usize;
    let column = |column: usize| {
        let pixels = (0..frame.height as usize).map(|row| row * width + column);
        let mut line: Vec<[f64; 4]> =
            pixels.map(|at| value(&frame.rgb[3 * at..3 * at + 3], frame.transmittance[at])).collect();
        for _ in 0..PASSES {
            line = boxed(&line, |row| reaches[row]);
        }
        line
    };
    let columns: Vec<Vec<[f64; 4]>> = (0..width).into_par_iter().map(column).collect();
    for (x, line) in columns.iter().enumerate() {
        for (y, value) in line.iter().enumerate() {
            let at = y * width + x;
            (0..3).for_each(|channel| frame.rgb[3 * at + channel] = value[channel] as f32);
            frame.transmittance[at] = value[3] as f32;
        }
    }
}

fn value(rgb: &[f32], rest: f32) -> [f64; 4] {
    [rgb[0], rgb[1], rgb[2], rest].map(f64::from)
}

/// Means over the pixels within `reach` of each one, which may end within a pixel; beyond its ends the line goes on as it
/// ends.
fn boxed(line: &[[f64; 4]], reach: impl Fn(usize) -> f64) -> Vec<[f64; 4]> {
    let mut sums = vec![[0.0; 4]];
    for (idx, value) in line.iter().enumerate() {
        sums.push([0, 1, 2, 3].map(|part| sums[idx][part] + value[part]));
    }
    let len = line.len();
    // The integral of the line up to a place.
    let until = |place: f64, part: usize| {
        let inside = place.clamp(0.0, len as f64);
        let cell = (inside as usize).min(len - 1);
        let beyond = (place - inside) * line[if place < 0.0 { 0 } else { len - 1 }][part];
        sums[cell][part] + (inside - cell as f64) * line[cell][part] + beyond
    };
    let mean = |idx: usize| {
        let (middle, reach) = (idx as f64 + 0.5, reach(idx));
        [0, 1, 2, 3].map(|part| (until(middle + reach, part) - until(middle - reach, part)) / (2.0 * reach))
    };
    (0..len).map(mean).collect()
}

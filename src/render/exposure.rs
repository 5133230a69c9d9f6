//! Exposures: the mean light of several pictures, as a shutter that stays open or an open aperture collects it.
//!
//! Enters: sub-frames. Leaves: one picture. The invariant: an exposure of one sub-frame without blur has the bits of
//! the plain picture.

use pulp::{Simd, WithSimd};
use rayon::prelude::*;

use super::blur::SubFrame;
use super::canvas::{Canvas, LightSums};
use super::close::has_close_splats;
use super::error::check_len;
use super::frame::level;
use super::light::color_value;
use super::sweep::{Sweep, ViewSweep};
use super::{Frame, Limits, Quality, RenderError, RenderSettings, RenderStats, Renderer, Rgb8Frame};

/// Values that one job converts.
const VALUES_PER_JOB: usize = 1 << 15;
/// Splat-tile pairs up to which pictures share a projection: 1 GiB of lists. Plain pictures have some millions, at 4K
/// some ten millions.
const SWEEP_MAX_PAIRS: u64 = 1 << 28;

impl Renderer<'_> {
    /// Renders the exposure of sub-frames: the mean of their light, in the colors of the scene. Colors are light in the
    /// encoding of sRGB; more than one sub-frame clamps them to 0..=1.
    ///
    /// # Errors
    /// Those of [`Renderer::render`]; [`RenderError::Setting`] for a lens out of range; [`RenderError::Length`] without
    /// sub-frames or if their pictures differ in size.
    pub fn expose_into(
        &self,
        subframes: &[SubFrame],
        settings: &RenderSettings,
        frame: &mut Frame,
    ) -> Result<(), RenderError> {
        if let [one] = subframes {
            return self.render_subframe_into(one, settings, frame);
        }
        self.sum_light(&evenly(subframes), settings, frame)?;
        to_colors(frame, settings);
        Ok(())
    }

    /// As [`Renderer::expose_into`], in 8 bits. The result equals [`Frame::to_rgb8`].
    ///
    /// # Errors
    /// Those of [`Renderer::expose_into`].
    pub fn expose_rgb8_into(
        &self,
        subframes: &[SubFrame],
        settings: &RenderSettings,
        frame: &mut Rgb8Frame,
    ) -> Result<(), RenderError> {
        match subframes {
            [one] => self.render_subframe_rgb8_into(one, settings, frame),
            _ => self.with_light(|sums| {
                self.sum_light(&evenly(subframes), settings, sums)?;
                to_levels(sums, settings, frame);
                Ok(())
            }),
        }
    }

    /// Renders an exposure whose pictures share one projection and one depth order: the mean of their light, in the colors
    /// of the scene. Takes less time than [`Renderer::expose_into`], and less still where little of the picture moves.
    /// [`Quality::Reference`] and pictures that are enlarged render each picture of the largest pattern by itself, and so do
    /// exposures that pass a splat closely, and those whose splats move over so many tiles that sharing costs more than
    /// it saves. None of this depends on the memory of the machine or on its threads: a sweep that exceeds
    /// [`RenderSettings::limits`] in memory is an error, as a plain picture is.
    ///
    /// # Errors
    /// Those of [`Renderer::expose_into`].
    pub fn sweep_into(&self, sweep: &Sweep, settings: &RenderSettings, frame: &mut Frame) -> Result<(), RenderError> {
        self.sum_sweep(sweep, settings, frame)?;
        to_colors(frame, settings);
        Ok(())
    }

    /// As [`Renderer::sweep_into`], in 8 bits. The result equals [`Frame::to_rgb8`].
    ///
    /// # Errors
    /// Those of [`Renderer::sweep_into`].
    pub fn sweep_rgb8_into(
        &self,
        sweep: &Sweep,
        settings: &RenderSettings,
        frame: &mut Rgb8Frame,
    ) -> Result<(), RenderError> {
        self.with_light(|sums| {
            self.sum_sweep(sweep, settings, sums)?;
            to_levels(sums, settings, frame);
            Ok(())
        })
    }

    fn sum_sweep(&self, sweep: &Sweep, settings: &RenderSettings, sums: &mut Frame) -> Result<(), RenderError> {
        let is_enlarged = settings.effective_accuracy().resolution_frac < 1.0;
        if settings.quality == Quality::Reference || is_enlarged {
            return self.sum_light(&sweep.subframes(), settings, sums);
        }
        let view = self.view_of(&sweep.middle(), settings)?;
        let shared = ViewSweep::new(sweep, view.near)?;
        if has_close_splats(sweep, &view, self.gaussians) {
            return self.sum_light(&sweep.subframes(), settings, sums);
        }
        sums.resize(view.width, view.height);
        let Frame { rgb, transmittance, .. } = &mut *sums;
        let canvas = Canvas::Light(LightSums { light: rgb, transmittance, weight: 1.0, is_first: true });
        let limits = Limits { max_pairs: settings.limits.max_pairs.min(SWEEP_MAX_PAIRS), ..settings.limits };
        let mut stats = match self.sweep_onto(canvas, &view, &shared, &RenderSettings { limits, ..*settings }) {
            // Splats that move far are in the lists of many tiles. How many these are follows from scene and cameras
            // alone, unlike the memory that is left: rendered otherwise for the lack of it, a film would have other
            // bytes on another machine.
            Err(RenderError::Cost { .. }) => return self.sum_light(&sweep.subframes(), settings, sums),
            taken => taken?,
        };
        stats.counts.num_subframes = sweep.num_samples() as u64;
        sums.stats = stats;
        Ok(())
    }

    /// Writes the sum of the light of the sub-frames times their weights, and of their transmittances, into `sums`.
    fn sum_light(
        &self,
        subframes: &[(SubFrame, f32)],
        settings: &RenderSettings,
        sums: &mut Frame,
    ) -> Result<(), RenderError> {
        check_len("sub-frames of an exposure", subframes.len().min(1), 1)?;
        let mut stats = RenderStats::default();
        for (idx, &(ref subframe, weight)) in subframes.iter().enumerate() {
            let view = self.view_of(subframe, settings)?;
            if idx == 0 {
                sums.resize(view.width, view.height);
            }
            check_len("pixels across a sub-frame", view.width as usize, sums.width as usize)?;
            check_len("pixels down a sub-frame", view.height as usize, sums.height as usize)?;
            let Frame { rgb, transmittance, width, .. } = &mut *sums;
            let mut canvas = LightSums { light: rgb, transmittance, weight, is_first: idx == 0 };
            stats += if settings.quality == Quality::Reference {
                let mut picture = Frame::default();
                self.render_subframe_into(subframe, settings, &mut picture)?;
                let rows = picture.rgb.chunks(*width as usize * 3).zip(picture.transmittance.chunks(*width as usize));
                rows.enumerate().for_each(|(row, (rgb, rest))| canvas.add(row * *width as usize, rgb, rest));
                picture.stats
            } else {
                self.render_onto(Canvas::Light(canvas), subframe, &view, settings)?
            };
        }
        sums.stats = stats;
        Ok(())
    }
}

/// Sub-frames with equal weights.
fn evenly(subframes: &[SubFrame]) -> Vec<(SubFrame, f32)> {
    let weight = (1.0 / subframes.len() as f64) as f32;
    subframes.iter().map(|&subframe| (subframe, weight)).collect()
}

/// Turns the light of a frame into colors.
fn to_colors(frame: &mut Frame, settings: &RenderSettings) {
    frame.rgb.par_chunks_mut(VALUES_PER_JOB).for_each(|light| {
        settings.instructions.dispatch(InPlace { light });
    });
}

/// Writes the light of a frame as colors in 8 bits.
fn to_levels(sums: &Frame, settings: &RenderSettings, frame: &mut Rgb8Frame) {
    (frame.width, frame.height, frame.stats) = (sums.width, sums.height, sums.stats);
    frame.rgb8.resize(sums.rgb.len(), 0);
    let jobs = frame.rgb8.par_chunks_mut(VALUES_PER_JOB).zip(sums.rgb.par_chunks(VALUES_PER_JOB));
    jobs.for_each(|(levels, light)| settings.instructions.dispatch(ToLevels { light, levels }));
}

/// Light to color values.
struct InPlace<'a> {
    light: &'a mut [f32],
}

impl WithSimd for InPlace<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        self.light.iter_mut().for_each(|value| *value = color_value(*value));
    }
}

/// Light to color in 8 bits.
struct ToLevels<'a> {
    light: &'a [f32],
    levels: &'a mut [u8],
}

impl WithSimd for ToLevels<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        self.levels.iter_mut().zip(self.light).for_each(|(to, &light)| *to = level(color_value(light)));
    }
}

//! Frames of a film, with their effects, compared with those of `reference`.

use super::effects::Filmed;
use crate::pipeline::accuracy::{at, mean_square};
use cinesplat_geometry::{Camera, Intrinsics};
use cinesplat_lens::EffectPlan;
use cinesplat_render::{Frame, Quality, RenderError, RenderSettings, Renderer};

/// Mean square error of sharing one projection among the samples of a frame, 60 dB: where the camera turns, more samples
/// do not bring it down (`renders/lens/lens.csv`, rows `shared,16`; `reference` renders each sample by itself).
const SHARED_SQUARE: f64 = 1e-6;

/// Rows and columns of parts of a frame, of which two per row are compared, a sixth of the frame.
const GRID: u32 = 12;
/// Columns from the part of a row to that of the next one, without a common factor with [`GRID`].
const STRIDE: u32 = 5;
/// Least width and height of a part, pixels: smaller frames are compared whole.
const LEAST_PART_PX: u32 = 20;
/// Share of the frame that is not compared.
const REST_FRAC: f64 = 5.0 / 6.0;
/// Standard errors by which the mean of the parts may be off.
const NUM_ERRORS: f64 = 2.0;

/// Mean square differences of a frame to that of `reference`, apart from that of `final` without effects.
pub(in crate::pipeline) struct Found {
    /// Per part of the frame that was compared, at least one.
    parts: Vec<f64>,
    /// What comes on top.
    floor: f64,
}

impl Found {
    /// That of the whole frame, as the parts show it.
    pub(in crate::pipeline) fn mean(&self) -> f64 {
        self.parts.iter().sum::<f64>() / self.parts.len() as f64 + self.floor
    }

    /// As [`Found::mean`], with what the parts may have missed.
    pub(in crate::pipeline) fn bound(&self) -> f64 {
        let (num, mean) = (self.parts.len() as f64, self.mean() - self.floor);
        let spread = self.parts.iter().map(|part| (part - mean).powi(2)).sum::<f64>() / (num - 1.0).max(1.0);
        self.mean() + NUM_ERRORS * (REST_FRAC * spread / num).sqrt()
    }
}

/// Compares frames of a film.
pub(in crate::pipeline) struct Compared<'a> {
    pub(in crate::pipeline) renderer: &'a Renderer<'a>,
    pub(in crate::pipeline) filmed: &'a Filmed<'a>,
    pub(in crate::pipeline) settings: &'a RenderSettings,
}

/// A frame as `final` renders it, with the samples of `reference` for its effects.
pub(in crate::pipeline) struct BestFrame {
    frame: Frame,
    /// Mean square difference to `reference`, besides that of `final` without effects.
    pub(in crate::pipeline) mean_square: f64,
}

impl Compared<'_> {
    /// The frame that those of other qualities are compared with.
    pub(in crate::pipeline) fn best(&self, frame_idx: usize) -> Result<BestFrame, RenderError> {
        let render = at(self.settings, Quality::Final);
        let plan = self.filmed.plan_finest(frame_idx..frame_idx + 1, (self.renderer, &render))?;
        let mut picture = self.filmed.expose(&plan, frame_idx, (self.renderer, &render))?;
        let mean_square = if plan.is_sampled(frame_idx) { SHARED_SQUARE } else { 0.0 };
        Ok(BestFrame { frame: std::mem::take(picture.display()), mean_square })
    }

    /// What comes on top of the difference to the best frame: that one's own.
    pub(in crate::pipeline) fn floor(&self, frame_idx: usize) -> Result<f64, RenderError> {
        let render = at(self.settings, Quality::Final);
        let finest = self.filmed.plan_finest(frame_idx..frame_idx + 1, (self.renderer, &render))?;
        Ok(if finest.is_sampled(frame_idx) { SHARED_SQUARE } else { 0.0 })
    }

    /// A frame at some qualities. Where lens or shutter take samples, a sixth of the frame is compared, and effects outside of
    /// them are left out: the samples of `reference` take long.
    pub(in crate::pipeline) fn found(
        &self,
        frame_idx: usize,
        qualities: &[Quality],
    ) -> Result<Vec<Found>, RenderError> {
        let render = at(self.settings, Quality::Final);
        let finest = self.filmed.plan_finest(frame_idx..frame_idx + 1, (self.renderer, &render))?;
        let parts = parts(&self.filmed.camera(frame_idx));
        if parts.is_empty() || !finest.is_sampled(frame_idx) {
            let best = self.best(frame_idx)?;
            let whole = |quality: &Quality| {
                let found = self.mean_square(frame_idx, *quality, &best)?;
                Ok(Found { parts: vec![found], floor: 0.0 })
            };
            return qualities.iter().map(whole).collect();
        }
        let part_of = |plan: &EffectPlan, part: Camera, render: &RenderSettings| -> Result<Frame, RenderError> {
            let mut picture = self.filmed.expose_part(plan, (frame_idx, part), (self.renderer, render))?;
            Ok(std::mem::take(picture.display()))
        };
        let exact = parts.iter().map(|part| part_of(&finest, *part, &render)).collect::<Result<Vec<_>, _>>()?;
        let of_quality = |quality: &Quality| {
            let render = at(self.settings, *quality);
            let plan = self.filmed.plan(frame_idx..frame_idx + 1, (self.renderer, &render))?;
            let pairs = parts.iter().zip(&exact);
            let found = pairs.map(|(part, exact)| Ok(mean_square(&part_of(&plan, *part, &render)?, exact)));
            Ok(Found { parts: found.collect::<Result<_, RenderError>>()?, floor: SHARED_SQUARE })
        };
        qualities.iter().map(of_quality).collect()
    }

    /// Mean square difference of a frame to that of `reference`, apart from that of `final` without effects.
    pub(in crate::pipeline) fn mean_square(
        &self,
        frame_idx: usize,
        quality: Quality,
        best: &BestFrame,
    ) -> Result<f64, RenderError> {
        if quality == Quality::Final && !self.filmed.develops() {
            return Ok(0.0);
        }
        let render = at(self.settings, quality);
        let plan = self.filmed.plan(frame_idx..frame_idx + 1, (self.renderer, &render))?;
        let mut picture = self.filmed.expose(&plan, frame_idx, (self.renderer, &render))?;
        Ok(mean_square(picture.display(), &best.frame) + best.mean_square)
    }
}

/// Cameras of parts of a picture that are spread over it; none for a small one.
fn parts(camera: &Camera) -> Vec<Camera> {
    let whole = camera.intrinsics;
    let (width, height) = (whole.width / GRID, whole.height / GRID);
    if width.min(height) < LEAST_PART_PX {
        return Vec::new();
    }
    let part = |row: u32, column: u32| {
        let (left, top) = (f64::from(column * width), f64::from(row * height));
        let intrinsics = Intrinsics { width, height, cx_px: whole.cx_px - left, cy_px: whole.cy_px - top, ..whole };
        Camera { intrinsics, ..*camera }
    };
    let columns = |row: u32| [0, GRID / 2].map(|first| (first + row * STRIDE) % GRID);
    (0..GRID).flat_map(|row| columns(row).map(|column| part(row, column))).collect()
}

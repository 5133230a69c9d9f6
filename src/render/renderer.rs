use std::time::Instant;

use glam::{DVec3, Vec3};

use super::blur::SubFrame;
use super::canvas::Canvas;
use super::depth::{DepthMap, DepthPayload};
use super::error::check_len;
use super::fast::{self, Buffers};
use super::groups::{Groups, Pack};
use super::ids::{IdMap, IdPayload};
use super::lift::{LiftPayload, LiftedValues};
use super::memory::{Budget, SharedBudget, bytes_of};
use super::payload::{ColorOnly, Payload};
use super::pool::Pool;
use super::sweep::ViewSweep;
use super::upsample::upsample;
use super::weights::{PixelWeight, WeightCounts, WeightPayload};
use super::{Frame, Quality, RenderError, RenderSettings, RenderStats, Rgb8Frame, View, reference};
use cinesplat_geometry::Camera;
use cinesplat_scene::Gaussians;

/// Renders pictures of one scene. Keeps its buffers from picture to picture; several threads may share it.
///
/// Uses the threads of the current rayon pool. A picture has the same bits for any number of threads.
#[derive(Debug)]
pub struct Renderer<'scene> {
    pub(super) gaussians: &'scene Gaussians,
    groups: Groups,
    buffers: Pool<Buffers>,
    small_frames: Pool<Frame>,
    /// Sums of light.
    light_frames: Pool<Frame>,
}

impl<'scene> Renderer<'scene> {
    /// A renderer of `gaussians`. Never draws Gaussians with a value that is not finite, a rotation of length zero or
    /// an opacity of 0.
    pub fn new(gaussians: &'scene Gaussians) -> Self {
        Self {
            gaussians,
            groups: Groups::new(gaussians),
            buffers: Pool::default(),
            small_frames: Pool::default(),
            light_frames: Pool::default(),
        }
    }

    /// Bytes that the renderer holds between pictures, without the scene and the returned pictures.
    pub fn memory_bytes(&self) -> u64 {
        let small = |frame: &Frame| bytes_of(&frame.rgb) + bytes_of(&frame.transmittance);
        self.groups.bytes()
            + self.buffers.sum(Buffers::bytes)
            + self.small_frames.sum(small)
            + self.light_frames.sum(small)
    }

    /// Number of Gaussians of the scene.
    pub fn num_gaussians(&self) -> usize {
        self.gaussians.len()
    }

    /// Renders the picture of a camera.
    ///
    /// # Errors
    /// [`RenderError::Camera`] for an unusable camera, [`RenderError::Setting`] for a setting out of range,
    /// [`RenderError::Memory`] and [`RenderError::Cost`] if the picture exceeds [`RenderSettings::limits`].
    pub fn render(&self, camera: &Camera, settings: &RenderSettings) -> Result<Frame, RenderError> {
        let mut frame = Frame::default();
        self.render_into(camera, settings, &mut frame)?;
        Ok(frame)
    }

    /// As [`Renderer::render`], into a frame whose memory is reused.
    ///
    /// # Errors
    /// Those of [`Renderer::render`]; the frame is then unspecified.
    pub fn render_into(
        &self,
        camera: &Camera,
        settings: &RenderSettings,
        frame: &mut Frame,
    ) -> Result<(), RenderError> {
        self.render_subframe_into(&SubFrame::from(*camera), settings, frame)
    }

    /// As [`Renderer::render_into`], with blur.
    pub(super) fn render_subframe_into(
        &self,
        subframe: &SubFrame,
        settings: &RenderSettings,
        frame: &mut Frame,
    ) -> Result<(), RenderError> {
        let view = self.view_of(subframe, settings)?;
        frame.resize(view.width, view.height);
        if settings.quality == Quality::Reference {
            return self.render_reference(&view, settings, frame);
        }
        frame.stats = self.render_onto(Canvas::from(&mut *frame), subframe, &view, settings)?;
        Ok(())
    }

    /// As [`Renderer::render_into`], in 8 bits. The result equals [`Frame::to_rgb8`], without writing a picture in
    /// `f32` first.
    ///
    /// # Errors
    /// Those of [`Renderer::render`]; the frame is then unspecified.
    pub fn render_rgb8_into(
        &self,
        camera: &Camera,
        settings: &RenderSettings,
        frame: &mut Rgb8Frame,
    ) -> Result<(), RenderError> {
        self.render_subframe_rgb8_into(&SubFrame::from(*camera), settings, frame)
    }

    /// As [`Renderer::render_rgb8_into`], with blur.
    pub(super) fn render_subframe_rgb8_into(
        &self,
        subframe: &SubFrame,
        settings: &RenderSettings,
        frame: &mut Rgb8Frame,
    ) -> Result<(), RenderError> {
        let view = self.view_of(subframe, settings)?;
        (frame.width, frame.height) = (view.width, view.height);
        if settings.quality == Quality::Reference {
            let mut linear = Frame::default();
            self.render_subframe_into(subframe, settings, &mut linear)?;
            linear.write_rgb8(&mut frame.rgb8);
            frame.stats = linear.stats;
            return Ok(());
        }
        frame.rgb8.resize(view.width as usize * view.height as usize * 3, 0);
        frame.stats = self.render_onto(Canvas::from(&mut *frame), subframe, &view, settings)?;
        Ok(())
    }

    /// The view of a sub-frame, whose picture the limits allow.
    pub(super) fn view_of(&self, subframe: &SubFrame, settings: &RenderSettings) -> Result<View, RenderError> {
        let origin = self.gaussians.origin;
        let view = View::new(&subframe.camera, origin, settings)?.blurred(&subframe.blur, origin)?;
        // Before a picture of this size is allocated.
        Budget::of_picture(&view, &settings.limits)?;
        Ok(view)
    }

    /// Calls `work` with a frame whose memory is reused.
    pub(super) fn with_light<R>(&self, work: impl FnOnce(&mut Frame) -> R) -> R {
        self.light_frames.with(work)
    }

    /// The Gaussians that can be drawn, in packs.
    pub(super) fn packs(&self) -> &[Pack] {
        &self.groups.packs
    }

    /// Origin of the scene.
    pub(super) fn origin(&self) -> DVec3 {
        self.gaussians.origin
    }

    /// Renders onto a canvas of the view's size, at the resolution that the accuracy knobs set.
    pub(super) fn render_onto(
        &self,
        canvas: Canvas<'_>,
        subframe: &SubFrame,
        view: &View,
        settings: &RenderSettings,
    ) -> Result<RenderStats, RenderError> {
        let resolution_frac = settings.effective_accuracy().resolution_frac;
        if resolution_frac >= 1.0 {
            return Ok(self.render_payload(view, settings, (Some(canvas), None), &ColorOnly)?.0);
        }
        let mut small_view = self.view_of(&subframe.scaled(resolution_frac), settings)?;
        // Keeps the dilation that the large picture has. The small picture then samples the large one, and enlarging
        // interpolates only between samples.
        small_view.dilation_px2 *= resolution_frac * resolution_frac;
        self.small_frames.with(|small| {
            small.resize(small_view.width, small_view.height);
            let (stats, _) =
                self.render_payload(&small_view, settings, (Some(Canvas::from(&mut *small)), None), &ColorOnly)?;
            upsample(small, canvas, [view.width, view.height], settings.instructions);
            Ok(stats)
        })
    }

    /// Depth of every pixel, from the blending weights at full resolution.
    ///
    /// # Errors
    /// Those of [`Renderer::render`].
    pub fn depth(&self, camera: &Camera, settings: &RenderSettings) -> Result<DepthMap, RenderError> {
        let tiles = self.tiles_of_payload(camera, settings, &DepthPayload)?;
        Ok(DepthMap::assemble(camera.intrinsics.width, camera.intrinsics.height, tiles))
    }

    /// The object in each pixel: the label with the largest sum of blending weights. `labels` holds one per Gaussian,
    /// 0 = none.
    ///
    /// # Errors
    /// Those of [`Renderer::render`]; [`RenderError::Length`] unless there is one label per Gaussian.
    pub fn object_ids(&self, camera: &Camera, settings: &RenderSettings, labels: &[u16]) -> Result<IdMap, RenderError> {
        check_len("labels", labels.len(), self.gaussians.len())?;
        let tiles = self.tiles_of_payload(camera, settings, &&IdPayload::new(labels))?;
        Ok(IdMap::assemble(camera.intrinsics.width, camera.intrinsics.height, &tiles))
    }

    /// Adds pixel values (`[(row * width + column) * num_channels + channel]`) to the Gaussians that are visible in the
    /// pixels, weighted with their blending weights. `lifted` may sum over several pictures.
    ///
    /// # Errors
    /// Those of [`Renderer::render`]; [`RenderError::Length`] if `values` or `lifted` does not fit picture or scene.
    pub fn lift(
        &self,
        camera: &Camera,
        settings: &RenderSettings,
        values: &[f32],
        lifted: &mut LiftedValues,
    ) -> Result<(), RenderError> {
        let num_channels = lifted.num_channels;
        let num_pixels = camera.intrinsics.width as usize * camera.intrinsics.height as usize;
        check_len("pixel values", values.len(), num_pixels * num_channels)?;
        check_len("lifted weights", lifted.weights.len(), self.gaussians.len())?;
        let payload = &LiftPayload { values, num_channels, budget: SharedBudget::default() };
        let tiles = self.tiles_of_payload(camera, settings, &payload)?;
        payload.budget.check("the rows of lifted sums")?;
        lifted.add(tiles);
        Ok(())
    }

    /// The blending weight of every splat in every pixel: nearest first within a pixel, pixels in no defined order. The
    /// list is long: about fifty entries per pixel in an indoor scene. Blends twice: to count the weights, and to list them.
    ///
    /// # Errors
    /// Those of [`Renderer::render`]; [`RenderError::Memory`] if the list exceeds the limit.
    pub fn weights(&self, camera: &Camera, settings: &RenderSettings) -> Result<Vec<PixelWeight>, RenderError> {
        let counts = WeightCounts::default();
        let nums = self.tiles_of_payload(camera, settings, &counts)?;
        counts.budget.check("the list of weights")?;
        let mut list = bytemuck::zeroed_vec(nums.iter().sum());
        self.tiles_of_payload(camera, settings, &WeightPayload::new(&mut list, &nums))?;
        Ok(list)
    }

    /// The tiles of a payload that takes the weights, at full resolution.
    pub(super) fn tiles_of_payload<P: Payload>(
        &self,
        camera: &Camera,
        settings: &RenderSettings,
        payload: &P,
    ) -> Result<Vec<P::TileOutput>, RenderError> {
        let view = View::new(camera, self.gaussians.origin, settings)?;
        Ok(self.render_payload(&view, settings, (None, None), payload)?.1)
    }

    fn render_payload<P: Payload>(
        &self,
        view: &View,
        settings: &RenderSettings,
        (canvas, sweep): (Option<Canvas<'_>>, Option<&ViewSweep>),
        payload: &P,
    ) -> Result<(RenderStats, Vec<P::TileOutput>), RenderError> {
        let scene = (self.gaussians, &self.groups);
        self.buffers.with(|buffers| fast::render(scene, view, settings, buffers, (canvas, sweep, payload)))
    }

    /// Renders the sum of the light of a sweep around a view, at full resolution.
    pub(super) fn sweep_onto(
        &self,
        canvas: Canvas<'_>,
        view: &View,
        sweep: &ViewSweep,
        settings: &RenderSettings,
    ) -> Result<RenderStats, RenderError> {
        Ok(self.render_payload(view, settings, (Some(canvas), Some(sweep)), &ColorOnly)?.0)
    }

    fn render_reference(&self, view: &View, settings: &RenderSettings, frame: &mut Frame) -> Result<(), RenderError> {
        let start = Instant::now();
        let scene = (self.gaussians, self.groups.usable());
        let output = (frame.rgb.as_mut_slice(), frame.transmittance.as_mut_slice());
        let counts = reference::render(scene, view, &settings.limits, output)?;
        frame.stats = RenderStats { counts, ..RenderStats::default() };
        frame.stats.times.blend = start.elapsed();
        add_background(frame, settings.visible_background());
        Ok(())
    }
}

/// Adds the background color, weighted with the transmittance.
fn add_background(frame: &mut Frame, background: Vec3) {
    if background != Vec3::ZERO {
        for (rgb, rest) in frame.rgb.chunks_exact_mut(3).zip(&frame.transmittance) {
            rgb.iter_mut().zip(background.to_array()).for_each(|(value, behind)| *value += behind * rest);
        }
    }
}

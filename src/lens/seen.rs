//! What is known about a frame when it is decided which effects it needs.

use std::cell::OnceCell;
use std::fmt;

use cinesplat_geometry::Camera;
use cinesplat_render::{BlurExtent, Frame, Quality, RenderError, RenderSettings, Renderer, SplatBlur};
use glam::DVec2;

use super::moment::Moment;

/// Side of the small picture over that of the frame, by which the depths are found.
const SMALL_FRAC: f64 = 0.125;

/// A point that the frame shows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SeenPoint {
    /// Position in the frame, pixels.
    pub position_px: DVec2,
    /// Depth along the view axis, scene units: that of the splat that covers half of the pixel.
    pub depth: f64,
}

/// A frame before it is rendered.
pub struct FrameFacts<'a> {
    /// The frame.
    pub moment: Moment<'a>,
    /// Whether effects other than lens and shutter may show what the plain picture lacks.
    pub(super) is_changed: bool,
    renderer: &'a Renderer<'a>,
    seen: OnceCell<Vec<SeenPoint>>,
}

impl fmt::Debug for FrameFacts<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("FrameFacts").field("moment", &self.moment).finish_non_exhaustive()
    }
}

impl<'a> FrameFacts<'a> {
    /// The facts of a frame.
    pub fn new(moment: Moment<'a>, renderer: &'a Renderer<'a>) -> Self {
        Self { moment, is_changed: false, renderer, seen: OnceCell::new() }
    }

    /// Dilation of the splats, pixels squared: the blur that a picture has without any effect.
    pub fn dilation_px2(&self) -> f64 {
        self.moment.render.dilation_px2()
    }

    /// Points that the frame shows, evenly spread over it; none where there is nothing but background. Found on the first
    /// call by a small picture of depths.
    ///
    /// # Errors
    /// Those of the renderer.
    pub fn seen(&self) -> Result<&[SeenPoint], RenderError> {
        if let Some(seen) = self.seen.get() {
            return Ok(seen);
        }
        let found = self.find_seen()?;
        Ok(self.seen.get_or_init(|| found))
    }

    /// The plain picture of the frame at a fraction of its size.
    ///
    /// # Errors
    /// Those of the renderer.
    pub fn small_picture(&self, frac: f64) -> Result<Frame, RenderError> {
        let Camera { pose, intrinsics } = self.moment.camera;
        let render = RenderSettings { quality: Quality::Standard, accuracy: None, ..self.moment.render };
        self.renderer.render(&Camera { pose, intrinsics: intrinsics.scaled(frac) }, &render)
    }

    /// How much blur of splats there is in the frame.
    ///
    /// # Errors
    /// Those of [`Renderer::blur_extent`].
    pub fn blur_extent(&self, blur: &SplatBlur) -> Result<BlurExtent, RenderError> {
        self.renderer.blur_extent(&self.moment.camera, blur, &self.moment.render)
    }

    /// Whether the frame shows background.
    ///
    /// # Errors
    /// Those of the renderer.
    pub fn sees_background(&self) -> Result<bool, RenderError> {
        let small = self.moment.camera.intrinsics.scaled(SMALL_FRAC);
        Ok(self.seen()?.len() < small.width as usize * small.height as usize)
    }

    /// How far the points of the frame move in it between two times, pixels: 99 of 100 move no further. 0 where there is
    /// nothing.
    ///
    /// # Errors
    /// Those of the renderer.
    pub fn travel_px(&self, from_secs: f64, to_secs: f64) -> Result<f64, RenderError> {
        let (from, to) = (self.moment.at(from_secs).camera, self.moment.at(to_secs).camera);
        if from == to {
            return Ok(0.0);
        }
        let camera = self.moment.camera;
        let travel = |point: &SeenPoint| {
            let ray = camera.ray(point.position_px);
            let point_world = camera.pose.position + ray * (point.depth / ray.dot(camera.pose.forward()));
            Some(from.project(point_world)?.0.distance(to.project(point_world)?.0))
        };
        // A point that passes the camera moves without bound.
        let mut travels: Vec<f64> = self.seen()?.iter().map(|point| travel(point).unwrap_or(f64::INFINITY)).collect();
        travels.sort_by(f64::total_cmp);
        Ok(travels.get(travels.len() * 99 / 100).copied().unwrap_or(0.0))
    }

    fn find_seen(&self) -> Result<Vec<SeenPoint>, RenderError> {
        let Camera { pose, intrinsics } = self.moment.camera;
        let small = intrinsics.scaled(SMALL_FRAC);
        let render = RenderSettings { quality: Quality::Standard, accuracy: None, ..self.moment.render };
        let depths = self.renderer.depth(&Camera { pose, intrinsics: small }, &render)?;
        let step = DVec2::new(
            f64::from(intrinsics.width) / f64::from(small.width),
            f64::from(intrinsics.height) / f64::from(small.height),
        );
        let place = |idx: usize| {
            let (column, row) = (idx % small.width as usize, idx / small.width as usize);
            DVec2::new(column as f64 + 0.5, row as f64 + 0.5) * step
        };
        let points = depths.median.iter().enumerate().filter(|(_, depth)| depth.is_finite());
        Ok(points.map(|(idx, &depth)| SeenPoint { position_px: place(idx), depth: f64::from(depth) }).collect())
    }
}

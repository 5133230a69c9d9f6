use std::time::Instant;

use crate::pipeline::accuracy::at;
use cinesplat_geometry::{Camera, Intrinsics};
use cinesplat_render::{Quality, RenderError, RenderSettings, Renderer};

/// Size of the crop that `reference` renders.
const CUTOUT_PX: [u32; 2] = [128, 72];
/// Size of the crop that measures the fixed cost of `reference`.
const LEAST_PX: [u32; 2] = [8, 8];

/// `final` compared with `reference` on a crop from the middle of a picture.
#[derive(Debug, Clone, Copy)]
pub(super) struct ReferenceSample {
    /// PSNR of `final`, dB.
    pub(super) final_db: f64,
    /// Seconds that `reference` took.
    secs: f64,
    /// Block blends that `final` counted.
    num_blends: f64,
}

impl ReferenceSample {
    pub(super) fn of(renderer: &Renderer<'_>, camera: &Camera, settings: &RenderSettings) -> Result<Self, RenderError> {
        let cutout = middle(camera, CUTOUT_PX);
        let best = renderer.render(&cutout, &at(settings, Quality::Final))?;
        let start = Instant::now();
        let exact = renderer.render(&cutout, &at(settings, Quality::Reference))?;
        let secs = start.elapsed().as_secs_f64();
        // At 150 dB the 8-bit pictures are equal.
        let final_db = best.psnr_db(&exact).min(150.0);
        Ok(Self { final_db, secs, num_blends: best.stats.counts.num_block_blends as f64 })
    }

    /// Seconds that `reference` takes for the whole picture: those of the crop, scaled by the number of block blends that
    /// `final` counts.
    pub(super) fn reference_secs(
        &self,
        renderer: &Renderer<'_>,
        camera: &Camera,
        settings: &RenderSettings,
    ) -> Result<f64, RenderError> {
        let start = Instant::now();
        renderer.render(&middle(camera, LEAST_PX), &at(settings, Quality::Reference))?;
        let fixed = start.elapsed().as_secs_f64();
        let whole = renderer.render(camera, &at(settings, Quality::Final))?.stats.counts.num_block_blends as f64;
        Ok(fixed + (self.secs - fixed).max(0.0) * whole / self.num_blends.max(1.0))
    }
}

/// The camera cropped to the middle of its picture, at most `size_px` pixels.
fn middle(camera: &Camera, size_px: [u32; 2]) -> Camera {
    let whole = camera.intrinsics;
    let (width, height) = (size_px[0].min(whole.width), size_px[1].min(whole.height));
    let intrinsics = Intrinsics {
        width,
        height,
        cx_px: whole.cx_px - f64::from(whole.width - width) / 2.0,
        cy_px: whole.cy_px - f64::from(whole.height - height) / 2.0,
        ..whole
    };
    Camera { pose: camera.pose, intrinsics }
}

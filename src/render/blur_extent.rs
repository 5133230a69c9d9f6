use glam::DVec3;

use super::blur::SplatBlur;
use super::groups::{LANES, Pack};
use super::{RenderError, RenderSettings, Renderer, View};
use cinesplat_geometry::Camera;

/// Gaussians that are looked at, about; a tenth of them is visible in a typical picture.
const NUM_SAMPLES: usize = 8192;
/// The fraction of the visible splats that may be blurred more.
const PERCENTILE: f64 = 0.99;

/// How much blur there is in a picture: 99th percentiles over a sample of the splats in it, pixels.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct BlurExtent {
    /// Diameter of the circle of confusion.
    pub circle_px: f64,
    /// Length of the motion.
    pub motion_px: f64,
    /// Number of splats in the sample.
    pub num_splats: usize,
}

impl Renderer<'_> {
    /// The extent of blur in the picture of a camera. Takes a fraction of a millisecond: looks at a fixed sample of the
    /// Gaussians, and only at their means. Zeros for a picture without splats.
    ///
    /// # Errors
    /// [`RenderError::Camera`] for an unusable camera, [`RenderError::Setting`] for a setting or a lens out of range.
    pub fn blur_extent(
        &self,
        camera: &Camera,
        blur: &SplatBlur,
        settings: &RenderSettings,
    ) -> Result<BlurExtent, RenderError> {
        let view = View::new(camera, self.origin(), settings)?.blurred(blur, self.origin())?;
        let Some(view_blur) = view.blur else { return Ok(BlurExtent::default()) };
        let packs = self.packs();
        let step = (packs.len() * LANES / NUM_SAMPLES).max(1);
        let visible = packs.iter().step_by(step).flat_map(|pack| visible_means(&view, pack));
        let (mut circles, mut motions): (Vec<f64>, Vec<f64>) =
            visible.map(|(mean, depth)| view_blur.lengths_px(mean, depth).into()).unzip();
        let num_splats = circles.len();
        Ok(BlurExtent { circle_px: percentile(&mut circles), motion_px: percentile(&mut motions), num_splats })
    }
}

/// Means in the picture and in front of the near plane, with their depths, of Gaussians above the alpha cut.
fn visible_means(view: &View, pack: &Pack) -> impl Iterator<Item = (DVec3, f64)> {
    (0..LANES).filter_map(|lane| {
        let mean = DVec3::from(pack.mean.map(|axis| f64::from(axis[lane])));
        let p = view.camera_from_world * (mean - view.center);
        let ([fx, fy], [cx, cy]) = (view.focal_px, view.principal_px);
        let (x, y) = (fx * p.x / p.z + cx, fy * p.y / p.z + cy);
        let is_inside = x > 0.0 && x < f64::from(view.width) && y > 0.0 && y < f64::from(view.height);
        let is_drawn = f64::from(pack.opacity[lane]) >= view.alpha_cut;
        (p.z > view.near && is_inside && is_drawn).then_some((mean, p.z))
    })
}

fn percentile(lengths: &mut [f64]) -> f64 {
    if lengths.is_empty() {
        return 0.0;
    }
    let place = (((lengths.len() - 1) as f64) * PERCENTILE) as usize;
    *lengths.select_nth_unstable_by(place, f64::total_cmp).1
}

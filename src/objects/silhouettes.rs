//! An object seen from all sides: the masks of its views, and how well the alpha shapes of some points cover them.

use cinesplat_geometry::Camera;
use cinesplat_render::Renderer;
use cinesplat_scene::{Gaussians, SplatFilter};
use glam::{DVec2, DVec3};
use rayon::prelude::*;

use super::alpha_shape::AlphaShapes;
use super::error::ObjectsError;
use super::mask::Mask;
use super::radius_search::{Coverage, RadiusMinimum, RadiusOptimizer};

/// One view of an object.
pub(crate) struct View {
    pub(crate) camera: Camera,
    pub(crate) mask: Mask,
}

/// The views of an object in which its mask is not empty.
pub(crate) struct Silhouettes {
    pub(crate) views: Vec<View>,
}

/// The alpha shapes of some points at their best radius, against the masks.
pub(crate) struct Fit {
    /// The radius, px, and the mismatch.
    pub(crate) minimum: RadiusMinimum,
    /// Mean over the views of the overlap (intersection over union) of shape and mask, 0..=1.
    pub(crate) mask_iou: f64,
    /// The least radius (px) at which the shape covers each pixel, per view.
    radii_px: Vec<Vec<f32>>,
}

impl Fit {
    /// The pixels of a view that the shape of a radius covers.
    pub(crate) fn covered(&self, view_idx: usize, radius_px: f64) -> Vec<bool> {
        self.radii_px[view_idx].iter().map(|radius| f64::from(*radius) <= radius_px).collect()
    }
}

impl Silhouettes {
    /// Renders the masks of an object's Gaussians.
    pub(crate) fn new(gaussians: &Gaussians, cameras: &[Camera], filter: SplatFilter) -> Result<Self, ObjectsError> {
        let renderer = Renderer::new(gaussians);
        let view = |camera: &Camera| Ok(View { camera: *camera, mask: Mask::render(&renderer, camera, filter)? });
        let views: Result<Vec<View>, ObjectsError> = cameras.par_iter().map(view).collect();
        Ok(Self { views: views?.into_iter().filter(|view| view.mask.area() > 0).collect() })
    }

    /// Fits the radius of the points' alpha shapes to the masks.
    pub(crate) fn fit(&self, points: &[DVec3], optimizer: RadiusOptimizer) -> Fit {
        let radii_px: Vec<Vec<f32>> = self.views.par_iter().map(|view| view.covering_radii_px(points)).collect();
        let mut coverage = Coverage::default();
        for (view, radii_px) in self.views.iter().zip(&radii_px) {
            coverage.add(radii_px, &view.mask.inside);
        }
        let minimum = coverage.minimize(optimizer);
        let mut fit = Fit { minimum, mask_iou: 0.0, radii_px };
        let overlap_of = |idx: usize| overlap(&self.views[idx].mask.inside, &fit.covered(idx, minimum.radius_px));
        fit.mask_iou = (0..self.views.len()).map(overlap_of).sum::<f64>() / self.views.len().max(1) as f64;
        fit
    }
}

impl View {
    fn covering_radii_px(&self, points: &[DVec3]) -> Vec<f32> {
        let positions_px: Vec<DVec2> = points.iter().filter_map(|p| self.position_px(*p)).collect();
        AlphaShapes::new(&positions_px).covering_radii_px(self.mask.size, self.mask.size)
    }

    /// Pixel position of a point; `None` behind the camera.
    pub(crate) fn position_px(&self, point: DVec3) -> Option<DVec2> {
        self.camera.project(point).map(|(px, _)| px)
    }
}

/// Intersection over union; 1 of two empty pictures.
fn overlap(a: &[bool], b: &[bool]) -> f64 {
    let both = a.iter().zip(b).filter(|(a, b)| **a && **b).count();
    let any = a.iter().zip(b).filter(|(a, b)| **a || **b).count();
    if any > 0 { both as f64 / any as f64 } else { 1.0 }
}

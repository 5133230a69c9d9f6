//! The surface of a subject as far as it was captured.

use cinesplat_scene::Gaussians;
use glam::DVec3;

/// Facets that a subject keeps, and those from which its sides can be told.
const MAX_FACETS: usize = 200;
const MIN_FACETS: usize = 24;

/// The flat Gaussians of a subject, with normals that point away from its middle.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Facets {
    /// Where each is, and its outward normal times its area.
    facets: Vec<(DVec3, DVec3)>,
}

impl Facets {
    /// Facets of the Gaussians `own` of a subject.
    pub(super) fn of(gaussians: &Gaussians, own: &[usize], center: DVec3) -> Self {
        let stride = own.len().div_ceil(MAX_FACETS).max(1);
        let facet = |&i: &usize| {
            let (normal, area) = gaussians.facet(i)?;
            let mean = gaussians.mean_world(i);
            let outward = if normal.dot(mean - center) < 0.0 { -normal } else { normal };
            Some((mean, outward * area))
        };
        Self { facets: own.iter().step_by(stride).filter_map(facet).collect() }
    }

    /// Share of the surface whose outer side faces a camera at `eye`, 0..=1; `None` where too few facets are known.
    pub(super) fn front_frac(&self, eye: DVec3) -> Option<f64> {
        let total: f64 = self.facets.iter().map(|(_, normal)| normal.length()).sum();
        let front = self.facets.iter().filter(|(mean, normal)| normal.dot(eye - *mean) > 0.0);
        let front: f64 = front.map(|(_, normal)| normal.length()).sum();
        (self.facets.len() >= MIN_FACETS && total > 0.0).then(|| front / total)
    }
}

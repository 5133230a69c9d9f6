//! The surface of a subject as far as it was captured.

use cinesplat_scene::Gaussians;
use glam::DVec3;

/// Facets that a subject keeps, and those from which its sides can be told.
const MAX_FACETS: usize = 200;
const MIN_FACETS: usize = 24;

/// Distance of a facet's plane from the middle of its subject, over the subject's radius, below which its outer side
/// cannot be told: a screen on a wall that was captured from the front is a sheet through the middle of its box.
const LEAST_DEPTH: f64 = 0.2;

/// A flat Gaussian of a subject.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Facet {
    mean: DVec3,
    /// Its normal times its area; outward where that can be told.
    normal: DVec3,
    is_two_sided: bool,
}

impl Facet {
    /// Area that a camera sees in a direction.
    fn shown(&self, toward: DVec3) -> f64 {
        let shown = self.normal.dot(toward);
        if self.is_two_sided { shown.abs() } else { shown.max(0.0) }
    }
}

/// The flat Gaussians of a subject, with normals that point away from its middle.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Facets {
    facets: Vec<Facet>,
}

impl Facets {
    /// Facets of the Gaussians `own` of a subject.
    pub(super) fn of(gaussians: &Gaussians, own: &[usize], center: DVec3, radius: f64) -> Self {
        let stride = own.len().div_ceil(MAX_FACETS).max(1);
        let facet = |&i: &usize| {
            let (normal, area) = gaussians.facet(i)?;
            let mean = gaussians.mean_world(i);
            let depth = normal.dot(mean - center);
            let is_two_sided = depth.abs() < LEAST_DEPTH * radius;
            Some(Facet { mean, normal: normal * area * depth.signum(), is_two_sided })
        };
        Self { facets: own.iter().step_by(stride).filter_map(facet).collect() }
    }

    /// Area that a camera at `eye` sees, over the largest that one at the same height sees around the subject's `center`,
    /// 0..=1: a picture on a wall from the side has little of it, a table the same from everywhere. `None` where too few
    /// facets are known.
    pub(super) fn breadth(&self, center: DVec3, eye: DVec3, up: DVec3) -> Option<f64> {
        if self.facets.len() < MIN_FACETS {
            return None;
        }
        let shown = |toward: DVec3| self.facets.iter().map(|facet| facet.shown(toward)).sum::<f64>();
        let toward = (eye - center).try_normalize()?;
        let around = |i: u8| glam::DQuat::from_axis_angle(up, std::f64::consts::TAU * f64::from(i) / 24.0) * toward;
        let widest = (0..24).map(|i| shown(around(i))).fold(0.0, f64::max);
        (widest > 0.0).then(|| shown(toward) / widest)
    }

    /// Share of the surface whose outer side faces a camera at `eye`, 0..=1; `None` where too few facets are known.
    pub(super) fn front_frac(&self, eye: DVec3) -> Option<f64> {
        let area = |facet: &Facet| facet.normal.length();
        let total: f64 = self.facets.iter().map(area).sum();
        let faces = |facet: &&Facet| facet.is_two_sided || facet.normal.dot(eye - facet.mean) > 0.0;
        let front: f64 = self.facets.iter().filter(faces).map(area).sum();
        (self.facets.len() >= MIN_FACETS && total > 0.0).then(|| front / total)
    }
}

//! Sparse clouds: the few points that represent an object's shape.
//!
//! Enters: a scene and its objects with Gaussians. Leaves: for every object points whose alpha shapes cover its masks in a
//! ring of views, the one radius of these shapes, and their overlap with the masks. Radius and overlap are those of the
//! points that are kept.

use glam::DVec3;
use rayon::prelude::*;

use super::candidates::candidates;
use super::error::ObjectsError;
use super::kept_points::keep;
use super::object::{Object, ObjectSet, PointFeatures};
use super::radius_search::RadiusOptimizer;
use super::sampling::{PointSampler, border_points, farthest_points, in_canonical_order, uniform_points, voxel_points};
use super::silhouettes::{Fit, Silhouettes};
use super::views;
use cinesplat_scene::{Gaussians, SOLID_OPACITY, Scene, SplatFilter};

/// Gaussians farther outside the box than this share of its radius are dropped as floaters.
const FLOATER_FRAC: f64 = 0.1;

/// Least number of points that can enclose a volume. With fewer, all means represent the object.
const MIN_POINTS: usize = 4;

/// Largest share of an object's Gaussians that is kept, unless they are few.
const MAX_KEPT_FRAC: f64 = 0.02;

/// Number of points that may be kept of every object.
const ALWAYS_KEPT: usize = 128;

/// Settings of [`fill_clouds`]. Larger values are slower and follow the silhouettes more closely.
#[derive(Debug, Clone, PartialEq)]
pub struct CloudSettings {
    /// Cameras around the object per elevation.
    pub num_azimuths: usize,
    /// Elevations of the rings, seen from the object's middle, rad.
    pub elevations_rad: Vec<f64>,
    /// Width and height of the masks, at least 8.
    pub mask_size_px: u32,
    /// Limit on the number of points per object. An object of fewer than 50 Gaussians per point keeps 2 % of them, at
    /// least 128.
    pub points: usize,
    /// Overlap that may be missing: no point is added once the alpha shapes overlap the masks by `1 - tolerance`.
    pub tolerance: f64,
    /// How the radius is found.
    pub optimizer: RadiusOptimizer,
    /// How the points are chosen.
    pub sampler: PointSampler,
}

impl Default for CloudSettings {
    fn default() -> Self {
        Self {
            num_azimuths: 8,
            elevations_rad: vec![0.0, 0.5, 1.1],
            mask_size_px: 96,
            points: 512,
            tolerance: 0.03,
            optimizer: RadiusOptimizer::ExactSweep,
            sampler: PointSampler::Silhouette,
        }
    }
}

/// Computes the sparse cloud of every object without points. Clear `points` to recompute a cloud.
///
/// The radius minimizes the mismatch of alpha shapes and masks, one radius for all views. The result depends on the set of
/// Gaussians, not on their order or on duplicates, and rotates with object and world. An object without Gaussians gets the
/// corners of its box. An object with fewer than four candidates gets all its distinct means.
///
/// # Errors
/// [`ObjectsError::Picture`] where a mask cannot be rendered.
pub fn fill_clouds(scene: &Scene, set: &mut ObjectSet, settings: &CloudSettings) -> Result<(), ObjectsError> {
    let all: Vec<u32> = set.objects.iter().map(|object| object.id).collect();
    fill_clouds_of(scene, set, &all, settings)
}

/// As [`fill_clouds`], for the objects with the given ids.
///
/// # Errors
/// [`ObjectsError::Picture`] where a mask cannot be rendered.
pub fn fill_clouds_of(
    scene: &Scene,
    set: &mut ObjectSet,
    ids: &[u32],
    settings: &CloudSettings,
) -> Result<(), ObjectsError> {
    let members = set.members();
    let filter = scene.filter.unwrap_or(SplatFilter::Classic);
    let is_missing = |object: &&mut Object| object.points.is_empty() && ids.contains(&object.id);
    let missing: Vec<&mut Object> = set.objects.iter_mut().filter(is_missing).collect();
    missing.into_par_iter().try_for_each(|object| {
        object.features = PointFeatures::default();
        let members = members.get(&object.id).map_or(&[][..], Vec::as_slice);
        let gaussians = near_box(&scene.gaussians, members, object);
        if gaussians.is_empty() {
            object.points = object.corners().to_vec();
            return Ok(());
        }
        let cloud = cloud_of(object, &gaussians, (scene.up, filter), settings)?;
        (object.points, object.shape_radius, object.mask_iou) = (cloud.points, cloud.shape_radius, cloud.mask_iou);
        Ok(())
    })
}

struct Cloud {
    points: Vec<DVec3>,
    shape_radius: f64,
    mask_iou: f64,
}

/// The Gaussians of an object in canonical order, without floaters and duplicates.
pub(crate) fn near_box(gaussians: &Gaussians, members: &[usize], object: &Object) -> Gaussians {
    let margin = FLOATER_FRAC * object.radius();
    let near = |&i: &usize| object.contains(gaussians.mean_world(i), margin);
    let mut chosen: Vec<usize> = members.iter().copied().filter(near).collect();
    let key = |&i: &usize| {
        let (mean, scale) = (gaussians.means[i], gaussians.scales[i]);
        [mean.x, mean.y, mean.z, scale.x, scale.y, scale.z, gaussians.opacities[i]].map(f32::to_bits)
    };
    chosen.sort_by_cached_key(key);
    chosen.dedup_by_key(|i| key(i));
    gaussians.subset(&chosen)
}

fn cloud_of(
    object: &Object,
    gaussians: &Gaussians,
    (up, filter): (DVec3, SplatFilter),
    settings: &CloudSettings,
) -> Result<Cloud, ObjectsError> {
    let size_px = settings.mask_size_px.max(8);
    let cameras = views::ring(object, up, settings.num_azimuths, &settings.elevations_rad, size_px);
    let silhouettes = Silhouettes::new(gaussians, &cameras, filter)?;
    let unit = cameras.first().map_or(1.0, |camera| views::unit_per_px(camera, object));
    let budget = settings.points.min(((gaussians.len() as f64 * MAX_KEPT_FRAC) as usize).max(ALWAYS_KEPT));
    let (points, fit) = kept(gaussians, &silhouettes, budget, settings);
    // Far points first, so that the first points of a cloud are a coarser cloud.
    let points = farthest_points(&points, points.len());
    Ok(Cloud { points, shape_radius: fit.minimum.radius_px * unit, mask_iou: fit.mask_iou })
}

/// The kept points and the fit of their alpha shapes.
fn kept(
    gaussians: &Gaussians,
    silhouettes: &Silhouettes,
    budget: usize,
    settings: &CloudSettings,
) -> (Vec<DVec3>, Fit) {
    let optimizer = settings.optimizer;
    let means = solid_means(gaussians);
    if settings.sampler == PointSampler::Silhouette && means.len() >= MIN_POINTS {
        let candidates = candidates(gaussians, silhouettes);
        if candidates.len() >= MIN_POINTS {
            return keep(&candidates, silhouettes, (budget, settings.tolerance), optimizer);
        }
    }
    let cameras = || silhouettes.views.iter().map(|view| view.camera).collect::<Vec<_>>();
    let chosen = match settings.sampler {
        PointSampler::Silhouette | PointSampler::Farthest => farthest_points(&means, budget),
        PointSampler::Uniform => uniform_points(&means, budget, 0),
        PointSampler::VoxelGrid => voxel_points(&means, budget),
        PointSampler::Hull => farthest_points(&border_points(&means, &cameras(), f64::INFINITY), budget),
        PointSampler::AlphaBorder => {
            let radius_px = silhouettes.fit(&means, optimizer).minimum.radius_px;
            farthest_points(&border_points(&means, &cameras(), radius_px), budget)
        }
    };
    let chosen = if chosen.len() < MIN_POINTS { farthest_points(&means, budget) } else { chosen };
    let fit = silhouettes.fit(&chosen, optimizer);
    (chosen, fit)
}

/// Distinct means of the solid Gaussians in canonical order; of all Gaussians where fewer than a tenth are solid.
fn solid_means(gaussians: &Gaussians) -> Vec<DVec3> {
    let means = |least: f32| (0..gaussians.len()).filter(move |&i| gaussians.opacities[i] >= least);
    let least = if means(SOLID_OPACITY).count() * 10 >= gaussians.len() { SOLID_OPACITY } else { 0.0 };
    in_canonical_order(means(least).map(|i| gaussians.mean_world(i)).collect())
}

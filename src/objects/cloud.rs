//! Sparse clouds: the few points that represent an object's shape.
//!
//! Enters: a scene and its objects with Gaussians. Leaves: for every object the points on the border of its alpha shape
//! in at least one view of a ring of cameras, the common radius of these shapes, and their overlap with the rendered
//! masks.

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use super::alpha_shape::AlphaShapes;
use super::error::ObjectsError;
use super::object::{Object, ObjectSet};
use super::sampling::{farthest_points, in_canonical_order};
use super::{boxes, radius_search, views};
use cinesplat_geometry::Camera;
use cinesplat_render::{Quality, RenderSettings, Renderer};
use cinesplat_scene::{Gaussians, SOLID_OPACITY, Scene, SplatFilter};

/// Gaussians farther outside the box than this share of its radius are dropped as floaters.
const FLOATER_FRAC: f64 = 0.1;

/// Least number of border points that can enclose a volume. With fewer, all points represent the object.
const MIN_BORDER: usize = 4;

/// Transmittance below which a pixel belongs to the object's mask.
const MASK_TRANSMITTANCE: f32 = 0.5;

/// Settings of [`fill_clouds`]. Larger values are slower and follow the silhouettes more closely.
#[derive(Debug, Clone, PartialEq)]
pub struct CloudSettings {
    /// Cameras around the object per elevation.
    pub num_azimuths: usize,
    /// Elevations of the rings, seen from the object's middle, rad.
    pub elevations_rad: Vec<f64>,
    /// Width and height of the masks, at least 8.
    pub mask_size_px: u32,
    /// Edge of the squares that divide the picture. One Gaussian per square is triangulated; 0 triangulates all.
    pub thinning_px: f64,
    /// Limit on the number of radii that are compared with the masks.
    pub search_budget: usize,
    /// Limit on the number of points per object, by farthest point sampling.
    pub max_points: usize,
}

impl Default for CloudSettings {
    fn default() -> Self {
        Self {
            num_azimuths: 8,
            elevations_rad: vec![0.0, 0.5, 1.1],
            mask_size_px: 96,
            thinning_px: 0.5,
            search_budget: 24,
            max_points: 256,
        }
    }
}

/// Computes the sparse cloud of every object without points. Clear `points` to recompute a cloud.
///
/// A derivative-free search finds the radius of the largest mean overlap (intersection over union) of alpha shapes and
/// masks over all views. The result depends on the set of Gaussians, not on their order or on duplicates, and rotates
/// with object and world. An object without Gaussians gets the corners of its box. An object whose border has fewer
/// than four points gets all its distinct points.
///
/// # Errors
/// [`ObjectsError::Picture`] where a mask cannot be rendered.
pub fn fill_clouds(scene: &Scene, set: &mut ObjectSet, settings: &CloudSettings) -> Result<(), ObjectsError> {
    let ObjectSet { objects, labels } = set;
    let members = boxes::members_by_id(labels);
    for object in objects.iter_mut().filter(|object| object.points.is_empty()) {
        let members = members.get(&object.id).map_or(&[][..], Vec::as_slice);
        let gaussians = near_box(&scene.gaussians, members, object);
        if gaussians.is_empty() {
            object.points = object.corners().to_vec();
            continue;
        }
        let filter = scene.filter.unwrap_or(SplatFilter::Classic);
        let cloud = cloud_of(object, &gaussians, (scene.up, filter), settings)?;
        (object.points, object.shape_radius, object.mask_iou) = (cloud.points, cloud.shape_radius, cloud.mask_iou);
    }
    Ok(())
}

struct Cloud {
    points: Vec<DVec3>,
    shape_radius: f64,
    mask_iou: f64,
}

/// The Gaussians of an object, without floaters.
fn near_box(gaussians: &Gaussians, members: &[usize], object: &Object) -> Gaussians {
    let margin = FLOATER_FRAC * object.radius();
    let near = |&i: &usize| object.contains(gaussians.mean_world(i), margin);
    let chosen: Vec<usize> = members.iter().copied().filter(near).collect();
    let num_rest = gaussians.sh_rest.len() / gaussians.len().max(1);
    Gaussians {
        origin: gaussians.origin,
        means: chosen.iter().map(|&i| gaussians.means[i]).collect(),
        scales: chosen.iter().map(|&i| gaussians.scales[i]).collect(),
        rotations: chosen.iter().map(|&i| gaussians.rotations[i]).collect(),
        opacities: chosen.iter().map(|&i| gaussians.opacities[i]).collect(),
        sh_dc: chosen.iter().map(|&i| gaussians.sh_dc[i]).collect(),
        sh_degree: gaussians.sh_degree,
        sh_rest: chosen.iter().flat_map(|&i| &gaussians.sh_rest[i * num_rest..(i + 1) * num_rest]).copied().collect(),
        ids: Vec::new(),
    }
}

fn cloud_of(
    object: &Object,
    gaussians: &Gaussians,
    world: (DVec3, SplatFilter),
    settings: &CloudSettings,
) -> Result<Cloud, ObjectsError> {
    let (up, filter) = world;
    let points = solid_points(gaussians);
    let size_px = settings.mask_size_px.max(8);
    let cameras = views::ring(object, up, settings.num_azimuths, &settings.elevations_rad, size_px);
    let renderer = Renderer::new(gaussians);
    let silhouettes: Result<Vec<Silhouette>, ObjectsError> = cameras
        .par_iter()
        .map(|camera| {
            let mask = mask(&renderer, camera, filter)?;
            Ok(Silhouette::new(&points, camera, &mask, settings.thinning_px))
        })
        .collect();
    let silhouettes = silhouettes?;
    let unit = cameras.first().map_or(1.0, |camera| views::unit_per_px(camera, object));
    let found = best_radius(&silhouettes, settings);
    let mut on_border: Vec<usize> = silhouettes.iter().flat_map(|view| view.border(found.radius)).collect();
    on_border.sort_unstable();
    on_border.dedup();
    let border: Vec<DVec3> = on_border.into_iter().map(|i| points[i]).collect();
    let chosen = if border.len() < MIN_BORDER { &points } else { &border };
    let points = farthest_points(chosen, settings.max_points);
    Ok(Cloud { points, shape_radius: found.radius * unit, mask_iou: found.value })
}

/// Distinct means of the solid Gaussians in canonical order; of all Gaussians where fewer than a tenth are solid.
fn solid_points(gaussians: &Gaussians) -> Vec<DVec3> {
    let means = |least: f32| (0..gaussians.len()).filter(move |&i| gaussians.opacities[i] >= least);
    let least = if means(SOLID_OPACITY).count() * 10 >= gaussians.len() { SOLID_OPACITY } else { 0.0 };
    in_canonical_order(means(least).map(|i| gaussians.mean_world(i)).collect())
}

/// The pixels that the object covers.
fn mask(renderer: &Renderer, camera: &Camera, filter: SplatFilter) -> Result<Vec<bool>, ObjectsError> {
    let settings = RenderSettings { quality: Quality::Standard, filter, near: 0.0, ..RenderSettings::default() };
    let picture = renderer.render(camera, &settings);
    let frame = picture.map_err(|error| ObjectsError::Picture { reason: error.to_string() })?;
    Ok(frame.transmittance.iter().map(|&t| t < MASK_TRANSMITTANCE).collect())
}

/// One view of an object: the alpha shapes of its points and its rendered mask.
struct Silhouette {
    shapes: AlphaShapes,
    /// For each point of the shapes, the index of the object's point.
    point_from_shape: Vec<usize>,
    /// Least radius (px) at which the shape covers each pixel of the mask, ascending.
    inside_px: Vec<f32>,
    /// The same for the pixels outside the mask.
    outside_px: Vec<f32>,
}

impl Silhouette {
    fn new(points: &[DVec3], camera: &Camera, mask: &[bool], thinning_px: f64) -> Self {
        let size = camera.intrinsics.width as usize;
        let (point_from_shape, positions_px) = project(points, camera, thinning_px);
        let shapes = AlphaShapes::new(&positions_px);
        let radii_px = shapes.covering_radii_px(size, mask.len() / size);
        let of = |wanted: bool| {
            let mut chosen: Vec<f32> =
                radii_px.iter().zip(mask).filter(|(_, m)| **m == wanted).map(|(r, _)| *r).collect();
            chosen.sort_unstable_by(f32::total_cmp);
            chosen
        };
        Self { inside_px: of(true), outside_px: of(false), shapes, point_from_shape }
    }

    /// Intersection over union of the mask and the shape of a radius.
    fn overlap(&self, radius_px: f64) -> f64 {
        let covered = |radii: &[f32]| radii.partition_point(|&r| f64::from(r) <= radius_px) as f64;
        let union = self.inside_px.len() as f64 + covered(&self.outside_px);
        if union > 0.0 { covered(&self.inside_px) / union } else { 0.0 }
    }

    fn border(&self, radius_px: f64) -> Vec<usize> {
        self.shapes.border(radius_px).into_iter().map(|i| self.point_from_shape[i]).collect()
    }
}

/// Indices and pixel positions of the points in front of the camera: the first one per square of side `thinning_px`.
fn project(points: &[DVec3], camera: &Camera, thinning_px: f64) -> (Vec<usize>, Vec<DVec2>) {
    let seen = points.iter().enumerate().filter_map(|(i, &p)| camera.project(p).map(|(px, _)| (i, px)));
    if thinning_px.is_nan() || thinning_px <= 0.0 {
        return seen.unzip();
    }
    let mut cells: Vec<(i64, i64, usize, DVec2)> =
        seen.map(|(i, px)| ((px.x / thinning_px).floor() as i64, (px.y / thinning_px).floor() as i64, i, px)).collect();
    cells.sort_unstable_by_key(|&(x, y, i, _)| (x, y, i));
    cells.dedup_by_key(|&mut (x, y, ..)| (x, y));
    cells.into_iter().map(|(_, _, i, px)| (i, px)).unzip()
}

/// The radius (px) with the largest mean overlap over all views, between half a pixel and the picture's diagonal.
fn best_radius(silhouettes: &[Silhouette], settings: &CloudSettings) -> radius_search::RadiusMaximum {
    let high = 2.0 * f64::from(settings.mask_size_px.max(8));
    let num_views = silhouettes.len().max(1) as f64;
    let mean = |radius_px: f64| silhouettes.iter().map(|view| view.overlap(radius_px)).sum::<f64>() / num_views;
    radius_search::maximize(0.5, high, settings.search_budget, mean)
}

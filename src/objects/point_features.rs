//! Features of the points of a cloud, from pictures of their object.
//!
//! Enters: clouds, and a function that describes a picture by a grid of patches, such as a network for pictures. Leaves: one
//! row of numbers per point. Each object is rendered alone from all around, each picture cropped to its mask. A point takes the
//! features of its place in every picture, interpolated between the patches, and averages them by the blending weights of the
//! Gaussians around it. A picture in which it is hidden says nothing about it.

use glam::{DVec2, DVec3};

use super::cloud::near_box;
use super::crop::cropped;
use super::error::ObjectsError;
use super::near_gaussians::nearest;
use super::object::{Object, ObjectSet, PointFeatures};
use super::photo::photo;
use super::views;
use cinesplat_geometry::Camera;
use cinesplat_render::{DepthMap, LiftedValues, Quality, RenderError, RenderSettings, Renderer};
use cinesplat_scene::{Gaussians, Scene, SplatFilter};

/// Color behind an object: the mean of the photos of ImageNet, which is zero for most networks.
const BACKGROUND: [f32; 3] = [0.485, 0.456, 0.406];

/// Depth behind the surface at which a point is hidden, over half the diagonal of its object's box: points of the outline lie
/// somewhat behind the surface that their pixel shows.
const SLACK_FRAC: f64 = 0.1;

/// Settings of [`fill_features`]. More and larger pictures are slower.
#[derive(Debug, Clone, PartialEq)]
pub struct FeatureSettings {
    /// Cameras around the object per elevation.
    pub num_azimuths: usize,
    /// Elevations of the rings, seen from the object's middle, rad.
    pub elevations_rad: Vec<f64>,
    /// Width and height of the pictures.
    pub picture_px: u32,
    /// Rows and columns of the grid that describes a picture.
    pub side_patches: usize,
}

impl FeatureSettings {
    /// Two rings of six pictures with 16 x 16 patches of a size.
    pub fn of_patches(patch_px: usize) -> Self {
        let side_patches = 16;
        let picture_px = u32::try_from(side_patches * patch_px).unwrap_or(u32::MAX);
        Self { num_azimuths: 6, elevations_rad: vec![0.1, 0.8], picture_px, side_patches }
    }
}

/// Describes a picture (`[(row * picture_px + column) * 3 + channel]`, display-referred) by the features of its patches
/// (`[(row * side_patches + column) * num_channels + channel]`).
pub type Describe<'a, E> = dyn FnMut(&[u8]) -> Result<Vec<f32>, E> + 'a;

/// Gives the points of every object with a cloud and Gaussians their features. `progress` gets the number of objects done and
/// of all.
///
/// # Errors
/// [`ObjectsError::Picture`] where a picture cannot be rendered, or `describe` returns another number of features than for
/// other pictures; the errors of `describe`.
pub fn fill_features<E: From<ObjectsError>>(
    scene: &Scene,
    set: &mut ObjectSet,
    settings: &FeatureSettings,
    describe: &mut Describe<E>,
    progress: &mut dyn FnMut(usize, usize),
) -> Result<(), E> {
    let members = set.members();
    let num_objects = set.objects.len();
    for (idx, object) in set.objects.iter_mut().enumerate() {
        let members = members.get(&object.id).map_or(&[][..], Vec::as_slice);
        let gaussians = near_box(&scene.gaussians, members, object);
        object.features = PointFeatures::default();
        if !object.points.is_empty() && !gaussians.is_empty() {
            object.features = features_of(scene, (object, &gaussians), settings, describe)?;
        }
        progress(idx + 1, num_objects);
    }
    Ok(())
}

fn features_of<E: From<ObjectsError>>(
    scene: &Scene,
    (object, gaussians): (&Object, &Gaussians),
    settings: &FeatureSettings,
    describe: &mut Describe<E>,
) -> Result<PointFeatures, E> {
    let filter = scene.filter.unwrap_or(SplatFilter::Classic);
    let renderer = Renderer::new(gaussians);
    let around = nearest(gaussians, &object.points);
    let mut sums = Sums::new(object.points.len());
    let side = settings.side_patches;
    for camera in views::ring(object, scene.up, settings.num_azimuths, &settings.elevations_rad, settings.picture_px) {
        let Some(camera) = cropped(&renderer, &camera, filter)? else { continue };
        let picture = photo(scene, &renderer, &camera, (0.0, BACKGROUND, Quality::Standard))?;
        let grid = Grid { side, px: f64::from(settings.picture_px), values: describe(picture.as_raw())? };
        let sight = Sight::new(&renderer, camera, filter, SLACK_FRAC * object.radius())?;
        for (idx, (point, around)) in object.points.iter().zip(&around).enumerate() {
            if let Some((position_px, weight)) = sight.of(*point, around) {
                sums.add(idx, weight, &grid, position_px)?;
            }
        }
    }
    Ok(sums.means())
}

/// What one picture shows of an object.
struct Sight {
    camera: Camera,
    /// Sum of the blending weights of every Gaussian over the pixels.
    weights: Vec<f64>,
    depth: DepthMap,
    /// Depth behind the surface at which a point is hidden.
    slack: f64,
}

impl Sight {
    fn new(renderer: &Renderer, camera: Camera, filter: SplatFilter, slack: f64) -> Result<Self, ObjectsError> {
        let failed = |error: RenderError| ObjectsError::Picture { reason: error.to_string() };
        let settings = RenderSettings { filter, near: 0.0, ..RenderSettings::default() };
        let mut lifted = LiftedValues::new(renderer.num_gaussians(), 0);
        renderer.lift(&camera, &settings, &[], &mut lifted).map_err(failed)?;
        let depth = renderer.depth(&camera, &settings).map_err(failed)?;
        Ok(Self { camera, weights: lifted.weights, depth, slack })
    }

    /// Position of a point (px), and the weight of the Gaussians around it; `None` where the point is hidden. Through a surface
    /// the last percents of light still pass, so that its weight alone does not tell.
    fn of(&self, point: DVec3, around: &[usize]) -> Option<(DVec2, f64)> {
        let (position_px, depth) = self.camera.project(point)?;
        let last = DVec2::new(f64::from(self.depth.width) - 1.0, f64::from(self.depth.height) - 1.0);
        let pixel = position_px.floor().clamp(DVec2::ZERO, last);
        let surface = f64::from(self.depth.median[pixel.y as usize * self.depth.width as usize + pixel.x as usize]);
        let weight: f64 = around.iter().map(|gaussian| self.weights[*gaussian]).sum();
        // Without a surface there is nothing before the point.
        let is_hidden = depth > surface + self.slack;
        (weight > 0.0 && !is_hidden).then_some((position_px, weight))
    }
}

/// The features of the patches of a square picture.
struct Grid {
    /// Rows and columns.
    side: usize,
    /// Width and height of the picture.
    px: f64,
    /// `[(row * side + column) * num_channels + channel]`
    values: Vec<f32>,
}

impl Grid {
    /// Numbers per patch; 0 where they are not as many for each.
    fn num_channels(&self) -> usize {
        let num_patches = (self.side * self.side).max(1);
        if self.values.len().is_multiple_of(num_patches) { self.values.len() / num_patches } else { 0 }
    }

    /// The four patches around a position, and the weight of each. Beyond the middles of the outer patches theirs count.
    fn around(&self, position_px: DVec2) -> [(usize, f32); 4] {
        let last = self.side.saturating_sub(1);
        let at = (position_px * (self.side as f64 / self.px) - 0.5).clamp(DVec2::ZERO, DVec2::splat(last as f64));
        let (before, frac) = (at.floor(), at - at.floor());
        std::array::from_fn(|corner| {
            let (right, down) = (corner % 2, corner / 2);
            let (column, row) = ((before.x as usize + right).min(last), (before.y as usize + down).min(last));
            let share = |is_far: usize, frac: f64| if is_far == 1 { frac } else { 1.0 - frac };
            (row * self.side + column, (share(right, frac.x) * share(down, frac.y)) as f32)
        })
    }
}

/// Weighted sums of features per point.
struct Sums {
    num_channels: usize,
    weights: Vec<f64>,
    /// `[point * num_channels + channel]`; empty before the first picture.
    values: Vec<f32>,
}

impl Sums {
    fn new(num_points: usize) -> Self {
        Self { num_channels: 0, weights: vec![0.0; num_points], values: Vec::new() }
    }

    /// Adds the features of a picture at a position to those of a point.
    fn add(&mut self, point: usize, weight: f64, grid: &Grid, position_px: DVec2) -> Result<(), ObjectsError> {
        if self.values.is_empty() {
            self.num_channels = grid.num_channels();
            self.values = vec![0.0; self.weights.len() * self.num_channels];
        }
        let (num, found, num_patches) = (self.num_channels, grid.values.len(), grid.side * grid.side);
        if num == 0 || found != num * num_patches {
            let expected =
                if num == 0 { format!("a multiple of {num_patches}") } else { (num * num_patches).to_string() };
            let reason = format!("{found} features of a picture, expected {expected}");
            return Err(ObjectsError::Picture { reason });
        }
        self.weights[point] += weight;
        let sums = &mut self.values[point * num..][..num];
        for (patch, share) in grid.around(position_px) {
            let share = weight as f32 * share;
            sums.iter_mut().zip(&grid.values[patch * num..][..num]).for_each(|(sum, value)| *sum += share * value);
        }
        Ok(())
    }

    fn means(mut self) -> PointFeatures {
        let rows = self.values.chunks_exact_mut(self.num_channels.max(1)).zip(&self.weights);
        for (row, weight) in rows.filter(|(_, weight)| **weight > 0.0) {
            row.iter_mut().for_each(|value| *value /= *weight as f32);
        }
        PointFeatures { num_channels: self.num_channels, values: self.values }
    }
}

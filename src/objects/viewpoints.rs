//! Viewpoints that show one object, or as many objects as possible.
//!
//! Enters: a scene with labels. Leaves: cameras. Candidates are compared on coarse pictures of object ids and depths,
//! rendered from a thinned scene.

use std::collections::{BTreeMap, BTreeSet};

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use super::boxes::upright_axes;
use super::error::ObjectsError;
use super::object::{Object, ObjectSet};
use super::surroundings::surrounds;
use super::voxels::VoxelGrid;
use cinesplat_geometry::{Camera, Intrinsics, LevelFrame, Pose};
use cinesplat_render::{RenderError, RenderSettings, Renderer};
use cinesplat_scene::{Gaussians, Scene};

/// Least opacity of an occluding Gaussian.
const OCCLUDER_OPACITY: f32 = 0.3;

/// Limit on the Gaussians of the thinned scene.
const MAX_GAUSSIANS: usize = 40_000;

/// Height of the coarse pictures.
const COARSE_HEIGHT_PX: u32 = 60;

/// Diagonal of an object, over the scene size, from which the scene shows one thing and is seen from outside.
const SINGLE_FRAC: f64 = 0.6;

/// Share of the matter that is that of objects, from which on the scene is no room.
const THINGS_FRAC: f64 = 0.9;

/// Voxels along the diagonal of a scene, to tell whether it surrounds a viewer.
const NUM_CELLS: f64 = 220.0;

/// Distance to the nearest Gaussian, over the scene size, below which a viewpoint counts as blocked.
const CLEARANCE_FRAC: f64 = 0.04;

/// Largest number of overviews of a room, least number of objects that a further one adds, and what an object counts that
/// an earlier one shows.
const MAX_OVERVIEWS: usize = 3;
const MIN_NEW: usize = 2;
const SEEN_WEIGHT: f64 = 0.15;

/// Least number of pixels in the coarse picture of an object whose id an overview shows.
pub(crate) const MIN_ID_PIXELS: usize = 6;

/// Elevations from which one object may be seen, rad, likely ones first.
const CLOSEUP_ELEVATIONS_RAD: [f64; 3] = [0.35, 0.1, 0.8];

/// Factor on the pixels of an object seen from far above.
const STEEP_WEIGHT: f64 = 0.85;

/// Share by which the pixels of an object count more from the middle of the room, and less from behind. It applies in
/// full from this distance of the object from the middle on, over the scene size.
const INWARD_WEIGHT: f64 = 0.7;
const INWARD_FRAC: f64 = 0.2;

/// What the contrast of an object's pixels, at most 0.5, is added to: their weight without contrast.
const CONTRAST_BASE: f64 = 0.4;

/// Share of a picture that a fitted object takes, share of its Gaussians that may lie beyond at each side, and least
/// number of Gaussians to fit it by.
const FILL_FRAC: f64 = 0.86;
const FIT_TAIL_FRAC: f64 = 0.004;
const MIN_FITTED: usize = 5;

/// A part of the Gaussians of a scene, each grown to cover what was left out, with their labels.
pub(crate) struct ThinnedScene {
    gaussians: Gaussians,
    labels: Vec<u16>,
}

impl ThinnedScene {
    pub(crate) fn new(scene: &Scene, set: &ObjectSet) -> Self {
        let opacities = &scene.gaussians.opacities;
        let mut kept: Vec<usize> = (0..opacities.len()).filter(|&i| opacities[i] >= OCCLUDER_OPACITY).collect();
        let stride = kept.len().div_ceil(MAX_GAUSSIANS).max(1);
        kept = kept.into_iter().step_by(stride).collect();
        let mut gaussians = scene.gaussians.plain_subset(&kept);
        let growth = (stride as f32).sqrt();
        gaussians.scales.iter_mut().for_each(|scale| *scale *= growth);
        let labels = kept.iter().map(|&i| set.labels.get(i).copied().unwrap_or(0)).collect();
        Self { gaussians, labels }
    }
}

/// A coarse picture: object id and depth per pixel; infinite where nothing is.
pub(crate) struct IdPicture {
    pub(crate) width: usize,
    pub(crate) ids: Vec<u16>,
    depths: Vec<f32>,
}

/// A search for viewpoints of a scene.
pub(crate) struct ViewpointSearch<'a> {
    set: &'a ObjectSet,
    thinned: &'a ThinnedScene,
    renderer: Renderer<'a>,
    render_settings: RenderSettings,
    frame: LevelFrame,
    center: DVec3,
    size: f64,
    /// Whether the scene surrounds its objects, as a room does.
    is_room: bool,
}

impl<'a> ViewpointSearch<'a> {
    /// `None` for a scene without extent or up.
    pub(crate) fn new(scene: &Scene, set: &'a ObjectSet, thinned: &'a ThinnedScene) -> Option<Self> {
        let bounds = scene.bounds();
        let frame = LevelFrame::new(scene.up).ok()?;
        let size = bounds.size();
        let is_room =
            !shows_one_thing(set, size) && !is_without_surroundings(&thinned.labels) && scene_surrounds(scene);
        (size > 0.0).then(|| Self {
            set,
            thinned,
            renderer: Renderer::new(&thinned.gaussians),
            render_settings: RenderSettings { near: bounds.default_near(), ..RenderSettings::for_scene(scene) },
            frame,
            center: bounds.center(),
            size,
            is_room,
        })
    }

    /// The coarse picture of a camera.
    pub(crate) fn id_picture(&self, camera: &Camera) -> Result<IdPicture, ObjectsError> {
        let ids = self.ids(camera)?;
        let camera = coarse(camera);
        let depths = self.renderer.depth(&camera, &self.render_settings).map_err(|error| failed(&error))?.median;
        let depths = depths.into_iter().map(|depth| if depth.is_nan() { f32::INFINITY } else { depth }).collect();
        Ok(IdPicture { width: camera.intrinsics.width as usize, ids, depths })
    }

    /// The ids of that picture.
    fn ids(&self, camera: &Camera) -> Result<Vec<u16>, ObjectsError> {
        let map = self.renderer.object_ids(&coarse(camera), &self.render_settings, &self.thinned.labels);
        Ok(map.map_err(|error| failed(&error))?.ids)
    }

    /// The camera that shows the most objects, with little void and nothing close before the lens; in a room up to
    /// [`MAX_OVERVIEWS`] cameras, each of which shows the most of what the earlier ones do not.
    ///
    /// # Errors
    /// [`ObjectsError::Picture`] where a picture cannot be rendered.
    pub(crate) fn overviews(&self, intrinsics: Intrinsics) -> Result<Vec<Camera>, ObjectsError> {
        if !self.is_room {
            let camera = best_of(&self.outside(intrinsics), |camera| self.outside_score(camera))?;
            let all = self.thinned.labels.iter().copied().collect();
            return Ok(vec![self.fitted(camera, &all)]);
        }
        let clear = self.inside(intrinsics).into_par_iter().filter(|camera| self.is_clear(camera));
        let survey = |camera: Camera| Ok((camera, self.id_picture(&camera)?.contents(0.12 * self.size)));
        let surveyed: Result<Vec<(Camera, Contents)>, ObjectsError> = clear.map(survey).collect();
        let surveyed = surveyed?;
        let mut chosen: Vec<Camera> = Vec::new();
        let mut seen = BTreeSet::new();
        while chosen.len() < MAX_OVERVIEWS {
            let scores = surveyed.iter().map(|(_, contents)| self.overview_score(contents, &seen));
            let Some(best) = first_highest(scores) else { break };
            let shown = self.seen_in(&surveyed[best].1);
            let num_new = shown.difference(&seen).count();
            if !chosen.is_empty() && num_new < MIN_NEW.max(self.set.objects.len() / 10) {
                break;
            }
            seen.extend(shown);
            chosen.push(surveyed[best].0);
        }
        if chosen.is_empty() {
            chosen.push(self.camera_at(self.center, self.middle_of_objects(), intrinsics));
        }
        Ok(chosen)
    }

    /// Cameras in a room, aimed at the middle of its objects.
    fn inside(&self, intrinsics: Intrinsics) -> Vec<Camera> {
        let target = self.middle_of_objects();
        let eye = |(height_frac, radius_frac, step): (f64, f64, u32)| {
            let away = self.frame.direction(f64::from(step) * std::f64::consts::TAU / 16.0);
            self.center + (away * radius_frac + self.frame.up * height_frac) * self.size
        };
        let places = [0.05, 0.15, 0.3].into_iter().flat_map(|height_frac| {
            let radii = [0.25, 0.4, 0.6, 0.9].into_iter();
            radii.flat_map(move |radius_frac| (0..16).map(move |step| (height_frac, radius_frac, step)))
        });
        places.map(|place| self.camera_at(eye(place), target, intrinsics)).collect()
    }

    /// Cameras outside the scene.
    fn outside(&self, intrinsics: Intrinsics) -> Vec<Camera> {
        let distance = 0.55 * self.size / (intrinsics.fov_y_rad() / 2.0).sin();
        let camera = |away: DVec3| self.camera_at(self.center + away * distance, self.center, intrinsics);
        self.frame.rings(16, &[0.3, 0.1]).map(camera).collect()
    }

    /// The camera that shows most of one object and fits its picture, from where a person in the room would look.
    ///
    /// # Errors
    /// [`ObjectsError::Picture`] where a picture cannot be rendered.
    pub(crate) fn closeup(&self, object: &Object, intrinsics: Intrinsics) -> Result<Camera, ObjectsError> {
        let ids = self.ids_of(object);
        let narrow = intrinsics.fov_y_rad() * intrinsics.aspect().min(1.0);
        let distance = object.radius().max(0.01 * self.size) * 1.15 / (narrow / 2.0).sin();
        let inward = if self.is_room {
            self.frame.horizontal(self.center - object.center) / (INWARD_FRAC * self.size)
        } else {
            DVec3::ZERO
        };
        let camera = |away: DVec3| self.camera_at(object.center + away * distance, object.center, intrinsics);
        let cameras: Vec<Camera> = self.frame.rings(12, &CLOSEUP_ELEVATIONS_RAD).map(camera).collect();
        let score = |camera: &Camera| {
            let picture = self.ids(camera)?;
            let seen = picture.iter().filter(|id| ids.contains(id)).count() as f64;
            let away = (camera.pose.position - object.center) / distance;
            let steepness = if away.dot(self.frame.up) > 0.5 { STEEP_WEIGHT } else { 1.0 };
            let inward = 1.0 + INWARD_WEIGHT * away.dot(inward.clamp_length_max(1.0));
            Ok((seen + 1.0)
                * steepness
                * inward
                * (CONTRAST_BASE + self.contrast(camera, &picture, &|id| ids.contains(&id))?))
        };
        let camera = best_of(&cameras, score)?;
        Ok(self.fitted(camera, &ids))
    }

    /// Labels of an object and its parts.
    pub(crate) fn ids_of(&self, object: &Object) -> BTreeSet<u16> {
        let parts = self.set.parts_of(object.id);
        parts.into_iter().chain([object.id]).filter_map(|id| u16::try_from(id).ok()).collect()
    }

    /// The lens with which the Gaussians of these labels fill the picture.
    fn fitted(&self, camera: Camera, ids: &BTreeSet<u16>) -> Camera {
        let gaussians = &self.thinned.gaussians;
        let extent_of = |i: usize| {
            let (px, depth) = camera.project(gaussians.mean_world(i))?;
            let radius = f64::from(gaussians.scales[i].max_element()) * camera.intrinsics.fy_px / depth;
            Some((px, radius))
        };
        let own = (0..gaussians.len()).filter(|&i| ids.contains(&self.thinned.labels[i]));
        let extents: Vec<(DVec2, f64)> = own.filter_map(extent_of).collect();
        if extents.len() < MIN_FITTED {
            return camera;
        }
        let tail = (FIT_TAIL_FRAC * extents.len() as f64) as usize;
        let range = |along: &dyn Fn(&DVec2) -> f64| {
            let mut low: Vec<f64> = extents.iter().map(|(px, radius)| along(px) - radius).collect();
            let mut high: Vec<f64> = extents.iter().map(|(px, radius)| along(px) + radius).collect();
            low.sort_by(f64::total_cmp);
            high.sort_by(f64::total_cmp);
            (low[tail], high[high.len() - 1 - tail])
        };
        let (x, y) = (range(&|px| px.x), range(&|px| px.y));
        let lens = camera.intrinsics;
        let size = DVec2::new(f64::from(lens.width), f64::from(lens.height));
        let extent = DVec2::new(x.1 - x.0, y.1 - y.0).max(size * 0.02);
        let zoom = (size * FILL_FRAC / extent).min_element();
        let middle = DVec2::new(x.0 + x.1, y.0 + y.1) / 2.0;
        let center = size / 2.0 - (middle - DVec2::new(lens.cx_px, lens.cy_px)) * zoom;
        let intrinsics =
            Intrinsics { fx_px: lens.fx_px * zoom, fy_px: lens.fy_px * zoom, cx_px: center.x, cy_px: center.y, ..lens };
        Camera { intrinsics, ..camera }
    }

    fn camera_at(&self, eye: DVec3, target: DVec3, intrinsics: Intrinsics) -> Camera {
        let forward = (target - eye).try_normalize().unwrap_or(self.frame.north);
        Camera { pose: Pose::facing(eye, forward, self.frame.up, Some(self.frame.east)), intrinsics }
    }

    fn middle_of_objects(&self) -> DVec3 {
        let sum: DVec3 = self.set.objects.iter().map(|object| object.center).sum();
        let count = self.set.objects.len();
        if count > 0 { (sum / count as f64 + self.center) / 2.0 } else { self.center }
    }

    /// Pixels of objects, which count more where they are rich in contrast: fronts are.
    fn outside_score(&self, camera: &Camera) -> Result<f64, ObjectsError> {
        let picture = self.ids(camera)?;
        let seen = picture.iter().filter(|id| **id > 0).count() as f64;
        Ok(seen * (CONTRAST_BASE + self.contrast(camera, &picture, &|id| id > 0)?))
    }

    /// Standard deviation of the brightness, 0..=0.5, of the pixels with some ids.
    fn contrast(
        &self,
        camera: &Camera,
        picture: &[u16],
        is_counted: &dyn Fn(u16) -> bool,
    ) -> Result<f64, ObjectsError> {
        let frame = self.renderer.render(&coarse(camera), &self.render_settings).map_err(|error| failed(&error))?;
        let brightness = |rgb: &[f32]| f64::from(rgb.iter().sum::<f32>().clamp(0.0, 3.0) / 3.0);
        let values: Vec<f64> = (frame.rgb.chunks_exact(3).zip(picture))
            .filter(|(_, id)| is_counted(**id))
            .map(|(rgb, _)| brightness(rgb))
            .collect();
        let count = values.len().max(1) as f64;
        let mean = values.iter().sum::<f64>() / count;
        Ok((values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / count).sqrt())
    }

    /// Whether nothing is close to a camera.
    fn is_clear(&self, camera: &Camera) -> bool {
        let clearance = CLEARANCE_FRAC * self.size;
        let eye = camera.pose.position;
        let gaussians = &self.thinned.gaussians;
        (0..gaussians.len()).all(|i| gaussians.mean_world(i).distance_squared(eye) >= clearance * clearance)
    }

    /// Ids of the objects that a picture shows, those of their wholes not included.
    fn seen_in(&self, contents: &Contents) -> BTreeSet<u32> {
        let is_seen = |object: &&Object| contents.num_pixels(object) >= MIN_ID_PIXELS as u32;
        self.set.objects.iter().filter(is_seen).map(|object| object.id).collect()
    }

    /// `seen`: objects that count little, because another picture shows them.
    fn overview_score(&self, contents: &Contents, seen: &BTreeSet<u32>) -> f64 {
        let value = |object: &Object| {
            let weight = if seen.contains(&object.id) { SEEN_WEIGHT } else { 1.0 };
            weight * (f64::from(contents.num_pixels(object)) / 40.0).min(1.0)
        };
        let shown: f64 = self.set.objects.iter().map(value).sum();
        shown - contents.lost_frac * (1.0 + 0.5 * (self.set.objects.len() - seen.len()) as f64)
    }
}

/// What a coarse picture shows.
struct Contents {
    /// Number of pixels of each id that it shows.
    counts: BTreeMap<u32, u32>,
    /// Share of the picture without matter, and of what is close before the lens.
    lost_frac: f64,
}

impl Contents {
    fn num_pixels(&self, object: &Object) -> u32 {
        self.counts.get(&object.id).copied().unwrap_or(0)
    }
}

impl IdPicture {
    /// `close`: distance below which matter is close.
    fn contents(&self, close: f64) -> Contents {
        let mut counts = BTreeMap::new();
        self.ids.iter().for_each(|&id| *counts.entry(u32::from(id)).or_default() += 1);
        let share = |what: &dyn Fn(f32) -> bool| {
            self.depths.iter().filter(|depth| what(**depth)).count() as f64 / self.depths.len() as f64
        };
        let lost_frac = share(&|depth| depth.is_infinite()) + share(&|depth| f64::from(depth) < close);
        Contents { counts, lost_frac }
    }
}

/// Whether one object is most of a scene. The curtains or the window of a room may be as long as the scene.
fn shows_one_thing(set: &ObjectSet, scene_size: f64) -> bool {
    let is_large = |object: &Object| object.parent.is_none() && 2.0 * object.radius() > SINGLE_FRAC * scene_size;
    if set.labels.iter().any(|label| *label > 0) {
        set.only_whole().is_some_and(is_large)
    } else {
        set.objects.iter().any(is_large)
    }
}

/// Whether most of a scene is seen from inside.
fn scene_surrounds(scene: &Scene) -> bool {
    let bounds = scene.bounds();
    let axes = upright_axes(scene.up);
    surrounds(&VoxelGrid::new(&scene.gaussians, bounds.size() / NUM_CELLS, bounds.center(), axes))
}

/// Whether nearly all matter is that of objects: things without a room around them.
fn is_without_surroundings(labels: &[u16]) -> bool {
    labels.iter().filter(|label| **label > 0).count() as f64 >= THINGS_FRAC * labels.len() as f64
}

/// The camera with which coarse pictures are rendered.
fn coarse(camera: &Camera) -> Camera {
    let intrinsics = camera.intrinsics.scaled(f64::from(COARSE_HEIGHT_PX) / f64::from(camera.intrinsics.height));
    Camera { intrinsics, ..*camera }
}

fn failed(error: &RenderError) -> ObjectsError {
    ObjectsError::Picture { reason: error.to_string() }
}

/// The first camera with the highest score.
fn best_of(cameras: &[Camera], score: impl Fn(&Camera) -> Result<f64, ObjectsError>) -> Result<Camera, ObjectsError> {
    let scores: Result<Vec<f64>, ObjectsError> = cameras.iter().map(score).collect();
    let best = first_highest(scores?.into_iter()).map(|best| cameras[best]);
    best.ok_or_else(|| ObjectsError::Picture { reason: "there is no viewpoint".to_owned() })
}

/// Index of the first of the highest scores.
fn first_highest(scores: impl Iterator<Item = f64>) -> Option<usize> {
    let best = scores.enumerate().fold(None, |best: Option<(usize, f64)>, (i, score)| {
        if best.is_none_or(|(_, most)| score > most + 1e-9) { Some((i, score)) } else { best }
    });
    best.map(|(i, _)| i)
}

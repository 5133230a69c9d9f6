//! Viewpoints that show one object, or as many objects as possible.
//!
//! Enters: a scene with labels. Leaves: cameras. Candidates are compared on coarse pictures of object ids, drawn from
//! sparse points with a depth buffer, which is much cheaper than rendering.

use glam::DVec3;

use super::object::{Object, ObjectSet};
use cinesplat_geometry::{Camera, Intrinsics, LevelFrame, Pose};
use cinesplat_scene::Scene;

/// Least opacity of an occluding Gaussian.
const OCCLUDER_OPACITY: f32 = 0.3;

/// Limit on the Gaussians drawn into a coarse picture.
const MAX_POINTS: usize = 40_000;

/// Height of the coarse pictures.
const COARSE_HEIGHT_PX: u32 = 60;

/// Largest half side of a splat in a coarse picture.
const MAX_SPLAT_PX: i64 = 5;

/// Diagonal of an object, over the scene size, from which the scene shows one thing and is seen from outside.
const SINGLE_FRAC: f64 = 0.6;

/// Share of the matter that is that of objects, from which on the scene is no room.
const THINGS_FRAC: f64 = 0.9;

/// Distance to the nearest Gaussian, over the scene size, below which a viewpoint counts as blocked.
const CLEARANCE_FRAC: f64 = 0.04;

/// A coarse picture: object id and depth per pixel.
pub(crate) struct IdPicture {
    pub(crate) width: usize,
    pub(crate) ids: Vec<u16>,
    pub(crate) depths: Vec<f32>,
}

/// A search for viewpoints of a scene, on a sparse subset of its Gaussians.
pub(crate) struct ViewpointSearch<'a> {
    set: &'a ObjectSet,
    frame: LevelFrame,
    center: DVec3,
    size: f64,
    near: f64,
    /// Mean, radius (scene units) and id.
    points: Vec<(DVec3, f64, u16)>,
}

impl<'a> ViewpointSearch<'a> {
    /// `None` for a scene without extent or up.
    pub(crate) fn new(scene: &Scene, set: &'a ObjectSet) -> Option<Self> {
        let bounds = scene.bounds();
        let gaussians = &scene.gaussians;
        let solid: Vec<usize> = (0..gaussians.len()).filter(|&i| gaussians.opacities[i] >= OCCLUDER_OPACITY).collect();
        let stride = solid.len().div_ceil(MAX_POINTS).max(1);
        // Each point of a sparser subset covers more area.
        let growth = (stride as f64).sqrt();
        let point = |&i: &usize| {
            let id = set.labels.get(i).copied().unwrap_or(0);
            (gaussians.mean_world(i), f64::from(gaussians.scales[i].max_element()) * growth, id)
        };
        let points = solid.iter().step_by(stride).map(point).collect();
        let frame = LevelFrame::new(scene.up).ok()?;
        let has_extent = bounds.size() > 0.0;
        has_extent.then(|| Self {
            set,
            frame,
            center: bounds.center(),
            size: bounds.size(),
            near: bounds.default_near(),
            points,
        })
    }

    /// Draws the coarse picture of a camera.
    pub(crate) fn id_picture(&self, camera: &Camera) -> IdPicture {
        let intrinsics = camera.intrinsics.scaled(f64::from(COARSE_HEIGHT_PX) / f64::from(camera.intrinsics.height));
        let camera = Camera { intrinsics, ..*camera };
        let (width, height) = (intrinsics.width as usize, intrinsics.height as usize);
        let mut picture =
            IdPicture { width, ids: vec![0; width * height], depths: vec![f32::INFINITY; width * height] };
        for &(mean, radius, id) in &self.points {
            if let Some((px, depth)) = camera.project(mean).filter(|(_, depth)| *depth > self.near) {
                let reach = ((radius * intrinsics.fy_px / depth) as i64).min(MAX_SPLAT_PX);
                picture.splat((px.x.floor() as i64, px.y.floor() as i64), reach, depth as f32, id);
            }
        }
        picture
    }

    /// The camera that shows the most objects, with little void and nothing close before the lens.
    pub(crate) fn overview(&self, intrinsics: Intrinsics) -> Camera {
        if self.shows_one_thing() || self.is_without_surroundings() {
            return self.outside(intrinsics);
        }
        let target = self.middle_of_objects();
        let mut best = (f64::NEG_INFINITY, self.camera_at(self.center, target, intrinsics));
        for height_frac in [0.05, 0.15, 0.3] {
            for radius_frac in [0.25, 0.4, 0.6, 0.9] {
                for step in 0..16 {
                    let away = self.frame.direction(f64::from(step) * std::f64::consts::TAU / 16.0);
                    let eye = self.center + (away * radius_frac + self.frame.up * height_frac) * self.size;
                    let camera = self.camera_at(eye, target, intrinsics);
                    let score = self.overview_score(&camera);
                    if score > best.0 {
                        best = (score, camera);
                    }
                }
            }
        }
        best.1
    }

    /// Whether one object is most of the scene. The curtains or the window of a room may be as long as the scene.
    fn shows_one_thing(&self) -> bool {
        let is_large = |object: &Object| object.parent.is_none() && 2.0 * object.radius() > SINGLE_FRAC * self.size;
        if self.set.labels.iter().any(|label| *label > 0) {
            self.set.only_whole().is_some_and(is_large)
        } else {
            self.set.objects.iter().any(is_large)
        }
    }

    /// Whether nearly all matter is that of objects: things without a room around them.
    fn is_without_surroundings(&self) -> bool {
        let owned = self.points.iter().filter(|(_, _, id)| *id > 0).count();
        owned as f64 >= THINGS_FRAC * self.points.len() as f64
    }

    /// The camera outside the scene that shows most of the objects.
    fn outside(&self, intrinsics: Intrinsics) -> Camera {
        let distance = 0.55 * self.size / (intrinsics.fov_y_rad() / 2.0).sin();
        let mut best = (-1.0, self.camera_at(self.center + self.frame.north * distance, self.center, intrinsics));
        for away in self.frame.rings(16, &[0.3, 0.1]) {
            let camera = self.camera_at(self.center + away * distance, self.center, intrinsics);
            let picture = self.id_picture(&camera);
            let seen = picture.ids.iter().filter(|id| **id > 0).count() as f64;
            if seen > best.0 {
                best = (seen, camera);
            }
        }
        best.1
    }

    /// The camera that shows most of one object, and the visible share of it, 0..=1.
    pub(crate) fn closeup(&self, object: &Object, intrinsics: Intrinsics) -> (Camera, f64) {
        let narrow = intrinsics.fov_y_rad() * intrinsics.aspect().min(1.0);
        let distance = object.radius().max(0.01 * self.size) * 1.15 / (narrow / 2.0).sin();
        let mut best = (-1.0, self.camera_at(object.center + self.frame.north * distance, object.center, intrinsics));
        for away in self.frame.rings(12, &[0.35, 0.1, 0.8]) {
            let camera = self.camera_at(object.center + away * distance, object.center, intrinsics);
            let seen = self.visible_frac(object, &camera);
            if seen > best.0 + 1e-9 {
                best = (seen, camera);
            }
        }
        (best.1, best.0.max(0.0))
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

    fn overview_score(&self, camera: &Camera) -> f64 {
        let clearance = CLEARANCE_FRAC * self.size;
        let eye = camera.pose.position;
        if self.points.iter().any(|(mean, ..)| mean.distance_squared(eye) < clearance * clearance) {
            return f64::NEG_INFINITY;
        }
        let picture = self.id_picture(camera);
        let mut counts = vec![0_u32; usize::from(u16::MAX) + 1];
        for &id in &picture.ids {
            counts[usize::from(id)] += 1;
        }
        let seen: f64 =
            self.set.objects.iter().map(|object| (f64::from(counts[object.id as usize]) / 40.0).min(1.0)).sum();
        let share = |what: &dyn Fn(f32) -> bool| {
            picture.depths.iter().filter(|depth| what(**depth)).count() as f64 / picture.depths.len() as f64
        };
        let void = share(&|depth| depth.is_infinite());
        let close = share(&|depth| f64::from(depth) < 0.12 * self.size);
        seen - (void + close) * (1.0 + 0.5 * self.set.objects.len() as f64)
    }

    /// Visible share of an object: its pixels in the scene over its pixels when drawn alone.
    fn visible_frac(&self, object: &Object, camera: &Camera) -> f64 {
        let picture = self.id_picture(camera);
        let own = picture.ids.iter().filter(|id| u32::from(**id) == object.id).count();
        let alone = ViewpointSearch {
            points: self.points.iter().copied().filter(|p| u32::from(p.2) == object.id).collect(),
            ..*self
        };
        let all = alone.id_picture(camera).ids.iter().filter(|id| **id > 0).count();
        own as f64 / all.max(1) as f64
    }
}

impl IdPicture {
    fn splat(&mut self, at: (i64, i64), reach: i64, depth: f32, id: u16) {
        let height = (self.ids.len() / self.width) as i64;
        let range = |middle: i64, limit: i64| (middle - reach).max(0)..(middle + reach + 1).min(limit);
        for y in range(at.1, height) {
            for x in range(at.0, self.width as i64) {
                let pixel = (y * self.width as i64 + x) as usize;
                if depth < self.depths[pixel] {
                    (self.depths[pixel], self.ids[pixel]) = (depth, id);
                }
            }
        }
    }
}

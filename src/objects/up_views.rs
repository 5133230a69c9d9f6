//! Pictures of a scene with each direction that may be up.
//!
//! Enters: a scene. Leaves: pictures with the flag that chooses one; none where up is known or sure.

use glam::DVec3;
use image::{Rgb, RgbImage, imageops};

use super::drawing::{self, Ink};
use super::error::ObjectsError;
use super::photo::{TILE_BACKGROUND, TILE_FOV_RAD, photo};
use cinesplat_geometry::{Camera, Intrinsics, Pose};
use cinesplat_render::{Quality, Renderer};
use cinesplat_scene::{SURE_PERCENT, Scene, UpEstimate, UpSource, up_flag};

/// Largest number of directions, and the least probability of one.
const MAX_VIEWS: usize = 5;
const MIN_PERCENT: u8 = 2;

/// Color of captions.
const PAPER: Ink = Rgb([245, 245, 245]);

/// Distance of the camera over the scene size, and its rise over its horizontal distance.
const DISTANCE_FRAC: f64 = 0.55;
const RISE: f64 = 0.35;

/// The scene with a direction that may be up.
#[derive(Debug, Clone, PartialEq)]
pub struct UpView {
    /// The direction, world, unit.
    pub up: DVec3,
    /// Its probability.
    pub percent: u8,
    /// The scene from outside with that direction up.
    pub picture: RgbImage,
}

impl UpView {
    /// Two lines: the probability and the flag to type.
    pub(crate) fn caption(&self) -> [String; 2] {
        [format!("up? {} %", self.percent), up_flag(self.up)]
    }

    /// Draws the picture with its caption below it. `place`: upper left corner.
    pub(crate) fn draw(&self, page: &mut RgbImage, place: (i64, i64), picture_height: u32) {
        let (left, top) = place;
        imageops::replace(page, &self.picture, left, top);
        let below = top + i64::from(picture_height) + 5;
        let [likely, flag] = self.caption();
        drawing::text(page, (left + 2, below), 2, PAPER, &likely);
        // Three numbers fit below a tile in small letters alone.
        drawing::text(page, (left + 2, below + 22), 1, PAPER, &flag);
    }
}

/// The pictures of the directions that may be up, most likely first; none where up is known or sure.
pub(crate) fn up_views(scene: &Scene, size_px: (u32, u32), quality: Quality) -> Result<Vec<UpView>, ObjectsError> {
    if !matches!(scene.up_source, UpSource::Estimated(percent) if percent < SURE_PERCENT) {
        return Ok(Vec::new());
    }
    let renderer = Renderer::new(&scene.gaussians);
    let bounds = scene.bounds();
    let intrinsics = Intrinsics::from_fov_y(size_px.0, size_px.1, TILE_FOV_RAD);
    let distance = DISTANCE_FRAC * bounds.size() / (TILE_FOV_RAD / 2.0).sin();
    let view = |candidate: &UpEstimate| {
        let away = (candidate.up.any_orthonormal_vector() + RISE * candidate.up).normalize();
        let pose = Pose::facing(bounds.center() + away * distance, -away, candidate.up, None);
        let picture = photo(scene, &renderer, &Camera { pose, intrinsics }, (0.0, TILE_BACKGROUND, quality))?;
        Ok(UpView { up: candidate.up, percent: candidate.confidence_percent, picture })
    };
    let candidates = scene.up_candidates();
    let likely = candidates.iter().filter(|candidate| candidate.confidence_percent >= MIN_PERCENT);
    likely.take(MAX_VIEWS).map(view).collect()
}

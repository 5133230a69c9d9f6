//! All directions in one picture.

use cinesplat_geometry::{Camera, Intrinsics, Pose};
use cinesplat_render::RenderError;
use glam::DVec3;

use super::budget::{Budget, Loss};
use super::calls::{Call, Calls};
use super::effect::{Effect, EffectKind, Next};
use super::light::Picture;
use super::moment::{Moment, Take};
use super::resample::through;
use super::seen::FrameFacts;

/// An equirectangular picture of all directions: longitude across, from behind over the left, ahead and the right to behind;
/// latitude down, from the zenith to the nadir.
///
/// The horizon is level: of the camera's rotation only the heading counts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Panorama;

impl EffectKind for Panorama {
    const NAME: &'static str = "panorama";
    const SETTINGS: &'static [&'static str] = &[];

    fn called_for(_: &Call, _: &Calls<'_>) -> Option<Self> {
        Some(Self)
    }
}

impl Effect for Panorama {
    fn settings(&self) -> Vec<(&'static str, f64)> {
        Vec::new()
    }

    fn measure(&self) -> (&'static str, &'static str) {
        ("directions that a plain picture lacks", "of 1")
    }

    fn error_if_skipped(&self, frame: &FrameFacts<'_>, budget: &Budget) -> Result<Loss, RenderError> {
        let intrinsics = frame.moment.camera.intrinsics;
        let (x, y) = (
            0.5 * f64::from(intrinsics.width) / intrinsics.fx_px,
            0.5 * f64::from(intrinsics.height) / intrinsics.fy_px,
        );
        // Solid angle of a rectangle over that of the sphere.
        let seen = (x * y / ((1.0 + x * x) * (1.0 + y * y)).sqrt()).asin() / std::f64::consts::PI;
        Ok(Loss::of_one_sample(1.0 - seen, budget.color))
    }

    /// A level camera with the pixels of the horizon.
    fn seen_through(&self, camera: Camera, up: Option<DVec3>) -> Option<Camera> {
        let own = camera.intrinsics;
        let focal_px = f64::from(own.width) / std::f64::consts::TAU;
        let pose = up.map_or(camera.pose, |up| leveled(&camera.pose, up));
        Some(Camera { pose, intrinsics: Intrinsics { fx_px: focal_px, fy_px: focal_px, ..own } })
    }

    fn changes_with_time(&self) -> bool {
        false
    }

    fn is_panorama(&self) -> bool {
        true
    }

    fn apply(&self, moment: &Moment<'_>, _: u32, next: Next<'_>) -> Result<Picture, RenderError> {
        let intrinsics = moment.camera.intrinsics;
        let [width, height] = [intrinsics.width, intrinsics.height].map(f64::from);
        let directions = |[x, y]: [f64; 2]| {
            let longitude = (x / width - 0.5) * std::f64::consts::TAU;
            let latitude = (0.5 - y / height) * std::f64::consts::PI;
            Some(DVec3::new(latitude.cos() * longitude.sin(), -latitude.sin(), latitude.cos() * longitude.cos()))
        };
        // What blurs inside sees the level camera over the whole exposure: of pitch, roll and zoom nothing shows.
        let shown = |camera: Camera| self.seen_through(camera, moment.take.up).unwrap_or(camera);
        let camera_at = |time_secs: f64| shown((moment.take.camera_at)(time_secs));
        let take = Take { camera_at: &camera_at, ..moment.take };
        through(&Moment { take, camera: shown(moment.camera), ..moment.clone() }, &directions, next)
    }
}

/// The pose without its pitch and roll.
fn leveled(pose: &Pose, up: DVec3) -> Pose {
    let along = |direction: DVec3| direction - up * direction.dot(up);
    // Looking straight up or down, the heading is that of the picture's upper border.
    let ahead = along(pose.forward()).try_normalize().filter(|_| along(pose.forward()).length() > 1e-6);
    let turned = along(pose.up()) * -pose.forward().dot(up).signum();
    let forward = ahead.or_else(|| turned.try_normalize()).unwrap_or_else(|| pose.forward());
    Pose::facing(pose.position, forward, up, Some(pose.right()))
}

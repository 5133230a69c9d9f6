//! A very wide lens.

use cinesplat_geometry::{Camera, Intrinsics};
use cinesplat_render::RenderError;
use glam::DVec3;

use super::budget::{Budget, Loss};
use super::calls::{Call, Calls};
use super::effect::{Effect, EffectKind, Next};
use super::light::Picture;
use super::moment::{Moment, Take};
use super::resample::through;
use super::seen::FrameFacts;

/// Angles from the view axis at which the lens is compared with a pinhole.
const NUM_ANGLES: u32 = 16;

/// A fisheye lens that fills the frame: the distance from the middle is proportional to the angle from the view axis. It
/// takes the place of the shot's lens: a zoom does not change it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fisheye {
    /// Angle of view from corner to corner, radians.
    pub fov_rad: f64,
}

impl Fisheye {
    /// The direction of a position in a frame; `None` beyond straight behind.
    fn direction(self, intrinsics: &Intrinsics, [x, y]: [f64; 2]) -> Option<DVec3> {
        let (x, y) = (x - f64::from(intrinsics.width) / 2.0, y - f64::from(intrinsics.height) / 2.0);
        let corner = 0.5 * f64::from(intrinsics.width).hypot(f64::from(intrinsics.height));
        let radius = x.hypot(y);
        let angle = radius / corner * self.fov_rad / 2.0;
        if angle >= std::f64::consts::PI {
            return None;
        }
        let across = if radius > 0.0 { angle.sin() / radius } else { 0.0 };
        Some(DVec3::new(x * across, y * across, angle.cos()))
    }
}

impl EffectKind for Fisheye {
    const NAME: &'static str = "fisheye";
    const SETTINGS: &'static [&'static str] = &["fov_deg"];
    const YIELDS_TO: &'static [(&'static str, &'static str)] = &[("panorama", "a picture has one projection")];

    fn called_for(call: &Call, _: &Calls<'_>) -> Option<Self> {
        let fov_deg = call.setting_or("fov_deg", [140.0, 175.0, 220.0]).clamp(1.0, 360.0);
        Some(Self { fov_rad: fov_deg.to_radians() })
    }
}

impl Effect for Fisheye {
    fn settings(&self) -> Vec<(&'static str, f64)> {
        vec![("fov_deg", self.fov_rad.to_degrees())]
    }

    fn measure(&self) -> (&'static str, &'static str) {
        ("largest shift of what both lenses show", "px")
    }

    fn error_if_skipped(&self, frame: &FrameFacts<'_>, budget: &Budget) -> Result<Loss, RenderError> {
        let intrinsics = frame.moment.camera.intrinsics;
        let corner = 0.5 * f64::from(intrinsics.width).hypot(f64::from(intrinsics.height));
        let (own, plain) = (self.fov_rad / 2.0, (corner / intrinsics.fx_px).atan());
        // Beyond the narrower of the two only one of them shows something, and nothing can be compared.
        let widest = own.min(plain);
        let shift_px = |part: u32| {
            let angle = widest * f64::from(part) / f64::from(NUM_ANGLES);
            (angle / own * corner - intrinsics.fx_px * angle.tan()).abs()
        };
        let shift_px = (1..=NUM_ANGLES).map(shift_px).fold(0.0, f64::max);
        Ok(Loss::of_one_sample(shift_px, budget.shift_px))
    }

    /// The pixels of its middle, whatever the shot's lens.
    fn seen_through(&self, camera: Camera, _: Option<DVec3>) -> Option<Camera> {
        let own = camera.intrinsics;
        let corner = 0.5 * f64::from(own.width).hypot(f64::from(own.height));
        let focal_px = 2.0 * corner / self.fov_rad;
        Some(Camera { intrinsics: Intrinsics { fx_px: focal_px, fy_px: focal_px, ..own }, ..camera })
    }

    fn changes_with_time(&self) -> bool {
        false
    }

    fn apply(&self, moment: &Moment<'_>, _: u32, next: Next<'_>) -> Result<Picture, RenderError> {
        let intrinsics = moment.camera.intrinsics;
        // What blurs inside sees this lens over the whole exposure: of a zoom nothing shows.
        let shown = |camera: Camera| self.seen_through(camera, moment.take.up).unwrap_or(camera);
        let camera_at = |time_secs: f64| shown((moment.take.camera_at)(time_secs));
        let take = Take { camera_at: &camera_at, ..moment.take };
        through(
            &Moment { take, camera: shown(moment.camera), ..moment.clone() },
            &|place| self.direction(&intrinsics, place),
            next,
        )
    }
}

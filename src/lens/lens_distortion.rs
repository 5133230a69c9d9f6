//! A lens as OpenCV models it, or a bulge of the whole frame.

use cinesplat_geometry::Intrinsics;
use cinesplat_render::RenderError;
use cinesplat_trajectory::{LENS_EFFECT, LensModel};
use glam::{DVec2, DVec3};

use super::budget::{Budget, Loss};
use super::calls::{Call, Calls};
use super::effect::{Effect, EffectKind, Next};
use super::light::Picture;
use super::moment::Moment;
use super::opencv::{direction, has_circle};
use super::resample::through;
use super::seen::FrameFacts;

/// Share of the depth at which a direction counts as one to the side, where a shift is measured.
const LEAST_AHEAD: f64 = 1e-3;

/// Distortion of a lens: OpenCV's models, which scans state for their own cameras, or a bulge of the whole frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LensDistortion {
    /// The lens where the keyframes state none.
    pub lens: LensModel,
    /// How much farther out it looks in the corners than a pinhole, as a share: barrel distortion. Below 0: pincushion
    /// distortion. Grows with the square of the distance from the middle.
    pub bulge: f64,
}

impl LensDistortion {
    /// The lens of a moment: that of the keyframes from cut to cut, which has no bulge, or the effect's own.
    fn at(self, moment: &Moment<'_>) -> Self {
        moment.take.optics.lens(moment.time_secs).map_or(self, |lens| Self { lens, bulge: 0.0 })
    }

    /// The direction of a position in a frame; `None` where the lens shows nothing.
    fn direction(&self, intrinsics: &Intrinsics, [x, y]: [f64; 2]) -> Option<DVec3> {
        let height = f64::from(intrinsics.height);
        let [cx, cy] =
            [intrinsics.cx_px + self.lens.center[0] * height, intrinsics.cy_px + self.lens.center[1] * height];
        let seen = DVec2::new((x - cx) / (intrinsics.fx_px * self.lens.stretch), (y - cy) / intrinsics.fy_px);
        let corner =
            DVec2::new(f64::from(intrinsics.width) / intrinsics.fx_px, f64::from(intrinsics.height) / intrinsics.fy_px)
                / 2.0;
        let bulged = seen * (1.0 + self.bulge * seen.length_squared() / corner.length_squared());
        direction(&self.lens, bulged)
    }
}

impl EffectKind for LensDistortion {
    const NAME: &'static str = LENS_EFFECT;
    const SETTINGS: &'static [&'static str] = &[
        "fisheye", "k1", "k2", "k3", "k4", "k5", "k6", "p1", "p2", "center_x", "center_y", "stretch", "bulge", "sign",
    ];
    const YIELDS_TO: &'static [(&'static str, &'static str)] =
        &[("panorama", "a picture has one projection"), ("fisheye", "a picture has one projection")];

    fn call(calls: &Calls<'_>) -> Option<Call> {
        let of_key = || calls.of_keyframes(Self::NAME, "lens", |key| key.optics.lens.is_some());
        calls.named(Self::NAME).cloned().or_else(of_key)
    }

    fn called_for(call: &Call, calls: &Calls<'_>) -> Option<Self> {
        let lens = LensModel::of_values(|name| call.setting(name));
        let lens = if lens.fault().is_some() { LensModel::default() } else { lens };
        let is_stated = lens.is_distorted();
        let is_on_keys = calls.keyframes.iter().any(|key| key.optics.lens.is_some());
        let by_degree = if is_stated || is_on_keys { [0.0; 3] } else { [0.08, 0.2, 0.45] };
        // Beyond -1/3 the corners would fold inward.
        let sign = call.setting("sign").unwrap_or(1.0).signum();
        let bulge = call.setting("bulge").unwrap_or(sign * call.degree.of(by_degree)).clamp(-0.33, 2.0);
        (is_stated || is_on_keys || bulge != 0.0).then_some(Self { lens, bulge })
    }
}

impl Effect for LensDistortion {
    fn settings(&self) -> Vec<(&'static str, f64)> {
        let mut settings = self.lens.own_values();
        settings.push(("bulge", self.bulge));
        settings
    }

    fn measure(&self) -> (&'static str, &'static str) {
        ("shift of the border", "px")
    }

    /// Refuses a distortion that folds the picture. Beyond the circle of a fisheye there is nothing.
    fn error_if_skipped(&self, frame: &FrameFacts<'_>, budget: &Budget) -> Result<Loss, RenderError> {
        let intrinsics = frame.moment.camera.intrinsics;
        let own = self.at(&frame.moment);
        let [width, height] = [intrinsics.width, intrinsics.height].map(f64::from);
        let mut shift_px: f64 = 0.0;
        for part in 0..=16 {
            let along = f64::from(part) / 16.0;
            for place in [[along * width, 0.0], [along * width, height], [0.0, along * height], [width, along * height]]
            {
                let Some(point) = own.direction(&intrinsics, place) else {
                    if has_circle(&own.lens) {
                        shift_px = shift_px.max(width);
                        continue;
                    }
                    let found_px = DVec2::from(place).distance(DVec2::new(width, height) / 2.0);
                    return Err(RenderError::Fold { found_px });
                };
                let ahead = point.z.max(LEAST_AHEAD * point.length());
                let plain = DVec2::new(
                    intrinsics.cx_px + intrinsics.fx_px * point.x / ahead,
                    intrinsics.cy_px + intrinsics.fy_px * point.y / ahead,
                );
                shift_px = shift_px.max(plain.distance(DVec2::from(place)));
            }
        }
        Ok(Loss::of_one_sample(shift_px, budget.shift_px))
    }

    fn state(&self, moment: &Moment<'_>) -> Option<Vec<f64>> {
        let own = self.at(moment);
        Some(own.lens.values().into_iter().map(|(_, value)| value).chain([own.bulge]).collect())
    }

    fn apply(&self, moment: &Moment<'_>, _: u32, next: Next<'_>) -> Result<Picture, RenderError> {
        let (own, intrinsics) = (self.at(moment), moment.camera.intrinsics);
        through(moment, &|place| own.direction(&intrinsics, place), next)
    }
}

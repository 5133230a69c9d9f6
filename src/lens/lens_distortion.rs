//! Distortion of a lens that is nearly a pinhole.

use cinesplat_geometry::Intrinsics;
use cinesplat_render::RenderError;
use glam::{DVec2, DVec3};

use super::budget::{Budget, Loss};
use super::calls::{Call, Calls};
use super::effect::{Effect, EffectKind, Next};
use super::light::Picture;
use super::moment::Moment;
use super::resample::through;
use super::seen::FrameFacts;

/// Steps of Newton's method.
const MAX_STEPS: usize = 30;
/// Largest distance from the solution, at depth 1.
const TOLERANCE: f64 = 1e-9;

/// Distortion of a lens: OpenCV's coefficients, which scans state for their own cameras, or a bulge of the whole frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LensDistortion {
    /// OpenCV's k1, k2, p1, p2, k3.
    pub coefficients: [f64; 5],
    /// How much farther out the lens looks in the corners than a pinhole, as a share: barrel distortion. Below 0: pincushion
    /// distortion. Grows with the square of the distance from the middle.
    pub bulge: f64,
}

impl LensDistortion {
    /// Where a point at depth 1 appears, at depth 1 (OpenCV, `cv::projectPoints`).
    fn distorted(&self, p: DVec2) -> DVec2 {
        let [k1, k2, p1, p2, k3] = self.coefficients;
        let r2 = p.length_squared();
        let radial = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3));
        let (x, y) = (p.x, p.y);
        let tangential =
            DVec2::new(2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x), p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y);
        p * radial + tangential
    }

    /// The point that appears at a position, both at depth 1; `None` where the distortion folds before it.
    fn undistorted(&self, seen: DVec2) -> Option<DVec2> {
        // From the middle outward, so that of several solutions the one before any fold is found.
        let mut p = DVec2::ZERO;
        for part in 1..=8 {
            p = self.solved(seen * (f64::from(part) / 8.0), p)?;
        }
        Some(p)
    }

    /// The solution near a guess, by Newton's method with the determinant of the derivative above 0.
    fn solved(&self, seen: DVec2, mut p: DVec2) -> Option<DVec2> {
        for _ in 0..MAX_STEPS {
            let miss = self.distorted(p) - seen;
            if miss.length() < TOLERANCE {
                return Some(p);
            }
            let step = 1e-6;
            let [dx, dy] = [DVec2::X, DVec2::Y]
                .map(|axis| (self.distorted(p + axis * step) - self.distorted(p - axis * step)) / (2.0 * step));
            let determinant = dx.perp_dot(dy);
            if !(determinant > 1e-3) {
                return None;
            }
            p -= DVec2::new(miss.perp_dot(dy), dx.perp_dot(miss)) / determinant;
        }
        None
    }

    /// The direction of a position in a frame.
    fn direction(&self, intrinsics: &Intrinsics, [x, y]: [f64; 2]) -> Option<DVec3> {
        let seen = DVec2::new((x - intrinsics.cx_px) / intrinsics.fx_px, (y - intrinsics.cy_px) / intrinsics.fy_px);
        let corner =
            DVec2::new(f64::from(intrinsics.width) / intrinsics.fx_px, f64::from(intrinsics.height) / intrinsics.fy_px)
                / 2.0;
        let bulged = seen * (1.0 + self.bulge * seen.length_squared() / corner.length_squared());
        let point = if self.coefficients.iter().all(|k| k.abs() <= 0.0) { bulged } else { self.undistorted(bulged)? };
        Some(point.extend(1.0))
    }
}

impl EffectKind for LensDistortion {
    const NAME: &'static str = "lens-distortion";
    const SETTINGS: &'static [&'static str] = &["k1", "k2", "p1", "p2", "k3", "bulge", "sign"];
    const YIELDS_TO: &'static [(&'static str, &'static str)] =
        &[("panorama", "a picture has one projection"), ("fisheye", "a picture has one projection")];

    fn called_for(call: &Call, _: &Calls<'_>) -> Option<Self> {
        let coefficients = ["k1", "k2", "p1", "p2", "k3"].map(|name| call.setting(name).unwrap_or(0.0));
        let is_stated = coefficients.iter().any(|k| *k != 0.0);
        let by_degree = if is_stated { [0.0; 3] } else { [0.08, 0.2, 0.45] };
        // Beyond -1/3 the corners would fold inward.
        let sign = call.setting("sign").unwrap_or(1.0).signum();
        let bulge = call.setting("bulge").unwrap_or(sign * call.degree.of(by_degree)).clamp(-0.33, 2.0);
        (is_stated || bulge != 0.0).then_some(Self { coefficients, bulge })
    }
}

impl Effect for LensDistortion {
    fn settings(&self) -> Vec<(&'static str, f64)> {
        let [k1, k2, p1, p2, k3] = self.coefficients;
        vec![("k1", k1), ("k2", k2), ("p1", p1), ("p2", p2), ("k3", k3), ("bulge", self.bulge)]
    }

    fn measure(&self) -> (&'static str, &'static str) {
        ("shift of the border", "px")
    }

    /// Refuses a distortion that folds the picture.
    fn error_if_skipped(&self, frame: &FrameFacts<'_>, budget: &Budget) -> Result<Loss, RenderError> {
        let intrinsics = frame.moment.camera.intrinsics;
        let [width, height] = [intrinsics.width, intrinsics.height].map(f64::from);
        let mut shift_px: f64 = 0.0;
        for part in 0..=16 {
            let along = f64::from(part) / 16.0;
            for place in [[along * width, 0.0], [along * width, height], [0.0, along * height], [width, along * height]]
            {
                let Some(point) = self.direction(&intrinsics, place) else {
                    let found_px = DVec2::from(place).distance(DVec2::new(width, height) / 2.0);
                    return Err(RenderError::Fold { found_px });
                };
                let plain = DVec2::new(
                    intrinsics.cx_px + intrinsics.fx_px * point.x,
                    intrinsics.cy_px + intrinsics.fy_px * point.y,
                );
                shift_px = shift_px.max(plain.distance(DVec2::from(place)));
            }
        }
        Ok(Loss::of_one_sample(shift_px, budget.shift_px))
    }

    fn changes_with_time(&self) -> bool {
        false
    }

    fn apply(&self, moment: &Moment<'_>, _: u32, next: Next<'_>) -> Result<Picture, RenderError> {
        let intrinsics = moment.camera.intrinsics;
        through(moment, &|place| self.direction(&intrinsics, place), next)
    }
}

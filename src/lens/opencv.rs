//! Where the lenses of OpenCV look.
//!
//! Enters: a position in the picture, less the principal point, over the focal lengths. Leaves: the direction that is seen
//! there. OpenCV's functions go the other way, so they are inverted by Newton's method, from the middle outward: of several
//! solutions the one before any fold is found.

use std::f64::consts::PI;

use cinesplat_trajectory::{LensModel, LensProjection};
use glam::{DVec2, DVec3};

/// Steps of Newton's method.
const MAX_STEPS: usize = 30;
/// Largest distance from the solution.
const TOLERANCE: f64 = 1e-9;
/// Parts of the way from the middle, each solved from the one before it.
const NUM_PARTS: u32 = 8;
/// Least growth of the picture with the direction: below it the lens folds.
const LEAST_GROWTH: f64 = 1e-3;

/// The direction of a position (camera axes, any length); `None` where the lens folds before it, and beyond the circle of a
/// fisheye.
pub(super) fn direction(lens: &LensModel, seen: DVec2) -> Option<DVec3> {
    match lens.projection {
        LensProjection::Opencv if lens.is_bent() => Some(undistorted(lens, seen)?.extend(1.0)),
        LensProjection::Opencv => Some(seen.extend(1.0)),
        LensProjection::OpencvFisheye => {
            let distance = seen.length();
            let angle = fisheye_angle(lens, distance)?;
            let across = if distance > 0.0 { angle.sin() / distance } else { 0.0 };
            Some((seen * across).extend(angle.cos()))
        }
    }
}

/// Whether the picture of a lens is a circle, beyond which there is nothing.
pub(super) fn has_circle(lens: &LensModel) -> bool {
    lens.projection == LensProjection::OpencvFisheye
}

/// Where a point at depth 1 appears (`cv::projectPoints`).
fn distorted(lens: &LensModel, p: DVec2) -> DVec2 {
    let ([k1, k2, k3, k4, k5, k6], [p1, p2]) = (lens.radial, lens.tangential);
    let r2 = p.length_squared();
    let radial = (1.0 + r2 * (k1 + r2 * (k2 + r2 * k3))) / (1.0 + r2 * (k4 + r2 * (k5 + r2 * k6)));
    let (x, y) = (p.x, p.y);
    let tangential = DVec2::new(2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x), p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y);
    p * radial + tangential
}

/// The point at depth 1 that appears at a position.
fn undistorted(lens: &LensModel, seen: DVec2) -> Option<DVec2> {
    let mut p = DVec2::ZERO;
    for part in 1..=NUM_PARTS {
        p = solved(lens, seen * (f64::from(part) / f64::from(NUM_PARTS)), p)?;
    }
    Some(p)
}

/// The solution near a guess, with the determinant of the derivative above 0.
fn solved(lens: &LensModel, seen: DVec2, mut p: DVec2) -> Option<DVec2> {
    for _ in 0..MAX_STEPS {
        let miss = distorted(lens, p) - seen;
        if miss.length() < TOLERANCE {
            return Some(p);
        }
        let step = 1e-6;
        let [dx, dy] = [DVec2::X, DVec2::Y]
            .map(|axis| (distorted(lens, p + axis * step) - distorted(lens, p - axis * step)) / (2.0 * step));
        let determinant = dx.perp_dot(dy);
        if !(determinant > LEAST_GROWTH) {
            return None;
        }
        p -= DVec2::new(miss.perp_dot(dy), dx.perp_dot(miss)) / determinant;
    }
    None
}

/// The angle from the view axis that a fisheye shows at a distance from the middle (`cv::fisheye::projectPoints`).
fn fisheye_angle(lens: &LensModel, distance: f64) -> Option<f64> {
    let [k1, k2, k3, k4, ..] = lens.radial;
    let mut angle: f64 = 0.0;
    for part in 1..=NUM_PARTS {
        let wanted = distance * f64::from(part) / f64::from(NUM_PARTS);
        let mut miss = f64::INFINITY;
        for _ in 0..MAX_STEPS {
            let t2 = angle * angle;
            miss = angle * (1.0 + t2 * (k1 + t2 * (k2 + t2 * (k3 + t2 * k4)))) - wanted;
            if miss.abs() < TOLERANCE {
                break;
            }
            let growth = 1.0 + t2 * (3.0 * k1 + t2 * (5.0 * k2 + t2 * (7.0 * k3 + t2 * 9.0 * k4)));
            if !(growth > LEAST_GROWTH) {
                return None;
            }
            angle -= miss / growth;
        }
        if !(miss.abs() < TOLERANCE && angle < PI) {
            return None;
        }
    }
    Some(angle)
}

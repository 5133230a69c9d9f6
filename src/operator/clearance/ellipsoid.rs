//! The distance from a point to an ellipsoid.
//!
//! For a point `y` outside an ellipsoid of semi-axes `e`, in the ellipsoid's frame, the nearest point is `x_i = e_i^2
//! y_i / (t + e_i^2)` with the `t > 0` at which `x` lies on the surface: `N(t) = |e_i y_i / (t + e_i^2)| = 1` (Eberly,
//! "Distance from a Point to an Ellipse, an Ellipsoid, or a Hyperellipsoid", 2013). `1 / N` is concave in `t`, so
//! Newton's method on it, started left of the root, never passes it (Conn, Gould and Toint, "Trust-Region Methods",
//! 2000, 7.3.3), and the distance `|t y_i / (t + e_i^2)|` grows with `t`: every iterate is a lower bound on the
//! distance, for every shape.

use glam::{DVec3, Quat, Vec3};

/// Smallest semi-axis over the largest. Smaller ones are raised to it, which changes less than the rounding of
/// positions.
const MIN_AXIS_FRAC: f64 = 1e-9;
/// Limit on Newton steps; ten are rare.
const MAX_STEPS: usize = 64;
/// Tolerance on `N = 1`.
const TOLERANCE: f64 = 1e-12;

/// The ellipsoid of a Gaussian. The mean is relative to the scene's origin.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ellipsoid {
    pub(super) mean: Vec3,
    /// From the ellipsoid's axes to the world; of any length except zero.
    pub(super) rotation: Quat,
    /// Standard deviations along the ellipsoid's axes.
    pub(super) scales: Vec3,
}

impl Ellipsoid {
    /// Distance from a point (relative to the scene's origin) to the ellipsoid of `sigma` standard deviations; 0
    /// inside. `None` where it is `cutoff` or more. Never above the true distance by more than rounding.
    pub(super) fn distance_below(&self, point: DVec3, sigma: f64, cutoff: f64) -> Option<f64> {
        let away = point - self.mean.as_dvec3();
        let semi_axes = self.scales.as_dvec3() * sigma;
        let longest = semi_axes.max_element();
        if away.length() - longest >= cutoff {
            return None;
        }
        let local = unrotated(self.rotation, away).abs();
        let semi_axes = semi_axes.max(DVec3::splat(MIN_AXIS_FRAC * longest));
        // The ellipsoid's box in its own frame is never farther than the ellipsoid.
        if (local - semi_axes).max(DVec3::ZERO).length_squared() >= cutoff * cutoff {
            return None;
        }
        distance_below(local, semi_axes, cutoff)
    }

    /// Half extents along the world's axes of the ellipsoid of `sigma` standard deviations.
    pub(super) fn half_extents(&self, sigma: f64) -> DVec3 {
        let semi_axes = self.scales.as_dvec3() * sigma;
        let axis = |unit: DVec3| (unrotated(self.rotation, unit) * semi_axes).length();
        DVec3::new(axis(DVec3::X), axis(DVec3::Y), axis(DVec3::Z))
    }
}

/// A vector rotated by the inverse of a quaternion, which need not be of unit length.
fn unrotated(rotation: Quat, v: DVec3) -> DVec3 {
    let (axis, w) = (-rotation.as_dquat().xyz(), f64::from(rotation.w));
    let twice = axis.cross(v) * 2.0 / (axis.length_squared() + w * w);
    v + twice * w + axis.cross(twice)
}

/// As [`Ellipsoid::distance_below`], for a point in the first octant. The semi-axes `e` are all above zero, or all
/// zero.
fn distance_below(y: DVec3, e: DVec3, cutoff: f64) -> Option<f64> {
    if e.max_element() <= 0.0 {
        return Some(y.length()).filter(|&distance| distance < cutoff);
    }
    if (y / e).length_squared() <= 1.0 {
        return Some(0.0);
    }
    let squares = e * e;
    // At the root no single term of N is above 1: the root lies at or right of this start.
    let mut t = (e * y - squares).max_element().max(0.0);
    let mut distance = 0.0;
    for _ in 0..MAX_STEPS {
        let share = y / (squares + t);
        distance = t * share.length();
        if distance >= cutoff {
            return None;
        }
        let g = e * share;
        let norm_squared = g.length_squared();
        let over = norm_squared.sqrt() - 1.0;
        if over <= TOLERANCE {
            break;
        }
        t += over * norm_squared / (g * g / (squares + t)).element_sum();
    }
    Some(distance)
}

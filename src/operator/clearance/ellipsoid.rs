//! The distance from a point to an ellipsoid.
//!
//! For a point `y` outside, in the frame of semi-axes `e`, the nearest point is `x_i = e_i^2 y_i / (t + e_i^2)` with the
//! `t > 0` at which `x` lies on the surface: `N(t) = |e_i y_i / (t + e_i^2)| = 1` (Eberly, "Distance from a Point to an
//! Ellipse, an Ellipsoid, or a Hyperellipsoid", 2013). `1 / N` is concave in `t`, so Newton's method on it, begun left of
//! the root, never passes it (Conn, Gould and Toint, "Trust-Region Methods", 2000, 7.3.3), and the distance
//! `|t y_i / (t + e_i^2)|` grows with `t`: every iterate is a lower bound of the distance, whatever the shape.

use glam::{DVec3, Quat, Vec3};

/// Thinnest semi-axis over the longest. Thinner ones count as this thick, which is less than the rounding of their place.
const THINNEST_FRAC: f64 = 1e-9;
/// Newton steps at most; ten are rare.
const MAX_STEPS: usize = 64;
/// How near `N` comes to 1.
const TOLERANCE: f64 = 1e-12;

/// An ellipsoid about a mean, relative to the scene's origin.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ellipsoid {
    pub(super) mean: Vec3,
    /// From the ellipsoid's own axes to the world; of any length but zero.
    pub(super) rotation: Quat,
    /// Standard deviations along its own axes.
    pub(super) scales: Vec3,
}

impl Ellipsoid {
    /// Distance from a point (relative to the scene's origin) to the ellipsoid of so many standard deviations; 0 inside.
    /// `None` as soon as it is known to be `cutoff` or more. Never above the true distance by more than rounding.
    pub(super) fn distance_below(&self, point: DVec3, sigma: f64, cutoff: f64) -> Option<f64> {
        let away = point - self.mean.as_dvec3();
        let semi_axes = self.scales.as_dvec3() * sigma;
        let longest = semi_axes.max_element();
        if away.length() - longest >= cutoff {
            return None;
        }
        let local = unrotated(self.rotation, away).abs();
        let semi_axes = semi_axes.max(DVec3::splat(THINNEST_FRAC * longest));
        // The box about the ellipsoid, in its own frame, is nearer than the ellipsoid.
        if (local - semi_axes).max(DVec3::ZERO).length_squared() >= cutoff * cutoff {
            return None;
        }
        distance_below(local, semi_axes, cutoff)
    }

    /// Half extents along the world's axes of the ellipsoid of so many standard deviations.
    pub(super) fn half_extents(&self, sigma: f64) -> DVec3 {
        let semi_axes = self.scales.as_dvec3() * sigma;
        let axis = |unit: DVec3| (unrotated(self.rotation, unit) * semi_axes).length();
        DVec3::new(axis(DVec3::X), axis(DVec3::Y), axis(DVec3::Z))
    }
}

/// A vector turned back by a quaternion that need not be of unit length.
fn unrotated(rotation: Quat, v: DVec3) -> DVec3 {
    let (axis, w) = (-rotation.as_dquat().xyz(), f64::from(rotation.w));
    let twice = axis.cross(v) * 2.0 / (axis.length_squared() + w * w);
    v + twice * w + axis.cross(twice)
}

/// As [`Ellipsoid::distance_below`], of a point of the first octant; semi-axes above zero, or all zero.
fn distance_below(y: DVec3, e: DVec3, cutoff: f64) -> Option<f64> {
    if e.max_element() <= 0.0 {
        return Some(y.length()).filter(|&distance| distance < cutoff);
    }
    if (y / e).length_squared() <= 1.0 {
        return Some(0.0);
    }
    let squares = e * e;
    // No single term of N may be above 1: the root lies at or right of this.
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

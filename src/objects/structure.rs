//! Names of objects that bound a room: floor, ceiling, wall.
//!
//! Enters: an object with its box. Leaves: a name where the box alone leaves no doubt.

use glam::DVec3;

use super::boxes::UprightBox;
use cinesplat_scene::{SOLID_OPACITY, Scene};

/// Diagonal of a box over the scene size from which it can bound a room.
const MIN_SHARE: f64 = 0.4;

/// Largest share of the scene's Gaussians of an object that bounds a room: a scan of one flat thing is no wall.
const MAX_MEMBERS: f64 = 0.7;

/// Largest thickness, and largest distance from the end of the scene, over the scene's extent in that direction.
const THIN_FRAC: f64 = 0.12;

/// Least share of the scene's extent that a floor covers in both directions, and that a wall covers along and upward.
const MIN_COVERED: f64 = 0.6;

/// `floor`, `ceiling` or `wall` if an object is one: thin, at an end of the scene, and most of its width.
pub(crate) fn name(scene: &Scene, members: &[usize], fitted: &UprightBox, scene_size: f64) -> Option<&'static str> {
    let half = fitted.half_extents;
    let is_large = 2.0 * half.length() >= MIN_SHARE * scene_size;
    if !is_large || members.len() as f64 > MAX_MEMBERS * scene.gaussians.len() as f64 {
        return None;
    }
    let [x, y, z] = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| Span::of(scene, fitted, fitted.rotation * axis));
    let covers = |span: &Span| span.covered >= MIN_COVERED;
    if y.covered <= THIN_FRAC && covers(&x) && covers(&z) {
        return if y.below <= THIN_FRAC {
            Some("floor")
        } else if y.above <= THIN_FRAC {
            Some("ceiling")
        } else {
            None
        };
    }
    let is_wall = |thin: &Span, along: &Span| {
        thin.covered <= THIN_FRAC && thin.below.min(thin.above) <= THIN_FRAC && covers(along) && covers(&y)
    };
    (is_wall(&x, &z) || is_wall(&z, &x)).then_some("wall")
}

/// A box along a direction, over the extent of the scene's solid Gaussians.
struct Span {
    /// Share that the box covers.
    covered: f64,
    /// Shares of the scene below and above it.
    below: f64,
    above: f64,
}

impl Span {
    /// `direction` is an axis of the box.
    fn of(scene: &Scene, fitted: &UprightBox, direction: DVec3) -> Self {
        let gaussians = &scene.gaussians;
        let solid = (0..gaussians.len()).filter(|&i| gaussians.opacities[i] >= SOLID_OPACITY);
        let mut along: Vec<f64> = solid.map(|i| gaussians.mean_world(i).dot(direction)).collect();
        let mut at = |frac: f64| {
            let idx = (frac * along.len().saturating_sub(1) as f64) as usize;
            if along.is_empty() { 0.0 } else { *along.select_nth_unstable_by(idx, f64::total_cmp).1 }
        };
        let (low, high) = (at(0.005), at(0.995));
        let extent = (high - low).max(f64::MIN_POSITIVE);
        let local = (fitted.rotation.conjugate() * direction).abs();
        let (middle, half) = (fitted.center.dot(direction), fitted.half_extents.dot(local));
        Self {
            covered: 2.0 * half / extent,
            below: (middle - half - low).max(0.0) / extent,
            above: (high - middle - half).max(0.0) / extent,
        }
    }
}

//! Splats that an exposure passes so closely that its pictures share no projection.
//!
//! Enters: an exposure and a scene. Leaves: whether a splat may be in front of the near plane in some of its pictures and
//! behind it in others, or so close to it that its size changes much meanwhile.

use glam::DVec3;
use rayon::prelude::*;

use super::View;
use super::sweep::Sweep;
use cinesplat_scene::Gaussians;

/// Share of the near plane's distance by which the camera may come closer.
const SLIGHT_FRAC: f64 = 0.01;
/// Distance from the near plane, in ways of the camera, from which on a splat changes little.
const FAR_WAYS: f64 = 4.0;
/// Standard deviations at which splats end.
const END_SIGMAS: f64 = 4.0;

/// Whether the camera of an exposure passes a splat closely. `view` is that of its middle.
pub(super) fn has_close_splats(sweep: &Sweep, view: &View, gaussians: &Gaussians) -> bool {
    let ways = sweep.ends.iter().map(|end| end.pose.position - sweep.center.pose.position);
    let (mut along, mut any_way) = (0.0_f64, 0.0_f64);
    for way in ways {
        along = along.max((view.camera_from_world * way).z.abs());
        any_way = any_way.max(way.length());
    }
    if along <= SLIGHT_FRAC * view.near {
        return false;
    }
    let depths = view.near - along..view.near + FAR_WAYS * along;
    let sides = [0, 1].map(|axis| {
        let size = f64::from([view.width, view.height][axis]);
        view.principal_px[axis].abs().max((size - view.principal_px[axis]).abs()) / view.focal_px[axis]
    });
    let is_close = |mean: DVec3, size: f64| {
        let at = view.camera_from_world * (mean - view.center);
        let reach = any_way + END_SIGMAS * size;
        depths.contains(&at.z)
            && [at.x, at.y].iter().zip(sides).all(|(x, slope)| x.abs() <= slope * (at.z + along) + reach)
    };
    let members = gaussians.means.par_iter().zip(&gaussians.scales).with_min_len(1 << 14);
    members.any(|(mean, scales)| is_close(mean.as_dvec3(), f64::from(scales.max_element())))
}

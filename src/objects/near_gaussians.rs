//! The Gaussians around points.

use glam::DVec3;
use rayon::prelude::*;

use cinesplat_scene::Gaussians;

/// Number of Gaussians around a point: enough that some of them lie on the surface of the object, and not under it.
const NUM_NEAREST: usize = 8;

/// For every point the indices of the Gaussians with the nearest means, nearest first; ties go to the earlier one.
pub(crate) fn nearest(gaussians: &Gaussians, points: &[DVec3]) -> Vec<Vec<usize>> {
    let of_point = |point: &DVec3| {
        let mut found: Vec<(f64, usize)> = Vec::with_capacity(NUM_NEAREST + 1);
        for i in 0..gaussians.len() {
            let distance = gaussians.mean_world(i).distance_squared(*point);
            if found.len() < NUM_NEAREST || found.last().is_some_and(|last| distance < last.0) {
                let place = found.partition_point(|other| other.0 <= distance);
                found.insert(place, (distance, i));
                found.truncate(NUM_NEAREST);
            }
        }
        found.into_iter().map(|(_, i)| i).collect()
    };
    points.par_iter().map(of_point).collect()
}

//! A brute-force scan of a path: every sample against every ellipsoid, by bisection of the distance equation. It
//! shares no code for trees, distances or bounds with the solver.

use glam::DVec3;

use cinesplat::operator::SIGMA_LEVEL;
use cinesplat::scene::{Gaussians, SOLID_OPACITY};

/// Number of consecutive samples in a bounding ball. An ellipsoid is compared with the ball before its samples.
const CHUNK: usize = 250;

/// Number of samples nearer to matter than `radius`, and the least distance of any sample, at most 1.5 radii.
pub(super) fn scan(gaussians: &Gaussians, samples: &[DVec3], radius: f64) -> (usize, f64) {
    let reach = 1.5 * radius;
    let ball = |chunk: &[DVec3]| {
        let center = chunk.iter().sum::<DVec3>() / chunk.len() as f64;
        (center, chunk.iter().map(|point| point.distance(center)).fold(0.0, f64::max))
    };
    let balls: Vec<(DVec3, f64)> = samples.chunks(CHUNK).map(ball).collect();
    let mut near = vec![reach; samples.len()];
    for i in (0..gaussians.len()).filter(|&i| gaussians.opacities[i] >= SOLID_OPACITY) {
        let mean = gaussians.mean_world(i);
        let semi_axes = gaussians.scales[i].as_dvec3() * SIGMA_LEVEL;
        let far = reach + semi_axes.max_element();
        for (chunk, &(center, extent)) in balls.iter().enumerate() {
            if mean.distance_squared(center) > (far + extent) * (far + extent) {
                continue;
            }
            let gaussian_from_world = gaussians.rotations[i].as_dquat().normalize().conjugate();
            let first = chunk * CHUNK;
            for at in first..(first + CHUNK).min(samples.len()) {
                let local = gaussian_from_world * (samples[at] - mean);
                if local.length_squared() <= far * far {
                    near[at] = near[at].min(bisected_distance(local, semi_axes));
                }
            }
        }
    }
    let least = near.iter().copied().fold(reach, f64::min);
    (near.iter().filter(|&&distance| distance < radius).count(), least)
}

/// Distance from a point `y` to an ellipsoid about the origin with semi-axes `e` along the axes, 0 inside: the root of
/// `sum (e_i y_i / (t + e_i^2))^2 = 1` by bisection.
fn bisected_distance(y: DVec3, e: DVec3) -> f64 {
    let e = e.max(DVec3::splat(1e-12));
    let sum = |t: f64| (e * y / (e * e + t)).length_squared();
    if sum(0.0) <= 1.0 {
        return 0.0;
    }
    let (mut low, mut high): (f64, f64) = (0.0, y.length() * e.max_element());
    for _ in 0..100 {
        let middle = low.midpoint(high);
        if sum(middle) > 1.0 { low = middle } else { high = middle }
    }
    y.distance(e * e * y / (e * e + high))
}

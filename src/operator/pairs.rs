//! A trial of the router: ways between random places of a scene, looked at again without any index.
//!
//! Enters: a prepared scene, its Gaussians and a seed. Leaves: for every pair how long the solver took, what it proved, and
//! what a plain scan finds: every one of many samples of the path against every ellipsoid, by bisection of the distance's
//! own equation. The scan shares neither tree, nor distance, nor bounds with the solver.

use std::time::Duration;

use glam::DVec3;
use rand::{Rng, RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use super::SIGMA_LEVEL;
use super::route::{NoRoute, Route, route};
use super::world::World;
use cinesplat_geometry::Pose;
use cinesplat_scene::{Gaussians, SOLID_OPACITY};
use cinesplat_trajectory::{CameraPath, CameraState};

/// Least distance between the ends of a pair, over the scene size.
const LEAST_APART_FRAC: f64 = 0.2;
/// Room that both ends have, in camera radii.
const END_ROOM: f64 = 1.25;
/// Draws for one pair before any is taken.
const MAX_DRAWS: usize = 4000;
/// Samples in a row that are compared with an ellipsoid at once before they are one by one.
const CHUNK: usize = 250;
/// Seconds that a way takes.
const WAY_SECS: f64 = 8.0;

/// What to try.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PairSettings {
    /// Pairs.
    pub num_pairs: usize,
    /// Samples of every path that are compared with all ellipsoids; 0 to compare none.
    pub num_samples: usize,
    /// Seed of the pairs.
    pub seed: u64,
}

/// What came of one pair.
#[derive(Debug, Clone)]
pub struct PairResult {
    /// Where it starts, world.
    pub start: DVec3,
    /// Where it goes, world.
    pub goal: DVec3,
    /// Time of the solver, route and proof, by the clock that was given.
    pub solve_time: Duration,
    /// The way.
    pub route: Result<Route, NoRoute>,
    /// Samples of it nearer to matter than the camera's radius, by the scan; `None` without a way or scan.
    pub num_violations: Option<usize>,
    /// Least distance that the scan found below 1.5 camera radii, or those.
    pub scanned_least: Option<f64>,
}

/// Tries pairs of places that are free and seen from where one stands in the scene. Every second one is drawn until the
/// straight way between its ends is blocked. `clock` tells the time since any moment of its own.
pub fn try_pairs(
    world: &World,
    gaussians: &Gaussians,
    settings: &PairSettings,
    clock: impl Fn() -> Duration,
) -> Vec<PairResult> {
    let mut rng = Pcg64Mcg::seed_from_u64(settings.seed);
    let mut results = Vec::with_capacity(settings.num_pairs);
    for number in 0..settings.num_pairs {
        let Some((start, goal)) = draw_pair(world, number % 2 == 1, &mut rng) else { break };
        let begun = clock();
        let route = route(world, &start, &goal);
        let solve_time = clock().saturating_sub(begun);
        let scanned = route.as_ref().ok().filter(|_| settings.num_samples > 1).map(|route| {
            let keys = route.keyframes(world, WAY_SECS);
            let path = CameraPath::fine(keys, world.frame);
            let at = |i: usize| path.sample(WAY_SECS * i as f64 / (settings.num_samples - 1) as f64).pose.position;
            let samples: Vec<DVec3> = (0..settings.num_samples).map(at).collect();
            scan(gaussians, &samples, world.camera_radius)
        });
        results.push(PairResult {
            start: start.pose.position,
            goal: goal.pose.position,
            solve_time,
            route,
            num_violations: scanned.map(|(count, _)| count),
            scanned_least: scanned.map(|(_, least)| least),
        });
    }
    results
}

/// Two free places apart from each other, with cameras that look from one to the other.
fn draw_pair(world: &World, blocked: bool, rng: &mut impl Rng) -> Option<(CameraState, CameraState)> {
    let (low, extent) = (world.bounds.core_min, world.bounds.core_max - world.bounds.core_min);
    let mut place = || -> Option<DVec3> {
        for _ in 0..MAX_DRAWS {
            let point = low + extent * DVec3::from_array(std::array::from_fn(|_| rng.random::<f64>()));
            if world.clearance(point) >= END_ROOM * world.camera_radius && world.supports(point) {
                return Some(point);
            }
        }
        None
    };
    let mut last = None;
    for _ in 0..MAX_DRAWS / 40 {
        let (a, b) = (place()?, place()?);
        if a.distance(b) < LEAST_APART_FRAC * world.bounds.size() {
            continue;
        }
        let camera = |position: DVec3| CameraState {
            pose: Pose::facing(position, b - a, world.frame.up, None),
            fov_y_rad: 50_f64.to_radians(),
            focus_distance: None,
        };
        last = Some((camera(a), camera(b)));
        if !blocked || !is_open(world, a, b) {
            break;
        }
    }
    last
}

/// Whether some even samples of a straight way are all free; only chooses pairs.
fn is_open(world: &World, a: DVec3, b: DVec3) -> bool {
    (0..=200).all(|i| world.clearance(a.lerp(b, f64::from(i) / 200.0)) >= world.camera_radius)
}

/// Number of samples nearer to matter than `radius`, and the least distance found, 1.5 radii at most.
fn scan(gaussians: &Gaussians, samples: &[DVec3], radius: f64) -> (usize, f64) {
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
            let to_own = gaussians.rotations[i].as_dquat().normalize().conjugate();
            let first = chunk * CHUNK;
            for at in first..(first + CHUNK).min(samples.len()) {
                let local = to_own * (samples[at] - mean);
                if local.length_squared() <= far * far {
                    near[at] = near[at].min(bisected_distance(local, semi_axes));
                }
            }
        }
    }
    let least = near.iter().copied().fold(reach, f64::min);
    (near.iter().filter(|&&distance| distance < radius).count(), least)
}

/// Distance from a point to an ellipsoid about the origin along the axes, 0 inside: the root of
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

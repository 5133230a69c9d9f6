//! A trial of the router on random start-goal pairs, verified without any index.
//!
//! Enters: a prepared scene, its Gaussians and a seed. Leaves: for every pair the solver's time, the route with its
//! certificate, and the result of a brute-force scan of the path.

use std::time::Duration;

use glam::DVec3;
use rand::{Rng, RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use super::scan::scan;
use cinesplat::geometry::Pose;
use cinesplat::operator::{NoRoute, Route, World, route};
use cinesplat::scene::Gaussians;
use cinesplat::trajectory::{CameraPath, CameraState};

/// Least distance between the ends of a pair, over the scene size.
const MIN_APART_FRAC: f64 = 0.2;
/// Clearance of both ends, in camera radii.
const END_CLEARANCE: f64 = 1.25;
/// Limit on the draws of one end.
const MAX_DRAWS: usize = 4000;
/// Time to travel a route.
const TRAVEL_SECS: f64 = 8.0;

/// Size and seed of a trial.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct PairTrial {
    /// Number of pairs.
    pub(super) num_pairs: usize,
    /// Samples of every path that are compared with all ellipsoids; below 2 no path is scanned.
    pub(super) num_samples: usize,
    /// Seed of the pairs.
    pub(super) seed: u64,
}

/// The result of one pair.
#[derive(Debug, Clone)]
pub(super) struct PairResult {
    /// Start, world.
    pub(super) start: DVec3,
    /// Goal, world.
    pub(super) goal: DVec3,
    /// Time of the solver for route and certificate, by the clock of the trial.
    pub(super) solve_time: Duration,
    /// The route.
    pub(super) route: Result<Route, NoRoute>,
    /// Samples of the path that the scan finds nearer to matter than the camera's radius; `None` without a route or
    /// scan.
    pub(super) num_violations: Option<usize>,
    /// Least distance that the scan finds, at most 1.5 camera radii; `None` without a route or scan.
    pub(super) scanned_least: Option<f64>,
}

impl PairTrial {
    /// Routes between pairs of free places inside the captured region. Every second pair is redrawn until the straight
    /// line between its ends is blocked. `clock` returns the time since an arbitrary moment.
    pub(super) fn run(&self, world: &World, gaussians: &Gaussians, clock: impl Fn() -> Duration) -> Vec<PairResult> {
        let mut rng = Pcg64Mcg::seed_from_u64(self.seed);
        let mut results = Vec::with_capacity(self.num_pairs);
        for number in 0..self.num_pairs {
            let Some((start, goal)) = draw_pair(world, number % 2 == 1, &mut rng) else { break };
            let begun = clock();
            let route = route(world, &start, &goal);
            let solve_time = clock().saturating_sub(begun);
            let scanned = route.as_ref().ok().filter(|_| self.num_samples > 1).map(|route| {
                let path = CameraPath::fine(route.keyframes(world, TRAVEL_SECS), world.frame);
                let at = |i: usize| path.sample(TRAVEL_SECS * i as f64 / (self.num_samples - 1) as f64).pose.position;
                let samples: Vec<DVec3> = (0..self.num_samples).map(at).collect();
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
}

/// Two free places apart from each other, with cameras that look from the first to the second.
fn draw_pair(world: &World, blocked: bool, rng: &mut impl Rng) -> Option<(CameraState, CameraState)> {
    let (low, extent) = (world.bounds.core_min, world.bounds.core_max - world.bounds.core_min);
    let mut place = || -> Option<DVec3> {
        for _ in 0..MAX_DRAWS {
            let point = low + extent * DVec3::from_array(std::array::from_fn(|_| rng.random::<f64>()));
            if world.clearance(point) >= END_CLEARANCE * world.camera_radius && world.in_capture_region(point) {
                return Some(point);
            }
        }
        None
    };
    let mut last = None;
    for _ in 0..MAX_DRAWS / 40 {
        let (a, b) = (place()?, place()?);
        if a.distance(b) < MIN_APART_FRAC * world.bounds.size() {
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

/// Whether 201 samples of a straight line are all free. This only selects pairs.
fn is_open(world: &World, a: DVec3, b: DVec3) -> bool {
    (0..=200).all(|i| world.clearance(a.lerp(b, f64::from(i) / 200.0)) >= world.camera_radius)
}

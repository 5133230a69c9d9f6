//! Certificates of the distance between matter and a whole path, by branch and bound.
//!
//! An interval of a path lies in a ball about its midpoint ([`CameraPath::bounding_ball`]), and the distance to matter
//! is 1-Lipschitz: where the midpoint is `d` from matter and the ball's radius is `r`, the whole interval is at least
//! `d - r` from it. Intervals whose bound is too loose are bisected, the one of least bound first. The result is a
//! lower bound for every moment, because the intervals cover the path. The nearest midpoint is a witness of how tight
//! the bound is.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use super::index::{ClearanceIndex, Nearest, SIGMA_LEVEL};
use cinesplat_scene::SOLID_OPACITY;
use cinesplat_trajectory::{CameraPath, ClearanceFailure, ClearanceProof, PathInterval};

/// Largest gap between the certified bound and the witness's distance, over the camera's radius.
const TOLERANCE_FRAC: f64 = 0.01;
/// Limit on the intervals examined for one certificate. A path along a wall for its whole length takes a few thousand.
const MAX_INTERVALS: usize = 60_000;
/// Share of the camera's radius that exceeds the rounding error of distances.
const ROUNDING_FRAC: f64 = 1e-9;

/// When branch and bound stops.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ClearanceQuery {
    /// Intervals that are known to be this far from matter are not examined further, scene units.
    pub(crate) enough: f64,
    /// Largest gap between the bound and the witness's distance, scene units.
    pub(crate) tolerance: f64,
    /// Limit on the number of intervals examined.
    pub(crate) max_intervals: usize,
}

/// A lower bound on the clearance of a path.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ClearanceBound {
    /// Every point of the path is at least this far from matter, scene units; at most [`ClearanceQuery::enough`].
    pub(crate) bound: f64,
    /// The interval whose midpoint is nearest to matter, and the matter. `None` where every midpoint is at least
    /// `enough` away.
    pub(crate) witness: Option<(PathInterval, Nearest)>,
    /// Intervals examined.
    pub(crate) num_intervals: usize,
}

/// An interval that may come nearer to matter than the witness.
#[derive(Debug, Clone, Copy)]
struct OpenInterval {
    bound: f64,
    interval: PathInterval,
}

impl Ord for OpenInterval {
    /// The least bound is the greatest, so that the heap pops it first; ties go to the earlier interval.
    fn cmp(&self, other: &Self) -> Ordering {
        let place = |open: &Self| (open.interval.key_idx, open.interval.from);
        let ((key, from), (other_key, other_from)) = (place(self), place(other));
        other.bound.total_cmp(&self.bound).then(other_key.cmp(&key)).then(other_from.total_cmp(&from))
    }
}

impl PartialOrd for OpenInterval {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for OpenInterval {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for OpenInterval {}

/// The state of branch and bound.
struct BranchAndBound<'a> {
    index: &'a ClearanceIndex,
    path: &'a CameraPath,
    open: BinaryHeap<OpenInterval>,
    /// Distance at the nearest midpoint so far, at most [`ClearanceQuery::enough`].
    nearest: f64,
    witness: Option<(PathInterval, Nearest)>,
    num_intervals: usize,
}

impl BranchAndBound<'_> {
    /// Examines an interval that is known to be at least `floor` from matter. Keeps it where it may come nearer than
    /// the witness.
    fn examine(&mut self, interval: PathInterval, floor: f64) {
        self.num_intervals += 1;
        let ball = self.path.bounding_ball(interval);
        let Some(nearest) = self.index.nearest_within(ball.center, self.nearest + ball.radius) else { return };
        if nearest.distance < self.nearest {
            self.nearest = nearest.distance;
            self.witness = Some((interval, nearest));
        }
        let bound = (nearest.distance - ball.radius).max(floor);
        if bound < self.nearest {
            self.open.push(OpenInterval { bound, interval });
        }
    }
}

/// A lower bound on the distance between a path and matter, as tight as the query requires.
pub(crate) fn least_clearance(index: &ClearanceIndex, path: &CameraPath, query: &ClearanceQuery) -> ClearanceBound {
    let mut search =
        BranchAndBound { index, path, open: BinaryHeap::new(), nearest: query.enough, witness: None, num_intervals: 0 };
    path.intervals().into_iter().for_each(|interval| search.examine(interval, 0.0));
    let mut bound = None;
    while let Some(next) = search.open.pop() {
        let tight = search.witness.is_some() && next.bound >= search.nearest - query.tolerance;
        if tight || search.num_intervals >= query.max_intervals {
            bound = Some(next.bound);
            break;
        }
        next.interval.halves().into_iter().for_each(|half| search.examine(half, next.bound));
    }
    let bound = bound.unwrap_or(search.nearest).min(search.nearest);
    ClearanceBound { bound, witness: search.witness, num_intervals: search.num_intervals }
}

/// Certifies the clearance of a path for a camera ball of `radius`, scene units.
pub(crate) fn prove(index: &ClearanceIndex, path: &CameraPath, radius: f64) -> ClearanceProof {
    let query =
        ClearanceQuery { enough: f64::INFINITY, tolerance: TOLERANCE_FRAC * radius, max_intervals: MAX_INTERVALS };
    let found = least_clearance(index, path, &query);
    let least = (found.bound * (1.0 - ROUNDING_FRAC) - radius * ROUNDING_FRAC).max(0.0);
    // A bound just below the radius may be loose: the search for a failure decides.
    let (more_intervals, failure) = if least >= radius { (0, None) } else { first_failure(index, path, radius) };
    let least = if failure.is_none() { least.max(radius) } else { least };
    ClearanceProof {
        camera_radius: radius,
        opacity_floor: f64::from(SOLID_OPACITY),
        sigma_level: SIGMA_LEVEL,
        min_distance: least,
        at_secs: found.witness.map_or(0.0, |(interval, _)| path.time_at(interval.key_idx, interval.middle())),
        gaussian_idx: found.witness.map(|(_, nearest)| nearest.gaussian_idx as usize),
        num_intervals: found.num_intervals + more_intervals,
        failure,
    }
}

/// The first stretch of a path that cannot be certified as clear, and the number of intervals examined to find it.
fn first_failure(index: &ClearanceIndex, path: &CameraPath, radius: f64) -> (usize, Option<ClearanceFailure>) {
    let finest = TOLERANCE_FRAC * radius;
    let mut ahead = path.intervals();
    ahead.reverse();
    let (mut num_intervals, mut failing): (usize, Option<(PathInterval, PathInterval, Nearest)>) = (0, None);
    while let Some(interval) = ahead.pop() {
        num_intervals += 1;
        let ball = path.bounding_ball(interval);
        match index.nearest_within(ball.center, radius * (1.0 + ROUNDING_FRAC) + ball.radius) {
            None if failing.is_some() => break,
            None => {}
            Some(nearest)
                if nearest.distance + ball.radius < radius
                    || ball.radius <= finest
                    || num_intervals >= MAX_INTERVALS =>
            {
                let (first, _, worst) = failing.unwrap_or((interval, interval, nearest));
                failing = Some((first, interval, if nearest.distance < worst.distance { nearest } else { worst }));
            }
            Some(_) => ahead.extend(interval.halves().into_iter().rev()),
        }
    }
    let failure = failing.map(|(first, last, worst)| ClearanceFailure {
        from_secs: path.time_at(first.key_idx, first.from),
        to_secs: path.time_at(last.key_idx, last.to),
        distance: worst.distance,
        gaussian_idx: worst.gaussian_idx as usize,
    });
    (num_intervals, failure)
}

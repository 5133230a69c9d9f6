//! Proofs about the distance between matter and a whole path.
//!
//! A part of a path lies in a ball about its middle ([`CameraPath::bounding_ball`]), and distances change by no more than the way:
//! the part is at least `d - r` from matter when its middle is `d` from it and the ball's radius is `r`. Parts for which
//! that says too little are halved, those that may come nearest first (branch and bound). What remains is a bound that
//! holds at every moment, since it speaks of parts that together are the path, and that a witness on the path shows to
//! be tight.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use super::{ClearanceIndex, Nearest, SIGMA_LEVEL};
use cinesplat_scene::SOLID_OPACITY;
use cinesplat_trajectory::{CameraPath, ClearanceFailure, ClearanceProof, PathInterval};

/// How close the proved bound comes to the least distance found on the path, over the camera's radius.
const TOLERANCE_FRAC: f64 = 0.01;
/// Parts looked at for one proof at most; a path along a wall for its whole length takes some thousand.
const MAX_PARTS: usize = 60_000;
/// Share of the camera's radius that covers the rounding of distances.
const ROUNDING_FRAC: f64 = 1e-9;

/// How far to look for the least clearance of a path.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Search {
    /// A clearance that is good enough: nothing is asked of what is known to have it.
    pub(crate) enough: f64,
    /// How close the bound has to come to the least distance found.
    pub(crate) tolerance: f64,
    /// Parts looked at, at most.
    pub(crate) max_parts: usize,
}

/// What is known about the clearance of a path.
#[derive(Debug, Clone, Copy)]
pub(crate) struct LeastClearance {
    /// No point of the path is nearer to matter than this; at most [`Search::enough`].
    pub(crate) bound: f64,
    /// The nearest that was met at the middle of a part: where, and what. `None` where all is at least `enough` away.
    pub(crate) witness: Option<(PathInterval, Nearest)>,
    /// Parts looked at.
    pub(crate) num_parts: usize,
}

/// A part that may come nearer than what has been met.
#[derive(Debug, Clone, Copy)]
struct Open {
    bound: f64,
    part: PathInterval,
}

impl Ord for Open {
    /// The least bound is the greatest, ties to the earlier part.
    fn cmp(&self, other: &Self) -> Ordering {
        let place = |open: &Self| (open.part.key_idx, open.part.from);
        let ((key, from), (other_key, other_from)) = (place(self), place(other));
        other.bound.total_cmp(&self.bound).then(other_key.cmp(&key)).then(other_from.total_cmp(&from))
    }
}

impl PartialOrd for Open {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Open {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Open {}

/// A search under way.
struct Hunt<'a> {
    index: &'a ClearanceIndex,
    path: &'a CameraPath,
    open: BinaryHeap<Open>,
    /// Distance at the nearest place met so far, or what is enough.
    met: f64,
    witness: Option<(PathInterval, Nearest)>,
    num_parts: usize,
}

impl Hunt<'_> {
    /// Looks at a part that is known to be at least `floor` from matter; keeps it if it may come nearer than what is met.
    fn look(&mut self, part: PathInterval, floor: f64) {
        self.num_parts += 1;
        let ball = self.path.bounding_ball(part);
        let Some(nearest) = self.index.nearest_within(ball.center, self.met + ball.radius) else { return };
        if nearest.distance < self.met {
            self.met = nearest.distance;
            self.witness = Some((part, nearest));
        }
        let bound = (nearest.distance - ball.radius).max(floor);
        if bound < self.met {
            self.open.push(Open { bound, part });
        }
    }
}

/// A lower bound of the distance between a path and matter, as far as the search asks.
pub(crate) fn least_clearance(index: &ClearanceIndex, path: &CameraPath, search: &Search) -> LeastClearance {
    let mut hunt = Hunt { index, path, open: BinaryHeap::new(), met: search.enough, witness: None, num_parts: 0 };
    path.intervals().into_iter().for_each(|part| hunt.look(part, 0.0));
    let mut bound = None;
    while let Some(next) = hunt.open.pop() {
        let tight = hunt.witness.is_some() && next.bound >= hunt.met - search.tolerance;
        if tight || hunt.num_parts >= search.max_parts {
            bound = Some(next.bound);
            break;
        }
        next.part.halves().into_iter().for_each(|half| hunt.look(half, next.bound));
    }
    let bound = bound.unwrap_or(hunt.met).min(hunt.met);
    LeastClearance { bound, witness: hunt.witness, num_parts: hunt.num_parts }
}

/// What can be proved about a camera ball of `radius` on a path.
pub(crate) fn prove(index: &ClearanceIndex, path: &CameraPath, radius: f64) -> ClearanceProof {
    let search = Search { enough: f64::INFINITY, tolerance: TOLERANCE_FRAC * radius, max_parts: MAX_PARTS };
    let found = least_clearance(index, path, &search);
    let least = (found.bound * (1.0 - ROUNDING_FRAC) - radius * ROUNDING_FRAC).max(0.0);
    // A bound just short of the radius may be one that was not made tight enough.
    let (more_parts, failure) = if least >= radius { (0, None) } else { first_failure(index, path, radius) };
    let least = if failure.is_none() { least.max(radius) } else { least };
    ClearanceProof {
        camera_radius: radius,
        opacity_floor: f64::from(SOLID_OPACITY),
        sigma_level: SIGMA_LEVEL,
        min_distance: least,
        at_secs: found.witness.map_or(0.0, |(part, _)| path.time_at(part.key_idx, part.middle())),
        gaussian_idx: found.witness.map(|(_, nearest)| nearest.gaussian_idx as usize),
        num_intervals: found.num_parts + more_parts,
        failure,
    }
}

/// The first stretch of a path that cannot be shown to be clear, and the number of parts looked at to find it.
fn first_failure(index: &ClearanceIndex, path: &CameraPath, radius: f64) -> (usize, Option<ClearanceFailure>) {
    let finest = TOLERANCE_FRAC * radius;
    let mut ahead = path.intervals();
    ahead.reverse();
    let (mut num_parts, mut failing): (usize, Option<(PathInterval, PathInterval, Nearest)>) = (0, None);
    while let Some(part) = ahead.pop() {
        num_parts += 1;
        let ball = path.bounding_ball(part);
        match index.nearest_within(ball.center, radius * (1.0 + ROUNDING_FRAC) + ball.radius) {
            None if failing.is_some() => break,
            None => {}
            Some(nearest)
                if nearest.distance + ball.radius < radius || ball.radius <= finest || num_parts >= MAX_PARTS =>
            {
                let (first, _, worst) = failing.unwrap_or((part, part, nearest));
                failing = Some((first, part, if nearest.distance < worst.distance { nearest } else { worst }));
            }
            Some(_) => ahead.extend(part.halves().into_iter().rev()),
        }
    }
    let failure = failing.map(|(first, last, worst)| ClearanceFailure {
        from_secs: path.time_at(first.key_idx, first.from),
        to_secs: path.time_at(last.key_idx, last.to),
        distance: worst.distance,
        gaussian_idx: worst.gaussian_idx as usize,
    });
    (num_parts, failure)
}

//! A path as an elastic band: it contracts, and matter repels it (Quinlan and Khatib, "Elastic Bands", 1993).

use glam::DVec3;

use super::straight::{end_room, free_around};
use crate::world::World;

/// Points of the band per scene size of path length.
const POINTS_PER_SIZE: f64 = 48.0;
/// Least and largest number of points.
const POINTS: (usize, usize) = (16, 96);
/// Relaxation sweeps over the band.
const SWEEPS: usize = 24;
/// Distance below which matter repels the band, over the required room.
const REPULSION_RANGE: f64 = 1.8;

/// Evenly spaced points along a path, moved so that it bends gently and keeps away from matter. Every point keeps its
/// room.
pub(super) fn smoothed(world: &World, path: &[DVec3], room: f64) -> Vec<DVec3> {
    let length: f64 = path.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
    let count = ((length / world.bounds.size() * POINTS_PER_SIZE) as usize).clamp(POINTS.0, POINTS.1);
    let spacing = length / count as f64;
    let probe = ClearanceProbe { world, wide: REPULSION_RANGE * room, reach: REPULSION_RANGE * room + spacing };
    let mut band: Vec<BandPoint> = resampled(path, length, count).into_iter().map(|point| probe.at(point)).collect();
    let near_ends = end_room(world, path, room);
    for _ in 0..SWEEPS {
        for i in 1..count {
            let needed = if i <= 2 || i + 2 >= count { near_ends } else { room };
            if let Some(moved) = probe.moved(&band[i - 1..=i + 1], needed, spacing) {
                band[i] = moved;
            }
        }
    }
    band.into_iter().map(|at| at.point).collect()
}

/// A point of the band.
#[derive(Debug, Clone, Copy)]
struct BandPoint {
    point: DVec3,
    /// Distance to matter, at most [`ClearanceProbe::reach`].
    free: f64,
}

/// Distances to matter up to a limit.
struct ClearanceProbe<'a> {
    world: &'a World,
    /// Distance below which matter repels the band.
    wide: f64,
    /// Limit: larger distances make no difference.
    reach: f64,
}

/// `count + 1` points at even distances along a polyline.
fn resampled(path: &[DVec3], length: f64, count: usize) -> Vec<DVec3> {
    let mut points = Vec::with_capacity(count + 1);
    let (mut corner, mut before) = (0, 0.0);
    for i in 0..count {
        let wanted = length * i as f64 / count as f64;
        let mut side = path[corner].distance(path[corner + 1]);
        while before + side < wanted && corner + 2 < path.len() {
            before += side;
            corner += 1;
            side = path[corner].distance(path[corner + 1]);
        }
        let share = if side > 0.0 { ((wanted - before) / side).min(1.0) } else { 0.0 };
        points.push(path[corner].lerp(path[corner + 1], share));
    }
    points.push(path[path.len() - 1]);
    points
}

impl ClearanceProbe<'_> {
    fn at(&self, point: DVec3) -> BandPoint {
        BandPoint { point, free: free_around(self.world, point, self.reach) }
    }

    /// The next position of the middle one of three points; `None` where it would lose its room.
    fn moved(&self, three: &[BandPoint], room: f64, spacing: f64) -> Option<BandPoint> {
        let [before, here, after] = [three[0], three[1], three[2]];
        let mut next = here.point.lerp(before.point.midpoint(after.point), 0.6);
        if here.free < self.wide {
            let push = self.away_from_matter(here, 0.1 * room) * (self.wide - here.free);
            next += push.clamp_length_max(0.5 * spacing);
        }
        let next = self.at(next);
        let needed = room.min(here.free);
        // The band between two neighbors is free where the free balls about both overlap.
        let meets = |other: BandPoint| {
            next.free + other.free - next.point.distance(other.point) >= 2.0 * needed.min(other.free)
        };
        (next.free >= needed && meets(before) && meets(after)).then_some(next)
    }

    /// Gradient of the distance to matter, by forward differences; of length 1 at most, less in the middle between
    /// walls.
    fn away_from_matter(&self, here: BandPoint, step: f64) -> DVec3 {
        let slope = |axis: DVec3| (self.at(here.point + axis * step).free - here.free) / step;
        DVec3::new(slope(DVec3::X), slope(DVec3::Y), slope(DVec3::Z)).clamp_length_max(1.0)
    }
}

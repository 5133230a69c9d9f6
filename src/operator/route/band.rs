//! A way as an elastic band: it shortens, and walls push it off (Quinlan and Khatib, "Elastic Bands", 1993).

use glam::DVec3;

use super::straight::{end_room, free_around};
use crate::world::World;

/// Points of the band over a way as long as the scene's size, and at least and at most.
const POINTS_PER_SIZE: f64 = 48.0;
const POINTS: (usize, usize) = (16, 96);
/// Sweeps over the band.
const SWEEPS: usize = 24;
/// Distance to walls up to which they push, over the room that is needed.
const PUSHED_WITHIN: f64 = 1.8;

/// Even points along a way, moved so that it bends gently and keeps away from matter. Every point keeps its room.
pub(super) fn rounded(world: &World, way: &[DVec3], room: f64) -> Vec<DVec3> {
    let length: f64 = way.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
    let count = ((length / world.bounds.size() * POINTS_PER_SIZE) as usize).clamp(POINTS.0, POINTS.1);
    let spacing = length / count as f64;
    let look = Look { world, wide: PUSHED_WITHIN * room, reach: PUSHED_WITHIN * room + spacing };
    let mut band: Vec<Place> = spread(way, length, count).into_iter().map(|point| look.at(point)).collect();
    let near_ends = end_room(world, way, room);
    for _ in 0..SWEEPS {
        for i in 1..count {
            let needed = if i <= 2 || i + 2 >= count { near_ends } else { room };
            if let Some(moved) = look.moved(&band[i - 1..=i + 1], needed, spacing) {
                band[i] = moved;
            }
        }
    }
    band.into_iter().map(|place| place.point).collect()
}

/// A point of the band.
#[derive(Debug, Clone, Copy)]
struct Place {
    point: DVec3,
    /// Distance to matter, as far as one looks.
    free: f64,
}

/// How far one looks for matter.
struct Look<'a> {
    world: &'a World,
    /// Distance up to which walls push.
    wide: f64,
    /// Distance beyond which it makes no difference.
    reach: f64,
}

/// `count + 1` points at even distances along a polyline.
fn spread(way: &[DVec3], length: f64, count: usize) -> Vec<DVec3> {
    let mut points = Vec::with_capacity(count + 1);
    let (mut corner, mut before) = (0, 0.0);
    for i in 0..count {
        let wanted = length * i as f64 / count as f64;
        let mut side = way[corner].distance(way[corner + 1]);
        while before + side < wanted && corner + 2 < way.len() {
            before += side;
            corner += 1;
            side = way[corner].distance(way[corner + 1]);
        }
        let share = if side > 0.0 { ((wanted - before) / side).min(1.0) } else { 0.0 };
        points.push(way[corner].lerp(way[corner + 1], share));
    }
    points.push(way[way.len() - 1]);
    points
}

impl Look<'_> {
    fn at(&self, point: DVec3) -> Place {
        Place { point, free: free_around(self.world, point, self.reach) }
    }

    /// Where the middle one of three points goes next; `None` where it would lose its room.
    fn moved(&self, three: &[Place], room: f64, spacing: f64) -> Option<Place> {
        let [before, here, after] = [three[0], three[1], three[2]];
        let mut next = here.point.lerp(before.point.midpoint(after.point), 0.6);
        if here.free < self.wide {
            let push = self.away_from_matter(here, 0.1 * room) * (self.wide - here.free);
            next += push.clamp_length_max(0.5 * spacing);
        }
        let next = self.at(next);
        let needed = room.min(here.free);
        // The band between two neighbors is free where balls of what is free about them meet.
        let meets =
            |other: Place| next.free + other.free - next.point.distance(other.point) >= 2.0 * needed.min(other.free);
        (next.free >= needed && meets(before) && meets(after)).then_some(next)
    }

    /// Direction in which the distance to matter grows, of length 1 at most: less in the middle between walls.
    fn away_from_matter(&self, here: Place, step: f64) -> DVec3 {
        let slope = |axis: DVec3| (self.at(here.point + axis * step).free - here.free) / step;
        DVec3::new(slope(DVec3::X), slope(DVec3::Y), slope(DVec3::Z)).clamp_length_max(1.0)
    }
}

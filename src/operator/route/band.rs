//! A way as an elastic band: it shortens, and walls push it off (Quinlan and Khatib, "Elastic Bands", 1993).

use glam::DVec3;

use super::straight::{end_room, free_around};
use crate::operator::world::World;

/// Points of the band over a way as long as the scene's size, and at least and at most.
const POINTS_PER_SIZE: f64 = 64.0;
const POINTS: (usize, usize) = (16, 128);
/// Sweeps over the band.
const SWEEPS: usize = 36;
/// Distance to walls up to which they push, over the room that is needed.
const PUSHED_WITHIN: f64 = 1.8;

/// Even points along a way, moved so that it bends gently and keeps away from matter. Every point keeps its room.
pub(super) fn rounded(world: &World, way: &[DVec3], room: f64) -> Vec<DVec3> {
    let length: f64 = way.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
    let count = ((length / world.bounds.size() * POINTS_PER_SIZE) as usize).clamp(POINTS.0, POINTS.1);
    let mut band = spread(way, length, count);
    let near_ends = end_room(world, way, room);
    for _ in 0..SWEEPS {
        for i in 1..count {
            let needed = if i <= 2 || i + 2 >= count { near_ends } else { room };
            if let Some(moved) = moved(world, &band[i - 1..=i + 1], needed, length / count as f64) {
                band[i] = moved;
            }
        }
    }
    band
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

/// Where the middle one of three points goes next; `None` where it would lose its room.
fn moved(world: &World, three: &[DVec3], room: f64, spacing: f64) -> Option<DVec3> {
    let (before, here, after) = (three[0], three[1], three[2]);
    let wide = PUSHED_WITHIN * room;
    let free = free_around(world, here, wide);
    let mut next = here.lerp(before.midpoint(after), 0.6);
    if free < wide {
        let push = away_from_matter(world, here, free, 0.25 * room) * (wide - free);
        next += push.clamp_length_max(0.5 * spacing);
    }
    let needed = room.min(free);
    let clear = free_around(world, next, wide + spacing);
    // The band between two neighbors is free where balls of what is free about them meet.
    let meets = |other: DVec3| {
        let around = free_around(world, other, wide + spacing);
        clear + around - next.distance(other) >= 2.0 * needed.min(around)
    };
    (clear >= needed && meets(before) && meets(after)).then_some(next)
}

/// Unit direction in which the distance to matter grows; zero in the middle between walls.
fn away_from_matter(world: &World, point: DVec3, free: f64, step: f64) -> DVec3 {
    let far = free + 2.0 * step;
    let slope = |axis: DVec3| {
        (free_around(world, point + axis * step, far) - free_around(world, point - axis * step, far)) / (2.0 * step)
    };
    let gradient = DVec3::new(slope(DVec3::X), slope(DVec3::Y), slope(DVec3::Z));
    gradient.clamp_length_max(1.0)
}

//! Straight ways through free space.

use glam::DVec3;

use crate::world::World;

/// Steps along one straight way at most.
const MAX_STEPS: usize = 400;

/// Whether a ball of radius `room` can go straight from `a` to `b`: it steps by what is free around it, so that every
/// point of the way lies in a ball known to be free. Ways with less than a hundredth of the room to spare count as blocked.
pub(super) fn is_clear(world: &World, a: DVec3, b: DVec3, room: f64) -> bool {
    let length = a.distance(b);
    let (mut at, least) = (0.0, 0.01 * room);
    for _ in 0..MAX_STEPS {
        let point = a.lerp(b, if length > 0.0 { (at / length).min(1.0) } else { 0.0 });
        // More than the way that is left need not be known.
        let free = free_around(world, point, room + length - at + least) - room;
        if free < least {
            return false;
        }
        at += free;
        if at >= length {
            return true;
        }
    }
    false
}

/// Distance from a point to matter, or `most` where that is less.
pub(super) fn free_around(world: &World, point: DVec3, most: f64) -> f64 {
    world.ellipsoids().nearest_within(point, most).map_or(most, |nearest| nearest.distance)
}

/// The corners of a way that are left when every stretch that is clear without them is straight. The ends keep what room
/// they have.
pub(super) fn pulled_tight(world: &World, way: &[DVec3], room: f64) -> Vec<DVec3> {
    let last = way.len() - 1;
    let needed = |i: usize, j: usize| if i == 0 || j == last { end_room(world, way, room) } else { room };
    let mut tight = vec![way[0]];
    let mut at = 0;
    while at < last {
        // Neighbors see each other; from there on in steps that double while they can and halve when not.
        let (mut next, mut step) = (at + 1, 1);
        while step > 0 {
            let probe = (next + step).min(last);
            let farther = probe > next && is_clear(world, way[at], way[probe], needed(at, probe));
            (next, step) = if farther { (probe, step * 2) } else { (next, step / 2) };
        }
        tight.push(way[next]);
        at = next;
    }
    tight
}

/// Room that is asked for next to the ends of a way: no more than they have themselves.
pub(super) fn end_room(world: &World, way: &[DVec3], room: f64) -> f64 {
    let ends = [way[0], way[way.len() - 1]];
    let free = ends.map(|end| free_around(world, end, 2.0 * room) * 0.98);
    free[0].min(free[1]).clamp(world.camera_radius, room)
}

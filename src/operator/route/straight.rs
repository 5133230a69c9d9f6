//! Straight lines through free space.

use glam::DVec3;

use crate::world::World;

/// Limit on the steps along one line.
const MAX_STEPS: usize = 400;

/// Whether a ball of radius `room` can move straight from `a` to `b`. Each step is as long as the free distance around
/// the ball (sphere tracing), so that balls known to be free cover the line. A line with less than a hundredth of
/// `room` to spare counts as blocked.
pub(super) fn is_clear(world: &World, a: DVec3, b: DVec3, room: f64) -> bool {
    let length = a.distance(b);
    let (mut at, least) = (0.0, 0.01 * room);
    for _ in 0..MAX_STEPS {
        let point = a.lerp(b, if length > 0.0 { (at / length).min(1.0) } else { 0.0 });
        // Distances beyond the rest of the line make no difference.
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

/// Distance from a point to matter, at most `most`.
pub(super) fn free_around(world: &World, point: DVec3, most: f64) -> f64 {
    world.ellipsoids().nearest_within(point, most).map_or(most, |nearest| nearest.distance)
}

/// The path without the points that a clear straight line can skip. The first and last line need only the room that the
/// ends have.
pub(super) fn shortened(world: &World, path: &[DVec3], room: f64) -> Vec<DVec3> {
    let last = path.len() - 1;
    let needed = |i: usize, j: usize| if i == 0 || j == last { end_room(world, path, room) } else { room };
    let mut short = vec![path[0]];
    let mut at = 0;
    while at < last {
        // Neighbors are connected. From there on the step doubles after a clear line and halves after a blocked one.
        let (mut next, mut step) = (at + 1, 1);
        while step > 0 {
            let probe = (next + step).min(last);
            let farther = probe > next && is_clear(world, path[at], path[probe], needed(at, probe));
            (next, step) = if farther { (probe, step * 2) } else { (next, step / 2) };
        }
        short.push(path[next]);
        at = next;
    }
    short
}

/// Room required next to the ends of a path: at most what the ends have themselves.
pub(super) fn end_room(world: &World, path: &[DVec3], room: f64) -> f64 {
    let ends = [path[0], path[path.len() - 1]];
    let free = ends.map(|end| free_around(world, end, 2.0 * room) * 0.98);
    free[0].min(free[1]).clamp(world.camera_radius, room)
}

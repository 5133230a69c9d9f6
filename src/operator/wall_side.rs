//! The side from which people see what stands against a wall.

use glam::DVec3;

use super::world::{Subject, World};

/// Distance behind a thing within which a wall counts as at its back, and the free space before it, over the height of a
/// standing person's eyes.
const AT_WALL: f64 = 0.16;
const FREE: f64 = 0.9;
/// Heights above a thing's middle, over half its height, at which what surrounds it is looked for.
const LEVELS: [f64; 3] = [-0.2, 0.3, 0.8];
/// Size of a thing over the height of a standing person's eyes below which it stands on something and not at a wall.
const LEAST_SIZE: f64 = 0.3;
/// Half the length of a thing over that height below which its sides are not told from its box.
const LEAST_BREADTH: f64 = 0.2;

/// Azimuth of the free side of a thing at a wall, seen from its middle; `None` of one that stands free, in a corner or in a
/// niche, and out of doors.
pub(super) fn wall_side(world: &World, subject: &Subject) -> Option<f64> {
    *subject.wall_side_rad.get_or_init(|| found(world, subject))
}

fn found(world: &World, subject: &Subject) -> Option<f64> {
    let up = world.frame.up;
    let [long, short] = subject.level_axes(up);
    let eye = world.eye_height();
    let foot = world.height_above_floor(subject.center) - subject.reach(up);
    // A guitar on its stand faces where it was turned to.
    let is_narrow = long.length() < LEAST_BREADTH * eye;
    if !world.is_indoor() || is_narrow || subject.radius < LEAST_SIZE * eye || foot > LEAST_SIZE * eye {
        return None;
    }
    let half_height = subject.reach(up);
    let free = |way: DVec3| {
        let from = |level: f64| subject.center + up * (level * half_height) + way * (subject.reach(way) + 0.02 * eye);
        let distance = |level: f64| world.hit_distance(from(level), way).unwrap_or(f64::INFINITY);
        LEVELS.map(distance)
    };
    let is_wall = |way: DVec3| free(way).iter().all(|distance| *distance < AT_WALL * eye);
    let is_open = |way: DVec3| free(way).iter().any(|distance| *distance > FREE * eye);
    let ways = [short, -short, long, -long].map(DVec3::normalize_or_zero);
    let walls: Vec<DVec3> = ways.iter().copied().filter(|way| is_wall(*way)).collect();
    // In a corner the long side is the front.
    let back = *walls.first()?;
    (!walls.contains(&-back) && is_open(-back)).then(|| world.frame.azimuth(-back))
}

//! The side from which people see what stands against a wall or hangs on it.

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
    let free = |way: DVec3| free_distances(world, subject, beside(world, subject, way), way);
    let is_wall = |way: DVec3| free(way).iter().all(|distance| *distance < AT_WALL * eye);
    let is_open = |way: DVec3| free(way).iter().any(|distance| *distance > FREE * eye);
    let ways = [short, -short, long, -long].map(DVec3::normalize_or_zero);
    let walls: Vec<DVec3> = ways.iter().copied().filter(|way| is_wall(*way)).collect();
    // In a corner the long side is the front.
    let back = *walls.first()?;
    (!walls.contains(&-back) && is_open(-back)).then(|| world.frame.azimuth(-back))
}

/// A point just beside a thing, at the height of its middle.
fn beside(world: &World, subject: &Subject, way: DVec3) -> DVec3 {
    subject.center + way * (subject.reach(way) + 0.02 * world.eye_height())
}

/// Distances that are free from a point beside a thing, at three of the thing's heights.
fn free_distances(world: &World, subject: &Subject, beside: DVec3, way: DVec3) -> [f64; 3] {
    let half_height = subject.reach(world.frame.up);
    let from = |level: f64| beside + world.frame.up * (level * half_height);
    LEVELS.map(|level| world.hit_distance(from(level), way).unwrap_or(f64::INFINITY))
}

/// What is free at two heights of three.
fn middle(mut distances: [f64; 3]) -> f64 {
    distances.sort_by(f64::total_cmp);
    distances[1]
}

/// Distance from the near side of a thing to the wall behind it, over the height of a standing person's eyes: a desk is as deep.
const BEHIND: f64 = 0.4;
/// Length of a box over its depth from which on its sides are those of the wall: that of a thing of some size, and of a small one
/// such as a picture.
const OBLONG: f64 = 1.3;
const FLAT: f64 = 3.0;
/// Free space before such a side, over that height.
const OPEN: f64 = 0.6;
/// Distances from a box at which it is told whether there is a room at that side, over that height.
const BEYOND: [f64; 3] = [0.08, 0.2, 0.4];

/// Azimuth from which a thing before a wall is seen square to that wall, whether it stands there, hangs there or lies on
/// something that does; `None` where there is no wall right behind it, or one at two sides.
pub(super) fn wall_behind(world: &World, subject: &Subject) -> Option<f64> {
    *subject.wall_behind_rad.get_or_init(|| {
        if !world.is_indoor() {
            return None;
        }
        let [long, short] = subject.level_axes(world.frame.up);
        let is_flat = long.length() > FLAT * short.length();
        let is_long = long.length() > OBLONG * short.length().max(LEAST_BREADTH * world.eye_height() / OBLONG);
        if is_flat || is_long {
            oblong_front(world, subject, short.try_normalize()?)
        } else {
            let bearer = || subject.bearer.and_then(|id| world.subject(id));
            // What stands on a sideboard is before the wall of that.
            let borne =
                || bearer().filter(|bearer| bearer.bearer.is_none()).and_then(|bearer| wall_behind(world, bearer));
            wall_side(world, subject).or_else(borne).or_else(|| wall_before(world, subject))
        }
    })
}

/// The open one of the two broad sides of a thing that has a wall, or nothing of the room, at the other one.
fn oblong_front(world: &World, subject: &Subject, short: DVec3) -> Option<f64> {
    let eye = world.eye_height();
    let free = |way: DVec3| {
        let at = |beyond: f64| subject.center + way * (subject.reach(way) + beyond * eye);
        let inside = BEYOND.into_iter().map(at).find(|point| world.in_capture_region(*point));
        inside.map_or(0.0, |beside| middle(free_distances(world, subject, beside, way)))
    };
    let [ahead, back] = [free(short), free(-short)];
    let (way, far, near) = if ahead > back { (short, ahead, back) } else { (-short, back, ahead) };
    (far > OPEN * eye && near < BEHIND * eye).then(|| world.frame.azimuth(way))
}

/// Directions around a thing in which the wall behind it is looked for, and how far beside one of them what is seen belongs to
/// the same wall, in directions.
const AROUND: usize = 48;
const BESIDE: usize = 6;
/// Distance from which the wall is seen over the height of a standing person's eyes, the heights over half the thing's own at
/// which it is, and the least number of points on it.
const BEFORE: f64 = 0.35;
const SEEN_LEVELS: [f64; 3] = [0.3, 1.2, 1.8];
const LEAST_HITS: usize = 12;
/// Mean deviation of what is seen from a plane, over that height, up to which it is a wall.
const UNEVEN: f64 = 0.03;
/// Angles beside the nearest direction at which the wall's own direction is looked for, steps of [`TURN_RAD`].
const TURNS: i32 = 9;
const TURN_RAD: f64 = 0.044;

/// Azimuth of the way out from the nearest wall around a compact thing.
fn wall_before(world: &World, subject: &Subject) -> Option<f64> {
    let frame = &world.frame;
    let (eye, half_height) = (world.eye_height(), subject.reach(frame.up));
    let way = |i: usize| frame.direction((i % AROUND) as f64 / AROUND as f64 * std::f64::consts::TAU);
    let free = |i: usize| middle(free_distances(world, subject, beside(world, subject, way(i)), way(i)));
    let gaps: Vec<f64> = (0..AROUND).map(free).collect();
    let back = (0..AROUND).min_by(|&a, &b| gaps[a].total_cmp(&gaps[b]))?;
    let gap = |turn: usize| gaps[(back + turn) % AROUND];
    let is_near = |turn: usize| gap(turn) < BEHIND * eye;
    if !is_near(0) || gap(AROUND / 2) < FREE * eye || is_near(AROUND / 4) || is_near(3 * AROUND / 4) {
        return None;
    }
    // The wall as somebody sees it who stands before the thing.
    let before = subject.center - way(back) * (subject.reach(way(back)) + BEFORE * eye);
    let seen = (back + AROUND - BESIDE..=back + AROUND + BESIDE).flat_map(|i| {
        let from = |level: f64| before + frame.up * (level * half_height);
        let hit = |level: &f64| world.hit_distance(from(*level), way(i)).map(|distance| way(i) * distance);
        SEEN_LEVELS.iter().filter_map(hit).collect::<Vec<_>>()
    });
    let points: Vec<DVec3> = seen.collect();
    if points.len() < LEAST_HITS {
        return None;
    }
    let uneven = |azimuth: f64| {
        let mut depths: Vec<f64> = points.iter().map(|point| point.dot(frame.direction(azimuth))).collect();
        depths.sort_by(f64::total_cmp);
        let middle = depths[depths.len() / 2];
        depths.iter().map(|depth| (depth - middle).abs().min(2.0 * UNEVEN * eye)).sum::<f64>() / depths.len() as f64
    };
    let near = frame.azimuth(way(back));
    let turned = (-TURNS..=TURNS).map(|turn| near + f64::from(turn) * TURN_RAD);
    let wall = turned.min_by(|a, b| uneven(*a).total_cmp(&uneven(*b)))?;
    (uneven(wall) < UNEVEN * eye).then_some(wall + std::f64::consts::PI)
}

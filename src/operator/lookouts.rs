//! Where people stand in a room and what they look at: the views of a shot that names no subject.
//!
//! Enters: an indoor scene and its objects. Leaves: lookouts, the best one first. A lookout is a place on free floor at
//! eye height with a heading, rated by the depth along it and the objects that it shows. Walls close by, matter close
//! before the lens and directions without any matter count against it. A person who shows somebody a room does the
//! same: back to a wall or a corner, along the longest line of sight.

use std::f64::consts::TAU;

use glam::DVec3;

use super::lookout::{Lookout, Thing};
use super::world::World;
use cinesplat_geometry::rotation;

/// Places along each side of the lattice on the floor.
const NUM_PLACES: usize = 17;
/// Headings at each place.
const NUM_HEADINGS: usize = 72;
/// Pitches of the rays of a heading, degrees.
const PITCHES_DEG: [f64; 5] = [-30.0, -17.0, -6.0, 4.0, 15.0];
/// Headings on either side of a lookout's that its picture shows: 35 degrees, the half width of a 40 degree lens at 16:9.
const HALF_WIDTH: usize = 7;
/// Headings on either side whose depth is that of the line of sight.
const HALF_SIGHT: usize = 1;
/// Distance below which a surface stands before the lens, over the scene size.
const NEAR_FRAC: f64 = 0.13;
/// Width of the margin around the core box in which the camera of a capture of one side of a room may have stood, over
/// the scene size.
const MARGIN_FRAC: f64 = 0.2;
/// Factor on the rating of a place without free floor below it: above furniture, or where no floor was captured.
const OFF_FLOOR: f64 = 0.6;
/// Free space around a lookout, in radii of the camera.
const FREE_RADII: f64 = 2.5;
/// Lookouts per scene.
const MAX_LOOKOUTS: usize = 12;
/// Least rating of a lookout, over the best one's.
const LEAST_OF_BEST: f64 = 0.72;

/// The lookouts of an indoor scene, the best one first; none of an outdoor scene, or where nobody can stand.
pub(super) fn lookouts(world: &World) -> &[Lookout] {
    world.lookouts.get_or_init(|| if world.is_indoor() { found(world) } else { Vec::new() })
}

/// Where somebody can stand in a room: free places at eye height from which the capture shows front faces; none outdoors.
///
/// The first caller finds them, on its own thread: a caller in a parallel search that waited for other threads here could
/// be handed a task that asks for them again.
pub(super) fn standing_places(world: &World) -> &[DVec3] {
    world.standing_places.get_or_init(|| if world.is_indoor() { places(world) } else { Vec::new() })
}

fn found(world: &World) -> Vec<Lookout> {
    let places = standing_places(world);
    let mut rated: Vec<Lookout> = places.iter().flat_map(|&eye| around(world, eye, &world.things)).collect();
    rated.sort_by(|a, b| b.rating.total_cmp(&a.rating));
    distinct(world, &rated)
}

/// The places, found anew.
fn places(world: &World) -> Vec<DVec3> {
    let (bounds, frame) = (&world.bounds, &world.frame);
    let eye = world.eye_height();
    let is_free = |p: &DVec3| {
        world.clearance(*p) > FREE_RADII * world.camera_radius
            && world.beyond_corner_frac(*p) <= 0.0
            && world.in_capture_region(*p)
            && world.sees_front_faces(*p)
    };
    let at = |i: usize| (i as f64 + 0.5) / NUM_PLACES as f64;
    let axis = frame.up.abs().max_position();
    let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
    let place = |i: usize| {
        let mut share = DVec3::splat(0.5);
        (share[a], share[b]) = (at(i / NUM_PLACES), at(i % NUM_PLACES));
        let margin = DVec3::splat(MARGIN_FRAC * bounds.size());
        let at = (bounds.core_min - margin) + (bounds.core_max - bounds.core_min + 2.0 * margin) * share;
        at + frame.up * (eye - world.height_above_floor(at))
    };
    (0..NUM_PLACES * NUM_PLACES).map(place).filter(is_free).collect()
}

/// What the rays of one heading meet.
#[derive(Default, Clone, Copy)]
struct Column {
    /// Distance to the first surface near eye height, over the scene size.
    depth: f64,
    /// Share of rays that meet nothing.
    void: f64,
    /// Share of rays that meet matter close before the lens.
    blocked: f64,
}

/// The lookouts at one place: the heading of best rating in each of twelve directions.
fn around(world: &World, eye: DVec3, things: &[Thing]) -> Vec<Lookout> {
    let azimuth = |i: usize| TAU * i as f64 / NUM_HEADINGS as f64;
    let columns: Vec<Column> = (0..NUM_HEADINGS).map(|i| column(world, eye, azimuth(i))).collect();
    let seen = visible(world, eye, things);
    let stands = world.hit_distance(eye, -world.frame.up).is_some_and(|below| below > 0.8 * world.eye_height());
    let factor = if stands { 1.0 } else { OFF_FLOOR };
    let rated = |i: usize| {
        let lookout = rated(world, (eye, azimuth(i)), &window(&columns, i), &seen);
        Lookout { rating: factor * lookout.rating, ..lookout }
    };
    let best_of = |sector: usize| {
        let width = NUM_HEADINGS / 12;
        (sector * width..(sector + 1) * width).map(rated).max_by(|a, b| a.rating.total_cmp(&b.rating))
    };
    (0..12).filter_map(best_of).collect()
}

fn column(world: &World, eye: DVec3, azimuth_rad: f64) -> Column {
    let size = world.bounds.size();
    let mut out = Column::default();
    let share = 1.0 / PITCHES_DEG.len() as f64;
    for pitch in PITCHES_DEG.map(f64::to_radians) {
        let ray = world.frame.direction(azimuth_rad) * pitch.cos() + world.frame.up * pitch.sin();
        match world.hit_distance(eye, ray) {
            None => out.void += share,
            Some(distance) => {
                out.blocked += if distance < NEAR_FRAC * size { share } else { 0.0 };
                if pitch.abs() < 0.15 {
                    out.depth = out.depth.max(distance / size);
                }
            }
        }
    }
    out
}

/// The columns that the picture of a heading shows, and the depth of its line of sight in `depth`.
fn window(columns: &[Column], heading: usize) -> Column {
    let at = |offset: usize, half: usize| columns[(heading + NUM_HEADINGS + offset - half) % NUM_HEADINGS];
    let count = (2 * HALF_WIDTH + 1) as f64;
    let mut out = Column { depth: f64::INFINITY, ..Column::default() };
    for offset in 0..=2 * HALF_WIDTH {
        let column = at(offset, HALF_WIDTH);
        out.void += column.void / count;
        out.blocked += column.blocked / count;
    }
    for offset in 0..=2 * HALF_SIGHT {
        out.depth = out.depth.min(at(offset, HALF_SIGHT).depth);
    }
    out
}

/// The visible things with the share of a wide picture that each fills.
fn visible(world: &World, eye: DVec3, things: &[Thing]) -> Vec<(DVec3, f64)> {
    let is_seen = |thing: &&Thing| {
        let way = thing.center - eye;
        let length = way.length();
        let first = world.hit_distance(eye, way / length.max(1e-9)).unwrap_or(f64::INFINITY);
        length > 1.5 * thing.radius && first >= length - 1.2 * thing.radius
    };
    // A thing counts by its radius on the picture, but a large or near one does not outweigh five others.
    let share = |thing: &Thing| (thing.radius / thing.center.distance(eye)).min(0.25);
    things.iter().filter(is_seen).map(|thing| (thing.center, share(thing))).collect()
}

fn rated(world: &World, (eye, azimuth_rad): (DVec3, f64), view: &Column, seen: &[(DVec3, f64)]) -> Lookout {
    let frame = &world.frame;
    let off = |center: DVec3| rotation::short_turn(frame.azimuth(center - eye) - azimuth_rad).abs();
    // Full weight in the middle half of the picture, none at its edge.
    let weight = |center: DVec3| (2.0 - off(center) / 0.3).clamp(0.0, 1.0);
    let content: f64 = seen.iter().map(|&(center, share)| share * weight(center)).sum();
    let spoilt = (1.0 - 2.5 * view.void).max(0.02) * (1.0 - 1.6 * view.blocked).max(0.05);
    let rating = (view.depth.min(0.8) + 0.35 * content) * spoilt;
    Lookout { eye, azimuth_rad, depth: view.depth * world.bounds.size(), rating }
}

/// The first lookouts that differ in place or heading and are nearly as good as the best.
fn distinct(world: &World, rated: &[Lookout]) -> Vec<Lookout> {
    let mut kept: Vec<Lookout> = Vec::new();
    let least = rated.first().map_or(0.0, |best| LEAST_OF_BEST * best.rating);
    for &lookout in rated.iter().take_while(|lookout| lookout.rating >= least) {
        let alike = |other: &Lookout| {
            rotation::short_turn(lookout.azimuth_rad - other.azimuth_rad).abs() < 0.3
                && lookout.eye.distance(other.eye) < 0.15 * world.bounds.size()
        };
        if kept.len() < MAX_LOOKOUTS && !kept.iter().any(alike) {
            kept.push(lookout);
        }
    }
    kept
}

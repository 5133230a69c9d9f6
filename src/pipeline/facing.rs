//! The side that seats and screens face in a room: a chair away from its back, a monitor to the chair before it.
//!
//! Enters: the named objects of a scene and its Gaussians. Leaves: a level direction for each that has one.

use cinesplat_language::{Relation, Things, tokenize};
use cinesplat_objects::{Object, ObjectSet};
use cinesplat_operator::World;
use cinesplat_scene::{Gaussians, SOLID_OPACITY};
use glam::DVec3;

/// Seats that have a back, and what has a screen, as nouns.
const SEATS: [&str; 4] = ["armchair", "sofa", "chair", "office chair"];
const SCREENS: [&str; 3] = ["monitor", "laptop", "computer"];
/// Least number of Gaussians from which a back is told.
const LEAST_GAUSSIANS: usize = 60;
/// Shares of a seat's height below which its seat is, and above which its back.
const SEAT_TO: f64 = 0.55;
const BACK_FROM: f64 = 0.7;
/// Least distance of the back from the seat, over the seat's half breadth.
const LEAST_OFF: f64 = 0.2;
/// Farthest distance of a screen from the seat before it, over the seat's height.
const NEAR_SEAT: f64 = 1.6;

/// Says in a world which way its seats and screens face.
pub(super) fn face_people(gaussians: &Gaussians, objects: &ObjectSet, ids: &[u32], world: &mut World) {
    for object in objects.objects.iter().filter(|object| ids.contains(&object.id)) {
        let facing = if is_called(object, &SEATS) {
            away_from_back(gaussians, objects, object, world.frame.up)
        } else if is_called(object, &SCREENS) {
            toward_seat(objects, object, world.frame.up)
        } else {
            None
        };
        if let Some(direction) = facing {
            world.set_facing(object.id, direction);
        }
    }
}

/// Whether a word of an object's label is one of these, or the label another name for it.
fn is_called(object: &Object, nouns: &[&str]) -> bool {
    let same = |noun: &&str| Things::embedded().is_related(&object.label, noun, &[Relation::Same]);
    let has = |noun: &&str| tokenize(&object.label).iter().any(|word| word.text == **noun);
    nouns.iter().any(|noun| same(noun) || has(noun))
}

/// The way from the back of a seat to the front, along a side of its box where it has one there.
fn away_from_back(gaussians: &Gaussians, objects: &ObjectSet, seat: &Object, up: DVec3) -> Option<DVec3> {
    let [low, high] = seat.span_along(up);
    let labels = objects.labels_of(seat.id);
    let owns = seat.owns(&labels, 0.0);
    let solid = (0..gaussians.len()).filter(|&i| gaussians.opacities[i] >= SOLID_OPACITY);
    let means: Vec<DVec3> =
        solid.map(|i| (i, gaussians.mean_world(i))).filter(|(i, at)| owns(*i, *at)).map(|(_, at)| at).collect();
    if means.len() < LEAST_GAUSSIANS {
        return None;
    }
    let share = |at: &DVec3| (at.dot(up) - low) / (high - low).max(1e-9);
    let level = |picked: Vec<&DVec3>| -> Option<DVec3> {
        let middle = picked.iter().copied().sum::<DVec3>() / picked.len().max(1) as f64;
        (!picked.is_empty()).then_some(middle - up * middle.dot(up))
    };
    let seated = level(means.iter().filter(|at| share(at) < SEAT_TO).collect())?;
    let back = level(means.iter().filter(|at| share(at) > BACK_FROM).collect())?;
    let ahead = seated - back;
    let breadth = level_axes(seat, up).iter().map(|axis| axis.length()).fold(f64::INFINITY, f64::min);
    (ahead.length() > LEAST_OFF * breadth).then(|| along_side(seat, up, ahead))
}

/// The way from a screen to the nearest seat before it.
fn toward_seat(objects: &ObjectSet, screen: &Object, up: DVec3) -> Option<DVec3> {
    let level = |way: DVec3| way - up * way.dot(up);
    let seats = objects.objects.iter().filter(|seat| is_called(seat, &SEATS) || is_called(seat, &["stool"]));
    let near = seats.filter_map(|seat| {
        let [low, high] = seat.span_along(up);
        let way = level(seat.center - screen.center);
        (way.length() < NEAR_SEAT * (high - low)).then_some(way)
    });
    let way = near.min_by(|a, b| a.length().total_cmp(&b.length()))?;
    Some(along_side(screen, up, way))
}

/// The horizontal axes of an object's box, half extents along them.
fn level_axes(object: &Object, up: DVec3) -> Vec<DVec3> {
    let axes = object.half_axes();
    let upright = axes.iter().enumerate().max_by(|a, b| upness(a.1, up).total_cmp(&upness(b.1, up)));
    let upright = upright.map_or(0, |(nth, _)| nth);
    axes.into_iter().enumerate().filter(|(nth, _)| *nth != upright).map(|(_, axis)| axis - up * axis.dot(up)).collect()
}

fn upness(axis: &DVec3, up: DVec3) -> f64 {
    axis.normalize_or_zero().dot(up).abs()
}

/// A direction turned to the nearest side of a box, where one is within 30 degrees of it.
fn along_side(object: &Object, up: DVec3, way: DVec3) -> DVec3 {
    let way = way.normalize_or_zero();
    let sides = level_axes(object, up).into_iter().flat_map(|axis| [axis, -axis]).map(DVec3::normalize_or_zero);
    let nearest = sides.max_by(|a, b| a.dot(way).total_cmp(&b.dot(way)));
    nearest.filter(|side| side.dot(way) > SIDE_COS).unwrap_or(way)
}

/// Cosine of 30 degrees.
const SIDE_COS: f64 = 0.866;

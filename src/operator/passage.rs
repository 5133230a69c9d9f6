//! How a path passes an object, measured on the line through its samples.

use glam::DVec3;

use super::composition::off_side_deg;
use super::program::{Pass, SubjectSide};
use super::world::{Subject, World};
use cinesplat_geometry::rotation;
use cinesplat_trajectory::CameraState;

/// Largest angle about the object from the middle of its far or near side, degrees.
const SIDE_DEG: f64 = 60.0;
/// Largest distance of the camera from the object's box beside or behind it, over the scene size.
const BESIDE_FRAC: f64 = 0.3;
/// Least share of an object's length along which the camera travels.
const ALONG_FRAC: f64 = 0.8;
/// Largest distance from the box of an object of a camera that stands at it, over the scene size.
pub(super) const STANDING_FRAC: f64 = 0.15;
/// Points per interval between two samples.
const POINTS_PER_INTERVAL: usize = 8;

/// The measured value of a passage and its allowed range; `None` for an unknown object and for `Between` and `Over`, which other
/// constraints measure.
///
/// - `Under`: where the path is nearest to the upright axis through the box, height of the box's bottom above the
///   camera. NaN where the path never is above or below the box.
/// - `Through`: the least over the path of the largest coordinate in the box's axes over its half extents: inside the box
///   at most 1.
/// - `Behind`, `Front`: the least angle about the object's center between the camera and the middle of its back or front
///   ([`SubjectSide`]), over the points of the path next to the box and outside it.
/// - `From`: distance of the first camera from the box, which counts as reaching up to eye height, over the scene size.
/// - `Past`: level distance of the path from the object's center where it is abeam, over the scene size; larger where the path ends
///   before it or begins behind it.
/// - `Along`: share of the box's longer horizontal axis that the path beside the box covers.
pub(super) fn passage(world: &World, how: Pass, id: u32, states: &[CameraState]) -> Option<(f64, (f64, f64))> {
    let subject = world.subject(id)?;
    let path = points(states);
    match how {
        Pass::Under => Some((under(world, subject, states), (0.0, f64::INFINITY))),
        Pass::Through => Some((through(subject, states), (0.0, 1.0))),
        Pass::Behind => Some((side_deg(world, subject, &path, SubjectSide::FromBack), (0.0, SIDE_DEG))),
        Pass::Front => Some((side_deg(world, subject, &path, SubjectSide::FromFront), (0.0, SIDE_DEG))),
        Pass::Along => Some((covered(world, subject, &path), (ALONG_FRAC, f64::INFINITY))),
        Pass::From => Some((apart_frac(world, subject, states[0].pose.position), (0.0, STANDING_FRAC))),
        Pass::Past => Some((past_frac(world, subject, states), (0.0, BESIDE_FRAC))),
        Pass::Between | Pass::Over => None,
    }
}

/// Weight of what a path lacks to have an object abeam, over that of its distance there: a way that ends before a thing is not one past it.
const LACKING: f64 = 6.0;

/// Level distance of a path from an object at the point that has it abeam, over the scene size; farther by what the path lacks to have
/// it abeam.
fn past_frac(world: &World, subject: &Subject, states: &[CameraState]) -> f64 {
    let level = |state: &CameraState| world.frame.horizontal(subject.center - state.pose.position);
    let (first, last) = (level(&states[0]), level(&states[states.len() - 1]));
    let Some(way) = (first - last).try_normalize() else { return f64::INFINITY };
    // Before the way sets out the object lies ahead, at its end abeam or behind.
    let lacking = (-first.dot(way)).max(last.dot(way)).max(0.0);
    let abeam = states.iter().min_by(|a, b| level(a).dot(way).abs().total_cmp(&level(b).dot(way).abs()));
    let beside = abeam.map_or(0.0, |state| level(state).reject_from(way).length());
    (beside + LACKING * lacking) / world.bounds.size()
}

/// Distance of a point from an object's box, which counts as reaching up to eye height, over the scene size.
fn apart_frac(world: &World, subject: &Subject, point: DVec3) -> f64 {
    let spare = world.eye_height() - world.height_above_floor(subject.center) - subject.reach(world.frame.up);
    let above = world.height_above_floor(point) - world.height_above_floor(subject.center);
    let lowered = point - world.frame.up * spare.min(above).max(0.0);
    let at = subject.in_box(lowered);
    let nearest: DVec3 = (0..3).map(|i| subject.half_axes[i] * at[i].clamp(-1.0, 1.0)).sum();
    lowered.distance(subject.center + nearest) / world.bounds.size()
}

/// Points along the path: the samples and evenly spaced points between them.
fn points(states: &[CameraState]) -> Vec<DVec3> {
    let between = |pair: &[CameraState]| {
        let (a, b) = (pair[0].pose.position, pair[1].pose.position);
        (0..POINTS_PER_INTERVAL).map(move |i| a.lerp(b, i as f64 / POINTS_PER_INTERVAL as f64))
    };
    states.windows(2).flat_map(between).chain(states.last().map(|s| s.pose.position)).collect()
}

/// The point of the path at which a convex function of the position is least, and its value.
fn least(states: &[CameraState], value: impl Fn(DVec3) -> f64) -> (DVec3, f64) {
    let mut best = (states[0].pose.position, f64::INFINITY);
    for pair in states.windows(2) {
        let at = |t: f64| pair[0].pose.position.lerp(pair[1].pose.position, t);
        let (mut low, mut high) = (0.0, 1.0);
        // Ternary search: 30 steps narrow the interval to 5e-6 of itself.
        for _ in 0..30 {
            let (a, b) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
            if value(at(a)) <= value(at(b)) { high = b } else { low = a }
        }
        let point = at(f64::midpoint(low, high));
        if value(point) < best.1 {
            best = (point, value(point));
        }
    }
    best
}

fn under(world: &World, subject: &Subject, states: &[CameraState]) -> f64 {
    let up = world.frame.up;
    let upright = subject.axis_along(up);
    let beside = |point: DVec3| {
        let mut at = subject.in_box(point).abs();
        at[upright] = 0.0;
        at.max_element()
    };
    let (point, off) = least(states, beside);
    if off > 1.0 {
        return f64::NAN;
    }
    world.frame.height(subject.center) - subject.reach(up) - world.frame.height(point)
}

fn through(subject: &Subject, states: &[CameraState]) -> f64 {
    least(states, |point| subject.in_box(point).abs().max_element()).1
}

fn side_deg(world: &World, subject: &Subject, path: &[DVec3], side: SubjectSide) -> f64 {
    let near = |p: &&DVec3| is_beside(world, subject, **p);
    let off = |p: &DVec3| off_side_deg(world, subject.center, *p, side);
    path.iter().filter(near).map(off).fold(f64::INFINITY, f64::min)
}

/// Whether a point is outside the box and next to it.
fn is_beside(world: &World, subject: &Subject, point: DVec3) -> bool {
    let at = subject.in_box(point);
    let nearest: DVec3 = (0..3).map(|i| subject.half_axes[i] * at[i].clamp(-1.0, 1.0)).sum();
    let distance = point.distance(subject.center + nearest);
    at.abs().max_element() > 1.0 && distance <= BESIDE_FRAC * world.bounds.size()
}

fn covered(world: &World, subject: &Subject, path: &[DVec3]) -> f64 {
    let long = subject.level_axes(world.frame.up)[0];
    let along = |p: &DVec3| ((*p - subject.center).dot(long) / long.length_squared().max(1e-18)).clamp(-1.0, 1.0);
    let near = |p: &&DVec3| is_beside(world, subject, **p);
    let (low, high) = path
        .iter()
        .filter(near)
        .map(along)
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), at| (low.min(at), high.max(at)));
    ((high - low) / 2.0).max(0.0)
}

/// Points from `a` to `b` around the upright axis through a subject: azimuth, distance and height change evenly, so that
/// the path does not cross a box that both ends are outside of. Neither end is included.
pub(super) fn around(world: &World, subject: &Subject, a: DVec3, b: DVec3) -> Vec<DVec3> {
    let frame = &world.frame;
    let polar = |p: DVec3| {
        let away = p - subject.center;
        (frame.azimuth(away), frame.horizontal(away).length(), frame.height(away))
    };
    let (from, to) = (polar(a), polar(b));
    let turn = rotation::short_turn(to.0 - from.0);
    let count = (turn.abs() / MAX_TURN_RAD).ceil() as usize;
    let at = |i: usize| {
        let t = i as f64 / count as f64;
        let radius = from.1 + (to.1 - from.1) * t;
        let height = from.2 + (to.2 - from.2) * t;
        subject.center + frame.direction(from.0 + turn * t) * radius + frame.up * height
    };
    (1..count).map(at).collect()
}

/// Largest turn about an object between two points of a path around it.
const MAX_TURN_RAD: f64 = 0.7;

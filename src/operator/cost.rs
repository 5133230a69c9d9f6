//! The cost of a motion segment: violated constraints, clearance, the captured region, and the quality of the pictures.

use glam::DVec3;

use super::captured_side::side_cost;
use super::clearance::{ClearanceQuery, least_clearance};
use super::constraint::{Constraint, ConstraintKind};
use super::contents::contents_cost;
use super::crowding::{crowding_cost, heap_cost, screened_cost};
use super::framing_cost::framing_cost;
use super::measure::{SEARCH_POINTS, measure};
use super::motion::{MotionSegment, StepLabels, keyframes};
use super::pictures::{pictures_cost, under_furniture_cost};
use super::posture::posture_cost;
use super::underside::underside_cost;
use super::vertigo::vertigo_cost;
use super::world::World;
use cinesplat_geometry::sphere_directions;
use cinesplat_trajectory::{CameraPath, CameraState, Easing};

/// Limit on the path intervals that branch and bound examines per candidate.
const SEARCH_INTERVALS: usize = 400;

/// Cost above which a segment cannot win, so that the expensive terms are skipped.
const REJECT_COST: f64 = 9.0;

/// Cost of a segment; costs add up over a film. It is between 0 and 3 where every constraint is met, and above 3 where
/// one is violated. Cheap terms are evaluated first: above [`REJECT_COST`] a constant replaces the others. The
/// director's camera, where given, attracts the first state.
pub(super) fn cost(world: &World, segment: &MotionSegment, suggestion: Option<&CameraState>) -> f64 {
    let path = path_of(world, segment);
    let states = sampled(&path, segment, if segment.states.len() > 2 { 11 } else { 9 });
    let charge = |constraint: &Constraint| charge_of(measure(world, constraint, &states, SEARCH_POINTS).violation);
    let is_expensive = |constraint: &&Constraint| {
        matches!(constraint.kind, ConstraintKind::Unoccluded(..) | ConstraintKind::Unseen(..))
    };
    let (expensive, cheap): (Vec<&Constraint>, Vec<&Constraint>) = segment.constraints.iter().partition(is_expensive);
    let mut total: f64 = cheap.into_iter().map(charge).sum::<f64>() + clearance_cost(world, &path);
    if total > REJECT_COST {
        return total + REJECT_COST + outside_cost(world, &states);
    }
    total += region_cost(world, &states) + under_furniture_cost(world, &segment.constraints, &states);
    if total > REJECT_COST {
        return total + REJECT_COST / 2.0;
    }
    let charge_hidden = |constraint: &Constraint| {
        // Of what must not be seen a few percent count.
        let finely = if matches!(constraint.kind, ConstraintKind::Unseen(..)) { 3 } else { 1 };
        let measured = measure(world, constraint, &states, finely * SEARCH_POINTS);
        if measured.violation > 0.0 || !matches!(constraint.kind, ConstraintKind::Unoccluded(..)) {
            return charge_of(measured.violation);
        }
        HIDDEN_COST * (1.0 - measured.value).clamp(0.0, 1.0)
    };
    total += expensive.into_iter().map(charge_hidden).sum::<f64>();
    total += side_cost(world, &segment.constraints, &states) + underside_cost(world, &segment.constraints, &states);
    total += aside_cost(world, &states) + framing_cost(world, segment, &states);
    total += posture_cost(world, segment, &states) + vertigo_cost(world, segment, &states);
    total += crowding_cost(world, segment, &states) + heap_cost(world, segment, &states);
    total += screened_cost(world, segment, &states);
    total += contents_cost(world, segment, &states);
    total += pictures_cost(world, &segment.constraints, &states);
    total + suggestion.map_or(0.0, |proposed| deviation(world, &states[0], proposed))
}

/// Cost of a subject that is hidden, over its hidden share, where enough of it is seen: something in front spoils a
/// picture before it hides half of it.
const HIDDEN_COST: f64 = 1.2;

/// Cost of a violation.
fn charge_of(violation: f64) -> f64 {
    if violation > 0.0 { 3.0 + 4.0 * violation.min(2.0) } else { 0.0 }
}

/// The path of a segment by itself.
pub(super) fn path_of(world: &World, segment: &MotionSegment) -> CameraPath {
    let alone = MotionSegment { cut: false, step: 0, ..segment.clone() };
    // Keyframes carry their move and pivot only where they have labels: empty ones do.
    CameraPath::coarse(keyframes(&[alone], &[StepLabels::default()]), world.frame)
}

/// Samples of a segment's path at even times.
pub(super) fn sampled(path: &CameraPath, segment: &MotionSegment, count: usize) -> Vec<CameraState> {
    (0..count).map(|i| path.sample(segment.secs * i as f64 / (count - 1) as f64)).collect()
}

/// The cameras of a segment at `count` points that divide its path evenly.
pub(super) fn evenly_spaced(world: &World, segment: &MotionSegment, count: usize) -> Vec<CameraState> {
    let even = MotionSegment { easing: Easing::Linear, ..segment.clone() };
    sampled(&path_of(world, &even), &even, count)
}

/// Cost of coming closer to matter than the camera's radius, at any moment.
fn clearance_cost(world: &World, path: &CameraPath) -> f64 {
    let radius = world.camera_radius;
    let query = ClearanceQuery { enough: radius, tolerance: 0.1 * radius, max_intervals: SEARCH_INTERVALS };
    let short = 1.0 - least_clearance(world.ellipsoids(), path, &query).bound / radius;
    if short > 0.0 { 6.0 + 6.0 * short } else { 0.0 }
}

/// Cost of positions from which the capture shows back faces, and a milder one of positions far outside the scene's
/// core box.
fn region_cost(world: &World, states: &[CameraState]) -> f64 {
    let position = |state: &CameraState| state.pose.position;
    let most = |frac: fn(&World, DVec3) -> f64| states.iter().map(|s| frac(world, position(s))).fold(0.0, f64::max);
    let sunk = most(World::sunk_frac);
    let beyond_room = if sunk > 0.0 { sunk } else { most(World::beyond_corner_frac) };
    if beyond_room > 0.0 && world.is_indoor() {
        return LEFT_ROOM_COST + 20.0 * beyond_room.min(0.4) + outside_cost(world, states);
    }
    let uncaptured =
        states.iter().filter(|s| !world.in_capture_region(position(s))).count() as f64 / states.len() as f64;
    if uncaptured > 0.0 {
        let left = if world.is_indoor() { LEFT_ROOM_COST } else { 5.0 };
        return left + 8.0 * uncaptured + outside_cost(world, states);
    }
    let ends = [&states[0], &states[states.len() / 2], &states[states.len() - 1]];
    let wrong = ends.iter().filter(|s| !world.sees_front_faces(position(s))).count();
    let outside = most(|world, point| {
        let [level, upright] = world.outside_fracs(point);
        upright.max(level - OUTSIDE_FRAC)
    });
    let far = if world.is_indoor() { outside } else { sunk };
    3.0 * wrong as f64 + (8.0 * far).clamp(0.0, 2.0) + enclosed_cost(world, states)
}

/// Rays from a camera, and the share of them that meet matter from which on it is inside a lone thing: half of them do right before it.
const NUM_ENCLOSING: usize = 24;
const ENCLOSED_FRAC: f64 = 0.7;
/// Cost of ends of a segment that are inside a lone thing.
const ENCLOSED_COST: f64 = 6.0;

/// Cost of ends of a segment inside a lone thing: the inside of a skull was not captured.
fn enclosed_cost(world: &World, states: &[CameraState]) -> f64 {
    if world.is_indoor() {
        return 0.0;
    }
    let is_enclosed = |state: &&&CameraState| {
        let position = state.pose.position;
        let within = position.cmpge(world.bounds.core_min).all() && position.cmple(world.bounds.core_max).all();
        let meets = |ray: &DVec3| world.hit_distance(position, *ray).is_some();
        let met = || sphere_directions(NUM_ENCLOSING).iter().filter(|ray| meets(ray)).count();
        within && met() as f64 >= ENCLOSED_FRAC * NUM_ENCLOSING as f64
    };
    ENCLOSED_COST * [&states[0], &states[states.len() - 1]].iter().filter(is_enclosed).count() as f64
}

/// Level distance from the core box of a room, over the scene size, from which a camera in the captured region is far
/// outside: one wall of a room is captured from before it.
const OUTSIDE_FRAC: f64 = 0.25;
/// Cost of a segment that leaves the captured region of a room, under its floor or behind its walls: more than that of two
/// violated constraints, because nobody keeps a film of the backs of walls.
const LEFT_ROOM_COST: f64 = 24.0;
/// Cost of an end of a segment outside the captured region of a room.
const OUTSIDE_COST: f64 = 12.0;

/// Share of the scene's surfaces, over what the best place sees, below which a camera stands aside; cost of seeing none.
const LEAST_SEEN_FRAC: f64 = 0.6;
const ASIDE_COST: f64 = 2.0;

/// Cost of ends of a segment in a room from which little of it is in sight: behind a curtain or outside a window the
/// capture shows the backs of things.
fn aside_cost(world: &World, states: &[CameraState]) -> f64 {
    if !world.is_indoor() {
        return 0.0;
    }
    let lack = |point: DVec3| (1.0 - world.seen_of_best_frac(point) / LEAST_SEEN_FRAC).max(0.0);
    let [first, last] = [&states[0], &states[states.len() - 1]].map(|state| state.pose.position);
    // Many moves only turn.
    ASIDE_COST * if first == last { lack(first) } else { lack(first).max(lack(last)) }
}

/// Cost of the ends of a segment outside the captured region of a room, from where its walls are seen from behind: where
/// no camera meets all the words, the film still stays in the room.
fn outside_cost(world: &World, states: &[CameraState]) -> f64 {
    let ends = [&states[0], &states[states.len() - 1]];
    let is_outside = |state: &&&CameraState| {
        let position = state.pose.position;
        is_beyond_room(world, position) || !world.in_capture_region(position)
    };
    if world.is_indoor() { OUTSIDE_COST * ends.iter().filter(is_outside).count() as f64 } else { 0.0 }
}

/// Whether a point lies under the floor, or beyond a corner of the room.
fn is_beyond_room(world: &World, point: DVec3) -> bool {
    world.sunk_frac(point) > 0.0 || world.beyond_corner_frac(point) > 0.0
}

/// Share of the states inside the captured region, seeing front faces.
pub(super) fn captured_frac(world: &World, states: &[CameraState]) -> f64 {
    let good = |s: &&CameraState| {
        let p = s.pose.position;
        let inside = !(world.is_indoor() && is_beyond_room(world, p));
        world.in_capture_region(p) && world.sees_front_faces(p) && inside
    };
    states.iter().filter(good).count() as f64 / states.len() as f64
}

/// Distance of the first view from the camera that the director proposes, as a tie breaker.
fn deviation(world: &World, state: &CameraState, proposed: &CameraState) -> f64 {
    let apart = state.pose.position.distance(proposed.pose.position) / world.bounds.size();
    let turned = state.pose.forward().angle_between(proposed.pose.forward());
    0.2 * apart.min(1.0) + 0.1 * turned
}

//! Things that stand before a subject or touch it in the picture: the leg of a bench, the back of a chair, a hanging lamp.
//!
//! A subject of which nine tenths are seen still reads badly with something dark across its edge. Rays over the part of the
//! picture that the subject takes, and a margin about it, tell how much of that belongs to nearer matter.

use glam::DVec2;

use super::constraint::{Constraint, ConstraintKind, Scope};
use super::framing::{MANY, frame_bounds, frame_ray};
use super::motion::MotionSegment;
use super::world::{Subject, World};
use cinesplat_trajectory::{CameraState, Move};

/// Cost of a subject before which all of its part of the picture is taken. It grows with the root of the share: a lamp before
/// the middle of a table spoils the picture, and hides little of it.
const CROWDED_COST: f64 = 1.35;
/// Columns and rows of rays over a subject's part of the picture.
const RAYS: (u32, u32) = (5, 4);
/// Margins about a subject that should be free, over its width to the sides and over its height above it. Below it is what
/// it stands on, which is nearer than its foot: that part of its height is left out. A ray beside it counts by half.
const BESIDE: f64 = 0.12;
const ABOVE: f64 = 0.1;
const FOOT: f64 = 0.2;
const BESIDE_WEIGHT: f64 = 0.5;
/// Distance before the nearest corner of a subject's box from which matter stands before it, over the scene size.
const BEFORE_FRAC: f64 = 0.02;
/// Radius of a subject over the scene size from which it is part of the room, which things always stand before.
pub(super) const LARGE_FRAC: f64 = 0.22;
/// Height over breadth below which a subject is flat.
const FLAT: f64 = 0.2;

/// Cost of what stands before the subjects that a segment has to show, where no words ask for a foreground.
pub(super) fn crowding_cost(world: &World, segment: &MotionSegment, states: &[CameraState]) -> f64 {
    if segment.is_join || !world.is_indoor() || segment.constraints.iter().any(asks_foreground) {
        return 0.0;
    }
    let ends = [states[0], states[states.len() / 2], states[states.len() - 1]];
    let stands = ends[0] == ends[1] && ends[0] == ends[2];
    let crowded = |constraint: &Constraint| {
        let Some(subject) = constraint.shown(world).filter(|subject| stands_free(world, subject)) else { return 0.0 };
        let picked = if stands { &ends[..1] } else { constraint.scope.of(&ends) };
        let shares: Vec<f64> = picked.iter().map(|state| crowded_frac(world, state, subject)).collect();
        let mean = shares.iter().sum::<f64>() / shares.len() as f64;
        shares.into_iter().fold(0.0, f64::max).midpoint(mean).sqrt()
    };
    // Each by itself: what hides the one whatever the camera does is no reason to hide the other.
    CROWDED_COST * segment.constraints.iter().map(crowded).sum::<f64>()
}

/// Whether a subject is neither part of the room nor a rug: on and before those there are always things.
pub(super) fn stands_free(world: &World, subject: &Subject) -> bool {
    let [_, short] = subject.level_axes(world.frame.up);
    let is_flat = subject.reach(world.frame.up) < FLAT * short.length();
    subject.radius < LARGE_FRAC * world.bounds.size() && !is_flat
}

/// Whether a constraint asks for matter before the lens or before a subject.
fn asks_foreground(constraint: &Constraint) -> bool {
    matches!(constraint.kind, ConstraintKind::Foreground(..) | ConstraintKind::Passed(..) | ConstraintKind::Unseen(..))
}

/// Share of a subject's part of a picture, and of a margin about it, that nearer matter takes; 0 for a subject behind the
/// camera.
fn crowded_frac(world: &World, state: &CameraState, subject: &Subject) -> f64 {
    let Some(([box_low, box_high], near)) = frame_bounds(world, state, &subject.corners) else { return 0.0 };
    let size = box_high - box_low;
    let (low, high) = (box_low + size * DVec2::new(-BESIDE, FOOT), box_high + size * DVec2::new(BESIDE, ABOVE));
    // What a table bears is part of its picture.
    let borne = subject.borne_heights.map_or(0.0, |[surface, highest]| highest - surface);
    let before = near - BEFORE_FRAC * world.bounds.size() - borne;
    let (mut framed, mut taken) = (0.0_f64, 0.0);
    for at in places(low, high) {
        if at.abs().max_element() > 0.5 {
            continue;
        }
        let is_over = at.cmpge(box_low).all() && at.cmple(box_high).all();
        let weight = if is_over { 1.0 } else { BESIDE_WEIGHT };
        framed += weight;
        taken += if depth_at(world, state, at).is_some_and(|depth| depth < before) { weight } else { 0.0 };
    }
    if framed > 0.0 { taken / framed } else { 0.0 }
}

/// Places of the frame in columns and rows over a part of it, from its lower left to its upper right corner.
fn places(low: DVec2, high: DVec2) -> impl Iterator<Item = DVec2> {
    let share = |i: u32, count: u32| (f64::from(i) + 0.5) / f64::from(count);
    let rays = (0..RAYS.0).flat_map(|column| (0..RAYS.1).map(move |row| (column, row)));
    rays.map(move |(column, row)| low + (high - low) * DVec2::new(share(column, RAYS.0), share(row, RAYS.1)))
}

/// Depth of the first matter at a place of the frame.
fn depth_at(world: &World, state: &CameraState, at: DVec2) -> Option<f64> {
    let ray = frame_ray(world, state, at);
    let (length, ray) = (ray.length(), state.pose.rotation * ray.normalize());
    world.hit_distance(state.pose.position, ray).map(|distance| distance / length)
}

/// Cost of a slide from one thing to another behind things that take all of the picture on the way, and the share of it that
/// they may take: something that passes before the lens gives depth.
const SCREENED_COST: f64 = 1.6;
const FREE_SHARE: f64 = 0.1;
/// Depth of what is in the way, over that of what the camera slides along.
const IN_FRONT: f64 = 0.6;
/// Corners of the part of the picture in which it counts, from its middle: to the sides and above; below it is what the things stand
/// on.
const SCREEN: [DVec2; 2] = [DVec2::new(-0.4, -0.1), DVec2::new(0.4, 0.35)];

/// Cost of what stands between the camera and the way along which it slides from one thing to another.
pub(super) fn screened_cost(world: &World, segment: &MotionSegment, states: &[CameraState]) -> f64 {
    let slides = matches!(segment.movement, Move::TruckLeft | Move::TruckRight);
    if !slides || segment.is_join || !world.is_indoor() || segment.constraints.iter().any(asks_foreground) {
        return 0.0;
    }
    let centered = |scope: Scope| {
        segment.constraints.iter().find_map(|constraint| match &constraint.kind {
            ConstraintKind::Centered(target, _) if constraint.scope == scope => Some(target.aim),
            _ => None,
        })
    };
    let (Some(from), Some(to)) = (centered(Scope::Start), centered(Scope::End)) else { return 0.0 };
    let last = states.len() - 1;
    let taken = |nth: usize| {
        let state = &states[nth];
        let way = from.lerp(to, nth as f64 / last as f64);
        let most = IN_FRONT * (way - state.pose.position).dot(state.pose.forward());
        let is_hit = |at: &DVec2| depth_at(world, state, *at).is_some_and(|depth| depth < most);
        let [low, high] = SCREEN;
        places(low, high).filter(is_hit).count() as f64 / f64::from(RAYS.0 * RAYS.1)
    };
    let moments: Vec<usize> = (1..last).step_by(2).collect();
    let mean = moments.iter().map(|nth| taken(*nth)).sum::<f64>() / moments.len().max(1) as f64;
    SCREENED_COST * (mean - FREE_SHARE).max(0.0) / (1.0 - FREE_SHARE)
}

/// Cost of many things of which all hide one another in the last picture.
const HEAP_COST: f64 = 1.4;

/// Cost of a picture of many things that overlap: each should be told from its neighbors.
pub(super) fn heap_cost(world: &World, segment: &MotionSegment, states: &[CameraState]) -> f64 {
    let held = segment.constraints.iter().filter(|constraint| constraint.scope.covers(Scope::End));
    let overlap = held.filter_map(|constraint| match &constraint.kind {
        ConstraintKind::InFrame(ids, _) if ids.len() >= MANY => Some(overlap_frac(world, states.last()?, ids)),
        _ => None,
    });
    HEAP_COST * overlap.fold(0.0, f64::max)
}

/// Share of the parts of the picture that some things take which other ones of them take as well; the part of a thing is
/// the box about it.
fn overlap_frac(world: &World, state: &CameraState, ids: &[u32]) -> f64 {
    let part = |id: &u32| frame_bounds(world, state, &world.subject(*id)?.corners).map(|(bounds, _)| bounds);
    let parts: Vec<[DVec2; 2]> = ids.iter().filter_map(part).collect();
    let area = |[low, high]: [DVec2; 2]| (high - low).max(DVec2::ZERO).element_product();
    let common = |a: &[DVec2; 2], b: &[DVec2; 2]| area([a[0].max(b[0]), a[1].min(b[1])]);
    let total: f64 = parts.iter().map(|part| area(*part)).sum();
    let pairs = (0..parts.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
    let shared: f64 = pairs.map(|(i, j)| common(&parts[i], &parts[j])).sum();
    if total > 0.0 { (shared / total).min(1.0) } else { 0.0 }
}

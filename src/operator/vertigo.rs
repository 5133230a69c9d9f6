//! What makes a dolly zoom: a subject that keeps its size, and something far behind it. A wall at its back does not move.

use glam::DVec2;

use super::motion::MotionSegment;
use super::view::ramp;
use super::world::World;
use cinesplat_geometry::{Camera, Intrinsics};
use cinesplat_trajectory::{CameraState, Move};

/// Cost of a dolly zoom before a wall; share of the frame in which the background has to be far, and its distance over the
/// subject's, in the picture from nearer by.
const FLAT_COST: f64 = 1.0;
const LEAST_FAR: f64 = 0.5;
const FAR: f64 = 2.2;
/// Cost of a subject that swells: whose near side grows over its middle, which the lens keeps at its size; and the growth at
/// which it begins and is reached.
const SWOLLEN_COST: f64 = 1.2;
const SWELLING: (f64, f64) = (1.14, 1.3);
/// Cost of a dolly zoom in which the background hardly changes its size; factor of that size in the middle of the picture with which
/// nothing is missing, and with which all is.
const WEAK_COST: f64 = 0.8;
const CHANGE: (f64, f64) = (1.6, 1.15);
/// Columns and rows of rays.
const RAYS: (u32, u32) = (8, 5);

/// Cost of a dolly zoom that comes so close that its subject swells, or whose background is hardly farther away than that.
pub(super) fn vertigo_cost(world: &World, segment: &MotionSegment, states: &[CameraState]) -> f64 {
    // Of a lone thing the swelling is all that there is to see.
    if !matches!(segment.movement, Move::DollyZoomIn | Move::DollyZoomOut) || !world.is_indoor() {
        return 0.0;
    }
    let Some(subject) = segment.constraints.iter().find_map(|constraint| constraint.shown(world)) else { return 0.0 };
    let distance = |state: &CameraState| state.pose.position.distance(subject.center);
    let (first, last) = (&states[0], &states[states.len() - 1]);
    let (near, far) = if distance(first) < distance(last) { (first, last) } else { (last, first) };
    let reach = subject.reach(near.pose.forward());
    let growth = swelling(distance(near), reach) / swelling(distance(far), reach);
    let swollen = ramp(SWELLING, growth);
    let travel = [distance(near), distance(far)];
    let hits = background(world, near);
    SWOLLEN_COST * swollen + FLAT_COST * flat_frac(&hits, distance(near)) + WEAK_COST * weak_frac(&hits, travel)
}

/// By how much the near side of a subject, `reach` before its middle, is larger in the picture than its middle.
pub(super) fn swelling(distance: f64, reach: f64) -> f64 {
    distance / (distance - reach).max(1e-9)
}

/// How much weaker than it should be the change of the background is, 0..=1. `hits`: [`background`] of the nearer
/// picture; then the distances of the subject.
fn weak_frac(hits: &[f64], [nearer, farther]: [f64; 2]) -> f64 {
    let change = |hit: &f64| (hit / nearer) * farther / (hit + farther - nearer);
    let mut changes: Vec<f64> = hits.iter().filter(|hit| **hit > nearer).map(change).collect();
    changes.sort_by(f64::total_cmp);
    let typical = changes.get(changes.len() / 2).copied().unwrap_or(1.0);
    ramp(CHANGE, typical)
}

/// Distances of what the rays of a picture meet.
fn background(world: &World, state: &CameraState) -> Vec<f64> {
    let height = 90.0;
    let width = (height * world.aspect).round().max(1.0);
    let camera =
        Camera { pose: state.pose, intrinsics: Intrinsics::from_fov_y(width as u32, height as u32, state.fov_y_rad) };
    let at = |i: u32, count: u32| (f64::from(i) + 0.5) / f64::from(count);
    let rays = (0..RAYS.0).flat_map(|column| (0..RAYS.1).map(move |row| (column, row)));
    let hit = |(column, row)| {
        let pixel = DVec2::new(at(column, RAYS.0) * width, at(row, RAYS.1) * height);
        world.hit_distance(state.pose.position, camera.ray(pixel))
    };
    rays.filter_map(hit).collect()
}

/// How far the background of a picture is from filling its share of the frame, 0..=1.
fn flat_frac(hits: &[f64], distance: f64) -> f64 {
    let far = hits.iter().filter(|hit| **hit > FAR * distance).count() as f64 / f64::from(RAYS.0 * RAYS.1);
    (1.0 - far / LEAST_FAR).max(0.0)
}

//! Dolly zooms need something far behind their subject: a wall at its back does not move.

use glam::DVec2;

use super::motion::MotionSegment;
use super::world::World;
use cinesplat_geometry::{Camera, Intrinsics};
use cinesplat_trajectory::{CameraState, Move};

/// Cost of a dolly zoom before a wall; share of the frame in which the background has to be far, and its distance over the
/// subject's, in the picture from nearer by.
const FLAT_COST: f64 = 1.0;
const LEAST_FAR: f64 = 0.5;
const FAR: f64 = 2.2;
/// Columns and rows of rays.
const RAYS: (u32, u32) = (8, 5);

/// Cost of a dolly zoom whose background is hardly farther away than its subject.
pub(super) fn vertigo_cost(world: &World, segment: &MotionSegment, states: &[CameraState]) -> f64 {
    if !matches!(segment.movement, Move::DollyZoomIn | Move::DollyZoomOut) || !world.is_indoor() {
        return 0.0;
    }
    let Some(aim) = segment.constraints.iter().find_map(|constraint| constraint.shown(world)) else { return 0.0 };
    let distance = |state: &CameraState| state.pose.position.distance(aim.center);
    let (first, last) = (&states[0], &states[states.len() - 1]);
    let near = if distance(first) < distance(last) { first } else { last };
    let height = 90.0;
    let width = (height * world.aspect).round().max(1.0);
    let intrinsics = Intrinsics::from_fov_y(width as u32, height as u32, near.fov_y_rad);
    let camera = Camera { pose: near.pose, intrinsics };
    let at = |i: u32, count: u32| (f64::from(i) + 0.5) / f64::from(count);
    let rays = (0..RAYS.0).flat_map(|column| (0..RAYS.1).map(move |row| (column, row)));
    let is_far = |(column, row): &(u32, u32)| {
        let pixel = DVec2::new(at(*column, RAYS.0) * width, at(*row, RAYS.1) * height);
        let hit = world.hit_distance(near.pose.position, camera.ray(pixel));
        hit.is_some_and(|hit| hit > FAR * distance(near))
    };
    let far = rays.filter(is_far).count() as f64 / f64::from(RAYS.0 * RAYS.1);
    FLAT_COST * (1.0 - far / LEAST_FAR).max(0.0)
}

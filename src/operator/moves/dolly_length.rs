//! How far a push goes in and a pull-out backs off.

use glam::DVec3;

use super::context::StepContext;
use crate::framing::{Fill, Target, bearing_of, distance_for, extent_frac, in_frame_frac};
use crate::program::Amount;
use crate::view::{distance_along, fill_in, lerp, moved};
use crate::world::World;
use cinesplat_trajectory::{CameraState, Move, ShotSize};

/// Least distance at the end of a pull-out over that at its start.
pub(super) const LEAST_RATIO: f64 = 1.36;
/// Most: from a ring on a finger to the whole of a hall.
const MOST_RATIO: f64 = 50.0;
/// Ratio from which on a pull-out to the whole of something ends in the room.
const LONG_RATIO: f64 = 12.0;
/// How far outside the core of a room it may end, over the scene size: the wall may be there.
const OUTSIDE_FRAC: f64 = 0.1;
/// Distance of a camera from the wall behind it, over its radius.
pub(super) const WALL_RADII: f64 = 3.0;
/// Share of the frame that a lone thing fills at the end of a push toward it.
const LONE_END: (f64, f64) = (0.8, 0.94);

/// The same of a thing in a room, where the words name no size: what ends smaller is lost among the things around it.
const ROOM_END: (f64, f64) = (0.55, 0.88);
/// Distance ratio of a push that goes nearer than others for that at most.
const NEAREST_RATIO: f64 = 0.22;
/// Distance ratios of a push in a room whose end the words leave open.
const OPEN_RATIOS: (f64, f64) = (0.36, 0.56);
/// Largest size of a subject's splats over the frame's height to which a move brings it for that.
const SOFT_FRAC: f64 = 13.0 / 720.0;

/// Ratio of the distances, or of the tangents of half the fields of view, at which a thing in a room is large in the picture, as far
/// as its splats hold.
pub(super) fn large_ratio(context: &StepContext, target: &Target, first: &CameraState) -> f64 {
    let now = extent_frac(context.world, first, &target.corners).max_element();
    (now / lerp(ROOM_END, context.parameters[6])).max(soft_ratio(context, target, first))
}

/// The same ratio, beyond which a subject is only seen softer and not better.
fn soft_ratio(context: &StepContext, target: &Target, first: &CameraState) -> f64 {
    let subject = target.ids.first().and_then(|id| context.world.subject(*id));
    let reach = 2.0 * first.pose.position.distance(target.aim) * (first.fov_y_rad / 2.0).tan();
    subject.map_or(0.0, |subject| subject.splat_size / (reach * SOFT_FRAC))
}

/// Size in the picture, the larger of its shares of width and height, beyond which a way in whose end the words leave open goes
/// no farther.
const FULLEST: f64 = 0.9;
/// The same where a circle follows, which sees the subject from sides that may be broader.
const FULLEST_CIRCLED: f64 = 0.68;
/// Largest ratio at which a way in stops for that, or before other matter: one that a join takes part of is still a way in.
pub(super) const LARGEST_OPEN_RATIO: f64 = 0.66;

/// The ratio of the distances, or of the tangents of half the fields of view, beyond which the edges of the frame would cut a
/// subject that they need not.
pub(super) fn least_open_ratio(context: &StepContext, target: &Target, first: &CameraState) -> f64 {
    let now = extent_frac(context.world, first, &target.corners).max_element();
    let fullest = if context.is_circled_next { FULLEST_CIRCLED } else { FULLEST };
    (now / fullest).min(LARGEST_OPEN_RATIO)
}

/// The distance ratio of a push whose end the words leave open: a lone thing fills the picture at the end, and a small thing in a
/// room is large in it.
fn open_ratio(context: &StepContext, target: &Target, first: &CameraState) -> f64 {
    let open = lerp(OPEN_RATIOS, context.parameters[6]);
    if target.ids.is_empty() {
        return open;
    }
    if context.world.is_indoor() {
        let large = open.min(large_ratio(context, target, first).max(NEAREST_RATIO));
        return large.max(least_open_ratio(context, target, first));
    }
    let now = extent_frac(context.world, first, &target.corners).max_element();
    let filling = now / lerp(LONE_END, context.parameters[6]);
    if filling < 0.74 { filling.max(0.3) } else { open }
}

/// Distance at the end over that at the start.
pub(super) fn distance_ratio(context: &StepContext, target: &Target, first: &CameraState, inward: bool) -> f64 {
    let distance = first.pose.position.distance(target.aim);
    let open = if inward { open_ratio(context, target, first) } else { lerp((1.9, 3.3), context.parameters[6]) };
    let by_size = room_ratio(context, target, first).or_else(|| size_ratio(context, target, first));
    let by_whole = || whole_ratio(context, first, distance);
    let stated = match context.step.amount {
        Some(Amount::Factor(factor)) => Some(factor),
        Some(Amount::Units(units)) => Some(1.0 + if inward { -units / distance } else { units / distance }),
        Some(Amount::Slight) => Some(if inward { 0.82 } else { 1.25 }),
        Some(Amount::Large) => Some(if inward { 0.32 } else { 3.2 }),
        _ => None,
    };
    let ratio = stated.or(by_size).or_else(|| (!inward).then(by_whole).flatten()).unwrap_or(open);
    if inward { ratio.clamp(0.05, 0.97) } else { ratio.clamp(1.03, MOST_RATIO) }
}

/// Share of the free way behind a camera that a pull-out to the whole room goes.
const BACK_SHARE: (f64, f64) = (0.5, 0.95);

/// Distance ratio of a pull-out from a small thing to the room as a whole: as far back as the room goes. `None` for any
/// other way, and where that is no longer than one to a long shot.
fn room_ratio(context: &StepContext, target: &Target, first: &CameraState) -> Option<f64> {
    if !context.backs_to_room() {
        return None;
    }
    let world = context.world;
    let back = -first.pose.forward();
    // Where a room was captured from its open side, there is no wall behind the camera.
    let behind = world.hit_distance(first.pose.position, back).unwrap_or_else(|| captured_way(world, first, back));
    let free = behind - WALL_RADII * world.camera_radius;
    let distance = first.pose.position.distance(target.aim);
    let ratio = 1.0 + lerp(BACK_SHARE, context.parameters[6]) * free / distance;
    (ratio > size_ratio(context, target, first).unwrap_or(LEAST_RATIO)).then_some(ratio)
}

/// How far a camera can go in a direction and stays in the captured region.
fn captured_way(world: &World, first: &CameraState, direction: DVec3) -> f64 {
    let step = WAY_STEP_FRAC * world.bounds.size();
    let at = |steps: &u32| first.pose.position + direction * (f64::from(*steps) * step);
    let inside = (1..WAY_STEPS).take_while(|steps| world.in_capture_region(at(steps))).count();
    inside as f64 * step
}

/// Steps in which the way out of the captured region is sought, and their length over the scene size.
const WAY_STEPS: u32 = 80;
const WAY_STEP_FRAC: f64 = 0.015;

/// Distance ratio that gives the subject the wanted size at the end; `None` where the camera would move the other way.
fn size_ratio(context: &StepContext, target: &Target, first: &CameraState) -> Option<f64> {
    let inward = context.step.movement == Move::PushIn;
    let (world, end) = (context.world, &context.step.end);
    let subject = context.end.as_ref().unwrap_or(target);
    let wide = matches!(end.size, Some(ShotSize::Long | ShotSize::ExtremeLong));
    let parameter = match (wide && !inward, inward && context.before.is_none()) {
        (true, _) => 0.55 + 0.45 * context.parameters[6],
        // The parameter that chose the size from which the free start was moved back.
        (false, true) => context.parameters[2],
        (false, false) => context.parameters[6],
    };
    let bearing = bearing_of(world, subject.aim, first.pose.position);
    let wanted = match (end.distance, fill_in(world, end, parameter)) {
        (Some(distance), _) => distance_along(world, subject, bearing, distance),
        (None, Some(fill)) => {
            let fill = match fill {
                Fill::Height(height) if end.subjects.is_empty() && wide => Fill::Height(height.min(0.4)),
                fill => fill,
            };
            distance_for(world, subject, bearing, fill, context.end_fov_rad(first))
        }
        (None, None) => return None,
    };
    let ratio = wanted / first.pose.position.distance(target.aim);
    let exact = end.distance.is_some() || end.height_frac.is_some();
    let least = if exact { 0.03 } else { 0.1 };
    let is_consistent = if inward { ratio < 1.0 - least } else { ratio > 1.0 + least };
    is_consistent.then_some(ratio)
}

/// Distance ratio at which all subjects of the end are in the frame; `None` where the end requires no whole subjects.
fn whole_ratio(context: &StepContext, first: &CameraState, distance: f64) -> Option<f64> {
    let end = context.end.as_ref().filter(|_| context.step.end.whole)?;
    let ids = &context.step.end.subjects;
    let corners: Vec<DVec3> = ids
        .iter()
        .filter_map(|&id| context.world.subject(id))
        .flat_map(|s| s.corners.iter().copied())
        .chain(end.corners.iter().copied())
        .collect();
    let back = |ratio: f64| moved(first, first.pose.forward() * distance * (1.0 - ratio));
    let ratios = (0..54).map(|i| 1.32 * 1.07_f64.powi(i));
    let spare = lerp((1.0, 1.2), context.parameters[7]);
    // Of the longest ways many lead out of the room.
    let is_in = |eye: DVec3| !context.world.is_indoor() || context.world.outside_frac(eye) <= OUTSIDE_FRAC;
    let stays = |ratio: &f64| *ratio < LONG_RATIO || is_in(back(*ratio).pose.position);
    ratios
        .filter(stays)
        .find(|&ratio| in_frame_frac(context.world, &back(ratio), &corners, 0.02) >= 1.0)
        .map(|ratio| ratio * spare)
}

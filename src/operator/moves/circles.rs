//! Moves about a subject that the camera stays aimed at: orbit, arc, crane.

use glam::DVec3;

use super::context::{NORMAL_LENS_DEG, StepContext, require_visible};
use super::paths::end_view;
use super::with::factor_beside_circle;
use crate::composition::stated_azimuths;
use crate::constraint::{ConstraintKind, Scope, pitch_band_deg};
use crate::framing::{Bearing, Fill, Target, bearing_of, distance_for, extent_frac, view_at};
use crate::motion::MotionSegment;
use crate::program::{Amount, Framing};
use crate::view::{aimed, fill_in, lerp, moved, stated_fill, with_fov};
use cinesplat_geometry::{Pose, rotation};
use cinesplat_trajectory::{CameraState, Move, ShotAngle};

/// Largest angle of an orbit between two keyframes, so that the keyframes show its shape.
const DEG_PER_KEY: f64 = 30.0;

/// Circles the upright axis through the subject's center, at constant radius and height.
pub(super) fn orbit(context: &StepContext) -> Vec<MotionSegment> {
    let target = context.main_target();
    let center = Target { aim: target.center, ..target.clone() };
    let (mut segments, first) = match &context.before {
        Some(before) if is_among(context, before, &target) => {
            let there = end_view(context, &center, before);
            (vec![context.join(*before, there)], there)
        }
        _ => context.opened_on(&center, (0.5, 0.82)),
    };
    let sign = context.sign(match context.step.movement {
        Move::OrbitLeft | Move::ArcLeft => 1.0,
        _ => -1.0,
    });
    let pivot = target.center;
    let away = first.pose.position - pivot;
    let frame = &context.world.frame;
    let degrees = deg_to_side(context, &target, frame.azimuth(away), sign).unwrap_or_else(|| orbit_deg(context));
    let first = from_front(context, &target, first, degrees);
    let away = first.pose.position - pivot;
    let (first, squeeze) = squeezed(context, first, degrees);
    let radius = squeeze * frame.horizontal(away).length();
    // A stated angle is kept; else a closer circle at the same height looks down on its subject from above the
    // furniture.
    let is_stated = |framing: &Framing| framing.angle.is_some() || framing.elevation_deg.is_some();
    let keeps_angle = is_stated(&context.step.start) || is_stated(&context.step.end);
    let rise = if keeps_angle { squeeze * frame.height(away) } else { frame.height(away) };
    let from = frame.azimuth(away);
    let count = (degrees / DEG_PER_KEY).ceil().max(2.0) as usize;
    let at = |i: usize| {
        let azimuth = from + sign * degrees.to_radians() * i as f64 / count as f64;
        let position = pivot + frame.direction(azimuth) * radius + frame.up * rise;
        aimed(context.world, &moved(&first, position - first.pose.position), pivot)
    };
    let states: Vec<CameraState> = (0..=count).map(at).collect();
    let mut segment = context.segment(states).about(pivot);
    // Where the prompt leaves the direction open, the keyframes record the one that was taken.
    segment.movement = match (context.step.movement, sign > 0.0) {
        (Move::OrbitLeft | Move::OrbitRight, true) => Move::OrbitLeft,
        (Move::OrbitLeft | Move::OrbitRight, false) => Move::OrbitRight,
        (_, true) => Move::ArcLeft,
        (_, false) => Move::ArcRight,
    };
    segment = context.constrained_at_end(context.constrained_at_start(segment));
    if let Some(angle) = context.step.start.angle.or(context.step.end.angle).filter(|_| context.before.is_none()) {
        segment = segment.requiring(Scope::All, ConstraintKind::Pitch(pitch_band_deg(angle)));
    }
    segments.push(require_visible(segment, &target, Scope::All));
    segments
}

/// Size in the frame of a thing that the film comes to with a circle from which on the camera is too near to circle it.
const TOO_NEAR: f64 = 1.3;

/// Whether the step before ends too near to another thing than its own, which this step circles: `close up of the laptop, then orbit
/// the desk`.
fn is_among(context: &StepContext, before: &CameraState, target: &Target) -> bool {
    let turned = aimed(context.world, before, target.center);
    let nears = extent_frac(context.world, &turned, target.sized_by()).max_element() > TOO_NEAR;
    context.comes_to(target) && nears && !context.forbids_turning() && context.step.start == Framing::default()
}

/// The first camera of a full turn about a thing that has a front: there, and so the turn ends face to face as well. Others,
/// and those whose beginning the words or the step before state, begin where they begin.
fn from_front(context: &StepContext, target: &Target, first: CameraState, degrees: f64) -> CameraState {
    let (world, step) = (context.world, context.step);
    let is_stated = step.start.side.or(step.end.side).is_some() || context.before.is_some();
    let is_turn = (degrees - FULL_TURN_DEG).abs() < FULL_TURN_TOLERANCE_DEG;
    let front = world.known_front(target.center).filter(|_| is_turn && !is_stated && step.via.is_none());
    let Some(front_rad) = front else { return first };
    let away = first.pose.position - target.center;
    let level = world.frame.horizontal(away).length();
    let position = target.center + world.frame.direction(front_rad) * level + world.frame.up * world.frame.height(away);
    aimed(world, &moved(&first, position - first.pose.position), target.center)
}

/// Angle of a full turn, and by how much it may differ, degrees.
const FULL_TURN_DEG: f64 = 360.0;
const FULL_TURN_TOLERANCE_DEG: f64 = 20.0;

/// A wide orbit in a room may be closer than its picture asks for, with a wider lens: the camera, and the factor on the
/// radius. Parameter 7 chooses it.
fn squeezed(context: &StepContext, first: CameraState, degrees: f64) -> (CameraState, f64) {
    let start = &context.step.start;
    let end = &context.step.end;
    let is_stated = |framing: &Framing| {
        framing.size.is_some()
            || framing.height_frac.is_some()
            || framing.distance.is_some()
            || framing.lens.is_some()
            || framing.height.is_some()
    };
    let opens = context.before.is_none();
    let parameter = context.parameters[7];
    if !opens || degrees < WIDE_ORBIT_DEG || !context.world.is_indoor() || is_stated(start) || is_stated(end) {
        return (first, 1.0);
    }
    let squeeze = if parameter <= 0.5 { 1.0 } else { lerp((1.0, LEAST_SQUEEZE), (parameter - 0.5) / 0.5) };
    let widest = (SQUEEZED_LENS_DEG / 2.0).to_radians().tan();
    let tan = (first.fov_y_rad / 2.0).tan();
    let tan = (tan / squeeze).min(widest).max(tan);
    (with_fov(&first, 2.0 * tan.atan()), squeeze)
}

/// Least angle of an orbit that may be squeezed between walls, degrees.
const WIDE_ORBIT_DEG: f64 = 120.0;
/// Least factor on the radius of an orbit between walls.
const LEAST_SQUEEZE: f64 = 0.35;
/// Widest vertical field of view of an orbit between walls, degrees.
const SQUEEZED_LENS_DEG: f64 = 72.0;

/// Angle of an orbit that ends on a stated side of its subject or before a background: at least 20 degrees. `None` where the prompt
/// states neither, or an angle.
fn deg_to_side(context: &StepContext, target: &Target, from_rad: f64, sign: f64) -> Option<f64> {
    let stated = stated_azimuths(context.world, target, &context.step.end).filter(|_| context.step.amount.is_none())?;
    let turn = |to: f64| ((to - from_rad) * sign).rem_euclid(std::f64::consts::TAU).to_degrees();
    // A background may stand beside the subject: the camera need not go all the way.
    let is_before = context.step.end.side.is_none();
    let beside_rad = if is_before { sign * stated.1 * lerp((-1.0, 0.2), context.parameters[6]) } else { 0.0 };
    let turns = stated.0.into_iter().map(|to| turn(to + beside_rad));
    Some(turns.map(|deg| if deg < 20.0 { deg + 360.0 } else { deg }).fold(f64::INFINITY, f64::min))
}

/// Angle of an orbit: the stated one, or the usual meaning of its words.
fn orbit_deg(context: &StepContext) -> f64 {
    let arc = matches!(context.step.movement, Move::ArcLeft | Move::ArcRight);
    let of_distance = factor_beside_circle(context.step).is_some();
    match context.step.amount.filter(|_| !of_distance) {
        Some(Amount::Degrees(degrees)) => degrees.clamp(1.0, 1080.0),
        Some(Amount::Factor(turns)) => (turns * 360.0).clamp(1.0, 1080.0),
        Some(Amount::Slight) => 25.0,
        Some(Amount::Large) if arc => 180.0,
        Some(Amount::Large) => 360.0,
        _ if arc => lerp((45.0, 70.0), context.parameters[6]),
        _ => lerp((64.0, 90.0), context.parameters[6]),
    }
}

/// Size of what lies below a camera that sinks toward it from straight above: from as high as the room allows.
const HIGH_FILL: (f64, f64) = (0.12, 0.4);
/// The same of a lone thing, around which there is nothing else to see.
const HIGH_LONE_FILL: (f64, f64) = (0.55, 0.8);

/// Rises or sinks, aimed at the subject.
pub(super) fn crane(context: &StepContext) -> Vec<MotionSegment> {
    let target = context.main_target();
    let upward = (context.step.movement == Move::CraneUp) != (context.step.either_way && context.parameters[5] < 0.5);
    if let Some(start) = context.start.as_ref().filter(|start| start.ids.first() != target.ids.first()) {
        return crane_between(context, start, &target, upward);
    }
    let (mut segments, first) = if context.before.is_none() && context.step.start.angle.is_none() {
        let view = context.view(&target, &opening_for_crane(context, upward), (0.42, 0.68), NORMAL_LENS_DEG);
        (Vec::new(), view)
    } else {
        let from_above = !upward && context.step.start.angle == Some(ShotAngle::Overhead);
        let high_fill = if context.world.is_indoor() { HIGH_FILL } else { HIGH_LONE_FILL };
        context.opened_on(&target, if from_above { high_fill } else { (0.42, 0.68) })
    };
    let states = if swoops(context, &first, &target, upward) {
        swoop(context, &first, &target)
    } else {
        let last = raised(context, &first, &target, upward);
        let position = first.pose.position.lerp(last.pose.position, 0.5);
        let middle = CameraState { pose: Pose { position, ..first.pose }, ..first };
        vec![first, aimed(context.world, &middle, target.aim), last]
    };
    let mut segment = context.segment(states).about(target.aim);
    let end_angle = context.step.end.angle;
    let band = match (end_angle, upward) {
        (Some(angle), _) => pitch_band_deg(angle),
        (None, true) => (-60.0, -7.0),
        // From near the floor one looks up.
        (None, false) if context.step.end.height.is_some() => (-40.0, 42.0),
        (None, false) => (-40.0, 6.0),
    };
    segment = segment.requiring(Scope::End, ConstraintKind::Pitch(band));
    if let Some(angle) = context.step.start.angle {
        segment = segment.requiring(Scope::Start, ConstraintKind::Pitch(pitch_band_deg(angle)));
    }
    segment = context
        .constrained_at_end(context.constrained_at_start(segment))
        .requiring(Scope::All, ConstraintKind::Centered(target.clone(), 0.14));
    segments.push(require_visible(segment, &target, Scope::All));
    segments
}

/// Elevation of the camera from which on a descent is a swoop, degrees: straight down it would come down on its subject.
const SWOOP_FROM_DEG: f64 = 50.0;
/// Share of its height above its subject by which a camera that looks straight down sinks.
const OVERHEAD_DESCENT: (f64, f64) = (0.32, 0.5);
/// Intervals between the keyframes of a swoop.
const SWOOP_KEYS: u32 = 8;
/// Largest size of the subject at the end of a swoop, where the words state none.
const SWOOP_FILL: f64 = 0.72;

/// Whether a descent begins above its subject and leads to a side of it, or a rise leads from its side to above it.
fn swoops(context: &StepContext, first: &CameraState, target: &Target, upward: bool) -> bool {
    let end = &context.step.end;
    let start = bearing_of(context.world, target.aim, first.pose.position).elevation_rad.to_degrees();
    let is_stated = end.height.is_some() || context.step.amount.is_some();
    let is_above = end.angle == Some(ShotAngle::Overhead);
    // Just above a table, its middle is far below the camera already.
    let is_low = || start < SWOOP_FROM_DEG || context.before.is_some();
    let swings = if upward { is_above && is_low() } else { !is_above && start > SWOOP_FROM_DEG };
    swings && !is_stated
}

/// Rises or sinks on an arc about the subject, from above it to the elevation of the end or the other way, at a distance
/// that keeps its size and, under a ceiling, as far as that lets it.
fn swoop(context: &StepContext, first: &CameraState, target: &Target) -> Vec<CameraState> {
    let world = context.world;
    let start = bearing_of(world, target.aim, first.pose.position);
    let stated = context.step.end.elevation_deg;
    let to_deg = stated.unwrap_or_else(|| end_elevation_deg(context, lerp((4.0, 24.0), context.parameters[6])));
    let from = first.pose.position.distance(target.aim);
    let bearing =
        |share: f64| Bearing { elevation_rad: lerp((start.elevation_rad, to_deg.to_radians()), share), ..start };
    let fill = stated_fill(&context.step.end, context.parameters[7]);
    let whole = distance_for(world, target, bearing(1.0), fill.unwrap_or(Fill::Fit(SWOOP_FILL)), first.fov_y_rad);
    let to = if fill.is_some() { whole } else { whole.max(from) };
    let to = if to_deg > SWOOP_FROM_DEG { to.min(under_ceiling(context, first, target, to_deg)) } else { to };
    let at = |i: u32| {
        let share = f64::from(i) / f64::from(SWOOP_KEYS);
        view_at(world, target.aim, bearing(share), lerp((from, to), share), first.fov_y_rad)
    };
    std::iter::once(*first).chain((1..=SWOOP_KEYS).map(at)).collect()
}

/// Farthest that a camera above its target is from it under the ceiling that is above the camera now.
fn under_ceiling(context: &StepContext, first: &CameraState, target: &Target, elevation_deg: f64) -> f64 {
    let world = context.world;
    let eye = first.pose.position;
    let Some(free) = world.hit_distance(eye, world.frame.up).filter(|_| world.is_indoor()) else {
        return f64::INFINITY;
    };
    let rise = world.frame.height(eye - target.aim) + free - CEILING_RADII * world.camera_radius;
    rise.max(0.0) / elevation_deg.to_radians().sin()
}

/// Distance of a camera from the ceiling above it, over its radius.
const CEILING_RADII: f64 = 2.0;

/// Elevation at the end of a crane whose end has an angle; `free_deg` without one.
fn end_elevation_deg(context: &StepContext, free_deg: f64) -> f64 {
    match context.step.end.angle {
        Some(ShotAngle::Overhead) if context.world.is_indoor() => lerp((58.0, 70.0), context.parameters[6]),
        Some(ShotAngle::Overhead) => lerp((66.0, 80.0), context.parameters[6]),
        Some(ShotAngle::High) if context.step.movement == Move::CraneUp => lerp((30.0, 38.5), context.parameters[6]),
        Some(ShotAngle::High) => lerp((24.0, 38.0), context.parameters[6]),
        Some(ShotAngle::EyeLevel) => lerp((-4.0, 7.0), context.parameters[6]),
        Some(ShotAngle::Low) => lerp((-30.0, -10.0), context.parameters[6]),
        Some(ShotAngle::Worm) => -45.0,
        None => free_deg,
    }
}

/// Rises or sinks from a view of one subject to a view of another.
fn crane_between(context: &StepContext, start: &Target, end: &Target, upward: bool) -> Vec<MotionSegment> {
    let (mut segments, first) = context.opened_on(start, (0.42, 0.68));
    let view = end_view(context, end, &first);
    let seen = bearing_of(context.world, end.aim, view.pose.position);
    let seen = Bearing { azimuth_rad: near_side(context, [start, end], &first, seen.azimuth_rad), ..seen };
    let distance = view.pose.position.distance(end.aim);
    let frame = &context.world.frame;
    // The least rise or fall that shows, over the distances to the end's subject and to the start's.
    let least = (LEAST_RISE_FRAC * distance).max(LEAST_RISE_FROM * first.pose.position.distance(start.aim));
    let rise = frame.height(view.pose.position - first.pose.position);
    let lift = if upward { (least - rise).max(0.0) } else { (-least - rise).min(0.0) };
    let sine = (frame.height(view.pose.position - end.aim) + lift) / distance.max(1e-9);
    let bearing = Bearing { elevation_rad: sine.clamp(-0.999, 0.999).asin(), ..seen };
    let last = view_at(context.world, end.aim, bearing, distance, view.fov_y_rad);
    let movement = if upward { Move::CraneUp } else { Move::CraneDown };
    // The aim goes from one subject to the other with the camera, so that neither is lost on the way.
    let at = |i: u32| {
        let share = f64::from(i) / f64::from(CRANE_KEYS);
        let position = first.pose.position.lerp(last.pose.position, share);
        let fov_y_rad = lerp((first.fov_y_rad, last.fov_y_rad), share);
        let state = CameraState { pose: Pose { position, ..first.pose }, fov_y_rad, ..first };
        aimed(context.world, &state, start.aim.lerp(end.aim, share))
    };
    let between = (1..CRANE_KEYS).map(at);
    let states = std::iter::once(first).chain(between).chain([last]).collect();
    let segment = context
        .constrained_at_end(context.constrained_at_start(context.segment(states)))
        .requiring(Scope::All, ConstraintKind::Also(movement, end.aim))
        .requiring(Scope::Start, ConstraintKind::Centered(start.clone(), 0.17))
        .requiring(Scope::End, ConstraintKind::Centered(end.clone(), 0.17));
    segments.push(require_visible(require_visible(segment, start, Scope::Start), end, Scope::End));
    segments
}

/// Azimuth from which a crane ends on its second subject: where nothing says a side, about that from which it comes, for nobody asked
/// for a way around it. From what stands on the second subject it may go back in any direction.
fn near_side(context: &StepContext, [start, end]: [&Target; 2], first: &CameraState, azimuth_rad: f64) -> f64 {
    let level = |point: DVec3| context.world.frame.horizontal(point - end.aim).length();
    let stands_on_it = level(start.aim) < end.corners.iter().map(|corner| level(*corner)).fold(0.0, f64::max);
    if stands_on_it || stated_azimuths(context.world, end, &context.step.end).is_some() {
        return azimuth_rad;
    }
    // From straight above, the picture stays the way up that it is.
    let up = first.pose.rotation * DVec3::NEG_Y;
    let is_steep = first.pose.forward().dot(context.world.frame.up) < -STEEP_SIN;
    let near = if is_steep {
        context.world.frame.azimuth(-up)
    } else {
        bearing_of(context.world, end.aim, first.pose.position).azimuth_rad
    };
    near + rotation::short_turn(azimuth_rad - near).clamp(-CRANE_BESIDE_RAD, CRANE_BESIDE_RAD)
}

/// Sine of the angle below the horizon from which on a camera looks straight down.
const STEEP_SIN: f64 = 0.77;
/// Farthest that a crane goes around its second subject, radians.
const CRANE_BESIDE_RAD: f64 = 0.45;

/// Intervals between the keyframes of a crane between two subjects.
const CRANE_KEYS: u32 = 4;
/// Least rise of a crane between two subjects, over the distance to the second one at the end and to the first one at the start.
const LEAST_RISE_FRAC: f64 = 0.3;
const LEAST_RISE_FROM: f64 = 0.17;

/// Framing of a crane's free start: low enough to rise, or high enough to sink.
fn opening_for_crane(context: &StepContext, upward: bool) -> Framing {
    let mut framing = context.opening_framing();
    framing.angle = if upward { None } else { Some(ShotAngle::High) };
    framing
}

/// Least change of a crane's elevation, seen from its subject.
const MIN_CRANE_DEG: f64 = 18.0;

/// Height above a target at which it has the size that the words state for the end, seen from where the camera is; `None`
/// where they state none, and where that is no lower.
fn sized_height(context: &StepContext, first: &CameraState, target: &Target) -> Option<f64> {
    let fill = fill_in(context.world, &context.step.end, context.parameters[6])?;
    let bearing = bearing_of(context.world, target.aim, first.pose.position);
    let distance = distance_for(context.world, target, bearing, fill, first.fov_y_rad);
    let away = first.pose.position - target.aim;
    (distance < 0.9 * away.length()).then(|| context.world.frame.height(away) * distance / away.length())
}

/// The camera after it has risen or sunk, aimed at the target.
fn raised(context: &StepContext, first: &CameraState, target: &Target, upward: bool) -> CameraState {
    let frame = &context.world.frame;
    let away = first.pose.position - target.aim;
    let level = frame.horizontal(away);
    let distance = away.length();
    let start = bearing_of(context.world, target.aim, first.pose.position).elevation_rad.to_degrees();
    let sign = if upward { 1.0 } else { -1.0 };
    let asked = end_elevation_deg(context, start + sign * lerp((22.0, 42.0), context.parameters[6]));
    let asked = context.step.end.elevation_deg.unwrap_or(asked);
    // For every end angle a crane must rise or sink visibly.
    let least = start + sign * MIN_CRANE_DEG;
    let elevation = match (context.step.end.elevation_deg, upward) {
        (Some(stated), _) if (stated - start) * sign > 0.0 => stated,
        (_, true) => asked.max(least),
        (_, false) => asked.min(least),
    };
    let to_height =
        context.step.end.height.map(|height| height - context.world.height_above_floor(first.pose.position));
    let rise = match context.step.amount {
        Some(Amount::Units(units)) => sign * units,
        Some(Amount::Slight) => sign * 0.22 * distance,
        Some(Amount::Large) => sign * 1.2 * distance,
        _ if to_height.is_some_and(|rise| rise * sign > 0.0) => to_height.unwrap_or_default(),
        _ if start > SWOOP_FROM_DEG && !upward && context.step.end.angle == Some(ShotAngle::Overhead) => {
            match sized_height(context, first, target) {
                Some(height) => height - frame.height(away),
                None => -frame.height(away) * lerp(OVERHEAD_DESCENT, context.parameters[6]),
            }
        }
        _ => (level.length() * elevation.clamp(-70.0, 70.0).to_radians().tan()) - frame.height(away),
    };
    // The jib swings toward the subject as it rises, unless it backs away.
    let swings = context.step.end.elevation_deg.is_none() && !context.step.with.contains(&Move::PullOut);
    let swing: DVec3 = f64::from(u8::from(swings)) * -level * lerp((0.0, 0.3), context.parameters[7]) * rise.abs()
        / (rise.abs() + distance);
    aimed(context.world, &moved(first, frame.up * rise + swing), target.aim)
}

//! Moves that pass an object on a side of it: behind it, in front of it, along it; and a reveal from behind it.
//!
//! The near side of an object is its front, which faces the middle of the scene
//! ([`SubjectSide`](crate::program::SubjectSide)); the far side is its back.

use glam::DVec3;

use super::context::{NORMAL_LENS_DEG, StepContext, is_stated, require_visible};
use super::paths::{arriving, end_view};
use crate::composition::{front_azimuth, lens_fov_deg};
use crate::constraint::{ConstraintKind, Scope, TravelDirection};
use crate::framing::{Bearing, Fill, Target, extent_frac, view_at};
use crate::motion::MotionSegment;
use crate::passage::around;
use crate::program::{Framing, Pass};
use crate::route::states_along;
use crate::view::{aimed, distance_along, lerp, moved, stated_fill, view_from, with_fov};
use crate::world::Subject;
use cinesplat_geometry::{Pose, rotation};
use cinesplat_trajectory::{CameraState, Move, ShotAngle};

/// The object that the step passes.
fn passed<'a>(context: &StepContext<'a>) -> Option<&'a Subject> {
    context.world.subject(*context.step.via.as_ref()?.objects.first()?)
}

/// Travels around an object on its far or near side, or along it, to a view of the end target. `None` where the object is
/// unknown.
pub(super) fn passing_beside(context: &StepContext) -> Option<Vec<MotionSegment>> {
    let (how, subject) = (context.step.via.as_ref()?.how, passed(context)?);
    let inner = match how {
        Pass::Along => line_along(context, subject),
        _ => vec![gate_beside(context, subject, how)],
    };
    let first = first_beside(context, subject, &inner);
    let last = match &context.end {
        Some(end) => end_view(context, end, &first),
        None => last_beside(context, subject, &first, &inner),
    };
    let positions = joined(context, subject, (first.pose.position, last.pose.position), &inner);
    let mut states = states_along(context.world, (&first, &last), &positions);
    if how == Pass::Along {
        look_along(context, subject, &mut states);
    }
    let segment = context.segment(states);
    Some(vec![match &context.end {
        Some(end) => arriving(context, segment, None, end),
        None => context.constrained_at_end(context.constrained_at_start(segment)),
    }])
}

/// How far ahead on an object somebody looks who goes along it, over half its length.
const AHEAD: f64 = 0.7;

/// Turns the cameras of a way along an object, but those at ends that other words state, to it: to what stands on it a little ahead, as somebody looks
/// who walks along a workbench.
fn look_along(context: &StepContext, subject: &Subject, states: &mut [CameraState]) {
    let frame = &context.world.frame;
    let [long, _] = subject.level_axes(frame.up);
    let Some(axis) = long.try_normalize() else { return };
    let surface = subject.borne_heights.map_or(0.0, |[surface, _]| surface - frame.height(subject.center));
    let [first, .., last] = states else { return };
    let onward = (last.pose.position - first.pose.position).dot(axis).signum();
    let is_open = context.before.is_none() && context.start.is_none();
    let to = states.len() - usize::from(context.end.is_some());
    for state in &mut states[usize::from(!is_open)..to] {
        let along = (state.pose.position - subject.center).dot(axis) + onward * AHEAD * long.length();
        let at = subject.center + axis * along.clamp(-long.length(), long.length()) + frame.up * surface;
        *state = aimed(context.world, state, at);
    }
}

/// The path from end to end: around the object to the inner points and away from them, and straight between those.
fn joined(context: &StepContext, subject: &Subject, (first, last): (DVec3, DVec3), inner: &[DVec3]) -> Vec<DVec3> {
    let mut out = vec![first];
    let mut go_to = |point: DVec3, bends: bool| {
        let from = out[out.len() - 1];
        if from.distance(point) > 1e-6 * context.world.bounds.size() {
            if bends {
                out.extend(around(context.world, subject, from, point));
            }
            out.push(point);
        }
    };
    for (i, &point) in inner.iter().enumerate() {
        go_to(point, i == 0);
    }
    go_to(last, true);
    if out.len() < 2 {
        out.push(last);
    }
    out
}

/// Room between the object's box and a camera beside it. Parameter 1 chooses it.
fn margin(context: &StepContext) -> f64 {
    let world = context.world;
    2.0 * world.camera_radius + lerp((0.0, 0.12), context.parameters[1]) * world.bounds.size()
}

/// Height of a camera that passes an object, as an offset from the object's center. Parameter 3 chooses it.
fn rise(context: &StepContext, subject: &Subject) -> DVec3 {
    let frame = &context.world.frame;
    let low = context.world.camera_radius * 1.5 - context.world.height_above_floor(subject.center);
    let half = subject.reach(frame.up);
    let usual = lerp((-0.2 * half, 1.3 * half + 0.05 * context.world.bounds.size()), context.parameters[3]);
    // Who walks along cabinets on a wall stays on the floor.
    let walks = context.world.is_indoor() && matches!(context.step.movement, Move::Follow | Move::PushIn);
    let most = MOST_WALKING * context.world.eye_height() - context.world.height_above_floor(subject.center);
    frame.up * if walks { usual.min(most) } else { usual }.max(low)
}

/// Height of a walking camera over that of a standing person's eyes.
const MOST_WALKING: f64 = 1.05;

/// The point behind or in front of an object.
fn gate_beside(context: &StepContext, subject: &Subject, how: Pass) -> DVec3 {
    let turn = if how == Pass::Behind { std::f64::consts::PI } else { 0.0 };
    let azimuth = front_azimuth(context.world, subject.center) + turn + (context.parameters[0] - 0.5) * 1.2;
    let direction = context.world.frame.direction(azimuth);
    subject.center + direction * (subject.reach(direction) + margin(context)) + rise(context, subject)
}

/// Both ends of the line beside an object, along its longer horizontal axis: toward the end target, or either way; on the
/// side of the camera before, or else mostly in front.
fn line_along(context: &StepContext, subject: &Subject) -> Vec<DVec3> {
    let world = context.world;
    let [long, _] = subject.level_axes(world.frame.up);
    let aside = long.cross(world.frame.up).normalize_or_zero();
    let (near, from) = match &context.before {
        Some(before) => (before.pose.position - subject.center, Some(before.pose.position)),
        None => (world.frame.direction(front_azimuth(world, subject.center)), None),
    };
    let other = context.parameters[4] > 0.75 && from.is_none();
    let aside = if (near.dot(aside) < 0.0) == other { aside } else { -aside };
    let ahead = match (&context.end, from) {
        (Some(end), _) => (end.aim - subject.center).dot(long),
        (None, Some(from)) => (subject.center - from).dot(long),
        (None, None) => context.parameters[2] - 0.5,
    };
    let long = if ahead < 0.0 { -long } else { long };
    let middle = subject.center + aside * (subject.reach(aside) + margin(context)) + rise(context, subject);
    vec![middle - long * 1.02, middle + long * 1.02]
}

/// The camera at the start: the one before, a view of the start target, or one on the way to the first inner point, that
/// looks along the path.
fn first_beside(context: &StepContext, subject: &Subject, inner: &[DVec3]) -> CameraState {
    let world = context.world;
    if let Some(before) = &context.before {
        return *before;
    }
    if context.start.is_some() {
        return context.view(&context.opening_target(), &context.opening_framing(), (0.4, 0.7), NORMAL_LENS_DEG);
    }
    let (position, next) = if let [from, to, ..] = inner {
        (*from, *to)
    } else {
        let gate = inner.first().copied().unwrap_or(subject.center);
        let sign = if context.parameters[2] < 0.5 { -1.0 } else { 1.0 };
        (context.world.frame.swung(subject.center, gate, sign * lerp((0.9, 1.9), context.parameters[4])), gate)
    };
    let fov_deg = context.opening_framing().lens.map_or(NORMAL_LENS_DEG, lens_fov_deg);
    let fov_y_rad = lerp(fov_deg, context.parameters[5]).to_radians();
    let pose = Pose { position, rotation: glam::DQuat::IDENTITY };
    aimed(world, &CameraState { pose, fov_y_rad, focus_distance: None }, next)
}

/// The camera after the object where no end target is named: as far beyond the last inner point as the path came, looking
/// on along it.
fn last_beside(context: &StepContext, subject: &Subject, first: &CameraState, inner: &[DVec3]) -> CameraState {
    let frame = &context.world.frame;
    let gate = inner.last().copied().unwrap_or(first.pose.position);
    if inner.len() > 1 {
        let last = moved(first, gate - first.pose.position);
        return aimed(context.world, &last, gate + (gate - inner[0]));
    }
    let azimuth = |p: DVec3| frame.azimuth(p - subject.center);
    let turn = rotation::short_turn(azimuth(gate) - azimuth(first.pose.position));
    let turn = turn.signum() * turn.abs().clamp(0.6, 1.9);
    let position = context.world.frame.swung(subject.center, gate, turn);
    let onward = context.world.frame.swung(subject.center, position, turn.signum() * 0.5) - position;
    aimed(context.world, &moved(first, position - first.pose.position), position + onward)
}

/// A truck from one end of an object to the other, parallel to its longer horizontal axis and facing it; mostly on its
/// front side. `None` where the object is unknown or the camera's place is given.
pub(super) fn truck_along(context: &StepContext) -> Option<Vec<MotionSegment>> {
    let subject = passed(context).filter(|_| context.before.is_none())?;
    let world = context.world;
    let framing = Framing { subjects: context.step.via.as_ref()?.objects.clone(), ..context.opening_framing() };
    let target = Target::of(world, &framing)?;
    let fill = stated_fill(&framing, context.parameters[2]);
    // A stated size is that of the table itself.
    let borne = subject.borne_heights.filter(|_| fill.is_none());
    let named = named_along(context, subject).filter(|_| fill.is_none());
    let bears = borne.is_some() || named.is_some();
    let (fill_frac, target) = match (named, borne) {
        (Some(named), _) => (NAMED_FILL, named),
        (None, Some(heights)) => (BORNE_FILL, things_on(context, (subject, 1.0), heights, target)),
        (None, None) => ((0.3, 0.7), target),
    };
    let [long, _] = subject.level_axes(world.frame.up);
    let aside = long.cross(world.frame.up).normalize_or_zero();
    let front = world.frame.direction(front_azimuth(world, subject.center));
    let aside = if (front.dot(aside) < 0.0) == (context.parameters[4] > 0.75) { aside } else { -aside };
    let angle = context.step.end.angle.or(framing.angle);
    let elevation_deg = match angle {
        Some(ShotAngle::EyeLevel | ShotAngle::Low) => LEVEL_ELEVATION_DEG,
        _ if bears => BORNE_ELEVATION_DEG,
        _ => (0.0, 20.0),
    };
    let elevation_deg = lerp(elevation_deg, context.parameters[1]);
    let elevation_rad = framing.elevation_deg.unwrap_or(elevation_deg).to_radians();
    let bearing = Bearing { azimuth_rad: world.frame.azimuth(aside), elevation_rad };
    let fill = fill.unwrap_or_else(|| Fill::Height(lerp(fill_frac, context.parameters[2])));
    let fov_deg = framing.lens.map_or(NORMAL_LENS_DEG, lens_fov_deg);
    let fov_y_rad = lerp(fov_deg, context.parameters[3]).to_radians();
    let middle = view_from(world, (&target, &framing), bearing, fill, fov_y_rad);
    let sign = context.sign(if context.step.movement == Move::TruckLeft { -1.0 } else { 1.0 });
    let half = middle.pose.right() * sign * long.length() * lerp((0.84, 1.0), context.parameters[6]);
    let states = vec![moved(&middle, -half), moved(&middle, half)];
    let direction = if sign > 0.0 { TravelDirection::Right } else { TravelDirection::Left };
    let segment = context
        .segment(states)
        .requiring(Scope::All, ConstraintKind::Travel(direction, target.aim, 0.02))
        .requiring(Scope::All, ConstraintKind::InFrame(target.ids.iter().take(1).copied().collect(), 0.2));
    Some(vec![context.constrained_at_end(context.constrained_at_start(require_visible(segment, &target, Scope::All)))])
}

/// The things on or before a subject that a slide along it is to show, as one target; `None` where the words name none.
fn named_along(context: &StepContext, along: &Subject) -> Option<Target> {
    let world = context.world;
    let ids = [&context.step.start, &context.step.end].into_iter().flat_map(|framing| &framing.subjects);
    let things: Vec<&Subject> =
        ids.filter_map(|&id| world.subject(id)).filter(|thing| thing.radius < MOST_NAMED * along.radius).collect();
    let frame = &world.frame;
    let heights = |thing: &Subject| {
        let (middle, reach) = (frame.height(thing.center), thing.reach(frame.up));
        (middle - reach, middle + reach)
    };
    let low = things.iter().map(|thing| heights(thing).0).reduce(f64::min)?;
    let high = things.iter().map(|thing| heights(thing).1).reduce(f64::max)?;
    // All of the table's length, at the height of the things on it.
    let id = context.step.via.as_ref()?.objects.first().copied()?;
    let framing = Framing { subjects: vec![id], ..Framing::default() };
    let target = Target::of(world, &framing)?;
    Some(things_on(context, (along, NAMED_DEPTH), [low, high], target))
}

/// Size of a thing that is shown along another one, over the size of that.
const MOST_NAMED: f64 = 0.6;
/// Share of a table's depth that such things take up, and their height in the frame.
const NAMED_DEPTH: f64 = 0.4;
const NAMED_FILL: (f64, f64) = (0.62, 0.95);
/// Elevation of a camera that slides along at the height of things, degrees.
const LEVEL_ELEVATION_DEG: (f64, f64) = (0.0, 7.0);

/// Elevation of a camera that slides along things on a table, degrees, and their height in the frame.
const BORNE_ELEVATION_DEG: (f64, f64) = (4.0, 16.0);
const BORNE_FILL: (f64, f64) = (0.5, 0.85);
/// Depth of a tabletop that belongs to the picture of the things on it, over their height.
const TABLETOP_DEPTH: f64 = 0.3;

/// The target of a view of a subject with the space that the things on it take up in place of the subject's own.
fn things_on(
    context: &StepContext,
    (subject, depth): (&Subject, f64),
    [surface, top]: [f64; 2],
    target: Target,
) -> Target {
    let frame = &context.world.frame;
    let height = (top - surface).max(0.5 * subject.reach(frame.up));
    let at = |point: DVec3, height: f64| frame.at_height(point, height);
    let [long, short] = subject.level_axes(frame.up);
    let heights = [surface - TABLETOP_DEPTH * height, surface + height];
    let corners = [(-1.0, -1.0), (-1.0, 1.0), (1.0, -1.0), (1.0, 1.0)]
        .iter()
        .flat_map(|(a, b)| heights.map(|height| at(subject.center + long * *a + short * (depth * *b), height)));
    let (aim, corners) = (at(subject.center, heights[0].midpoint(heights[1])), corners.collect::<Vec<_>>());
    let radius = corners.iter().map(|corner| corner.distance(aim)).fold(0.0, f64::max);
    Target { aim, corners, outline: None, radius, ..target }
}

/// Starts behind an object that hides the subject and slides out from behind it, aimed at the subject. `None` where the
/// object is unknown or above the subject, or the camera's place is given.
pub(super) fn reveal_from_behind(context: &StepContext) -> Option<Vec<MotionSegment>> {
    let cover = passed(context).filter(|_| context.before.is_none())?;
    let world = context.world;
    let target = on_its_top(context, context.main_target());
    let first = covered_view(context, cover, &target)?;
    let last = aimed(world, &moved(&first, way_out(context, cover, &target, &first)), target.aim);
    let segment = context.segment(vec![first, last]).about(target.aim);
    let mut segment = context.constrained_at_end(segment);
    for &id in target.ids.iter().take(1) {
        segment = segment.requiring(Scope::Start, ConstraintKind::Unseen(id, COVERED_FRAC));
    }
    Some(vec![require_visible(segment, &target, Scope::End)])
}

/// The target with its aim on its top where other things stand there: a laid table is looked at from above its edge.
fn on_its_top(context: &StepContext, target: Target) -> Target {
    match target.borne_heights(context.world) {
        Some([surface, _]) => Target { aim: context.world.frame.at_height(target.aim, surface), ..target },
        None => target,
    }
}

/// A camera aimed at the target on the line from it through the middle of the cover, beyond the cover.
fn covered_view(context: &StepContext, cover: &Subject, target: &Target) -> Option<CameraState> {
    let (world, frame) = (context.world, &context.world.frame);
    let line = cover.center - target.aim;
    let back = frame.horizontal(line).try_normalize()?;
    let azimuth_rad = frame.azimuth(back);
    let farther = (FARTHER_FRAC * world.bounds.size()).min(cover.radius);
    let room = 2.0 * world.camera_radius + lerp((0.0, farther), context.parameters[1]);
    let near = frame.horizontal(line).length() + cover.reach(back) + room;
    let distance = context.step.end.distance.map_or(near, |wanted| {
        distance_along(world, target, Bearing { azimuth_rad, elevation_rad: 0.0 }, wanted).max(near)
    });
    let height = match context.parameters[3] {
        share if share < 0.5 => frame.height(line) * lerp((0.0, 1.2), 2.0 * share),
        // Close behind the upper part of what hides it: the back of a chair and not its legs.
        share => frame.height(line) + cover.reach(frame.up) * lerp(HIDDEN_BEHIND, 2.0 * share - 1.0),
    };
    let bearing = Bearing { azimuth_rad, elevation_rad: height.atan2(distance) };
    let fov_y_rad = lerp(NORMAL_LENS_DEG, 0.5).to_radians();
    let view = view_at(world, target.aim, bearing, distance.hypot(height), fov_y_rad);
    // A lens that takes in a whole table shows far more than the chair that is to hide it.
    let hides_little = target.radius > MOST_HIDDEN * cover.radius && !is_stated(&context.step.end);
    let normal = || with_fov(&view, lerp(NORMAL_LENS_DEG, context.parameters[2]).to_radians());
    Some(if hides_little { normal() } else { filled(context, target, &view) })
}

/// Size of what a cover can hide, over its own.
const MOST_HIDDEN: f64 = 1.3;
/// Farthest that a camera is behind a cover, over the scene size; a small cover hides little from farther away.
const FARTHER_FRAC: f64 = 0.15;
/// Height of a camera behind the upper part of a cover, over half of the cover's height, from its middle.
const HIDDEN_BEHIND: (f64, f64) = (0.2, 0.85);

/// The slide that brings the target out from behind the cover: to a side or up, beyond the edge of the cover as the
/// camera sees it, by at least the target's own extent.
fn way_out(context: &StepContext, cover: &Subject, target: &Target, first: &CameraState) -> DVec3 {
    let frame = &context.world.frame;
    let spare = lerp((0.85, 1.35), context.parameters[6]);
    let level = |v: DVec3| frame.horizontal(v).length();
    let to_target = level(first.pose.position - target.aim);
    // The edge of the cover shifts across the target by the camera's travel times this share.
    let share = (level(cover.center - target.aim) / to_target).max(0.1);
    let right = frame.horizontal(first.pose.right()).normalize_or_zero();
    let breadth = target.corners.iter().map(|corner| (*corner - target.aim).dot(right).abs()).fold(0.0, f64::max);
    // Out of a chair's shadow all of a table is seen, which the chair never hid.
    let reach = cover.reach(right);
    let aside = right * (reach + breadth.min(2.0 * reach)) / share * spare;
    let over = frame.up * (2.0 * cover.reach(frame.up)) * spare;
    match context.step.with.first() {
        Some(Move::PedestalUp | Move::CraneUp | Move::TiltUp) => over,
        Some(Move::TruckLeft | Move::PanLeft | Move::OrbitLeft | Move::ArcLeft) => -aside,
        Some(Move::TruckRight | Move::PanRight | Move::OrbitRight | Move::ArcRight) => aside,
        // Beside one chair at a table stands the next.
        _ if target.borne_heights(context.world).is_some() => over,
        _ if context.parameters[5] < 0.5 => -aside,
        _ => aside,
    }
}

/// Largest visible share of a subject that a reveal starts behind cover.
const COVERED_FRAC: f64 = 0.1;

/// The camera with the lens that gives its target the stated height, or the usual one; or with the stated lens.
fn filled(context: &StepContext, target: &Target, view: &CameraState) -> CameraState {
    let end = &context.step.end;
    if let Some(lens) = end.lens {
        let range = lens_fov_deg(lens);
        return with_fov(view, lerp(range, context.parameters[2]).to_radians());
    }
    let wanted = match stated_fill(end, context.parameters[2]) {
        Some(Fill::Height(wanted) | Fill::Fit(wanted)) => wanted,
        None => lerp((0.3, 0.6), context.parameters[2]),
    };
    let now = extent_frac(context.world, view, target.sized_by()).y;
    let tan = (view.fov_y_rad / 2.0).tan() * now / wanted;
    with_fov(view, (2.0 * tan.atan()).clamp(12.0_f64.to_radians(), 70.0_f64.to_radians()))
}

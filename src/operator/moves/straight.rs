//! Moves along a straight line without a turn: push in, pull out, truck, pedestal.

use glam::DVec3;

use super::context::{NORMAL_LENS_DEG, StepContext, require_visible};
use super::passes::gate;
use super::standing_view::stands;
use super::turns::is_along;
use crate::constraint::{ConstraintKind, Scope, TravelDirection};
use crate::framing::{Fill, Target, bearing_of, distance_for, frame_position, in_frame_frac};
use crate::motion::MotionSegment;
use crate::program::{Amount, Framing, Motion, Pass, SubjectPart};
use crate::view::{LYING_RADII, aimed, distance_along, lerp, moved, stated_fill, with_fov};
use cinesplat_trajectory::{CameraState, Move, ShotSize};

/// Moves along the line to the subject, toward it or away from it.
pub(super) fn dolly(context: &StepContext) -> Vec<MotionSegment> {
    let inward = (context.step.movement == Move::PushIn) != (context.step.either_way && context.parameters[5] < 0.5);
    let target =
        if inward { context.main_target() } else { context.start.clone().unwrap_or_else(|| pulled_from(context)) };
    let fill = if inward { (0.24, 0.45) } else { (0.6, 0.95) };
    let (mut segments, first) = if context.before.is_none()
        && context.step.start.size.is_none()
        && !context.step.start.whole
        && !stands(&context.standing())
    {
        (Vec::new(), open_first(context, &target, inward, fill))
    } else if let Some(before) =
        context.before.filter(|_| takes_in(context, inward).is_some() && context.start.is_none())
    {
        // The step before may have turned away from what it began with.
        (Vec::new(), before)
    } else {
        context.opened_on(&target, fill)
    };
    let ratio = distance_ratio(context, &target, &first, inward);
    let first = if backs_into_view(context, &target, inward) { nearer(&first, &target, ratio) } else { first };
    let distance = first.pose.position.distance(target.aim);
    let last = moved(&first, first.pose.forward() * distance * (1.0 - ratio));
    let last = if inward { last } else { within_room(context, &first, distance, last) };
    let taken_in = takes_in(context, inward);
    let last = taken_in.map_or(last, |end| settled_on(context, [&first, &last], &target, end));
    let segment = context.segment(vec![first, last]);
    let wanted = if inward { (0.0, 0.76) } else { (1.32, f64::INFINITY) };
    let subtle = matches!(context.step.amount, Some(Amount::Slight | Amount::Units(_) | Amount::Factor(_)));
    let segment =
        if subtle { segment } else { segment.requiring(Scope::All, ConstraintKind::DistanceRatio(target.aim, wanted)) };
    let segment = match taken_in {
        Some(end) => segment.requiring(Scope::End, ConstraintKind::Centered(end.clone(), 0.2)),
        None => segment.requiring(Scope::All, ConstraintKind::Centered(target.clone(), 0.17)),
    };
    let mut segment = context.constrained_at_end(context.constrained_at_start(segment));
    if !inward && context.step.end.whole && context.step.start.whole == context.step.end.whole {
        segment = segment.requiring(Scope::End, ConstraintKind::InFrame(context.step.end.subjects.clone(), 0.97));
    }
    if !inward && context.step.end.whole && context.before.is_none() {
        let left = target.ids.first();
        let ids = &context.step.end.subjects;
        let others: Vec<u32> = ids.iter().filter(|&id| Some(id) != left).copied().collect();
        segment = segment.requiring(
            Scope::Start,
            ConstraintKind::NotWhole(if others.is_empty() { ids.clone() } else { others }, 0.6),
        );
    }
    if !inward {
        segment =
            segment.requiring(Scope::End, ConstraintKind::InFrame(target.ids.iter().take(1).copied().collect(), 0.95));
    }
    segments.push(require_visible(segment, &target, Scope::All));
    segments
}

/// What a pull-out goes back to take in: the whole of another thing than it sets out from, or of the thing of which the step
/// before showed a part.
fn takes_in<'a>(context: &'a StepContext, inward: bool) -> Option<&'a Target> {
    let end = context.end.as_ref().filter(|_| !inward && context.step.end.whole)?;
    let start = context.start.as_ref();
    let is_other =
        start.is_some_and(|start| start.ids.first() != end.ids.first()) || start.is_none() && context.before.is_some();
    (is_other && context.step.end.subjects.len() == 1).then_some(end)
}

/// The end of a pull-out with its aim on what it takes in, as far as a camera that backs away turns; farther back where that
/// is not in the picture.
fn settled_on(context: &StepContext, [first, last]: [&CameraState; 2], left: &Target, end: &Target) -> CameraState {
    let forbidden = |motion: &Motion| matches!(motion, Motion::Turn | Motion::Pan | Motion::Tilt);
    let turned = |state: &CameraState| aimed(context.world, state, end.aim);
    let turn_rad = turned(last).pose.forward().angle_between(last.pose.forward());
    if turn_rad > MOST_SETTLING_RAD || context.forbidden.iter().any(forbidden) {
        return *last;
    }
    let way = last.pose.position - first.pose.position;
    let distance = |state: &CameraState| state.pose.position.distance(left.aim);
    let is_whole = |state: &CameraState| {
        in_frame_frac(context.world, state, &end.corners, 0.03) >= 1.0
            && distance(state) > LEAST_RATIO * distance(first)
    };
    // Aimed at its middle, a thing fits from nearer by.
    let share = |i: u32| 0.35 + 0.05 * f64::from(i);
    let nearer = (0..=13).map(|i| turned(&moved(first, way * share(i)))).find(is_whole);
    nearer.map_or_else(|| turned(last), |view| with_fov(&view, last.fov_y_rad))
}

/// Least distance at the end of a pull-out over that at its start.
const LEAST_RATIO: f64 = 1.36;
/// Largest turn of a pull-out to what it takes in, radians.
const MOST_SETTLING_RAD: f64 = 0.8;

/// Whether a pull-out ends, and does not start, at its view: in a room without a subject the way back is a wall.
fn backs_into_view(context: &StepContext, target: &Target, inward: bool) -> bool {
    !inward && target.ids.is_empty() && context.before.is_none() && context.world.is_indoor()
}

/// The end of a pull-out that goes on from another step and is to hold more: before the wall behind the camera where the way
/// is much longer than the room, with a wider lens instead.
fn within_room(context: &StepContext, first: &CameraState, distance: f64, last: CameraState) -> CameraState {
    let world = context.world;
    let is_open = context.before.is_some() && (context.step.end.whole || context.step.end.size.is_some());
    let may_zoom = !context.forbidden.contains(&Motion::Zoom) && context.step.end.lens.is_none();
    let way = last.pose.position.distance(first.pose.position);
    let free = world.hit_distance(first.pose.position, -first.pose.forward()).unwrap_or(f64::INFINITY);
    let free = (free - WALL_RADII * world.camera_radius).max(0.0);
    let leaves = free < way && way > LONG_WAY * distance && !world.in_capture_region(last.pose.position);
    if !world.is_indoor() || !is_open || !may_zoom || context.step.amount.is_some() || !leaves {
        return last;
    }
    let tan = (first.fov_y_rad / 2.0).tan() * (distance + way) / (distance + free);
    let tan = tan.min((WIDEST_DEG / 2.0).to_radians().tan()).max((first.fov_y_rad / 2.0).tan());
    with_fov(&moved(first, -first.pose.forward() * free), 2.0 * tan.atan())
}

/// Way of a pull-out over its first distance from which on it is a flight out of the house.
const LONG_WAY: f64 = 4.0;
/// Distance of a camera from the wall behind it, over its radius, and the widest lens of a pull-out that ends there.
const WALL_RADII: f64 = 3.0;
const WIDEST_DEG: f64 = 78.0;

/// The camera before a pull-out of a ratio that ends at `last`.
fn nearer(last: &CameraState, target: &Target, ratio: f64) -> CameraState {
    let distance = last.pose.position.distance(target.aim);
    moved(last, last.pose.forward() * distance * (1.0 - 1.0 / ratio))
}

/// The target that a pull-out without a start framing pulls away from: that of an earlier step, else the first subject
/// of its end.
fn pulled_from(context: &StepContext) -> Target {
    let first = Framing { subjects: context.step.end.subjects.iter().take(1).copied().collect(), ..Framing::default() };
    let first = || Target::of(context.world, &first);
    context.earlier.clone().or_else(first).unwrap_or_else(|| context.main_target())
}

/// Opening view of a dolly with a free start size. A push that ends at a stated size starts far enough away.
fn open_first(context: &StepContext, target: &Target, inward: bool, fill: (f64, f64)) -> CameraState {
    let framing = if context.start.is_some() || !inward { context.step.start.clone() } else { Framing::default() };
    let angle = framing.angle.or(context.step.end.angle);
    let mut framing = Framing { angle, ..framing };
    context.inherit(&mut framing);
    let stated = &context.step.end;
    let sized = stated.size.is_some() || stated.height_frac.is_some() || stated.distance.is_some();
    let nearer = context.step.start.height_frac.is_none() && context.step.start.distance.is_none();
    if target.ids.is_empty() || !(inward && nearer && (sized || stated.height.is_some())) {
        return context.view(target, &framing, fill, NORMAL_LENS_DEG);
    }
    // The camera at the end, moved back.
    let end_framing = Framing {
        size: stated.size,
        height_frac: stated.height_frac,
        distance: stated.distance,
        height: stated.height,
        ..framing
    };
    let fill = if sized { fill } else { (0.4, 0.8) };
    let end = context.view(target, &end_framing, fill, NORMAL_LENS_DEG);
    let distance = end.pose.position.distance(target.aim);
    let back = lerp((1.4, 2.8), context.parameters[6]);
    moved(&end, -end.pose.forward() * distance * back)
}

/// Distance at the end over that at the start.
fn distance_ratio(context: &StepContext, target: &Target, first: &CameraState, inward: bool) -> f64 {
    let distance = first.pose.position.distance(target.aim);
    let open = if inward { lerp((0.36, 0.56), context.parameters[6]) } else { lerp((1.9, 3.3), context.parameters[6]) };
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
    if inward { ratio.clamp(0.05, 0.97) } else { ratio.clamp(1.03, 12.0) }
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
    let behind = world.hit_distance(first.pose.position, -first.pose.forward())?;
    let free = behind - WALL_RADII * world.camera_radius;
    let distance = first.pose.position.distance(target.aim);
    let ratio = 1.0 + lerp(BACK_SHARE, context.parameters[6]) * free / distance;
    (ratio > size_ratio(context, target, first).unwrap_or(LEAST_RATIO)).then_some(ratio)
}

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
    let wanted = match (end.distance, stated_fill(end, parameter)) {
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
    let ratios = (0..40).map(|i| 1.32 * 1.07_f64.powi(i));
    let spare = lerp((1.0, 1.2), context.parameters[7]);
    ratios
        .into_iter()
        .find(|&ratio| in_frame_frac(context.world, &back(ratio), &corners, 0.02) >= 1.0)
        .map(|ratio| ratio * spare)
}

/// Slides sideways, past or along a subject.
pub(super) fn truck(context: &StepContext) -> Vec<MotionSegment> {
    let sign = context.sign(if context.step.movement == Move::TruckLeft { -1.0 } else { 1.0 });
    let along = |state: &CameraState| state.pose.right() * sign;
    let direction = if sign > 0.0 { TravelDirection::Right } else { TravelDirection::Left };
    slide(context, direction, along, |context, target, state| {
        let right = state.pose.right() * sign;
        frame_depth(context, state, target.aim).map(|_| (target.aim - state.pose.position).dot(right)).map(|way| {
            let half = target.corners.iter().map(|c| (*c - target.aim).dot(right)).fold(0.0, f64::max);
            way + match context.step.end.part {
                SubjectPart::Left => -half * 0.8 * sign,
                SubjectPart::Right => half * 0.8 * sign,
                _ => 0.0,
            }
        })
    })
}

/// Slides up or down.
pub(super) fn pedestal(context: &StepContext) -> Vec<MotionSegment> {
    let sign = context.sign(if context.step.movement == Move::PedestalDown { -1.0 } else { 1.0 });
    let up = context.world.frame.up;
    let direction = if sign > 0.0 { TravelDirection::Up } else { TravelDirection::Down };
    slide(
        context,
        direction,
        |_| up * sign,
        |_, target, state| {
            // The rise that brings the target to the middle row of the frame, where the view axis meets its height.
            let away = target.aim - state.pose.position;
            let forward = state.pose.forward();
            let level = forward - up * forward.dot(up);
            let reach = away.dot(level) / level.length_squared().max(1e-9);
            (reach > 0.0).then(|| (away - forward * reach).dot(up) * sign)
        },
    )
}

fn frame_depth(context: &StepContext, state: &CameraState, point: DVec3) -> Option<f64> {
    frame_position(context.world, state, point).map(|(_, depth)| depth)
}

/// Size of the subject of a slide, and that of one along which the camera slides, from one end of it to the other.
const SLIDE_FILL: (f64, f64) = (0.36, 0.66);
const ALONG_SLIDE_FILL: (f64, f64) = (1.1, 1.8);

/// A slide in a direction: from the start target to the end target, or past a target.
/// `way_to` gives the travel that brings a target to the frame's middle.
fn slide(
    context: &StepContext,
    direction: TravelDirection,
    along: impl Fn(&CameraState) -> DVec3,
    way_to: impl Fn(&StepContext, &Target, &CameraState) -> Option<f64>,
) -> Vec<MotionSegment> {
    let beside = |how: Pass| matches!(how, Pass::Past | Pass::Front | Pass::Behind);
    let passed = context.step.via.as_ref().filter(|via| beside(via.how));
    let passed = passed
        .and_then(|via| Target::of(context.world, &Framing { subjects: via.objects.clone(), ..Framing::default() }));
    let same = matches!((&context.start, &context.end), (Some(a), Some(b)) if a.ids.first() == b.ids.first())
        && context.step.start.part == context.step.end.part;
    let travels = context.end.is_some() && !same && (context.start.is_some() || context.before.is_some());
    let target =
        if travels { context.opening_target() } else { passed.clone().unwrap_or_else(|| context.main_target()) };
    let (mut segments, mut first) = match (&context.before, &context.start) {
        (Some(before), None) => (Vec::new(), *before),
        _ => context.opened_on(&target, if is_along(context) { ALONG_SLIDE_FILL } else { SLIDE_FILL }),
    };
    let placed = context.before.is_some() || stands(&context.standing());
    if !placed && direction.is_vertical() && context.step.start.angle.is_none() && !target.ids.is_empty() {
        first = leveled(context, &first, &target);
    }
    let distance = first.pose.position.distance(target.aim);
    let rise = rise_to_height(context, direction, &first);
    let way = match (&context.end, travels) {
        _ if rise.is_some() => rise.unwrap_or_default(),
        (Some(end), true) => way_to(context, end, &first).unwrap_or(0.0),
        _ if keeps_picture(context, direction, &target) => {
            let half_height = (first.fov_y_rad / 2.0).tan() * distance;
            lerp((0.55, 0.75), context.parameters[6]) * half_height
        }
        _ => free_slide_length(context, &target, &first, &along, distance),
    };
    if !placed && !travels && rise.is_none() {
        // A truck passes its target halfway; a pedestal starts in front of it.
        let lead = if direction.is_vertical() && !target.ids.is_empty() { 0.12 } else { 0.5 };
        first = moved(&first, -along(&first) * way * lead);
        if direction == TravelDirection::Down {
            first = off_the_floor(context, &first, (&target, along(&first) * way));
        }
    }
    first = through_gate(context, &first, along(&first) * way);
    let last = moved(&first, along(&first) * way);
    let mut segment = context.segment(vec![first, last]);
    let slight = matches!(context.step.amount, Some(Amount::Slight | Amount::Units(_)))
        || !travels && keeps_picture(context, direction, &target);
    segment =
        segment.requiring(Scope::All, ConstraintKind::Travel(direction, target.aim, if slight { 0.02 } else { 0.24 }));
    if travels {
        segment = segment.requiring(Scope::Start, ConstraintKind::Centered(target.clone(), 0.22));
        if let Some(end) = &context.end {
            segment = segment.requiring(Scope::End, ConstraintKind::Centered(end.clone(), 0.2));
            segment = require_visible(segment, end, Scope::End);
        }
        segment = require_visible(segment, &target, Scope::Start);
    } else if context.before.is_none() {
        let ids: Vec<u32> = target.ids.iter().take(1).copied().collect();
        let (scope, share) = if same { (Scope::All, 0.35) } else { (Scope::All, 0.3) };
        segment = segment
            .requiring(scope, ConstraintKind::InFrame(ids.clone(), share))
            .requiring(Scope::Any, ConstraintKind::InFrame(ids, 0.8));
        segment = require_visible(segment, &target, Scope::All);
    } else if keeps_picture(context, direction, &target) {
        segment = segment.requiring(Scope::All, ConstraintKind::Centered(target.clone(), PICTURE_EDGE));
    }
    segments.push(context.constrained_at_end(context.constrained_at_start(segment)));
    segments
}

/// Distance from the frame's middle up to which a thing is in the picture, in frame heights or widths.
const PICTURE_EDGE: f64 = 0.4;

/// Whether a rise or a descent keeps the thing in the picture that the step before shows: nothing says how far it goes.
fn keeps_picture(context: &StepContext, direction: TravelDirection, target: &Target) -> bool {
    direction.is_vertical()
        && context.before.is_some()
        && context.step.amount.is_none()
        && context.step.end == Framing::default()
        && context.step.via.is_none()
        && !target.ids.is_empty()
}

/// The first camera of a descent that would end in the floor of a room: raised so that it ends above it, and aimed at
/// its target again.
fn off_the_floor(context: &StepContext, first: &CameraState, (target, way): (&Target, DVec3)) -> CameraState {
    let world = context.world;
    let lowest = world.height_above_floor(first.pose.position + way);
    let lift = LYING_RADII * world.camera_radius - lowest;
    if !world.is_indoor() || lift <= 0.0 {
        return *first;
    }
    let raised = moved(first, world.frame.up * lift);
    if target.ids.is_empty() { raised } else { aimed(world, &raised, target.aim) }
}

/// The first camera of a slide under or through an object: shifted so that the middle of the slide is the gate.
fn through_gate(context: &StepContext, first: &CameraState, way: DVec3) -> CameraState {
    let via = context.step.via.as_ref().filter(|via| matches!(via.how, Pass::Under | Pass::Through));
    match via.filter(|_| context.before.is_none()).and_then(|via| gate(context, via)) {
        Some(gate) => moved(first, gate - first.pose.position - way / 2.0),
        None => *first,
    }
}

/// Travel of a pedestal that ends at a stated height; `None` where no height is stated, or it lies the other way.
fn rise_to_height(context: &StepContext, direction: TravelDirection, first: &CameraState) -> Option<f64> {
    let height = context.step.end.height.filter(|_| direction.is_vertical())?;
    let rise = height - context.world.height_above_floor(first.pose.position);
    let way = if direction == TravelDirection::Up { rise } else { -rise };
    (way > 0.0).then_some(way)
}

/// The camera lowered toward the height of its target, where a pedestal starts with a nearly level view axis.
fn leveled(context: &StepContext, state: &CameraState, target: &Target) -> CameraState {
    let frame = &context.world.frame;
    let fall = frame.height(state.pose.position - target.aim) * lerp((1.0, 0.4), context.parameters[7]);
    let lowered = moved(state, -frame.up * fall);
    aimed(context.world, &lowered, target.aim)
}

/// Length of a slide with a free end.
fn free_slide_length(
    context: &StepContext,
    target: &Target,
    state: &CameraState,
    along: impl Fn(&CameraState) -> DVec3,
    distance: f64,
) -> f64 {
    let axis = along(state);
    let reach = target.corners.iter().map(|c| (*c - target.aim).dot(axis).abs()).fold(0.0, f64::max);
    match context.step.amount {
        Some(Amount::Units(units)) => units,
        Some(Amount::Slight) => 0.12 * distance,
        Some(Amount::Large) => 0.9 * distance,
        _ => lerp((0.55, 1.0), context.parameters[6]) * distance.max(0.8 * reach),
    }
}

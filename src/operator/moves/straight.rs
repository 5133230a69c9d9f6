//! Moves along a straight line across the view, without a turn: truck, pedestal.

use glam::DVec3;

use super::context::{NORMAL_LENS_DEG, StepContext, require_visible};
use super::passes::gate;
use super::standing_view::stands;
use super::turns::is_along;
use crate::composition::span;
use crate::constraint::{ConstraintKind, Scope, TravelDirection};
use crate::framing::{Target, bearing_of, distance_for, frame_position};
use crate::motion::MotionSegment;
use crate::program::{Amount, Framing, Pass, SubjectPart};
use crate::view::{LYING_RADII, aimed, fill_in, lerp, moved};
use cinesplat_trajectory::{CameraState, Move};

/// Slides sideways, past or along a subject.
pub(super) fn truck(context: &StepContext) -> Vec<MotionSegment> {
    let sign = context.sign(if context.step.movement == Move::TruckLeft { -1.0 } else { 1.0 });
    let along = |state: &CameraState| state.pose.right() * sign;
    let direction = if sign > 0.0 { TravelDirection::Right } else { TravelDirection::Left };
    slide(context, direction, along, |context, target, state| {
        let right = state.pose.right() * sign;
        frame_depth(context, state, target.aim)
            .map(|_| (target.aim - state.pose.position).dot(right))
            .map(|way| way + (end_of(target, context.step.end.part, state) - target.aim).dot(right))
    })
}

/// The segment of a slide that begins with one target in the middle and ends with another, or with the ends of the same.
fn between_ends(context: &StepContext, mut segment: MotionSegment, target: &Target) -> MotionSegment {
    let first = segment.states[0];
    let at = |target: &Target, part: SubjectPart| match part {
        SubjectPart::Left | SubjectPart::Right if is_along(context) => {
            one_at(context, Target { aim: end_of(target, part, &first), ..target.clone() })
        }
        _ => target.clone(),
    };
    let opening = at(target, context.step.start.part);
    segment = segment.requiring(Scope::Start, ConstraintKind::Centered(opening.clone(), 0.22));
    if let Some(end) = &context.end {
        let ending = at(end, context.step.end.part);
        segment = segment.requiring(Scope::End, ConstraintKind::Centered(ending.clone(), 0.2));
        segment = require_visible(segment, &ending, Scope::End);
    }
    require_visible(segment, &opening, Scope::Start)
}

/// A point near the left or the right end of a target, as a camera sees it; the target's aim for other parts.
fn end_of(target: &Target, part: SubjectPart, state: &CameraState) -> DVec3 {
    let toward = match part {
        SubjectPart::Left => -state.pose.right(),
        SubjectPart::Right => state.pose.right(),
        _ => return target.aim,
    };
    let half = target.corners.iter().map(|c| (*c - target.aim).dot(toward)).fold(0.0, f64::max);
    target.aim + toward * (NEAR_END * half)
}

/// The first camera of a slide from one end of a target to the other: square before its middle, and then aside to the end.
fn before_end(context: &StepContext, target: &Target) -> CameraState {
    let part = context.step.start.part;
    let framing = Framing { part: SubjectPart::Middle, ..context.opening_framing() };
    let middle = context.view(target, &framing, ALONG_SLIDE_FILL, NORMAL_LENS_DEG);
    let right = middle.pose.right();
    moved(&middle, right * (end_of(target, part, &middle) - target.aim).dot(right))
}

/// A target of the one of its subjects that is nearest to its aim, where it has several.
fn one_at(context: &StepContext, target: Target) -> Target {
    let away = |id: &u32| context.world.subject(*id).map_or(f64::INFINITY, |thing| thing.center.distance(target.aim));
    let nearest = target.ids.iter().copied().min_by(|a, b| away(a).total_cmp(&away(b)));
    Target { ids: nearest.into_iter().collect(), ..target }
}

/// Distance from the middle of a target to where its left or right end is looked at, over half its length.
const NEAR_END: f64 = 0.75;

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
    // What is to be gone from the frame at the end is nothing to slide to.
    let leaves = context.step.end.hidden;
    let travels = context.end.is_some() && !same && !leaves && (context.start.is_some() || context.before.is_some());
    let target =
        if travels { context.opening_target() } else { passed.clone().unwrap_or_else(|| context.main_target()) };
    let (mut segments, mut first) = match (&context.before, &context.start) {
        (Some(before), None) => (Vec::new(), *before),
        (None, _) if is_along(context) => (Vec::new(), before_end(context, &target)),
        _ => context.opened_on(&target, if is_along(context) { ALONG_SLIDE_FILL } else { SLIDE_FILL }),
    };
    let placed = context.before.is_some() || stands(&context.standing());
    if !placed && direction.is_vertical() && context.step.start.angle.is_none() && !target.ids.is_empty() {
        first = leveled(context, &first, &target);
    }
    if travels && !direction.is_vertical() && context.parameters[7] < HOLDING_TO {
        let held = holding(context, &first, [Some(&target), context.end.as_ref(), passed.as_ref()]);
        if held != first {
            match (segments.last_mut(), context.before) {
                (Some(join), _) => *join = context.join(join.states[0], held),
                (None, Some(before)) => segments.push(context.join(before, held)),
                (None, None) => {}
            }
            first = held;
        }
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
    let sized = context.end.as_ref().filter(|_| travels && !direction.is_vertical());
    let last = sized.map_or(last, |end| resized(context, &last, end, way));
    let risen = context.end.as_ref().filter(|_| travels && direction.is_vertical());
    let last = risen.map_or(last, |end| before_goal(&last, end, way));
    let mut segment = context.segment(vec![first, last]);
    let slight = matches!(context.step.amount, Some(Amount::Slight | Amount::Units(_)))
        || !travels && keeps_picture(context, direction, &target);
    segment =
        segment.requiring(Scope::All, ConstraintKind::Travel(direction, target.aim, if slight { 0.02 } else { 0.24 }));
    if travels {
        segment = between_ends(context, segment, &target);
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

/// Way to the side by which a rise or a descent comes before its goal at most, over its length: it stays a way up or down.
const MOST_ASIDE: f64 = 0.35;

/// The last camera of a rise or a descent, moved to the side so that the thing to which it leads is in the middle.
fn before_goal(last: &CameraState, end: &Target, way: f64) -> CameraState {
    let right = last.pose.right();
    let aside = (end.aim - last.pose.position).dot(right);
    if aside.abs() <= MOST_ASIDE * way.abs() { moved(last, right * aside) } else { *last }
}

/// The last camera of a slide, nearer or farther where the words state another size for its end; it stays a slide.
fn resized(context: &StepContext, last: &CameraState, end: &Target, way: f64) -> CameraState {
    let Some(fill) = fill_in(context.world, &context.step.end, context.parameters[6]) else { return *last };
    let away = end.aim - last.pose.position;
    let bearing = bearing_of(context.world, end.aim, last.pose.position);
    let wanted = distance_for(context.world, end, bearing, fill, last.fov_y_rad);
    let nearer = away.dot(last.pose.forward()) - wanted;
    let most = MOST_NEARER * way.abs();
    moved(last, last.pose.forward() * nearer.clamp(-most, most))
}

/// Farthest that a slide nears or leaves its end, over its length.
const MOST_NEARER: f64 = 0.8;

/// Value of parameter 7 up to which a slide steps back for what it leads past: there may be no room for that.
const HOLDING_TO: f64 = 0.6;
/// Height in the frame that things take up at most which a slide leads past.
const MOST_PASSED: f64 = 0.86;
/// Farthest that a slide steps back for them, over its distance.
const MOST_BACK: f64 = 2.5;

/// The first camera of a slide, farther back and higher or lower where a thing on the way would lose its head. A stated size
/// or height stays.
fn holding(context: &StepContext, first: &CameraState, shown: [Option<&Target>; 3]) -> CameraState {
    let ends = [&context.step.start, &context.step.end];
    let is_sized = |framing: &&Framing| {
        framing.size.is_some()
            || framing.height_frac.is_some()
            || framing.height.is_some()
            || framing.distance.is_some()
    };
    let frame = &context.world.frame;
    if !context.world.is_indoor() || ends.iter().any(is_sized) {
        return *first;
    }
    let forward = frame.horizontal(first.pose.forward()).normalize_or_zero();
    let shown = || shown.into_iter().flatten();
    let corners = || shown().flat_map(|target| &target.corners);
    let depth = |corner: &DVec3| (*corner - first.pose.position).dot(forward);
    if shown().any(|target| target.radius > LARGE_FRAC * context.world.bounds.size()) {
        return *first;
    }
    let nearest = corners().map(depth).fold(f64::INFINITY, f64::min);
    let (low, high) = span(corners().map(|corner| frame.height(*corner)));
    let needed = (high - low) / (2.0 * (first.fov_y_rad / 2.0).tan() * MOST_PASSED);
    if nearest <= 0.0 || needed > (1.0 + MOST_BACK) * nearest {
        return *first;
    }
    let depth = needed.max(nearest);
    // What the view axis meets at the depth of the things is to be at the middle of their height, if they do not fit as it is.
    let slope = frame.height(first.pose.forward()) / frame.horizontal(first.pose.forward()).length().max(1e-9);
    let axis = frame.height(first.pose.position) + slope * depth;
    let half = depth * (first.fov_y_rad / 2.0).tan() * MOST_PASSED;
    let lift = (high - (axis + half)).max(0.0) + (low - (axis - half)).min(0.0);
    moved(first, forward * (nearest - depth) + frame.up * lift)
}

/// Radius of a thing over the scene size from which on it is part of the room, which no picture has to hold.
const LARGE_FRAC: f64 = 0.15;

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
        _ => {
            // After another move it keeps in the picture what that showed.
            let keeps = context.before.is_some() && !context.step.end.hidden;
            lerp(if keeps { (0.3, 0.55) } else { (0.55, 1.0) }, context.parameters[6]) * distance.max(0.8 * reach)
        }
    }
}

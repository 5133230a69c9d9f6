//! Moves along the line to a subject: push in and pull out.

use super::context::{NORMAL_LENS_DEG, StepContext, is_stated, require_visible};
use super::dolly_length::{LARGEST_OPEN_RATIO, LEAST_RATIO, WALL_RADII, distance_ratio};
use super::room_view::room_target;
use super::standing_view::stands;
use crate::constraint::{ConstraintKind, Scope};
use crate::framing::{Target, in_frame_frac};
use crate::motion::MotionSegment;
use crate::pictures::{blocked_by_others_frac, void_frac};
use crate::program::{Amount, Framing, Motion};
use crate::view::{aimed, lerp, moved, with_fov};
use cinesplat_trajectory::{CameraState, Move};

/// Moves along the line to the subject, toward it or away from it.
pub(super) fn dolly(context: &StepContext) -> Vec<MotionSegment> {
    let inward = (context.step.movement == Move::PushIn) != (context.step.either_way && context.parameters[5] < 0.5);
    let target =
        if inward { context.main_target() } else { context.start.clone().unwrap_or_else(|| pulled_from(context)) };
    let fill = match (inward, context.world.is_indoor()) {
        (true, true) => (0.24, 0.45),
        (true, false) => LONE_START,
        // What is to be seen whole at the end is not at the start.
        (false, false) if shows_all(context, &target) => CROPPED_FILL,
        (false, _) => (0.6, 0.95),
    };
    if let Some(start) = from_another(context, &target, inward) {
        return vec![push_from(context, &start, &target, fill)];
    }
    let (mut segments, first) = if context.before.is_none()
        && context.step.start.size.is_none()
        && !context.step.start.whole
        && !stands(&context.standing())
    {
        let first = open_first(context, &target, inward, fill);
        (Vec::new(), if context.backs_to_room() { with_room_behind(context, &target, first) } else { first })
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
    let last = if inward { before_matter(context, &target, &first, last) } else { last };
    let (first, last) = within_capture(context, &target, (first, last), inward);
    let taken_in = takes_in(context, inward);
    let last = taken_in.map_or(last, |end| settled_on(context, [&first, &last], &target, end));
    let (last, is_lowered) =
        if inward || taken_in.is_some() { (last, false) } else { lowered_to_room(context, &target, last) };
    let segment = context.segment(vec![first, last]);
    let wanted = if inward { (0.0, 0.76) } else { (1.32, f64::INFINITY) };
    let subtle = matches!(context.step.amount, Some(Amount::Slight | Amount::Units(_) | Amount::Factor(_)));
    let segment =
        if subtle { segment } else { segment.requiring(Scope::All, ConstraintKind::DistanceRatio(target.aim, wanted)) };
    let segment = match taken_in {
        Some(end) => segment.requiring(Scope::End, ConstraintKind::Centered(end.clone(), 0.2)),
        None if is_lowered => segment.requiring(Scope::Start, ConstraintKind::Centered(target.clone(), 0.17)),
        None => segment.requiring(Scope::All, ConstraintKind::Centered(target.clone(), 0.17)),
    };
    let segment = context.constrained_in_pitch(segment);
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

/// The first picture of a film that goes in on one thing from another picture: from a group that it belongs to, from another
/// thing, or from the room. `None` where it goes in on what it shows first.
fn from_another(context: &StepContext, target: &Target, inward: bool) -> Option<Target> {
    let start = &context.step.start;
    if inward && context.opens_on_room() && !target.ids.is_empty() && context.parameters[5] < MOST_FROM_ROOM {
        return room_target(context.world, context.parameters).filter(|_| !stands(&context.standing()));
    }
    let is_other = start.subjects != context.step.end.subjects && !context.step.end.subjects.is_empty();
    if !inward || !is_other || context.before.is_some() || stands(&context.standing()) || target.ids.is_empty() {
        return None;
    }
    Target::of(context.world, &Framing { whole: start.whole || start.subjects.len() > 1, ..start.clone() })
}

/// Value of parameter 5 up to which a film that begins with the room as a whole begins where people stand; it begins far from
/// what it goes in on otherwise.
const MOST_FROM_ROOM: f64 = 0.7;

/// Share of what a film goes in on that the picture of the room shows.
const SHOWN_IN_ROOM: f64 = 0.6;

/// Goes in on a target from a picture of something else, and turns to it on the way.
fn push_from(context: &StepContext, start: &Target, target: &Target, fill: (f64, f64)) -> MotionSegment {
    let opening = context.opening_framing();
    let framing = Framing { whole: opening.whole || start.ids.len() > 1, ..opening };
    let first = context.view(start, &framing, fill, NORMAL_LENS_DEG);
    let ratio = distance_ratio(context, target, &first, true);
    let way = (target.aim - first.pose.position) * (1.0 - ratio);
    let last = aimed(context.world, &moved(&first, way), target.aim);
    let segment = context
        .segment(vec![first, last])
        .requiring(Scope::Start, ConstraintKind::Centered(start.clone(), 0.2))
        .requiring(Scope::End, ConstraintKind::Centered(target.clone(), 0.2));
    let segment = if start.ids.is_empty() {
        segment.requiring(Scope::Start, ConstraintKind::InFrame(target.ids.clone(), SHOWN_IN_ROOM))
    } else {
        segment
    };
    let segment = if context.step.amount.is_some() {
        segment
    } else {
        segment.requiring(Scope::All, ConstraintKind::DistanceRatio(target.aim, (0.0, 0.76)))
    };
    let segment = context.constrained_at_end(context.constrained_at_start(segment));
    require_visible(require_visible(segment, start, Scope::Start), target, Scope::End)
}

/// The first camera of a pull-out to the room, on the side of its subject from which the way back is longest.
fn with_room_behind(context: &StepContext, target: &Target, first: CameraState) -> CameraState {
    let world = context.world;
    if context.parameters[5] > MOST_BACKED {
        return first;
    }
    let swung = |i: i32| {
        let position = world.frame.swung(target.aim, first.pose.position, -f64::from(i) * BACKING_STEP_RAD);
        aimed(world, &moved(&first, position - first.pose.position), target.aim)
    };
    let is_free = |state: &CameraState| {
        let to = state.pose.position - target.aim;
        let from = target.aim + to.normalize_or_zero() * target.radius;
        world.hit_distance(from, to.normalize_or_zero()).is_none_or(|hit| hit + target.radius > to.length())
    };
    let behind = |state: &CameraState| {
        let back = -state.pose.forward();
        world.hit_distance(state.pose.position, back).filter(|_| is_free(state)).unwrap_or(0.0)
    };
    let sides = (-NUM_BACKING..=NUM_BACKING).map(swung);
    sides.max_by(|a, b| behind(a).total_cmp(&behind(b))).unwrap_or(first)
}

/// Value of parameter 5 up to which a pull-out to the room looks for the longest way back, the angle between the sides that it
/// compares, radians, and how many there are on each hand.
const MOST_BACKED: f64 = 0.7;
const BACKING_STEP_RAD: f64 = 0.22;
const NUM_BACKING: i32 = 5;

/// What a pull-out goes back to take in: the whole of another thing than it sets out from, of several things, or of the thing of
/// which the step before showed a part.
fn takes_in<'a>(context: &'a StepContext, inward: bool) -> Option<&'a Target> {
    let end = context.end.as_ref().filter(|_| !inward && context.step.end.whole)?;
    let start = context.start.as_ref();
    let is_other = start.is_some_and(|start| start.ids != end.ids) || start.is_none() && context.before.is_some();
    let left = start.or(context.earlier.as_ref()).and_then(|left| left.ids.first());
    let is_with_others = end.ids.len() > 1;
    (is_other && left.is_none_or(|left| is_with_others || !end.ids.contains(left))).then_some(end)
}

/// The end of a pull-out with its aim on what it takes in, as far as a camera that backs away turns; farther back where that
/// is not in the picture.
fn settled_on(context: &StepContext, [first, last]: [&CameraState; 2], left: &Target, end: &Target) -> CameraState {
    let turned = |state: &CameraState| aimed(context.world, state, end.aim);
    let turn_rad = turned(last).pose.forward().angle_between(last.pose.forward());
    if turn_rad > MOST_SETTLING_RAD || context.forbids_turning() {
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

/// The end of a pull-out to the room from something high on a wall: it tilts down as far as that stays in the picture, so that
/// the room is seen, and not the wall. Whether it does.
fn lowered_to_room(context: &StepContext, left: &Target, last: CameraState) -> (CameraState, bool) {
    let world = context.world;
    let height = world.height_above_floor(left.aim);
    let goal = ROOM_AIM_EYES * world.eye_height();
    if !context.backs_to_room() || height <= world.eye_height() * HIGH_EYES || context.forbids_turning() {
        return (last, false);
    }
    let lowered = |i: u32| {
        let share = 1.0 - f64::from(i) / 10.0;
        aimed(world, &last, left.aim - world.frame.up * ((height - goal) * share))
    };
    let holds = |state: &CameraState| in_frame_frac(world, state, &left.corners, 0.04) >= 1.0;
    (0..10).map(lowered).find(holds).map_or((last, false), |view| (view, true))
}

/// Height above the floor at which the picture of a room is aimed, and from which on a thing is high, over that of a standing
/// person's eyes.
const ROOM_AIM_EYES: f64 = 0.55;
const HIGH_EYES: f64 = 0.85;

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
/// Widest lens of a pull-out that ends before the wall behind the camera.
const WIDEST_DEG: f64 = 78.0;

/// Void of the far end of a way in or out from which on the way is shortened, and the parts in which that is done.
const LEAST_VOID: f64 = 0.08;
const NUM_SHORTENED: i32 = 10;
/// Void of the shortened way, over that of the whole one, from which on it is worth it.
const LESS_VOID: f64 = 0.8;
/// Least change of the distance that is left of such a way, nearer over farther.
const SHORTENED_RATIO: f64 = 0.73;

/// The ends of a way in a room, the far one brought nearer where it would show what was never captured: as much of the way as
/// needed, while the way stays one. Stated ends and amounts stay.
fn within_capture(
    context: &StepContext,
    target: &Target,
    (first, last): (CameraState, CameraState),
    inward: bool,
) -> (CameraState, CameraState) {
    let (far, near) = if inward { (first, last) } else { (last, first) };
    let framing = if inward { &context.step.start } else { &context.step.end };
    let is_open =
        !is_stated(framing) && context.step.amount.is_none() && context.step.via.is_none() && !target.ids.is_empty();
    if !is_open || !context.world.is_indoor() || (inward && context.before.is_some()) {
        return (first, last);
    }
    let void = void_frac(context.world, &far);
    let distance = |state: &CameraState| state.pose.position.distance(target.aim);
    let zooms = (far.fov_y_rad - near.fov_y_rad).abs() > 1e-9;
    if void < LEAST_VOID || zooms {
        return (first, last);
    }
    let way = near.pose.position - far.pose.position;
    let nearer = |i: i32| moved(&far, way * (f64::from(i) / f64::from(NUM_SHORTENED)));
    let is_way = |state: &CameraState| distance(&near) <= SHORTENED_RATIO * distance(state);
    let (mut least, mut fullest) = (LESS_VOID * void, far);
    for state in (1..NUM_SHORTENED).map(nearer).filter(is_way) {
        let void = void_frac(context.world, &state);
        if void < least.max(LEAST_VOID) {
            (least, fullest) = (void, state);
        }
        if void < LEAST_VOID {
            break;
        }
    }
    if inward { (fullest, last) } else { (first, fullest) }
}

/// Share of a picture that matter before the subject takes close to the lens from which on a way in stops sooner, and the shares
/// of the way that it tries then.
const MOST_BLOCKED: f64 = 0.12;
const SHARES_BEFORE: [f64; 4] = [0.88, 0.76, 0.64, 0.52];

/// The end of a way in whose end the words leave open, before what stands in front of its subject: a bench at the foot of a bed
/// would fill the picture.
fn before_matter(context: &StepContext, target: &Target, first: &CameraState, last: CameraState) -> CameraState {
    let end = &context.step.end;
    let is_sized = end.size.is_some() || end.height_frac.is_some() || end.distance.is_some() || end.whole;
    if is_sized || context.step.amount.is_some() || !context.world.is_indoor() || target.ids.is_empty() {
        return last;
    }
    let is_blocked = |state: &CameraState| blocked_by_others_frac(context.world, &target.ids, state) > MOST_BLOCKED;
    if !is_blocked(&last) {
        return last;
    }
    let distance = |state: &CameraState| state.pose.position.distance(target.aim);
    let way = last.pose.position - first.pose.position;
    let sooner = SHARES_BEFORE.iter().map(|share| moved(&last, way * (share - 1.0)));
    let is_way = |state: &CameraState| distance(state) <= LARGEST_OPEN_RATIO * distance(first);
    sooner.filter(is_way).find(|state| !is_blocked(state)).unwrap_or(last)
}

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

/// Size in the frame of a lone thing of which a pull-out begins to show all.
const CROPPED_FILL: (f64, f64) = (1.7, 2.4);

/// Whether a pull-out leads to all of its own subject.
fn shows_all(context: &StepContext, target: &Target) -> bool {
    let end = &context.step.end;
    end.whole && !target.ids.is_empty() && (end.subjects.is_empty() || end.subjects == target.ids)
}

/// Size from which a camera goes in on a lone thing, before the factor of such things.
const LONE_START: (f64, f64) = (0.3, 0.42);

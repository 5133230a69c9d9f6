//! Turns of a camera that stays in place: pan, tilt, roll.

use glam::DVec3;

use super::context::{NORMAL_LENS_DEG, StepContext, is_stated, require_visible};
use super::overlook::overlook;
use super::room_view::amid_room;
use super::standing_view::stands;
use crate::constraint::{Constraint, ConstraintKind, Scope};
use crate::framing::Target;
use crate::motion::MotionSegment;
use crate::program::{Amount, Framing, Motion, SubjectPart};
use crate::view::{aimed, aimed_at_side, lerp, moved, with_fov};
use cinesplat_geometry::{LevelAngles, Pose, rotation};
use cinesplat_trajectory::{CameraState, Move, ShotAngle};

/// Range of the turn of a pan with a free end, and of a tilt, degrees.
const OPEN_PAN_DEG: (f64, f64) = (44.0, 84.0);
const OPEN_TILT_DEG: (f64, f64) = (24.0, 42.0);

/// Change of pitch that a pan may have before its ends are brought nearer to one pitch.
const LEVEL_PAN_RAD: f64 = 0.1;
/// Largest shift of a pan's subject from the middle of its picture, over the height of the picture.
const LEVELED_FRAC: f64 = 0.11;

/// Turns about the world's up, from one subject to another or by an angle.
pub(super) fn pan(context: &StepContext) -> Vec<MotionSegment> {
    let whip = context.step.movement == Move::WhipPan;
    let direction =
        if whip { context.step.with.first().copied().unwrap_or(Move::WhipPan) } else { context.step.movement };
    let named = if direction == Move::PanLeft { -1.0 } else { 1.0 };
    let sign = context.sign(named);
    turn(
        context,
        sign,
        whip,
        |state, angle_rad| turned(context, state, angle_rad * sign, 0.0),
        |yaw| (ConstraintKind::YawChange(yaw), ConstraintKind::PitchChange((-10.0, 10.0))),
    )
}

/// Turns up or down, from one subject to another or by an angle.
pub(super) fn tilt(context: &StepContext) -> Vec<MotionSegment> {
    let named = if context.step.movement == Move::TiltDown { -1.0 } else { 1.0 };
    let sign = context.sign(named);
    turn(
        context,
        sign,
        false,
        |state, angle_rad| turned(context, state, 0.0, angle_rad * sign),
        |pitch| (ConstraintKind::PitchChange(pitch), ConstraintKind::YawChange((-9.0, 9.0))),
    )
}

/// Range of a signed quantity whose magnitude is between two numbers.
fn band(sign: f64, least: f64, most: f64) -> (f64, f64) {
    if sign > 0.0 { (least, most) } else { (-most, -least) }
}

/// A camera turned by yaw (to the right) and pitch (up).
fn turned(context: &StepContext, state: &CameraState, yaw_rad: f64, pitch_rad: f64) -> CameraState {
    let frame = &context.world.frame;
    let angles = frame.angles(state.pose.rotation);
    let limit = 1.45;
    let turned = LevelAngles {
        yaw_rad: angles.yaw_rad + yaw_rad,
        pitch_rad: (angles.pitch_rad + pitch_rad).clamp(-limit, limit),
        roll_rad: angles.roll_rad,
    };
    CameraState { pose: Pose { rotation: frame.rotation(turned), ..state.pose }, ..*state }
}

/// A turn in place. `by` turns a camera by an angle in the step's direction; `limits` gives the constraints along and
/// across the turn for a range of signed degrees.
fn turn(
    context: &StepContext,
    sign: f64,
    whip: bool,
    by: impl Fn(&CameraState, f64) -> CameraState,
    limits: impl Fn((f64, f64)) -> (ConstraintKind, ConstraintKind),
) -> Vec<MotionSegment> {
    let tilts = matches!(context.step.movement, Move::TiltUp | Move::TiltDown);
    let open_deg = if tilts { OPEN_TILT_DEG } else { OPEN_PAN_DEG };
    let open_rad = lerp(open_deg, context.parameters[6]).to_radians();
    let stated_rad = match context.step.amount {
        Some(Amount::Degrees(degrees)) => Some(degrees.to_radians()),
        Some(Amount::Factor(turns)) if !tilts => Some(turns * std::f64::consts::TAU),
        Some(Amount::Slight) => Some(14.0_f64.to_radians()),
        Some(Amount::Large) => Some(75.0_f64.to_radians()),
        _ => None,
    };
    let angle_rad = stated_rad.unwrap_or(open_rad);
    let is_free = context.start.is_none() && context.before.is_none();
    let goes_to_end = stated_rad.is_none() || is_between(context) || is_free;
    let (mut segments, first, last) = match &context.end {
        Some(end) if goes_to_end => onto(context, end, |state| by(state, -angle_rad)),
        _ => {
            let target = context.opening_target();
            let (segments, first) = context.opened_on(&target, (0.3, 0.6));
            let is_amid = is_free && !tilts && angle_rad > ALL_ROUND_RAD && context.world.is_indoor();
            let is_open = is_amid && target.ids.is_empty() && !stands(&context.standing());
            let first = if is_open { amid_room(context.world, &first) } else { first };
            let last = by(&first, angle_rad);
            (segments, first, last)
        }
    };
    let is_pinned = context.before.is_some() || !segments.is_empty() || stated_rad.is_some();
    let (first, last) = if tilts { (first, last) } else { leveled(context, [first, last], is_pinned) };
    // Half a turn and more is no shortest way from the first camera to the last.
    let wide_rad = stated_rad.filter(|angle_rad| !tilts && !is_between(context) && *angle_rad > WIDE_TURN_RAD);
    let states = match wide_rad {
        Some(angle_rad) => {
            let count = (angle_rad / WIDE_TURN_RAD).ceil();
            (0..=count as usize).map(|i| by(&first, angle_rad * i as f64 / count)).collect()
        }
        None => vec![first, last],
    };
    let mut segment = context.segment(states);
    // A whip goes to its goal, whichever way that is, unless the words name one.
    let names_way = context.step.with.iter().any(|other| matches!(other, Move::PanLeft | Move::PanRight));
    let is_open = whip && (context.step.either_way || (context.end.is_some() && !names_way));
    if !is_open {
        // Between two subjects a stated angle is one to look for a place for.
        let sought = match context.step.amount {
            Some(Amount::Degrees(degrees)) if is_between(context) => Some(degrees),
            _ => wide_rad.map(f64::to_degrees),
        };
        let (least, most) = sought.map_or(if tilts { TILT_RANGE_DEG } else { PAN_RANGE_DEG }, |degrees| {
            ((1.0 - ANGLE_TOLERANCE) * degrees, (1.0 + ANGLE_TOLERANCE) * degrees)
        });
        let (along, across) = limits(band(sign, least, most));
        let is_slight = angle_rad < 0.3 && stated_rad.is_some() && sought.is_none();
        let along = Some(along).filter(|_| !is_slight);
        segment.constraints.extend(along.map(|kind| Constraint { kind, scope: Scope::All }));
        segment = segment.requiring(Scope::All, across);
    }
    segment = context.constrained_at_end(context.constrained_at_start(segment));
    if let Some(start) = &context.start {
        segment = require_visible(segment, start, Scope::Start);
    }
    if let Some(end) = &context.end {
        segment = require_visible(segment, end, Scope::End);
    }
    segments.push(segment);
    segments
}

/// Angle of a pan that is one all the way round.
const ALL_ROUND_RAD: f64 = 5.2;
/// Angle of a pan from which on it passes through cameras between its ends.
const WIDE_TURN_RAD: f64 = 2.0;
/// Least and largest turn of a pan and of a tilt, degrees.
const PAN_RANGE_DEG: (f64, f64) = (13.0, 178.0);
const TILT_RANGE_DEG: (f64, f64) = (10.0, 120.0);
/// Tolerance of a stated angle between two subjects, over the angle.
const ANGLE_TOLERANCE: f64 = 0.12;

/// Whether a turn leads from one subject to another.
fn is_between(context: &StepContext) -> bool {
    matches!((&context.start, &context.end), (Some(start), Some(end)) if start.ids != end.ids)
}

/// The ends of a pan, brought nearer to one pitch where its subjects are at different heights: each may stand a little
/// above or below the middle of its picture. The first end stays where it `is_pinned`.
fn leveled(context: &StepContext, [first, last]: [CameraState; 2], is_pinned: bool) -> (CameraState, CameraState) {
    let pitch = |state: &CameraState| context.world.frame.angles(state.pose.rotation).pitch_rad;
    let climb_rad = pitch(&last) - pitch(&first);
    // Where the words rule out tilts, the pitch stays.
    let is_level = context.forbidden.contains(&Motion::Tilt);
    let excess_rad = if is_level { climb_rad.abs() } else { (climb_rad.abs() - LEVEL_PAN_RAD).max(0.0) };
    let most_rad = if is_level { excess_rad } else { LEVELED_FRAC * first.fov_y_rad.min(last.fov_y_rad) };
    let share = if is_pinned { 1.0 } else { 0.5 };
    let by_rad = (share * excess_rad).min(most_rad).copysign(climb_rad);
    let first = if is_pinned { first } else { turned(context, &first, 0.0, by_rad) };
    (first, turned(context, &last, 0.0, -by_rad))
}

/// A turn that ends on a target: from the start target, from the camera before, or from a view turned away from the
/// target.
fn onto(
    context: &StepContext,
    end: &Target,
    away: impl Fn(&CameraState) -> CameraState,
) -> (Vec<MotionSegment>, CameraState, CameraState) {
    let (segments, first) = match (&context.start, &context.before) {
        (None, Some(before)) => (Vec::new(), *before),
        (Some(start), None) => (Vec::new(), opened_on_either(context, start, end)),
        (Some(start), Some(_)) => context.opened_on(start, OPEN_FILL),
        (None, None) => {
            let view = context.view(end, &context.step.end, (0.3, 0.6), NORMAL_LENS_DEG);
            (Vec::new(), away(&view))
        }
    };
    let whole = aimed(context.world, &first, end.aim);
    let last = match context.step.end.part {
        SubjectPart::Left | SubjectPart::Right => aimed_at_side(context.world, end, context.step.end.part, whole),
        _ => whole,
    };
    (segments, first, last)
}

/// Size of the subject from which a pan or tilt starts.
const OPEN_FILL: (f64, f64) = (0.32, 0.66);

/// The first camera of a turn between two subjects: at a place with a view of the first one, or of a whip, whose goal is
/// what counts, at one with a view of the second one; from [`OVERLOOK_FROM`] on where somebody stands in the room. What
/// stands behind other things is seen from few places. Parameter 7 chooses.
fn opened_on_either(context: &StepContext, start: &Target, end: &Target) -> CameraState {
    if start.ids == end.ids && is_along(context) {
        let fill = if context.world.is_indoor() { ALONG_FILL } else { ALONG_LONE_FILL };
        let view = context.view(start, &context.opening_framing(), fill, NORMAL_LENS_DEG);
        let start_framing = &context.step.start;
        let is_placed = start_framing.height.or(start_framing.elevation_deg).is_some() || start_framing.angle.is_some();
        return if is_placed || stands(&context.standing()) {
            view
        } else {
            between_heights(context, &view, [start, end])
        };
    }
    if let Some(view) = before_both(context, [start, end]) {
        return view;
    }
    let whip = context.step.movement == Move::WhipPan;
    let stated = [&context.step.start, &context.step.end].map(is_stated);
    let choice = context.parameters[7];
    // A tilt needs a place in one line with both subjects, which few of these are.
    let tilts = matches!(context.step.movement, Move::TiltUp | Move::TiltDown);
    let least = if tilts { OVERLOOK_TILT_FROM } else { OVERLOOK_FROM };
    let is_free = stated == [false; 2] && !stands(&context.standing());
    let overlooking = if choice > least && is_free { overlook(context, [start, end]) } else { None };
    if let Some(camera) = overlooking {
        return camera;
    }
    if !whip || stated[0] || choice <= OVERLOOK_FROM / 2.0 {
        return context.view(start, &context.opening_framing(), OPEN_FILL, NORMAL_LENS_DEG);
    }
    let place = context.view(end, &context.step.end, OPEN_FILL, NORMAL_LENS_DEG);
    aimed(context.world, &place, start.aim)
}

/// Distance aside of two things, over their difference of height, up to which one is above the other; the height of both
/// together in the frame before which a tilt goes from the one to the other.
const MOST_ASIDE: f64 = 0.5;
const STACKED_FILL: (f64, f64) = (1.1, 1.7);

/// The first camera of a tilt from one thing to another above or below it: straight before both, so near that the way from the
/// one to the other is a turn. `None` for other turns and for stated framings.
fn before_both(context: &StepContext, [start, end]: [&Target; 2]) -> Option<CameraState> {
    let world = context.world;
    let tilts = matches!(context.step.movement, Move::TiltUp | Move::TiltDown);
    let apart = end.aim - start.aim;
    let is_stacked = world.frame.horizontal(apart).length() < MOST_ASIDE * world.frame.height(apart).abs();
    let is_sized = |framing: &Framing| is_stated(&Framing { part: SubjectPart::Middle, ..framing.clone() });
    let stated = is_sized(&context.step.start) || is_sized(&context.step.end) || stands(&context.standing());
    if !tilts || !is_stacked || stated || context.parameters[7] > OVERLOOK_TILT_FROM {
        return None;
    }
    let corners: Vec<DVec3> = start.corners.iter().chain(&end.corners).copied().collect();
    let aim = start.aim.midpoint(end.aim);
    let radius = corners.iter().map(|corner| corner.distance(aim)).fold(0.0, f64::max);
    let both = Target { aim, corners, outline: None, radius, ..start.clone() };
    let view = context.view(&both, &Framing::default(), STACKED_FILL, NORMAL_LENS_DEG);
    Some(aimed(world, &view, start.aim))
}

/// The camera of a view of `start` at the height halfway to `end`, so that it is as near to the one as to the other: from the
/// height of a guitar's body its head is small and seen from below.
fn between_heights(context: &StepContext, view: &CameraState, [start, end]: [&Target; 2]) -> CameraState {
    let frame = &context.world.frame;
    let middle = frame.height(start.aim).midpoint(frame.height(end.aim));
    let lift = middle - frame.height(view.pose.position);
    aimed(context.world, &moved(view, frame.up * lift), start.aim)
}

/// Value of the parameter from which on somebody stands in the room and looks at both subjects: for pans and for tilts.
const OVERLOOK_FROM: f64 = 0.6;
const OVERLOOK_TILT_FROM: f64 = 0.75;
/// Size of a subject along which the view turns, from one end to the other: more than the picture holds.
const ALONG_FILL: (f64, f64) = (1.4, 2.2);
/// The same for a lone thing, around which there is nothing to see.
const ALONG_LONE_FILL: (f64, f64) = (2.0, 2.8);

/// Whether the view turns from one end of a subject to the other.
pub(super) fn is_along(context: &StepContext) -> bool {
    let (start, end) = (&context.step.start, &context.step.end);
    let free = start.size.is_none() && end.size.is_none() && !start.whole && !end.whole;
    free && start.part != end.part && start.part != SubjectPart::Middle && end.part != SubjectPart::Middle
}

/// Turns about the view axis.
pub(super) fn roll(context: &StepContext) -> Vec<MotionSegment> {
    let overhead = context.step.start.angle.or(context.step.end.angle) == Some(ShotAngle::Overhead);
    let (mut segments, first) = match (&context.before, &context.start, &context.end) {
        (Some(before), None, None) => (Vec::new(), *before),
        _ => context.opened_on(&context.main_target(), if overhead { OVERHEAD_FILL } else { (0.4, 0.7) }),
    };
    let first = if overhead && context.before.is_none() { holding_turned(context, first) } else { first };
    let degrees = match context.step.amount {
        Some(Amount::Degrees(degrees)) => degrees,
        Some(Amount::Slight) => 8.0,
        Some(Amount::Large) if overhead => 120.0,
        Some(Amount::Large) => 45.0,
        _ if overhead => lerp(OVERHEAD_ROLL_DEG, context.parameters[6]),
        _ => 20.0,
    };
    let sign = context.sign(if context.step.movement == Move::RollCw { 1.0 } else { -1.0 });
    let count = (degrees / 60.0).ceil().max(1.0) as usize;
    // About the view axis z: positive turns x (right) toward y (down), which is clockwise for the operator.
    let rolled = |i: usize| {
        let angle = sign * degrees.to_radians() * i as f64 / count as f64;
        let pose = Pose::new(first.pose.position, first.pose.rotation * rotation::exp(DVec3::Z * angle));
        CameraState { pose, ..first }
    };
    let segment = context.segment((0..=count).map(rolled).collect());
    segments.push(require_visible(segment, &context.main_target(), Scope::Start));
    segments
}

/// Size of the subject below a camera that turns above it, before the lens is widened: near views are below the lamps.
const OVERHEAD_FILL: (f64, f64) = (0.45, 1.5);
/// Angle of a turn above a subject with a free end, degrees: what lies there is seen from another side.
const OVERHEAD_ROLL_DEG: (f64, f64) = (50.0, 90.0);
/// Widest vertical field of view above a subject, degrees, and the share of the frame's height that the subject takes.
const OVERHEAD_WIDEST_DEG: f64 = 84.0;
const OVERHEAD_HELD: f64 = 0.94;

/// The camera with a lens that holds the whole subject at every turn about the view axis, unless the words state its size.
fn holding_turned(context: &StepContext, view: CameraState) -> CameraState {
    let [start, end] = [&context.step.start, &context.step.end];
    if [start, end]
        .iter()
        .any(|framing| framing.size.is_some() || framing.lens.is_some() || framing.height_frac.is_some())
    {
        return view;
    }
    let off_axis = |corner: &DVec3| {
        let at = view.pose.to_camera(*corner);
        at.x.hypot(at.y) / at.z.max(1e-9)
    };
    let target = context.main_target();
    let reach = target.corners.iter().map(off_axis).fold(0.0, f64::max) / OVERHEAD_HELD;
    let widest = OVERHEAD_WIDEST_DEG.to_radians();
    with_fov(&view, (2.0 * reach.atan()).clamp(view.fov_y_rad.min(widest), widest))
}

//! Pictures at rest: hold and handheld, with what is composed where the words leave it open.

use glam::DVec2;

use super::context::{NORMAL_LENS_DEG, StepContext, is_stated, require_visible};
use super::paths::end_view;
use super::sway::{num_sways, swayed};
use crate::composition::front_azimuth;
use crate::constraint::{ConstraintKind, Scope};
use crate::crowding::stands_free;
use crate::framing::{MANY, Target, extent_frac, frame_position, frame_ray, off_center};
use crate::motion::MotionSegment;
use crate::program::{Framing, Motion, SubjectPart};
use crate::view::aimed;
use cinesplat_trajectory::{CameraState, Easing};

/// Holds a view of the step's target.
pub(super) fn hold(context: &StepContext) -> Vec<MotionSegment> {
    let target = context.main_target();
    let named = context.start.is_some() || context.end.is_some();
    let (mut segments, state) = match &context.before {
        Some(before) if named && is_elsewhere(context, before, &target) => {
            let there = end_view(context, &target, before);
            (vec![context.join(*before, there)], there)
        }
        Some(before) if named && off_center(context.world, before, target.aim) > held_off(context, &target) => {
            context.turned_to(before, target.aim)
        }
        Some(before) => (Vec::new(), *before),
        None => {
            let mut framing = context.step.start.clone();
            // A size without a subject is that of the room, which gives way to a subject with a size.
            let of_room = framing.subjects.is_empty() && !context.step.end.subjects.is_empty();
            framing.size =
                if of_room { context.step.end.size.or(framing.size) } else { framing.size.or(context.step.end.size) };
            framing.angle = framing.angle.or(context.step.end.angle);
            framing.whole |= context.step.end.whole;
            context.inherit(&mut framing);
            let first = target.ids.first().and_then(|id| context.world.subject(*id));
            let is_free_standing = first.is_some_and(|subject| stands_free(context.world, subject));
            // A thing that is all there is fills the picture.
            let fill = match (target.ids.len(), context.is_last) {
                (0, _) => (0.65, 0.88),
                (MANY.., true) => GROUP_FILL,
                (_, true) if is_free_standing => PORTRAIT_FILL,
                _ => (0.45, 0.75),
            };
            let view = context.view(&target, &framing, fill, NORMAL_LENS_DEG);
            let is_free = target.ids.len() <= 1 && is_free(context, &framing);
            let view = if is_free { on_a_third(context, &target, view) } else { view };
            (Vec::new(), if target.ids.len() >= MANY { with_all_amid(context, &target, view) } else { view })
        }
    };
    let natural = match (context.before.is_none(), context.is_last) {
        (true, true) => STILL_SECS,
        (true, false) => OPENING_SECS,
        (false, _) => REST_SECS,
    };
    let mut segment = context.lasting(vec![state, state], natural);
    if context.before.is_none() {
        segment =
            require_visible(context.constrained_at_end(context.constrained_at_start(segment)), &target, Scope::All);
        segment = context.constrained_in_pitch(segment);
        if (off_center(context.world, &state, target.aim) - THIRD).abs() < 1e-4 {
            segment = segment.requiring(Scope::All, ConstraintKind::OnThird(target.clone()));
        }
    }
    segments.push(segment);
    segments
}

/// Size in the frame of what a film holds from its start to its end and nothing else: of a thing, and of many.
const PORTRAIT_FILL: (f64, f64) = (0.58, 0.78);
const GROUP_FILL: (f64, f64) = (0.76, 0.94);
/// Largest distance from the frame's middle of a subject that a hold after another step leaves where it is.
const HELD_OFF: f64 = 0.2;
/// The same of a subject that the film comes to with the hold: `the chest, the palm, the skull, two seconds each`.
const COME_TO_OFF: f64 = 0.06;
/// Distance of the thirds from the frame's middle, over its width.
const THIRD: f64 = 1.0 / 6.0;
/// Largest width of a subject that is placed on a third, over the frame's width: a wider one would nearly touch the
/// edge.
const MAX_THIRD_WIDTH: f64 = 0.45;

/// Least sine of the angle between the view axis and the front of a subject that faces a side of the picture.
const LEAST_ACROSS: f64 = 0.3;

/// Largest distance from the frame's middle of the hold's subject where the camera need not turn to it.
fn held_off(context: &StepContext, target: &Target) -> f64 {
    if context.comes_to(target) && !context.forbids_turning() { COME_TO_OFF } else { HELD_OFF }
}

/// Whether the composition of a held view is free: one subject, no stated size, part or angle, and no later step that
/// needs the subject in the middle.
fn is_free(context: &StepContext, framing: &Framing) -> bool {
    let alone = framing.subjects.len() <= 1 && !framing.whole && framing.part == SubjectPart::Middle;
    let placed = context.step.start.place.or(context.step.end.place).is_some();
    let sized = framing.size.is_some() || framing.height_frac.is_some();
    alone && !sized && framing.angle.is_none() && !placed && context.is_last
}

/// The view turned so that its subject is on the left or right third, where it fits there.
fn on_a_third(context: &StepContext, target: &Target, view: CameraState) -> CameraState {
    if target.ids.is_empty() || extent_frac(context.world, &view, target.sized_by()).x > MAX_THIRD_WIDTH {
        return view;
    }
    let distance = view.pose.position.distance(target.aim);
    let frame_width = 2.0 * distance * (view.fov_y_rad / 2.0).tan() * context.world.aspect;
    let sign = looking_room(context, target, &view).unwrap_or(if context.parameters[5] < 0.5 { -1.0 } else { 1.0 });
    let (mut beside, mut out) = (frame_width * THIRD, view);
    // A pitched camera turns on a cone, so that the turn is iterated; each iteration divides the error by ten or more.
    for _ in 0..8 {
        out = aimed(context.world, &view, target.aim + view.pose.right() * (sign * beside));
        let across = frame_position(context.world, &out, target.aim).map_or(THIRD, |(at, _)| at.x.abs());
        beside *= THIRD / across.max(0.01);
    }
    out
}

/// Pitch of a view that is turned to the middle of many things at least, radians.
const STEEPEST_RAD: f64 = -0.96;

/// The view of many things turned so that they lie about the middle of the picture: from near by, that is not where the middle
/// of the box about them lies. Stated places stay.
fn with_all_amid(context: &StepContext, target: &Target, view: CameraState) -> CameraState {
    let world = context.world;
    let is_placed = context.step.start.place.or(context.step.end.place).is_some();
    // From straight above a turn to a side is a roll.
    if is_placed || world.frame.angles(view.pose.rotation).pitch_rad < STEEPEST_RAD {
        return view;
    }
    let turned = |view: CameraState| {
        let positions = target.corners.iter().map(|corner| frame_position(world, &view, *corner).map(|(at, _)| at));
        let (low, high) = positions
            .flatten()
            .fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(low, high), at| (low.min(at), high.max(at)));
        let toward = view.pose.rotation * frame_ray(world, &view, low.midpoint(high));
        if toward.is_finite() { aimed(world, &view, view.pose.position + toward) } else { view }
    };
    // The first turn leaves a tenth of the way, since near things move more than far ones.
    turned(turned(view))
}

/// Side of the picture that a subject faces, right positive, so that the room is in front of it; `None` where it faces
/// the camera or away from it.
fn looking_room(context: &StepContext, target: &Target, view: &CameraState) -> Option<f64> {
    let front = context.world.frame.direction(front_azimuth(context.world, target.center));
    let across = front.dot(view.pose.right());
    (across.abs() > LEAST_ACROSS).then(|| across.signum())
}

/// Holds a view with a small, slow, seeded sway of 0.3 % of the distance and 0.35 degrees.
pub(super) fn handheld(context: &StepContext) -> Vec<MotionSegment> {
    let mut segments = hold(context);
    let Some(segment) = segments.last_mut() else { return segments };
    let target = context.main_target();
    let base = segment.states[0];
    let distance = base.pose.position.distance(target.aim);
    let count = num_sways(segment.secs);
    segment.states = swayed(&vec![base; count + 1], distance, context.parameters[6] * 60.0);
    segment.easing = Easing::Linear;
    segments
}

/// Duration of a film without a move, of a picture at rest before the first move, and of a rest after one.
const STILL_SECS: f64 = 4.0;
const OPENING_SECS: f64 = 2.4;
const REST_SECS: f64 = 1.5;
/// Height in the frame up to which a thing is too far away for a picture of it.
const TOO_SMALL: f64 = 0.1;

/// Whether the picture that a film rests on is of something that it has not come to yet, and that a turn on the spot does not
/// show as the words say.
fn is_elsewhere(context: &StepContext, before: &CameraState, target: &Target) -> bool {
    let world = context.world;
    let is_new = context.earlier.as_ref().is_none_or(|earlier| earlier.ids.first() != target.ids.first());
    let stays = context.forbids_turning() || context.forbidden.contains(&Motion::Travel);
    let framing = &context.step.end;
    let turned = extent_frac(world, &aimed(world, before, target.aim), target.sized_by());
    // A turn on the spot brings a thing to its place in the frame.
    let is_framed = is_stated(&Framing { place: None, part: SubjectPart::default(), ..framing.clone() });
    is_new && !stays && !framing.subjects.is_empty() && (is_framed || turned.max_element() < TOO_SMALL)
}

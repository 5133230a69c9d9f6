//! The geometry of every move, one file per family. Definitions: [`Move`].
//!
//! Enters: one step of a program, the camera before it, and the values of its open parameters. Leaves: segments whose
//! camera states carry out the move exactly.

mod beside;
mod circles;
mod compose;
mod context;
mod dolly;
mod dolly_length;
mod held_whole;
mod hold;
mod lens;
mod level;
mod look;
mod nearing;
mod over_shoulder;
mod overlook;
mod passes;
mod passing_by;
mod paths;
mod rack_focus;
mod requirements;
mod room_view;
mod scanned;
mod skim;
mod standing;
mod standing_view;
mod straight;
mod sway;
mod turns;
mod with;

pub(super) use context::StepContext;

use super::constraint::{ConstraintKind, Scope, pitch_band_deg};
use super::framing::Target;
use super::motion::MotionSegment;
use super::program::{Framing, Motion, Pass, Step, SubjectPart, Via};
use cinesplat_trajectory::{Move, ShotAngle};

/// The segments of one step.
pub(super) fn build(context: &StepContext) -> Vec<MotionSegment> {
    let Some((join, there)) = standing::arrival(context) else { return built(context) };
    let mut segments = built(&StepContext { before: Some(there), ..context.clone() });
    segments.insert(0, join);
    segments
}

/// The segments of a step that starts at the camera before, or anywhere.
fn built(context: &StepContext) -> Vec<MotionSegment> {
    let mut segments =
        if context.step.returns && context.origin.is_some() { paths::back_to_origin(context) } else { family(context) };
    with::add_second_moves(context, &mut segments);
    compose::compose(context, &mut segments);
    if context.step.look.is_some() {
        look::look(context, &mut segments);
        compose::rejoin(context, &mut segments);
    }
    scanned::fill_frame(context, &mut segments);
    held_whole::hold_whole(context, &mut segments);
    level::keep_height(context, &mut segments);
    requirements::require(context, &mut segments);
    if let Some(first) = segments.first_mut() {
        first.cut = context.step.cut;
    }
    segments
}

/// Whether a crane rises or sinks without a turn to its subject: where the words rule the turn out, or lead from one part of
/// the subject up or down to another. Heights that the words state for its views need the turn.
fn keeps_its_view(context: &StepContext) -> bool {
    let ends = [&context.step.start, &context.step.end];
    let is_free = |framing: &&Framing| framing.elevation_deg.is_none() && framing.place.is_none();
    let is_level = |framing: &&Framing| matches!(framing.angle, None | Some(ShotAngle::EyeLevel));
    if !ends.iter().all(|framing| is_free(framing) && is_level(framing)) {
        return false;
    }
    let is_upright = |framing: &&Framing| !matches!(framing.part, SubjectPart::Left | SubjectPart::Right);
    let [start, end] = ends;
    let along = !start.subjects.is_empty() && start.subjects == end.subjects && start.part != end.part;
    along && ends.iter().all(is_upright)
        || context.forbidden.iter().any(|motion| matches!(motion, Motion::Turn | Motion::Tilt))
}

fn family(context: &StepContext) -> Vec<MotionSegment> {
    let how = context.step.via.as_ref().map(|via| via.how);
    if let Some(segments) = how.and_then(|how| passing_a_side(context, how)) {
        return segments;
    }
    if let Some(segments) = rounding(context) {
        return segments;
    }
    let passes = how.is_some_and(|how| !matches!(how, Pass::Past | Pass::From))
        && !rises_over_subject(context)
        && !backs_over(context);
    match context.step.movement {
        Move::Static => hold::hold(context),
        Move::Handheld => hold::handheld(context),
        Move::PanLeft | Move::PanRight => nearing::pan_and_near(context),
        Move::WhipPan => turns::pan(context),
        Move::TiltUp | Move::TiltDown => turns::tilt(context),
        Move::RollCw | Move::RollCcw => turns::roll(context),
        Move::FlyThrough | Move::PushIn | Move::PullOut | Move::Follow | Move::CraneUp | Move::CraneDown if passes => {
            passes::passing(context)
        }
        Move::PushIn | Move::PullOut => dolly::dolly(context),
        Move::TruckLeft | Move::TruckRight => straight::truck(context),
        Move::PedestalUp if leads_above(context) && !keeps_its_view(context) => {
            made_as(context, Move::CraneUp, circles::crane)
        }
        Move::PedestalUp if leads_aside(context) && !keeps_its_view(context) => {
            hardly_turning(made_as(context, Move::CraneUp, circles::crane))
        }
        Move::PedestalDown if leads_aside(context) && !keeps_its_view(context) => {
            hardly_turning(made_as(context, Move::CraneDown, circles::crane))
        }
        Move::PedestalUp | Move::PedestalDown => straight::pedestal(context),
        Move::CraneUp if keeps_its_view(context) => made_as(context, Move::PedestalUp, straight::pedestal),
        Move::CraneDown if keeps_its_view(context) => made_as(context, Move::PedestalDown, straight::pedestal),
        Move::CraneUp | Move::CraneDown => circles::crane(context),
        Move::OrbitLeft | Move::OrbitRight | Move::ArcLeft | Move::ArcRight => circles::orbit(context),
        Move::ZoomIn | Move::ZoomOut => lens::zoom(context),
        Move::DollyZoomIn | Move::DollyZoomOut => lens::dolly_zoom(context),
        Move::RackFocus => rack_focus::rack_focus(context),
        Move::Follow | Move::FlyThrough => passing_by::passing_by(context).unwrap_or_else(|| paths::follow(context)),
        Move::Reveal if matches!(how, Some(Pass::Under | Pass::Through)) => passes::passing(context),
        Move::Reveal => paths::reveal(context),
    }
}

/// The segments of a step whose move is carried out as another one.
fn made_as(context: &StepContext, movement: Move, make: fn(&StepContext) -> Vec<MotionSegment>) -> Vec<MotionSegment> {
    let step = Step { movement, ..context.step.clone() };
    make(&StepContext { step: &step, ..context.clone() })
}

/// Largest turn to a side, and up or down, of a rise or a descent between two subjects, degrees: no more than needed.
const PEDESTAL_TURN_DEG: f64 = 8.0;

/// The segments as those of a camera that rises or sinks, and looks to its end with little of a turn.
fn hardly_turning(segments: Vec<MotionSegment>) -> Vec<MotionSegment> {
    let range = (-PEDESTAL_TURN_DEG, PEDESTAL_TURN_DEG);
    let held = |segment: MotionSegment| {
        if segment.is_join {
            return segment;
        }
        segment
            .requiring(Scope::All, ConstraintKind::YawChange(range))
            .requiring(Scope::All, ConstraintKind::PitchChange(range))
    };
    segments.into_iter().map(held).collect()
}

/// Whether a rise or a descent leads from one subject to another that is neither above nor below it: without a turn and a
/// travel aside the camera would not see it.
fn leads_aside(context: &StepContext) -> bool {
    let (Some(start), Some(end)) = (&context.start, &context.end) else { return false };
    // A stated way or height is one of a pedestal.
    if context.step.amount.is_some() || context.step.end.height.is_some() {
        return false;
    }
    let apart = end.aim - start.aim;
    let frame = &context.world.frame;
    let aside = frame.horizontal(apart).length();
    start.ids.iter().all(|id| !end.ids.contains(id)) && aside > LEAST_ASIDE * frame.height(apart).abs()
}

/// Whether a rise leads from beside a subject to a view from above it.
fn leads_above(context: &StepContext) -> bool {
    let (Some(before), Some(_)) = (&context.before, &context.end) else { return false };
    let pitch_rad = context.world.frame.angles(before.pose.rotation).pitch_rad;
    let looks_down = pitch_rad.to_degrees() < pitch_band_deg(ShotAngle::Overhead).1;
    context.step.end.angle == Some(ShotAngle::Overhead) && context.step.amount.is_none() && !looks_down
}

/// Distance aside over the height from which on a rise between two subjects is a crane.
const LEAST_ASIDE: f64 = 0.25;

/// Whether a pull-out leads back over something, as in `ease back over the books`: it looks where it came from all the way.
fn backs_over(context: &StepContext) -> bool {
    let over = context.step.via.as_ref().is_some_and(|via| via.how == Pass::Over);
    context.step.movement == Move::PullOut && over
}

/// The way round a thing from one place to another, as in `from the door, a curve round the sofa, and finish at the window`:
/// it circles neither of them. `None` of any other step.
fn rounding(context: &StepContext) -> Option<Vec<MotionSegment>> {
    let step = context.step;
    let via = step.via.as_ref().filter(|via| via.how == Pass::Past)?;
    let end = context.end.as_ref()?;
    let is_other = |target: &Target| target.ids.first() != end.ids.first();
    let starts_apart = context.start.as_ref().or(context.earlier.as_ref()).is_some_and(is_other);
    let is_passed = !end.ids.iter().any(|id| via.objects.contains(id));
    if !step.movement.is_circular() || !starts_apart || !is_passed || step.amount.is_some() {
        return None;
    }
    let way = Step { via: Some(Via { how: Pass::Front, ..via.clone() }), movement: Move::Follow, ..step.clone() };
    beside::passing_beside(&StepContext { step: &way, ..context.clone() })
}

/// Whether a crane rises or sinks over its own subject, as in `crane up over the sofa`: it then passes nothing.
fn rises_over_subject(context: &StepContext) -> bool {
    let step = context.step;
    let subject = step.end.subjects.first().or(step.start.subjects.first());
    let over = step.via.as_ref().filter(|via| via.how == Pass::Over);
    matches!(step.movement, Move::CraneUp | Move::CraneDown) && over.is_some_and(|via| via.objects.first() == subject)
}

/// The segments of a step that passes an object on a side of it; `None` for every other step.
fn passing_a_side(context: &StepContext, how: Pass) -> Option<Vec<MotionSegment>> {
    if let Some(segments) = skim::skim(context) {
        return Some(segments);
    }
    let along = how == Pass::Along;
    let beside = along || matches!(how, Pass::Behind | Pass::Front);
    match context.step.movement {
        Move::TruckLeft | Move::TruckRight if along => beside::truck_along(context),
        Move::Reveal if how == Pass::Behind => beside::reveal_from_behind(context),
        Move::FlyThrough | Move::Follow | Move::PushIn | Move::PullOut | Move::CraneUp | Move::CraneDown if beside => {
            beside::passing_beside(context)
        }
        _ => None,
    }
}

//! What the prompt states about the pictures of a step, as constraints: the framing at both ends, what stays in view,
//! what is never in view, and what the film must not do.

use super::context::StepContext;
use super::passing_by::passed_by;
use super::skim::skims;
use super::standing::require_shoulder;
use crate::composition::lens_fov_deg;
use crate::constraint::{Constraint, ConstraintKind, Scope};
use crate::framing::Target;
use crate::motion::{Angle, MotionSegment};
use crate::program::{Framing, Pass, Step, Via};
use cinesplat_trajectory::{Move, ShotAngle};

/// Tolerance of a stated height in the frame, and of a stated distance, over itself.
const HEIGHT_TOLERANCE: f64 = 0.15;
const DISTANCE_TOLERANCE: f64 = 0.1;
/// Tolerance of a stated elevation and of a stated field of view, degrees.
const ELEVATION_TOLERANCE_DEG: f64 = 6.0;
const LENS_TOLERANCE_DEG: f64 = 0.3;
/// Tolerance of a stated height above the floor: over itself, and over the scene size.
const CAMERA_HEIGHT_TOLERANCE: (f64, f64) = (0.1, 0.01);
/// Largest visible share of a subject that counts as hidden, and of one that is avoided.
const HIDDEN_FRAC: f64 = 0.1;
const AVOIDED_FRAC: f64 = 0.05;
/// Largest share of a thing in the frame that has left it.
const LEFT_FRAC: f64 = 0.05;
/// Least share of a kept object in the frame, and least visible share of it.
const KEPT_FRAC: f64 = 0.5;

/// Least visible share of what of a backdrop is in the frame.
const BACKDROP_SEEN_FRAC: f64 = 0.5;

/// Adds the constraints of a step to its segments.
pub(super) fn require(context: &StepContext, segments: &mut [MotionSegment]) {
    let step = context.step;
    let is_angled = [&step.start, &step.end].iter().any(|framing| {
        matches!(framing.angle, Some(ShotAngle::High | ShotAngle::Overhead | ShotAngle::Low | ShotAngle::Worm))
    });
    for segment in segments.iter_mut() {
        keep_and_avoid(context, segment);
        if is_angled {
            segment.angle = Angle::Stated;
        }
    }
    if let Some(own) = segments.iter_mut().rev().find(|segment| !segment.is_join) {
        add(own, Scope::Start, framing(context, &step.start, &context.opening_target()));
        add(own, Scope::End, framing(context, &step.end, &context.main_target()));
        hide(own, &step.start, Scope::Start);
        hide(own, &step.end, Scope::End);
        leave_frame(context, own);
        add(own, Scope::End, closed_in_on(context));
        // To a thing on a sideboard the camera goes along a part of that.
        let is_part = |via: &Via| via.how == Pass::Along && !step.end.subjects.is_empty() && slides(step.movement);
        add(own, Scope::All, passages(step.via.as_ref().filter(|via| !skims(context) && !is_part(via))));
        let each = |ids: &[u32], kind: &dyn Fn(u32) -> ConstraintKind| ids.iter().map(|&id| kind(id)).collect();
        let seen = |least: f64| move |id: u32| ConstraintKind::InFrame(vec![id], least);
        add(own, Scope::Any, each(passed_in_turn(step), &seen(PASSED_FRAC)));
        add(own, Scope::All, each(passed_by(step), &|id| ConstraintKind::Passed(Pass::Past, id)));
        add(own, Scope::Any, each(passed_by(step), &seen(PASSED_BY_FRAC)));
        require_shoulder(context, own);
    }
}

fn slides(movement: Move) -> bool {
    matches!(movement, Move::TruckLeft | Move::TruckRight)
}

/// The passages of a step that are measured on its path. `Between` with one object means through it.
fn passages(via: Option<&Via>) -> Vec<ConstraintKind> {
    let Some(via) = via else { return Vec::new() };
    let how = match via.how {
        Pass::Between if via.objects.len() == 1 => Pass::Through,
        Pass::Past | Pass::Between | Pass::Over => return Vec::new(),
        how => how,
    };
    via.objects.iter().map(|&id| ConstraintKind::Passed(how, id)).collect()
}

/// Share of what a way passes that is in the picture at some moment.
const PASSED_BY_FRAC: f64 = 0.4;

/// Share of what a turn passes that is in the picture at some moment.
const PASSED_FRAC: f64 = 0.6;

/// What a turn passes is seen on the way: `pan left from the television, past the armchair, to the curtain`.
fn passed_in_turn(step: &Step) -> &[u32] {
    let turns = matches!(step.movement, Move::PanLeft | Move::PanRight | Move::TiltUp | Move::TiltDown);
    let via = step.via.as_ref().filter(|via| turns && via.how == Pass::Past);
    via.map(|via| via.objects.as_slice()).unwrap_or_default()
}

fn add(segment: &mut MotionSegment, scope: Scope, kinds: Vec<ConstraintKind>) {
    segment.constraints.extend(kinds.into_iter().map(|kind| Constraint { kind, scope }));
}

/// The constraints of a framing on one frame, apart from size and whole subjects.
fn framing(context: &StepContext, framing: &Framing, target: &Target) -> Vec<ConstraintKind> {
    let around = |value: f64, tolerance: f64| (value - tolerance, value + tolerance);
    let mut out = Vec::new();
    let of = || target.clone();
    let height = |frac: f64| ConstraintKind::Height(of(), around(frac, HEIGHT_TOLERANCE * frac));
    let distance = |units: f64| ConstraintKind::Distance(of(), around(units, DISTANCE_TOLERANCE * units));
    let elevation = |deg: f64| ConstraintKind::Elevation(of(), around(deg, ELEVATION_TOLERANCE_DEG));
    let (own, size) = CAMERA_HEIGHT_TOLERANCE;
    let above = |units: f64| {
        let tolerance = (own * units.abs()).max(size * context.world.bounds.size());
        ConstraintKind::CameraHeight(around(units, tolerance))
    };
    out.extend(framing.height_frac.map(height));
    out.extend(framing.distance.map(distance));
    out.extend(framing.elevation_deg.map(elevation));
    out.extend(framing.height.map(above));
    out.extend(
        framing
            .lens
            .map(lens_fov_deg)
            .map(|(low, high)| ConstraintKind::FieldOfView((low - LENS_TOLERANCE_DEG, high + LENS_TOLERANCE_DEG))),
    );
    out.extend(framing.side.map(|side| ConstraintKind::FromSide(of(), side)));
    out.extend(framing.place.map(|place| ConstraintKind::Placed(of(), place)));
    for &id in &framing.backdrop {
        out.extend([ConstraintKind::Backdrop(id, of()), ConstraintKind::Unoccluded(id, BACKDROP_SEEN_FRAC)]);
    }
    if framing.hidden {
        let ids = if framing.subjects.is_empty() { &target.ids } else { &framing.subjects };
        out.extend(ids.iter().map(|&id| ConstraintKind::Unseen(id, HIDDEN_FRAC)));
    }
    out
}

/// Drops what a hidden subject contradicts at that end: it then need not be visible there, in the middle, or wholly in
/// the frame. Where it was to be visible on all frames, it still is at the other end.
fn hide(segment: &mut MotionSegment, framing: &Framing, scope: Scope) {
    if !framing.hidden {
        return;
    }
    let other = if scope == Scope::Start { Scope::End } else { Scope::Start };
    let is_hidden = |ids: &[u32]| ids.iter().any(|id| framing.subjects.contains(id)) || framing.subjects.is_empty();
    let contradicts = |kind: &ConstraintKind| match kind {
        ConstraintKind::Unoccluded(id, _) => is_hidden(&[*id]),
        ConstraintKind::Centered(target, _) | ConstraintKind::OnThird(target) => is_hidden(&target.ids),
        ConstraintKind::InFrame(ids, _) => is_hidden(ids),
        _ => false,
    };
    segment.constraints.retain(|constraint| constraint.scope != scope || !contradicts(&constraint.kind));
    for constraint in segment.constraints.iter_mut().filter(|c| c.scope == Scope::All && contradicts(&c.kind)) {
        constraint.scope = other;
    }
}

/// What a slide whose lens closes in on it ends on lies near the middle.
fn closed_in_on(context: &StepContext) -> Vec<ConstraintKind> {
    let step = context.step;
    let slides = matches!(step.movement, Move::TruckLeft | Move::TruckRight) && step.with.contains(&Move::ZoomIn);
    let is_open = step.end.place.is_none() && !step.end.hidden && !step.end.subjects.is_empty();
    if slides && is_open { vec![ConstraintKind::Centered(context.main_target(), CLOSED_IN_OFF)] } else { Vec::new() }
}

/// Largest distance from the frame's middle of what a slide closes in on.
const CLOSED_IN_OFF: f64 = 0.22;

/// Where a slide or a turn ends without a subject, that has left the frame: the camera does not hide behind something.
fn leave_frame(context: &StepContext, segment: &mut MotionSegment) {
    let (step, end) = (context.step, &context.step.end);
    let passes = matches!(
        step.movement,
        Move::TruckLeft
            | Move::TruckRight
            | Move::PanLeft
            | Move::PanRight
            | Move::TiltUp
            | Move::TiltDown
            | Move::PedestalUp
            | Move::PedestalDown
    );
    if end.hidden && passes && step.via.is_none() && !end.subjects.is_empty() {
        let left = end.subjects.iter().map(|id| ConstraintKind::NotWhole(vec![*id], LEFT_FRAC));
        add(segment, Scope::End, left.collect());
    }
}

fn keep_and_avoid(context: &StepContext, segment: &mut MotionSegment) {
    for &id in &context.step.keep {
        add(
            segment,
            Scope::All,
            vec![ConstraintKind::InFrame(vec![id], KEPT_FRAC), ConstraintKind::Unoccluded(id, KEPT_FRAC)],
        );
    }
    let avoided = context.step.avoid.iter().map(|&id| ConstraintKind::Unseen(id, AVOIDED_FRAC)).collect();
    add(segment, Scope::All, avoided);
    let forbidden = context.forbidden.iter().map(|&motion| ConstraintKind::Without(motion)).collect();
    add(segment, Scope::All, forbidden);
    let limits = context.limits.iter().filter(|limit| !limit.is_speed()).map(|limit| ConstraintKind::Limited(*limit));
    add(segment, Scope::All, limits.collect());
}

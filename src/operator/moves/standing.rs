//! Openings whose place the prompt states by another object: from it, and over the shoulder of it.

use super::context::StepContext;
use super::standing_view::{shoulder, standing_view};
use crate::constraint::{Constraint, ConstraintKind, Scope};
use crate::framing::Target;
use crate::motion::MotionSegment;
use crate::program::{Framing, SubjectPart};
use crate::view::aimed;
use cinesplat_trajectory::{CameraState, Move};

/// The way from the camera before to the stated place, and the camera there; `None` for a step that states none, or
/// without a camera before.
pub(super) fn arrival(context: &StepContext) -> Option<(MotionSegment, CameraState)> {
    let before = context.before?;
    let target = context.opening_target();
    let fov_deg = before.fov_y_rad.to_degrees();
    let there =
        standing_view(&context.standing(), &target, &context.opening_framing(), (0.3, 0.6), (fov_deg, fov_deg))?;
    Some((context.join(before, there), there))
}

/// Adds the constraint that the step sees its subject over the shoulder of an object.
pub(super) fn require_shoulder(context: &StepContext, segment: &mut MotionSegment) {
    if let Some(id) = shoulder(&context.standing()) {
        let kind = ConstraintKind::Foreground(id, context.opening_target());
        segment.constraints.push(Constraint { kind, scope: Scope::Start });
    }
}

/// A camera at the stated place, turned away from a target until that is out of the frame. Parameter 5 chooses the way
/// where the prompt leaves it open.
pub(super) fn turned_away(context: &StepContext, target: &Target) -> Option<CameraState> {
    let framing = Framing { part: SubjectPart::Middle, ..context.step.start.clone() };
    let view = standing_view(&context.standing(), target, &framing, (0.3, 0.6), (36.0, 56.0))?;
    let away = target.aim - view.pose.position;
    let half_width = ((view.fov_y_rad / 2.0).tan() * context.world.aspect).atan();
    let angle = 1.1 * half_width + (target.radius / away.length().max(1e-9)).min(1.0).asin();
    let sign = match context.step.with.first() {
        Some(Move::TruckRight | Move::PanRight | Move::OrbitRight | Move::ArcRight) => -1.0,
        Some(Move::TruckLeft | Move::PanLeft | Move::OrbitLeft | Move::ArcLeft) => 1.0,
        _ if context.parameters[5] < 0.5 => -1.0,
        _ => 1.0,
    };
    let turn = glam::DQuat::from_axis_angle(context.world.frame.up, -sign * angle);
    Some(aimed(context.world, &view, view.pose.position + turn * away))
}

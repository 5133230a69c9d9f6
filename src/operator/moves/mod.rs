//! The geometry of every move, one file per family. Definitions: [`Move`].
//!
//! Enters: one step of a program, the camera before it, and the values of its open parameters. Leaves: segments whose
//! camera states carry out the move exactly.

mod circles;
mod context;
mod lens;
mod paths;
mod straight;
mod turns;
mod with;

pub(super) use context::StepContext;

use super::motion::MotionSegment;
use super::program::Pass;
use cinesplat_trajectory::Move;

/// The segments of one step.
pub(super) fn build(context: &StepContext) -> Vec<MotionSegment> {
    let mut segments =
        if context.step.returns && context.origin.is_some() { paths::back_to_origin(context) } else { family(context) };
    with::add_second_move(context, &mut segments);
    if let Some(first) = segments.first_mut() {
        first.cut = context.step.cut;
    }
    segments
}

fn family(context: &StepContext) -> Vec<MotionSegment> {
    let passes = context.step.via.as_ref().is_some_and(|via| via.how != Pass::Past);
    match context.step.movement {
        Move::Static => turns::hold(context),
        Move::Handheld => turns::handheld(context),
        Move::PanLeft | Move::PanRight | Move::WhipPan => turns::pan(context),
        Move::TiltUp | Move::TiltDown => turns::tilt(context),
        Move::RollCw | Move::RollCcw => turns::roll(context),
        Move::FlyThrough | Move::PushIn | Move::PullOut | Move::Follow | Move::CraneUp | Move::CraneDown if passes => {
            paths::passing(context)
        }
        Move::PushIn | Move::PullOut => straight::dolly(context),
        Move::TruckLeft | Move::TruckRight => straight::truck(context),
        Move::PedestalUp | Move::PedestalDown => straight::pedestal(context),
        Move::CraneUp | Move::CraneDown => circles::crane(context),
        Move::OrbitLeft | Move::OrbitRight | Move::ArcLeft | Move::ArcRight => circles::orbit(context),
        Move::ZoomIn | Move::ZoomOut => lens::zoom(context),
        Move::DollyZoomIn | Move::DollyZoomOut => lens::dolly_zoom(context),
        Move::RackFocus => lens::rack_focus(context),
        Move::Follow | Move::FlyThrough => paths::follow(context),
        Move::Reveal => paths::reveal(context),
    }
}

//! Pans whose words state how large their end is: `turn to the fireplace and finish close on the fire`. A turn on the spot
//! changes no size, so the camera goes on to it.

use super::context::StepContext;
use super::{dolly, turns};
use crate::framing::extent_frac;
use crate::motion::MotionSegment;
use crate::program::{Framing, Motion, Step};
use crate::view::{aimed, height_band_frac};
use cinesplat_trajectory::Move;

/// A pan, and a push in after it where its end is to be larger than it is from where the camera turns.
pub(super) fn pan_and_near(context: &StepContext) -> Vec<MotionSegment> {
    if !nears(context) {
        return turns::pan(context);
    }
    let subjects = context.step.end.subjects.clone();
    let turn = Step { end: Framing { subjects, ..Framing::default() }, ..context.step.clone() };
    let mut segments = turns::pan(&StepContext { step: &turn, ..context.clone() });
    let Some(before) = segments.last().and_then(|segment| segment.states.last()).copied() else { return segments };
    let way =
        Step { movement: Move::PushIn, start: Framing::default(), via: None, amount: None, ..context.step.clone() };
    let way = StepContext { step: &way, before: Some(before), start: None, ..context.clone() };
    segments.extend(dolly::dolly(&way));
    segments
}

/// Whether the end of a pan from where the film has come to is larger in the frame than a turn can make it.
fn nears(context: &StepContext) -> bool {
    let (Some(before), Some(end)) = (&context.before, &context.end) else { return false };
    let framing = &context.step.end;
    let least = framing.height_frac.or(framing.size.map(|size| height_band_frac(framing, size).0));
    let stays = context.forbidden.contains(&Motion::Travel) || context.step.duration_secs.is_some();
    let turned = aimed(context.world, before, end.aim);
    let now = extent_frac(context.world, &turned, end.sized_by()).y;
    !stays && least.is_some_and(|least| now < SMALLER * least)
}

/// Size over the stated one below which a thing is too small.
const SMALLER: f64 = 0.8;

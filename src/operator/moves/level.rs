//! Films at one height.
//!
//! Enters: the segments of a step in a film whose height the prompt holds constant. Leaves: the same segments with every
//! camera at the height of the first, turned up or down so that the subject keeps its place in the frame. Where the prompt
//! rules that turn out as well, the camera only shifts.

use super::context::StepContext;
use crate::composition::placed;
use crate::framing::frame_position;
use crate::motion::MotionSegment;
use crate::program::Motion;
use crate::view::moved;

/// Keeps the height of a step, unless one of its own moves is up or down.
pub(super) fn keep_height(context: &StepContext, segments: &mut [MotionSegment]) {
    let forbids = |motion: Motion| context.forbidden.contains(&motion);
    let mut moves = std::iter::once(&context.step.movement).chain(&context.step.with);
    if !forbids(Motion::Rise) || moves.any(|movement| Motion::of(*movement) == Some(Motion::Rise)) {
        return;
    }
    let first = context.before.or_else(|| Some(*segments.first()?.states.first()?));
    let Some(first) = first else { return };
    let frame = &context.world.frame;
    let height = frame.height(first.pose.position);
    let aim = context.main_target().aim;
    let may_turn = !forbids(Motion::Tilt) && !forbids(Motion::Turn);
    for state in segments.iter_mut().flat_map(|segment| &mut segment.states) {
        let by = height - frame.height(state.pose.position);
        if by.abs() < 1e-9 * context.world.bounds.size() {
            continue;
        }
        let shifted = moved(state, frame.up * by);
        let seen_at = frame_position(context.world, state, aim).filter(|_| may_turn);
        *state = seen_at.map_or(shifted, |(at, _)| placed(context.world, &shifted, aim, at));
    }
}

//! Rest at both ends of a film, which an editor needs to cut it, and after a whip pan.

use super::motion::MotionSegment;
use super::program::Program;
use cinesplat_trajectory::{Easing, Move};

/// Rest before the first move and after the last one.
const HANDLE_SECS: f64 = 0.6;
/// Rest after a whip pan: the time that an eye needs to find the new picture.
const SETTLE_SECS: f64 = 1.0;
/// Longest film where the prompt states no time.
pub(super) const MAX_FREE_FILM_SECS: f64 = 15.0;

/// Rest before and after the moves of a film, seconds. None where the prompt states the time, at a hold, and where a
/// stated speed profile does not rest.
pub(super) fn handles(program: &Program, segments: &[MotionSegment]) -> [f64; 2] {
    let stated = program.duration_secs.is_some();
    let rest = |segment: Option<&MotionSegment>, rests: fn(Easing) -> bool| {
        let handle = |segment: &MotionSegment| match segment.movement {
            Move::Static | Move::Handheld => 0.0,
            _ if stated || segment.secs_bind || !rests(segment.easing) => 0.0,
            _ => HANDLE_SECS,
        };
        segment.map_or(0.0, handle)
    };
    let last = segments.last();
    let whipped = last.is_some_and(|segment| segment.movement == Move::WhipPan);
    let after = rest(last, Easing::rests_at_end);
    let after = if whipped && after > 0.0 { SETTLE_SECS } else { after };
    [rest(segments.first(), Easing::rests_at_start), after]
}

/// Adds rest after each whip pan that another move follows.
pub(super) fn settle(segments: &mut Vec<MotionSegment>) {
    let mut index = 0;
    while index + 1 < segments.len() {
        let (whip, next) = (&segments[index], &segments[index + 1]);
        if whip.movement == Move::WhipPan && !whip.is_join && next.movement != Move::Static {
            let state = whip.last();
            let mut rest = MotionSegment::new(whip.step, Move::Static, vec![state, state], SETTLE_SECS);
            rest.is_join = true;
            segments.insert(index + 1, rest);
        }
        index += 1;
    }
}

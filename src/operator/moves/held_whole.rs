//! Framing along a move: what fits into the picture stays in it as a whole, with some room around it.
//!
//! A camera that goes in on the middle of a thing sees its near, lower half grow faster than its upper one, and one that
//! circles it sees one arm swing out. An operator corrects that by a turn of a few degrees.
//!
//! Enters: the segments of a move, aimed at their subjects. Leaves: the same segments, each camera turned by as little as
//! puts its subject back inside the frame. Parts, stated places, and moves that keep their direction stay as they are.

use glam::{DVec2, DVec3};

use super::compose::{is_same_camera, rejoin, turned_by};
use super::context::StepContext;
use super::with::is_turn;
use crate::framing::frame_bounds;
use crate::motion::MotionSegment;
use crate::pictures::void_frac;
use crate::program::{Framing, SubjectPart};
use cinesplat_trajectory::{CameraState, Move};

/// Room between a subject and the edge of the frame, over the frame's width and height.
const MARGIN: f64 = 0.045;
/// Least turn that is worth it, over the frame.
const LEAST_SHIFT: f64 = 0.004;
/// Largest turn, over the frame: more would take the subject's middle out of the picture's.
const MOST_SHIFT: f64 = 0.16;

/// Stated height of a subject in the frame from which on the frame may cut it: that of a medium close-up.
const CUTTING_HEIGHT: f64 = 0.8;
/// Void that such a turn may add to the picture of a room.
const MORE_VOID: f64 = 0.02;

/// Turns the cameras of the step's own motion so that what fits is whole.
pub(super) fn hold_whole(context: &StepContext, segments: &mut Vec<MotionSegment>) {
    let ends = [&context.step.start, &context.step.end];
    // A stated close view cuts its subject, and keeps its head.
    let height = |framing: &Framing| framing.height_frac.or(framing.size.map(|size| size.height_band_frac().0));
    let is_free = |framing: &&Framing| {
        height(framing).is_none_or(|height| height < CUTTING_HEIGHT)
            && framing.place.is_none()
            && framing.part == SubjectPart::Middle
            && framing.elevation_deg.is_none()
    };
    if !re_aims(context.step.movement)
        || context.step.with.iter().any(|second| is_turn(*second))
        || context.step.look.is_some()
        || !ends.iter().all(is_free)
        || context.forbids_turning()
    {
        return;
    }
    let [start, end] = ends.map(|framing| points_of(context, &framing.subjects));
    let (start, end) = (start.as_deref().or(end.as_deref()), end.as_deref().or(start.as_deref()));
    let Some((start, end)) = start.zip(end) else { return };
    let Some(segment) = segments.last_mut().filter(|segment| !segment.is_join) else { return };
    let last = segment.states.len() - 1;
    let continues = context.before.is_some_and(|before| is_same_camera(&before, &segment.states[0]));
    let is_held = segment.states[0] == segment.states[last];
    if continues && is_held {
        return;
    }
    // On the way from one subject to another neither has to be whole.
    let shown = |i: usize| match i {
        0 if continues => None,
        0 => Some(start),
        i if i == last => Some(end),
        _ => (start == end).then_some(start),
    };
    let mut turned = segment.states.clone();
    for (i, state) in turned.iter_mut().enumerate() {
        *state = shown(i).map_or(*state, |points| held(context, state, points));
    }
    if is_held {
        turned[last] = turned[0];
    }
    if turned != segment.states {
        segment.states = turned;
        rejoin(context, segments);
    }
}

/// The camera turned by as little as makes whole what fits; as it is where that would show what was never captured.
fn held(context: &StepContext, state: &CameraState, points: &[DVec3]) -> CameraState {
    let by = shift(context, state, points);
    if by.abs().max_element() <= LEAST_SHIFT {
        return *state;
    }
    let tan = (state.fov_y_rad / 2.0).tan();
    let angle = |share: f64, aspect: f64| (2.0 * tan * aspect * share).atan();
    let held = turned_by(context, state, (angle(by.x, context.world.aspect), angle(by.y, 1.0)));
    if is_as_full(context, state, &held) { held } else { *state }
}

/// Moves that aim at their subjects anyway. A pan, a tilt, a truck and a rise keep their direction.
fn re_aims(movement: Move) -> bool {
    use Move::{ArcLeft, ArcRight, CraneDown, CraneUp, DollyZoomIn, DollyZoomOut, Follow, OrbitLeft, OrbitRight};
    use Move::{PullOut, PushIn, Static, ZoomIn, ZoomOut};
    matches!(
        movement,
        ArcLeft
            | ArcRight
            | CraneDown
            | CraneUp
            | DollyZoomIn
            | DollyZoomOut
            | Follow
            | OrbitLeft
            | OrbitRight
            | PullOut
            | PushIn
            | Static
            | ZoomIn
            | ZoomOut
    )
}

/// Whether a turned camera shows no more of what was never captured.
fn is_as_full(context: &StepContext, state: &CameraState, turned: &CameraState) -> bool {
    let void = |state: &CameraState| void_frac(context.world, state);
    !context.world.is_indoor() || void(turned) <= void(state) + MORE_VOID
}

/// Outermost points of some subjects; `None` for none.
fn points_of(context: &StepContext, ids: &[u32]) -> Option<Vec<DVec3>> {
    let subjects = ids.iter().filter_map(|&id| context.world.subject(id));
    let points: Vec<DVec3> = subjects.flat_map(|subject| subject.outline.iter().copied()).collect();
    (!points.is_empty()).then_some(points)
}

/// How far the picture has to move, right and up positive, over the frame, so that points which fit into it are whole. Zero
/// along an axis on which they do not fit.
fn shift(context: &StepContext, state: &CameraState, points: &[DVec3]) -> DVec2 {
    let Some(([low, high], _)) = frame_bounds(context.world, state, points) else { return DVec2::ZERO };
    let edge = 0.5 - MARGIN;
    let along = |low: f64, high: f64| {
        if high - low > 2.0 * edge {
            return 0.0;
        }
        (high - edge).max(0.0) + (low + edge).min(0.0)
    };
    let by = DVec2::new(along(low.x, high.x), along(low.y, high.y));
    if by.abs().max_element() > MOST_SHIFT { DVec2::ZERO } else { by }
}

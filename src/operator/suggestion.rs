//! The cameras that the director proposes, and the film that follows them without a search.

use super::motion::MotionSegment;
use cinesplat_trajectory::CameraState;

/// The cameras that the director proposes for one step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepCameras {
    /// Camera at the start of the step.
    pub start: CameraState,
    /// Camera at the end of the step.
    pub end: CameraState,
    /// Time from the first to the second, seconds.
    pub secs: f64,
}

/// Shortest time between the two proposed cameras of a step.
const MIN_SECS: f64 = 0.5;

/// The segments with their cameras replaced by the director's.
///
/// Each step that has a proposal becomes one segment from the first camera to the second, on the path that its move
/// implies (a circle for an orbit). It lasts as long as the prompt says, or else as the director proposes. Constraints
/// are kept, so that the report lists the ones that the film misses. Steps without a proposal stay unchanged.
pub(super) fn follow_suggestions(segments: Vec<MotionSegment>, suggestions: &[StepCameras]) -> Vec<MotionSegment> {
    let mut out: Vec<MotionSegment> = Vec::with_capacity(segments.len());
    for segment in segments {
        let Some(suggestion) = suggestions.get(segment.step) else {
            out.push(segment);
            continue;
        };
        if let Some(last) = out.last_mut().filter(|last| last.step == segment.step) {
            // The proposal already leads from view to view: it replaces the step's join as well.
            let cut = last.cut;
            *last = between(segment, suggestion);
            last.cut = cut;
        } else {
            out.push(between(segment, suggestion));
        }
    }
    out
}

fn between(segment: MotionSegment, suggestion: &StepCameras) -> MotionSegment {
    let secs = if segment.secs_bind { segment.secs } else { suggestion.secs.max(MIN_SECS) };
    MotionSegment { states: vec![suggestion.start, suggestion.end], secs, is_join: false, ..segment }
}

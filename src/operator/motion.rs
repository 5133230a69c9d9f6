//! A candidate film as segments of motion, and the keyframes of those segments.
//!
//! Neighboring segments share one camera state, except at a cut. Their keyframes carry the move, the framing and the
//! words of the step that they belong to.

use glam::DVec3;

use super::constraint::{Constraint, ConstraintKind, Scope};
use cinesplat_trajectory::{CameraState, Easing, Intent, Keyframe, Move, ShotAngle, ShotSize};

/// The open parameters of a step, each 0..1. Every move defines what its parameters mean.
pub(super) type StepParameters = [f64; NUM_PARAMETERS];
/// Number of open parameters per step.
pub(super) const NUM_PARAMETERS: usize = 8;

/// Whether the words state the angle from which a camera looks: high, low, overhead.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Angle {
    /// They do not.
    Free,
    /// They do, at one end at least.
    Stated,
}

/// A stretch of the film with one kind of motion.
#[derive(Debug, Clone)]
pub(super) struct MotionSegment {
    /// Index of the program's step that the segment belongs to.
    pub(super) step: usize,
    /// Camera at each keyframe; at least two.
    pub(super) states: Vec<CameraState>,
    /// The kind of motion.
    pub(super) movement: Move,
    /// Point that the camera stays aimed at, and the center of the circle where the move is an orbit; world.
    pub(super) pivot: Option<DVec3>,
    /// Duration.
    pub(super) secs: f64,
    /// Whether the prompt states that duration.
    pub(super) secs_bind: bool,
    /// Speed profile over the whole segment.
    pub(super) easing: Easing,
    /// The segment begins with a cut.
    pub(super) cut: bool,
    /// The segment only turns the camera to where the step's own motion starts.
    pub(super) is_join: bool,
    /// Whether the words state the angle from which the camera looks.
    pub(super) angle: Angle,
    /// Constraints on the segment's frames.
    pub(super) constraints: Vec<Constraint>,
}

impl MotionSegment {
    /// A segment of a step, without constraints.
    pub(super) fn new(step: usize, movement: Move, states: Vec<CameraState>, secs: f64) -> Self {
        Self {
            step,
            states,
            movement,
            pivot: None,
            secs,
            secs_bind: false,
            easing: Easing::Smooth,
            cut: false,
            is_join: false,
            angle: Angle::Free,
            constraints: Vec::new(),
        }
    }

    /// The same segment, aimed at a point throughout.
    pub(super) fn about(mut self, pivot: DVec3) -> Self {
        self.pivot = Some(pivot);
        self
    }

    /// The same segment with one more constraint.
    pub(super) fn requiring(mut self, scope: Scope, kind: ConstraintKind) -> Self {
        self.constraints.push(Constraint { kind, scope });
        self
    }

    /// The camera at the end.
    pub(super) fn last(&self) -> CameraState {
        self.states[self.states.len() - 1]
    }
}

/// The labels that the keyframes of one step record.
#[derive(Debug, Clone, Default)]
pub(super) struct StepLabels {
    pub(super) start_subjects: Vec<u32>,
    pub(super) end_subjects: Vec<u32>,
    pub(super) start_size: Option<ShotSize>,
    pub(super) end_size: Option<ShotSize>,
    pub(super) start_angle: Option<ShotAngle>,
    pub(super) end_angle: Option<ShotAngle>,
    pub(super) words: Option<[usize; 2]>,
}

/// Keyframes of consecutive segments, starting at time 0. The state that two neighbors share is written once.
pub(super) fn keyframes(segments: &[MotionSegment], labels: &[StepLabels]) -> Vec<Keyframe> {
    let mut keys: Vec<Keyframe> = Vec::new();
    let mut time_secs = 0.0;
    for (p, segment) in segments.iter().enumerate() {
        if p > 0 && !segment.cut {
            // The shared keyframe belongs to the segment that it starts: its easing and intent describe what follows.
            keys.pop();
        }
        let num_intervals = segment.states.len() - 1;
        let times = even_times(segment, time_secs);
        for (i, state) in segment.states.iter().enumerate() {
            // Two keyframes cannot share a time: the first one after a cut comes a moment later.
            let nudge = if segment.cut && p > 0 && i == 0 { CUT_SECS } else { 0.0 };
            keys.push(Keyframe {
                time_secs: times[i] + nudge,
                pose: state.pose,
                fov_y_rad: state.fov_y_rad,
                focus_distance: state.focus_distance,
                optics: cinesplat_trajectory::KeyOptics::default(),
                easing: interval_easing(segment.easing, i.min(num_intervals - 1), num_intervals),
                cut: segment.cut && p > 0 && i == 0,
                intent: labels.get(segment.step).map(|label| intent(segment, label, i)),
            });
        }
        time_secs += segment.secs;
    }
    keys
}

/// Time between the last keyframe before a cut and the first one after it.
const CUT_SECS: f64 = 1e-3;

/// Easing between two keyframes of a segment. A segment with several intervals accelerates in its first and decelerates
/// in its last, because no easing describes a piece of another one.
fn interval_easing(easing: Easing, interval: usize, num_intervals: usize) -> Easing {
    if num_intervals == 1 {
        return easing;
    }
    let starts = interval == 0 && easing.rests_at_start();
    let ends = interval + 1 == num_intervals && easing.rests_at_end();
    match (starts, ends) {
        (true, true) => Easing::Smooth,
        (true, false) => Easing::EaseIn,
        (false, true) => Easing::EaseOut,
        (false, false) => Easing::Linear,
    }
}

/// Times of a segment's keyframes, proportional to the distance between them. `retime` later makes them exact along the
/// film's curve.
fn even_times(segment: &MotionSegment, start_secs: f64) -> Vec<f64> {
    let length = |pair: &[CameraState]| {
        let travel = pair[0].pose.position.distance(pair[1].pose.position);
        travel.max(1e-6)
    };
    let lengths: Vec<f64> = segment.states.windows(2).map(length).collect();
    let total: f64 = lengths.iter().sum();
    let mut at = start_secs;
    let mut times = vec![at];
    for length in &lengths {
        at += segment.secs * length / total;
        times.push(at);
    }
    times
}

fn intent(segment: &MotionSegment, label: &StepLabels, key: usize) -> Intent {
    let at_end = key + 1 == segment.states.len();
    let at_start = key == 0;
    let subjects = if at_end { &label.end_subjects } else { &label.start_subjects };
    Intent {
        subjects: subjects.clone(),
        size: if at_end { label.end_size } else { label.start_size.filter(|_| at_start) },
        movement: Some(segment.movement),
        angle: if at_end { label.end_angle } else { label.start_angle.filter(|_| at_start) },
        words: label.words,
        pivot: segment.pivot,
        look_at: None,
    }
}

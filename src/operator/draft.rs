//! A film in the making: parts with their states, and what each part has to keep.

use glam::DVec3;

use super::framing::Target;
use cinesplat_trajectory::{CameraState, Easing, Intent, Keyframe, Move, ShotAngle, ShotSize};

/// Choices that a step leaves open, each 0..1; what each one means is up to the move.
pub(super) type Genes = [f64; NUM_GENES];
/// Number of open choices a step.
pub(super) const NUM_GENES: usize = 8;

/// A stretch of one kind of motion.
#[derive(Debug, Clone)]
pub(super) struct Part {
    /// Index of the program's step it belongs to.
    pub(super) step: usize,
    /// The camera at the keys, at least two.
    pub(super) states: Vec<CameraState>,
    /// What the stretch is.
    pub(super) movement: Move,
    /// Point that the camera keeps its aim on, and circles where the move is an orbit.
    pub(super) pivot: Option<DVec3>,
    /// Length in time.
    pub(super) secs: f64,
    /// Whether the words fix that length.
    pub(super) secs_bind: bool,
    /// How the speed changes over the whole part.
    pub(super) easing: Easing,
    /// It begins with a cut.
    pub(super) cut: bool,
    /// It only leads over to the step's own motion.
    pub(super) is_join: bool,
    /// What it has to keep.
    pub(super) goals: Vec<Goal>,
}

/// Something that a part has to keep, checked on its frames.
#[derive(Debug, Clone)]
pub(super) struct Goal {
    /// What is wanted.
    pub(super) kind: GoalKind,
    /// On which frames.
    pub(super) when: When,
}

/// Frames of a part on which a goal must hold.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum When {
    /// The first.
    Start,
    /// The last.
    End,
    /// All.
    All,
    /// At least one.
    Any,
}

/// What a goal measures.
#[derive(Debug, Clone)]
pub(super) enum GoalKind {
    /// The target's aim at most this far from the frame's middle.
    Centered(Target, f64),
    /// The target's aim on the left or right third of the frame.
    OnThird(Target),
    /// At least this share of the subject's framed points seen past everything else.
    Unoccluded(u32, f64),
    /// Projected height over the frame's in this band.
    Height(Target, (f64, f64)),
    /// At least this share of the corners and points of these subjects in the frame.
    InFrame(Vec<u32>, f64),
    /// At most this share of the corners and points of these subjects in the frame.
    NotWhole(Vec<u32>, f64),
    /// Pitch of the camera in this band, degrees.
    Pitch((f64, f64)),
    /// Total turn to the right in this band, degrees (a stretch value).
    YawChange((f64, f64)),
    /// Total turn upward in this band, degrees (a stretch value).
    PitchChange((f64, f64)),
    /// Distance to the point at the end over that at the start, in this band (a stretch value).
    DistanceRatio(DVec3, (f64, f64)),
    /// Tangent of half the field of view at the end over that at the start, in this band (a stretch value).
    LensRatio((f64, f64)),
    /// Way along an axis of the first camera over the distance to the point at the start, at least this much, and at
    /// least 0.9 of the whole way (a stretch value).
    Travel(Axis, DVec3, f64),
}

/// Axis of the first camera of a stretch, or the world's up.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Axis {
    /// To the camera's right.
    Right,
    /// To its left.
    Left,
    /// Along the world's up.
    Up,
    /// Against the world's up.
    Down,
}

impl Part {
    /// A part of a step with nothing to keep yet.
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
            goals: Vec::new(),
        }
    }

    /// The same with the aim kept on a point.
    pub(super) fn about(mut self, pivot: DVec3) -> Self {
        self.pivot = Some(pivot);
        self
    }

    /// The same with one more thing to keep.
    pub(super) fn keeping(mut self, when: When, kind: GoalKind) -> Self {
        self.goals.push(Goal { kind, when });
        self
    }

    /// The camera at the end.
    pub(super) fn last(&self) -> CameraState {
        self.states[self.states.len() - 1]
    }
}

/// What the keys of one step say about themselves.
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

/// Keys of a film: the parts one after the other from time 0, with the shared state of two neighbors written once.
pub(super) fn keyframes(parts: &[Part], labels: &[StepLabels]) -> Vec<Keyframe> {
    let mut keys: Vec<Keyframe> = Vec::new();
    let mut time_secs = 0.0;
    for (p, part) in parts.iter().enumerate() {
        if p > 0 && !part.cut {
            // The end of the part before is the start of this one, which knows what comes next.
            keys.pop();
        }
        let num_segments = part.states.len() - 1;
        let times = even_times(part, time_secs);
        for (i, state) in part.states.iter().enumerate() {
            // The jump happens one millisecond of the hold before it: two keys cannot share a time.
            let nudge = if part.cut && p > 0 && i == 0 { CUT_SECS } else { 0.0 };
            keys.push(Keyframe {
                time_secs: times[i] + nudge,
                pose: state.pose,
                fov_y_rad: state.fov_y_rad,
                focus_distance: state.focus_distance,
                easing: segment_easing(part.easing, i.min(num_segments - 1), num_segments),
                cut: part.cut && p > 0 && i == 0,
                intent: labels.get(part.step).map(|label| intent(part, label, i)),
            });
        }
        time_secs += part.secs;
    }
    keys
}

/// Time between the last key before a cut and the first after it.
pub(super) const CUT_SECS: f64 = 1e-3;

/// Easing of one segment of a part. Of several segments each cruises, with ramps at the part's ends only: a curve over
/// all of them has no name for its pieces.
fn segment_easing(easing: Easing, segment: usize, num_segments: usize) -> Easing {
    if num_segments == 1 {
        return easing;
    }
    let starts = segment == 0 && easing.rests_at_start();
    let ends = segment + 1 == num_segments && easing.rests_at_end();
    match (starts, ends) {
        (true, true) => Easing::Smooth,
        (true, false) => Easing::EaseIn,
        (false, true) => Easing::EaseOut,
        (false, false) => Easing::Linear,
    }
}

/// Times of a part's keys by the length between them; `retimed` makes them exact for the film.
fn even_times(part: &Part, start_secs: f64) -> Vec<f64> {
    let length = |pair: &[CameraState]| {
        let travel = pair[0].pose.position.distance(pair[1].pose.position);
        travel.max(1e-6)
    };
    let lengths: Vec<f64> = part.states.windows(2).map(length).collect();
    let total: f64 = lengths.iter().sum();
    let mut at = start_secs;
    let mut times = vec![at];
    for length in &lengths {
        at += part.secs * length / total;
        times.push(at);
    }
    times
}

fn intent(part: &Part, label: &StepLabels, key: usize) -> Intent {
    let at_end = key + 1 == part.states.len();
    let at_start = key == 0;
    let subjects = if at_end { &label.end_subjects } else { &label.start_subjects };
    Intent {
        subjects: subjects.clone(),
        size: if at_end { label.end_size } else { label.start_size.filter(|_| at_start) },
        movement: Some(part.movement),
        angle: if at_end { label.end_angle } else { label.start_angle.filter(|_| at_start) },
        words: label.words,
        pivot: part.pivot,
    }
}

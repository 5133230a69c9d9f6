//! Constraints on the frames of a motion segment. `measure` measures them, `wording` puts them in words.

use std::slice;

use glam::DVec3;

use super::framing::Target;
use super::program::{FramePlace, Limit, Motion, Pass, SubjectSide};
use super::world::{Subject, World};
use cinesplat_trajectory::{Move, ShotAngle};

/// A constraint on the frames of a segment.
#[derive(Debug, Clone)]
pub(super) struct Constraint {
    /// The requirement.
    pub(super) kind: ConstraintKind,
    /// Frames on which it must hold.
    pub(super) scope: Scope,
}

/// Frames of a segment on which a constraint must hold.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Scope {
    /// The first.
    Start,
    /// The last.
    End,
    /// All.
    All,
    /// At least one.
    Any,
}

impl Scope {
    /// Whether it means the frame at an end.
    pub(super) fn covers(self, end: Self) -> bool {
        self == end || self == Self::All
    }

    /// The states that it means, of at least one.
    pub(super) fn of<T>(self, states: &[T]) -> &[T] {
        match self {
            Self::Start => &states[..1],
            Self::End => &states[states.len() - 1..],
            Self::All | Self::Any => states,
        }
    }
}

/// The requirement of a constraint. Values over the whole segment, such as a turn, ignore the scope.
#[derive(Debug, Clone)]
pub(super) enum ConstraintKind {
    /// The target's aim is at most this far from the frame's middle.
    Centered(Target, f64),
    /// The target's aim is on the left or right third of the frame.
    OnThird(Target),
    /// At least this share of the subject's points in the frame is visible.
    Unoccluded(u32, f64),
    /// Projected height over the frame's height is in this range.
    Height(Target, (f64, f64)),
    /// At least this share of each subject's corners and points is in the frame.
    InFrame(Vec<u32>, f64),
    /// At most this share of the corners and points is in the frame, for at least one of the subjects.
    NotWhole(Vec<u32>, f64),
    /// Pitch of the camera is in this range, degrees.
    Pitch((f64, f64)),
    /// Total turn to the right over the segment is in this range, degrees.
    YawChange((f64, f64)),
    /// Total turn upward over the segment is in this range, degrees.
    PitchChange((f64, f64)),
    /// Distance to the point at the end over that at the start is in this range.
    DistanceRatio(DVec3, (f64, f64)),
    /// Tangent of half the field of view at the end over that at the start is in this range.
    LensRatio((f64, f64)),
    /// Travel in a direction, over the distance to the point at the start, is at least this much, and at least 0.9 of
    /// the whole displacement.
    Travel(TravelDirection, DVec3, f64),
    /// The target's aim is at a place of the frame, within [`PLACE_TOLERANCE`].
    Placed(Target, FramePlace),
    /// Distance from the camera to the center of the target's first subject is in this range, scene units.
    Distance(Target, (f64, f64)),
    /// Elevation of the camera, seen from the center of the target's first subject, is in this range, degrees.
    Elevation(Target, (f64, f64)),
    /// Height of the camera above the floor is in this range, scene units.
    CameraHeight((f64, f64)),
    /// Vertical field of view is in this range, degrees.
    FieldOfView((f64, f64)),
    /// The camera's azimuth about the target's first subject is on a side, within [`side_tolerance_deg`].
    FromSide(Target, SubjectSide),
    /// At most this share of all points of the subject is in the frame and visible.
    Unseen(u32, f64),
    /// The point, named for the report, is at most this far from the frame's middle.
    LookAt(DVec3, String, f64),
    /// The view axis is within this many degrees of the direction of travel (sign 1) or of its opposite (sign -1), on
    /// the first [`AHEAD_FRAC`] of the segment.
    LookAlong(f64, f64),
    /// The path passes an object.
    Passed(Pass, u32),
    /// The object is nearer than the target and in the outer third of the frame or its lower part: the middle of its
    /// points in the frame is [`FOREGROUND_OFF`] and more beside or below the frame's middle.
    Foreground(u32, Target),
    /// The object is seen behind the target's first subject: [`BACKDROP_FRAC`] of it is in the frame, its center is
    /// farther away, and in the frame at most [`BACKDROP_OFF`] beside the subject's.
    Backdrop(u32, Target),
    /// The segment also contains a further move; the point is its subject.
    Also(Move, DVec3),
    /// The segment does not contain a motion. The report lists it once for the whole film.
    Without(Motion),
    /// The camera keeps a limit, but for speeds. The report lists it once for the whole film.
    Limited(Limit),
}

impl Constraint {
    /// The subject that has to be visible, if that is the requirement.
    pub(super) fn shown<'a>(&self, world: &'a World) -> Option<&'a Subject> {
        self.shown_id().and_then(|id| world.subject(id))
    }

    /// Its identifier.
    pub(super) fn shown_id(&self) -> Option<u32> {
        match self.kind {
            ConstraintKind::Unoccluded(id, _) => Some(id),
            _ => None,
        }
    }

    /// The identifiers of the subjects that it wants to be seen, in full or in passing.
    pub(super) fn about(&self) -> &[u32] {
        match &self.kind {
            ConstraintKind::Unoccluded(id, _) | ConstraintKind::Passed(Pass::Past, id) => slice::from_ref(id),
            ConstraintKind::InFrame(ids, _) => ids,
            _ => &[],
        }
    }
}

/// Distance from a place of the frame that counts as there, over the frame's width and height.
pub(super) const PLACE_TOLERANCE: f64 = 0.04;
/// Least distance of a foreground from the frame's middle, to a side or below, over the frame's width or height.
pub(super) const FOREGROUND_OFF: f64 = 1.0 / 6.0;
/// Least share of a backdrop in the frame, and its largest distance beside its subject, over the frame's width.
pub(super) const BACKDROP_FRAC: f64 = 0.4;
pub(super) const BACKDROP_OFF: f64 = 0.5;
/// Angle from the middle of a side that counts as that side, and from half way between two sides, degrees.
const SIDE_TOLERANCE_DEG: f64 = 40.0;
const QUARTER_TOLERANCE_DEG: f64 = 35.0;
/// Angle from the middle of a side, or of a place between two, that counts as there, degrees.
pub(super) fn side_tolerance_deg(side: SubjectSide) -> f64 {
    match side {
        SubjectSide::FromFrontQuarter | SubjectSide::FromBackQuarter => QUARTER_TOLERANCE_DEG,
        _ => SIDE_TOLERANCE_DEG,
    }
}

/// Share of a segment on which a camera that looks along its path must do so; on the rest it may turn to its goal.
pub(super) const AHEAD_FRAC: f64 = 0.7;

/// Direction of a sliding move.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[derive(strum::Display)]
#[strum(serialize_all = "kebab-case")]
pub(super) enum TravelDirection {
    /// To the right of the segment's first camera.
    Right,
    /// To the left of the segment's first camera.
    Left,
    /// Along the world's up.
    Up,
    /// Against the world's up.
    Down,
}

impl TravelDirection {
    /// Whether the direction is along or against the world's up.
    pub(super) fn is_vertical(self) -> bool {
        matches!(self, Self::Up | Self::Down)
    }
}

/// Range of the camera's pitch for an angle of the shot, degrees, positive up.
pub(super) fn pitch_band_deg(angle: ShotAngle) -> (f64, f64) {
    match angle {
        ShotAngle::Overhead => (-90.0, -50.0),
        ShotAngle::High => (-40.0, -12.0),
        ShotAngle::EyeLevel => (-12.0, 10.0),
        ShotAngle::Low => (8.0, 42.0),
        ShotAngle::Worm => (38.0, 90.0),
    }
}

//! Motion tags of paths, as two published systems define them.
//!
//! E.T. (R. Courant et al., "E.T. the Exceptional Trajectories", ECCV 2024) has 27 classes of translation. GenDoP (M.
//! Zhang et al., "GenDoP: Auto-regressive Camera Trajectory Generation as a Director of Photography", 2025) has the
//! same 27 classes times 7 classes of rotation.
//!
//! The motion from each frame to the next is expressed in the camera's axes. An axis is active if its speed is above a
//! threshold in scene units per second and no other axis is much faster. A mode filter smooths the classes, and runs
//! that are too short are given to their neighbors. The thresholds are those of the two systems; they are not
//! independent of the path's scale.

use std::fmt;

use glam::{DMat3, DQuat, DVec3};
use strum::VariantArray;

use super::Trajectory;
use super::tag_runs::{Run, smoothed, without_short_runs};
use cinesplat_geometry::rotation;

/// Speed above which an axis is active, scene units per second.
const ACTIVE_SPEED: f64 = 0.02;
/// Relative difference of two speeds above which the slower axis is dropped.
const DOMINANCE: f64 = 0.4;
/// Rotation above which a frame turns, rad per frame.
const ACTIVE_TURN: f64 = 0.005;
/// Largest number of segments of a GenDoP description.
const MAX_SEGMENTS: usize = 4;

/// A system of motion tags.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Tagger {
    /// E.T.: translations, at 25 frames per second, in OpenCV axes.
    Et,
    /// GenDoP: translations and rotations, at 30 frames per second, in OpenGL axes.
    Gendop,
}

/// The motion of a frame or segment in camera axes: -1, 0 or 1 along right, up and forward, and a turn.
///
/// Displayed in words: `right and forward, yaw left`, or `static`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct MotionTag {
    /// Movement to the camera's right (1) or left (-1).
    pub right: i8,
    /// Movement along the camera's up (1) or down (-1).
    pub up: i8,
    /// Movement forward (1) or back (-1).
    pub forward: i8,
    /// The turn; always [`Turn::None`] for E.T.
    pub turn: Turn,
}

/// The main rotation of a frame, in the order of GenDoP's classes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[derive(strum::AsRefStr, strum::Display, strum::EnumString)]
#[derive(strum::VariantArray)]
pub enum Turn {
    /// No turn.
    #[default]
    #[strum(serialize = "")]
    None,
    /// The view tilts up.
    #[strum(serialize = "pitch up")]
    PitchUp,
    /// The view tilts down.
    #[strum(serialize = "pitch down")]
    PitchDown,
    /// The view pans left.
    #[strum(serialize = "yaw left")]
    YawLeft,
    /// The view pans right.
    #[strum(serialize = "yaw right")]
    YawRight,
    /// The camera's left side dips.
    #[strum(serialize = "roll left")]
    RollLeft,
    /// The camera's right side dips.
    #[strum(serialize = "roll right")]
    RollRight,
}

/// Consecutive motions with one tag.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TagSegment {
    /// Index of the first motion, from frame `start` to the next.
    pub start: usize,
    /// Index after that of the last motion.
    pub end: usize,
    /// The tag.
    pub tag: MotionTag,
}

impl fmt::Display for MotionTag {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let word = |sign: i8, positive: &'static str, negative: &'static str| match sign {
            1 => Some(positive),
            -1 => Some(negative),
            _ => None,
        };
        let moves =
            [word(self.right, "right", "left"), word(self.up, "up", "down"), word(self.forward, "forward", "back")];
        let moves = moves.into_iter().flatten().collect::<Vec<_>>().join(" and ");
        match (moves.is_empty(), self.turn) {
            (true, Turn::None) => f.write_str("static"),
            (true, turn) => write!(f, "{turn}"),
            (false, Turn::None) => f.write_str(&moves),
            (false, turn) => write!(f, "{moves}, {turn}"),
        }
    }
}

impl Tagger {
    fn fps(self) -> f64 {
        if self == Self::Et { 25.0 } else { 30.0 }
    }

    /// Length of the mode filter and shortest run that is kept, motions.
    fn smoothing(self) -> (usize, usize) {
        if self == Self::Et { (56, 25) } else { (15, 10) }
    }

    /// The class of every motion, without smoothing.
    fn classes(self, path: &Trajectory) -> Vec<usize> {
        let motion = |idx: usize| {
            let back = path.rotations[idx].transpose();
            let velocity = back * (path.positions[idx + 1] - path.positions[idx]) * self.fps();
            (velocity, back * path.rotations[idx + 1])
        };
        (0..path.len().saturating_sub(1)).map(|idx| self.class(motion(idx))).collect()
    }

    fn class(self, (velocity, turn): (DVec3, DMat3)) -> usize {
        if self == Self::Et {
            return translation_class(velocity);
        }
        let opengl = DMat3::from_diagonal(DVec3::new(1.0, -1.0, -1.0));
        let turn = rotation::log(DQuat::from_mat3(&(opengl * turn * opengl)).normalize());
        7 * translation_class(opengl * velocity) + rotation_class(turn)
    }

    fn tag(self, class: usize) -> MotionTag {
        let (translation, turn) = if self == Self::Et { (class, 0) } else { (class / 7, class % 7) };
        let sign = |digit: usize| [0, 1, -1][digit % 3];
        let (x, y, z) = (sign(translation / 9), sign(translation / 3), sign(translation));
        // In E.T. y points down and z forward, in GenDoP y points up and z back.
        let flip = if self == Self::Et { 1 } else { -1 };
        MotionTag {
            right: x,
            up: -y * flip,
            forward: z * flip,
            turn: Turn::VARIANTS.get(turn).copied().unwrap_or_default(),
        }
    }

    /// The segments of a path, in order.
    ///
    /// GenDoP increases the length of its filter and of its shortest run until at most four segments are left.
    pub fn segments(self, path: &Trajectory) -> Vec<TagSegment> {
        let classes = self.classes(path);
        let (mut window, mut shortest) = self.smoothing();
        loop {
            let segments = self.tagged(&without_short_runs(&smoothed(&classes, window), shortest));
            if self == Self::Et || segments.len() <= MAX_SEGMENTS || window > 2 * classes.len() {
                return segments;
            }
            window += 5;
            shortest += 5;
        }
    }

    /// The tag of every motion after smoothing.
    pub fn tags(self, path: &Trajectory) -> Vec<MotionTag> {
        self.segments(path).iter().flat_map(|segment| vec![segment.tag; segment.end - segment.start]).collect()
    }

    fn tagged(self, runs: &[Run]) -> Vec<TagSegment> {
        runs.iter().map(|run| TagSegment { start: run.start, end: run.end, tag: self.tag(run.class) }).collect()
    }
}

/// The class 9 x + 3 y + z, where the digit of an axis is 0 for no motion, 1 for positive and 2 for negative motion.
fn translation_class(velocity: DVec3) -> usize {
    let v = velocity.to_array();
    let mut active = v.map(|speed| speed.abs() > ACTIVE_SPEED);
    let weaker = |a: usize, b: usize| {
        let relative = (v[a].abs() - v[b].abs()) / v[a].abs().max(v[b].abs());
        if relative > DOMINANCE { Some(b) } else { (relative < -DOMINANCE).then_some(a) }
    };
    let axes: Vec<usize> = (0..3).filter(|axis| active[*axis]).collect();
    for pair in [(0, 1), (0, 2), (1, 2)] {
        if axes.contains(&pair.0)
            && axes.contains(&pair.1)
            && let Some(axis) = weaker(pair.0, pair.1)
        {
            active[axis] = false;
        }
    }
    let digit = |axis: usize| match (active[axis], v[axis] > 0.0) {
        (false, _) => 0,
        (true, true) => 1,
        (true, false) => 2,
    };
    9 * digit(0) + 3 * digit(1) + digit(2)
}

/// The class of a rotation vector in OpenGL axes: 0 without a turn or with two equal largest components, else
/// 1 + 2 axis, plus 1 for a negative rotation.
fn rotation_class(turn: DVec3) -> usize {
    let t = turn.to_array();
    let is_main = |axis: usize| (0..3).all(|other| other == axis || t[axis].abs() > t[other].abs());
    match (0..3).find(|axis| is_main(*axis)) {
        Some(axis) if t[axis].abs() > ACTIVE_TURN => 1 + 2 * axis + usize::from(t[axis] < 0.0),
        _ => 0,
    }
}

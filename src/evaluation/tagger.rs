//! Motion tags as two published systems give them to paths: E.T. (Courant et al. 2024, 27 translations) and GenDoP
//! (Zhang et al. 2025, the same times 7 rotations).
//!
//! Each frame's motion is seen in the camera's own axes. An axis is active when its speed is above a threshold in absolute
//! units a second, and stays active unless another is much faster; tags are then smoothed by a mode filter, and chunks too
//! short are given to their neighbors. Thresholds are those systems' own and depend on the path's scale.

use glam::{DMat3, DQuat, DVec3};

use super::Trajectory;
use cinesplat_geometry::rotation;

/// Speed above which an axis is active, units a second.
const ACTIVE_SPEED: f64 = 0.02;
/// Relative difference of two speeds beyond which the slower axis is dropped.
const DOMINANCE: f64 = 0.4;
/// Turn above which a frame rotates, rad a frame.
const ACTIVE_TURN: f64 = 0.005;
/// Most segments of a GenDoP description.
const MAX_SEGMENTS: usize = 4;

/// Which system's tags.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Tagger {
    /// Translations alone, 25 frames a second, OpenCV axes.
    Et,
    /// Translations and rotations, 30 frames a second, OpenGL axes.
    Gendop,
}

/// One frame's or segment's motion in camera axes: -1, 0 or 1 along right, up and forward, and a turn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct MotionTag {
    /// Movement to the camera's right (1) or left (-1).
    pub right: i8,
    /// Movement up (1) or down (-1) along the camera's own up.
    pub up: i8,
    /// Movement forward (1) or back (-1).
    pub forward: i8,
    /// The turn; [`Turn::None`] for E.T.
    pub turn: Turn,
}

/// The axis a frame turns about.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Turn {
    /// No turn.
    #[default]
    None,
    /// The view tilts up.
    PitchUp,
    /// The view tilts down.
    PitchDown,
    /// The view pans left.
    YawLeft,
    /// The view pans right.
    YawRight,
    /// The camera rolls to its left (its left side dips).
    RollLeft,
    /// The camera rolls to its right.
    RollRight,
}

/// A stretch of frames with one tag.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TagSegment {
    /// First motion (from frame `start` to the next).
    pub start: usize,
    /// One past the last motion.
    pub end: usize,
    /// Its tag.
    pub tag: MotionTag,
}

impl MotionTag {
    /// The tag in words: `right and forward, yaw left`, or `static`.
    pub fn words(self) -> String {
        let word = |sign: i8, positive: &'static str, negative: &'static str| match sign {
            1 => Some(positive),
            -1 => Some(negative),
            _ => None,
        };
        let moves =
            [word(self.right, "right", "left"), word(self.up, "up", "down"), word(self.forward, "forward", "back")];
        let moves = moves.into_iter().flatten().collect::<Vec<_>>().join(" and ");
        let parts: Vec<String> =
            [moves, self.turn.words().to_owned()].into_iter().filter(|part| !part.is_empty()).collect();
        if parts.is_empty() { "static".to_owned() } else { parts.join(", ") }
    }
}

impl Turn {
    /// The turn in words, empty for none.
    pub fn words(self) -> &'static str {
        match self {
            Self::None => "",
            Self::PitchUp => "pitch up",
            Self::PitchDown => "pitch down",
            Self::YawLeft => "yaw left",
            Self::YawRight => "yaw right",
            Self::RollLeft => "roll left",
            Self::RollRight => "roll right",
        }
    }

    /// From a rotation vector in OpenGL camera axes and the number that GenDoP gives each turn.
    fn from_class(class: usize) -> Self {
        [Self::None, Self::PitchUp, Self::PitchDown, Self::YawLeft, Self::YawRight, Self::RollLeft, Self::RollRight]
            .get(class)
            .copied()
            .unwrap_or_default()
    }
}

impl Tagger {
    fn fps(self) -> f64 {
        if self == Self::Et { 25.0 } else { 30.0 }
    }

    /// Length of the mode filter and of the shortest chunk, motions.
    fn smoothing(self) -> (usize, usize) {
        if self == Self::Et { (56, 25) } else { (15, 10) }
    }

    /// The class of every motion from a frame to the next, neither smoothed nor joined.
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
        // E.T. counts y down and z forward, GenDoP y up and z back.
        let flip = if self == Self::Et { 1 } else { -1 };
        MotionTag { right: x, up: -y * flip, forward: z * flip, turn: Turn::from_class(turn) }
    }

    /// The path's segments.
    ///
    /// GenDoP widens its filter and its shortest chunk until at most four are left.
    pub fn segments(self, path: &Trajectory) -> Vec<TagSegment> {
        let classes = self.classes(path);
        let (mut window, mut shortest) = self.smoothing();
        loop {
            let segments = self.joined(&absorbed(&smoothed(&classes, window), shortest));
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

    fn joined(self, chunks: &[Chunk]) -> Vec<TagSegment> {
        chunks
            .iter()
            .map(|chunk| TagSegment { start: chunk.start, end: chunk.end, tag: self.tag(chunk.class) })
            .collect()
    }
}

/// 9 x + 3 y + z with digits 0 none, 1 positive, 2 negative.
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

/// 0 without a turn, else 1 + 2 axis + (1 when negative).
fn rotation_class(turn: DVec3) -> usize {
    let t = turn.to_array();
    let axis = (1..3).fold(0, |best, axis| if t[axis].abs() > t[best].abs() { axis } else { best });
    if t[axis].abs() > ACTIVE_TURN { 1 + 2 * axis + usize::from(t[axis] < 0.0) } else { 0 }
}

/// Mode filter; lists shorter than the window stay as they are.
fn smoothed(classes: &[usize], window: usize) -> Vec<usize> {
    let (len, half) = (classes.len(), window / 2);
    if len < window {
        return classes.to_vec();
    }
    let around = |idx: usize| match idx {
        _ if idx < half => &classes[..(idx + half + 1).min(len)],
        _ if idx + half < len => &classes[idx - half..=idx + half],
        _ => &classes[idx - half..],
    };
    (0..len).map(|idx| mode(around(idx))).collect()
}

/// Most frequent class, the smallest of equals.
fn mode(classes: &[usize]) -> usize {
    let mut counts = std::collections::BTreeMap::new();
    for class in classes {
        *counts.entry(*class).or_insert(0_usize) += 1;
    }
    counts.into_iter().fold((0, 0), |best, (class, count)| if count > best.1 { (class, count) } else { best }).0
}

/// A run of one class.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Chunk {
    start: usize,
    end: usize,
    class: usize,
}

fn runs(classes: &[usize]) -> Vec<Chunk> {
    let mut chunks: Vec<Chunk> = Vec::new();
    for (idx, class) in classes.iter().enumerate() {
        match chunks.last_mut() {
            Some(last) if last.class == *class => last.end = idx + 1,
            _ => chunks.push(Chunk { start: idx, end: idx + 1, class: *class }),
        }
    }
    chunks
}

/// Gives chunks shorter than `shortest` to their neighbors, the shortest first: at the ends to the only one, in between
/// half to each, the odd motion to the one before.
fn absorbed(classes: &[usize], shortest: usize) -> Vec<Chunk> {
    let mut classes = classes.to_vec();
    loop {
        let chunks = runs(&classes);
        let Some(idx) = (0..chunks.len()).min_by_key(|idx| chunks[*idx].end - chunks[*idx].start) else {
            return chunks;
        };
        let chunk = chunks[idx];
        if chunks.len() == 1 || chunk.end - chunk.start >= shortest {
            return chunks;
        }
        let before = idx.checked_sub(1).map(|idx| chunks[idx].class);
        let after = chunks.get(idx + 1).map(|chunk| chunk.class);
        let split = match (before, after) {
            (Some(_), Some(_)) => chunk.start + (chunk.end - chunk.start).div_ceil(2),
            (None, _) => chunk.start,
            _ => chunk.end,
        };
        classes[chunk.start..split].fill(before.unwrap_or(chunk.class));
        classes[split..chunk.end].fill(after.unwrap_or(chunk.class));
    }
}

//! Pairs of poses for relative errors: two poses a given distance apart along a path.

use glam::{DMat3, DVec3};

use super::error::{EvaluationError, SettingName};
use super::svd::rotation_angle;
use super::trajectory::Trajectory;

/// Largest error of [`approximate_angle`] for matrices that count as rotations, rad.
const APPROXIMATION_RAD: f64 = 0.01;

/// Distance between the two poses of a pair.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Delta {
    /// Number of frames, at least 1.
    Frames(usize),
    /// Distance traveled, scene units.
    Distance(f64),
    /// Angle of rotation, degrees.
    Degrees(f64),
    /// Angle of rotation, rad.
    Radians(f64),
}

/// Unit of a [`Delta`]; named by its letter on the command line.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[derive(strum::AsRefStr, strum::Display, strum::EnumString, strum::IntoStaticStr)]
#[derive(strum::VariantArray, strum::VariantNames)]
pub enum DeltaUnit {
    /// Frames, `f`.
    #[default]
    #[strum(serialize = "f")]
    Frames,
    /// Scene units, `m`.
    #[strum(serialize = "m")]
    Distance,
    /// Degrees, `d`.
    #[strum(serialize = "d")]
    Degrees,
    /// Radians, `r`.
    #[strum(serialize = "r")]
    Radians,
}

impl Delta {
    /// The distance of a value in a unit.
    ///
    /// # Errors
    /// [`EvaluationError::BadSetting`] for a value that is not above 0, a fraction of a frame, or an angle above half a
    /// turn.
    pub fn new(value: f64, unit: DeltaUnit) -> Result<Self, EvaluationError> {
        let bad = |expected| {
            Err(EvaluationError::BadSetting { setting: SettingName::Delta, found: value.to_string(), expected })
        };
        if !(value > 0.0 && value.is_finite()) {
            return bad("above 0");
        }
        match unit {
            DeltaUnit::Frames if value.fract() == 0.0 => Ok(Self::Frames(value as usize)),
            DeltaUnit::Frames => bad("a whole number of frames"),
            DeltaUnit::Distance => Ok(Self::Distance(value)),
            DeltaUnit::Degrees if value <= 180.0 => Ok(Self::Degrees(value)),
            DeltaUnit::Radians if value <= std::f64::consts::PI => Ok(Self::Radians(value)),
            DeltaUnit::Degrees | DeltaUnit::Radians => bad("at most half a turn"),
        }
    }

    /// The value and its unit in words.
    pub(crate) fn named(self) -> (f64, &'static str) {
        match self {
            Self::Frames(frames) => (frames as f64, "frames"),
            Self::Distance(distance) => (distance, "scene units"),
            Self::Degrees(degrees) => (degrees, "degrees"),
            Self::Radians(radians) => (radians, "rad"),
        }
    }
}

/// Settings of the choice of pairs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PairSettings {
    /// Distance between the two poses.
    pub delta: Delta,
    /// Whether every pose may start a pair. Otherwise a pair starts where the previous one ends.
    pub all_pairs: bool,
    /// Tolerance of the distance for overlapping pairs, as a fraction of it.
    pub tolerance_frac: f64,
}

impl Default for PairSettings {
    fn default() -> Self {
        Self { delta: Delta::Frames(1), all_pairs: false, tolerance_frac: 0.1 }
    }
}

/// Indices of the poses of each pair, in order.
///
/// Without overlap a pair ends at the first pose at which the distance, summed from frame to frame, reaches the delta.
/// With overlap and a delta in scene units, each pose is paired with the later pose whose distance along the path is
/// nearest to the delta. With overlap and an angle, it is paired with every later pose at that relative rotation. Both
/// apply the tolerance.
///
/// # Errors
/// [`EvaluationError::NoPairs`] if the path is too short.
pub fn pairs(path: &Trajectory, settings: &PairSettings) -> Result<Vec<(usize, usize)>, EvaluationError> {
    let turn = |a: usize, b: usize| rotation_angle(path.rotations[a].transpose() * path.rotations[b]);
    let step = |idx: usize| path.positions[idx].distance(path.positions[idx + 1]);
    let found = match (settings.delta, settings.all_pairs) {
        (Delta::Frames(frames), true) => {
            (0..path.len().saturating_sub(frames.max(1))).map(|idx| (idx, idx + frames.max(1))).collect()
        }
        (Delta::Frames(frames), false) => {
            let ends: Vec<usize> = (0..path.len()).step_by(frames.max(1)).collect();
            ends.windows(2).map(|pair| (pair[0], pair[1])).collect()
        }
        (Delta::Distance(distance), true) => at_distance(path, distance, distance * settings.tolerance_frac),
        (Delta::Distance(distance), false) => end_to_end(path.len(), distance, step),
        (Delta::Degrees(_) | Delta::Radians(_), all_pairs) => {
            let (value, _) = settings.delta.named();
            let angle = if matches!(settings.delta, Delta::Degrees(_)) { value.to_radians() } else { value };
            if all_pairs {
                at_angle(path, angle, angle * settings.tolerance_frac)
            } else {
                end_to_end(path.len(), angle, |idx| turn(idx, idx + 1))
            }
        }
    };
    if found.is_empty() {
        return Err(no_pairs(path, settings.delta, turn));
    }
    Ok(found)
}

fn no_pairs(path: &Trajectory, asked: Delta, turn: impl Fn(usize, usize) -> f64) -> EvaluationError {
    let (delta, unit) = asked.named();
    let turned = || (1..path.len()).map(|idx| turn(idx - 1, idx)).sum::<f64>();
    let available = match asked {
        Delta::Frames(_) => path.len().saturating_sub(1) as f64,
        Delta::Distance(_) => path.path_length(),
        Delta::Degrees(_) => turned().to_degrees(),
        Delta::Radians(_) => turned(),
    };
    EvaluationError::NoPairs { delta, unit, num_poses: path.len(), available }
}

/// Pairs without overlap: each ends where the sum of the steps since its start reaches `delta`.
fn end_to_end(len: usize, delta: f64, step: impl Fn(usize) -> f64) -> Vec<(usize, usize)> {
    let (mut start, mut since, mut out) = (0, 0.0, Vec::new());
    for idx in 0..len.saturating_sub(1) {
        since += step(idx);
        if since >= delta {
            out.push((start, idx + 1));
            (start, since) = (idx + 1, 0.0);
        }
    }
    out
}

/// For every pose the later one whose distance along the path is nearest to `delta`, if within the tolerance.
fn at_distance(path: &Trajectory, delta: f64, tolerance: f64) -> Vec<(usize, usize)> {
    let mut along = vec![0.0];
    for pair in path.positions.windows(2) {
        along.push(along[along.len() - 1] + pair[0].distance(pair[1]));
    }
    let nearest = |start: usize| {
        let off = |end: usize| (along[end] - along[start] - delta).abs();
        // Distances along a path never decrease; of equal ones the first pose is taken.
        let after = (start + 1) + along[start + 1..].partition_point(|at| at - along[start] < delta);
        let reached = after.min(along.len() - 1);
        let before = reached.checked_sub(1).filter(|end| *end > start && off(*end) <= off(reached));
        let mut end = before.unwrap_or(reached);
        while end > start + 1 && off(end - 1) <= off(end) {
            end -= 1;
        }
        (off(end) <= tolerance).then_some((start, end))
    };
    (0..along.len().saturating_sub(1)).filter_map(nearest).collect()
}

/// All pairs of poses whose relative rotation is `delta` within the tolerance, rad.
fn at_angle(path: &Trajectory, delta: f64, tolerance: f64) -> Vec<(usize, usize)> {
    let (low, high) = (delta - tolerance, delta + tolerance);
    let within = |a: usize, b: usize| {
        let turn = path.rotations[a].transpose() * path.rotations[b];
        // The cheap approximation rejects most pairs; only those near the bounds need the exact angle.
        let approximate = approximate_angle(turn);
        let near = approximate > low - APPROXIMATION_RAD && approximate < high + APPROXIMATION_RAD;
        near && (low..=high).contains(&rotation_angle(turn))
    };
    let later = |a: usize| (a + 1..path.len()).map(move |b| (a, b));
    (0..path.len()).flat_map(later).filter(|(a, b)| within(*a, *b)).collect()
}

/// Angle of a rotation matrix from its skew part and its trace. Its error is about that of the matrix.
fn approximate_angle(turn: DMat3) -> f64 {
    let (x, y, z) = (turn.x_axis, turn.y_axis, turn.z_axis);
    let skew = DVec3::new(y.z - z.y, z.x - x.z, x.y - y.x);
    skew.length().atan2(x.x + y.y + z.z - 1.0)
}

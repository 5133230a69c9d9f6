//! Alignment of an estimate to a reference before errors are computed.
//!
//! Reference for `se3`, `sim3` and `scale`: S. Umeyama, "Least-squares estimation of transformation parameters between
//! two point patterns", PAMI 1991. That method uses positions alone. They do not determine the rotation about a
//! straight line, or any rotation of a stationary camera. In these cases the cameras' rotations determine it, and a note
//! says so.

use glam::{DMat3, DVec3};

use super::convention::Convention;
use super::error::{EvaluationError, SettingName};
use super::svd::{Svd, nearest_rotation, svd};
use super::trajectory::Trajectory;
use cinesplat_geometry::LevelFrame;

/// Singular values of the covariance below this fraction of the largest count as 0: lateral extents below 0.001 of the
/// length. A larger bound treats real bends as straight lines; a smaller one lets noise choose the rotation about the
/// line.
const RANK_TOLERANCE: f64 = 1e-6;
/// Extents below this fraction of the distance from the origin count as rounding errors.
const STILL_TOLERANCE: f64 = 1e-9;

/// The transform that an alignment may use.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[derive(strum::AsRefStr, strum::Display, strum::EnumString, strum::IntoStaticStr)]
#[derive(strum::VariantArray, strum::VariantNames)]
#[strum(serialize_all = "kebab-case")]
pub enum Align {
    /// No transform.
    #[default]
    None,
    /// The rigid transform that makes the first poses equal.
    Origin,
    /// Rotation about up, and translation.
    Yaw,
    /// Rotation and translation.
    Se3,
    /// Rotation, translation and scale.
    Sim3,
    /// Scale alone.
    Scale,
}

/// The transform `p -> rotation * (scale * p) + translation` of an estimate.
#[derive(Debug, Clone, PartialEq)]
pub struct Alignment {
    /// The requested mode.
    pub mode: Align,
    /// Factor of the positions, applied first.
    pub scale: f64,
    /// Rotation of the world; proper, and orthonormal up to the rounding of the files.
    pub rotation: DMat3,
    /// Translation, applied last.
    pub translation: DVec3,
    /// Says how the transform was determined if positions alone do not determine it; `None` otherwise.
    pub note: Option<String>,
}

impl Alignment {
    const fn identity(mode: Align) -> Self {
        Self { mode, scale: 1.0, rotation: DMat3::IDENTITY, translation: DVec3::ZERO, note: None }
    }

    /// The aligned path.
    pub fn apply(&self, path: &Trajectory) -> Trajectory {
        let mut out = path.clone();
        let unmoved = self.rotation == DMat3::IDENTITY && self.translation == DVec3::ZERO;
        for position in &mut out.positions {
            *position *= self.scale;
            *position = if unmoved { *position } else { self.rotation * *position + self.translation };
        }
        if !unmoved {
            out.rotations.iter_mut().for_each(|rotation| *rotation = self.rotation * *rotation);
        }
        out
    }
}

/// Settings of [`align`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct AlignSettings {
    /// The transform.
    pub mode: Align,
    /// Number of poses from the start that determine it; `None` for all.
    pub num_poses: Option<usize>,
    /// By evo's convention positions alone determine the rotation as long as they do so numerically.
    pub convention: Convention,
}

/// The alignment of `estimate` to `reference`, whose poses are matched by index.
///
/// It is defined for every non-empty input (see the module's documentation for straight and stationary paths). Yaw
/// rotates about the reference's up, or about the mean up of its cameras if the file states none.
///
/// # Errors
/// [`EvaluationError::Empty`] without poses, [`EvaluationError::BadSetting`] for a `num_poses` of 0.
pub fn align(
    reference: &Trajectory,
    estimate: &Trajectory,
    settings: &AlignSettings,
) -> Result<Alignment, EvaluationError> {
    let AlignSettings { mode, num_poses, convention } = *settings;
    let count = num_poses.unwrap_or(usize::MAX).min(reference.len()).min(estimate.len());
    if num_poses == Some(0) {
        let found = "0".into();
        return Err(EvaluationError::BadSetting { setting: SettingName::AlignPoses, found, expected: "at least 1" });
    }
    if count == 0 {
        return Err(EvaluationError::Empty { which: "alignment" });
    }
    let first: Vec<usize> = (0..count).collect();
    let (reference, estimate) = (reference.select(&first), estimate.select(&first));
    Ok(match mode {
        Align::None => Alignment::identity(mode),
        Align::Origin => origin(&reference, &estimate),
        Align::Yaw => yaw(&reference, &estimate),
        Align::Se3 | Align::Sim3 | Align::Scale => umeyama(&reference, &estimate, mode, convention),
    })
}

fn origin(reference: &Trajectory, estimate: &Trajectory) -> Alignment {
    let rotation = reference.rotations[0] * estimate.rotations[0].transpose();
    let translation = reference.positions[0] - rotation * estimate.positions[0];
    Alignment { rotation, translation, ..Alignment::identity(Align::Origin) }
}

/// Means and variances of both paths, and the covariance of the reference with the estimate.
struct Moments {
    mean_reference: DVec3,
    mean_estimate: DVec3,
    covariance: DMat3,
    variance_estimate: f64,
    variance_reference: f64,
}

fn moments(reference: &Trajectory, estimate: &Trajectory) -> Moments {
    let count = reference.len() as f64;
    let mean = |points: &[DVec3]| points.iter().sum::<DVec3>() / count;
    let (mean_reference, mean_estimate) = (mean(&reference.positions), mean(&estimate.positions));
    let variance =
        |points: &[DVec3], mean: DVec3| points.iter().map(|p| (*p - mean).length_squared()).sum::<f64>() / count;
    let mut covariance = DMat3::ZERO;
    for (y, x) in reference.positions.iter().zip(&estimate.positions) {
        let (y, x) = (*y - mean_reference, *x - mean_estimate);
        covariance += DMat3::from_cols(y * x.x, y * x.y, y * x.z);
    }
    Moments {
        mean_reference,
        mean_estimate,
        covariance: covariance * (1.0 / count),
        variance_estimate: variance(&estimate.positions, mean_estimate),
        variance_reference: variance(&reference.positions, mean_reference),
    }
}

impl Moments {
    /// Whether either path is stationary up to rounding.
    fn stands(&self) -> bool {
        let still = |variance: f64, mean: DVec3| variance.sqrt() <= STILL_TOLERANCE * mean.length() || variance == 0.0;
        still(self.variance_estimate, self.mean_estimate) || still(self.variance_reference, self.mean_reference)
    }
}

fn umeyama(reference: &Trajectory, estimate: &Trajectory, mode: Align, convention: Convention) -> Alignment {
    let m = moments(reference, estimate);
    let Svd { u, values, v } = svd(m.covariance);
    let handed = if u.determinant() * v.determinant() < 0.0 { -1.0 } else { 1.0 };
    let (rotation, note) = if m.stands() {
        (
            mean_rotation(reference, estimate),
            Some("a path is stationary: the cameras' rotations determine the rotation, scale stays 1"),
        )
    } else if values.y <= straight_below(values, convention) {
        let note = "positions lie on a straight line: the cameras' rotations determine the rotation about it";
        (rotation_about_line(reference, estimate, u.x_axis, v.x_axis), Some(note))
    } else {
        (u * DMat3::from_diagonal(DVec3::new(1.0, 1.0, handed)) * v.transpose(), None)
    };
    let with_scale = matches!(mode, Align::Sim3 | Align::Scale) && !m.stands();
    let trace = values.x + values.y + handed * values.z;
    let scale = if with_scale { trace / m.variance_estimate } else { 1.0 };
    if mode == Align::Scale {
        let note = m.stands().then(|| "a path is stationary: scale stays 1".to_owned());
        return Alignment { scale, note, ..Alignment::identity(mode) };
    }
    let translation = m.mean_reference - rotation * (m.mean_estimate * scale);
    Alignment { mode, scale, rotation, translation, note: note.map(str::to_owned) }
}

/// The second singular value of the covariance up to which a path counts as straight.
fn straight_below(values: DVec3, convention: Convention) -> f64 {
    match convention {
        Convention::Cinesplat => RANK_TOLERANCE * values.x,
        // Below it evo refuses to align.
        Convention::Evo => f64::EPSILON,
    }
}

/// The mean rotation from the estimate's cameras to the reference's, in the least-squares sense.
fn mean_rotation(reference: &Trajectory, estimate: &Trajectory) -> DMat3 {
    nearest_rotation(rotation_sum(reference, estimate))
}

/// Sum of the rotations from the estimate's cameras to the reference's.
fn rotation_sum(reference: &Trajectory, estimate: &Trajectory) -> DMat3 {
    let pairs = reference.rotations.iter().zip(&estimate.rotations);
    pairs.fold(DMat3::ZERO, |sum, (a, b)| sum + *a * b.transpose())
}

/// The rotation that takes the line `from` to the line `to` and, about that line, fits the cameras' rotations best.
///
/// With R1 any rotation of one line to the other and N = R1 * (sum of rotations)^T, the best angle about the unit axis
/// u maximizes cos(a) (tr N - u N u) + sin(a) tr(N [u]).
fn rotation_about_line(reference: &Trajectory, estimate: &Trajectory, to: DVec3, from: DVec3) -> DMat3 {
    let first = DMat3::from_quat(glam::DQuat::from_rotation_arc(from.normalize(), to.normalize()));
    about_axis(to.normalize(), first * rotation_sum(reference, estimate).transpose()) * first
}

/// The rotation about the unit `axis` that maximizes tr(R * n).
fn about_axis(axis: DVec3, n: DMat3) -> DMat3 {
    let trace = |m: DMat3| m.x_axis.x + m.y_axis.y + m.z_axis.z;
    let skew = DMat3::from_cols(
        DVec3::new(0.0, axis.z, -axis.y),
        DVec3::new(-axis.z, 0.0, axis.x),
        DVec3::new(axis.y, -axis.x, 0.0),
    );
    let (cosine, sine) = (trace(n) - axis.dot(n * axis), trace(skew * n));
    DMat3::from_axis_angle(axis, sine.atan2(cosine))
}

fn yaw(reference: &Trajectory, estimate: &Trajectory) -> Alignment {
    let m = moments(reference, estimate);
    let up = reference.up_or_mean();
    let level = LevelFrame::new(up).map_or(DMat3::ZERO, |level| {
        let outer = |a: DVec3| DMat3::from_cols(a * a.x, a * a.y, a * a.z);
        outer(level.north) + outer(level.east)
    });
    // Only the horizontal part of the covariance determines a heading.
    let flat = level * m.covariance * level;
    let extent = flat.x_axis.length() + flat.y_axis.length() + flat.z_axis.length();
    let open = m.stands() || extent <= RANK_TOLERANCE * (m.variance_estimate * m.variance_reference).sqrt();
    let rotation = about_axis(up, if open { rotation_sum(reference, estimate).transpose() } else { flat.transpose() });
    let mut notes = Vec::new();
    if reference.up.is_none() {
        notes.push(format!("up is not known: {up}, the mean of the reference cameras' up, is used"));
    }
    if open {
        notes.push("positions determine no heading: the cameras' rotations do".to_owned());
    }
    let note = (!notes.is_empty()).then(|| notes.join("; "));
    let translation = m.mean_reference - rotation * m.mean_estimate;
    Alignment { rotation, translation, note, ..Alignment::identity(Align::Yaw) }
}

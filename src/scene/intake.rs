//! Validation of decoded Gaussians.
//!
//! Enters: decoded values of any codec. Leaves: columns, the positions of dropped Gaussians and notes. Invariant: every
//! value in the columns is finite and every rotation has unit length. A Gaussian with extreme but valid values is kept.

use std::ops::Range;
use std::path::Path;

use glam::{DQuat, DVec3, Vec3};
use strum::{Display, EnumCount, VariantArray};

use super::error::SceneError;
use super::gaussians::{Gaussians, NUM_SH_REST};
use super::source_file::{SourceFile, collected_bytes};

/// Spherical harmonic of degree 0, 1 / (2 sqrt(pi)): color = 0.5 + `SH_C0` * `f_dc`.
pub(super) const SH_C0: f64 = 0.282_094_791_773_878_14;

/// Largest standard deviation, scene units. Larger ones are clamped, so that squares stay finite in `f32`.
const MAX_SCALE: f64 = 1e15;

/// Distance between the scene's median and the world's origin, in extents of the scene, above which the scene gets a
/// local origin. At 16, `f32` positions are precise to a millionth of the extent.
const MAX_ORIGIN_DISTANCE: f64 = 16.0;

/// A decoded Gaussian before validation.
pub(super) struct RawGaussian {
    /// Mean, world.
    pub(super) mean: DVec3,
    /// Linear standard deviations.
    pub(super) scale: DVec3,
    /// Rotation, a quaternion of any length.
    pub(super) rotation_wxyz: [f64; 4],
    /// Opacity, nominally 0..=1.
    pub(super) opacity: f64,
    /// Coefficients of degree 0.
    pub(super) sh_dc: DVec3,
}

/// Reason for dropping a Gaussian, in the order of the checks.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Display, EnumCount, VariantArray)]
enum DropReason {
    #[strum(serialize = "position is not finite")]
    Position,
    #[strum(serialize = "scale is negative or not finite")]
    Scale,
    #[strum(serialize = "rotation is zero or not finite")]
    Rotation,
    #[strum(serialize = "opacity is not a number")]
    Opacity,
    #[strum(serialize = "color is not finite")]
    Color,
}

/// Collects the valid Gaussians of a file and counts the others.
pub(super) struct Intake {
    means: Vec<DVec3>,
    out: Gaussians,
    num_seen: u32,
    dropped: Vec<u32>,
    num_by_reason: [usize; DropReason::COUNT],
    num_clamped: usize,
}

/// Result of an [`Intake`].
pub(super) struct Collected {
    /// The valid Gaussians.
    pub(super) gaussians: Gaussians,
    /// Positions in the file of the dropped Gaussians, ascending.
    pub(super) dropped: Vec<u32>,
    /// Notes on dropped, repaired and ignored data, one line each.
    pub(super) notes: Vec<String>,
}

impl Intake {
    /// An intake with memory for `count` Gaussians of a degree, 0..=3.
    ///
    /// # Errors
    /// [`SceneError::OutOfMemory`] when the limits forbid that much memory, [`SceneError::NoMemory`] when the system has not
    /// that much.
    pub(super) fn new(source: &SourceFile, count: usize, sh_degree: u8) -> Result<Self, SceneError> {
        source.check_memory(count, sh_degree, 0)?;
        let mut out = Gaussians { sh_degree, ..Gaussians::default() };
        let mut means: Vec<DVec3> = Vec::new();
        let num_rest = count * NUM_SH_REST[usize::from(sh_degree.min(3))];
        let reserved = (means.try_reserve_exact(count))
            .and_then(|()| out.scales.try_reserve_exact(count))
            .and_then(|()| out.rotations.try_reserve_exact(count))
            .and_then(|()| out.opacities.try_reserve_exact(count))
            .and_then(|()| out.sh_dc.try_reserve_exact(count))
            .and_then(|()| out.sh_rest.try_reserve_exact(num_rest));
        if reserved.is_err() {
            return Err(source.no_memory(count, collected_bytes(count, sh_degree)));
        }
        Ok(Self { means, out, num_seen: 0, dropped: Vec::new(), num_by_reason: [0; DropReason::COUNT], num_clamped: 0 })
    }

    /// Adds or drops the next Gaussian of the file. `sh_rest` holds its coefficients above degree 0.
    pub(super) fn push(&mut self, raw: &RawGaussian, sh_rest: &[Vec3]) {
        let file_idx = self.num_seen;
        self.num_seen += 1;
        match checked(raw, sh_rest) {
            Ok(rotation) => {
                let clamped = raw.scale.max_element() > MAX_SCALE;
                self.num_clamped += usize::from(clamped);
                self.means.push(raw.mean);
                self.out.scales.push(raw.scale.min(DVec3::splat(MAX_SCALE)).as_vec3());
                self.out.rotations.push(rotation.as_quat());
                self.out.opacities.push(raw.opacity.clamp(0.0, 1.0) as f32);
                self.out.sh_dc.push(raw.sh_dc.as_vec3());
                self.out.sh_rest.extend_from_slice(sh_rest);
            }
            Err(reason) => {
                self.num_by_reason[reason as usize] += 1;
                self.dropped.push(file_idx);
            }
        }
    }

    /// Counts a Gaussian that the reader of a file inside this one dropped. Its notes tell why.
    pub(super) fn push_dropped(&mut self) {
        self.dropped.push(self.num_seen);
        self.num_seen += 1;
    }

    /// The columns, with a local origin if the scene is far from the world's origin.
    ///
    /// # Errors
    /// [`SceneError::Empty`] when no Gaussian is valid.
    pub(super) fn finish(mut self, path: &Path) -> Result<Collected, SceneError> {
        let drops = self.num_by_reason.iter().zip(DropReason::VARIANTS).filter(|(count, _)| **count > 0);
        let mut notes: Vec<String> = drops.map(|(count, reason)| format!("{count} dropped: {reason}")).collect();
        if self.means.is_empty() {
            let reason = match self.dropped.len() {
                0 => "the file holds none".to_owned(),
                _ if notes.is_empty() => "all are dropped in its files".to_owned(),
                _ => notes.join("; "),
            };
            return Err(SceneError::Empty { path: path.to_path_buf(), found: u64::from(self.num_seen), reason });
        }
        if self.num_clamped > 0 {
            notes.push(format!("{} repaired: scale clamped to {MAX_SCALE:e}", self.num_clamped));
        }
        self.out.origin = local_origin(&self.means);
        if self.out.origin != DVec3::ZERO {
            let o = self.out.origin;
            notes.push(format!(
                "far from the world's origin: positions are stored relative to ({}, {}, {})",
                o.x, o.y, o.z
            ));
        }
        self.out.means = self.means.iter().map(|mean| (*mean - self.out.origin).as_vec3()).collect();
        Ok(Collected { gaussians: self.out, dropped: self.dropped, notes })
    }
}

impl Collected {
    /// Number of Gaussians in the file, with those that were dropped.
    pub(super) fn num_in_file(&self) -> usize {
        self.gaussians.len() + self.dropped.len()
    }

    /// The Gaussians of a range of the file as indices into the columns; `None` for each that was dropped.
    pub(super) fn in_file_order(&self, range: Range<usize>) -> impl Iterator<Item = Option<usize>> {
        let mut num_dropped = self.dropped.partition_point(|idx| (*idx as usize) < range.start);
        range.map(move |file_idx| {
            let is_dropped = self.dropped.get(num_dropped).is_some_and(|idx| *idx as usize == file_idx);
            num_dropped += usize::from(is_dropped);
            (!is_dropped).then(|| file_idx - num_dropped)
        })
    }
}

/// The unit rotation (w >= 0) of a valid Gaussian, or the reason to drop it.
fn checked(raw: &RawGaussian, sh_rest: &[Vec3]) -> Result<DQuat, DropReason> {
    // NaN fails every comparison.
    if !(raw.mean.abs().max_element() <= f64::from(f32::MAX) && raw.mean.is_finite()) {
        return Err(DropReason::Position);
    }
    if !(raw.scale.is_finite() && raw.scale.min_element() >= 0.0) {
        return Err(DropReason::Scale);
    }
    let rotation = unit_rotation(raw.rotation_wxyz).ok_or(DropReason::Rotation)?;
    if raw.opacity.is_nan() {
        return Err(DropReason::Opacity);
    }
    let representable = raw.sh_dc.abs().max_element() <= f64::from(f32::MAX) && raw.sh_dc.is_finite();
    if representable && sh_rest.iter().all(|c| c.is_finite()) { Ok(rotation) } else { Err(DropReason::Color) }
}

/// The normalized quaternion with w >= 0; `None` if it is zero or not finite.
fn unit_rotation(wxyz: [f64; 4]) -> Option<DQuat> {
    // Division by the largest component first prevents the squares from underflow and overflow.
    let largest = wxyz.iter().fold(0.0_f64, |most, v| most.max(v.abs()));
    if !(largest > 0.0 && largest.is_finite() && wxyz.iter().all(|v| v.is_finite())) {
        return None;
    }
    let [w, x, y, z] = wxyz.map(|v| v / largest);
    let unit = DQuat::from_xyzw(x, y, z, w).normalize();
    Some(if unit.w < 0.0 { -unit } else { unit })
}

/// Zero, or a point near the scene's median if that is far from the world's origin in units of the scene's extent. Its
/// coordinates are multiples of a power of two, so that the subtraction from round positions is exact.
fn local_origin(means: &[DVec3]) -> DVec3 {
    let axis = |axis: usize| {
        let mut values: Vec<f64> = means.iter().map(|mean| mean[axis]).collect();
        let last = values.len() - 1;
        let mut at = |frac: f64| *values.select_nth_unstable_by((frac * last as f64) as usize, f64::total_cmp).1;
        (at(0.5), at(0.98) - at(0.02))
    };
    let (x, y, z) = (axis(0), axis(1), axis(2));
    let middle = DVec3::new(x.0, y.0, z.0);
    let extent = DVec3::new(x.1, y.1, z.1).length();
    if middle.length() <= MAX_ORIGIN_DISTANCE * extent || extent == 0.0 && middle.length() < 1e4 {
        return DVec3::ZERO;
    }
    let step = if extent > 0.0 { extent.log2().floor().exp2() } else { 1.0 };
    (middle / step).round() * step
}

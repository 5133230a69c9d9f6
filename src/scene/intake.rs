//! What becomes of each Gaussian on its way in: checked, normalized, counted.
//!
//! Enters: decoded values of any codec. Leaves: columns in which every value is finite and every rotation unit.
//! A Gaussian that cannot be drawn is dropped and counted; one that is merely extreme stays.

use std::path::Path;

use glam::{DQuat, DVec3, Vec3};

use super::error::SceneError;
use super::gaussians::{Gaussians, NUM_SH_REST};

/// Y(0,0) = 1 / (2 sqrt(pi)): color = 0.5 + `SH_C0` * `f_dc`.
pub(super) const SH_C0: f64 = 0.282_094_791_773_878_14;

/// Longest standard deviation kept; longer ones are shortened to it, so that squares stay finite in `f32`.
const MAX_SCALE: f64 = 1e15;

/// How many times the scene's extent its middle may lie from the world's origin before a local origin is used.
/// At 16, `f32` positions are good to a millionth of the extent.
const FAR_OFF: f64 = 16.0;

/// One Gaussian as a codec decodes it: activations applied, nothing checked.
pub(super) struct RawGaussian {
    /// Mean, world.
    pub(super) mean: DVec3,
    /// Linear standard deviations.
    pub(super) scale: DVec3,
    /// Quaternion of any length, w first.
    pub(super) rotation_wxyz: [f64; 4],
    /// Opacity, 0..=1.
    pub(super) opacity: f64,
    /// Degree-0 coefficients.
    pub(super) sh_dc: DVec3,
}

/// Reasons for which a Gaussian is dropped, in the order in which they are looked for.
const REASONS: [&str; 5] = [
    "position is not finite",
    "scale is not a number or infinite",
    "rotation is zero or not finite",
    "opacity is not a number",
    "color is not finite",
];

/// Collects Gaussians and what was wrong with the others.
pub(super) struct Intake {
    means: Vec<DVec3>,
    out: Gaussians,
    num_seen: u32,
    dropped: Vec<u32>,
    num_by_reason: [usize; REASONS.len()],
    num_shortened: usize,
}

/// What an [`Intake`] leaves.
pub(super) struct Collected {
    /// The Gaussians that stay.
    pub(super) gaussians: Gaussians,
    /// Positions in the file of those that do not, ascending.
    pub(super) dropped: Vec<u32>,
    /// One line for each thing that was dropped or repaired.
    pub(super) notes: Vec<String>,
}

impl Intake {
    /// Room for `count` Gaussians of the given degree (0..=3).
    ///
    /// # Errors
    /// [`SceneError::OutOfMemory`] when memory does not hold them.
    pub(super) fn new(path: &Path, count: usize, sh_degree: u8) -> Result<Self, SceneError> {
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
            return Err(SceneError::OutOfMemory { path: path.to_path_buf(), found: count as u64 });
        }
        Ok(Self { means, out, num_seen: 0, dropped: Vec::new(), num_by_reason: [0; REASONS.len()], num_shortened: 0 })
    }

    /// Takes the next Gaussian of the file, or drops it. `sh_rest` are its coefficients above degree 0.
    pub(super) fn push(&mut self, raw: &RawGaussian, sh_rest: &[Vec3]) {
        let file_idx = self.num_seen;
        self.num_seen += 1;
        match checked(raw, sh_rest) {
            Ok(rotation) => {
                let shortened = raw.scale.max_element() > MAX_SCALE;
                self.num_shortened += usize::from(shortened);
                self.means.push(raw.mean);
                self.out.scales.push(raw.scale.min(DVec3::splat(MAX_SCALE)).as_vec3());
                self.out.rotations.push(rotation.as_quat());
                self.out.opacities.push(raw.opacity.clamp(0.0, 1.0) as f32);
                self.out.sh_dc.push(raw.sh_dc.as_vec3());
                self.out.sh_rest.extend_from_slice(sh_rest);
            }
            Err(reason) => {
                self.num_by_reason[reason] += 1;
                self.dropped.push(file_idx);
            }
        }
    }

    /// The columns, with a local origin where the scene lies far off.
    ///
    /// # Errors
    /// [`SceneError::Empty`] when no Gaussian is left.
    pub(super) fn finish(mut self, path: &Path) -> Result<Collected, SceneError> {
        let drops = self.num_by_reason.iter().zip(REASONS).filter(|(count, _)| **count > 0);
        let mut notes: Vec<String> = drops.map(|(count, reason)| format!("{count} dropped: {reason}")).collect();
        if self.means.is_empty() {
            let reason = if notes.is_empty() { "the file holds none".to_owned() } else { notes.join("; ") };
            return Err(SceneError::Empty { path: path.to_path_buf(), found: u64::from(self.num_seen), reason });
        }
        if self.num_shortened > 0 {
            notes.push(format!("{} repaired: scale above {MAX_SCALE:e} shortened to that", self.num_shortened));
        }
        self.out.origin = local_origin(&self.means);
        if self.out.origin != DVec3::ZERO {
            let o = self.out.origin;
            notes.push(format!("far off: positions are kept relative to ({}, {}, {})", o.x, o.y, o.z));
        }
        self.out.means = self.means.iter().map(|mean| (*mean - self.out.origin).as_vec3()).collect();
        Ok(Collected { gaussians: self.out, dropped: self.dropped, notes })
    }
}

/// The unit rotation (w >= 0) of a Gaussian that can be drawn, or the index of the reason why it cannot.
fn checked(raw: &RawGaussian, sh_rest: &[Vec3]) -> Result<DQuat, usize> {
    // Comparisons are phrased so that NaN fails them.
    if !(raw.mean.abs().max_element() <= f64::from(f32::MAX) && raw.mean.is_finite()) {
        return Err(0);
    }
    if !(raw.scale.is_finite() && raw.scale.min_element() >= 0.0) {
        return Err(1);
    }
    let rotation = unit_rotation(raw.rotation_wxyz).ok_or(2_usize)?;
    if raw.opacity.is_nan() {
        return Err(3);
    }
    let representable = raw.sh_dc.abs().max_element() <= f64::from(f32::MAX) && raw.sh_dc.is_finite();
    if representable && sh_rest.iter().all(|c| c.is_finite()) { Ok(rotation) } else { Err(4) }
}

/// The unit quaternion along `wxyz` with w >= 0, or `None` where there is none.
fn unit_rotation(wxyz: [f64; 4]) -> Option<DQuat> {
    // Dividing by the largest part first keeps the squares of 1e-200 and 1e200 from vanishing or overflowing.
    let largest = wxyz.iter().fold(0.0_f64, |most, v| most.max(v.abs()));
    if !(largest > 0.0 && largest.is_finite() && wxyz.iter().all(|v| v.is_finite())) {
        return None;
    }
    let [w, x, y, z] = wxyz.map(|v| v / largest);
    let unit = DQuat::from_xyzw(x, y, z, w).normalize();
    Some(if unit.w < 0.0 { -unit } else { unit })
}

/// Zero, or a point near the scene's middle where that lies far off in units of the scene's extent. It is a multiple
/// of a power of two, so that offsets written as round numbers subtract without rounding.
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
    if middle.length() <= FAR_OFF * extent || extent == 0.0 && middle.length() < 1e4 {
        return DVec3::ZERO;
    }
    let step = if extent > 0.0 { extent.log2().floor().exp2() } else { 1.0 };
    (middle / step).round() * step
}

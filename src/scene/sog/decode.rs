use glam::{DVec3, Vec3};

use super::meta::{Dequantizer, Meta, Palette};
use super::pictures::{Picture, PictureFiles};
use crate::error::SceneError;
use crate::gaussians::NUM_SH_REST;
use crate::intake::{Collected, Intake, RawGaussian};
use crate::source_file::SourceFile;

/// Palette entries per row of the palette picture.
const ENTRIES_PER_ROW: usize = 64;

/// Alpha of a rotation texel: 252 + the index of the omitted component of wxyz.
const FIRST_MODE: u8 = 252;

/// Decodes all Gaussians.
///
/// # Errors
/// [`SceneError::SogPicture`] for an unusable picture, [`SceneError::OutOfMemory`], [`SceneError::Empty`].
pub(super) fn decode(
    source: &SourceFile,
    meta: &Meta,
    files: &mut PictureFiles,
    count: usize,
) -> Result<Collected, SceneError> {
    let mut picture = |name: &str| files.picture(source, name, count);
    let (low, high) = (picture(&meta.means[0])?, picture(&meta.means[1])?);
    let (scales, quats, colors) = (picture(&meta.scales)?, picture(&meta.quats)?, picture(&meta.sh0)?);
    let higher_degrees =
        meta.palette.as_ref().map(|palette| HigherDegrees::read(source, palette, files, count)).transpose()?;
    let degree = higher_degrees.as_ref().map_or(0, |higher_degrees| higher_degrees.degree);
    let mut intake = Intake::new(source, count, degree)?;
    let scale_tables: [[f64; 256]; 3] =
        std::array::from_fn(|channel| meta.scale_dequantizer.table(channel).map(f64::exp));
    let color_tables: [[f64; 256]; 3] = std::array::from_fn(|channel| meta.color_dequantizer.table(channel));
    let opacities = opacity_table(&meta.color_dequantizer);
    let look_up = |tables: &[[f64; 256]; 3], texel: [u8; 4]| {
        DVec3::from_array(std::array::from_fn(|c| tables[c][usize::from(texel[c])]))
    };
    let mut num_unknown_modes = 0_usize;
    for idx in 0..count {
        let rotation_wxyz = rotation_wxyz(quats.rgba[idx]);
        num_unknown_modes += usize::from(rotation_wxyz.is_none());
        let raw = RawGaussian {
            mean: mean(meta.mean_bounds, low.rgba[idx], high.rgba[idx]),
            scale: look_up(&scale_tables, scales.rgba[idx]),
            rotation_wxyz: rotation_wxyz.unwrap_or([1.0, 0.0, 0.0, 0.0]),
            opacity: opacities[usize::from(colors.rgba[idx][3])],
            sh_dc: look_up(&color_tables, colors.rgba[idx]),
        };
        intake.push(&raw, higher_degrees.as_ref().map_or(&[], |higher_degrees| higher_degrees.of(idx)));
    }
    let mut collected = intake.finish(source.path)?;
    if num_unknown_modes > 0 {
        collected
            .notes
            .push(format!("{num_unknown_modes} repaired: rotation of unknown mode replaced by the identity"));
    }
    Ok(collected)
}

/// Opacity per byte: a quantized logit in version 1, a quantized opacity in version 2.
fn opacity_table(dequantizer: &Dequantizer) -> [f64; 256] {
    match dequantizer {
        Dequantizer::Range { mins, .. } if mins.len() == 4 => {
            dequantizer.table(3).map(|logit| 1.0 / (1.0 + (-logit).exp()))
        }
        _ => std::array::from_fn(|byte| byte as f64 / 255.0),
    }
}

/// A mean: 16 bits per axis between the bounds, then the inverse of sign(x) ln(1 + |x|).
fn mean([min, max]: [DVec3; 2], low: [u8; 4], high: [u8; 4]) -> DVec3 {
    let unit =
        DVec3::from_array(std::array::from_fn(|axis| f64::from(u16::from_le_bytes([low[axis], high[axis]])) / 65535.0));
    let log = min + (max - min) * unit;
    DVec3::new(log.x.abs().exp_m1(), log.y.abs().exp_m1(), log.z.abs().exp_m1()) * log.signum()
}

/// A quaternion without its largest component, which follows from the unit length; `None` for an unknown mode.
fn rotation_wxyz([a, b, c, mode]: [u8; 4]) -> Option<[f64; 4]> {
    let omitted = usize::from(mode.checked_sub(FIRST_MODE)?);
    let mut kept =
        [a, b, c].into_iter().map(|byte| (f64::from(byte) / 255.0 * 2.0 - 1.0) * std::f64::consts::FRAC_1_SQRT_2);
    let mut wxyz: [f64; 4] = std::array::from_fn(|idx| if idx == omitted { 0.0 } else { kept.next().unwrap_or(0.0) });
    wxyz[omitted] = (1.0 - wxyz.iter().map(|v| v * v).sum::<f64>()).max(0.0).sqrt();
    Some(wxyz)
}

/// Coefficients above degree 0: a palette of entries, and the index of one entry per Gaussian.
struct HigherDegrees {
    degree: u8,
    /// Coefficients of all entries, entry by entry.
    entries: Vec<Vec3>,
    /// Index of the entry of each Gaussian.
    labels: Vec<u16>,
}

impl HigherDegrees {
    fn read(
        source: &SourceFile,
        palette: &Palette,
        files: &mut PictureFiles,
        count: usize,
    ) -> Result<Self, SceneError> {
        let labels = files.picture(source, &palette.labels, count)?;
        let labels: Vec<u16> =
            labels.rgba[..count].iter().map(|texel| u16::from_le_bytes([texel[0], texel[1]])).collect();
        let picture = files.picture(source, &palette.entries, 0)?;
        let fault = |reason: String| SceneError::SogPicture {
            path: source.path.to_path_buf(),
            file: palette.entries.clone(),
            reason,
        };
        let by_width = (1..=3_u8).find(|degree| picture.width == ENTRIES_PER_ROW * NUM_SH_REST[usize::from(*degree)]);
        let degree =
            by_width.filter(|degree| palette.degree.is_none_or(|stated| stated == *degree)).ok_or_else(|| {
                fault(format!("{} texels wide, expected 192, 512 or 960 for degree 1, 2 or 3", picture.width))
            })?;
        let most = labels.iter().max().copied().unwrap_or(0);
        let num_entries = picture.height * ENTRIES_PER_ROW;
        if usize::from(most) >= num_entries {
            return Err(fault(format!("{num_entries} entries, expected more than the largest index, {most}")));
        }
        Ok(Self { degree, entries: entries(&picture, &palette.dequantizer), labels })
    }

    /// Coefficients of a Gaussian.
    fn of(&self, idx: usize) -> &[Vec3] {
        let n = NUM_SH_REST[usize::from(self.degree)];
        let entry = usize::from(self.labels[idx]);
        &self.entries[entry * n..(entry + 1) * n]
    }
}

/// All texels as coefficients. The texels of an entry are adjacent, so row-major order is the order of entries.
fn entries(picture: &Picture, dequantizer: &Dequantizer) -> Vec<Vec3> {
    let tables: [[f64; 256]; 3] = std::array::from_fn(|channel| dequantizer.table(channel));
    let value = |texel: &[u8; 4]| Vec3::from_array(std::array::from_fn(|c| tables[c][usize::from(texel[c])] as f32));
    picture.rgba.iter().map(value).collect()
}

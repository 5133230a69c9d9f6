use glam::{DVec3, Vec3};
use half::f16;

use super::container::{Container, SpzHeader};
use crate::error::SceneError;
use crate::gaussians::NUM_SH_REST;
use crate::intake::{Collected, Intake, RawGaussian};
use crate::source_file::SourceFile;

/// Scale of the degree-0 coefficients: a byte encodes 0.5 + 0.15 * `f_dc`.
const COLOR_SCALE: f64 = 0.15;

/// Decodes all Gaussians.
///
/// # Errors
/// [`SceneError::OutOfMemory`] when the Gaussians do not fit into memory, [`SceneError::Empty`] when none is valid.
pub(super) fn decode(source: &SourceFile, container: &Container) -> Result<Collected, SceneError> {
    let header = container.header;
    let [positions, alphas, colors, scales, rotations, sh] = &container.attributes;
    let degree = header.sh_degree.min(3);
    let (num_stored, num_rest) = (header.stored_sh(), NUM_SH_REST[usize::from(degree)]);
    let mut intake = Intake::new(source, header.count, degree)?;
    let scale_of: [f64; 256] = std::array::from_fn(|byte| (byte as f64 / 16.0 - 10.0).exp());
    let mut rest = vec![Vec3::ZERO; num_rest];
    let num_rotation_bytes = if header.version < 3 { 3 } else { 4 };
    for idx in 0..header.count {
        let three = |bytes: &[u8]| [bytes[3 * idx], bytes[3 * idx + 1], bytes[3 * idx + 2]];
        let stored = &sh[idx * num_stored * 3..];
        for (coefficient, rgb) in rest.iter_mut().zip(stored.as_chunks::<3>().0) {
            *coefficient = Vec3::from_array(rgb.map(|byte| (f32::from(byte) - 128.0) / 128.0));
        }
        let raw = RawGaussian {
            mean: mean(header, positions, idx),
            scale: DVec3::from_array(three(scales).map(|byte| scale_of[usize::from(byte)])),
            rotation_wxyz: rotation_wxyz(&rotations[idx * num_rotation_bytes..(idx + 1) * num_rotation_bytes]),
            opacity: f64::from(alphas[idx]) / 255.0,
            sh_dc: DVec3::from_array(three(colors).map(|byte| (f64::from(byte) / 255.0 - 0.5) / COLOR_SCALE)),
        };
        intake.push(&raw, &rest);
    }
    intake.finish(source.path)
}

/// A mean: three half floats in version 1, three fixed-point numbers of 24 bits in later versions.
fn mean(header: SpzHeader, positions: &[u8], idx: usize) -> DVec3 {
    if header.version == 1 {
        let at = |axis: usize| {
            f16::from_le_bytes([positions[6 * idx + 2 * axis], positions[6 * idx + 2 * axis + 1]]).to_f64()
        };
        return DVec3::new(at(0), at(1), at(2));
    }
    let step = (-f64::from(header.fractional_bits)).exp2();
    let at = |axis: usize| {
        let byte = 9 * idx + 3 * axis;
        // The three bytes become the upper bytes of a word, so that the right shift extends the sign.
        let word = i32::from_le_bytes([0, positions[byte], positions[byte + 1], positions[byte + 2]]);
        f64::from(word >> 8) * step
    };
    DVec3::new(at(0), at(1), at(2))
}

/// A quaternion wxyz. Three bytes hold x, y, z and omit w >= 0. Four bytes hold two bits for the index of the omitted
/// component of xyzw; then each other component has a sign and 9 bits in units of sqrt(1/2) / 511, the first one highest.
fn rotation_wxyz(packed: &[u8]) -> [f64; 4] {
    let rebuilt = |sum: f64| (1.0 - sum).max(0.0).sqrt();
    if let Some(&[x, y, z]) = packed.as_array() {
        let [x, y, z] = [x, y, z].map(|byte| f64::from(byte) / 127.5 - 1.0);
        return [rebuilt(x * x + y * y + z * z), x, y, z];
    }
    let word = packed.first_chunk().map_or(0, |chunk| u32::from_le_bytes(*chunk));
    let omitted = (word >> 30) as usize;
    let mut xyzw = [0.0; 4];
    let mut bits = word;
    for idx in (0..4).rev().filter(|idx| *idx != omitted) {
        let size = f64::from(bits & 511) / 511.0 * std::f64::consts::FRAC_1_SQRT_2;
        xyzw[idx] = if bits & 512 == 0 { size } else { -size };
        bits >>= 10;
    }
    xyzw[omitted] = rebuilt(xyzw.iter().map(|v| v * v).sum());
    let [x, y, z, w] = xyzw;
    [w, x, y, z]
}

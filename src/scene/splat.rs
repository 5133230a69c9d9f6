//! `.splat`: records of 32 bytes without a header. Enters: bytes. Leaves: Gaussians of degree 0. Reference:
//! antimatter15/splat `convert.py`.

use glam::DVec3;

use super::decoded::DecodedScene;
use super::error::SceneError;
use super::intake::{Intake, RawGaussian, SH_C0};
use super::source_file::SourceFile;

/// Bytes per record: position 3 x f32, linear scale 3 x f32, rgba 4 x u8, rotation wxyz 4 x u8.
const RECORD: usize = 32;

/// Gaussians of a `.splat`.
///
/// # Errors
/// [`SceneError::SplatSize`] for a partial record, [`SceneError::TooManyGaussians`], [`SceneError::OutOfMemory`],
/// [`SceneError::Empty`].
pub(super) fn read(source: &SourceFile) -> Result<DecodedScene, SceneError> {
    let (records, cut) = source.bytes.as_chunks::<RECORD>();
    if records.is_empty() || !cut.is_empty() {
        return Err(SceneError::SplatSize { path: source.path.to_path_buf(), found: source.bytes.len() as u64 });
    }
    let count = source.check_count(records.len() as u64)?;
    let mut intake = Intake::new(source, count, 0)?;
    for record in records {
        intake.push(&gaussian(record), &[]);
    }
    Ok(DecodedScene {
        format: "splat".to_owned(),
        collected: intake.finish(source.path)?,
        filter: None,
        up: None,
        further_sha256: Vec::new(),
    })
}

fn gaussian(record: &[u8; RECORD]) -> RawGaussian {
    let real = |idx: usize| {
        let at = 4 * idx;
        f64::from(f32::from_le_bytes([record[at], record[at + 1], record[at + 2], record[at + 3]]))
    };
    let byte = |idx: usize| f64::from(record[24 + idx]);
    RawGaussian {
        mean: DVec3::new(real(0), real(1), real(2)),
        scale: DVec3::new(real(3), real(4), real(5)),
        rotation_wxyz: std::array::from_fn(|idx| (byte(4 + idx) - 128.0) / 128.0),
        opacity: byte(3) / 255.0,
        sh_dc: (DVec3::new(byte(0), byte(1), byte(2)) / 255.0 - 0.5) / SH_C0,
    }
}

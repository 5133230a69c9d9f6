//! `OpenEXR` pictures, read back by FFmpeg and by `OpenEXR`'s own Python module, where this machine has them.

use std::path::Path;
use std::process::Command;

use cinesplat::video::encode_exr;

use crate::support::report_skip;

const SIZE: [u32; 2] = [37, 21];
const NAMES: [&str; 4] = ["A", "B", "G", "R"];
/// Prints the channels of a picture, one after the other, as numbers on lines.
const READ: &str = "\
import sys, OpenEXR
channels = OpenEXR.File(sys.argv[1], separate_channels=True).channels()
for name in 'ABGR':
    for value in channels[name].pixels.astype('float32').ravel():
        print(float(value))
";

/// Values of all sizes: 0, those of a picture, and lights brighter than white.
fn channels() -> [Vec<f32>; 4] {
    let num = (SIZE[0] * SIZE[1]) as usize;
    [0_usize, 1, 2, 3].map(|channel| {
        let value = |idx: usize| match (idx + channel) % 7 {
            0 => 0.0,
            1 => 60_000.0 / (idx + 1) as f32,
            2 => 1e-6 * idx as f32,
            _ => ((idx * 37 + channel * 11) % 1000) as f32 / 999.0,
        };
        (0..num).map(value).collect()
    })
}

/// Relative error of rounding to half floats; below 2^-14 they have fixed steps of 2^-24.
fn assert_rounded(found: &[f32], wanted: &[f32], who: &str) {
    assert_eq!(found.len(), wanted.len(), "{who}");
    for (found, wanted) in found.iter().zip(wanted) {
        let allowed = (wanted.abs() * 2.0_f32.powi(-11)).max(2.0_f32.powi(-25));
        assert!((found - wanted).abs() <= allowed, "{who}: {found} instead of {wanted}");
    }
}

fn read_by_ffmpeg(path: &Path) -> Option<Vec<f32>> {
    let decode = ["-f", "rawvideo", "-pix_fmt", "gbrapf32le", "-"];
    let output = Command::new("ffmpeg").args(["-v", "error", "-i"]).arg(path).args(decode).output().ok()?;
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    Some(output.stdout.as_chunks::<4>().0.iter().map(|bytes| f32::from_le_bytes(*bytes)).collect())
}

/// `None` where Python has no module `OpenEXR`.
fn read_by_openexr(path: &Path) -> Option<Vec<f32>> {
    let python = std::env::var("CINESPLAT_PYTHON").unwrap_or_else(|_| "python3".to_owned());
    let output = Command::new(python).args(["-c", READ]).arg(path).output().ok()?;
    let errors = String::from_utf8_lossy(&output.stderr);
    if errors.contains("ModuleNotFoundError") {
        return None;
    }
    assert!(output.status.success(), "{errors}");
    Some(String::from_utf8(output.stdout).unwrap().lines().map(|line| line.parse().unwrap()).collect())
}

#[test]
fn other_programs_read_a_picture_within_half_float_rounding() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("picture.exr");
    let wanted = channels();
    let named: Vec<(&str, &[f32])> =
        NAMES.iter().zip(&wanted).map(|(name, values)| (*name, values.as_slice())).collect();
    std::fs::write(&path, encode_exr(&named, SIZE).unwrap()).unwrap();
    let [alpha, blue, green, red] = &wanted;
    match read_by_ffmpeg(&path) {
        Some(found) => assert_rounded(&found, &[green.as_slice(), blue, red, alpha].concat(), "FFmpeg"),
        None => report_skip("ffmpeg"),
    }
    match read_by_openexr(&path) {
        Some(found) => assert_rounded(&found, &wanted.concat(), "OpenEXR"),
        None => report_skip("Python module OpenEXR"),
    }
}

//! Shared by the tests of the renderer: readers of golden cameras and pictures, and differences of two pictures.

use std::path::Path;

use cinesplat::geometry::{Camera, Intrinsics, Pose};
use cinesplat::scene::SplatFilter;
use glam::DMat4;

/// A cameras file: the path of the scene, and the settings and cameras that its pictures were rendered with.
pub(crate) struct GoldenSet {
    pub(crate) scene: String,
    pub(crate) filter: SplatFilter,
    pub(crate) near: f64,
    pub(crate) cameras: Vec<(String, Camera)>,
}

/// Reads the cameras file of a golden set.
pub(crate) fn golden_set(path: &Path) -> GoldenSet {
    let text = std::fs::read_to_string(path).unwrap();
    let json: serde_json::Value = serde_json::from_str(&text).unwrap();
    let cameras = json["cameras"].as_array().unwrap().iter().map(camera).collect();
    let filter = match json["filter"].as_str().unwrap() {
        "mip" => SplatFilter::Mip,
        "classic" => SplatFilter::Classic,
        other => panic!("{}: filter {other}", path.display()),
    };
    GoldenSet { scene: json["scene"].as_str().unwrap().into(), filter, near: json["near"].as_f64().unwrap(), cameras }
}

fn camera(json: &serde_json::Value) -> (String, Camera) {
    let number = |key: &str| json[key].as_f64().unwrap();
    let rows = json["world_from_camera"].as_array().unwrap();
    let entry = |row: usize, column: usize| rows[row].as_array().unwrap()[column].as_f64().unwrap();
    let mut columns = [0.0; 16];
    for (position, value) in columns.iter_mut().enumerate() {
        *value = entry(position % 4, position / 4);
    }
    let intrinsics = Intrinsics {
        width: number("width") as u32,
        height: number("height") as u32,
        fx_px: number("fx"),
        fy_px: number("fy"),
        cx_px: number("cx"),
        cy_px: number("cy"),
    };
    let pose = Pose::from_matrix(DMat4::from_cols_array(&columns)).unwrap();
    (json["name"].as_str().unwrap().into(), Camera { pose, intrinsics })
}

/// The values of a little-endian `float32` `.npy` file.
pub(crate) fn npy(path: &Path) -> Vec<f32> {
    let bytes = std::fs::read(path).unwrap();
    let header_len = usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
    bytes[10 + header_len..].chunks_exact(4).map(|b| f32::from_le_bytes([b[0], b[1], b[2], b[3]])).collect()
}

/// PSNR in dB, both clamped to 0..=1, peak 1.
pub(crate) fn psnr_db(a: &[f32], b: &[f32]) -> f64 {
    assert_eq!(a.len(), b.len());
    let square = |(&a, &b): (&f32, &f32)| (f64::from(a.clamp(0.0, 1.0)) - f64::from(b.clamp(0.0, 1.0))).powi(2);
    let mean = a.iter().zip(b).map(square).sum::<f64>() / a.len() as f64;
    -10.0 * mean.log10()
}

/// Largest absolute difference between two pictures.
pub(crate) fn max_difference(a: &[f32], b: &[f32]) -> f32 {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max)
}

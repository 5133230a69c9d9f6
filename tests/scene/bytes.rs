//! Test files, built byte by byte from the format descriptions without code of the library.

use std::io::Write;

use flate2::{Compression, write::GzEncoder};

/// The 14 properties of every scene, with their values for one Gaussian: mean (1, 2, 3), scales 0.5 1 2, opacity 0.75,
/// rotation by 90 degrees about z, `f_dc` (0.1, 0.2, 0.3).
pub const PROPERTIES: [(&str, f64); 14] = [
    ("x", 1.0),
    ("y", 2.0),
    ("z", 3.0),
    ("f_dc_0", 0.1),
    ("f_dc_1", 0.2),
    ("f_dc_2", 0.3),
    ("opacity", 1.098_612_288_668_109_8),
    ("scale_0", -std::f64::consts::LN_2),
    ("scale_1", 0.0),
    ("scale_2", std::f64::consts::LN_2),
    ("rot_0", std::f64::consts::FRAC_1_SQRT_2),
    ("rot_1", 0.0),
    ("rot_2", 0.0),
    ("rot_3", std::f64::consts::FRAC_1_SQRT_2),
];

/// A PLY header with one `vertex` element of `float` properties.
pub fn header(format: &str, count: &str, names: &[&str]) -> String {
    format!("ply\nformat {format} 1.0\nelement vertex {count}\n{}end_header\n", properties("float", names))
}

/// Header lines of properties of one type.
pub fn properties<S: AsRef<str>>(scalar: &str, names: &[S]) -> String {
    names.iter().map(|name| format!("property {scalar} {}\n", name.as_ref())).collect::<Vec<_>>().concat()
}

/// The names `f_rest_0`, `f_rest_1`, ..
pub fn rest_names(count: usize) -> Vec<String> {
    (0..count).map(|i| format!("f_rest_{i}")).collect()
}

/// A binary little-endian PLY of `float` properties with these rows.
pub fn ply(names: &[&str], rows: &[Vec<f64>]) -> Vec<u8> {
    let mut out = header("binary_little_endian", &rows.len().to_string(), names).into_bytes();
    for value in rows.iter().flatten() {
        out.extend((*value as f32).to_le_bytes());
    }
    out
}

/// The names and values of [`PROPERTIES`].
pub fn one() -> (Vec<&'static str>, Vec<f64>) {
    PROPERTIES.into_iter().unzip()
}

/// A PLY of `count` copies of the Gaussian of [`PROPERTIES`] at x = 0, 1, 2, ..
pub fn row_of(count: usize) -> Vec<u8> {
    let (names, values) = one();
    let at = |x: usize| values.iter().enumerate().map(|(i, v)| if i == 0 { x as f64 } else { *v }).collect();
    ply(&names, &(0..count).map(at).collect::<Vec<_>>())
}

/// An SPZ of version 2 without gzip: two Gaussians of degree 1, 12 fractional bits.
pub fn spz_v2(flags: u8) -> Vec<u8> {
    let mut out = spz_header(2, 2, 1, 12, flags);
    for coordinate in [1.0, -2.0, 0.25, -0.5, 3.0, 100.0] {
        out.extend(&((coordinate * 4096.0) as i32).to_le_bytes()[..3]);
    }
    out.extend([255, 51]);
    out.extend([128, 0, 255, 64, 64, 64]);
    out.extend([160, 144, 176, 160, 160, 160]);
    // x = 0, y = 0, z = 0.70588 (218 / 127.5 - 1 = 0.7098); then no rotation.
    out.extend([128, 127, 218, 128, 128, 128]);
    out.extend((0..18).map(|i| 128 + i * 7));
    out
}

/// The 16 bytes before the attributes of versions 1-3.
pub fn spz_header(version: u32, count: u32, degree: u8, fractional_bits: u8, flags: u8) -> Vec<u8> {
    let mut out = b"NGSP".to_vec();
    out.extend(version.to_le_bytes());
    out.extend(count.to_le_bytes());
    out.extend([degree, fractional_bits, flags, 0]);
    out
}

/// Gzip.
pub fn gzip(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::fast());
    encoder.write_all(bytes).unwrap();
    encoder.finish().unwrap()
}

/// One `.splat` record.
pub fn splat_record(position: [f32; 3], scale: [f32; 3], rgba: [u8; 4], rotation: [u8; 4]) -> Vec<u8> {
    let reals = position.into_iter().chain(scale).flat_map(f32::to_le_bytes);
    reals.chain(rgba).chain(rotation).collect()
}

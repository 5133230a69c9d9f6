use glam::Vec3;

use super::bytes::{properties, rest_names};
use super::{code, read};

const CHUNK: [&str; 18] = [
    "min_x",
    "min_y",
    "min_z",
    "max_x",
    "max_y",
    "max_z",
    "min_scale_x",
    "min_scale_y",
    "min_scale_z",
    "max_scale_x",
    "max_scale_y",
    "max_scale_z",
    "min_r",
    "min_g",
    "min_b",
    "max_r",
    "max_g",
    "max_b",
];

/// A compressed PLY of one chunk with bounds -1..3 (position), -4..0 (log-scale), 0..2 (color), and degree 1.
fn file(words: [u32; 4], num_chunk: usize, sh: bool) -> Vec<u8> {
    let mut text = "ply\nformat binary_little_endian 1.0\nelement chunk 1\n".to_owned();
    text += &properties("float", &CHUNK[..num_chunk]);
    text += "element vertex 1\nproperty uint packed_position\nproperty uint packed_rotation\nproperty uint packed_scale\nproperty uint packed_color\n";
    if sh {
        text += "element sh 1\n";
        text += &properties("uchar", &rest_names(9));
    }
    let mut bytes = (text + "end_header\n").into_bytes();
    let bounds = [[-1.0_f32; 3], [3.0; 3], [-4.0; 3], [0.0; 3], [0.0; 3], [2.0; 3]];
    bytes.extend(bounds.as_flattened()[..num_chunk].iter().flat_map(|v| v.to_le_bytes()));
    bytes.extend(words.iter().flat_map(|w| w.to_le_bytes()));
    if sh {
        bytes.extend([0, 255, 128, 0, 255, 128, 64, 64, 64]);
    }
    bytes
}

#[test]
fn words_decode_to_their_values() {
    // Position x highest, y lowest, z halfway; w omitted from the rotation, x = 0, y = 0, z = sqrt(1/2).
    let words =
        [(2047 << 21) | 1024, (512 << 20) | (512 << 10) | 1023, (2047 << 21) | (1023 << 11) | 2047, 0xff00_33ff];
    let scene = read("a", &file(words, 18, true)).unwrap();
    let g = &scene.gaussians;
    assert_eq!((scene.format.as_str(), g.sh_degree), ("compressed ply", 1));
    assert!(g.means[0].abs_diff_eq(Vec3::new(3.0, -1.0, 1.0 + 4.0 * 0.5 / 2047.0), 1e-6), "{}", g.means[0]);
    assert_eq!((g.scales[0], g.opacities[0]), (Vec3::ONE, 1.0));
    let turned = g.rotations[0] * Vec3::X;
    assert!(turned.abs_diff_eq(Vec3::Y, 3e-3), "{turned}");
    let color = g.sh_dc[0] * 0.282_094_8 + 0.5;
    assert!(color.abs_diff_eq(Vec3::new(2.0, 0.0, 0.4), 1e-5), "{color}");
    assert_eq!(g.sh_rest_of(0)[0], Vec3::new(-4.0, -4.0, (64.5 / 256.0 - 0.5) * 8.0));
    assert_eq!(g.sh_rest_of(0)[1], Vec3::new(4.0, 4.0, (64.5 / 256.0 - 0.5) * 8.0));
}

#[test]
fn old_chunks_have_no_color_bounds() {
    let scene = read("a", &file([0, 0, 0, 0xff00_3300], 12, false)).unwrap();
    assert!(scene.gaussians.base_color(0).abs_diff_eq(Vec3::new(1.0, 0.0, 0.2), 1e-5));
    assert_eq!(scene.gaussians.opacities, [0.0]);
}

#[test]
fn too_few_chunks_are_rejected() {
    let text = String::from_utf8_lossy(&file([0; 4], 12, false)).replace("element chunk 1", "element chunk 0");
    assert!(["PLY-HEADER", "PLY-TRUNCATED"].contains(&code("a", text.as_bytes())));
}

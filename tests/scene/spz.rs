use cinesplat::scene::{SplatFilter, UpSource};
use glam::{DVec3, Vec3};

use super::bytes::{gzip, spz_header, spz_v2};
use super::{code, read};
use crate::support;

#[test]
fn version_2_decodes_to_its_values() {
    for (name, bytes) in [("plain", spz_v2(0)), ("gzip", gzip(&spz_v2(0)))] {
        let scene = read(name, &bytes).unwrap();
        let g = &scene.gaussians;
        assert_eq!((scene.format.as_str(), g.sh_degree, scene.filter), ("spz v2", 1, None));
        assert_eq!(g.means, [Vec3::new(1.0, -2.0, 0.25), Vec3::new(-0.5, 3.0, 100.0)]);
        assert_eq!(g.opacities, [1.0, 0.2]);
        assert!(g.scales[0].abs_diff_eq(Vec3::new(1.0, (-1.0_f32).exp(), 1.0_f32.exp()), 1e-6), "{}", g.scales[0]);
        // A byte encodes 255 * (0.5 + 0.15 f_dc).
        assert!(g.sh_dc[0].abs_diff_eq(Vec3::new(0.013_072, -3.333_333, 3.333_333), 1e-5), "{}", g.sh_dc[0]);
        assert!(
            (g.rotations[0].z - (218.0 / 127.5 - 1.0)).abs() < 1e-5 && (g.rotations[0].x - 0.5 / 127.5).abs() < 1e-5
        );
        assert_eq!(g.sh_rest_of(0)[1], Vec3::new(21.0, 28.0, 35.0) / 128.0);
        assert_eq!(g.sh_rest_of(1)[2], Vec3::new(105.0, 112.0, 119.0) / 128.0);
    }
}

#[test]
fn version_1_has_half_floats() {
    let mut bytes = spz_header(1, 1, 0, 0, 0);
    bytes.extend([0x00, 0x3c, 0x00, 0xc0, 0x00, 0x38]);
    bytes.extend([255, 128, 128, 128, 160, 160, 160, 128, 128, 128]);
    assert_eq!(read("v1", &bytes).unwrap().gaussians.means, [Vec3::new(1.0, -2.0, 0.5)]);
}

#[test]
fn version_3_omits_the_largest_component() {
    let mut bytes = spz_header(3, 1, 0, 12, 0);
    bytes.extend([0; 9]);
    bytes.extend([255, 128, 128, 128, 160, 160, 160]);
    // z is omitted (index 2 of x, y, z, w); x = +sqrt(1/2), y = -sqrt(1/2) / 511, w = 0.
    bytes.extend(((2_u32 << 30) | (511 << 20) | ((512 | 1) << 10)).to_le_bytes());
    let q = read("v3", &bytes).unwrap().gaussians.rotations[0];
    let half = std::f32::consts::FRAC_1_SQRT_2;
    assert!(
        (q.x.abs() - half).abs() < 1e-4
            && (q.y.abs() - half / 511.0).abs() < 1e-6
            && (q.z.abs() - half).abs() < 1e-4
            && q.w.abs() < 1e-6
    );
    assert!(q.x * q.z > 0.0 && q.x * q.y < 0.0, "{q}");
}

#[test]
fn antialiased_flag_is_the_mip_filter() {
    assert_eq!(read("a", &spz_v2(1)).unwrap().filter, Some(SplatFilter::Mip));
}

#[test]
fn coordinate_extension_names_the_up_axis() {
    // A left-handed system adds a note.
    for (number, up, num_notes) in [(6_u32, DVec3::NEG_Y, 1), (4, DVec3::Y, 1), (16, DVec3::Z, 1), (9, DVec3::NEG_Z, 2)]
    {
        let mut bytes = spz_v2(2);
        bytes.extend([0xAD_BE_12_34_u32, 3, 0].map(u32::to_le_bytes).concat());
        bytes.truncate(bytes.len() - 1);
        bytes.extend([0xAD_BE_00_03_u32, 4, number].map(u32::to_le_bytes).concat());
        let scene = read("ext", &bytes).unwrap();
        assert_eq!(scene.up, up, "system {number}");
        assert!(matches!(scene.up_source, UpSource::File(_)));
        assert_eq!(scene.notes.len(), num_notes, "system {number}: {:?}", scene.notes);
    }
}

#[test]
fn level_of_detail_trees_are_rejected() {
    assert_eq!(code("lod", &spz_v2(0x80)), "SCENE-UNSUPPORTED");
}

#[test]
fn inconsistent_headers_are_rejected() {
    let with = |at: usize, value: &[u8]| {
        let mut bytes = spz_v2(0);
        bytes[at..at + value.len()].copy_from_slice(value);
        bytes
    };
    assert_eq!(code("version", &with(4, &[9])), "SPZ-HEADER");
    assert_eq!(code("degree", &with(12, &[255])), "SPZ-HEADER");
    assert_eq!(code("bits", &with(13, &[255])), "SPZ-HEADER");
    assert_eq!(code("count", &with(8, &[3])), "SPZ-CORRUPT");
    assert_eq!(code("count", &gzip(&with(8, &[3]))), "SPZ-CORRUPT");
    assert_eq!(code("count", &with(8, &[255; 4])), "SCENE-COUNT-CAP");
    assert_eq!(code("magic", &gzip(b"not an spz at all")), "SPZ-HEADER");
}

#[test]
fn decompression_bombs_are_rejected() {
    let mut honest_header = spz_header(2, 1, 0, 12, 0);
    honest_header.resize(64 << 20, 0);
    assert_eq!(code("tail", &gzip(&honest_header)), "SPZ-BOMB");
    let mut many = spz_header(2, 40_000_000, 0, 12, 0);
    many.resize(1 << 20, 0);
    assert_eq!(code("claim", &gzip(&many)), "SPZ-BOMB");
    assert_eq!(code("zeros", &gzip(&vec![0; 16 << 20])), "SPZ-HEADER");
}

#[test]
fn damaged_gzip_is_rejected() {
    let good = gzip(&spz_v2(0));
    let mut bytes = good.clone();
    let checksum = bytes.len() - 8;
    bytes[checksum] ^= 1;
    assert_eq!(code("crc", &bytes), "SPZ-CORRUPT");
    assert_eq!(code("cut", &good[..good.len() - 9]), "SPZ-CORRUPT");
}

#[test]
fn the_fixtures_of_all_versions_hold_the_same_four_gaussians() {
    let Some(folder) = support::shared("data/format_fixtures") else { return };
    let load = |name: &str| super::read(name, &std::fs::read(folder.join(name)).unwrap()).unwrap();
    let (raw, v2, v3, v4) =
        (load("minimal-raw.spz"), load("minimal-v2.spz"), load("minimal-v3.spz"), load("minimal-v4.spz"));
    assert_eq!(raw.gaussians, v2.gaussians);
    assert_eq!(v3.gaussians, v4.gaussians);
    assert_eq!((v2.gaussians.len(), v4.gaussians.len(), v4.format.as_str()), (4, 4, "spz v4"));
}

//! `.ksplat`, PCD and glTF files, written here by the definition of each format.

use cinesplat::scene::{LoadOptions, Scene, UpSource, load};
use glam::{DVec3, Quat, Vec3};
use half::f16;

use super::bytes::spz_header;
use super::{code, read};
use crate::support::shared;

/// A `.ksplat` of one section with a full bucket of two records and one record in a partly filled bucket.
pub(super) fn ksplat(level: u16, degree: u16) -> Vec<u8> {
    let num_sh = [0, 9, 24][usize::from(degree)];
    let mut file = vec![0_u8; 4096 + 1024];
    let put = |file: &mut Vec<u8>, at: usize, bytes: &[u8]| file[at..at + bytes.len()].copy_from_slice(bytes);
    file[1] = 1;
    for (at, value) in [(4, 1_u32), (12, 3), (16, 3)] {
        put(&mut file, at, &value.to_le_bytes());
    }
    put(&mut file, 20, &level.to_le_bytes());
    put(&mut file, 36, &(-2.0_f32).to_le_bytes());
    put(&mut file, 40, &2.0_f32.to_le_bytes());
    for (at, value) in [(0, 3_u32), (4, 3), (8, 2), (12, 2), (24, 0), (32, 1), (36, 1)] {
        put(&mut file, 4096 + at, &value.to_le_bytes());
    }
    put(&mut file, 4096 + 16, &8.0_f32.to_le_bytes());
    put(&mut file, 4096 + 20, &12_u16.to_le_bytes());
    put(&mut file, 4096 + 40, &degree.to_le_bytes());
    file.extend(1_u32.to_le_bytes());
    let centers = [Vec3::new(10.0, 0.0, 0.0), Vec3::new(0.0, -20.0, 0.0)];
    file.extend(centers.iter().flat_map(glam::Vec3::to_array).flat_map(f32::to_le_bytes));
    for idx in 0..3_u16 {
        let real = |file: &mut Vec<u8>, value: f32| match level {
            0 => file.extend(value.to_le_bytes()),
            _ => file.extend(f16::from_f32(value).to_le_bytes()),
        };
        if level == 0 {
            [f32::from(idx), -2.0, 0.5].into_iter().for_each(|v| file.extend(v.to_le_bytes()));
        } else {
            // One scene unit is 32767 / 4 steps of a block of 8 units.
            [32767 + 8192 * idx, 32767, 16384].into_iter().for_each(|v| file.extend(v.to_le_bytes()));
        }
        [0.5, 0.25, 2.0, 0.5, -0.5, 0.5, 0.5].into_iter().for_each(|v| real(&mut file, v));
        file.extend([255, 0, 51, 204]);
        for k in 0..num_sh {
            match level {
                2 => file.push(k as u8 * 10),
                _ => real(&mut file, k as f32 * 0.125),
            }
        }
    }
    file
}

#[test]
fn ksplat_records_decode_at_every_compression() {
    for level in 0..3 {
        let scene = read("a.ksplat", &ksplat(level, 2)).unwrap();
        let g = &scene.gaussians;
        assert_eq!((g.len(), g.sh_degree, g.opacities[0]), (3, 2, 0.8));
        let wanted = if level == 0 {
            [[0.0, -2.0, 0.5], [1.0, -2.0, 0.5], [2.0, -2.0, 0.5]]
        } else {
            // Center plus steps times 4 / 32767; the third record is in the second bucket.
            let step = 4.0 / 32767.0;
            let z = (16384.0 - 32767.0) * step;
            [[10.0, 0.0, z], [10.0 + 8192.0 * step, 0.0, z], [2.0 * 8192.0 * step, -20.0, z]]
        };
        for (idx, wanted) in wanted.into_iter().enumerate() {
            assert!(g.mean_world(idx).distance(DVec3::from_array(wanted)) < 1e-5, "{level}: {}", g.mean_world(idx));
        }
        assert_eq!(g.scales[1], Vec3::new(0.5, 0.25, 2.0));
        assert!(g.rotations[1].abs_diff_eq(Quat::from_xyzw(-0.5, 0.5, 0.5, 0.5), 1e-3));
        assert!(g.base_color(2).abs_diff_eq(Vec3::new(1.0, 0.0, 0.2), 1e-6));
        // Band 1 holds three reds, three greens, three blues; band 2 five of each.
        let value = |k: usize| if level == 2 { -2.0 + 4.0 * k as f32 * 10.0 / 255.0 } else { k as f32 * 0.125 };
        let rest = g.sh_rest_of(1);
        assert!(rest[1].abs_diff_eq(Vec3::new(value(1), value(4), value(7)), 1e-6), "{}", rest[1]);
        assert!(rest[3].abs_diff_eq(Vec3::new(value(9), value(14), value(19)), 1e-6), "{}", rest[3]);
    }
}

#[test]
fn a_damaged_ksplat_is_refused() {
    let whole = ksplat(1, 1);
    assert_eq!(code("a.ksplat", &whole[..whole.len() - 1]), "SCENE-DAMAGED");
    let mut many = whole;
    many[4096 + 4..4096 + 8].copy_from_slice(&u32::MAX.to_le_bytes());
    assert_eq!(code("a.ksplat", &many), "SCENE-DAMAGED");
}

#[test]
fn the_same_four_splats_as_ksplat_and_as_splat() {
    let Some(folder) = shared("data/format_fixtures") else { return };
    let [a, b] =
        ["minimal.ksplat", "minimal.splat"].map(|name| load(&folder.join(name), &LoadOptions::default()).unwrap());
    assert_eq!((a.gaussians.means, a.gaussians.scales), (b.gaussians.means, b.gaussians.scales));
    assert_eq!((a.gaussians.opacities, a.gaussians.sh_dc), (b.gaussians.opacities, b.gaussians.sh_dc));
}

/// The head of a PCD with a label before the position, and a color.
fn pcd_head(num_points: usize, data: &str) -> String {
    format!(
        "# .PCD v0.7\nVERSION 0.7\nFIELDS label x y z rgb\nSIZE 4 4 4 4 4\nTYPE U F F F F\nCOUNT 1 1 1 1 1\n\
         WIDTH {num_points}\nHEIGHT 1\nPOINTS {num_points}\nDATA {data}\n"
    )
}

const POINTS: [[f32; 3]; 4] = [[0.0, 0.0, 1.0], [0.5, 0.0, 1.0], [f32::NAN, 0.0, 0.0], [1.0, 0.0, 1.0]];
const RED: u32 = 0x00ff_0033;

/// The points as a compressed PCD.
pub(super) fn compressed_pcd() -> Vec<u8> {
    // Compressed data holds one field after the other. Four equal labels are one literal label and a copy of 12 bytes from
    // 4 bytes back; the rest are literals.
    let mut packed = vec![3];
    packed.extend(7_u32.to_le_bytes());
    packed.extend([7 << 5, 12 - 2 - 7, 3]);
    let mut literals: Vec<u8> =
        (0..3).flat_map(|axis| POINTS.map(|point| point[axis]).map(f32::to_le_bytes)).flatten().collect();
    literals.extend([RED; 4].iter().flat_map(|color| color.to_le_bytes()));
    for piece in literals.chunks(32) {
        packed.push(piece.len() as u8 - 1);
        packed.extend(piece);
    }
    let mut compressed = pcd_head(4, "binary_compressed").into_bytes();
    compressed.extend((packed.len() as u32).to_le_bytes());
    compressed.extend(80_u32.to_le_bytes());
    compressed.extend(packed);
    compressed
}

fn check_cloud(scene: &Scene) {
    let g = &scene.gaussians;
    assert_eq!((g.len(), scene.dropped.len()), (3, 1));
    assert_eq!(g.mean_world(1), DVec3::new(0.5, 0.0, 1.0));
    assert!(g.base_color(0).abs_diff_eq(Vec3::new(1.0, 0.0, 0.2), 1e-6), "{}", g.base_color(0));
    // Half of the distance between neighbors.
    assert!(g.scales.iter().all(|scale| scale.abs_diff_eq(Vec3::splat(0.25), 1e-6)));
    assert!(scene.notes.iter().any(|note| note.contains("point cloud")), "{:?}", scene.notes);
}

#[test]
fn points_of_every_kind_of_pcd_become_small_gaussians() {
    let color = f32::from_bits(RED);
    let mut ascii = pcd_head(4, "ascii");
    for [x, y, z] in POINTS {
        let line = format!("7 {x} {y} {z} {color:e}\n");
        ascii.push_str(&line);
    }
    check_cloud(&read("a.pcd", ascii.as_bytes()).unwrap());
    let mut binary = pcd_head(4, "binary").into_bytes();
    for point in POINTS {
        binary.extend(7_u32.to_le_bytes());
        binary.extend(point.into_iter().flat_map(f32::to_le_bytes));
        binary.extend(RED.to_le_bytes());
    }
    check_cloud(&read("a.pcd", &binary).unwrap());
    let compressed = compressed_pcd();
    check_cloud(&read("a.pcd", &compressed).unwrap());
    assert_eq!(code("a.pcd", &compressed[..compressed.len() - 3]), "SCENE-DAMAGED");
    assert_eq!(code("a.pcd", &binary[..binary.len() - 3]), "SCENE-DAMAGED");
}

#[test]
fn signed_colors_of_a_pcd_keep_their_colors() {
    // With the highest byte set, as some writers do for alpha, the same bytes are below 0 as a signed number.
    let packed = (RED | 0xff00_0000).cast_signed();
    let head = pcd_head(2, "ascii").replace("TYPE U F F F F", "TYPE U F F F I");
    let text = format!("{head}7 0 0 1 {packed}\n7 0.5 0 1 {RED}\n");
    let scene = read("a.pcd", text.as_bytes()).unwrap();
    for idx in 0..2 {
        assert!(scene.gaussians.base_color(idx).abs_diff_eq(Vec3::new(1.0, 0.0, 0.2), 1e-6), "{idx}");
    }
}

#[test]
fn a_recorded_table_top_is_a_scene() {
    let Some(path) = shared("data/tabletop_mosd/test45.pcd") else { return };
    let scene = load(&path, &LoadOptions::default()).unwrap();
    assert_eq!(scene.gaussians.len() + scene.dropped.len(), 640 * 480);
    // A table at arm's length, in metres.
    let depths: Vec<f64> = (0..scene.gaussians.len()).map(|idx| scene.gaussians.mean_world(idx).z).collect();
    assert!(depths.iter().all(|depth| (0.1..10.0).contains(depth)));
}

/// A glTF with one primitive of two Gaussians of degree 1 under a moved, doubled node.
pub(super) fn gltf(node: &str, extension: &str) -> String {
    let mut bytes: Vec<u8> = Vec::new();
    let (mut views, mut accessors) = (Vec::new(), Vec::new());
    let mut column = |kind: &str, component: u32, normalized: bool, data: Vec<u8>| {
        views.push(format!(r#"{{"buffer":0,"byteOffset":{},"byteLength":{}}}"#, bytes.len(), data.len()));
        accessors.push(format!(
            r#"{{"bufferView":{},"componentType":{component},"normalized":{normalized},"count":2,"type":"{kind}"}}"#,
            accessors.len()
        ));
        bytes.extend(data);
        bytes.resize(bytes.len().next_multiple_of(4), 0);
    };
    let floats = |values: &[f32]| values.iter().flat_map(|v| v.to_le_bytes()).collect::<Vec<u8>>();
    column("VEC3", 5126, false, floats(&[1.0, 2.0, 3.0, -1.0, 0.0, 0.0]));
    column("VEC4", 5126, false, floats(&[0.0, 0.0, 0.0, 1.0, 0.5, -0.5, 0.5, 0.5]));
    column("VEC3", 5126, false, floats(&[0.5, 0.25, 2.0, 1.0, 1.0, 1.0]));
    column("SCALAR", 5121, true, vec![204, 51]);
    for coefficient in 0..4_u8 {
        let base = f32::from(coefficient);
        column("VEC3", 5126, false, floats(&[base, base + 0.25, base + 0.5, 0.0, 0.0, 0.0]));
    }
    let sh = ["0_COEF_0", "1_COEF_0", "1_COEF_1", "1_COEF_2"];
    let attributes: String = sh
        .iter()
        .zip(4..)
        .map(|(name, idx)| format!(r#","KHR_gaussian_splatting:SH_DEGREE_{name}":{idx}"#))
        .collect::<Vec<_>>()
        .concat();
    let data = cinesplat::files::base64::encode(&bytes);
    format!(
        r#"{{"asset":{{"version":"2.0"}},"scenes":[{{"nodes":[0]}}],"nodes":[{node}],
        "meshes":[{{"primitives":[{{"mode":0,"attributes":{{"POSITION":0,"KHR_gaussian_splatting:ROTATION":1,
        "KHR_gaussian_splatting:SCALE":2,"KHR_gaussian_splatting:OPACITY":3{attributes}}},
        "extensions":{{"KHR_gaussian_splatting":{extension}}}}}]}}],
        "accessors":[{}],"bufferViews":[{}],
        "buffers":[{{"byteLength":{},"uri":"data:application/octet-stream;base64,{data}"}}]}}"#,
        accessors.join(","),
        views.join(","),
        bytes.len()
    )
}

#[test]
fn gaussians_of_a_gltf_are_where_its_nodes_put_them() {
    let moved = r#"{"mesh":0,"translation":[10,0,0],"scale":[2,2,2]}"#;
    let scene = read("a.gltf", gltf(moved, r#"{"kernel":"ellipse"}"#).as_bytes()).unwrap();
    let g = &scene.gaussians;
    assert_eq!((g.len(), g.sh_degree, scene.up), (2, 1, DVec3::Y));
    assert!(matches!(scene.up_source, UpSource::File(_)));
    assert_eq!((g.mean_world(0), g.scales[0]), (DVec3::new(12.0, 4.0, 6.0), Vec3::new(1.0, 0.5, 4.0)));
    assert!((g.opacities[0] - 0.8).abs() < 1e-6);
    assert!(g.rotations[1].abs_diff_eq(Quat::from_xyzw(0.5, -0.5, 0.5, 0.5), 1e-6));
    assert_eq!((g.sh_dc[0], g.sh_rest_of(0)[2]), (Vec3::new(0.0, 0.25, 0.5), Vec3::new(3.0, 3.25, 3.5)));
    // A quarter turn about z takes x to y; coefficients of unturned axes are left out.
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let turned = format!(r#"{{"mesh":0,"rotation":[0,0,{half},{half}]}}"#);
    let scene = read("a.gltf", gltf(&turned, "{}").as_bytes()).unwrap();
    assert!(scene.gaussians.mean_world(0).distance(DVec3::new(-2.0, 1.0, 3.0)) < 1e-6);
    assert_eq!(scene.gaussians.sh_degree, 0);
    assert!(scene.notes.iter().any(|note| note.contains("without view-dependent color")), "{:?}", scene.notes);
    let packed = r#"{"extensions":{"EXT_other_compression":{"bufferView":0}}}"#;
    assert_eq!(code("a.gltf", gltf(moved, packed).as_bytes()), "SCENE-UNSUPPORTED");
}

#[test]
fn the_attribute_types_of_the_conformance_matrix() {
    let Some(folder) = shared("data/format_fixtures") else { return };
    let [text, binary] = ["khr_conformance_matrix.gltf", "khr_conformance_matrix.glb"]
        .map(|name| load(&folder.join(name), &LoadOptions::default()).unwrap());
    assert_eq!(text.gaussians, binary.gaussians);
    assert_eq!((text.gaussians.sh_degree, text.format.as_str()), (3, "gltf (15 primitives)"));
}

/// A glTF with one primitive that is an SPZ.
fn spz_gltf(node: &str, spz: &[u8]) -> String {
    let data = cinesplat::files::base64::encode(spz);
    format!(
        r#"{{"asset":{{"version":"2.0"}},"scenes":[{{"nodes":[0]}}],"nodes":[{node}],
        "meshes":[{{"primitives":[{{"mode":0,"attributes":{{}},"extensions":{{"KHR_gaussian_splatting":{{"extensions":
        {{"KHR_gaussian_splatting_compression_spz_2":{{"bufferView":0}}}}}}}}}}]}}],
        "bufferViews":[{{"buffer":0,"byteLength":{len}}}],
        "buffers":[{{"byteLength":{len},"uri":"data:application/octet-stream;base64,{data}"}}]}}"#,
        len = spz.len()
    )
}

#[test]
fn gaussians_compressed_as_spz_in_a_gltf_have_the_coordinates_of_the_spz() {
    let mut spz = spz_header(2, 1, 3, 12, 0);
    for step in [4096_i32, -8192, 1024] {
        spz.extend(&step.to_le_bytes()[..3]);
    }
    spz.extend([255, 128, 40, 200, 160, 144, 176, 200, 100, 90]);
    spz.extend((0..45_u8).map(|k| 20 + 5 * k));
    let own = read("a.spz", &spz).unwrap().gaussians;
    let scene =
        read("a.gltf", spz_gltf(r#"{"mesh":0,"translation":[10,0,0],"scale":[2,2,2]}"#, &spz).as_bytes()).unwrap();
    let found = &scene.gaussians;
    assert_eq!((scene.format.as_str(), scene.up, found.sh_degree), ("gltf (1 primitives, 1 as SPZ)", DVec3::Y, 3));
    // 4096, -8192 and 1024 steps of 1/4096 are 1, -2 and 1/4; the node doubles them and adds 10 to x.
    assert!(found.mean_world(0).distance(DVec3::new(12.0, -4.0, 0.5)) < 1e-6);
    assert!(found.rotations[0].abs_diff_eq(own.rotations[0], 1e-6));
    assert!(scene.notes.iter().any(|note| note.contains("CesiumJS")), "{:?}", scene.notes);
    assert!(found.scales[0].abs_diff_eq(2.0 * own.scales[0], 1e-6));
    assert_eq!((found.opacities[0], found.sh_dc[0]), (own.opacities[0], own.sh_dc[0]));
    assert_eq!(found.sh_rest_of(0), own.sh_rest_of(0));
    let cut = spz_gltf(r#"{"mesh":0}"#, &spz[..spz.len() - 9]);
    assert_eq!(code("a.gltf", cut.as_bytes()), "SPZ-CORRUPT");
    let outside = spz_gltf(r#"{"mesh":0}"#, &spz).replace(r#""bufferViews":[{"#, r#""bufferViews":[{"byteOffset":99,"#);
    assert_eq!(code("a.gltf", outside.as_bytes()), "SCENE-DAMAGED");
}

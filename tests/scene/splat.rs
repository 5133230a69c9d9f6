use glam::{Quat, Vec3};

use super::bytes::splat_record;
use super::{code, read};

#[test]
fn record_decodes_to_its_values() {
    let bytes = splat_record([1.0, -2.0, 3.0], [0.5, 0.25, 2.0], [255, 0, 51, 204], [128 + 90, 128, 128, 128 + 90]);
    let scene = read("a.splat", &bytes).unwrap();
    let g = &scene.gaussians;
    assert_eq!(
        (scene.format.as_str(), g.means[0], g.scales[0]),
        ("splat", Vec3::new(1.0, -2.0, 3.0), Vec3::new(0.5, 0.25, 2.0))
    );
    assert!(g.base_color(0).abs_diff_eq(Vec3::new(1.0, 0.0, 0.2), 1e-6) && (g.opacities[0] - 0.8).abs() < 1e-6);
    assert!(g.rotations[0].abs_diff_eq(Quat::from_rotation_z(std::f32::consts::FRAC_PI_2), 1e-6));
}

#[test]
fn content_decides_the_format() {
    let bytes = splat_record([1.0, -2.0, 3.0], [0.5, 0.25, 2.0], [9; 4], [255, 128, 128, 128]);
    assert_eq!(read("a.ply", &bytes).unwrap().format, "splat");
    assert_eq!(read("a.splat", &super::bytes::row_of(1)).unwrap().format, "ply");
    assert_eq!(read("a.splat", &super::bytes::spz_v2(0)).unwrap().format, "spz v2");
}

#[test]
fn partial_records_are_rejected() {
    let bytes = splat_record([1.0; 3], [1.0; 3], [9; 4], [255, 128, 128, 128]);
    assert_eq!(code("a.splat", &[]), "SPLAT-SIZE");
    assert_eq!(code("a.splat", &bytes[..31]), "SPLAT-SIZE");
    assert_eq!(code("a.bin", &[]), "SCENE-FORMAT");
    assert_eq!(code("a.bin", &[0; 64]), "SCENE-FORMAT");
    assert_eq!(code("a.bin", &[0xff; 64]), "SCENE-FORMAT");
}

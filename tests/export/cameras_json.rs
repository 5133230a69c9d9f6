use std::path::Path;

use cinesplat::export::cameras_json::{FilterChoice, read};
use glam::{DVec2, DVec3};

const ONE: &str = r#"{"near": 0.2, "unknown": [1], "cameras": [{"name": "c0", "width": 640, "height": 360,
  "fx": 500.0, "fy": 510.0, "cx": 320, "cy": 180, "world_from_camera": [[1,0,0,1],[0,1,0,2],[0,0,1,3],[0,0,0,1]]}]}"#;

#[test]
fn reads_pose_and_intrinsics() {
    let file = read(ONE).unwrap();
    let camera = file.cameras[0].camera;
    assert_eq!((file.near, file.filter, file.scene), (Some(0.2), None, None));
    assert_eq!(camera.pose.position, DVec3::new(1.0, 2.0, 3.0));
    // By hand: 2 units ahead, 1 right and 1 down.
    let (pixel, depth) = camera.project(DVec3::new(2.0, 3.0, 5.0)).unwrap();
    assert_eq!((pixel, depth), (DVec2::new(320.0 + 250.0, 180.0 + 255.0), 2.0));
}

#[test]
fn reads_the_golden_cameras() {
    let golden = |name: &str| {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/render/golden").join(name);
        read(&std::fs::read_to_string(path).unwrap()).unwrap()
    };
    let (classic, mip) = (golden("fruit.cameras.json"), golden("fruit_mip.cameras.json"));
    assert_eq!((classic.filter, classic.near), (Some(FilterChoice::Classic), Some(0.2)));
    assert_eq!((mip.filter, mip.near), (Some(FilterChoice::Mip), Some(0.1)));
    assert_eq!((classic.cameras.len(), mip.cameras.len()), (2, 1));
    assert_eq!(classic.scene.as_deref().map(Path::new), Some(Path::new("fruit.ply")));
    // The first camera is level in a world whose up is +y; its principal point is off the center.
    let level = classic.cameras[0].camera;
    assert_eq!(level.pose.up(), DVec3::Y);
    assert_eq!((level.intrinsics.cx_px, level.intrinsics.cy_px), (54.5, 20.25));
}

#[test]
fn errors_name_the_camera_and_the_field() {
    let refused = |from: &str, to: &str| read(&ONE.replace(from, to)).unwrap_err().to_string();
    insta::assert_snapshot!(refused("\"fx\": 500.0,", ""), @"cameras[0].fx: found nothing, expected pixels");
    insta::assert_snapshot!(refused("[1,0,0,1]", "[2,0,0,1]"), @r#"cameras[0].world_from_camera: found [[2,0,0,1],[0,1,0,2],[0,0,1,3],[0,0,0,1]], expected a rigid pose (not a rotation: R^T R is off the identity by 3.000e0, determinant 2.000e0)"#);
    insta::assert_snapshot!(refused("\"c0\"", "\"../c0\""), @r#"cameras[0].name: found "../c0", expected a file name without folders"#);
    insta::assert_snapshot!(refused("640", "0"), @r#"cameras[0]: found {"cx":320,"cy":180,"fx":500.0,"fy":510.0,"height":360,"name".., expected width, height, fx and fy above 0"#);
    insta::assert_snapshot!(read(r#"{"cameras": []}"#).unwrap_err(), @"no camera poses in the file, expected at least one");
}

#[test]
fn a_misspelled_key_is_named_with_the_nearest_known_one() {
    let notes = |text: &str| read(text).unwrap().notes;
    assert_eq!(notes(&ONE.replace("\"unknown\": [1], ", "")), [""; 0]);
    let misspelled = ONE.replace("\"near\"", "\"neer\"").replace("\"unknown\": [1]", "\"version\": 1");
    insta::assert_snapshot!(notes(&misspelled).join("\n"), @"neer: unknown key, the nearest known key is near");
}

#[test]
fn an_unknown_version_is_refused() {
    let error = read(&ONE.replace("\"unknown\": [1]", "\"version\": 2")).unwrap_err();
    insta::assert_snapshot!(error, @"cameras.json version 2, expected 1");
}

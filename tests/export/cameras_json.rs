use cinesplat::export::cameras_json::{FilterChoice, read};
use glam::{DVec2, DVec3};

use crate::support::shared;

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
    let Some(path) = shared("data/golden/kitchen_mip.cameras.json") else { return };
    let file = read(&std::fs::read_to_string(path).unwrap()).unwrap();
    assert_eq!(file.filter, Some(FilterChoice::Mip));
    assert_eq!(file.cameras.len(), 3);
    // The kitchen's up is +y, so every camera's up has a positive y.
    assert!(file.cameras.iter().all(|c| c.camera.pose.up().y > 0.9));
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

use cinesplat::export::{Content, Format, read};
use cinesplat::geometry::Pose;
use glam::{DQuat, DVec3};
use serde_json::Value;

use super::sample_shot::{file, key, shot, there_and_back};

/// The camera stood on the other side of the scene: the program's world is the file's turned by half a turn about x.
/// Poses as in the program's own check of its videos (`scripts/verify_video_orientation.py`); positions, view and up in
/// the scene file's world by hand.
#[test]
fn the_world_is_turned_about_x() {
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let cases = [
        ([0.0, 0.0, 5.0], [1.0, 0.0, 0.0, 0.0], DVec3::new(0.0, 0.0, -5.0), DVec3::Z, DVec3::NEG_Y),
        ([0.0, 0.0, 5.0], [half, 0.0, 0.0, half], DVec3::new(0.0, 0.0, -5.0), DVec3::Z, DVec3::NEG_X),
        ([0.0, 5.0, 0.0], [half, -half, 0.0, 0.0], DVec3::new(0.0, -5.0, 0.0), DVec3::Y, DVec3::Z),
        ([0.0, -5.0, 0.0], [half, half, 0.0, 0.0], DVec3::new(0.0, 5.0, 0.0), DVec3::NEG_Y, DVec3::NEG_Z),
    ];
    for (position, rotation, place, forward, up) in cases {
        let text = serde_json::json!({"version": 4, "clip_duration": 0.1, "keyframes": [
            {"time": 0.0, "position": position, "rotation": rotation, "focal_length_mm": 20.0, "easing": 0}]});
        let (path, _folder) = file("a.json", text.to_string().as_bytes());
        let pose = read(&path, None).unwrap().track.frames[0].pose;
        assert!(pose.position.distance(place) < 1e-12, "{pose:?}");
        assert!(pose.forward().distance(forward) < 1e-12, "{pose:?}");
        assert!(pose.up().distance(up) < 1e-12, "{pose:?}");
    }
}

#[test]
fn a_level_camera_has_the_programs_identity_rotation() {
    let pose = Pose::new(DVec3::new(1.0, -2.0, -5.0), DQuat::IDENTITY);
    let level = shot(vec![key(0.0, pose.position, pose.rotation, 60.0)], DVec3::NEG_Y);
    let (_, _, folder) = there_and_back(&level, Format::Lichtfeld, "a.json", Content::Sampled);
    let text = std::fs::read_to_string(folder.path().join("a.json")).unwrap();
    let key = &serde_json::from_str::<Value>(&text).unwrap()["keyframes"][0];
    let numbers =
        |name: &str| -> Vec<f64> { key[name].as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect() };
    assert_eq!(numbers("position"), [1.0, 2.0, 5.0]);
    let [w, x, y, z] = numbers("rotation").try_into().unwrap();
    assert_eq!((w.abs(), x, y, z), (1.0, 0.0, 0.0, 0.0));
    // By hand: 12 mm over the tangent of 30 degrees.
    assert!((key["focal_length_mm"].as_f64().unwrap() - 20.784_609_690_826_528).abs() < 1e-9);
}

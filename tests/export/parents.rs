//! Cameras that move, are stretched or are mirrored with the nodes above them.

use cinesplat::export::{PoseTrack, read};
use glam::DVec3;

use super::sample_shot::file;

/// A camera that turns by `turn` (xyzw) under a node with the given properties.
fn gltf_under(above: &str, turn: &str) -> PoseTrack {
    let text = format!(
        r#"{{"asset": {{"version": "2.0"}}, "cameras": [{{"perspective": {{"yfov": 0.8, "znear": 0.1}}}}],
        "nodes": [{{"children": [1], {above}}}, {{"camera": 0, "translation": [1, 2, 3], "rotation": {turn}}}]}}"#
    );
    let (path, _folder) = file("a.gltf", text.as_bytes());
    read(&path, None).unwrap().track
}

const NO_TURN: &str = "[0, 0, 0, 1]";
/// An eighth of a turn about z.
const EIGHTH_ABOUT_Z: &str = "[0, 0, 0.3826834323650898, 0.9238795325112867]";

#[test]
fn a_stretched_node_moves_its_camera_along_every_axis() {
    let track = gltf_under(r#""scale": [2, 3, 4]"#, NO_TURN);
    let pose = track.frames[0].pose;
    assert!(pose.position.distance(DVec3::new(2.0, 6.0, 12.0)) < 1e-12, "{}", pose.position);
    assert!(pose.forward().distance(DVec3::NEG_Z) < 1e-12 && pose.up().distance(DVec3::Y) < 1e-12);
    let wanted = "the nodes above the camera stretch it by up to 2.000 times: its picture is not stretched here";
    assert_eq!(track.unread, [wanted]);
}

#[test]
fn a_mirrored_node_is_reported_and_the_view_direction_is_kept() {
    for above in [r#""scale": [-1, 1, 1]"#, r#""matrix": [-1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]"#] {
        let track = gltf_under(above, NO_TURN);
        let pose = track.frames[0].pose;
        assert!(pose.position.distance(DVec3::new(-1.0, 2.0, 3.0)) < 1e-12, "{}", pose.position);
        assert!(pose.forward().distance(DVec3::NEG_Z) < 1e-12 && pose.up().distance(DVec3::Y) < 1e-12);
        assert_eq!(track.unread, ["the nodes above the camera mirror it: its picture is not mirrored here"]);
    }
}

#[test]
fn a_skewed_camera_is_reported_with_the_angle() {
    // The camera's axes (1, 1) and (-1, 1) become (2, 1) and (-2, 1), 126.87 degrees apart.
    let track = gltf_under(r#""scale": [2, 1, 1]"#, EIGHTH_ABOUT_Z);
    let pose = track.frames[0].pose;
    assert!(pose.forward().distance(DVec3::NEG_Z) < 1e-12);
    assert!(pose.up().distance(DVec3::new(-2.0, 1.0, 0.0).normalize()) < 1e-12, "{}", pose.up());
    assert!(track.unread.iter().any(|line| line.contains("skew it by up to 36.87 degrees")), "{:?}", track.unread);
}

#[test]
fn a_node_of_size_0_above_a_camera_is_refused() {
    let text = br#"{"asset": {"version": "2.0"}, "cameras": [{"perspective": {"yfov": 0.8}}],
        "nodes": [{"children": [1], "scale": [0, 0, 0]}, {"camera": 0}]}"#;
    let (path, _folder) = file("a.gltf", text);
    assert!(read(&path, None).unwrap_err().to_string().contains("a scale that is not 0"));
}

#[test]
fn a_second_gltf_buffer_without_uri_does_not_get_the_bytes_of_the_first() {
    let json = r#"{"asset": {"version": "2.0"}, "cameras": [{"perspective": {"yfov": 1}}], "nodes": [{"camera": 0}],
        "animations": [{"samplers": [{"input": 0, "output": 1}], "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "type": "SCALAR", "count": 1},
            {"bufferView": 1, "componentType": 5126, "type": "VEC3", "count": 1}],
        "bufferViews": [{"buffer": 0, "byteLength": 4}, {"buffer": 1, "byteLength": 12}],
        "buffers": [{"byteLength": 12}, {"byteLength": 12}]}"#;
    let json = format!("{json:<width$}", width = json.len().next_multiple_of(4));
    let mut glb = b"glTF\x02\0\0\0".to_vec();
    glb.extend((12 + 8 + json.len() as u32 + 8 + 12).to_le_bytes());
    glb.extend((json.len() as u32).to_le_bytes());
    glb.extend(b"JSON");
    glb.extend(json.as_bytes());
    glb.extend(12_u32.to_le_bytes());
    glb.extend(b"BIN\0");
    glb.extend([0; 12]);
    let (path, _folder) = file("a.glb", &glb);
    assert!(read(&path, None).unwrap_err().to_string().contains("values inside the buffer"));
}

#[test]
fn usd_animation_above_the_camera_is_not_dropped() {
    // The rig moves along x in 0..24 and rises at 12; the camera itself has one key, at 6.
    let text = br#"#usda 1.0
( upAxis = "Y" timeCodesPerSecond = 24 )
def Xform "crane" {
  double3 xformOp:translate.timeSamples = { 12: (0, 0, 0), 24: (0, 2, 0) }
  uniform token[] xformOpOrder = ["xformOp:translate"]
  def Xform "dolly" {
    double3 xformOp:translate.timeSamples = { 0: (0, 0, 0), 24: (4, 0, 0) }
    uniform token[] xformOpOrder = ["xformOp:translate"]
    def Camera "cam" {
      float focalLength.timeSamples = { 6: 50 }
    }
  }
}
"#;
    let (path, _folder) = file("a.usda", text);
    let frames = read(&path, None).unwrap().track.frames;
    let found: Vec<(f64, DVec3)> = frames.iter().map(|frame| (frame.time_secs * 24.0, frame.pose.position)).collect();
    let wanted = [(0.0, 0.0, 0.0), (6.0, 1.0, 0.0), (12.0, 2.0, 0.0), (24.0, 4.0, 2.0)];
    assert_eq!(found, wanted.map(|(code, x, y)| (code, DVec3::new(x, y, 0.0))));
}

#[test]
fn usd_operations_that_are_undone_and_a_reset_stack() {
    // A quarter turn about y around the pivot (1, 0, 0), under a parent that a reset excludes.
    let text = br#"#usda 1.0
def Xform "far" {
  double3 xformOp:translate = (100, 0, 0)
  uniform token[] xformOpOrder = ["xformOp:translate"]
  def Camera "cam" {
    double3 xformOp:translate:pivot = (1, 0, 0)
    double xformOp:rotateY = 90
    uniform token[] xformOpOrder = ["!resetXformStack!", "xformOp:translate:pivot", "xformOp:rotateY", "!invert!xformOp:translate:pivot"]
  }
}
"#;
    let (path, _folder) = file("a.usda", text);
    let pose = read(&path, None).unwrap().track.frames[0].pose;
    // The origin is 1 to the left of the pivot, and comes to 1 toward +z from it; the view turns from -z to -x.
    assert!(pose.position.distance(DVec3::new(1.0, 0.0, 1.0)) < 1e-12, "{}", pose.position);
    assert!(pose.forward().distance(DVec3::NEG_X) < 1e-12);
}
